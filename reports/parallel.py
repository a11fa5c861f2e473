"""The designs of a study as a scatter and as parallel coordinates, drawn so that a script can brush them.

Both are complete pictures by themselves. Each design is one element that carries its number (``data-row``), each axis
one that carries its column's; the script only dims, moves and adds.
"""

from __future__ import annotations

import html
import math
from collections.abc import Iterable, Sequence

from fluxbore.reports.brush_data import Column, Design, DesignTable
from fluxbore.reports.svg import Drawing
from fluxbore.reports.wording import plain

SCATTER = (500.0, 360.0)
"""Width and height of the scatter, in which type of 12 units reads well."""

FRAME = (64.0, 14.0, 486.0, 306.0)
"""Left, top, right and bottom of its axes."""

WIDTH, TOP, BOTTOM, EDGE = 1000.0, 66.0, 336.0, 70.0
"""Of the parallel axes: the drawing's width; their upper and lower ends; from the first and the last to its edge."""

MARKS = {"start": "M-5-5H5V5H-5Z", "chosen": "M0-9 2.6-2.9 9-2.6 4 1.5 5.6 8 0 4.4-5.6 8-4 1.5-9-2.6-2.6-2.9Z",
         "published optimum": "M0 7-6.5-5H6.5Z"}  # fmt: skip
"""Outline of the mark of a design with a name, around its place."""

DOT, DIAMOND = "M-3 0A3 3 0 1 1 3 0A3 3 0 1 1-3 0Z", "M0-4.4 4.4 0 0 4.4-4.4 0Z"


def scatter(table: DesignTable) -> Drawing:
    """Two columns against each other."""
    x, y = table.columns[table.across], table.columns[table.up]
    left, top, right, bottom = FRAME
    parts = [f'<rect class="plane" x="{left}" y="{top}" width="{right - left}" height="{bottom - top}"/>']
    parts.append('<g class="ticks">')
    for text, share in ticks(x):
        at = _short(left + share * (right - left))
        parts.append(f'<path class="grid" d="M{at} {top}V{bottom}"/>')
        parts.append(f'<text x="{at}" y="{bottom + 18}" text-anchor="middle">{text}</text>')
    for text, share in ticks(y):
        at = _short(bottom - share * (bottom - top))
        parts.append(f'<path class="grid" d="M{left} {at}H{right}"/>')
        parts.append(f'<text x="{left - 8}" y="{_short(float(at) + 4)}" text-anchor="end">{text}</text>')
    parts.append(f'<text x="{(left + right) / 2}" y="{bottom + 42}" text-anchor="middle">{html.escape(x.title)}</text>')
    middle = (top + bottom) / 2
    turned = f'transform="rotate(-90 14 {middle})"'
    parts.append(f'<text x="14" y="{middle}" text-anchor="middle" {turned}>{html.escape(y.title)}</text></g>')
    parts.append('<g class="designs">')
    for number in _in_order(table.designs):
        item = table.designs[number]
        across, up = item.values[table.across], item.values[table.up]
        if across is None or up is None:
            place = 'display="none"'
        else:
            place_x, place_y = left + share_of(x, across) * (right - left), bottom - share_of(y, up) * (bottom - top)
            place = f'transform="translate({_short(place_x)} {_short(place_y)})"'
        shape = MARKS.get(item.mark) or (DOT if item.feasible else DIAMOND)
        parts.append(f'<path class="{look(item)}" data-row="{number}" {place} d="{shape}"/>')
    parts.append("</g>")
    alt = f"{y.label} over {x.label} of {len(table.designs)} designs{_named(table, (table.across, table.up))}."
    caption = f"{y.label} over {x.label[:1].lower()}{x.label[1:]}, every design a mark."
    return Drawing("scatter", _whole(SCATTER, "scatter", alt, parts), alt, caption)


def parallel(table: DesignTable) -> Drawing:
    """Every column an axis, every design a line across them; what the study's limits exclude is shaded."""
    places = [EDGE + i * (WIDTH - 2 * EDGE) / (len(table.columns) - 1) for i in range(len(table.columns))]
    # Many lines would run into one surface.
    faint = min(0.5, max(0.12, 30 / len(table.designs)))
    parts = [f'<g class="designs" style="--faint:{faint:.2f}">']
    for number in _in_order(table.designs):
        item = table.designs[number]
        parts.append(f'<path class="{look(item)}" data-row="{number}" d="{_line(table.columns, places, item)}"/>')
    parts.append("</g>")
    for number, column in enumerate(table.columns):
        parts.append(_axis(number, column, places[number]))
    alt = (
        f"Parallel coordinates of {len(table.designs)} designs over "
        f"{', '.join(column.label for column in table.columns)}{_named(table, range(len(table.columns)))}."
    )
    caption = "Every axis a variable or a figure, every line a design. Shaded: what the limits exclude."
    markup = _whole((WIDTH, BOTTOM + 14), "parallel", alt, parts)
    return Drawing("parallel", markup, alt, caption, wide=True)


def share_of(column: Column, value: float) -> float:
    """0 to 1 along the axis; what lies beyond an end is drawn there."""
    low, high = column.ends
    return min(max((value - low) / (high - low), 0.0), 1.0)


def ticks(column: Column, most: int = 6) -> list[tuple[str, float]]:
    """Round numbers along an axis, each with its place, 0 to 1."""
    low, high = column.ends
    rough = (high - low) / most
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(factor * power for factor in (1, 2, 2.5, 5, 10) if factor * power >= rough * (1 - 1e-9))
    decimals = max(-math.floor(math.log10(step) + 1e-9), 0) + (round(step / power, 1) == 2.5)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [(plain(i * step, decimals), share_of(column, i * step)) for i in range(first, last + 1)]


def look(item: Design) -> str:
    """The classes that colour a design."""
    name = item.mark.partition(" ")[0]
    return f"{'row' if item.feasible else 'row broken'}{f' mark {name}' if name else ''}"


def _axis(number: int, column: Column, x: float) -> str:
    x = float(_short(x))
    parts = [f'<g class="axis" data-column="{number}">']
    for sense, limit in column.limits:
        at = BOTTOM - share_of(column, limit) * (BOTTOM - TOP)
        low, high = (TOP, at) if sense == "<=" else (at, BOTTOM)
        if high > low:
            parts.append(
                f'<rect class="beyond" x="{x - 7}" y="{_short(low)}" width="14" height="{_short(high - low)}"/>'
            )
        parts.append(f'<path class="limit" d="M{x - 9} {_short(at)}h18"/>')
    parts.append(f'<path class="line" d="M{x} {TOP}V{BOTTOM}"/>')
    for text, share in ticks(column):
        y = BOTTOM - share * (BOTTOM - TOP)
        parts.append(f'<path class="line" d="M{x} {_short(y)}h-4"/>')
        parts.append(f'<text class="halo" x="{x - 7}" y="{_short(y + 4)}" text-anchor="end">{text}</text>')
    lines = _wrapped(column.title)
    for place, text in enumerate(lines):
        y = TOP - 14 - 14 * (len(lines) - 1 - place)
        parts.append(f'<text x="{x}" y="{y}" text-anchor="middle">{html.escape(text)}</text>')
    return "".join((*parts, "</g>"))


def _line(columns: Sequence[Column], places: Sequence[float], item: Design) -> str:
    """A path across the axes, broken where a figure is not known."""
    found, pen = [], "M"
    for column, x, value in zip(columns, places, item.values, strict=True):
        if value is None:
            pen = "M"
            continue
        y = BOTTOM - share_of(column, value) * (BOTTOM - TOP)
        found.append(f"{pen}{_short(x)} {_short(y)}")
        pen = "L"
    return "".join(found)


def _in_order(designs: Sequence[Design]) -> list[int]:
    """What breaks a limit lies beneath what does not, and what has a name on top."""
    return sorted(range(len(designs)), key=lambda i: (bool(designs[i].mark), designs[i].feasible, i))


def _named(table: DesignTable, columns: Iterable[int]) -> str:
    """``; chosen: ring width 2.4 mm, …``: what the picture is about, for those who do not see it."""
    columns = list(columns)
    found = []
    for item in table.designs:
        if item.mark:
            pairs = ((table.columns[i], item.values[i]) for i in columns)
            values = (_reading(column, value) for column, value in pairs if value is not None)
            found.append(f"; {item.mark}: {', '.join(values)}")
    return "".join(found)


def _reading(column: Column, value: float) -> str:
    return f"{column.label} {plain(value, column.scale.decimals)} {column.scale.unit}".strip()


def _wrapped(text: str, width: int = 18, most: int = 4) -> list[str]:
    """A title in short lines."""
    import textwrap

    return textwrap.wrap(text, width, max_lines=most, placeholder=" …", break_long_words=False)


def _whole(size: tuple[float, float], name: str, alt: str, parts: Iterable[str]) -> str:
    width, height = (_short(value) for value in size)
    label = html.escape(alt, quote=True)
    head = f'<svg class="{name} plot" viewBox="0 0 {width} {height}" width="{width}" height="{height}" role="img"'
    return f'{head} aria-label="{label}">{"".join(parts)}</svg>'


def _short(value: float) -> str:
    return f"{value:.1f}".rstrip("0").rstrip(".")
