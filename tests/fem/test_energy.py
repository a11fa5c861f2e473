"""Laws that energies, linkages and fields obey whatever the drawing: reciprocity, balance, scale, shift and mirror."""

import sys
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases.drawing import Drawing
from exact import layers

from fluxbore.fem.energy import energies, energy_densities
from fluxbore.fem.femm_model import FemmModel
from fluxbore.fem.femm_solution import FemmSolution, solve_model

LOOSE = 5e-2
"""What must hold on any mesh is tried on coarse ones."""

sizes = st.floats(2.0, 9.0)
some = settings(max_examples=5)

CURRENT = 400.0
"""A, of the coil that drives a core of steel to 1.9 T."""


def coils(
    width: float = 5.0,
    gap: float = 4.0,
    currents: tuple[float, float] = (3.0, -1.0),
    turns: tuple[float, float] = (100, 40),
    mu: float = 30.0,
    axisymmetric: bool = True,
    at: tuple[float, float] = (0.0, 0.0),
    mirrored: bool = False,
    unit: float = 1.0,
) -> FemmModel:
    """Two coils (groups 1 and 2) and a core of permeability mu, in a box of 60 by 80 mm times ``unit``."""
    drawing = Drawing(axisymmetric, depth=20.0)
    wall = drawing.boundary("A=0")
    air, copper, iron = drawing.material("Air"), drawing.material("Copper"), drawing.material("Iron", mu=mu)

    def box(x: tuple[float, float], y: tuple[float, float], boundary: int | None = None) -> tuple[float, float]:
        y = (-y[1], -y[0]) if mirrored else y
        x, y = ((unit * (low + shift), unit * (high + shift)) for (low, high), shift in zip((x, y), at, strict=True))
        drawing.rectangle(x, y, boundary)
        return sum(x) / 2, sum(y) / 2

    box((0, 60), (-40, 40), wall)
    drawing.label(*box((4, 10), (-12, 5)), iron, group=3)
    drawing.label(*box((15, 15 + width), (-8, 2)), copper, drawing.circuit("one", currents[0]), turns[0], 1)
    drawing.label(*box((17, 24), (2 + gap, 8 + gap)), copper, drawing.circuit("two", currents[1]), turns[1], 2)
    low, high = (55 + at[0]) * unit, (38 + at[1]) * unit
    drawing.label(low, high, air)
    return drawing.model()


@cache
def solved(model: FemmModel) -> FemmSolution:
    return solve_model(model, accuracy=LOOSE)


@some
@given(sizes, sizes, st.booleans())
def test_mutual_inductance_is_mutual(width: float, gap: float, axisymmetric: bool) -> None:
    """Catches a load that is not the linkage's: M12 = M21 on any mesh, and λ = L I."""
    solution = solved(coils(width, gap, axisymmetric=axisymmetric))
    inductances = solution.inductances()
    assert inductances == pytest.approx(inductances.T, rel=1e-9)
    assert solution.linkages == pytest.approx(inductances @ (3.0, -1.0), rel=1e-6)
    assert np.all(np.linalg.eigvalsh(inductances) > 0)


@some
@given(sizes, st.floats(-5, 5), st.booleans())
def test_linear_energy_is_half_of_current_times_linkage(width: float, current: float, axisymmetric: bool) -> None:
    """Catches a factor of 2π or of the depth in one of the two: W = W' = ½ Σ I λ."""
    solution = solved(coils(width, currents=(current, 2.0), axisymmetric=axisymmetric))
    energy, coenergy = solution.energies
    assert energy == pytest.approx(coenergy, rel=1e-12)
    assert energy == pytest.approx(np.dot((current, 2.0), solution.linkages) / 2, rel=1e-6)


@cache
def saturated() -> FemmSolution:
    """The same with a core of steel, saturated."""
    model = coils(currents=(CURRENT, 0.0))
    steel = replace(model.materials[2], curve=layers.Steel().table())
    return solved(replace(model, materials=(*model.materials[:2], steel)))


def test_energy_and_coenergy_add_up() -> None:
    """Catches a coenergy that is not ∫ B dH: W + W' = Σ I λ, and W < W' in a steel that saturates."""
    energy, coenergy = saturated().energies
    assert energy + coenergy == pytest.approx(CURRENT * saturated().linkages[0], rel=1e-6)
    assert energy < 0.99 * coenergy


def test_incremental_inductance_is_the_linkage_s_slope() -> None:
    """Catches a tangent that is not the residual's derivative, on one mesh: dλ/dI by differences."""
    from fluxbore.fem.magnetostatics import Settings, solve

    base = saturated().solution
    step = 1e-2
    ends = []
    for current in (CURRENT - step, CURRENT + step):
        circuits = (replace(base.problem.circuits[0], current=current), *base.problem.circuits[1:])
        moved = solve(replace(base.problem, circuits=circuits), Settings(1e-12, method="auto"), base.psi)
        ends.append(2 * np.pi * base.problem.circuits[0].density @ moved.psi)
    slope = (ends[1] - ends[0]) / (2 * step)
    assert saturated().inductances()[0, 0] == pytest.approx(slope, rel=1e-5)
    assert slope < 0.95 * saturated().linkages[0] / CURRENT


@some
@given(st.floats(0.1, 20))
def test_field_grows_with_the_current(factor: float) -> None:
    """Catches a tolerance that is not relative: B in proportion to all currents, energy with their square."""
    one, other = solved(coils()), solved(coils(currents=(3.0 * factor, -factor)))
    at = np.array([(12.0, 4.0), (30.0, -20.0)])
    assert other.probe(at).flux_density == pytest.approx(factor * one.probe(at).flux_density, rel=1e-6, abs=1e-12)
    assert other.energies[0] == pytest.approx(factor**2 * one.energies[0], rel=1e-6)


@some
@given(st.floats(0.01, 100), st.booleans())
def test_field_falls_with_the_size(unit: float, axisymmetric: bool) -> None:
    """Catches an absolute length anywhere: at the same currents B goes as 1/size, L as size (planar: not at all)."""
    one = solved(coils(axisymmetric=axisymmetric))
    other = solved(coils(axisymmetric=axisymmetric, unit=unit))
    power = 1 if axisymmetric else 0
    assert other.linkages == pytest.approx(unit**power * one.linkages, rel=2e-3)
    at = np.array([(30.0, -20.0)])
    assert other.probe(at * unit).flux_density * unit == pytest.approx(one.probe(at).flux_density, rel=0.05, abs=1e-6)


@pytest.mark.parametrize("at", [(500.0, -300.0), (-30.0, 0.0)])
def test_planar_model_may_be_anywhere(at: tuple[float, float]) -> None:
    """Catches something that depends on where the origin is."""
    one, other = (solved(coils(axisymmetric=False, at=shift)) for shift in ((0.0, 0.0), at))
    assert other.linkages == pytest.approx(one.linkages, rel=2e-3)
    a, b = (solution.force(1).by_stress.force for solution in (one, other))
    assert np.hypot(*np.subtract(a, b)) < 0.02 * np.hypot(*a)


@pytest.mark.parametrize("axisymmetric", [True, False])
def test_mirror_image(axisymmetric: bool) -> None:
    """Catches a direction that is preferred: mirrored, linkages stay and the upward force turns round."""
    one, other = (solve_model(coils(axisymmetric=axisymmetric, mirrored=m), (1,), accuracy=2e-3) for m in (False, True))
    assert other.linkages == pytest.approx(one.linkages, rel=2e-3)
    a, b = (solution.force(1).by_stress.force for solution in (one, other))
    assert b == pytest.approx((a[0], -a[1]), rel=5e-3)


def test_turns_of_the_other_sign() -> None:
    """Catches |turns|: wound the other way a coil links minus as much, and repels what it attracted."""
    one, other = (solved(coils(currents=(3.0, 1.0), turns=(100, n))) for n in (40, -40))
    first, second = one.inductances(), other.inductances()
    assert second == pytest.approx(first * np.array([(1, -1), (-1, 1)]), rel=1e-9)


def test_densities_add_up_and_magnets_rest_at_zero() -> None:
    """Catches energies lost between elements, and a magnet's that is not zero at its remanence."""
    solution = solved(coils()).solution
    stored, co = energy_densities(solution.system, solution.psi)
    assert (stored.sum() * 2 * np.pi, co.sum() * 2 * np.pi) == pytest.approx(energies(solution))
    drawing = Drawing(False, depth=1000)
    drawing.rectangle((0, 10), (0, 10))
    drawing.label(5, 5, drawing.material("Magnet", mu=1.1, remanence=1.2), magnetisation=90)
    # Without any condition flux leaves both ends at right angles as between ideal poles: B is the remanence.
    closed = solve_model(drawing.model())
    assert closed.probe(np.array([(5.0, 5.0)])).flux_density[0] == pytest.approx((0.0, 1.2), abs=1e-7)
    assert abs(closed.energies[0]) < 1e-9 * 1.2**2 / (2 * 4e-7 * np.pi) * 1e-4  # of its volume, 100 mm² by 1 m
