"""A solution as a VTK file of an unstructured grid, which ParaView and PyVista open.

The elements are VTK's quadratic triangles (type 22), whose nodes are in our own order, in metres, z = 0; an
axisymmetric problem has r along x and z along y. Nodes on an interface are there once for each block, so that B and H
keep their jumps.
"""

from __future__ import annotations

import zlib
from base64 import b64encode
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from fluxbore.fem.femm_solution import FemmSolution
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.probe import field_in

QUADRATIC_TRIANGLE = 22

NODES = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [0.5, 0.5, 0], [0, 0.5, 0.5], [0.5, 0, 0.5]], dtype=float)
"""(6, 3) barycentric coordinates of an element's nodes."""

_TYPES = {"f8": "Float64", "i8": "Int64", "u1": "UInt8"}


def vtu(solution: FemmSolution) -> bytes:
    """The file's bytes: the same solution gives the same file.

    At points: A (Wb/m); r A (Wb/rad) of an axisymmetric problem; B (T); H (A/m). Of cells: block and material, numbers
    from 0 in the file's order, and group. Materials' names are in the field data.
    """
    solved, model = solution.solution, solution.model
    mesh = solved.problem.mesh
    cells, node, element, corner = _sided(mesh.elements, mesh.region, mesh.nodes.shape[0])
    positions = mesh.positions[node]
    field = field_in(solved, solution.field, element, NODES[corner], positions)
    potential = field.potential
    at_points = {}
    if model.axisymmetric:
        at_points["r A"] = potential
        potential = np.divide(potential, positions[:, 0], out=np.zeros_like(potential), where=positions[:, 0] > 0)
    at_points = {"A": potential, **at_points, "B": _space(field.flux_density), "H": _space(field.field_strength)}
    material = np.array([-1 if label.material is None else label.material for label in model.labels])
    group = np.array([label.group for label in model.labels])
    of_cells = {"block": mesh.region, "material": material[mesh.region], "group": group[mesh.region]}
    count = cells.shape[0]
    parts = [
        '<?xml version="1.0"?>',
        '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64"'
        ' compressor="vtkZLibDataCompressor">',
        "<UnstructuredGrid>",
        f"<FieldData>{_names([material.name for material in model.materials])}</FieldData>",
        f'<Piece NumberOfPoints="{node.size}" NumberOfCells="{count}">',
        "<PointData>",
        *(_array(name, values) for name, values in at_points.items()),
        "</PointData><CellData>",
        *(_array(name, values) for name, values in of_cells.items()),
        "</CellData><Points>",
        _array("Points", _space(positions)),
        "</Points><Cells>",
        _array("connectivity", cells.ravel()),
        _array("offsets", 6 * np.arange(1, count + 1)),
        _array("types", np.full(count, QUADRATIC_TRIANGLE, dtype=np.uint8)),
        "</Cells></Piece></UnstructuredGrid></VTKFile>\n",
    ]
    return "\n".join(parts).encode()


def _sided(elements: Ints, region: Ints, count: int) -> tuple[Ints, Ints, Ints, Ints]:
    """Nodes that are each of one region: the elements (m, 6) in these, and of each of them (k,) the node that it was,
    an element that has it, and which of the element's nodes it is."""
    codes, first, place = np.unique(region[:, None] * count + elements, return_index=True, return_inverse=True)
    return place.reshape(elements.shape), codes % count, first // 6, first % 6


def _space(vectors: Floats) -> Floats:
    """(k, 3) with a third component of zero."""
    return np.column_stack((vectors, np.zeros(vectors.shape[0])))


def _array(name: str, values: NDArray[Any]) -> str:
    """A DataArray in base64 of one block of zlib's."""
    kind = "f8" if values.dtype.kind == "f" else "u1" if values.dtype == np.uint8 else "i8"
    raw = np.ascontiguousarray(values, dtype=f"<{kind}").tobytes()
    squeezed = zlib.compress(raw, 6)
    # Blocks, their size, the last one's where it is less, and each one's size when compressed.
    header = np.array([1, len(raw), 0, len(squeezed)], dtype="<u8").tobytes()
    components = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
    text = (b64encode(header) + b64encode(squeezed)).decode()
    return f'<DataArray type="{_TYPES[kind]}" Name={quoteattr(name)}{components} format="binary">{text}</DataArray>'


def _names(names: list[str]) -> str:
    """Strings as VTK has them: the codes of their bytes, each string ended by a zero."""
    codes = " ".join(str(code) for name in names for code in (*name.replace("\0", " ").encode(), 0))
    return f'<Array type="String" Name="material names" NumberOfTuples="{len(names)}" format="ascii">{codes}</Array>'
