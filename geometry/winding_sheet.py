"""The winding chart as a sheet of the drawings and as CSV: every coil, every phase, and how they are joined."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence

from fluxbore.design.title_block import TitleBlock
from fluxbore.design.units import format_quantity
from fluxbore.design.winding_chart import CoilEntry, PhaseEntry, WindingChart, Wire
from fluxbore.geometry.sheet import Circle, Item, Place, Sheet, Stroke, Text
from fluxbore.geometry.sheet_frame import (
    TABLE_ROW,
    TITLE_HEIGHT,
    TITLE_WIDTH,
    TitleWords,
    frame,
    inner,
    mass_text,
    natural_widths,
    notes,
    table,
)
from fluxbore.geometry.sheet_text import SMALL, text_width

SIZE = "A3"

COIL_HEAD = (
    "no.",
    "coil",
    "phase",
    "from (mm)",
    "to (mm)",
    "inner Ø (mm)",
    "outer Ø (mm)",
    "direction",
    "turns",
    "ampere-turns (A)",
    "wire (m)",
    "resistance (ohm)",
    "conductor (kg)",
    "start joined to",
)

PHASE_HEAD = ("phase", "coils in series", "turns", "wire (m)", "resistance (ohm)", "conductor (kg)")

LINK = 3.2
"""mm between the lines that join two phases' coils."""

BOX = 9.0
"""mm, height of a coil in the scheme, and its width at most."""


def coil_row(coil: CoilEntry, chart: WindingChart) -> tuple[float | str, ...]:
    """The values under `COIL_HEAD`; "" where there is none."""
    first = next((phase.phase for phase in chart.phases if phase.coils[0] == coil.number), "")
    joined = f"end of {coil.follows}" if coil.follows is not None else (f"lead {first}" if first else "")
    return (
        coil.number,
        coil.name,
        coil.phase,
        coil.start * 1e3,
        coil.end * 1e3,
        coil.inner_diameter * 1e3,
        coil.outer_diameter * 1e3,
        coil.direction,
        coil.turns if coil.turns is not None else "",
        coil.current or "",
        coil.length if coil.length is not None else "",
        coil.resistance if coil.resistance is not None else "",
        coil.mass,
        joined,
    )


def phase_row(phase: PhaseEntry) -> tuple[float | str, ...]:
    """The values under `PHASE_HEAD`."""
    coils = ", ".join(str(number) for number in phase.coils)
    return phase.phase, coils, phase.turns, phase.length, phase.resistance, phase.mass


def facts(chart: WindingChart) -> tuple[tuple[str, str], ...]:
    """Label and text of what holds for all coils."""
    found = [("Conductor", chart.conductor), ("Conductor, all coils", mass_text(chart.mass))]
    if chart.wire is not None:
        wire = chart.wire
        found += [
            ("Wire, bare", format_quantity(wire.bare, "length", 4)),
            ("Wire, insulated", format_quantity(wire.insulated, "length", 4)),
            ("Layers", str(wire.layers)),
            ("Turns in a full layer", layer_text(wire)),
        ]
    return tuple(found)


def layer_text(wire: Wire) -> str:
    """Turns of a full layer, and of every other where they differ."""
    return str(wire.first) if wire.first == wire.second else f"{wire.first} and {wire.second} in turn"


def chart_csv(chart: WindingChart) -> str:
    """A line a coil, then a line a phase (RFC 4180); what holds for all coils stands in the last columns."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\r\n")
    wire = chart.wire
    common = ("layers", "turns a full layer", "bare wire (mm)", "insulated wire (mm)", "conductor")
    writer.writerow((*COIL_HEAD, *common))
    for coil in chart.coils:
        shared = (
            (wire.layers, layer_text(wire), _plain(wire.bare * 1e3), _plain(wire.insulated * 1e3))
            if wire is not None
            else ("", "", "", "")
        )
        writer.writerow((*map(_plain, coil_row(coil, chart)), *shared, chart.conductor))
    for phase in chart.phases:
        told: dict[str, float | str] = {
            "coil": f"all of {phase.phase}",
            "phase": phase.phase,
            "turns": phase.turns,
            "wire (m)": phase.length,
            "resistance (ohm)": phase.resistance,
            "conductor (kg)": phase.mass,
        }
        writer.writerow((*(_plain(told.get(title, "")) for title in COIL_HEAD), "", "", "", "", chart.conductor))
    return stream.getvalue()


def winding_sheets(chart: WindingChart, block: TitleBlock) -> list[Sheet]:
    """The chart on A3: the scheme and the phases on the first sheet, the coils beneath and on further ones."""
    left, low, right, high = inner(SIZE)
    rows = [tuple(map(shown, coil_row(coil, chart))) for coil in chart.coils]
    used = [i for i in range(len(COIL_HEAD)) if any(row[i] for row in rows)]
    cells = [tuple(COIL_HEAD[i] for i in used), *(tuple(row[i] for i in used) for row in rows)]
    top: list[Item] = []
    y = high - 8
    if chart.phases:
        top, y = _scheme(chart, (left + 12, y), right - left - 24)
        phases = [PHASE_HEAD, *(tuple(map(shown, phase_row(phase))) for phase in chart.phases)]
        top += table(phases, natural_widths(phases), (left + 12, y))
        y -= len(phases) * TABLE_ROW + 6
    first = max(4, int((y - low - TITLE_HEIGHT - 5) / TABLE_ROW) - 1)
    further = int((high - low - TITLE_HEIGHT - 16) / TABLE_ROW) - 1
    chunks = [cells[1 : first + 1], *(cells[i : i + further] for i in range(first + 1, len(cells), further))]
    sheets = []
    for number, chunk in enumerate(chunks, 1):
        words = TitleWords("Winding chart", block.part_number, block.drawing_number, chart.conductor,
                           mass_text(chart.mass), f"{number} of {len(chunks)}")  # fmt: skip
        body = table([cells[0], *chunk], natural_widths(cells), (left + 12, y if number == 1 else high - 8))
        said = _sentences(chart) if number == 1 else []
        text = notes(said, (left + 2, low + 2), right - left - TITLE_WIDTH - 4, _size_of(said))
        every = (*frame(SIZE, block, words, None), *(top if number == 1 else []), *body, *text)
        sheets.append(Sheet(f"winding-{number}", f"{block.name}, winding chart", SIZE, 1.0, (0.0, 0.0), every))
    return sheets


def shown(value: float | str) -> str:
    """A cell's text, with five figures, or all of those before the point."""
    if isinstance(value, str):
        return value
    return f"{value:.5g}" if abs(value) < 1e5 else f"{value:.0f}"


def _plain(value: float | str) -> str:
    return value if isinstance(value, str) else f"{value:.12g}"


def _sentences(chart: WindingChart) -> list[str]:
    told = "; ".join(f"{label}: {text}" for label, text in facts(chart)[2:])
    return [*([f"{told}."] if told else []), *chart.told, *(f"Assumed: {text}" for text in chart.assumed)]


def _size_of(sentences: Sequence[str]) -> float:
    """Smaller where there is much to say beside the title block."""
    return SMALL if sum(text_width(text, SMALL) for text in sentences) < 1200 else 2.0


def _scheme(chart: WindingChart, corner: Place, width: float) -> tuple[list[Item], float]:
    """The coils in a row with the links of each phase above them; and y below all of it.

    The start of a coil is at the left of its box. corner : upper left, of the highest link.
    """
    x0, top = corner
    count = len(chart.phases)
    box = min(BOX, width / len(chart.coils))
    high = top - (count + 2) * LINK
    items: list[Item] = []
    for coil in chart.coils:
        x = x0 + (coil.number - 1) * box
        corners = ((x, high - BOX), (x + box, high - BOX), (x + box, high), (x, high))
        items.append(Stroke("OUTLINE", corners, closed=True))
        size = min(SMALL, 0.8 * box / 2.2)
        items.append(Text(coil.name, (x + box / 2, high - BOX / 2 - size / 2), size, "middle"))
    star = high - BOX - 2.5 * LINK
    for level, phase in enumerate(chart.phases):
        y = high + (level + 1) * LINK
        starts = [x0 + (number - 0.75) * box for number in phase.coils]
        ends = [x0 + (number - 0.25) * box for number in phase.coils]
        for end, start in zip(ends, starts[1:], strict=False):
            items.append(Stroke("EDGES", ((end, high), (end, y), (start, y), (start, high))))
        items.append(Stroke("EDGES", ((starts[0], high), (starts[0], y))))
        items += [Circle("EDGES", (starts[0], y + 0.8), 0.8), Text(phase.phase, (starts[0] - 1.6, y), SMALL, "right")]
        items.append(Stroke("EDGES", ((ends[-1], high - BOX), (ends[-1], star))))
    joined = [x0 + (phase.coils[-1] - 0.25) * box for phase in chart.phases]
    items.append(Stroke("EDGES", ((min(joined), star), (max(joined), star))))
    items.append(Text("star", (max(joined) + 2, star - SMALL / 2), SMALL))
    return items, star - 6
