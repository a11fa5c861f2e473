"""Cells of a mapped mesh: fields of polynomials, sums over points, lines."""

import numpy as np
import pytest
from small_motor import small_section, solved

from fluxbore.fem.cells import Cells, cell_nodes
from fluxbore.fem.mesh import Floats
from fluxbore.fem.tensor_product import side, square


@pytest.fixture(scope="module")
def cells() -> Cells:
    return Cells(solved(small_section()).grid)


@pytest.fixture(scope="module")
def field(cells: Cells) -> Floats:
    s = cells.grid.mesh.nodes[:, 0]
    return np.asarray(s * np.random.default_rng(7).uniform(-1, 1, s.size))


@pytest.mark.parametrize("order", [2, 4])
def test_polynomials_of_a_side(order: int) -> None:
    """Catches a polynomial that is not one at its node and zero at the others, and a slope that is not its own."""
    one = side(order)
    nodes = np.arange(order + 1) / order
    assert one.values(nodes) == pytest.approx(np.eye(order + 1), abs=1e-12)
    t, step = np.linspace(0, 1, 7), 1e-6
    assert one.slopes(t) == pytest.approx((one.values(t + step) - one.values(t - step)) / (2 * step), abs=1e-7)


@pytest.mark.parametrize("order", [2, 4])
def test_nodes_on_the_edge_come_first(order: int) -> None:
    """Catches a node inside of a cell that another cell has too: condensation would lose it."""
    shape, nodes = square(order), cell_nodes(3, 4, order)
    assert shape.edge == 4 * order
    counts = np.bincount(nodes.ravel())
    assert np.all(counts[nodes[:, shape.edge :]] == 1)
    assert counts.size == (3 * order + 1) * (4 * order + 1)


def test_fields_of_a_polynomial(cells: Cells) -> None:
    """Catches a node in another's place: ψ = s² z³ is held exactly by a cell of fourth order."""
    s, z = cells.grid.mesh.nodes.T
    lines = cells.grid.r_nodes[:: cells.grid.order]
    columns = np.arange(cells.region.size) % cells.shape[1]
    at_s = lines[columns][:, None] + cells.width * cells.share
    at_z = cells.grid.z_lines[np.arange(cells.region.size) // cells.shape[1]][:, None] + cells.height * np.repeat(
        cells.share[: cells.square.order + 1], cells.square.order + 1
    )
    across, along = cells.fields(s**2 * z**3)
    assert across == pytest.approx(2 * at_s * at_z**3, rel=1e-8, abs=1e-9 * np.abs(across).max())
    assert along == pytest.approx(3 * at_s**2 * at_z**2 / np.sqrt(2 * at_s), rel=1e-6, abs=1e-8 * np.abs(along).max())


def test_weights_and_places(cells: Cells) -> None:
    """Catches a share that belongs to another point: ∫ ds dz and ∫ s ds dz over each cell, exactly."""
    lines = cells.grid.r_nodes[:: cells.grid.order]
    area = np.outer(np.diff(cells.grid.z_lines), np.diff(lines)).ravel()
    assert cells.weight.sum(axis=1) == pytest.approx(area, rel=1e-13)
    middle = np.tile((lines[1:] + lines[:-1]) / 2, cells.shape[0])
    assert (cells.weight / (2 * cells.metric)).sum(axis=1) == pytest.approx(area * middle, rel=1e-12)


def test_sums_are_the_fields_transposed(cells: Cells, field: Floats) -> None:
    """Catches a factor that one way has and the other has not."""
    factors = np.random.default_rng(8).uniform(-1, 1, (2, *cells.weight.shape))
    across, along = cells.fields(field)
    values = field[cells.nodes]
    for factor, own, pull in ((factors[0], across, cells.pull_across), (factors[1], along, cells.pull_along)):
        found, expected = (pull(factor) * values).sum(axis=1), (factor * own).sum(axis=1)
        assert found == pytest.approx(expected, rel=1e-9, abs=1e-10 * np.abs(expected).max())


def test_by_lines_one_field_or_many(cells: Cells, field: Floats) -> None:
    """Catches near and far lines that change places: sums by nodes, contracted before or after they are gathered."""
    rng = np.random.default_rng(9)
    n = cells.square.nodes
    by_s, by_z = rng.uniform(-1, 1, (2, cells.nodes.shape[0], n)), rng.uniform(-1, 1, cells.nodes.shape)
    fields = np.column_stack((field, field[::-1]))
    s, z = cells.on_lines_of(by_s, by_z, fields)
    for k in range(2):
        values = fields[cells.nodes, k]
        one_s, one_z = cells.on_lines((by_s * values).sum(axis=-1), (by_z * values).sum(axis=-1))
        assert s[:, k] == pytest.approx(one_s, rel=1e-9, abs=1e-12 * np.abs(one_s).max())
        assert z[:, k] == pytest.approx(one_z, rel=1e-9, abs=1e-12 * np.abs(one_z).max())
