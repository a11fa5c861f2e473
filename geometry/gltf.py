"""Assemblies as GLB, the binary form of glTF 2.0: metres, y upwards, a node for each part, a mesh for each shape.

Written directly: a header, JSON and arrays are less code than what a library wants to be told, and only here do pieces
of one shape share their mesh and get the materials that their names say.
"""

from __future__ import annotations

import json
import math
import struct
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from fluxbore.design.material_kinds import Material, Structural
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.model import Shape
from fluxbore.geometry.part import Body, Colour
from fluxbore.geometry.placement import Placement
from fluxbore.geometry.program import program
from fluxbore.geometry.surface import Surface

POINT_STEP, NORMAL_STEP = 2.0**-23, 2.0**-12
"""m, and 1: to what points and normals are rounded, so that half of their bytes are zero and a file packs well."""

Y_UP = [-math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)]
"""The quaternion that lays z, the axis of an actuator, along glTF's y."""

CONDUCTS = 4.0
"""W/(m K). Structural materials that conduct heat better are metals."""

FLOAT, SHORT, INT = 5126, 5123, 5125
POINTS_TARGET, INDICES_TARGET = 34962, 34963


def glb(assembly: Assembly, shapes: Sequence[Shape], materials: Mapping[str, Material]) -> bytes:
    """The file. Nodes and their ``extras`` tell item, part number, material, mass (kg) and group of every part."""
    writer = _Writer(materials)
    groups: dict[str, list[int]] = {}
    for shape in shapes:
        accessors = writer.surface(shape.surface)
        for part, place in shape.pieces:
            groups.setdefault(part.group, []).append(writer.part(shape, part, place, accessors))
    children = [writer.node({"name": name, "children": nodes}) for name, nodes in groups.items()]
    root = writer.node({"name": assembly.title.name or assembly.name, "rotation": Y_UP, "children": children})
    return writer.file(root)


def linear(colour: Colour) -> list[float]:
    """A colour of sRGB in linear light (IEC 61966-2-1), as glTF's factors are."""
    return [round(c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4, 6) for c in colour]


def finish(material: Material | None) -> tuple[float, float]:
    """Metallic and roughness factors. Metals are half metallic only: wholly so they are black wherever a viewer has no
    surroundings for them to mirror."""
    if material is None:
        return 0.0, 0.8
    if isinstance(material, Structural) and (material.thermal_conductivity or 0.0) < CONDUCTS:
        return 0.0, 0.6
    return 0.5, 0.4


class _Writer:
    """Collects the lists of a glTF document and its one buffer."""

    def __init__(self, materials: Mapping[str, Material]) -> None:
        self.library = materials
        self.lists: dict[str, list[dict[str, Any]]] = {}
        self.known: dict[tuple[Any, ...], int] = {}
        self.buffer = bytearray()

    def add(self, name: str, value: dict[str, Any]) -> int:
        found = self.lists.setdefault(name, [])
        found.append(value)
        return len(found) - 1

    def node(self, value: dict[str, Any]) -> int:
        return self.add("nodes", value)

    def once(self, name: str, key: tuple[Any, ...], value: dict[str, Any]) -> int:
        if (name, *key) not in self.known:
            self.known[name, *key] = self.add(name, value)
        return self.known[name, *key]

    def surface(self, surface: Surface) -> dict[str, int]:
        points = (np.round(surface.points / POINT_STEP) * POINT_STEP).astype("<f4")
        normals = (np.round(surface.normals / NORMAL_STEP) * NORMAL_STEP).astype("<f4")
        kind, of = (SHORT, "<u2") if len(points) < 2**16 - 1 else (INT, "<u4")
        return {
            "POSITION": self.array(points, FLOAT, "VEC3", POINTS_TARGET, bounds=True),
            "NORMAL": self.array(normals, FLOAT, "VEC3", POINTS_TARGET),
            "indices": self.array(surface.triangles.reshape(-1).astype(of), kind, "SCALAR", INDICES_TARGET),
        }

    def array(self, values: Any, kind: int, shape: str, target: int, *, bounds: bool = False) -> int:
        self.buffer += bytes(-len(self.buffer) % 4)
        raw = values.tobytes()
        view = {"buffer": 0, "byteOffset": len(self.buffer), "byteLength": len(raw), "target": target}
        self.buffer += raw
        accessor = {
            "bufferView": self.add("bufferViews", view),
            "componentType": kind,
            "count": len(values),
            "type": shape,
        }
        if bounds:
            accessor |= {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}
        return self.add("accessors", accessor)

    def part(self, shape: Shape, part: Body, place: Placement, accessors: dict[str, int]) -> int:
        item = shape.item
        attributes = {name: accessors[name] for name in ("POSITION", "NORMAL")}
        primitive = {"attributes": attributes, "indices": accessors["indices"], "material": self.material(part)}
        mesh = self.once(
            "meshes", (*accessors.values(), primitive["material"]), {"name": item.name, "primitives": [primitive]}
        )
        extras = {
            "item": item.number,
            "part_number": item.part_number,
            "material": part.material,
            "mass": item.mass,
            "group": part.group,
            "source": item.source,
        }
        where: dict[str, Any] = {}
        if place.flipped or place.angle:
            where["rotation"] = list(place.quaternion)
        if place.shift:
            where["translation"] = [0.0, 0.0, place.shift]
        return self.node({"name": part.name, "mesh": mesh, **where, "extras": extras})

    def material(self, part: Body) -> int:
        metallic, rough = finish(self.library.get(part.material))
        look = {
            "baseColorFactor": [*linear(part.colour), 1.0],
            "metallicFactor": metallic,
            "roughnessFactor": rough,
        }
        name = part.material or "envelope"
        return self.once("materials", (name, part.colour), {"name": name, "pbrMetallicRoughness": look})

    def file(self, root: int) -> bytes:
        self.buffer += bytes(-len(self.buffer) % 4)
        document = {
            "asset": {"version": "2.0", "generator": program()},
            "scene": 0,
            "scenes": [{"nodes": [root]}],
            **self.lists,
            "buffers": [{"byteLength": len(self.buffer)}],
        }
        text = json.dumps(document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
        chunks += struct.pack("<II", len(self.buffer), 0x004E4942) + bytes(self.buffer)
        return struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks
