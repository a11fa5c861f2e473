"""Quadratic elements on general meshes: fields that they hold exactly, arcs, and the axis."""

import numpy as np
import pytest
from manufactured import circle, levels, manufactured, misses, polygon

from fluxbore.fem.conditions import Conditions, Prescribed
from fluxbore.fem.element import kernel
from fluxbore.fem.mesh import Floats
from fluxbore.fem.outline import Curve, Outline, Seed
from fluxbore.fem.problem import MagneticMaterial

UNIT = MagneticMaterial(1.0)


def slanted() -> Outline:
    """A quadrilateral without a right angle, and a slanted line through it."""
    points = np.array([(0, 0), (1, 0.2), (0.8, 1.1), (-0.2, 0.7)], dtype=float)
    curves = (*polygon(0, 4, 0), Curve(0, 2))
    return Outline("planar", points, curves, (Seed((0.7, 0.4), 0), Seed((0.1, 0.6), 1)))


def disc() -> Outline:
    return Outline("planar", np.array([(-1.0, 0.0), (1.0, 0.0)]), tuple(circle(0, 0)), (Seed((0, 0.1), 0),))


def ball() -> Outline:
    points = np.array([(0, -1), (0, 1), (0, -0.4), (0, 0.3), (0.4, 0.1)], dtype=float)
    curves = Curve(0, 2), Curve(2, 3), Curve(3, 1), Curve(0, 1, np.pi, condition=0), Curve(2, 4), Curve(4, 3, 1.0)
    return Outline("axisymmetric", points, curves, (Seed((0.6, 0.5), 0), Seed((0.1, 0.0), 1)))


@pytest.mark.parametrize("power", [(1, 0), (0, 1), (2, 0), (1, 1), (0, 2)])
def test_patch_test_of_straight_elements(power: tuple[int, int]) -> None:
    """Catches any fault of numbering or assembly: A = xᵃ yᵇ up to the second degree is held to rounding."""
    a, b = power

    def field(points: Floats) -> Floats:
        x, y = points[..., 0], points[..., 1]
        return np.stack((b * x**a * y ** max(b - 1, 0), -a * x ** max(a - 1, 0) * y**b), axis=-1)

    def density(points: Floats) -> Floats:
        return np.full(points.shape[:-1], -2.0 if 2 in power else 0.0)

    rim = Conditions([Prescribed(lambda points: points[:, 0] ** a * points[:, 1] ** b)])
    (level,) = levels(slanted(), rim, 1)
    solution = manufactured(level, (UNIT, UNIT), density)
    assert np.sqrt(misses(solution, field)[0].max()) < 1e-9
    assert solution.psi == pytest.approx(level.mesh.nodes[:, 0] ** a * level.mesh.nodes[:, 1] ** b, abs=1e-10)


def test_patch_test_on_a_disc() -> None:
    """Catches bent elements that do not hold a linear A: a uniform field within a round rim."""
    rim = Conditions([Prescribed(lambda points: 2 * points[:, 0] - 3 * points[:, 1])])
    (level,) = levels(disc(), rim, 1)
    solution = manufactured(level, (UNIT,))
    miss, _ = misses(solution, lambda points: np.broadcast_to((-3.0, -2.0), points.shape))
    assert np.sqrt(miss.max()) < 1e-9


def test_patch_test_around_the_axis() -> None:
    """Catches any element, on the axis or bent, that does not hold a uniform B_z: ψ = r²/2 in a ball."""
    rim = Conditions([Prescribed(lambda points: points[:, 0] / 2)])
    (level,) = levels(ball(), rim, 1)
    solution = manufactured(level, (UNIT, UNIT))
    miss, _ = misses(solution, lambda points: np.broadcast_to((0.0, 1.0), points.shape))
    assert np.sqrt(miss.max()) < 1e-9


@pytest.mark.parametrize("outline", [disc(), ball()], ids=["disc", "ball"])
def test_all_nodes_of_arcs_lie_on_them(outline: Outline) -> None:
    """Catches middle nodes left on chords."""
    (level,) = levels(outline, Conditions([Prescribed(lambda points: np.zeros(points.shape[0]))]), 1)
    space = level.mesh.positions
    for number, curve in enumerate(outline.curves):
        if curve.turn:
            centre = outline.centre(curve)
            radius = np.hypot(*(outline.points[curve.start] - centre))
            nodes = level.quadratic.edges[level.triangulation.curve == number]
            assert nodes.size
            assert np.hypot(*(space[nodes] - centre).reshape(-1, 2).T) == pytest.approx(radius, rel=1e-9)


def test_slanted_lines_stay_straight_on_the_axis() -> None:
    """Catches a material's face that bends where it meets the axis: middle nodes of straight curves lie on them."""
    outline = ball()
    (level,) = levels(outline, Conditions([Prescribed(lambda points: np.zeros(points.shape[0]))]), 1)
    space = level.mesh.positions
    a, b = outline.points[[2, 4]]
    off = (space[level.quadratic.edges[level.triangulation.curve == 4]] - a).reshape(-1, 2)
    along = (b - a) / np.hypot(*(b - a))
    assert np.abs(off[:, 0] * along[1] - off[:, 1] * along[0]).max() < 1e-9


def test_volume_is_that_of_the_ball() -> None:
    """Catches elements that overlap or leave gaps, and a sphere that is not the exact parabola of the chart."""
    (level,) = levels(ball(), Conditions([Prescribed(lambda points: np.zeros(points.shape[0]))]), 1)
    weight = kernel(level.mesh).weight
    assert weight.min() > 0
    assert abs(2 * np.pi * weight.sum() / (4 / 3 * np.pi) - 1) < 1e-12


def test_vertices_keep_their_places() -> None:
    """Catches nodes renumbered without the outline's points, which carry currents and prescribed A."""
    outline = ball()
    (level,) = levels(outline, Conditions([Prescribed(lambda points: np.zeros(points.shape[0]))]), 1)
    assert np.abs(level.mesh.positions[level.quadratic.vertex] - outline.points).max() < 1e-12
