"""The linear part by the sides of rectangles: against the triangles' own matrices and loads."""

from dataclasses import replace

import numpy as np
import pytest

from fluxbore.design.spec import Spec
from fluxbore.fem.force import axial_force_gradient
from fluxbore.fem.magnetostatics import Settings, System
from fluxbore.fem.rectangles import linear_part
from fluxbore.fem.tubular import TubularSolution, solve_positions
from fluxbore.geometry.hybrid import cross_section


def assert_alike(general: System, values: np.ndarray) -> None:
    """Each entry to rounding of what is on the diagonal beside it: the triangles' sums cancel."""
    pattern = general.pattern
    root = np.zeros(pattern.unknowns)
    whole = general.linear if not general.iron else general.tangent_values(np.zeros(pattern.unknowns))
    on_diagonal = pattern.rows == pattern.columns
    root[pattern.rows[on_diagonal]] = np.sqrt(whole[on_diagonal])
    assert np.all(np.abs(values - general.linear) <= 1e-11 * root[pattern.rows] * root[pattern.columns])


def test_linear_part_is_that_of_the_triangles(mid_stroke: TubularSolution) -> None:
    """Catches a pair that is lost, a mirrored cell taken for a plain one, or an edge of the open rim that counts once
    too little: entry by entry, with magnets, iron and the rim."""
    problem = mid_stroke.solution.problem
    part = linear_part(mid_stroke.grid, problem.materials, problem.edges)
    assert part is not None
    general = System(problem)
    assert_alike(general, part.values)
    assert System(problem, part).load == pytest.approx(general.load, rel=1e-12, abs=1e-12 * np.abs(general.load).max())


def test_reluctivity_with_a_direction(mid_stroke: TubularSolution) -> None:
    """Catches ν_r and ν_z in each other's place."""
    problem = mid_stroke.solution.problem
    air = replace(problem.materials[0], reluctivity=(1e5, 3e5))
    uneven = replace(problem, materials=(air, *problem.materials[1:]))
    part = linear_part(mid_stroke.grid, uneven.materials, uneven.edges)
    assert part is not None
    assert_alike(System(uneven), part.values)


def test_what_rectangles_do_not_know_is_left_to_the_triangles(mid_stroke: TubularSolution) -> None:
    """Catches a magnet along r, whose load would be dropped without a word."""
    materials = mid_stroke.solution.problem.materials
    radial = replace(materials[0], coercivity=(1.0, 0.0))
    assert linear_part(mid_stroke.grid, (radial, *materials[1:])) is None


def test_fast_and_plain_path_agree(spec: Spec) -> None:
    """Catches a fast path that solves another problem: SuperLU takes general assembly and no condensation."""
    places = [spec.actuator.mid_stroke + step for step in (0.0, 3e-3)]
    fast, plain = (
        solve_positions(
            lambda z: cross_section(spec.actuator, z, spec.materials, 293.15), places, Settings(1e-11, 60, method)
        )
        for method in ("banded", "superlu")
    )
    for one, other in zip(fast, plain, strict=True):
        assert one.thrust_constants() == pytest.approx(other.thrust_constants(), rel=1e-9)
        assert one.flux_linkages() == pytest.approx(other.flux_linkages(), rel=1e-9)
        assert one.cogging_force() == pytest.approx(other.cogging_force(), rel=1e-9, abs=1e-9)
        psi = other.solution.psi
        assert one.solution.psi == pytest.approx(psi, rel=1e-9, abs=1e-9 * np.abs(psi).max())


def test_pull_is_that_of_the_force_shell(mid_stroke: TubularSolution) -> None:
    """Catches a mirrored cell with the wrong sign, or a column beside the shell: against the triangles' stress."""
    annulus = mid_stroke.section.force_annulus
    plain = axial_force_gradient(mid_stroke.solution, annulus)
    assert mid_stroke.pull == pytest.approx(plain, rel=1e-9, abs=1e-12 * np.abs(plain).max())
