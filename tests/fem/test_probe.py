"""A, B and H at points: exact in uniform fields, H by each material's own law, refusals in one sentence."""

import sys
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases import slabs
from cases.drawing import MU_0, Drawing

from fluxbore.design.errors import SpecError
from fluxbore.fem.femm_model import Hole
from fluxbore.fem.femm_solution import FemmSolution, solve_model

B0 = 0.8


@cache
def uniform(axisymmetric: bool) -> FemmSolution:
    """B0 along y or z in a box of 20 mm."""
    drawing = Drawing(axisymmetric)
    rim = drawing.boundary("rim", a0=B0 * 0.02 / 2) if axisymmetric else drawing.boundary("rim", a1=-B0 * 1e-3)
    drawing.rectangle((0, 20), (0, 20))
    for x in (20,) if axisymmetric else (0, 20):
        drawing.line((x, 0), (x, 20), boundary=rim)
    drawing.label(10, 10, drawing.material("Air"))
    return solve_model(drawing.model())


@pytest.mark.parametrize("axisymmetric", [False, True])
def test_uniform_field(axisymmetric: bool) -> None:
    """Catches components swapped, A for r A, and points on the axis, on a rim or in a corner that are not found."""
    points = np.array([(0.0, 10.0), (5.0, 3.0), (20.0, 7.0), (0.0, 0.0)])
    found = uniform(axisymmetric).probe(points)
    assert found.flux_density == pytest.approx(np.tile((0.0, B0), (4, 1)), abs=1e-7)
    assert found.field_strength == pytest.approx(np.tile((0.0, B0 / MU_0), (4, 1)), abs=0.1)
    x = points[:, 0] * 1e-3
    assert found.potential == pytest.approx(B0 * x**2 / 2 if axisymmetric else -B0 * x, abs=1e-10)
    assert np.all(found.region == 0)


def test_no_radial_field_on_the_axis() -> None:
    """Catches rounding where symmetry says nothing."""
    assert uniform(True).probe(np.array([(0.0, 4.0)])).flux_density[0, 0] == 0.0


def test_field_strength_is_the_same_in_all_strips() -> None:
    """Catches H by the wrong law: sheets along and across, two permeabilities, steel and stacked steel in one H."""
    found = solve_model(slabs.laminated_strips().model).probe(np.array([(5.0 * k + 2.5, 4.0) for k in range(6)]))
    assert found.field_strength[:, 1] == pytest.approx(4000.0, rel=3e-3)
    assert np.abs(found.field_strength[:, 0]).max() < 1.0
    assert found.region.tolist() == [2, 3, 4, 5, 6, 7]


def test_field_strength_in_a_magnet() -> None:
    """Catches H = νB in a magnet: closed on itself without iron, B is the remanence and H nothing."""
    drawing = Drawing(False)
    drawing.rectangle((0, 10), (0, 10))
    drawing.label(5, 5, drawing.material("Magnet", mu=1.05, remanence=1.2), magnetisation=90)
    found = solve_model(drawing.model()).probe(np.array([(5.0, 5.0)]))
    assert found.flux_density[0] == pytest.approx((0.0, 1.2), abs=1e-6)
    assert np.hypot(*found.field_strength[0]) < 1e-6 * 1.2 / MU_0


def test_point_outside() -> None:
    """Catches a value from nowhere."""
    with pytest.raises(SpecError, match=r"inside"):
        uniform(False).probe(np.array([(10.0, 10.0), (30.0, 10.0)]))


@cache
def around_a_pinhole() -> FemmSolution:
    """A disc of a metre in radius with a hole of half a millimetre."""
    drawing = Drawing(False)
    inner, outer = drawing.boundary("inner", a0=0.01), drawing.boundary("outer")
    drawing.circle(0, 0, 1000, outer, outer)
    drawing.circle(0, 0, 0.5, inner, inner)
    drawing.label(100, 0, drawing.material("Air"))
    return solve_model(replace(drawing.model(), holes=(Hole(0, 0),)), accuracy=0.5)


@pytest.mark.parametrize("x, y", [(0.0, 0.0), (0.1, 0.1), (0.0, 0.45), (1020.0, 0.0)])
def test_point_in_a_hole_smaller_than_the_reach(x: float, y: float) -> None:
    """Catches a field in nothing: 0.5 mm is less than a thousandth of the model, but four sides of its elements."""
    with pytest.raises(SpecError, match=r"inside"):
        around_a_pinhole().probe(np.array([(x, y)]))
    with pytest.raises(SpecError, match=r"--point must lie inside"):
        solve_model(around_a_pinhole().model, points=((x, y),))


@pytest.mark.parametrize("axisymmetric, centre", [(False, 0.0), (True, 0.0), (True, 100.5)])
def test_points_on_arcs(axisymmetric: bool, centre: float) -> None:
    """Catches a rim refused where the elements are a little inside it: circles, a ball, and a ring beside the axis."""
    drawing = Drawing(axisymmetric)
    if axisymmetric and not centre:
        drawing.half_disc(100)
    else:
        drawing.circle(centre, 0, 100)
    drawing.label(centre + 1, 0, drawing.material("Air"))
    turn = np.pi if axisymmetric and not centre else 2 * np.pi
    angle = np.linspace(0, turn, 501) - np.pi / 2
    r = centre + 100 * np.cos(angle)
    rim = np.column_stack((np.maximum(r, 0) if axisymmetric else r, 100 * np.sin(angle)))
    found = solve_model(drawing.model(), accuracy=0.5).probe(rim)
    assert np.all(found.region == 0)
