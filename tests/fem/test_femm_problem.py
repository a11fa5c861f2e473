"""What a FEMM file means: lengths, conditions, materials, magnets, circuits and current densities."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases.drawing import MU_0, Drawing
from manufactured import solved_levels

from fluxbore.design.errors import FluxboreError, SpecError
from fluxbore.fem.conditions import Mixed, Prescribed
from fluxbore.fem.femm_model import FemmModel, Node, PointProperty, Segment
from fluxbore.fem.femm_problem import drawing
from fluxbore.fem.femm_solution import solve_model
from fluxbore.fem.problem import Problem


def bars(series: bool, conductivities: tuple[float, float], turns: tuple[float, float], axisymmetric: bool) -> Drawing:
    """Two bars, 2 by 10 and 4 by 10 mm, in one circuit of 6 A."""
    found = Drawing(axisymmetric, depth=50)
    wall = found.boundary("A=0")
    found.rectangle((0, 30), (-20, 20), wall)
    circuit = found.circuit("bars", 6.0, series)
    for x, conductivity, count in zip(((10, 12), (20, 24)), conductivities, turns, strict=True):
        found.rectangle(x, (0, 10))
        material = found.material(f"bar at {x[0]}", conductivity=conductivity)
        found.label(sum(x) / 2, 5, material, circuit, count)
    found.label(5, -10, found.material("Air"))
    return found


def problem(model: FemmModel) -> Problem:
    return solved_levels(model, 1)[0].problem


def test_series_of_windings() -> None:
    """Catches turns per area of the wrong block: 100 and −40 turns."""
    found = problem(bars(True, (0, 0), (100, -40), False).model()).circuits[0]
    assert [c.density for c in found.conductors] == pytest.approx([100 / 20e-6, -40 / 40e-6], rel=1e-6)
    assert found.current == 6.0


def test_parallel_shares_by_conductance() -> None:
    """Catches a current shared by area alone: 50 and 10 MS/m over 20 and 40 mm²."""
    found = problem(bars(False, (50e6, 10e6), (1, 1), False).model()).circuits[0]
    shares = [c.density * area for c, area in zip(found.conductors, (20e-6, 40e-6), strict=True)]
    assert shares == pytest.approx([5 / 7, 2 / 7], rel=1e-6)


def test_parallel_without_conductivity_shares_by_area() -> None:
    """Catches a division by nothing: one density where nothing conducts."""
    found = problem(bars(False, (0, 0), (1, 1), False).model()).circuits[0]
    assert [c.density for c in found.conductors] == pytest.approx([1 / 60e-6] * 2, rel=1e-6)


def test_solid_rings_carry_current_by_radius() -> None:
    """Catches an even current in a solid ring: J goes as 1/r, and adds up to the turns."""
    found = problem(bars(True, (50e6, 50e6), (1, 1), True).model()).circuits[0]
    assert all(c.by_radius for c in found.conductors)
    expected = [1 / (0.01 * np.log(12 / 10)), 1 / (0.01 * np.log(24 / 20))]
    assert [c.density for c in found.conductors] == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("axisymmetric", [False, True])
def test_load_of_a_circuit_adds_up_to_its_turns(axisymmetric: bool) -> None:
    """Catches lost ampere-turns, in windings and in solid conductors."""
    for conductivity in (0.0, 50e6):
        found = problem(bars(True, (conductivity,) * 2, (1, -1), axisymmetric).model())
        assert abs(found.circuits[0].density.sum()) < 1e-9
        found = problem(bars(True, (conductivity,) * 2, (1, 1), axisymmetric).model())
        assert found.circuits[0].density.sum() == pytest.approx(2, rel=1e-9)


def one(axisymmetric: bool = False) -> Drawing:
    """A box of 10 mm."""
    found = Drawing(axisymmetric)
    found.rectangle((0, 10), (0, 10), found.boundary("A=0"))
    return found


def test_lengths_and_depth() -> None:
    """Catches a unit that is forgotten: inches, with a depth in the file's unit."""
    found = replace(one().model(), unit="inches", depth=3.0)
    drawn = drawing(found).outline
    assert drawn.points.max() == pytest.approx(0.254)
    assert drawn.unit == 0.0254


@pytest.mark.parametrize("r, size, expected", [(1e-7, 10, 0), (1e-4, 10, 1e-4), (5e-7, 1e-4, 5e-7), (1e-14, 1e-4, 0)])
def test_the_axis_is_a_millionth_of_a_unit_wide(r: float, size: float, expected: float) -> None:
    """Catches a hole of nothing along the axis, by which a coil links 24 % more, and one that is meant filled in."""
    made = Drawing(True)
    made.nodes += [Node(r, 0), Node(size, 0), Node(size, size), Node(r, size)]
    made.segments += [Segment(k, (k + 1) % 4) for k in range(4)]
    points = drawing(made.model()).outline.points
    assert points[[0, 3], 0] == pytest.approx([expected * 1e-3] * 2, rel=1e-12)


def test_conditions() -> None:
    """Catches A0 + A1 x + A2 y in metres, a phase left out, and a mixed condition's numbers swapped."""
    made = one()
    made.boundary("sloped", a0=1.0, a1=2.0, a2=3.0)
    made.boundary("mixed", "mixed", c0=4.0, c1=5.0)
    model = made.model()
    rules = drawing(model).conditions.curves
    at = np.array([(0.002, 0.005)])
    assert isinstance(rules[1], Prescribed)
    assert rules[1].potential(at) == pytest.approx([1 + 2 * 2 + 3 * 5])
    assert rules[2] == Mixed(4.0, 5.0)
    polar = replace(model, polar=True, boundaries=(replace(model.boundaries[1], phase=60.0),))
    rule = drawing(replace(polar, segments=())).conditions.curves[0]
    assert isinstance(rule, Prescribed)
    assert rule.potential(np.array([(0.0, 0.004)])) == pytest.approx([(1 + 2 * 4 + 3 * 90) / 2])


@pytest.mark.parametrize("direction, expected", [(0.0, (1, 0)), (90.0, (0, 1)), (180.0, (-1, 0)), (-90.0, (0, -1))])
def test_quarter_turns_are_exact(direction: float, expected: tuple[float, float]) -> None:
    """Catches 1e-16 of a magnet leaking along the axis."""
    made = one()
    made.label(5, 5, made.material("Magnet", remanence=1.2), magnetisation=direction)
    material = problem(made.model()).materials[0]
    assert material.coercivity == (1.2 / MU_0 * expected[0], 1.2 / MU_0 * expected[1])


def test_formula_of_a_magnet_is_in_the_file_s_unit() -> None:
    """Catches metres in a formula: 9 x degrees at x = 5 mm."""
    made = one()
    made.label(5, 5, made.material("Magnet", remanence=1.2), magnetisation="9*x")
    coercivity = problem(made.model()).materials[0].coercivity
    assert callable(coercivity)
    found = coercivity(np.array([(0.005, 0.001)]))[0]
    assert found == pytest.approx(1.2 / MU_0 * np.array([np.cos(np.pi / 4), np.sin(np.pi / 4)]))


@pytest.mark.parametrize("lamination, mu", [("in plane", (90.1, 90.1)), ("parallel to x", (90.1, 9.174)),
                                            ("parallel to y", (9.174, 90.1))])  # fmt: skip
def test_linear_sheets(lamination: str, mu: tuple[float, float]) -> None:
    """Catches along and across swapped: μ_r = 100, filled to 90 %."""
    made = one()
    assert lamination in ("in plane", "parallel to x", "parallel to y")
    made.label(5, 5, made.material("Sheets", 100.0, lamination=lamination, fill=0.9))  # type: ignore[arg-type]
    found = problem(made.model()).materials[0].components
    assert found == pytest.approx((1 / (MU_0 * mu[0]), 1 / (MU_0 * mu[1])), rel=1e-3)


def test_point_current_and_point_potential() -> None:
    """Catches a point current lost or prescribed: 7 A, and A = 0.5 at another point."""
    made = Drawing(False)
    made.rectangle((0, 10), (0, 10))
    made.point(4, 5, PointProperty("wire", None, 7.0))
    made.point(0, 0, PointProperty("zero", 0.5))
    made.label(2, 2, made.material("Air"))
    found = problem(made.model())
    assert sum(item.density.sum() for item in found.sources) == pytest.approx(7.0)
    assert found.prescribed is not None
    fixed = found.mesh.topology.freedom < 0
    assert np.count_nonzero(fixed) == 1
    assert found.prescribed[fixed] == pytest.approx([0.5])


def test_block_current_density() -> None:
    """Catches MA/m² taken for A/m²: 2 MA/m² over a square centimetre."""
    made = one()
    made.label(5, 5, made.material("Copper", density=2e6))
    found = problem(made.model())
    assert sum(item.density.sum() for item in found.sources) == pytest.approx(200.0)


def refused(model: FemmModel, pattern: str) -> None:
    with pytest.raises(FluxboreError, match=pattern) as caught:
        solve_model(model)
    assert "\n" not in str(caught.value)


def test_refusals_say_what_and_where() -> None:
    """Catches a traceback: labels without a material, exteriors without a place, groups that are none."""
    made = one()
    made.label(5, 5, made.material("Air"), external=True)
    model = made.model()
    refused(replace(model, labels=(replace(model.labels[0], material=None),)), r"\(5, 5\)")
    refused(replace(model, axisymmetric=True), r"extZo")
    with pytest.raises(SpecError, match=r"--group.*got 9"):
        solve_model(model, groups=(9,))


def test_a_negative_c0_is_refused_where_a_line_uses_it() -> None:
    """Catches another problem's answer: with c0 < 0 the field gives out energy without end."""
    made = one()
    made.label(5, 5, made.material("Copper", density=1e6))
    unused = made.boundary("open", "mixed", c0=-1e6)
    assert solve_model(made.model()).solution.convergence.converged
    made.segments[0] = replace(made.segments[0], boundary=unused)
    refused(made.model(), r'c0 of boundary "open" must not be negative; got -1e\+06\.')


@pytest.mark.parametrize("count", [1, 3])
def test_periodic_conditions_come_in_pairs(count: int) -> None:
    """Catches a third side tied to two, or a single one to nothing."""
    made = Drawing(False)
    side = made.boundary("sides", "periodic")
    corners = [(0, 0), (10, 0), (10, 10), (0, 10), (0, 0)]
    for k in range(4):
        made.line(corners[k], corners[k + 1], boundary=side if k < count else None)
    made.label(5, 5, made.material("Air"))
    refused(made.model(), f"{count} segments")
