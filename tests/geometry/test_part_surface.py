"""Triangles of parts: closed, facing outwards, as large as the part, and near its surface."""

import math

import numpy as np
import pytest

from fluxbore.geometry import helix
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.outline import rectangle
from fluxbore.geometry.part import AxialHole, Body, Hole, Part, volume
from fluxbore.geometry.part_surface import facets, surface
from fluxbore.geometry.surface import Surface, enclosed, is_closed, joined, unit

MM = 1e-3
FINE = 2e-7
"""m. At this tolerance volumes agree to 1e-4."""


def turned(profile: tuple[tuple[float, float], ...], **features: object) -> Part:
    return Part("piece", "piece", "stator", "aluminium 6061", (0.6, 0.6, 0.6), profile, **features)  # type: ignore[arg-type]


TUBE = rectangle(8 * MM, 12 * MM, 0.0, 30 * MM)
CONE = ((0.0, 0.0), (10 * MM, 0.0), (10 * MM, 4 * MM), (0.0, 9 * MM))
FLANGED = ((3 * MM, 0.0), (15 * MM, 0.0), (15 * MM, 4 * MM), (6 * MM, 4 * MM), (6 * MM, 20 * MM), (3 * MM, 20 * MM))
PARTS: dict[str, Body] = {
    "rod": turned(rectangle(0.0, 5 * MM, -3 * MM, 40 * MM)),
    "tube": turned(TUBE),
    "cone": turned(CONE),
    "cross-drilled": turned(TUBE, holes=(Hole(10 * MM, 3 * MM, 0.3), Hole(20 * MM, 2 * MM, 2.0, 9 * MM))),
    "port at the axis": turned(rectangle(0.0, 9 * MM, 0.0, 20 * MM), holes=(Hole(8 * MM, 5 * MM, -1.0),)),
    "drilled along": turned(
        FLANGED,
        axial_holes=(
            AxialHole(10 * MM, 3 * MM, 0.0, 4 * MM, 0.5),  # through: both its ends lie in faces of the part
            AxialHole(11 * MM, 2 * MM, 1 * MM, 4 * MM, 2.5),
        ),
    ),
    "arc": HelicalPart(
        "arc", "arc", "mover", "N42", (0.5, 0.5, 0.5), 15 * MM, 18 * MM, helix.arc(5 * MM, 2 * MM, 1.0, 0.4, 3 * MM)
    ),
}


def closed_volume(found: Surface) -> float:
    points, triangles = joined(found.points, found.triangles)
    assert is_closed(triangles)
    return enclosed(points, triangles)


@pytest.mark.parametrize("name", PARTS)
def test_surfaces_are_closed_and_enclose_the_part(name: str) -> None:
    """Catches a face that is missing or inside out, and a drilling that is left out, too deep or at a wrong place."""
    part = PARTS[name]
    assert closed_volume(surface(part, FINE)) == pytest.approx(volume(part), rel=2e-4)
    assert closed_volume(surface(part, 2e-5)) == pytest.approx(volume(part), rel=1e-2)


@pytest.mark.parametrize("name", PARTS)
def test_normals_stand_on_their_triangles(name: str) -> None:
    """Catches normals that point into the material, as those of a drilling would, and shading across edges."""
    found = surface(PARTS[name], 2e-5)
    a, b, c = (found.points[found.triangles[:, i]] for i in range(3))
    across = np.cross(b - a, c - a)
    large = np.linalg.norm(across, axis=1) > 1e-13  # a sliver has no direction
    lined = np.einsum("ij,ikj->ik", unit(across), found.normals[found.triangles])[large]
    assert lined.min() > math.cos(math.radians(20))
    assert np.linalg.norm(found.normals, axis=1) == pytest.approx(1.0, abs=1e-12)


def test_points_lie_on_the_true_surface() -> None:
    """Corners on the circle, sides within the tolerance inside it: catches radii that grow to save the volume."""
    tolerance = 1e-5
    found = surface(PARTS["rod"], tolerance)
    radii = np.hypot(found.points[:, 0], found.points[:, 1])
    assert radii.max() == pytest.approx(5 * MM, rel=1e-12)
    sagitta = 5 * MM * (1 - math.cos(math.pi / facets(5 * MM, tolerance, 0.1)))
    assert 0 < sagitta <= tolerance


def test_a_quarter_is_cut_out() -> None:
    """Three quarters are left, closed again, with the drillings that are not in the opening."""
    drilled = turned(TUBE, holes=(Hole(10 * MM, 3 * MM, 2.5), Hole(20 * MM, 2 * MM, -1.0, 9 * MM)))
    left = volume(drilled) - 0.25 * volume(turned(TUBE))
    assert closed_volume(surface(drilled, FINE, cut_open=True)) == pytest.approx(left, rel=2e-4)
    part = PARTS["drilled along"]
    whole = closed_volume(surface(turned(FLANGED), FINE))
    assert closed_volume(surface(turned(FLANGED), FINE, cut_open=True)) == pytest.approx(0.75 * whole, rel=1e-9)
    found = surface(part, 2e-5, cut_open=True)
    assert closed_volume(found) > 0
    assert not np.any((found.points[:, 0] > 1e-9) & (found.points[:, 1] > 1e-9))


def test_an_arc_within_the_opening_is_gone() -> None:
    outline = helix.arc(5 * MM, 2 * MM, 0.5, 0.4, 3 * MM)
    arc = HelicalPart("arc", "arc", "mover", "N42", (0.5, 0.5, 0.5), 15 * MM, 18 * MM, outline)
    assert surface(arc, 2e-5, cut_open=True).is_empty
