"""Refinement until estimates hold: when it ends, what it reports, and that it goes where the error is."""

import sys
from functools import cache
from pathlib import Path
from typing import NoReturn

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases import conductors, iron, slabs
from cases.drawing import MU_0, Drawing

from fluxbore.fem.adapt import tangent_product
from fluxbore.fem.bisection import signed_area
from fluxbore.fem.factors import SingularMatrixError
from fluxbore.fem.femm_model import FemmModel
from fluxbore.fem.femm_solution import FemmSolution, solve_model


def corner() -> FemmModel:
    """The L of three unit squares around the origin, A = 0 around it: the field is infinite in the corner."""
    drawing = Drawing(False, "meters")
    wall = drawing.boundary("A=0")
    drawing.line((0, 0), (1, 0), (1, 1), (-1, 1), (-1, -1), (0, -1), (0, 0), boundary=wall)
    drawing.label(-0.5, 0.5, drawing.material("Copper", density=1 / MU_0))
    return drawing.model()


@cache
def solved(accuracy: float) -> FemmSolution:
    return solve_model(corner(), accuracy=accuracy)


def test_ends_when_the_estimates_hold() -> None:
    """Catches one level too few or too many."""
    for accuracy in (1e-2, 1e-3, 1e-4):
        adapted = solved(accuracy).adapted
        assert adapted.reached
        assert adapted.levels[-1].worst <= accuracy
        assert all(level.worst > accuracy for level in adapted.levels[:-1])
        assert np.all(np.diff([level.unknowns for level in adapted.levels]) > 0)


def test_same_path_to_every_accuracy() -> None:
    """Catches chance: a stricter request goes through the same energies first."""
    loose, strict = (solved(accuracy).adapted.levels for accuracy in (1e-2, 1e-3))
    assert [level.unknowns for level in loose] == [level.unknowns for level in strict][: len(loose)]


def test_says_when_the_unknowns_run_out() -> None:
    """Catches a promise of an accuracy that was not reached, and more unknowns than allowed."""
    adapted = solve_model(corner(), accuracy=1e-7, max_unknowns=1000).adapted
    assert not adapted.reached
    assert adapted.levels[-1].unknowns <= 1000
    assert adapted.levels[-1].worst > 1e-7


def test_refines_towards_the_corner() -> None:
    """Catches uniform refinement: triangles in the corner are fifty times smaller than the largest."""
    mesh = solved(1e-4).adapted.triangulation
    corners = mesh.points[mesh.triangles]
    size = np.sqrt(signed_area(mesh.points, mesh.triangles))
    distance = np.hypot(*corners.mean(axis=1).T)
    assert size[distance < 0.05].min() < 0.02 * size.max()
    assert size[distance > 0.5].min() > 0.05 * size.max()


def test_exact_fields_are_not_refined() -> None:
    """Catches estimates of what is not there: a field that the elements hold needs one mesh."""
    adapted = solve_model(slabs.mixed_condition().model, accuracy=1e-6).adapted
    assert adapted.reached
    assert len(adapted.levels) == 1


def test_carried_field_is_a_good_start() -> None:
    """Catches a field lost between meshes: a saturated ring needs fewer of Newton's steps on its second mesh."""
    levels = solve_model(iron.saturated_ring().model, accuracy=1e-6, max_unknowns=20_000).adapted.levels
    assert len(levels) > 1
    assert max(level.iterations for level in levels[1:]) < levels[0].iterations


def test_tangent_product_is_twice_the_energy_of_a_linear_problem() -> None:
    """Catches a differential reluctivity that misses a factor: ∫ B·D·B = 2 W, in all materials without a curve."""
    found = solve_model(conductors.confined_wire().model, accuracy=1e-2)
    field = found.solution.flux_density()
    product = tangent_product(found.solution, field, field)
    assert product.sum() * found.solution.problem.extent == pytest.approx(2 * found.energies[0], rel=1e-12)


def test_tangent_product_of_steel() -> None:
    """Catches ν in D's place: ∫ a·D·a is the second difference of the energy along a, in saturated steel."""
    from fluxbore.fem.energy import energy_densities

    found = solve_model(iron.saturated_ring().model, accuracy=1e-2).solution
    system, psi = found.system, found.psi
    step = 1e-3 * psi
    middle, up, down = (energy_densities(system, psi + k * step)[0] for k in (0, 1, -1))
    field = 1e-3 * found.flux_density()
    assert tangent_product(found, field, field).sum() == pytest.approx((up - 2 * middle + down).sum(), rel=1e-3)


def test_ends_where_a_goal_has_no_estimate(monkeypatch: pytest.MonkeyPatch) -> None:
    """Catches an adjoint without a solution that takes the field along with it, or that counts as accuracy reached."""
    model = iron.saturated_ring().model

    def unsolvable(*_: object) -> NoReturn:
        raise SingularMatrixError("on purpose")

    monkeypatch.setattr("fluxbore.fem.adapt._estimates", unsolvable)
    found = solve_model(model, accuracy=0.5, points=((30.0, 0.0),))
    assert found.solution.convergence.converged
    assert found.solution.convergence.residual < 1e-8
    assert not found.adapted.reached
    assert [level.estimates for level in found.adapted.levels] == [()]
