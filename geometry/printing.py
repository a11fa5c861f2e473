"""Files for printing and measuring, in millimetres: binary STL, one of each item, and 3MF, an archive of all parts.

3MF as the Core Specification 1.3 of the 3MF Consortium says: a ZIP archive with content types, relationships and one
model part. Nothing in either file depends on when or where it is written.
"""

from __future__ import annotations

import io
import struct
import zipfile
from collections.abc import Sequence
from typing import TYPE_CHECKING
from xml.sax.saxutils import quoteattr

import numpy as np

from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.model import Shape
from fluxbore.geometry.part import Colour
from fluxbore.geometry.placement import Placement
from fluxbore.geometry.program import program
from fluxbore.geometry.surface import Surface, joined

if TYPE_CHECKING:
    from fluxbore.geometry.surface import Floats, Numbers

MILLIMETRE = 1e-3

DECIMALS = 6
"""Of a coordinate in mm, in 3MF."""

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
MODEL = "3D/3dmodel.model"

CONTENT_TYPES = (
    '<?xml version="1.0" encoding="UTF-8"?>\n'
    '<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">'
    '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
    '<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>'
    "</Types>\n"
)
RELATIONSHIPS = (
    '<?xml version="1.0" encoding="UTF-8"?>\n'
    '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
    f'<Relationship Target="/{MODEL}" Id="rel0" '
    'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>'
    "</Relationships>\n"
)


def stl(surface: Surface, name: str) -> bytes:
    """One shape as binary STL, standing on z = 0. name : for the header, less what is not ASCII."""
    points, triangles = printed(surface)
    points[:, 2] -= points[:, 2].min()
    corners = points[triangles]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(across, axis=1, keepdims=True)
    facets = np.zeros(len(triangles), dtype=[("numbers", "<f4", (4, 3)), ("attribute", "<u2")])
    facets["numbers"][:, 0] = np.divide(across, lengths, out=np.zeros_like(across), where=lengths > 0)
    facets["numbers"][:, 1:] = corners
    # A header that begins with "solid" would pass for a file of text.
    header = f"{program()}, mm: {name}".encode("ascii", "ignore")[:80].ljust(80)
    return header + struct.pack("<I", len(triangles)) + facets.tobytes()


def printed(surface: Surface) -> tuple[Floats, Numbers]:
    """Points (mm, in single precision) that are each there once, and triangles."""
    points, triangles = joined((surface.points / MILLIMETRE).astype(np.float32), surface.triangles)
    return points.astype(np.float64), triangles


def three_mf(assembly: Assembly, shapes: Sequence[Shape]) -> bytes:
    """All parts by name, where they stand in the assembly, moved to where no coordinate is negative."""
    model = "".join(_model(assembly, shapes))
    target = io.BytesIO()
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in (("[Content_Types].xml", CONTENT_TYPES), ("_rels/.rels", RELATIONSHIPS), (MODEL, model)):
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))  # ZIP has no earlier date, and no file a real one
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, text)
    return target.getvalue()


def _model(assembly: Assembly, shapes: Sequence[Shape]) -> list[str]:
    looks = list(dict.fromkeys((part.material or "envelope", part.colour) for s in shapes for part, _ in s.pieces))
    bases = "".join(f'<base name={quoteattr(name)} displaycolor="{_hexadecimal(c)}"/>' for name, c in looks)
    objects, build, number = [], [], 1
    aside = _aside(shapes)
    for shape in shapes:
        meshes: dict[int, int] = {}
        mesh = _mesh(shape.surface)
        for part, place in shape.pieces:
            look = looks.index((part.material or "envelope", part.colour))
            single = len(shape.pieces) == 1
            if look not in meshes:
                number += 1
                meshes[look] = number
                name = part.name if single else shape.item.name
                objects.append(_object(number, name, shape.item.part_number, mesh, f' pid="1" pindex="{look}"'))
            chosen = meshes[look]
            if not single:  # a name of its own for each copy
                number += 1
                inner = f'<components><component objectid="{chosen}"/></components>'
                objects.append(_object(number, part.name, shape.item.part_number, inner))
                chosen = number
            where = _transform(place, aside)
            build.append(f'<item objectid="{chosen}" transform="{where}" partnumber={_number(shape)}/>')
    title = quoteattr(assembly.title.name or assembly.name)[1:-1]
    return [
        f'<?xml version="1.0" encoding="UTF-8"?>\n<model unit="millimeter" xml:lang="en-US" xmlns="{CORE}">',
        f'<metadata name="Title">{title}</metadata>',
        f'<metadata name="Application">{program()}</metadata>',
        f'<resources><basematerials id="1">{bases}</basematerials>',
        *objects,
        "</resources><build>",
        *build,
        "</build></model>\n",
    ]


def _number(shape: Shape) -> str:
    return quoteattr(shape.item.part_number)


def _object(number: int, name: str, part_number: str, inner: str, more: str = "") -> str:
    """pid and pindex may stand with a mesh, not with components."""
    called = f"name={quoteattr(name)} partnumber={quoteattr(part_number)}"
    return f'<object id="{number}" type="model" {called}{more}>{inner}</object>'


def _mesh(surface: Surface) -> str:
    points, triangles = joined(np.round(surface.points / MILLIMETRE, DECIMALS) + 0.0, surface.triangles)
    vertices = "".join(f'<vertex x="{x:.9g}" y="{y:.9g}" z="{z:.9g}"/>' for x, y, z in points.tolist())
    faces = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in triangles.tolist())
    return f"<mesh><vertices>{vertices}</vertices><triangles>{faces}</triangles></mesh>"


def _aside(shapes: Sequence[Shape]) -> Floats:
    """By how much everything is moved (mm): a build plate begins at zero."""
    profiles = [part.profile for shape in shapes for part, _ in shape.pieces]
    reach = max(r for profile in profiles for r, _ in profile)
    low = min(z for profile in profiles for _, z in profile)
    return np.ceil(np.array([reach, reach, -low]) / MILLIMETRE)


def _transform(place: Placement, aside: Floats) -> str:
    """The first three columns of the matrix that rows (x, y, z, 1) are multiplied by, row after row."""
    rows = place.matrix.T[:, :3].copy()
    rows[3] = rows[3] / MILLIMETRE + aside
    return " ".join(f"{value + 0.0:.12g}" for value in np.round(rows, 12).reshape(-1).tolist())


def _hexadecimal(colour: Colour) -> str:
    return "#" + "".join(f"{round(255 * c):02X}" for c in colour) + "FF"
