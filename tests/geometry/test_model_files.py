"""GLB, STL and 3MF of a small assembly, read back by readers of this file's own."""

import dataclasses
import io
import json
import math
import struct
import zipfile
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from fluxbore.design.materials import standard
from fluxbore.design.title_block import TitleBlock
from fluxbore.geometry import gltf, helix
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.model import PRINTED, VIEWED, Shape, shapes
from fluxbore.geometry.outline import rectangle
from fluxbore.geometry.part import AxialHole, Hole, Part, mass, volume
from fluxbore.geometry.parts_list import parts_list
from fluxbore.geometry.placement import Placement
from fluxbore.geometry.printing import CORE, stl, three_mf
from fluxbore.geometry.surface import enclosed, is_closed, joined

MM = 1e-3
RED, BLUE, GREY = (0.8, 0.1, 0.1), (0.1, 0.2, 0.8), (0.5, 0.5, 0.5)

CAP = Part(
    "cap, left", "cap", "stator", "aluminium 6061", GREY,
    ((3 * MM, 0.0), (20 * MM, 0.0), (20 * MM, 5 * MM), (10 * MM, 5 * MM), (10 * MM, 8 * MM), (3 * MM, 8 * MM)),
    holes=(Hole(2.5 * MM, 2 * MM, 0.7, 12 * MM),),
    axial_holes=tuple(AxialHole(15 * MM, 3 * MM, 0.0, 5 * MM, 1.7 + i * math.pi / 2) for i in range(3)),
)  # fmt: skip


def flipped(part: Part, name: str, top: float) -> Part:
    """The same part end for end, its face at ``top``."""
    return dataclasses.replace(
        part,
        name=name,
        profile=tuple((r, top - z) for r, z in reversed(part.profile)),
        holes=tuple(dataclasses.replace(h, z=top - h.z, angle=-h.angle) for h in part.holes),
        axial_holes=tuple(
            dataclasses.replace(h, start=top - h.end, end=top - h.start, angle=-h.angle) for h in part.axial_holes
        ),
    )


def magnet(i: int) -> Part:
    profile = rectangle(4 * MM, 9 * MM, (10 + 7 * i) * MM, (16 + 7 * i) * MM)
    return Part(f"magnet {i + 1}", "magnet", "mover", "N42", (RED, BLUE)[i % 2], profile)


def arc(i: int) -> HelicalPart:
    outline = helix.arc(6 * MM, 2 * MM, 0.9, 1.1 * i, 10 * MM + i * 6 * MM * 1.1 / math.tau)
    return HelicalPart(f"arc <{i}>", "arc", "mover", "N42", RED, 10 * MM, 12 * MM, outline, 6 * MM)


PARTS = (CAP, flipped(CAP, "cap, right", 60 * MM), *(magnet(i) for i in range(4)), *(arc(i) for i in range(5)))
WHOLE = Assembly("toy", PARTS, 0.0, title=TitleBlock("toy & co", "TOY", "TOY"))
ITEMS = parts_list(WHOLE, standard())
FOUND = shapes(ITEMS, VIEWED)


class Glb:
    """A file's document and its buffer."""

    def __init__(self, data: bytes) -> None:
        magic, version, length = struct.unpack_from("<III", data)
        assert (magic, version, length) == (0x46546C67, 2, len(data))
        size, kind = struct.unpack_from("<II", data, 12)
        assert (kind, size % 4) == (0x4E4F534A, 0)
        self.document: dict[str, Any] = json.loads(data[20 : 20 + size])
        rest, kind = struct.unpack_from("<II", data, 20 + size)
        assert (kind, 28 + size + rest) == (0x004E4942, length)
        self.buffer = data[28 + size :]

    def array(self, index: int) -> Any:
        accessor = self.document["accessors"][index]
        view = self.document["bufferViews"][accessor["bufferView"]]
        kind = {5126: "<f4", 5123: "<u2", 5125: "<u4"}[accessor["componentType"]]
        width = {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
        raw = np.frombuffer(self.buffer, kind, accessor["count"] * width, view["byteOffset"])
        assert raw.nbytes == view["byteLength"]
        return raw.reshape(-1, width) if width > 1 else raw

    def parts(self) -> dict[str, tuple[Any, Any]]:
        """Points (m, where they stand, y upwards) and triangles by the parts' names."""
        found: dict[str, tuple[Any, Any]] = {}
        for root in self.document["scenes"][self.document["scene"]]["nodes"]:
            self._walk(root, np.eye(4), found)
        return found

    def _walk(self, index: int, above: Any, found: dict[str, tuple[Any, Any]]) -> None:
        node = self.document["nodes"][index]
        here = np.eye(4)
        x, y, z, w = node.get("rotation", (0, 0, 0, 1))
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        here[:3, :3] += 2 * w * cross + 2 * cross @ cross
        here[:3, 3] = node.get("translation", (0, 0, 0))
        here = above @ here
        if "mesh" in node:
            (primitive,) = self.document["meshes"][node["mesh"]]["primitives"]
            points = self.array(primitive["attributes"]["POSITION"]).astype(float)
            assert node["name"] not in found
            found[node["name"]] = points @ here[:3, :3].T + here[:3, 3], self.array(primitive["indices"]).reshape(-1, 3)
        for child in node.get("children", ()):
            self._walk(child, here, found)


@pytest.fixture(scope="module")
def model() -> Glb:
    return Glb(gltf.glb(WHOLE, FOUND, standard()))


def test_copies_share_a_shape() -> None:
    """Two caps end for end, four magnets and five arcs are three shapes: catches a lost or a doubled piece, too."""
    assert [len(shape.pieces) for shape in FOUND] == [2, 4, 5]
    assert sorted(part.name for shape in FOUND for part, _ in shape.pieces) == sorted(part.name for part in PARTS)


def test_glb_has_every_part_in_metres_where_it_stands(model: Glb) -> None:
    """z of the model is y of the file. Catches millimetres, z left upwards, copies at wrong places, open surfaces."""
    found = model.parts()
    assert set(found) == {part.name for part in PARTS}
    for part in PARTS:
        points, triangles = found[part.name]
        low, high = points[:, 1].min(), points[:, 1].max()
        heights = [z for _, z in part.profile]
        assert (low, high) == pytest.approx((min(heights), max(heights)), abs=2e-7)
        assert np.hypot(points[:, 0], points[:, 2]).max() == pytest.approx(max(r for r, _ in part.profile), abs=2e-7)
        welded, faces = joined(np.round(points, 8), triangles)
        assert is_closed(faces)
        assert enclosed(welded, faces) == pytest.approx(volume(part), rel=1e-2)


def test_glb_drillings_face_where_the_parts_have_them(model: Glb) -> None:
    """The right cap's radial drilling, seen in the file: a copy mirrored instead of turned would have it elsewhere."""
    for part in PARTS[:2]:
        assert isinstance(part, Part)
        points, _ = model.parts()[part.name]
        # Corners of the flat bottom lie at its distance from the axis along the drilling, and nowhere else.
        (hole,) = part.holes
        along = points @ [math.cos(hole.angle), 0.0, -math.sin(hole.angle)]
        across = points @ [math.sin(hole.angle), 0.0, math.cos(hole.angle)]
        near = (np.abs(along - hole.bottom) < 1e-6) & (np.abs(across) < hole.diameter / 2 + 1e-6)
        assert np.sum(near & (np.abs(points[:, 1] - hole.z) < hole.diameter / 2 + 1e-6)) >= 8


def test_glb_names_numbers_and_materials(model: Glb) -> None:
    nodes = {node["name"]: node for node in model.document["nodes"]}
    assert nodes["toy & co"]["children"] == [
        i for i, node in enumerate(model.document["nodes"]) if node["name"] in ("stator", "mover")
    ]
    extras = nodes["magnet 2"]["extras"]
    weight = mass(PARTS[3], standard()["N42"].density)
    assert extras == {
        "item": 2, "part_number": "TOY-002", "material": "N42", "mass": weight, "group": "mover", "source": "make",
    }  # fmt: skip
    meshes, materials = model.document["meshes"], model.document["materials"]
    looks = [
        materials[meshes[nodes[name]["mesh"]]["primitives"][0]["material"]]["pbrMetallicRoughness"]
        for name in ("magnet 1", "magnet 2", "cap, left")
    ]
    assert looks[0]["baseColorFactor"] == pytest.approx(
        [0.603827, 0.010023, 0.010023, 1.0], abs=1e-5
    )  # by the standard
    assert looks[0]["baseColorFactor"] != looks[1]["baseColorFactor"]
    # Polarity is a colour, not a shape: both magnets have the same points.
    first, second = (meshes[nodes[name]["mesh"]]["primitives"][0]["attributes"] for name in ("magnet 1", "magnet 2"))
    assert first == second


def test_glb_bounds_and_normals(model: Glb) -> None:
    for mesh in model.document["meshes"]:
        (primitive,) = mesh["primitives"]
        index = primitive["attributes"]["POSITION"]
        points, accessor = model.array(index), model.document["accessors"][index]
        assert (accessor["min"], accessor["max"]) == (points.min(axis=0).tolist(), points.max(axis=0).tolist())
        normals = model.array(primitive["attributes"]["NORMAL"])
        assert np.linalg.norm(normals, axis=1) == pytest.approx(1.0, abs=5e-4)
        assert model.array(primitive["indices"]).max() < len(points)


def test_metals_shine_and_plastics_do_not() -> None:
    library = standard()
    assert gltf.finish(library["stainless steel 304"]) == gltf.finish(library["N42"]) == (0.5, 0.4)
    assert gltf.finish(library["POM"])[0] == 0.0
    assert gltf.finish(None)[0] == 0.0


@pytest.mark.parametrize("shape", shapes(ITEMS, PRINTED), ids=lambda shape: shape.item.name)
def test_stl_is_watertight_and_as_large_as_the_part(shape: Shape) -> None:
    """Binary, millimetres, from z = 0; every edge twice after equal corners are one, facets facing outwards."""
    data = stl(shape.surface, "é" + shape.item.name)
    assert not data.startswith(b"solid")
    (count,) = struct.unpack_from("<I", data, 80)
    assert len(data) == 84 + 50 * count
    facets = np.frombuffer(data[84:], dtype=[("numbers", "<f4", (4, 3)), ("attribute", "<u2")])["numbers"].astype(float)
    corners = facets[:, 1:].reshape(-1, 3)
    points, triangles = joined(corners, np.arange(3 * count).reshape(-1, 3))
    assert len(triangles) == count
    assert is_closed(triangles)
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    assert set(np.unique(sides, axis=0, return_counts=True)[1]) == {2}
    assert enclosed(points, triangles) == pytest.approx(volume(shape.item.part) * 1e9, rel=5e-3)
    assert points[:, 2].min() == 0.0
    across = np.cross(facets[:, 2] - facets[:, 1], facets[:, 3] - facets[:, 1])
    large = np.linalg.norm(across, axis=1) > 1e-4
    assert np.einsum("ij,ij->i", across, facets[:, 0])[large].min() > 0


def test_3mf_is_a_package_of_closed_named_coloured_parts() -> None:
    """Content types, relationships, unit, resources before use, no negative coordinate: what the Core Specification
    asks for and slicers refuse to do without."""
    data = three_mf(WHOLE, FOUND)
    assert data == three_mf(WHOLE, FOUND)
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert archive.namelist() == ["[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"]
        types, relations, root = (ElementTree.fromstring(archive.read(name)) for name in archive.namelist())
    assert {child.get("Extension") for child in types} == {"rels", "model"}
    assert [child.get("Target") for child in relations] == ["/3D/3dmodel.model"]
    assert root.tag == f"{{{CORE}}}model"
    assert root.get("unit") == "millimeter"
    space = {"m": CORE}
    assert root.findtext("m:metadata[@name='Title']", namespaces=space) == "toy & co"
    colours = [base.get("displaycolor") for base in root.iterfind(".//m:base", space)]
    assert sorted(filter(None, colours)) == ["#1A33CCFF", "#808080FF", "#CC1A1AFF"]
    objects = {found.get("id"): found for found in root.iterfind(".//m:object", space)}
    placed = []
    for item in root.iterfind("m:build/m:item", space):
        found = objects[item.get("objectid")]
        placed.append(found.get("name"))
        inner = found.find("m:components/m:component", space)
        mesh = objects[inner.get("objectid")] if inner is not None else found
        assert int(mesh.get("pindex", "-1")) in range(len(colours))
        points = np.array([[float(v.get(k, "nan")) for k in "xyz"] for v in mesh.iterfind(".//m:vertex", space)])
        corners = ("v1", "v2", "v3")
        faces = np.array([[int(t.get(k, "-1")) for k in corners] for t in mesh.iterfind(".//m:triangle", space)])
        assert is_closed(faces)
        rows = np.array((item.get("transform") or "").split(), dtype=float).reshape(4, 3)
        where = points @ rows[:3] + rows[3]
        assert where.min() >= 0
        part = WHOLE.part(str(found.get("name")))
        assert enclosed(where, faces) == pytest.approx(volume(part) * 1e9, rel=1e-2)
        assert np.ptp(where[:, 2]) == pytest.approx(np.ptp([z for _, z in part.profile]) * 1e3, abs=1e-5)
    assert sorted(map(str, placed)) == sorted(part.name for part in PARTS)


def test_a_piece_that_is_no_copy_has_a_shape_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """And the first piece always has one, whatever stands in the others' way: catches a list that never ends."""
    monkeypatch.setattr("fluxbore.geometry.model.placement", lambda first, other: None)
    apart = shapes(ITEMS[1:2], VIEWED)
    assert [[(part.name, place) for part, place in shape.pieces] for shape in apart] == [
        [(f"magnet {i + 1}", Placement())] for i in range(4)
    ]
