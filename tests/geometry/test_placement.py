"""Copies stand where their parts are: a shape, placed, is the other part."""

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from fluxbore import load
from fluxbore.actuators import assembly_of
from fluxbore.geometry import helix
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.outline import Profile, rectangle
from fluxbore.geometry.part import AxialHole, Body, Hole, Part, centre_of_mass
from fluxbore.geometry.parts_list import parts_list
from fluxbore.geometry.placement import Placement, placement

MM = 1e-3
EXAMPLES = Path(__file__).parents[2] / "examples"
STEPPED: Profile = (
    (2 * MM, 0.0),
    (9 * MM, 0.0),
    (9 * MM, 3 * MM),
    (5 * MM, 3 * MM),
    (5 * MM, 11 * MM),
    (2 * MM, 11 * MM),
)
FIRST = Part(
    "a", "a", "stator", "POM", (0, 0, 0), STEPPED,
    holes=(Hole(7 * MM, 2 * MM, 0.4), Hole(7 * MM, 2 * MM, 2.0)),
    axial_holes=(AxialHole(7 * MM, 1 * MM, 0.0, 3 * MM, 1.0),),
)  # fmt: skip


def moved(part: Part, place: Placement) -> Part:
    """The same part somewhere else, by its own numbers."""
    side = -1.0 if place.flipped else 1.0
    holes = [dataclasses.replace(h, z=side * h.z + place.shift, angle=side * h.angle + place.angle) for h in part.holes]
    axial = []
    for h in part.axial_holes:
        low, high = sorted((side * h.start + place.shift, side * h.end + place.shift))
        axial.append(dataclasses.replace(h, start=low, end=high, angle=side * h.angle + place.angle + math.tau))
    profile = [(r, side * z + place.shift) for r, z in part.profile][:: -1 if place.flipped else 1]
    # Beginning at another corner, and its drillings in another order.
    return dataclasses.replace(
        part, profile=(*profile[2:], *profile[:2]), holes=tuple(holes[::-1]), axial_holes=tuple(axial)
    )


@pytest.mark.parametrize("flipped", [False, True])
def test_a_moved_part_is_found_where_it_is(flipped: bool) -> None:
    """Against centres of mass, which the parts compute by themselves; the quaternion turns as the matrix does."""
    other = moved(FIRST, Placement(flipped, 1.3, 5 * MM))
    place = placement(FIRST, other)
    assert place is not None
    assert place.flipped is flipped
    assert place.matrix @ [*centre_of_mass(FIRST), 1.0] == pytest.approx([*centre_of_mass(other), 1.0], abs=1e-12)
    x, y, z, w = place.quaternion
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    assert np.eye(3) + 2 * w * cross + 2 * cross @ cross == pytest.approx(place.matrix[:3, :3], abs=1e-12)


def test_another_shape_has_no_place() -> None:
    """A drilling turned by itself, one of another size, and a mirror image are other shapes."""
    first, second = FIRST.holes
    for holes in (
        (first, dataclasses.replace(second, angle=2.1)),
        (first, dataclasses.replace(second, diameter=3 * MM)),
        (first, dataclasses.replace(second, angle=0.4 - 1.6)),
        (first,),
    ):
        assert placement(FIRST, dataclasses.replace(FIRST, holes=holes)) is None
    assert placement(FIRST, dataclasses.replace(FIRST, profile=rectangle(2 * MM, 9 * MM, 0.0, 11 * MM))) is None


def test_arcs_along_a_helix() -> None:
    def arc(lead: float, angle: float, z: float) -> HelicalPart:
        outline = helix.arc(lead, 2 * MM, 1.0, angle, z)
        return HelicalPart("a", "a", "mover", "N42", (0, 0, 0), 15 * MM, 18 * MM, outline, lead)

    first, other = arc(5 * MM, 0.4, 3 * MM), arc(5 * MM, 7.9, 21 * MM)
    place = placement(first, other)
    assert place is not None
    assert not place.flipped
    assert place.matrix @ [*centre_of_mass(first), 1.0] == pytest.approx([*centre_of_mass(other), 1.0], abs=1e-12)
    assert placement(first, arc(-5 * MM, 0.4, 3 * MM)) is None


@pytest.mark.parametrize("name", ["ipehla", "prehydra"])
def test_every_piece_of_an_example_is_a_copy_of_its_items_first(name: str) -> None:
    spec = load(EXAMPLES / f"{name}.toml")
    pieces: list[tuple[Body, Body]] = [
        (item.part, part) for item in parts_list(assembly_of(spec), spec.materials) for part in item.parts
    ]
    assert all(placement(first, other) is not None for first, other in pieces)
