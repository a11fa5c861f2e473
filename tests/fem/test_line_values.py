"""The field along lines and FEMM's line integrals, on fields that quadratic elements hold exactly."""

import csv
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path as File

import numpy as np
import pytest

sys.path.insert(0, str(File(__file__).parents[2] / "docs" / "validation"))

from cases.drawing import Drawing

from fluxbore.design.errors import SpecError
from fluxbore.fem.femm_model import Hole
from fluxbore.fem.femm_solution import FemmSolution, solve_model
from fluxbore.fem.line_text import parse_line
from fluxbore.fem.line_values import line_integrals, line_values
from fluxbore.fem.paths import Path

MU_0 = 4e-7 * np.pi
MM = 1e-3
B_X, B_Y, B_Z = 0.3, -0.2, 0.4
DEPTH = 0.05
J, HALF = 2e6, 2 * MM
"""Current density (A/m²) and half the thickness (m) of the sheet."""


@cache
def uniform() -> FemmSolution:
    """20 mm by 20 mm of air in a field B = (B_X, B_Y), 50 mm deep: A = B_X y − B_Y x."""
    drawing = Drawing(axisymmetric=False, depth=50.0)
    edge = drawing.boundary("far", a1=-B_Y * MM, a2=B_X * MM)
    drawing.rectangle((-10, 10), (-10, 10), edge)
    drawing.label(0, 0, drawing.material("air"))
    return solve_model(drawing.model())


@cache
def two_materials() -> FemmSolution:
    """B = (B_X, 0) through air on the left of x = 0 and something of μ_r = 4 on its right."""
    drawing = Drawing(axisymmetric=False, depth=50.0)
    edge = drawing.boundary("far", a2=B_X * MM)
    drawing.rectangle((-10, 10), (-10, 10), edge)
    drawing.line((0, -10), (0, 10))
    drawing.label(-5, 0, drawing.material("air"))
    drawing.label(5, 0, drawing.material("iron", 4.0))
    return solve_model(drawing.model())


@cache
def sheet() -> FemmSolution:
    """A sheet of current between x = ±HALF, between walls at x = ±10 mm with A = 0 and A = 2e-3 Wb/m: B = (0, B_y)."""
    drawing = Drawing(axisymmetric=False, depth=50.0)
    left, right = drawing.boundary("left"), drawing.boundary("right", a0=2e-3)
    drawing.line((-10, -10), (-10, 10), boundary=left)
    drawing.line((10, -10), (10, 10), boundary=right)
    for x in (-2, 2):
        drawing.line((x, -10), (x, 10))
    for y in (-10, 10):
        drawing.line((-10, y), (-2, y), (2, y), (10, y))
    air, copper = drawing.material("air"), drawing.material("copper", density=J)
    for x, material in ((-5, air), (0, copper), (5, air)):
        drawing.label(x, 0, material)
    return solve_model(drawing.model())


@cache
def ball() -> FemmSolution:
    """A ball of air in a field B_Z along its axis: A_φ = B_Z r/2 on its face."""
    drawing = Drawing(axisymmetric=True)
    drawing.half_disc(10, boundary=drawing.boundary("far", a1=B_Z / 2 * MM))
    drawing.label(3, 0, drawing.material("air"))
    return solve_model(drawing.model())


def test_a_table_of_a_uniform_field() -> None:
    """Catches components along the wrong direction, and a normal on the right."""
    path, count = parse_line("-5,-4:3,2:7", MM)
    columns = line_values(uniform(), path, count).columns()
    assert columns["distance (mm)"] == pytest.approx(np.linspace(0, 10, 7))
    x, y = columns["x (mm)"], columns["y (mm)"]
    assert x == pytest.approx(np.linspace(-5, 3, 7))
    assert columns["A (Wb/m)"] == pytest.approx((B_X * y - B_Y * x) * MM)
    tangent, normal = np.array([0.8, 0.6]), np.array([-0.6, 0.8])
    b = np.array([B_X, B_Y])
    for name, value in (
        ("B_x", B_X),
        ("B_y", B_Y),
        ("B_n", b @ normal),
        ("B_t", b @ tangent),
        ("|B|", np.hypot(*b)),
    ):
        assert columns[f"{name} (T)"] == pytest.approx(np.full(7, value), rel=1e-6)
        assert columns[f"{name.replace('B', 'H')} (A/m)"] == pytest.approx(np.full(7, value / MU_0), rel=1e-6)


def test_a_table_as_text() -> None:
    """Catches headings that are not the columns', and figures cut too short."""
    table = line_values(ball(), *parse_line("0,0:5,0:3", MM))
    rows = list(csv.reader(table.csv().splitlines()))
    assert rows[0][:5] == ["distance (mm)", "r (mm)", "z (mm)", "r A (Wb/rad)", "B_r (T)"]
    assert len(rows) == 4
    values = np.array([[float(word) for word in row] for row in rows[1:]])
    assert values == pytest.approx(np.column_stack(list(table.columns().values())), rel=1e-9, abs=1e-20)
    assert values[:, 3] == pytest.approx(B_Z * (values[:, 1] * MM) ** 2 / 2, abs=1e-15)
    assert values[0, 4] == 0


@pytest.mark.parametrize(("line", "relative"), [("0,-5:0,5:9", 1.0), ("0,5:0,-5:9", 4.0)])
def test_an_interface_is_seen_from_its_left(line: str, relative: float) -> None:
    """Catches a side that is left to chance where the path runs along an interface."""
    columns = line_values(two_materials(), *parse_line(line, MM)).columns()
    assert columns["B_x (T)"] == pytest.approx(np.full(9, B_X), rel=1e-6)
    assert columns["H_x (A/m)"] == pytest.approx(np.full(9, B_X / MU_0 / relative), rel=1e-6)


@pytest.mark.parametrize("line", ["-10,-10:10,-10", "10,-10:-10,-10", "-10,10:-10,-10", "-10,-10:-10,10"])
def test_the_rim_of_the_model_belongs_to_it(line: str) -> None:
    """Catches a path along the rim that is lost on its outer side."""
    values = line_values(uniform(), *parse_line(line, MM)).columns()
    assert values["B_x (T)"] == pytest.approx(B_X, rel=1e-6)


def test_an_arc_of_the_rim_belongs_to_the_model() -> None:
    """Catches places between an arc and the parabolas that stand for it."""
    path = Path.through([(0, -10 * MM), (0, 10 * MM)], [np.pi])
    assert line_values(ball(), path, 500).columns()["B_z (T)"] == pytest.approx(B_Z, rel=1e-5)


def test_integrals_across_a_uniform_field() -> None:
    """Catches a flux of the wrong sign, a missing depth, and an average over the wrong size."""
    path, _ = parse_line("-5,-4:3,2", MM)
    found = line_integrals(uniform(), path)
    b_n, b_t = -0.6 * B_X + 0.8 * B_Y, 0.8 * B_X + 0.6 * B_Y
    assert (found.length, found.surface) == pytest.approx((10 * MM, 10 * MM * DEPTH))
    assert found.flux == pytest.approx(b_n * 10 * MM * DEPTH, rel=1e-6)
    assert found.mean_flux_density == pytest.approx(b_n, rel=1e-6)
    assert found.mmf == pytest.approx(b_t / MU_0 * 10 * MM, rel=1e-6)
    assert found.mean_tangential_field == pytest.approx(b_t / MU_0, rel=1e-6)
    assert found.squared == pytest.approx(b_n**2 * 10 * MM, rel=1e-6)
    assert found.mean_squared == pytest.approx(b_n**2, rel=1e-6)


def test_the_flux_through_a_curved_line_is_that_through_its_chord() -> None:
    """Catches an arc that is taken for another: its flux is the chord's, its length is not."""
    path, _ = parse_line("-4,0:4,0@180", MM)
    found = line_integrals(uniform(), path)
    assert found.flux == pytest.approx(B_Y * 8 * MM * DEPTH, rel=1e-6)
    assert found.length == pytest.approx(4 * np.pi * MM)
    assert found.mmf == pytest.approx(B_X / MU_0 * 8 * MM, rel=1e-6)


def test_a_path_around_a_current() -> None:
    """Catches a stress tensor's sign or share: mmf is the current, the force J × B, the torque its moment."""
    path, _ = parse_line("-5,-4:-5,6:5,6:5,-4:-5,-4", MM)
    found = line_integrals(sheet(), path)
    current = J * 2 * HALF * 10 * MM
    assert found.mmf == pytest.approx(-current, rel=1e-5)  # clockwise, current out of the page
    # In the middle of the sheet B_y is its mean: the walls' −ΔA over their distance, by symmetry.
    force = -current * (-2e-3 / (20 * MM)) * DEPTH
    assert found.force == pytest.approx((force, 0.0), rel=1e-5, abs=1e-5 * force)
    assert found.torque == pytest.approx(-force * 1 * MM, rel=1e-5)
    assert found.flux == pytest.approx(0.0, abs=1e-10)


def test_round_the_axis() -> None:
    """Catches a surface of revolution, or the flux through it, without its 2π r."""
    path, _ = parse_line("0,2:5,2", MM)
    found = line_integrals(ball(), path)
    disc = np.pi * (5 * MM) ** 2
    assert found.surface == pytest.approx(disc)
    assert found.flux == pytest.approx(B_Z * disc, rel=1e-6)
    assert found.mean_flux_density == pytest.approx(B_Z, rel=1e-6)
    assert found.force == pytest.approx((0.0, B_Z**2 / (2 * MU_0) * disc), rel=1e-5)
    assert found.torque == 0.0


def test_along_the_axis() -> None:
    """Catches a division by the surface of a line."""
    found = line_integrals(ball(), parse_line("0,-5:0,5", MM)[0])
    assert (found.surface, found.mean_flux_density) == (0.0, 0.0)
    assert found.mmf == pytest.approx(B_Z / MU_0 * 10 * MM, rel=1e-6)


def test_a_line_that_leaves_the_model() -> None:
    """Catches values from nowhere."""
    path, count = parse_line("0,0:12,0", MM)
    with pytest.raises(SpecError, match=r"inside the model; it leaves it at \(1[01].*, 0\) mm"):
        line_values(uniform(), path, count)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "1,2",
        "1,2:3",
        "1,2:1,2",
        "1,2:a,3",
        "1,2:nan,3",
        "0,0@90:1,1",
        "0,0:1,1:1",
        "0,0:1,1:99999999",
        "0,0:1,1@360",
        "0,0,0:1,1",
        "1,2:3,4:-5",
        "0,0:1,1@x",
        "0,0:1e300,1",
    ],
)
def test_what_is_no_line(text: str) -> None:
    """Catches a traceback, or a sentence that does not quote what was written."""
    with pytest.raises(SpecError, match="--line must be") as caught:
        parse_line(text, MM)
    assert "\n" not in str(caught.value)


def test_a_line_across_a_pinhole() -> None:
    """Catches values from a hole that is small beside the model."""
    drawing = Drawing(axisymmetric=False)
    inner, outer = drawing.boundary("inner", a0=0.01), drawing.boundary("outer")
    drawing.circle(0, 0, 1000, outer, outer)
    drawing.circle(0, 0, 0.5, inner, inner)
    drawing.label(100, 0, drawing.material("air"))
    found = solve_model(replace(drawing.model(), holes=(Hole(0, 0),)), accuracy=0.5)
    assert np.all(np.isfinite(line_values(found, *parse_line("-4,-0.5:4,-0.5:5", MM)).field.potential)), "touches it"
    with pytest.raises(SpecError, match=r"leaves it at \(0, 0.2\)"):
        line_values(found, *parse_line("-4,0.2:4,0.2:5", MM))
