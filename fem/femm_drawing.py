"""What the rows of a FEMM file draw: points, segments, arcs, holes and block labels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from fluxbore.design.errors import SpecError
from fluxbore.fem.femm_model import Arc, BlockLabel, Hole, Node, Segment
from fluxbore.fem.femm_properties import unsupported
from fluxbore.fem.femm_text import FemmText, Property, Row
from fluxbore.fem.formula import parse_formula

LARGEST_LENGTH = 1e6
"""m, of a coordinate: beyond it stands a wrong number."""

MOST_TURNS = 1e9

ON_AXIS = 1e-6
"""Of the file's unit: a node this near to the axis is on it, as in FEMM. A gap of rounding's width, with no
condition on its far side, would be a hole along the axis through which flux passes at will."""

THINNEST_HOLE, ROUNDING = 1e-4, 1e-9
"""Of the drawing's size: wider holes along the axis are meant, in a file of micrometres whose unit is the metre; less
is rounding, in any unit."""

ANGLE_TOLERANCE = 1e-9
"""Of 180 degrees: how far a half circle may be above it by rounding."""


@dataclass(frozen=True, slots=True)
class Drawing:
    nodes: tuple[Node, ...]
    segments: tuple[Segment, ...]
    arcs: tuple[Arc, ...]
    holes: tuple[Hole, ...]
    labels: tuple[BlockLabel, ...]


def drawing(found: FemmText, metres: float, axisymmetric: bool, exterior: bool) -> Drawing:
    """metres : of one unit of the file. exterior : whether the file describes a Kelvin-transformed region.

    Raises SpecError with the line, also for references to what the file has not and for lines of no length.
    """
    count = {kind: len(properties) for kind, properties in found.properties.items()}
    boundaries = found.properties["bdry"]
    rows = {key: found.rows.get(key, ()) for key in ("numsegments", "numarcsegments", "numholes")}
    rows |= {key.lower(): _required(found, key) for key in ("NumPoints", "NumBlockLabels")}
    if not rows["numsegments"] and not rows["numarcsegments"]:
        raise found.source.error("it must have segments or arcs; got none.")
    nodes = tuple(
        Node(
            *_position(row, metres),
            row.reference(2, "The point property", count["point"]),
            row.integer(3, "The group", 0),
        )
        for row in rows["numpoints"]
    )
    if axisymmetric:
        nodes = _beside_the_axis(nodes, rows["numpoints"])
    labels = tuple(_label(row, metres, count["block"], count["circuit"]) for row in rows["numblocklabels"])
    for label, row in zip(labels, rows["numblocklabels"], strict=True):
        if axisymmetric and label.x < 0:
            raise row.error(f"A block label's r must not be negative; got {label.x:g}.")
        if axisymmetric and label.external and not exterior:
            raise row.error("A label of the exterior region must have [extRo] and [extRi] in its file; got none.")
    return Drawing(
        nodes,
        tuple(_segment(row, nodes, boundaries) for row in rows["numsegments"]),
        tuple(_arc(row, nodes, boundaries) for row in rows["numarcsegments"]),
        tuple(Hole(*_position(row, metres), row.integer(2, "The group", 0)) for row in rows["numholes"]),
        labels,
    )


def _required(found: FemmText, key: str) -> tuple[Row, ...]:
    rows = found.rows.get(key.lower(), ())
    if not rows:
        raise found.source.error(f"it must have [{key}] with at least one row; got none.")
    return rows


def _position(row: Row, metres: float) -> tuple[float, float]:
    x, y = row.number(0, "x"), row.number(1, "y")
    if max(abs(x), abs(y)) * metres > LARGEST_LENGTH:
        raise row.error(f"Coordinates must be within {LARGEST_LENGTH:g} m of the origin; got ({x:g}, {y:g}).")
    return x, y


def _node(row: Row, metres: float, properties: int) -> Node:
    x, y = _position(row, metres)
    return Node(x, y, row.reference(2, "The point property", properties), row.integer(3, "The group", 0))


def axis_width(nodes: Sequence[Node]) -> float:
    """In the file's unit: nodes nearer than this to the axis are on it."""
    size = max((max(abs(node.x), abs(node.y)) for node in nodes), default=0.0)
    return max(ROUNDING * size, min(ON_AXIS, THINNEST_HOLE * size))


def _beside_the_axis(nodes: tuple[Node, ...], rows: Sequence[Row]) -> tuple[Node, ...]:
    least = -axis_width(nodes)
    for node, row in zip(nodes, rows, strict=True):
        if node.x < least:
            raise row.error(f"A point's r must not be negative in an axisymmetric file; got {node.x:g}.")
    return tuple(replace(node, x=0.0) if node.x < 0 else node for node in nodes)


def _ends(row: Row, nodes: tuple[Node, ...], what: str) -> tuple[int, int]:
    start, end = row.integer(0, f"{what}'s start"), row.integer(1, f"{what}'s end")
    for number in (start, end):
        if not 0 <= number < len(nodes):
            raise row.error(f"{what} must join points from 0 to {len(nodes) - 1}; got {number}.")
    a, b = nodes[start], nodes[end]
    if (a.x, a.y) == (b.x, b.y):
        raise row.error(f"{what} must have a length; both its ends are at ({a.x:g}, {a.y:g}).")
    return start, end


def _boundary(row: Row, at: int, boundaries: Sequence[Property]) -> int | None:
    number = row.reference(at, "The boundary property", len(boundaries))
    if number is not None and (kind := unsupported(boundaries[number])):
        raise row.error(f"A boundary must be prescribed, mixed, periodic or antiperiodic; {kind} is not supported.")
    return number


def _segment(row: Row, nodes: tuple[Node, ...], boundaries: Sequence[Property]) -> Segment:
    start, end = _ends(row, nodes, "A segment")
    size = row.number(2, "A segment's element size", -1.0)
    return Segment(
        start,
        end,
        size if size > 0 else None,
        _boundary(row, 3, boundaries),
        bool(row.integer(4, "The hidden flag", 0)),
        row.integer(5, "The group", 0),
    )


def _arc(row: Row, nodes: tuple[Node, ...], boundaries: Sequence[Property]) -> Arc:
    start, end = _ends(row, nodes, "An arc")
    angle = row.number(2, "An arc's angle")
    if not 0 < angle <= 180 * (1 + ANGLE_TOLERANCE):
        raise row.error(f"An arc's angle must be above 0 and at most 180 degrees; got {angle:g}.")
    widest = row.number(3, "An arc's greatest segment", -1.0)
    return Arc(
        start,
        end,
        min(angle, 180.0),
        widest if widest > 0 else 5.0,
        _boundary(row, 4, boundaries),
        bool(row.integer(5, "The hidden flag", 0)),
        row.integer(6, "The group", 0),
    )


def _label(row: Row, metres: float, materials: int, circuits: int) -> BlockLabel:
    x, y = _position(row, metres)
    size = row.number(3, "The mesh size", -1.0)
    turns = row.number(7, "The number of turns", 1.0)
    if abs(turns) > MOST_TURNS:
        raise row.error(f"The number of turns must be at most {MOST_TURNS:g}; got {turns:g}.")
    flags = row.integer(8, "The external flag", 0)
    direction: float | str = row.number(5, "The magnetisation", 0.0)
    if row.text.strip():
        direction = row.text
        try:
            parse_formula(row.text)
        except SpecError as error:
            raise row.error(str(error)) from error
    return BlockLabel(
        x,
        y,
        material=row.reference(2, "The block property", materials),
        size=size if size > 0 else None,
        circuit=row.reference(4, "The circuit", circuits),
        magnetisation=direction,
        group=row.integer(6, "The group", 0),
        turns=turns,
        external=bool(flags & 1),
        default=bool(flags & 2),
    )
