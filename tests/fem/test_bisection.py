"""Refinement: conforming, upright, true to arcs, pairs and axis, and never sharp."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import Delaunay

from fluxbore.fem.bisection import Refined, mates_of, prepare, refine, refine_all, signed_area
from fluxbore.fem.outline import Curve, Outline, Pair, Seed
from fluxbore.fem.triangulation import Triangulation


def square(cells: int, pairs: tuple[Pair, ...] = ()) -> tuple[Triangulation, Outline]:
    """The unit square from the axis outwards; curves 0 below, 1 outer, 2 above, 3 the axis, 4 x = 1/2 upwards."""
    x, y = (g.ravel() for g in np.meshgrid(np.linspace(0, 1, cells + 1), np.linspace(0, 1, cells + 1)))
    number = np.arange(x.size).reshape(cells + 1, cells + 1)
    a, b, c, d = (g.ravel() for g in (number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]))
    triangles = np.concatenate((np.column_stack((a, b, c)), np.column_stack((a, c, d))))
    half = cells // 2
    rows = [number[0], number[:, -1], number[-1, ::-1], number[::-1, 0], number[:, half]]
    edges = np.concatenate([np.column_stack((row[:-1], row[1:])) for row in rows])
    points = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0], [0.5, 1]], dtype=float)
    curves = (Curve(0, 1), Curve(1, 2), Curve(2, 3), Curve(3, 0), Curve(4, 5))
    outline = Outline("axisymmetric", points, curves, (Seed((0.2, 0.3), 0), Seed((0.7, 0.3), 1)), pairs)
    vertex = np.array([number[0, 0], number[0, -1], number[-1, -1], number[-1, 0], number[0, half], number[-1, half]])
    region = (x[triangles].mean(axis=1) > 0.5).astype(np.int_)
    mesh = Triangulation(np.column_stack((x, y)), triangles, region, edges, np.repeat(np.arange(5), cells), vertex)
    return mesh, outline


def disc(around: int = 8, inner: float = 0.5, outer: float = 1.0) -> tuple[Triangulation, Outline]:
    """A disc of two regions: four arcs inside (curves 0 to 3), two arcs of half a circle outside (4 and 5)."""
    angle = 2 * np.pi * np.arange(around) / around
    ring = np.column_stack((np.cos(angle), np.sin(angle)))
    points = np.concatenate(([[0.0, 0.0]], inner * ring, outer * ring))
    triangles = Delaunay(points).simplices.astype(np.int_)
    clockwise = signed_area(points, triangles) < 0
    triangles[clockwise] = triangles[clockwise][:, ::-1]
    region = np.all(triangles > around, axis=1) | (np.hypot(*points[triangles].mean(axis=1).T) > inner * 0.95)
    k = np.arange(around)
    loop = np.column_stack((k, (k + 1) % around))
    vertex = np.array([1 + q * around // 4 for q in range(4)] + [around + 1, around + 1 + around // 2])
    curves = tuple(Curve(q, (q + 1) % 4, np.pi / 2) for q in range(4)) + (Curve(4, 5, np.pi), Curve(5, 4, np.pi))
    outline = Outline("planar", points[vertex], curves, (Seed((0, 0), 0), Seed(((inner + outer) / 2, 0), 1)))
    edges = np.concatenate((loop + 1, loop + 1 + around))
    curve = np.concatenate((4 * k // around, 4 + 2 * k // around))
    return Triangulation(points, triangles, region.astype(np.int_), edges, curve, vertex), outline


def check(refined: Refined, old: Triangulation, outline: Outline) -> None:
    """Upright, conforming, whole: what must hold after every refinement."""
    new = refined.triangulation
    count = new.points.shape[0]
    area = signed_area(new.points, new.triangles)
    assert np.all(area > 0)
    assert np.array_equal(np.unique(new.triangles), np.arange(count))
    sides = np.stack((new.triangles, np.roll(new.triangles, -1, axis=1)), axis=-1).reshape(-1, 2)
    directed = sides[:, 0] * count + sides[:, 1]
    assert np.unique(directed).size == directed.size, "an edge has two triangles on one side"
    alone = ~np.isin(sides[:, 1] * count + sides[:, 0], directed)
    on_curve = np.concatenate((new.edges, new.edges[:, ::-1]))
    coded = on_curve[:, 0] * count + on_curve[:, 1]
    assert np.all(np.isin(directed[alone], coded)), "a hanging node: an edge inside has one triangle"
    assert np.all(np.isin(coded[: coded.size // 2], np.concatenate((directed, sides[:, 1] * count + sides[:, 0]))))
    assert np.array_equal(new.region, old.region[refined.origin])
    # Each curve is still one chain from its start to its end.
    for number, curve in enumerate(outline.curves):
        first, last = new.edges[new.curve == number].T
        start, end = new.vertex[[curve.start, curve.end]]
        assert set(first) - set(last) == {start}
        assert set(last) - set(first) == {end}
        turn = np.diff(new.points[new.edges[new.curve == number]], axis=1)[:, 0] @ (new.points[end] - new.points[start])
        assert curve.turn > 3 or np.all(turn > 0), "an edge runs backwards"
    # Where nodes and triangles come from.
    kept = np.arange(old.points.shape[0])
    assert np.array_equal(refined.parents[: kept.size], np.column_stack((kept, kept)))
    assert refined.parents.shape == (count, 2)
    middle = new.points[new.triangles].mean(axis=1)
    corners = old.points[old.triangles[refined.origin]]
    for k in range(3):
        a, b = corners[:, k], corners[:, (k + 1) % 3]
        u, v = b - a, middle - a
        side = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
        assert np.all(side > 0) or max(c.turn for c in outline.curves) > 0, "a child outside its parent"


def smallest_angle(mesh: Triangulation) -> float:
    """Degrees."""
    corners = mesh.points[mesh.triangles]
    ahead, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    cosine = np.sum(ahead * back, axis=-1) / np.linalg.norm(ahead, axis=-1) / np.linalg.norm(back, axis=-1)
    return float(np.degrees(np.arccos(cosine).min()))


@given(st.lists(st.integers(0, 10_000), min_size=0, max_size=5), st.integers(1, 5), st.booleans())
@settings(max_examples=60, deadline=None)
def test_random_marks(numbers: list[int], levels: int, round_one: bool) -> None:
    """Catches hanging nodes, overturned triangles, broken curves and wrong origins, whatever is marked."""
    mesh, outline = disc() if round_one else square(2)
    mesh = prepare(mesh)
    whole = signed_area(mesh.points, mesh.triangles).sum()
    for level in range(levels):
        marked = np.zeros(mesh.triangles.shape[0], dtype=bool)
        marked[[(k * (level + 1)) % marked.size for k in numbers]] = True
        refined = refine(mesh, outline, marked)
        check(refined, mesh, outline)
        children = np.bincount(refined.origin, minlength=marked.size)
        assert np.all(children[marked] == 4), "all edges of a marked triangle are halved"
        mesh = refined.triangulation
    area = signed_area(mesh.points, mesh.triangles).sum()
    assert area >= whole if round_one else area == pytest.approx(whole, rel=1e-12)


def test_nothing_marked_changes_nothing() -> None:
    """Catches renumbering or reordering that would spoil the newest-vertex order between rounds."""
    mesh, outline = square(3)
    mesh = prepare(mesh)
    refined = refine(mesh, outline, np.zeros(mesh.triangles.shape[0], dtype=bool))
    assert np.array_equal(refined.triangulation.triangles, mesh.triangles)
    assert np.array_equal(refined.triangulation.edges, mesh.edges)
    assert np.array_equal(refined.origin, np.arange(mesh.triangles.shape[0]))


def test_preparation_puts_the_longest_edge_first() -> None:
    """Catches a first cut across a short edge, and a turn that mirrors triangles."""
    mesh, _ = disc()
    ready = prepare(mesh)
    length = np.linalg.norm(np.roll(mesh.points[ready.triangles], -1, axis=1) - mesh.points[ready.triangles], axis=-1)
    assert np.all(length[:, 0] >= length.max(axis=1) * (1 - 1e-12))
    assert np.all(signed_area(ready.points, ready.triangles) > 0)


@pytest.mark.parametrize("shape", ["square", "disc"])
def test_angles_stay_away_from_zero(shape: str) -> None:
    """Catches a lost newest-vertex order: twelve levels towards a corner or a point of an arc, angles as at first."""
    mesh, outline = square(2) if shape == "square" else disc(12)
    target = np.array([0.5, 0.5]) if shape == "square" else np.array([0.5, 0.0])
    mesh = prepare(mesh)
    first = smallest_angle(mesh)
    for _ in range(12):
        at_target = np.all(mesh.points == mesh.points[np.argmin(np.hypot(*(mesh.points - target).T))], axis=1)
        refined = refine(mesh, outline, np.any(at_target[mesh.triangles], axis=1))
        check(refined, mesh, outline)
        mesh = refined.triangulation
    size = np.sqrt(signed_area(mesh.points, mesh.triangles))
    assert size.min() < 1e-3 * size.max()
    assert mesh.triangles.shape[0] < 1500, "closure spreads only a little"
    assert smallest_angle(mesh) > 0.5 * first - 1e-9


@pytest.mark.parametrize("red", [True, False])
def test_an_arc_is_approached_at_second_order(red: bool) -> None:
    """Catches nodes on chords: areas of inscribed polygons approach the circle's as h², of both circles."""
    mesh, outline = disc(8)
    mesh = prepare(mesh)
    gaps = []
    for _ in range(4):
        everything = np.ones(mesh.triangles.shape[0], dtype=bool)
        refined = refine_all(mesh, outline) if red else refine(mesh, outline, everything)
        check(refined, mesh, outline)
        mesh = refined.triangulation
        area = signed_area(mesh.points, mesh.triangles)
        gaps.append([np.pi / 4 - area[mesh.region == 0].sum(), np.pi - area.sum()])
        for number, curve in enumerate(outline.curves):
            nodes = mesh.edges[mesh.curve == number]
            radius = 0.5 if number < 4 else 1.0
            assert np.hypot(*mesh.points[nodes.ravel()].T) == pytest.approx(radius, rel=1e-14)
            chord = np.linalg.norm(np.diff(mesh.points[nodes], axis=1), axis=-1)
            assert chord == pytest.approx(chord.mean(), rel=1e-12), (
                f"curve {number} of turn {curve.turn} is cut unevenly"
            )
    rate = np.log2(np.array(gaps[:-1]) / np.array(gaps[1:]))
    assert rate[-1] == pytest.approx(2, abs=0.02)


def test_half_a_circle_in_one_edge() -> None:
    """Catches a centre that coincides with the chord's middle, where no direction can be had from the centre."""
    points = np.array([[0.0, -1.0], [0.0, 1.0], [-1.0, 0.0]])
    loop = np.array([[0, 1], [1, 2], [2, 0]])
    curves = (Curve(0, 1, np.pi), Curve(1, 2), Curve(2, 0))
    outline = Outline("planar", points, curves, (Seed((-0.5, 0), 0),))
    numbers = np.arange(3)
    mesh = Triangulation(points, np.array([[0, 1, 2]]), np.zeros(1, dtype=np.int_), loop, numbers, numbers)
    refined = refine(prepare(mesh), outline, np.ones(1, dtype=bool))
    check(refined, prepare(mesh), outline)
    new = refined.triangulation.points[3:]
    assert np.min(np.hypot(*(new - [1.0, 0.0]).T)) < 1e-15


def test_the_axis_stays_the_axis() -> None:
    """Catches r = 1e-17 on the axis, where a condition or a division asks for zero."""
    mesh, outline = square(4)
    mesh = prepare(mesh)
    for _ in range(5):
        mesh = refine(mesh, outline, np.any(mesh.points[mesh.triangles, 0] == 0, axis=1)).triangulation
    axis = np.unique(mesh.edges[mesh.curve == 3])
    assert axis.size > 100
    assert np.all(mesh.points[axis, 0] == 0)


@pytest.mark.parametrize("marked_side", [0.0, 1.0])
@pytest.mark.parametrize("reverse", [True, False])
def test_mates_are_halved_together(reverse: bool, marked_side: float) -> None:
    """Catches a periodic boundary whose sides are cut differently after marks on one side only."""
    pair = Pair(0, 2, reverse=True)
    mesh, outline = square(4, (pair,))
    if not reverse:
        turned = (*outline.curves[:2], Curve(3, 2), *outline.curves[3:])
        outline = Outline("axisymmetric", outline.points, turned, outline.seeds, (Pair(0, 2, -1),))
        edges = np.where((mesh.curve == 2)[:, None], mesh.edges[:, ::-1], mesh.edges)
        mesh = Triangulation(mesh.points, mesh.triangles, mesh.region, edges, mesh.curve, mesh.vertex)
    mesh = prepare(mesh)
    for _ in range(6):
        nearest = np.argmin(np.hypot(*(mesh.points[mesh.triangles].mean(axis=1) - [0.3, marked_side]).T))
        marked = np.arange(mesh.triangles.shape[0]) == nearest
        refined = refine(mesh, outline, marked)
        check(refined, mesh, outline)
        mesh = refined.triangulation
    below, above = (np.sort(mesh.points[np.unique(mesh.edges[mesh.curve == k]), 0]) for k in (0, 2))
    assert below.size > 10
    assert np.array_equal(below, above)
    first, second = mates_of(mesh, outline).T
    ends = mesh.points[mesh.edges[second], 0]
    assert np.array_equal(mesh.points[mesh.edges[first], 0], ends[:, ::-1] if reverse else ends)


def test_sides_cut_differently_are_refused() -> None:
    """Catches a mesher that forgot a pair, before it becomes a wrong field."""
    mesh, outline = square(2, (Pair(0, 4),))
    edges, curve = mesh.edges[mesh.curve != 4], mesh.curve[mesh.curve != 4]
    torn = Triangulation(mesh.points, mesh.triangles, mesh.region, edges, curve, mesh.vertex)
    with pytest.raises(ValueError, match="have 2 and 0 edges"):
        mates_of(torn, outline)


def test_a_triangle_below_its_arc_is_not_turned_over() -> None:
    """A node between an arc and its chord, where the arc's middle lies beyond it. Catches a negative area.

    The arc of 90° rises to 0.207 over a chord of 1; the node is 0.02 above the chord, where the arc is at 0.14.
    """
    points = np.array([[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.5, -1.0], [0.8, 0.02]])
    curves = (Curve(1, 0, np.pi / 2), Curve(1, 2), Curve(2, 0), Curve(0, 3), Curve(3, 1))
    outline = Outline("planar", points[:4], curves, (Seed((0.5, 0.5), 0), Seed((0.5, -0.5), 1)))
    triangles = np.array([[0, 4, 2], [4, 1, 2], [0, 1, 4], [0, 3, 1]])
    edges = np.array([[1, 0], [1, 2], [2, 0], [0, 3], [3, 1]])
    mesh = prepare(Triangulation(points, triangles, np.array([0, 0, 0, 1]), edges, np.arange(5), np.arange(4)))
    for _ in range(5):
        refined = refine(mesh, outline, np.ones(mesh.triangles.shape[0], dtype=bool))
        check(refined, mesh, outline)
        mesh = refined.triangulation
    # Between the chord and the arc, and not all on the chord.
    distance = np.hypot(*(mesh.points[np.unique(mesh.edges[mesh.curve == 0])] - [0.5, -0.5]).T)
    assert distance.max() < np.sqrt(0.5) * (1 + 1e-12)
    assert distance.min() > 0.5 - 1e-12
    assert np.median(distance) > 0.51


def test_an_arc_a_billionth_of_its_radius_long_keeps_its_digits() -> None:
    """Catches cancellation with a far centre: thirty levels at a point of an arc, triangles upright and not sharp."""
    mesh, outline = disc(8)
    mesh = prepare(mesh)
    for _ in range(30):
        near = np.argmin(np.hypot(*(mesh.points - mesh.points[1]).T))
        refined = refine(mesh, outline, np.any(mesh.triangles == near, axis=1))
        check(refined, mesh, outline)
        mesh = refined.triangulation
    assert np.sqrt(signed_area(mesh.points, mesh.triangles).min()) < 1e-8
    assert smallest_angle(mesh) > 10
