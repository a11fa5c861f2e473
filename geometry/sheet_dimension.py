"""Dimensions on paper: their lines, arrows and texts, by ISO 129-1. All in millimetres of the paper.

Three ways to show a size: between two arrows along or across the axis; from a common datum with the number at the end
of an extension line (running dimensioning); and the word of a hole in a table. Extension lines stop at texts.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from fluxbore.geometry.sheet import Box, Circle, Dimension, Filled, Item, Place, Stroke, Text, texts_of
from fluxbore.geometry.sheet_text import SMALL

ROW = 7.0
"""Between two dimension lines side by side."""

ARROW, HALF_ARROW = 2.5, 0.42
"""Length and half width of an arrow's head."""

GAP, BEYOND = 0.8, 1.2
"""From what is measured to its extension line, and of that beyond the dimension line."""

LEAST = 1.55 * SMALL
"""Between the feet of two texts side by side."""

DECIMALS = 3
"""Of a millimetre in a number that is shown."""

LAYER = "DIMENSIONS"


@dataclass(frozen=True, slots=True)
class Station:
    """A place along the axis that is told from the datum. name : of the dimension. point : where its extension line
    begins. value : from the datum in the model (mm). after : words behind the number."""

    name: str
    point: Place
    value: float
    after: str = ""


def number(value: float) -> str:
    """Millimetres as drawings show them: three decimals at most, none that is zero."""
    text = f"{value:.{DECIMALS}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def linear(
    name: str,
    start: Place,
    end: Place,
    line: float,
    value: float,
    *,
    across: bool = False,
    label: str = "<>",
    factor: float = 1.0,
) -> Dimension:
    """Between two arrows. line : y of a dimension along x, x of one across. value : what is shown (mm)."""

    def at(along: float, aside: float) -> Place:
        return (aside, along) if across else (along, aside)

    axis = 1 if across else 0
    first, last = sorted((start, end), key=lambda point: point[axis])
    low, high = first[axis], last[axis]
    strokes: list[Stroke | Filled | Circle] = []
    for point in (first, last):
        away = 1 if line > point[1 - axis] else -1
        if abs(line - point[1 - axis]) > GAP:
            feet = (point[1 - axis] + away * GAP, line + away * BEYOND)
            strokes.append(Stroke(LAYER, (at(point[axis], feet[0]), at(point[axis], feet[1]))))
    inside = high - low >= 2 * ARROW + 1
    reach = 0.0 if inside else ARROW + 2
    strokes.append(Stroke(LAYER, (at(low - reach, line), at(high + reach, line))))
    for tip, way in ((low, 1), (high, -1)):
        strokes.append(_arrow(at(tip, line), at(tip + (way if inside else -way) * ARROW, line), across))
    text = label.replace("<>", number(value))
    if across and not inside:  # there is no room between the arrows, and above them nothing is drawn as a rule
        shown = Text(text, (line + SMALL / 2, high + reach + GAP), SMALL, "left", 90, LAYER)
    else:
        middle = (low + high) / 2
        place = (line - GAP, middle) if across else (middle, line + GAP)
        shown = Text(text, place, SMALL, "middle", 90 if across else 0, LAYER)
    return Dimension(name, "across" if across else "along", (first, last), line, label, shown, tuple(strokes), factor)


def _arrow(tip: Place, tail: Place, across: bool) -> Filled:
    (x, y), (u, v) = tip, tail
    wings = ((u - HALF_ARROW, v), (u + HALF_ARROW, v)) if across else ((u, v - HALF_ARROW), (u, v + HALF_ARROW))
    return Filled(LAYER, ((x, y), *wings))


def running(stations: Sequence[Station], datum: Place, edge: float, *, factor: float = 1.0) -> list[Item]:
    """All sizes from one datum: numbers in a row, upright, beyond y = `edge`, with the datum's zero among them.

    Below the drawing `edge` is below the datum, else above; the numbers stand apart so that none hides another.
    """
    down = edge < datum[1]
    way = -1 if down else 1
    ordered = sorted(stations, key=lambda station: station.point[0])
    wanted = [datum[0], *(station.point[0] for station in ordered)]
    places = spread(wanted, LEAST)
    knee, foot, text = edge, edge + way * 4, edge + way * 5
    anchor = "right" if down else "left"

    def leader(point: Place, x: float) -> Stroke:
        return Stroke(LAYER, ((point[0], point[1] + way * GAP), (point[0], knee), (x, foot)))

    def words(shown: str, x: float) -> Text:
        return Text(shown, (x + SMALL / 2, text), SMALL, anchor, 90, LAYER)

    items: list[Item] = [leader(datum, places[0]), words("0", places[0]), Circle(LAYER, (datum[0], knee), 0.7)]
    for station, x in zip(ordered, places[1:], strict=True):
        label = f"<> {station.after}" if station.after else "<>"
        shown = words(label.replace("<>", number(station.value)), x)
        ends = (datum, station.point)
        items.append(Dimension(station.name, "from", ends, text, label, shown, (leader(station.point, x),), factor))
    return items


def spread(wanted: Sequence[float], gap: float) -> list[float]:
    """Places in the same order no nearer to one another than the gap, together as near as can be to those wanted.

    Least squares under an order: neighbours that would be too near form a block about the mean of their wishes.
    """
    blocks: list[list[float]] = []  # sum of wishes less the offsets in order, number
    for i, value in enumerate(wanted):
        blocks.append([value - i * gap, 1.0])
        while len(blocks) > 1 and blocks[-2][0] / blocks[-2][1] >= blocks[-1][0] / blocks[-1][1]:
            total, count = blocks.pop()
            blocks[-1][0] += total
            blocks[-1][1] += count
    flat = [total / count for total, count in blocks for _ in range(int(count))]
    return [value + i * gap for i, value in enumerate(flat)]


def touching(items: Iterable[Item]) -> bool:
    """Whether any two texts cover one another."""
    boxes = [text.box for text in texts_of(items)]
    return any(
        a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3] for i, a in enumerate(boxes) for b in boxes[:i]
    )


def apart(items: Iterable[Item], margin: float = 0.4) -> list[Item]:
    """The items with extension lines and edges interrupted where they would run through a text.

    A dimension's own text lies nearer to its lines than the margin, and counts without it.
    """
    every = list(items)
    boxes = [(text, text.box, _wider(text.box, margin)) for text in texts_of(every)]

    def clear(stroke: Stroke | Filled | Circle, own: Text | None) -> list[Stroke | Filled | Circle]:
        if not isinstance(stroke, Stroke) or stroke.closed:
            return [stroke]
        return [*_cut(stroke, [box if text is own else wide for text, box, wide in boxes])]

    result: list[Item] = []
    for item in every:
        if isinstance(item, Dimension):
            strokes = tuple(piece for stroke in item.strokes for piece in clear(stroke, item.shown))
            result.append(replace(item, strokes=strokes))
        elif isinstance(item, Stroke) and item.layer in (LAYER, "CENTRE"):
            result.extend(clear(item, None))
        else:
            result.append(item)
    return result


def _wider(box: Box, margin: float) -> Box:
    left, low, right, high = box
    return left - margin, low - margin, right + margin, high + margin


def _cut(stroke: Stroke, boxes: Sequence[Box]) -> list[Stroke]:
    """What of an open line lies outside of all boxes."""
    left, low, right, high = _ends(stroke.points)
    near = [b for b in boxes if b[0] < right and b[2] > left and b[1] < high and b[3] > low]
    if not near:
        return [stroke]
    import shapely

    rest = shapely.LineString(stroke.points).difference(shapely.union_all([shapely.box(*box) for box in near]))
    lines = [line for line in getattr(rest, "geoms", (rest,)) if line.geom_type == "LineString" and line.length > 0.05]
    return [replace(stroke, points=tuple((x, y) for x, y in line.coords)) for line in lines]


def _ends(points: Sequence[Place]) -> Box:
    xs, ys = zip(*points, strict=True)
    return min(xs), min(ys), max(xs), max(ys)
