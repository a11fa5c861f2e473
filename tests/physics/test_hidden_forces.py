"""Forces where a body is hard to go round: along a periodic seam, around a coil, against iron, beside a filament."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases.drawing import Drawing, open_disc

from fluxbore.fem.femm_model import FemmModel, PointProperty
from fluxbore.fem.femm_open import with_open_boundary
from fluxbore.fem.femm_solution import solve_model

MU_0 = 4e-7 * np.pi


def boxed(mu: float, iron: tuple[tuple[float, float], tuple[float, float]], hollow: bool = False) -> Drawing:
    """Iron of group 1 in a box of air without flux through its sides, 1 m deep; hollow: 5 mm of wall."""
    drawing = Drawing(False, depth=1000.0)
    air, steel = drawing.material("Air"), drawing.material("Steel", mu=mu)
    drawing.circuit("c", 1000.0)
    drawing.rectangle((-60, 60), (-60, 60), boundary=drawing.boundary("far"))
    drawing.rectangle(*iron)
    drawing.label(-50, 50, air)
    drawing.label(iron[0][0] + 2, iron[1][0] + 2, steel, group=1)
    if hollow:
        drawing.rectangle((-15, 15), (-15, 15))
        drawing.label(10, 10, air)
    return drawing


def coil(drawing: Drawing, x: tuple[float, float], y: tuple[float, float], turns: float, group: int) -> None:
    drawing.rectangle(x, y)
    drawing.label(sum(x) / 2, sum(y) / 2, 0, circuit=0, turns=turns, group=group)


def seam(left: float) -> FemmModel:
    """A row of magnets over iron bars, 20 mm apart, cut at x = left."""
    drawing = Drawing(False, depth=1000.0)
    air, steel = drawing.material("Air"), drawing.material("Steel", mu=1000.0)
    magnet = drawing.material("Magnet", mu=1.05, remanence=1.0)
    sides = [drawing.boundary(f"side {k}", "periodic") for k in range(5)]
    far = drawing.boundary("far")
    for y in (-30, 40):
        drawing.line((left, y), (left + 20, y), boundary=far)

    def bar(x: tuple[float, float], y: tuple[float, float], material: int, group: int) -> None:
        for shift in (-20, 0, 20):
            low, high = max(x[0] + shift, left), min(x[1] + shift, left + 20)
            if high > low:
                drawing.rectangle((low, high), y)
                drawing.label((low + high) / 2, sum(y) / 2, material, group=group, magnetisation=90.0)

    bar((-5, 5), (0, 5), magnet, 1)
    bar((-3, 7), (8, 12), steel, 2)
    heights = (-30, 0, 5, 8, 12, 40)
    for k, side in enumerate(sides):
        for x in (left, left + 20):
            drawing.line((x, heights[k]), (x, heights[k + 1]), boundary=side)
    drawing.label(left + 0.5, -20, air)
    return drawing.model()


def test_where_a_periodic_drawing_is_cut_does_not_matter() -> None:
    """Catches a weight that is one on a body and zero on its own continuation beyond the seam: 15 times the force."""
    forces = [solve_model(seam(left), (1, 2)).force(1).value.force for left in (-10.0, -5.0)]
    assert np.hypot(*(np.array(forces[0]) - forces[1])) < 2e-3 * np.hypot(*forces[0])


@pytest.mark.full
def test_iron_around_a_coil() -> None:
    """Catches currents forgotten where the weight on them is one all over: pot and coil push each other apart."""
    drawing = boxed(100.0, ((-20, 20), (-20, 20)), hollow=True)
    coil(drawing, (-12, -4), (-4, 4), 1, 2)
    coil(drawing, (35, 40), (-5, 5), -1, 3)
    solution = solve_model(drawing.model(), (1, 2, 3))
    pot, inner, outer = (np.array(solution.force(group).value.force) for group in (1, 2, 3))
    assert solution.force(1).error < 1e-2 * abs(pot[0])
    assert np.sign(pot[0]) == -np.sign(inner[0])
    assert abs(outer[0]) < 0.2 * abs(pot[0])


def test_coil_on_iron() -> None:
    """Catches a stress read in the iron that a coil lies on: the force on its currents is J × B."""
    drawing = boxed(1000.0, ((-30, 30), (-20, 0)))
    coil(drawing, (-5, 5), (0, 5), 1, 2)
    solution = solve_model(drawing.model(), (2,))
    found = solution.force(2)
    assert found.touches
    assert found.defined
    assert found.value is found.lorentz
    assert found.error < 1e-3 * abs(found.value.force[1])
    assert not solution.force(1).defined or solution.force(1).touches == ()


def test_copper_is_air() -> None:
    """Catches a hundred-thousandth off vacuum taken for a magnetic body."""
    drawing = boxed(1000.0, ((-30, 30), (-20, 0)))
    coil(drawing, (-5, 5), (2, 7), 1, 2)
    model = drawing.model()
    nearly = replace(model, materials=(replace(model.materials[0], mu_x=0.99999, mu_y=0.99999), *model.materials[1:]))
    plain, copper = (solve_model(each, (1,)).force(1).value.force[1] for each in (model, nearly))
    assert copper == pytest.approx(plain, rel=2e-3)
    assert plain > 10


def test_iron_beside_filaments() -> None:
    """Catches the stress beside a line current, which grows without bound: against the images in the cylinder."""
    drawing = Drawing(False, depth=1000.0)
    air, steel = drawing.material("Air"), drawing.material("Steel", mu=1000.0)
    radius, wires = 0.01, ((0.018, 1000.0), (-0.04, -1000.0))
    drawing.circle(0, 0, 10)
    open_disc(drawing, 60)
    for x, current in wires:
        drawing.point(x * 1e3, 0, PointProperty(f"{current:g} A", None, current))
    drawing.label(0, 0, steel, group=1)
    drawing.label(0, 30, air)
    share = 999 / 1001
    exact = 0.0
    for x, current in wires:
        for other, source in wires:
            for at, image in ((radius**2 / other, share * source), (0.0, -share * source)):
                exact += MU_0 * current * image / (2 * np.pi) / (x - at)
    found = solve_model(with_open_boundary(drawing.model()), (1,)).force(1)
    assert found.value.force[0] == pytest.approx(exact, rel=2e-3)
    assert found.error < 1e-3 * exact
