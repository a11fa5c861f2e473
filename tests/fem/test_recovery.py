"""The recovered field: exact on parabolas, apart in each region, sound on the axis."""

import numpy as np
import pytest
from manufactured import levels, manufactured, polygon, recovered

from fluxbore.fem.conditions import Conditions, Prescribed
from fluxbore.fem.element import from_frame, positions, to_frame
from fluxbore.fem.mesh import Floats, Mesh
from fluxbore.fem.outline import Chart, Curve, Outline, Seed
from fluxbore.fem.problem import MagneticMaterial
from fluxbore.fem.recovery import Patches


def halves(chart: Chart = "planar") -> Outline:
    """The unit square in two halves, region 0 on the left."""
    points = np.array([(0, 0), (0.5, 0), (1, 0), (1, 1), (0.5, 1), (0, 1)], dtype=float)
    seeds = Seed((0.2, 0.4), 0), Seed((0.8, 0.4), 1)
    return Outline(chart, points, (*polygon(0, 6, 0), Curve(1, 4)), seeds)


def mesh_of(chart: Chart = "planar") -> Mesh:
    (level,) = levels(halves(chart), Conditions([Prescribed(lambda points: points[:, 0] * 0)]), 1)
    return level.mesh


def shared(mesh: Mesh) -> Floats:
    """(m,) whether each corner of an element has another element of its region: a patch of one carries a plane."""
    corners = mesh.region[:, None] * mesh.nodes.shape[0] + mesh.elements[:, :3]
    _, place, count = np.unique(corners, return_inverse=True, return_counts=True)
    return np.asarray(np.all(count[place.reshape(corners.shape)] > 1, axis=1))


def parabola(points: Floats) -> Floats:
    x, y = points[..., 0], points[..., 1]
    return np.stack((1 + x - 2 * y + x * y, 3 - x**2 + y**2 / 2 + y), axis=-1)


def test_parabolas_are_kept() -> None:
    """Catches a fit that is not of the second degree, or a blend whose weights do not add up to one."""
    mesh = mesh_of()
    field = Patches(mesh).recover(to_frame("planar", parabola(positions(mesh))))
    found = from_frame("planar", field.at_quadrature())
    assert np.abs(found - parabola(positions(mesh)))[shared(mesh)].max() < 1e-5


def test_parabolas_of_the_right_symmetry_are_kept_on_the_axis() -> None:
    """Catches a mirror with the wrong sign: B_r odd and B_z even in r."""

    def even(points: Floats) -> Floats:
        r, z = points[..., 0], points[..., 1]
        return np.stack((r - 2 * r * z, 1 + z - z**2 + r**2), axis=-1)

    mesh = mesh_of("axisymmetric")
    field = Patches(mesh).recover(to_frame("axisymmetric", even(positions(mesh))))
    found = from_frame("axisymmetric", field.at_quadrature())
    assert np.abs(found - even(positions(mesh)))[shared(mesh)].max() < 1e-5


def test_jumps_between_regions_stay() -> None:
    """Catches a fit across a material's face, which would smear the jump that the field has there."""
    mesh = mesh_of()
    jump = np.where(mesh.region == 0, 1.0, 5.0)[:, None, None] * np.ones((mesh.region.size, 7, 2))
    found = Patches(mesh).recover(jump).at_quadrature()
    assert np.abs(found - jump).max() < 1e-6


def test_field_at_points_is_that_at_quadrature_points() -> None:
    """Catches two ways to evaluate that disagree."""
    from fluxbore.fem.element import QUADRATURE_POINTS

    mesh = mesh_of()
    field = Patches(mesh).recover(to_frame("planar", np.sin(3 * positions(mesh))))
    elements = np.arange(5)
    one = field.at(elements, np.tile(QUADRATURE_POINTS[3], (5, 1)))
    assert one == pytest.approx(field.at_quadrature(elements)[:, 3])


def test_recovered_field_is_continuous_in_a_region() -> None:
    """Catches patches that are the elements' instead of the corners': neighbours agree on their common edge."""
    (level,) = levels(halves(), Conditions([Prescribed(lambda points: np.sin(3 * points[:, 0]))]), 1)
    solution = manufactured(level, (MagneticMaterial(1.0),) * 2)
    mesh, field = level.mesh, recovered(solution)
    middles = mesh.elements[:, 3:].ravel()
    order = np.argsort(middles, kind="stable")
    twice = np.flatnonzero(np.diff(middles[order]) == 0)
    compared = 0
    for one, other in zip(order[twice].tolist(), order[twice + 1].tolist(), strict=True):
        if mesh.region[one // 3] != mesh.region[other // 3]:
            continue
        at = np.array([[0.5, 0.5, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5]])
        a, b = (field.at(np.array([k // 3]), at[[k % 3]]) for k in (one, other))
        assert a == pytest.approx(b, abs=1e-9)
        compared += 1
    assert compared > 50
