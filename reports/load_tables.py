"""Saturation and demagnetisation on the page: the parts' loads in a table, and in a picture against their limits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from fluxbore.fem.field_loads import Load
from fluxbore.reports.svg import BAD, CHOSEN, MUTED, Drawing, drawing, new_figure, style
from fluxbore.reports.tables import Cell, Table
from fluxbore.reports.wording import capital, percent, scale

WIDTH = 500.0

NEXT_TO = 84.0
"""% of the limit, from which a bar's number stands beyond the line of the limit, not across it."""

KNEE = (
    "An iron’s knee is where 10 % more flux density takes 50 % more field strength (IEC 61869-2); its share is of |B|. "
    "A magnet’s limit is its intrinsic coercivity at the magnets’ temperature; its share is of the field strength "
    "against the magnetisation. “99 %”: of the volume is below; what is above it sits at corners."
)


def section(loads: Sequence[Load], state: str) -> dict[str, Any] | None:
    """What the template shows; None where no part has a limit. state : of the field, in words."""
    if not loads:
        return None
    return {"picture": loads_picture(loads, state), "table": loads_table(loads, state), "note": KNEE}


def loads_table(loads: Sequence[Load], state: str) -> Table:
    """Each iron's |B| against its knee, each magnet's reverse field against its coercivity. state : of the field."""
    rows = []
    for item in loads:
        unit = scale("flux density" if item.kind == "iron" else "field strength", [item.limit])
        rows.append(
            (
                Cell(capital(_title(item))),
                Cell(item.material),
                Cell(f"{'knee' if item.kind == 'iron' else 'coercivity'} {unit.quantity(item.limit)}"),
                Cell(unit.quantity(item.mean)),
                Cell(unit.quantity(item.high)),
                Cell(unit.quantity(item.largest)),
                Cell(percent(item.beyond), "bad" if item.beyond > 0 and item.kind == "magnet" else ""),
            )
        )
    head = ("Part", "Material", "Limit", "Mean", "99 % below", "Largest", "Beyond its limit")
    return Table(f"Load of iron and magnets over their volume, {state}", head, tuple(rows), words=frozenset({1, 2}))


def loads_picture(loads: Sequence[Load], state: str) -> Drawing:
    """Mean and 99 % of each part as shares of its limit. state : of the field, in words."""
    items = list(loads)[::-1]
    with style():
        canvas = new_figure(WIDTH, 90.0 + 40.0 * len(items))
        plot = canvas.subplots()
        places = range(len(items))
        high = [100 * item.high / item.limit for item in items]
        mean = [100 * item.mean / item.limit for item in items]
        plot.barh(places, high, color=CHOSEN, alpha=0.35, height=0.6, label="99 % of the volume is below")
        plot.barh(places, mean, color=CHOSEN, height=0.3, label="mean")
        plot.axvline(100, color=BAD, lw=1.6, label="knee or coercivity")
        for place, value in zip(places, high, strict=True):
            at = (max(value, 100.0) if value > NEXT_TO else value, place)
            plot.annotate(f"{value:.0f} %", at, xytext=(5, 0), textcoords="offset points", va="center", color=MUTED)
        plot.set_yticks(places, [_title(item) for item in items])
        plot.grid(visible=False, axis="y")
        plot.set_xlim(0, 1.15 * max(100.0, *high))
        plot.set_xlabel("share of the limit (%)")
        plot.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=2, borderaxespad=0.2, handlelength=1.6)
        told = "; ".join(f"{_title(item)} {100 * item.high / item.limit:.0f} %" for item in loads)
        alt = f"What 99 % of each part's volume stays below, of its knee or coercivity: {told}."
        return drawing(canvas, "loads", alt, f"Iron against its knee, magnets against their coercivity, {state}.")


def _title(item: Load) -> str:
    if item.count == 1:
        return item.name
    return f"{item.name}{'' if item.name.endswith('s') else 's'} ({item.count})"
