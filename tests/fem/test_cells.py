"""Cells of a mapped mesh against its elements one by one: fields, sums over points, and who is mirrored."""

import numpy as np
import pytest
from small_motor import small_section, solved

from fluxbore.fem.cells import Cells
from fluxbore.fem.element import kernel
from fluxbore.fem.mesh import Floats


@pytest.fixture(scope="module")
def cells() -> Cells:
    return Cells(solved(small_section()).grid)


@pytest.fixture(scope="module")
def field(cells: Cells) -> Floats:
    s = cells.grid.mesh.nodes[:, 0]
    return np.asarray(s * np.random.default_rng(7).uniform(-1, 1, s.size))


def test_a_cell_is_two_elements(cells: Cells, field: Floats) -> None:
    """Catches a node in another's place, in mirrored cells too: B of both triangles, in whatever order of points."""
    mesh = cells.grid.mesh
    curl = kernel(mesh).curl
    expected = np.einsum("mqkn,mn->kmq", curl, field[mesh.elements]).reshape(2, cells.nodes.shape[0], -1)
    for found, own in zip(cells.fields(field), expected, strict=True):
        scale = np.abs(own).max(axis=1, keepdims=True)
        assert np.sort(found) / scale == pytest.approx(np.sort(own) / scale, abs=1e-10)


def test_weights_and_places(cells: Cells) -> None:
    """Catches a share that belongs to another point: ∫ ds dz and ∫ s ds dz over each cell, exactly."""
    lines = cells.grid.r_nodes[::2]
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
        assert (pull(factor) * values).sum(axis=1) == pytest.approx((factor * own).sum(axis=1), rel=1e-9, abs=1e-12)


def test_by_lines_one_field_or_many(cells: Cells, field: Floats) -> None:
    """Catches near and far lines that change places: sums by nodes, contracted before or after they are gathered."""
    rng = np.random.default_rng(9)
    by_s, by_z = rng.uniform(-1, 1, (2, cells.nodes.shape[0], 9)), rng.uniform(-1, 1, cells.nodes.shape)
    fields = np.column_stack((field, field[::-1]))
    s, z = cells.on_lines_of(by_s, by_z, fields)
    for k in range(2):
        values = fields[cells.nodes, k]
        one_s, one_z = cells.on_lines((by_s * values).sum(axis=-1), (by_z * values).sum(axis=-1))
        assert s[:, k] == pytest.approx(one_s, rel=1e-9, abs=1e-12 * np.abs(one_s).max())
        assert z[:, k] == pytest.approx(one_z, rel=1e-9, abs=1e-12 * np.abs(one_z).max())
