"""What the pointer reads off a map of the field: the field itself, at the place where it is."""

from __future__ import annotations

import base64
import json
import zlib
from dataclasses import replace

import numpy as np
import pytest

from fluxbore.reports.content import Array, FluxMap
from fluxbore.reports.flux_hover import STEP, field_readout, packed
from fluxbore.reports.svg import new_figure


def unpacked(text: str, columns: int) -> Array:
    """As the page's script does it."""
    low, high = np.frombuffer(zlib.decompress(base64.b64decode(text)), np.uint8).reshape(2, -1)
    differences = (low.astype(np.uint16) | (high.astype(np.uint16) << 8)).astype(np.int16)
    return np.cumsum(differences, dtype=np.int16).reshape(columns, -1) * STEP


@pytest.fixture(scope="module")
def field() -> FluxMap:
    """B_r = r/10 mm and B_z = 1 − z/20 mm on a coarse grid of triangles over 10 mm × 20 mm."""
    r, z = (axis.ravel() for axis in np.meshgrid(np.linspace(0, 0.01, 41), np.linspace(0, 0.02, 81), indexing="ij"))
    number = np.arange(r.size).reshape(41, 81)
    a, b, c, d = (item.ravel() for item in (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]))
    triangles = np.concatenate((np.stack((a, b, c), -1), np.stack((a, c, d), -1)))
    middle_r, middle_z = r[triangles].mean(1), z[triangles].mean(1)
    components = np.column_stack((middle_r / 0.01, 1 - middle_z / 0.02))
    outline = np.array([(0.002, 0.005), (0.006, 0.005), (0.006, 0.015), (0.002, 0.015)])
    parts = (("magnet", outline), ("far away", outline + np.array([0.0, 0.1])))
    return FluxMap(r, z, triangles, r**2, np.hypot(*components.T), parts, 0.0, None, components)


@pytest.mark.parametrize("mirrored", [False, True])
def test_the_field_is_read_where_it_is(field: FluxMap, mirrored: bool) -> None:
    """Catches components or axes that are exchanged, and rows of the grid in another order than the page's."""
    plot = new_figure(500.0, 300.0).subplots()
    plot.set_xlim(2.0, 18.0)
    plot.set_ylim(-9.0 if mirrored else 0.0, 9.0)
    (found,) = field_readout(plot, field)
    grid = found["field"]
    z, r = (grid[axis]["start"] + grid[axis]["step"] * np.arange(grid[axis]["count"]) for axis in "zr")
    assert z[0] > 2.0 - 1e-9
    assert r[0] > 0
    assert abs(z[-1] - 18.0) < grid["z"]["step"]
    assert abs(r[-1] - 9.0) < grid["r"]["step"]
    radial, axial, size = (item.reshape(r.size, z.size) for item in unpacked(grid["samples"], 3))
    coarse = 0.026  # of a triangle's middle from a point in it, and the page's step of B
    np.testing.assert_allclose(radial, np.broadcast_to(r[:, None] / 10, radial.shape), atol=coarse)
    np.testing.assert_allclose(axial, np.broadcast_to(1 - z / 20, axial.shape), atol=coarse)
    np.testing.assert_allclose(size, np.hypot(radial, axial), atol=2 * STEP)
    assert [name for name, _ in found["parts"]] == ["magnet"]
    assert found["parts"][0][1][0] == [5.0, 2.0]
    assert len(json.dumps(found, allow_nan=False)) < 60_000


def test_a_jump_of_many_tesla_survives() -> None:
    """Catches a difference that does not fit into 16 bits, and a field at a sharp corner that wraps round."""
    values = np.array([[-60.0, 0.0], [60.0, 1.0], [-60.0, -1.0], [1e6, 0.002]])
    found = unpacked(packed(values), 2)
    np.testing.assert_allclose(found[0], [-60.0, 60.0, -60.0, 64.0], atol=STEP)
    np.testing.assert_allclose(found[1], values[:, 1], atol=STEP)


def test_without_components_there_is_nothing_to_read(field: FluxMap) -> None:
    """Catches a pointer over a map whose content has no more than |B|."""
    assert field_readout(new_figure(500.0, 300.0).subplots(), replace(field, components=None)) == ()
