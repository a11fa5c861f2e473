"""The lip's closed form against finite elements of the whole cone, its limits, and which way things go."""

import math
from dataclasses import replace

import numpy as np
import pytest
import solid_cone
from conical_shell import ConicalShell
from hypothesis import given, settings
from hypothesis import strategies as st

from fluxbore.design.lip import STEEPEST, THICKEST, Lip, in_range, response

MM = 1e-3

PROTOTYPE = Lip(16.1 * MM, 16.3 * MM, 15.4 * MM, 1.8 * MM, 0.3 * MM, 0.5906e9, 0.46)

SHAPES = {
    "prototype": PROTOTYPE,
    "slender": replace(PROTOTYPE, length=4 * MM, thickness=0.2 * MM),
    "thick": replace(PROTOTYPE, thickness=0.7 * MM, length=3 * MM),
    "steep": replace(PROTOTYPE, length=1.3 * MM, poisson_ratio=0.35),
    "short": replace(PROTOTYPE, length=1.2 * MM, inner_diameter=15.6 * MM),
    "large bore": Lip(40 * MM, 40.6 * MM, 38.5 * MM, 4 * MM, 0.5 * MM, 3.1e9, 0.35),
}


@pytest.mark.parametrize("shape", SHAPES)
def test_forces_are_the_whole_cones(shape: str) -> None:
    """Catches a wrong foundation, a lost cosine, a load of the wrong sign: both parts of the force within 3.5 %."""
    lip = SHAPES[shape]
    assert in_range(lip)
    assert ConicalShell(lip, 0.1 * MM, 0.0).force == pytest.approx(response(lip).stiffness * 0.1 * MM, rel=0.035)
    assert ConicalShell(lip, 0.0, 1e6).force == pytest.approx(response(lip).pressure_area * 1e6, rel=0.035)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize(("interference", "pressure"), [(0.1 * MM, 0.0), (0.15 * MM, 0.6e6), (0.0, 0.6e6)])
def test_stresses_are_the_whole_cones(shape: str, interference: float, pressure: float) -> None:
    lip = SHAPES[shape]
    assert ConicalShell(lip, interference, pressure).stress() == pytest.approx(
        response(lip).stress(interference, pressure), rel=0.075
    )


@pytest.mark.parametrize("shape", SHAPES)
def test_forces_are_those_of_a_solid_wall(shape: str) -> None:
    """Catches what a thin shell leaves out in both the closed form and the shell's elements: shear, thickness. At the
    end's outer edge the bore meets a wall that turns; that much the closed form does not know."""
    lip = SHAPES[shape]
    found = response(lip)
    assert found.stiffness == pytest.approx(solid_cone.contact_force(lip, 0.1 * MM, 0.0) / (0.1 * MM), rel=0.035)
    assert found.pressure_area == pytest.approx(solid_cone.contact_force(lip, 0.0, 1e6) / 1e6, rel=0.03)
    at_the_edge = solid_cone.contact_force(lip, 0.1 * MM, 0.0, edge=True) / (0.1 * MM)
    assert found.stiffness == pytest.approx(at_the_edge, rel=0.095)


def test_a_long_cylinder_pushed_in_at_its_end() -> None:
    """Q = 2 beta^3 D w and the root does not know of it: the limit of both textbooks."""
    tube = replace(PROTOTYPE, inner_diameter=PROTOTYPE.outer_diameter, length=60 * MM)
    beta = (3 * (1 - 0.46**2)) ** 0.25 / math.sqrt(tube.radius * tube.thickness)
    assert tube.decay == pytest.approx(beta, rel=1e-12)
    expected = 2 * beta**3 * tube.bending_stiffness * math.pi * tube.bore
    assert response(tube).stiffness == pytest.approx(expected, rel=1e-9)


def test_a_short_lip_is_a_cantilever() -> None:
    """Too short for its hoops to matter: 3 D/L^3 at the tip, and three eighths of the pressure's load."""
    beam = replace(PROTOTYPE, inner_diameter=PROTOTYPE.outer_diameter, length=0.05 * MM)
    around = math.pi * beam.bore
    assert response(beam).stiffness == pytest.approx(3 * beam.bending_stiffness / beam.length**3 * around, rel=1e-4)
    assert response(beam).pressure_area == pytest.approx(3 / 8 * beam.length * around, rel=1e-4)
    root = 6 / beam.thickness**2 * beam.length**2 / 8
    assert response(beam).stress(0.0, 1e6) == pytest.approx(root * math.sqrt(1 - 0.46 + 0.46**2) * 1e6, rel=1e-3)


def test_without_pressure_the_hoop_at_the_tip_is_the_strain() -> None:
    """The tip is free to bend, so its stress is E delta / r alone; and it is the largest of the prototype."""
    expected = PROTOTYPE.young_modulus * 0.1 * MM / (PROTOTYPE.outer_diameter / 2)
    assert response(PROTOTYPE).stress(0.1 * MM, 0.0) == pytest.approx(expected, rel=1e-9)


def test_more_stations_find_no_larger_stress(monkeypatch: pytest.MonkeyPatch) -> None:
    coarse = response(PROTOTYPE).stress(0.1 * MM, 0.6e6)
    monkeypatch.setattr("fluxbore.design.lip.STATIONS", 2001)
    assert response(PROTOTYPE).stress(0.1 * MM, 0.6e6) == pytest.approx(coarse, rel=2e-3)


def test_the_worst_stress_stands_in_a_corner() -> None:
    """Catches a case left out: an unpressed lip bends the other way at its root."""
    worst = response(PROTOTYPE).worst_stress((0.05 * MM, 0.15 * MM), 0.6e6)
    inside = [
        response(PROTOTYPE).stress(delta * MM, p)
        for delta in np.linspace(0.05, 0.15, 5)
        for p in np.linspace(0, 6e5, 5)
    ]
    assert worst == pytest.approx(max(inside))


@settings(max_examples=50, deadline=None)
@given(
    length=st.floats(0.8, 5.0),
    wall=st.floats(0.1, 0.7),
    taper=st.floats(0.25, 0.5),
    delta=st.floats(0.01, 0.2),
    more=st.floats(1.01, 2.0),
)
def test_more_interference_wall_modulus_or_pressure_press_harder(
    length: float, wall: float, taper: float, delta: float, more: float
) -> None:
    lip = replace(PROTOTYPE, length=length * MM, thickness=wall * MM, inner_diameter=(16.3 - 2 * taper) * MM)
    force = response(lip).contact_force(delta * MM, 0.3e6)
    assert 0 < force < response(lip).contact_force(more * delta * MM, 0.3e6)
    assert force < response(lip).contact_force(delta * MM, more * 0.3e6)
    assert response(lip).stiffness < response(replace(lip, thickness=more * lip.thickness)).stiffness
    stiffer = replace(lip, young_modulus=more * lip.young_modulus)
    assert response(stiffer).stiffness == pytest.approx(more * response(lip).stiffness)
    assert response(stiffer).pressure_area == pytest.approx(response(lip).pressure_area)


def test_the_range_ends_where_it_says() -> None:
    thick = replace(PROTOTYPE, thickness=THICKEST * PROTOTYPE.radius)
    assert not in_range(thick)
    assert in_range(replace(thick, thickness=thick.thickness * 0.999))
    steep = replace(PROTOTYPE, length=0.45 * MM / math.tan(STEEPEST))
    assert not in_range(replace(steep, length=steep.length * 0.999))
    assert in_range(replace(steep, length=steep.length * 1.001))


def test_the_prototypes_lip_touches_at_its_tip_alone_until_it_bulges() -> None:
    assert not response(PROTOTYPE).touches(0.15 * MM, 0.6e6)
    assert response(PROTOTYPE).touches(0.15 * MM, 6e6)


@given(length=st.floats(1e-3, 1e3), wall=st.floats(1e-3, 1e1))
def test_any_proportions_give_numbers(length: float, wall: float) -> None:
    """Catches the overflow of hyperbolic functions in a long lip."""
    lip = replace(PROTOTYPE, length=length * MM, thickness=wall * MM)
    assert math.isfinite(response(lip).stiffness)
    assert math.isfinite(response(lip).stress(0.1 * MM, 0.6e6))
