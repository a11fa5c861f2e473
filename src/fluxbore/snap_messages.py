"""What became of a design in catalogue sizes, as lines and as plain data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fluxbore.snapping import Bought, Snapped

SAME = 1e-9
"""Relative change of a figure that is rounding."""


def snap_lines(found: Snapped) -> list[str]:
    """What is ordered, key by key, and every figure that it moves."""
    from fluxbore.value_text import show_key

    if not found.bought:
        return [f"No dimension of an actuator of kind {found.spec.kind.name} is a catalogue's to choose."]
    lines = []
    for item in found.bought:
        nearer = f" (nearer sizes made no actuator: {item.rank})" if item.rank else ""
        lines.append(f"{item.what}: {item.designation}{nearer}{'' if item.after else '; as it was'}")
        for key, value in item.after.items():
            before = f"{show_key(found.spec, key, item.before[key])} to " if key in item.before else ""
            lines.append(f"  {key}: {before}{show_key(found.spec, key, value)}")
    return [*lines, *_figures(found)]


def _figures(found: Snapped) -> list[str]:
    from fluxbore.design.performance import FIGURES, show_figure
    from fluxbore.reports.wording import change

    if not (found.before.ok and found.after.ok):
        return [*found.before.reasons, *found.after.reasons]
    moved = []
    for name in FIGURES:
        before, after = (getattr(item.performance, name) for item in (found.before, found.after))
        if before == after or (before and after and abs(after - before) <= SAME * abs(before)):
            continue
        percent = change(before, after)
        aside = f" ({percent.replace(chr(0xA0), ' ')})" if percent else ""
        moved.append(f"  {name}: {show_figure(name, before)} to {show_figure(name, after)}{aside}")
    return ["Figures that change:", *moved] if moved else ["No figure changes."]


def snap_plain(found: Snapped) -> dict[str, Any]:
    """For JSON; SI."""
    return {
        "bought": [_bought(item) for item in found.bought],
        "before": _performance(found.before.performance),
        "after": _performance(found.after.performance),
    }


def _bought(item: Bought) -> dict[str, Any]:
    return {
        "what": item.what,
        "designation": item.designation,
        "source": item.source,
        "before": dict(item.before),
        "after": dict(item.after),
        "nearer_sizes_that_do_not_fit": item.rank,
    }


def _performance(performance: object) -> dict[str, Any] | None:
    from fluxbore.design.performance import FIGURES

    return None if performance is None else {name: getattr(performance, name) for name in FIGURES}
