"""Every item of every example as files for printers and viewers: closed, oriented, as large as the part."""

import struct
from pathlib import Path

import numpy as np
import pytest

from fluxbore import load
from fluxbore.actuators import assembly_of
from fluxbore.geometry.gltf import glb
from fluxbore.geometry.model import PRINTED, VIEWED, shapes
from fluxbore.geometry.part import volume
from fluxbore.geometry.parts_list import parts_list
from fluxbore.geometry.printing import stl
from fluxbore.geometry.surface import enclosed, is_closed, joined

pytestmark = pytest.mark.full

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.mark.parametrize("name", ["ipehla", "rotlin", "prehydra", "fabry", "team22"])
def test_every_stl_is_watertight(name: str) -> None:
    """Read back in single precision, as a slicer does; the volume is the exact one within the facets' error."""
    spec = load(EXAMPLES / f"{name}.toml")
    items = parts_list(assembly_of(spec), spec.materials)
    for shape in shapes(items, PRINTED):
        data = stl(shape.surface, shape.item.name)
        (count,) = struct.unpack_from("<I", data, 80)
        facets = np.frombuffer(data[84:], dtype=[("numbers", "<f4", (4, 3)), ("attribute", "<u2")])["numbers"]
        corners = facets[:, 1:].reshape(-1, 3).astype(float)
        points, triangles = joined(corners, np.arange(3 * count).reshape(-1, 3))
        assert is_closed(triangles), shape.item.name
        assert enclosed(points, triangles) == pytest.approx(volume(shape.item.part) * 1e9, rel=3e-3), shape.item.name


@pytest.mark.parametrize("name", ["ipehla", "rotlin", "prehydra", "fabry", "team22"])
def test_models_are_light_enough_for_a_page(name: str) -> None:
    """Catches a part that is triangulated needlessly fine, and pieces that no longer share a shape."""
    spec = load(EXAMPLES / f"{name}.toml")
    parts = assembly_of(spec)
    items = parts_list(parts, spec.materials)
    found = shapes(items, VIEWED)
    assert len(found) == len(items)
    assert len(glb(parts, found, spec.materials)) < 1_500_000
