"""Centres and inertia tensors: against the CAD kernel's, closed forms, and what must hold of any body."""

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fluxbore.actuators import STROKE_PLACES, assembly_of
from fluxbore.design import graphics
from fluxbore.design.spec import load
from fluxbore.geometry import unrolled
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.helix import arc, band
from fluxbore.geometry.inertia import combined, inertia, of_mass
from fluxbore.geometry.mass import inertia_of, part_masses
from fluxbore.geometry.outline import rectangle
from fluxbore.geometry.part import AxialHole, Body, Hole, Part, volume
from fluxbore.geometry.step_products import own_frame

EXAMPLES = Path(__file__).parents[2] / "examples"
GREY = (0.5, 0.5, 0.5)


def turned(profile: tuple[tuple[float, float], ...], **rest: object) -> Part:
    return Part("p", "p", "mover", "steel", GREY, profile, **rest)  # type: ignore[arg-type]


def helical(outline: unrolled.Outline, inner: float = 0.02, outer: float = 0.025) -> HelicalPart:
    return HelicalPart("h", "h", "mover", "steel", GREY, inner, outer, outline, 0.01)


CONE = ((0.0, 0.01), (0.02, 0.01), (0.008, 0.05), (0.004, 0.05), (0.004, 0.03), (0.0, 0.03))

BODIES: dict[str, Body] = {
    "cone": turned(CONE),
    "port": turned(rectangle(0.005, 0.02, 0, 0.04), holes=(Hole(0.02, 0.006, 0.7, 0.012),)),
    "port to the axis": turned(rectangle(0.0, 0.02, 0, 0.04), holes=(Hole(0.015, 0.01, 2.0),)),
    "ports across a cone": turned(CONE, holes=(Hole(0.02, 0.005, 0.3, 0.006), Hole(0.04, 0.004, 4.0, 0.002))),
    "thread above a bore": turned(
        rectangle(0.004, 0.02, 0, 0.04), holes=(Hole(0.02, 0.008, 1.0, 0.012), Hole(0.02, 0.004, 1.0))
    ),
    "flange": turned(
        rectangle(0.004, 0.02, 0, 0.01), axial_holes=tuple(AxialHole(0.014, 0.004, 0, 0.01, i * 1.9) for i in range(3))
    ),
    "arc": helical(arc(0.01, 0.004, 1.0, 0.4, 0.02)),
    "sector": helical(arc(0.0, 0.004, 2.5, -0.4, -0.02)),
    "helix": helical(band(0.012, 0.004, 0.001, 0.05)),
}


@pytest.mark.skipif(not graphics.has_gl(), reason=f"libGL is missing: {graphics.APT_LINE}")
@pytest.mark.parametrize("name", BODIES)
def test_the_cad_kernel_finds_the_same(name: str) -> None:
    from fluxbore.geometry.solid import solid

    body = solid(BODIES[name])
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    found = GProp_GProps()
    BRepGProp.VolumeProperties_s(body.wrapped, found, 1e-9)
    matrix, middle = found.MatrixOfInertia(), found.CentreOfMass()
    tensor = np.array([[matrix.Value(i, j) for j in (1, 2, 3)] for i in (1, 2, 3)]) * 1e-15
    mine = inertia(BODIES[name], 1.0)
    assert mine.mass == pytest.approx(found.Mass() * 1e-9, rel=1e-6)
    assert mine.centre * 1e3 == pytest.approx([middle.X(), middle.Y(), middle.Z()], abs=1e-5)
    assert mine.tensor == pytest.approx(tensor, abs=1e-6 * np.abs(tensor).max())


def test_a_ring_and_a_cone_by_their_textbook_formulas() -> None:
    """m/12 (3 (r² + R²) + l²) and m (r² + R²)/2; a cone: 3/10 m R² and 3/80 m (4 R² + l²)."""
    ring = inertia(turned(rectangle(0.01, 0.02, 0.1, 0.15)), 7800.0)
    square = 0.01**2 + 0.02**2
    assert np.diag(ring.tensor) == pytest.approx(
        ring.mass * np.array([(3 * square + 0.05**2) / 12] * 2 + [square / 2]), rel=1e-12
    )
    cone = inertia(turned(((0.0, 0.0), (0.03, 0.0), (0.0, 0.08))), 1.0)
    assert cone.centre == pytest.approx([0, 0, 0.02])
    assert np.diag(cone.tensor) == pytest.approx(
        cone.mass * np.array([3 / 80 * (4 * 0.03**2 + 0.08**2)] * 2 + [0.3 * 0.03**2]), rel=1e-12
    )


@given(st.floats(-3, 3), st.floats(-0.1, 0.1), st.floats(0.05, 6.0), st.floats(-0.02, 0.02), st.floats(1e-4, 0.004))
@settings(max_examples=40, deadline=None)
def test_a_helix_turned_and_shifted_has_a_tensor_turned_and_the_same(
    angle: float, way: float, around: float, lead: float, width: float
) -> None:
    """Catches a lost digit far from the origin, and a series that does not join its formula."""
    first = helical(arc(lead, width, around, 0.3, 0.01))
    second = dataclasses.replace(first, outline=unrolled.moved(first.outline, angle, way))
    c, s = math.cos(angle), math.sin(angle)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    one, other = inertia(first, 1.0), inertia(second, 1.0)
    assert other.centre == pytest.approx(turn @ one.centre + [0, 0, way], abs=1e-12)
    assert other.tensor == pytest.approx(turn @ one.tensor @ turn.T, abs=1e-9 * np.abs(one.tensor).max())


@given(st.integers(2, 9))
@settings(deadline=None)
def test_pieces_of_a_tube_are_the_tube(pieces: int) -> None:
    """Steiner's theorem: sectors all round, put together, against the ring; likewise slices along it."""
    whole = inertia(turned(rectangle(0.02, 0.025, -0.01, 0.03)), 2.0)
    angle = math.tau / pieces
    sectors = [helical(arc(0.0, 0.04, angle, i * angle, 0.01)) for i in range(pieces)]
    height = 0.04 / pieces
    slices = [turned(rectangle(0.02, 0.025, -0.01 + i * height, -0.01 + (i + 1) * height)) for i in range(pieces)]
    for parts in (sectors, slices):
        found = combined(inertia(part, 2.0) for part in parts)
        assert found.mass == pytest.approx(whole.mass)
        assert found.centre == pytest.approx(whole.centre, abs=1e-15)
        assert found.tensor == pytest.approx(whole.tensor, abs=1e-12 * np.abs(whole.tensor).max())


@pytest.mark.parametrize("name", BODIES)
def test_a_tensor_is_one_of_a_body(name: str) -> None:
    """Symmetric, positive, each moment no more than the other two; the least of all points at the centre."""
    found = inertia(BODIES[name], 1.0)
    assert found.tensor == pytest.approx(found.tensor.T)
    least, middle, most = np.linalg.eigvalsh(found.tensor)
    assert 0 < least <= middle <= most < least + middle
    away = found.about(found.centre + [0.01, -0.02, 0.005])
    assert np.all(np.linalg.eigvalsh(away - found.tensor) > -1e-15)


@pytest.mark.parametrize("name", ["ipehla", "rotlin", "prehydra"])
def test_an_assembly_is_the_sum_of_its_parts(name: str) -> None:
    """Masses are those of the parts list, and the mover's centre moves with it."""
    spec = load(EXAMPLES / f"{name}.toml")
    rows = [part_masses(assembly_of(spec, place), spec.materials) for place in STROKE_PLACES.values()]
    for one in rows:
        both = combined([inertia_of(one, "mover"), inertia_of(one, "stator")])
        assert both.mass == pytest.approx(inertia_of(one).mass)
        assert both.tensor == pytest.approx(inertia_of(one).tensor, rel=1e-9, abs=1e-12)
    middle, retracted, extended = (inertia_of(one, "mover") for one in rows)
    assert middle.mass == pytest.approx(sum(row.mass for row in rows[0] if row.part.group == "mover"))
    assert middle.centre == pytest.approx((retracted.centre + extended.centre) / 2, abs=1e-9)
    assert middle.tensor[2, 2] == pytest.approx(extended.tensor[2, 2])


def test_the_lightest_of_all_has_none() -> None:
    assert of_mass(BODIES["cone"], 0.0).mass == 0.0
    assert combined([of_mass(BODIES["cone"], 0.0)]).mass == 0.0
    assert volume(own_frame(BODIES["cone"])[0]) == pytest.approx(volume(BODIES["cone"]), rel=1e-14)
