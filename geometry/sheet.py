"""A drawing sheet as plain data: lines, circles, hatches, texts and dimensions in millimetres of the paper.

Drawings are composed once, of these, and then written as DXF, SVG or PDF, so that all three show the same. x is to the
right and y upwards from the lower left corner of the sheet. Layers are the names of `LAYERS`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from fluxbore.geometry.sheet_text import SMALL, text_width

Place = tuple[float, float]
"""(x, y) in mm of the paper."""

Box = tuple[float, float, float, float]
"""Least x and y, largest x and y (mm)."""

LAYERS: dict[str, tuple[int, str, float]] = {
    "OUTLINE": (7, "Continuous", 0.5),
    "EDGES": (7, "Continuous", 0.25),
    "HIDDEN": (8, "DASHED", 0.18),
    "CENTRE": (1, "CENTER", 0.18),
    "HATCH": (8, "Continuous", 0.13),
    "DIMENSIONS": (5, "Continuous", 0.18),
    "TEXT": (7, "Continuous", 0.25),
    "SHEET": (7, "Continuous", 0.25),
    "FRAME": (7, "Continuous", 0.7),
}
"""Colour index of DXF, line type and line width (mm)."""


@dataclass(frozen=True, slots=True)
class Stroke:
    """A line through points; closed : back to the first."""

    layer: str
    points: tuple[Place, ...]
    closed: bool = False


@dataclass(frozen=True, slots=True)
class Circle:
    layer: str
    centre: Place
    radius: float


@dataclass(frozen=True, slots=True)
class Ellipse:
    """Half axes along x and y."""

    layer: str
    centre: Place
    along: float
    across: float


@dataclass(frozen=True, slots=True)
class Filled:
    """A polygon without a border, such as an arrow's head."""

    layer: str
    points: tuple[Place, ...]


@dataclass(frozen=True, slots=True)
class Hatch:
    """A cut face: its outline first, then the holes in it. spacing : of its lines (mm), 0 fills it. angle : degrees."""

    rings: tuple[tuple[Place, ...], ...]
    spacing: float
    angle: float = 45.0
    layer: str = "HATCH"


@dataclass(frozen=True, slots=True)
class Text:
    """One line. size : height of its capitals (mm). anchor : the end of its foot line that lies at the place, "left",
    "middle" or "right". angle : 0, or 90 for upwards."""

    text: str
    place: Place
    size: float = SMALL
    anchor: str = "left"
    angle: int = 0
    layer: str = "TEXT"

    @property
    def box(self) -> Box:
        """What it covers, descenders included."""
        width = text_width(self.text, self.size)
        start = -width * {"left": 0.0, "middle": 0.5, "right": 1.0}[self.anchor]
        low, high = -0.25 * self.size, self.size
        x, y = self.place
        if self.angle:
            return x - high, y + start, x - low, y + start + width
        return x + start, y + low, x + start + width, y + high


@dataclass(frozen=True, slots=True)
class Dimension:
    """A size that readers of the DXF file can measure, with the strokes and texts that show it.

    name : what it is. kind : "along" x, "across" along y, "from" a datum along x, or "round" over a diameter. points :
    its two ends on the paper; of "from" the datum comes first. line : where its line stands, y of one along x and x of
    one across. factor : of the model's millimetres over those between its points at the sheet's scale, not 1 in views
    of another scale. label : what is shown, with <> for the number; shown : the whole text.
    """

    name: str
    kind: str
    points: tuple[Place, Place]
    line: float
    label: str
    shown: Text
    strokes: tuple[Stroke | Filled | Circle, ...]
    factor: float = 1.0


Item = Stroke | Circle | Ellipse | Filled | Hatch | Text | Dimension


@dataclass(frozen=True, slots=True)
class Sheet:
    """One page. name : of its file, without an ending. size : "A3" or "A4". scale : of its main view. origin : where on
    the paper that view has the model's origin."""

    name: str
    title: str
    size: str
    scale: float
    origin: Place
    items: tuple[Item, ...]


def moved(item: Item, by: Place) -> Item:
    """The same elsewhere on the paper."""
    dx, dy = by

    def shift(points: Iterable[Place]) -> tuple[Place, ...]:
        return tuple((x + dx, y + dy) for x, y in points)

    match item:
        case Stroke() | Filled():
            return replace(item, points=shift(item.points))
        case Circle() | Ellipse():
            return replace(item, centre=shift((item.centre,))[0])
        case Hatch():
            return replace(item, rings=tuple(shift(ring) for ring in item.rings))
        case Text():
            return replace(item, place=shift((item.place,))[0])
    ends = shift(item.points)
    return replace(
        item,
        points=(ends[0], ends[1]),
        line=item.line + (dx if item.kind == "across" else dy),
        shown=replace(item.shown, place=shift((item.shown.place,))[0]),
        strokes=tuple(moved(stroke, by) for stroke in item.strokes),  # type: ignore[misc]
    )


def parts_of(items: Iterable[Item]) -> Iterator[Stroke | Circle | Ellipse | Filled | Hatch | Text]:
    """The items with every dimension taken apart into what shows it."""
    for item in items:
        if isinstance(item, Dimension):
            yield from item.strokes
            yield item.shown
        else:
            yield item


def texts_of(items: Iterable[Item]) -> list[Text]:
    """All texts, those of dimensions too."""
    return [item for item in parts_of(items) if isinstance(item, Text) and item.text]


def bounds(items: Iterable[Item]) -> Box:
    """The box around everything; of nothing, a point."""
    boxes = [_box(item) for item in parts_of(items)]
    if not boxes:
        return 0.0, 0.0, 0.0, 0.0
    left, low, right, high = zip(*boxes, strict=True)
    return min(left), min(low), max(right), max(high)


def _box(item: Stroke | Circle | Ellipse | Filled | Hatch | Text) -> Box:
    match item:
        case Text():
            return item.box
        case Circle():
            return _around(item.centre, item.radius, item.radius)
        case Ellipse():
            return _around(item.centre, item.along, item.across)
    points = item.rings[0] if isinstance(item, Hatch) else item.points
    xs, ys = zip(*points, strict=True)
    return min(xs), min(ys), max(xs), max(ys)


def _around(centre: Place, along: float, across: float) -> Box:
    x, y = centre
    return x - along, y - across, x + along, y + across
