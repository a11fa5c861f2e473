"""Meshes of outlines: true to their curves, well shaped, and an error sentence whatever the mesher does."""

from __future__ import annotations

import os

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fluxbore.design.errors import FluxboreError, MeshError
from fluxbore.fem import mesh_worker, unstructured
from fluxbore.fem.mesh import Floats
from fluxbore.fem.outline import HOLE, Curve, Outline, Pair, Seed
from fluxbore.fem.triangulation import Triangulation
from fluxbore.fem.unstructured import triangulate

SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
SIDES = [Curve(0, 1), Curve(1, 2), Curve(2, 3), Curve(3, 0)]


def planar(points: list[tuple[float, float]], curves: list[Curve], seeds: list[Seed], *pairs: Pair) -> Outline:
    return Outline("planar", np.array(points), tuple(curves), tuple(seeds), pairs)


def circles(radii: list[float], centre: float = 0.0, first: int = 0) -> tuple[list[tuple[float, float]], list[Curve]]:
    points = [(centre + s * r, 0.0) for r in radii for s in (1, -1)]
    ends = [(first + 2 * k, first + 2 * k + 1) for k in range(len(radii))]
    return points, [c for a, b in ends for c in (Curve(a, b, np.pi), Curve(b, a, np.pi))]


def areas(mesh: Triangulation) -> Floats:
    a, b, c = (mesh.points[mesh.triangles[:, k]] for k in range(3))
    u, v = b - a, c - a
    return np.asarray((u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2)


def smallest_angle(mesh: Triangulation) -> float:
    p = mesh.points[mesh.triangles]
    u, v = np.roll(p, -1, axis=1) - p, np.roll(p, 1, axis=1) - p
    return float(np.degrees(np.arccos((u * v).sum(2) / np.linalg.norm(u, axis=2) / np.linalg.norm(v, axis=2))).min())


def check(outline: Outline, mesh: Triangulation) -> None:
    """What every mesh owes its users."""
    assert (areas(mesh) > 0).all()
    sides = np.sort(mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    unique, count = np.unique(sides, axis=0, return_counts=True)
    assert count.max() == 2
    edges = {*map(tuple, np.sort(mesh.edges, axis=1).tolist())}
    assert len(edges) == len(mesh.edges)
    assert edges <= {*map(tuple, unique.tolist())}
    assert {*map(tuple, unique[count == 1].tolist())} <= edges  # a boundary lies on curves
    assert sorted(set(mesh.triangles.ravel().tolist())) == list(range(len(mesh.points)))
    known = mesh.vertex >= 0
    assert (mesh.points[mesh.vertex[known]] == outline.points[known]).all()
    for number in np.unique(mesh.curve):
        curve = outline.curves[number]
        a, b = (mesh.points[mesh.edges[mesh.curve == number, k]] for k in (0, 1))
        if curve.turn:
            centre = outline.centre(curve)
            radius = np.hypot(*(outline.points[curve.start] - centre))
            assert np.hypot(*(np.vstack((a, b)) - centre).T) == pytest.approx(radius, rel=1e-9)
            u, v = a - centre, b - centre
            assert (u[:, 0] * v[:, 1] > u[:, 1] * v[:, 0]).all()
            assert np.degrees(2 * np.arcsin(np.hypot(*(b - a).T).max() / 2 / radius)) < 16
        else:
            assert ((b - a) @ (outline.points[curve.end] - outline.points[curve.start]) > 0).all()


def made(outline: Outline) -> Triangulation:
    mesh = triangulate(outline)
    check(outline, mesh)
    return mesh


def test_nested_circles() -> None:
    """Catches islands that are filled twice, holes that are meshed and arcs that are left for their chords."""
    points, curves = circles([1.0, 2.0, 3.0])
    outline = planar(points, curves, [Seed((0.5, 0), HOLE), Seed((1.5, 0), 7), Seed((2.5, 0), 8)])
    mesh = made(outline)
    assert set(mesh.region.tolist()) == {7, 8}
    # A polygon of n ≥ 24 sides misses at most 1 − sinc(2π/n) = 1.2 % of its circle.
    for region, area in ((7, 3 * np.pi), (8, 5 * np.pi)):
        assert areas(mesh)[mesh.region == region].sum() == pytest.approx(area, rel=0.02)
    assert smallest_angle(mesh) > 25


def test_circles_that_touch_in_a_point() -> None:
    """Catches a face pinched in one point."""
    arcs = [Curve(0, 1, np.pi), Curve(1, 0, np.pi), Curve(1, 2, np.pi), Curve(2, 1, np.pi)]
    frame = [(-4.0, -4.0), (4.0, -4.0), (4.0, 4.0), (-4.0, 4.0)]
    box = [Curve(3 + k, 3 + (k + 1) % 4) for k in range(4)]
    points = [(-2.0, 0.0), (0.0, 0.0), (2.0, 0.0), *frame]
    mesh = made(planar(points, arcs + box, [Seed((-1, 0), 0), Seed((1, 0), 1), Seed((0, 3), 2)]))
    assert areas(mesh).sum() == pytest.approx(64, rel=1e-9)


def test_arcs_that_nearly_touch() -> None:
    """Catches chords that cross where their arcs pass each other at a thousandth of the radius."""
    left, arcs = circles([1.0], -1.0)
    right, more = circles([1.0], 1.001, 2)
    mesh = made(planar(left + right, arcs + more, [Seed((-1, 0), 0), Seed((1, 0), 1)]))
    assert smallest_angle(mesh) > 20


def test_a_narrow_gap_is_resolved() -> None:
    """Catches triangles whose base is a hundred times their height, between an island and a wall."""
    g = 2e-3
    island = [(0.4, g), (0.6, g), (0.6, 0.3), (0.4, 0.3)]
    curves = SIDES + [Curve(4 + k, 4 + (k + 1) % 4) for k in range(4)]
    mesh = made(planar(SQUARE + island, curves, [Seed((0.1, 0.1), 0), Seed((0.5, 0.1), 1)]))
    assert smallest_angle(mesh) > 15
    assert len(mesh.triangles) < 6000  # the wide part stays coarse


def test_lines_that_end_in_a_face_are_sides_of_triangles() -> None:
    """Catches a dangling chain that the faces do not know; `check` compares its sides with the triangles'."""
    angle = np.linspace(0, 12, 40)
    spiral = [(0.5 + 0.03 * a * np.cos(a), 0.5 + 0.03 * a * np.sin(a)) for a in angle.tolist()]
    chain = [Curve(4 + k, 5 + k) for k in range(39)]
    mesh = made(planar(SQUARE + spiral, SIDES + chain, [Seed((0.05, 0.05), 0)]))
    assert set(mesh.curve.tolist()) == set(range(43))


def test_a_point_on_no_line_is_a_node() -> None:
    """Catches a line current that no node can carry."""
    mesh = made(planar([*SQUARE, (0.3, 0.55)], SIDES, [Seed((0.1, 0.1), 0)]))
    assert (mesh.vertex >= 0).all()
    assert set(mesh.curve.tolist()) == {0, 1, 2, 3}


@pytest.mark.parametrize("reverse", [False, True])
def test_periodic_sides_have_matching_nodes(reverse: bool) -> None:
    """Catches sides divided by what lies near one of them only: a small line near the first."""
    c, s = np.cos(np.pi / 4), np.sin(np.pi / 4)
    points = [(1.0, 0.0), (2.0, 0.0), (2 * c, 2 * s), (c, s), (1.3, 0.03), (1.4, 0.03)]
    second = Curve(2, 3) if reverse else Curve(3, 2)
    curves = [Curve(0, 1), Curve(1, 2, np.pi / 4), second, Curve(0, 3, np.pi / 4), Curve(4, 5)]
    mesh = made(planar(points, curves, [Seed((1.5, 0.6), 0)], Pair(0, 2, -1, reverse)))
    radius = [np.sort(np.hypot(*mesh.points[np.unique(mesh.edges[mesh.curve == k])].T)) for k in (0, 2)]
    assert len(radius[0]) > 8
    assert radius[0] == pytest.approx(radius[1], abs=1e-9)


def test_the_axis_is_exact_and_sizes_are_obeyed() -> None:
    """Catches radii of 1e-17 on the axis, and a size taken for the length of a side instead of half of it."""
    seeds = (Seed((0.5, 0.5), 0, size=0.02),)
    curves = (*SIDES[:3], Curve(3, 0, size=0.005))
    outline = Outline("axisymmetric", np.array(SQUARE), curves, seeds)
    mesh = triangulate(outline)
    check(outline, mesh)
    ends = mesh.points[mesh.edges]
    length = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    assert (ends[mesh.curve == 3][:, :, 0] == 0.0).all()
    assert 0.006 < length[mesh.curve == 3].max() < 0.0101
    assert 0.02 < length[mesh.curve == 1].max() < 0.0401


def test_a_default_label_fills_what_has_none() -> None:
    """Catches faces that a default leaves empty."""
    points, curves = circles([0.1, 0.2])
    points = [(x + 0.5, y + 0.5) for x, y in points]
    shifted = [Curve(c.start + 4, c.end + 4, c.turn) for c in curves]
    seeds = [Seed((0.5, 0.5), 1), Seed((0.05, 0.05), 2, default=True)]
    mesh = made(planar(SQUARE + points, SIDES + shifted, seeds))
    assert areas(mesh).sum() == pytest.approx(1, rel=1e-9)


def test_the_same_outline_gives_the_same_mesh() -> None:
    """Catches a mesh that depends on what the worker did before."""
    points, curves = circles([1.0, 2.0])
    outline = planar(points, curves, [Seed((0.5, 0), 0), Seed((1.5, 0), 1)])
    first, second = triangulate(outline), triangulate(outline)
    assert (first.points == second.points).all()
    assert (first.triangles == second.triangles).all()


def test_a_dead_worker_is_replaced() -> None:
    """Catches a broken pipe that outlives the process at its other end."""
    outline = planar(SQUARE, SIDES, [Seed((0.1, 0.1), 0)])
    triangulate(outline)
    mesh_worker._running[0].kill()
    mesh_worker._running[0].wait()
    assert len(triangulate(outline).triangles)


def test_a_slow_mesher_is_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    """Catches a hang: the worker is killed, the sentence says so, and the next mesh is made."""
    outline = planar(SQUARE, SIDES, [Seed((0.1, 0.1), 0, size=4e-3)])
    with monkeypatch.context() as patch:
        patch.setattr(unstructured, "TIME_LIMIT", -100.0)
        with pytest.raises(MeshError, match="was stopped"):
            triangulate(outline)
    assert len(triangulate(planar(SQUARE, SIDES, [Seed((0.1, 0.1), 0)])).triangles)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork on this system")
def test_a_fork_has_a_worker_of_its_own() -> None:
    """Catches two processes that read each other's answers from one pipe."""
    outline = planar(SQUARE, SIDES, [Seed((0.1, 0.1), 0)])
    triangulate(outline)
    mine = mesh_worker._running[0].pid
    mesh_worker._forget()
    try:
        triangulate(outline)
        assert mesh_worker._running[0].pid != mine
    finally:
        for worker in mesh_worker._inherited:
            worker.returncode = None
            worker.wait(timeout=5)  # its standard input has ended: so has it
        mesh_worker._inherited.clear()


_COORDINATE = st.one_of(st.integers(0, 4).map(float), st.floats(0, 4, allow_nan=False))
_CURVE = st.tuples(st.integers(0, 7), st.integers(0, 7), st.sampled_from([0.0, 0.0, 0.5, np.pi / 2, np.pi]))


@settings(max_examples=60, deadline=None, derandomize=True)
@given(
    st.lists(st.tuples(_COORDINATE, _COORDINATE), min_size=8, max_size=8, unique=True),
    st.lists(_CURVE.filter(lambda c: c[0] != c[1]), min_size=3, max_size=9),
    st.tuples(_COORDINATE, _COORDINATE),
)
def test_any_drawing_gives_a_mesh_or_a_sentence(
    points: list[tuple[float, float]], curves: list[tuple[int, int, float]], seed: tuple[float, float]
) -> None:
    """Catches whatever the cases above do not think of."""
    outline = planar(points, [Curve(*c) for c in curves], [Seed(seed, 0, default=True)])
    sentence = ""
    try:
        mesh = triangulate(outline, limit=20_000)
        assert (areas(mesh) > 0).all()
    except FluxboreError as error:
        sentence = str(error)
    assert "\n" not in sentence
