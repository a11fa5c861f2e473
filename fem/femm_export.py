"""A machine's cross-section as a model that FEMM opens, to be checked or changed there.

The outer boundary is A = 0 where the machine's own mesh ends, three yoke diameters away, and no Kelvin exterior: the
file stays a plain drawing that people can edit, and an open boundary is one option away (`femm_open`). The machine's
own solution is open there (`asymptotic`): forces and linkages agree to some millionths, the stray field to half a per
cent.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from scipy.ndimage import label as connected

from fluxbore.design.bh_curve import MU_0
from fluxbore.design.materials import PermanentMagnet
from fluxbore.fem.femm_model import (
    BlockLabel,
    BlockProperty,
    BoundaryProperty,
    CircuitProperty,
    FemmModel,
    Node,
    Segment,
)
from fluxbore.fem.mapped import Subdivision
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.tubular import ORDER, R_CELLS, Z_CELLS
from fluxbore.geometry.cross_section import Breakpoints, CrossSection, Region

MOVER, STATOR, COILS = 1, 2, 3
"""Groups. Air is in none; lines and nodes are in the group of what they bound, so that FEMM moves all of it."""

MOVING = ("ring", "magnet", "shaft")
"""First words of the names of the mover's regions."""

AIR = BlockProperty("Air")
COPPER = BlockProperty("Copper", conductivity=58e6)
MILLIMETRE = 1e-3


@dataclass(frozen=True, slots=True)
class Face:
    """What one label stands for. region : index, of what lies there. coil : index, None outside of coils.

    cells : (k, 2) rows and columns of the grid.
    """

    region: int
    coil: int | None
    cells: Ints


@dataclass(frozen=True, slots=True, eq=False)
class Grid:
    """r, z : m, all edges of regions and coils. face : (rows, columns) number of each cell's face."""

    r: Floats
    z: Floats
    face: Ints
    faces: tuple[Face, ...]


def femm_model(section: CrossSection, currents: Mapping[str, float] | None = None, comment: str = "") -> FemmModel:
    """A cross-section with its mover where it is, in millimetres.

    currents : A, by name of the circuit; zero without. comment : of the file.

    FEMM knows whole turns only: where a coil has others, their nearest is written, the current raised for it as one
    current in all coils of a circuit allows, and the comment says by how much linkages differ.
    """
    grid = _grid(section)
    names = list(dict.fromkeys(coil.circuit for coil in section.coils))
    share = {name: _whole(section, name) for name in names}
    currents = currents or {}
    blocks = [AIR]
    labels = tuple(_label(section, grid, face, blocks, names) for face in grid.faces)
    nodes, segments = _lines(section, grid)
    remarks = [comment] if comment else []
    remarks += [
        f"Whole turns: linkages of {name} are {value:.6g} times the design's, currents {1 / value:.6g} times."
        for name, value in share.items()
        if abs(value - 1) > 1e-9
    ]
    return FemmModel(
        True,
        "millimeters",
        comment="\n".join(remarks),
        boundaries=(BoundaryProperty("A=0", "prescribed"),),
        materials=_distinct(blocks),
        circuits=tuple(CircuitProperty(name, currents.get(name, 0.0) / share[name]) for name in names),
        nodes=nodes,
        segments=segments,
        labels=labels,
    )


def _whole(section: CrossSection, circuit: str) -> float:
    """The whole turns of a circuit's coils over their real ones."""
    turns = [abs(coil.turns) for coil in section.coils if coil.circuit == circuit]
    whole = sum(max(round(each), 1) for each in turns)
    return whole / sum(turns) if sum(turns) else 1.0


def _grid(section: CrossSection) -> Grid:
    """The cells of the section, cut at the coils' edges too, and gathered to connected faces of one kind."""
    r = _merged([*section.r.values, *(edge for coil in section.coils for edge in coil.r)])
    z = _merged([*section.z.values, *(edge for coil in section.coils for edge in coil.z)])
    r_middle, z_middle = (r[1:] + r[:-1]) / 2, (z[1:] + z[:-1]) / 2
    region = section.cells[
        np.ix_(np.searchsorted(section.z.values, z_middle) - 1, np.searchsorted(section.r.values, r_middle) - 1)
    ]
    coil = np.full(region.shape, -1)
    for number, window in enumerate(section.coils):
        inside_r = (window.r[0] < r_middle) & (r_middle < window.r[1])
        inside_z = (window.z[0] < z_middle) & (z_middle < window.z[1])
        coil[np.ix_(inside_z, inside_r)] = number
    face = np.zeros(region.shape, dtype=int)
    faces: list[Face] = []
    for kind, winding in sorted(set(zip(region.ravel().tolist(), coil.ravel().tolist(), strict=True))):
        number, count = connected((region == kind) & (coil == winding))
        for k in range(1, count + 1):
            face[number == k] = len(faces)
            faces.append(Face(kind, None if winding < 0 else winding, np.argwhere(number == k)))
    return Grid(r, z, face, tuple(faces))


def _merged(values: list[float]) -> Floats:
    """Sorted; those closer than a thousandth of a micrometre are one."""
    ordered = np.unique(values)
    return ordered[np.concatenate(([True], np.diff(ordered) > MILLIMETRE * 1e-6))]


def _group(section: CrossSection, face: Face) -> int:
    if face.coil is not None:
        return COILS
    if face.region == 0:
        return 0
    return MOVER if section.regions[face.region].name.split()[0] in MOVING else STATOR


def _label(section: CrossSection, grid: Grid, face: Face, blocks: list[BlockProperty], names: list[str]) -> BlockLabel:
    """In the middle of the face's largest cell. Its material is added to the blocks where it is new."""
    rows, columns = face.cells.T
    largest = int(np.argmax(np.minimum(np.diff(grid.z)[rows], np.diff(grid.r)[columns])))
    r = (grid.r[columns[largest]] + grid.r[columns[largest] + 1]) / 2 / MILLIMETRE
    z = (grid.z[rows[largest]] + grid.z[rows[largest] + 1]) / 2 / MILLIMETRE
    size, group = _size(section, grid, face), _group(section, face)
    region = section.regions[face.region]
    if face.coil is not None:
        coil = section.coils[face.coil]
        turns = float(np.copysign(max(round(abs(coil.turns)), 1), coil.turns))
        number = _number(blocks, COPPER)
        return BlockLabel(float(r), float(z), number, size, names.index(coil.circuit), 0.0, group, turns)
    direction = 0.0 if region.remanence == 0 else 90.0 if region.remanence > 0 else 270.0
    number = _number(blocks, _block(region))
    return BlockLabel(float(r), float(z), number, size, None, direction, group)


def _number(blocks: list[BlockProperty], block: BlockProperty) -> int:
    """Of the block among those there are, added where it is new."""
    if block not in blocks:
        blocks.append(block)
    return blocks.index(block)


def _block(region: Region) -> BlockProperty:
    material = region.material
    if material is None:
        return AIR
    if isinstance(material, PermanentMagnet):
        mu = region.recoil_permeability
        return BlockProperty(material.name, mu, mu, abs(region.remanence) / (MU_0 * mu))
    if material.curve is not None:
        return BlockProperty(material.name, curve=tuple(zip(material.curve.b, material.curve.h, strict=True)))
    return BlockProperty(material.name)


def _distinct(blocks: list[BlockProperty]) -> tuple[BlockProperty, ...]:
    """With a name of its own for each, as a magnet's at another temperature."""
    count = Counter[str]()
    found = []
    for block in blocks:
        count[block.name] += 1
        number = count[block.name]
        found.append(block if number == 1 else replace(block, name=f"{block.name} ({number})"))
    return tuple(found)


def _size(section: CrossSection, grid: Grid, face: Face) -> float | None:
    """Side of the elements of the machine's own mesh (mm): along r, and on the mover along z too. Automatic in air."""
    group = _group(section, face)
    if group == 0:
        return None
    rows, columns = face.cells.T
    steps = _steps(section.r, R_CELLS, (grid.r[columns] + grid.r[columns + 1]) / 2)
    if group == MOVER:
        steps += _steps(section.z, Z_CELLS, (grid.z[rows] + grid.z[rows + 1]) / 2)
    return float(f"{min(steps) / MILLIMETRE:.3g}") if steps else None


def _steps(points: Breakpoints, cells: Mapping[str, Subdivision], at: Floats) -> list[float]:
    """Mean side (m) in each of the intervals that hold these places, of quadratic elements with the cells' nodes."""
    intervals = np.unique(np.searchsorted(points.values, at) - 1).tolist()
    return [
        (points.values[k + 1] - points.values[k]) / (ORDER // 2 * cells[name].cells)
        for k in intervals
        if (name := points.intervals[k]) in cells
    ]


def _lines(section: CrossSection, grid: Grid) -> tuple[tuple[Node, ...], tuple[Segment, ...]]:
    """Where two faces meet: from corner to corner, each line once."""
    around = np.pad(grid.face, 1, constant_values=-1)
    groups = np.array([*(_group(section, face) for face in grid.faces), 0])
    # Sides of cells, along z between columns and along r between rows, with the faces on either hand.
    upright = np.stack((around[1:-1, :-1], around[1:-1, 1:]), axis=-1)
    level = np.stack((around[:-1, 1:-1], around[1:, 1:-1]), axis=-1)
    is_upright, is_level = upright[..., 0] != upright[..., 1], level[..., 0] != level[..., 1]
    below, above = np.pad(is_upright, ((1, 0), (0, 0))), np.pad(is_upright, ((0, 1), (0, 0)))
    left, right = np.pad(is_level, ((0, 0), (1, 0))), np.pad(is_level, ((0, 0), (0, 1)))
    corner = (below | above | left | right) & ~((below == above) & (left == right) & (below != left))
    number = np.where(corner, np.cumsum(corner).reshape(corner.shape) - 1, -1)
    places = np.argwhere(corner)
    owner = np.zeros(len(places), dtype=int)
    segments = []
    for sides, present, numbers, vertical in (
        (upright, is_upright, number, True),
        (level.transpose(1, 0, 2), is_level.T, number.T, False),
    ):
        for line in range(present.shape[1]):
            start = -1
            for step in range(present.shape[0]):
                if not present[step, line]:
                    continue
                start = int(numbers[step, line]) if numbers[step, line] >= 0 else start
                end = int(numbers[step + 1, line])
                if end < 0:
                    continue
                beside = sides[step, line]
                group = _first(groups[beside].tolist())
                far = -1 in beside and not (vertical and line == 0)
                segments.append(Segment(start, end, boundary=0 if far else None, group=group))
                for node in (start, end):
                    owner[node] = _first([int(owner[node]), group])
    nodes = tuple(
        Node(float(grid.r[j]) / MILLIMETRE, float(grid.z[i]) / MILLIMETRE, group=int(group))
        for (i, j), group in zip(places.tolist(), owner, strict=True)
    )
    return nodes, tuple(segments)


def _first(groups: list[int]) -> int:
    """The group that a line or node between several belongs to: the mover's before others', none's last."""
    return min((group for group in groups if group), default=0)
