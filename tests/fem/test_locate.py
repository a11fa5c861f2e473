"""Points in meshes: found in curved elements, on interfaces, on the axis, and nowhere else."""

from collections.abc import Callable

import numpy as np
import pytest

from fluxbore.fem.element import shape
from fluxbore.fem.locate import Locator
from fluxbore.fem.mapped import MappedMesh
from fluxbore.fem.mesh import Chart, Floats, Ints, Mesh, Topology, in_space

Block = Callable[..., MappedMesh]


def waved(grid: MappedMesh, chart: Chart, depth: float = 0.012) -> Mesh:
    """The block with its lines bent by sines; in the chart of a planar mesh or of an axisymmetric one, axis kept."""
    s, z = grid.mesh.nodes.T
    u, v = s / s.max(), z / z.max()
    wave = np.sin(2 * np.pi * u) * np.sin(2 * np.pi * v)
    bent = np.column_stack(
        (u + depth * wave + 0.04 * np.sin(np.pi * v) * u, v + depth * wave + 0.04 * np.sin(np.pi * u))
    )
    nodes = bent * [1.0, 2.0] if chart == "planar" else bent * [0.1**2 / 2, 0.2]
    return Mesh(chart, nodes, grid.mesh.region, grid.mesh.topology)


def points_of(mesh: Mesh, element: Ints, barycentric: Floats) -> Floats:
    """Points (k, 2) in space."""
    return in_space(mesh.chart, np.einsum("kn,knd->kd", shape(barycentric), mesh.nodes[mesh.elements[element]]))


def random_places(mesh: Mesh, count: int, seed: int = 0) -> tuple[Ints, Floats]:
    rng = np.random.default_rng(seed)
    return rng.integers(0, mesh.elements.shape[0], count), rng.dirichlet([1, 1, 1], count)


@pytest.mark.parametrize("chart", ["planar", "axisymmetric"])
def test_every_point_of_a_curved_mesh_is_found(block: Block, chart: Chart) -> None:
    """Catches boxes that miss a bulge, a Newton that goes astray, and a place that is not the point's."""
    mesh = waved(block(12), chart)
    element, place = random_places(mesh, 100_000)
    found, barycentric = Locator(mesh).find(points_of(mesh, element, place))
    assert np.array_equal(found, element)
    assert np.abs(barycentric - place).max() < 1e-8


def test_a_graded_mesh(block: Block) -> None:
    """Catches a search that relies on elements of one size: a million to one from the middle to the rim."""
    mesh = block(40, 2.0).mesh
    element, place = random_places(mesh, 2000)
    found, barycentric = Locator(mesh, snap=0.0).find(points_of(mesh, element, place))
    assert np.array_equal(found, element)
    assert np.abs(barycentric - place).max() < 1e-6


def test_nodes_belong_to_all_their_elements(block: Block) -> None:
    """Catches an interface whose points are given to one side by rounding: the lowest number wins, always."""
    mesh = waved(block(5), "axisymmetric")
    locator = Locator(mesh)
    nodes = np.arange(mesh.nodes.shape[0])
    nodes = nodes[np.isin(nodes, mesh.elements)]
    found, _ = locator.find(mesh.positions[nodes])
    for node, lowest in zip(nodes, found, strict=True):
        meeting = np.flatnonzero(np.any(mesh.elements == node, axis=1))
        assert lowest == meeting[0]
        holders = locator.find_all(mesh.positions[node])
        assert [e for e, _ in holders] == meeting.tolist()
        for e, place in holders:
            assert points_of(mesh, np.array([e]), place[None])[0] == pytest.approx(mesh.positions[node], abs=1e-9)


def test_edges_belong_to_both_sides(block: Block) -> None:
    """Catches points on curved edges that fall between two elements."""
    mesh = waved(block(6), "planar")
    rng = np.random.default_rng(1)
    element = np.repeat(np.arange(mesh.elements.shape[0]), 20)
    t = rng.random(element.size)
    points = points_of(mesh, element, np.column_stack((t, 1 - t, np.zeros(t.size))))
    locator = Locator(mesh)
    found, _ = locator.find(points)
    assert np.all(found >= 0)
    assert np.all(found <= element)
    shared = [len(locator.find_all(p)) for p in points[10:200:20]]
    assert set(shared) == {1, 2}


@pytest.mark.parametrize("bend", [False, True])
def test_points_on_the_axis(block: Block, bend: bool) -> None:
    """Catches r = 0 lost to the root in the chart, and the element without slope at the axis.

    bend : with middles halfway in r instead of in s, so that s grows from the axis as the square of the place.
    """
    grid = block(4)
    nodes = grid.mesh.nodes.copy()
    if bend:
        r = np.sqrt(2 * nodes[:, 0])
        corners, middles = r[: grid.r_nodes.size : 2], r[1 : grid.r_nodes.size : 2]
        middles[:] = (corners[1:] + corners[:-1]) / 2
        row = np.empty(grid.r_nodes.size)
        row[::2], row[1::2] = corners, middles
        nodes[:, 0] = np.tile(row**2 / 2, grid.z_nodes.size)
    mesh = Mesh("axisymmetric", nodes, grid.mesh.region, grid.mesh.topology)
    z = np.linspace(0, 0.2, 401)
    for r in (0.0, -1e-11, 1e-12, 1e-7, 1e-4):
        points = np.column_stack((np.full(z.size, r), z))
        element, barycentric = Locator(mesh).find(points)
        assert np.all(element >= 0)
        assert points_of(mesh, element, barycentric) == pytest.approx(points, abs=3e-10)
    element, place = random_places(mesh, 5000)
    found, barycentric = Locator(mesh).find(points_of(mesh, element, place))
    assert np.mean(found == element) > 0.999
    assert points_of(mesh, found, barycentric) == pytest.approx(points_of(mesh, element, place), abs=3e-10)


@pytest.mark.parametrize("chart", ["planar", "axisymmetric"])
def test_a_hair_outside_snaps_in(block: Block, chart: Chart) -> None:
    """Catches a point of the rim lost to rounding, and a snap so wide that a point outside gets a field."""
    mesh = waved(block(6), chart)
    corner = mesh.positions.max(axis=0)
    size = float(np.hypot(*(corner - mesh.positions.min(axis=0))))
    rng = np.random.default_rng(2)
    at_rim = mesh.elements[:, :3] % 13 == 12
    outer = np.flatnonzero(at_rim.sum(axis=1) == 2)
    assert outer.size == 6
    for e in outer:
        k = next(k for k in range(3) if at_rim[e, k] and at_rim[e, (k + 1) % 3])
        place = np.zeros((10, 3))
        place[:, k] = rng.random(10)
        place[:, (k + 1) % 3] = 1 - place[:, k]
        on_rim = points_of(mesh, np.full(10, e), place)
        for out, held in ((0.0, True), (0.5e-9, True), (1e-6, False)):
            points = on_rim + [out * size, 0]
            element, barycentric = Locator(mesh).find(points)
            assert np.all((element >= 0) == held)
            if held:
                assert points_of(mesh, element, barycentric) == pytest.approx(points, abs=4e-9 * size)
                assert np.all(barycentric >= 0)


def test_outside_is_outside(block: Block) -> None:
    """Catches the mirror image at negative r, and numbers that are none."""
    mesh = waved(block(4), "axisymmetric")
    nowhere = [[-0.05, 0.1], [0.2, 0.1], [0.05, -0.1], [1e200, 0.1], [0.05, np.inf], [np.nan, 0.1], [np.inf, 0.1]]
    element, barycentric = Locator(mesh).find(np.array(nowhere))
    assert np.all(element == -1)
    assert np.all(np.isnan(barycentric))
    assert Locator(mesh).find_all(np.array([0.3, 0.1])) == []


def test_no_points_and_one_element() -> None:
    """Catches empty arrays, and a tree of a single box."""
    nodes = np.array([[0, 0], [1, 0], [0, 1], [0.5, 0], [0.6, 0.6], [0, 0.5]], dtype=float)
    topology = Topology(np.arange(6)[None], np.arange(6))
    locator = Locator(Mesh("planar", nodes, np.zeros(1, dtype=np.int_), topology))
    element, barycentric = locator.find(np.empty((0, 2)))
    assert element.shape == (0,)
    assert barycentric.shape == (0, 3)
    # The edge from (1, 0) to (0, 1) bulges to (0.6, 0.6): beyond the straight triangle, within the curved one.
    assert locator.find(np.array([[0.59, 0.59], [0.61, 0.61]]))[0].tolist() == [0, -1]


def test_half_a_disc_in_one_element() -> None:
    """Catches corners in a line, whose straight triangle has no area to start from."""
    nodes = np.array([[0, -1], [0, 1], [0, 0], [1, 0], [0, 0.5], [0, -0.5]], dtype=float)
    mesh = Mesh("planar", nodes, np.zeros(1, dtype=np.int_), Topology(np.arange(6)[None], np.arange(6)))
    points = np.array([[0.9, 0.0], [0.3, 0.5], [0.3, -0.5], [0.0, 0.2], [-0.1, 0.0], [0.9, 0.9]])
    element, place = Locator(mesh).find(points)
    assert element.tolist() == [0, 0, 0, 0, -1, -1]
    assert points_of(mesh, element[:4], place[:4]) == pytest.approx(points[:4], abs=1e-9)


def test_a_point_of_the_true_arc_is_reached() -> None:
    """Catches a point on the rim of a drawing lost in the gap between a circle and the parabolas that stand for it."""
    angle = np.pi * np.arange(8) / 4
    ring, middle = ([np.cos(a), np.sin(a)] for a in (angle, angle + np.pi / 8))
    nodes = np.concatenate(([[0.0, 0.0]], np.transpose(ring), np.transpose(middle), np.transpose(ring) / 2))
    k = np.arange(8)
    elements = np.column_stack((0 * k, 1 + k, 1 + (k + 1) % 8, 17 + k, 9 + k, 17 + (k + 1) % 8))
    mesh = Mesh("planar", nodes, np.zeros(8, dtype=np.int_), Topology(elements, np.arange(25)))
    fine = 2 * np.pi * (np.arange(299) + 0.3) / 299
    rim = np.column_stack((np.cos(fine), np.sin(fine)))
    locator = Locator(mesh)
    assert np.count_nonzero(locator.find(rim)[0] < 0) > 200
    element, place = locator.find(rim, reach=1e-2)
    assert np.array_equal(element, (fine // (np.pi / 4)).astype(int)), "the nearest element, not the first in reach"
    assert points_of(mesh, element, place) == pytest.approx(rim, abs=2e-3)
    assert np.all(locator.find(1.3 * rim, reach=1e-2)[0] == -1)
    # Points inside are found as without a reach.
    inside, where = locator.find(0.7 * rim, reach=1e-2)
    assert np.array_equal(inside, locator.find(0.7 * rim)[0])
    assert points_of(mesh, inside, where) == pytest.approx(0.7 * rim, abs=1e-9)
