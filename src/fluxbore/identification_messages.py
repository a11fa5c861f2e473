"""What the command line says of identified parameters: a table, what to mind, and lines for the specification."""

from __future__ import annotations

import json
from typing import Any

from fluxbore.design.errors import one_line
from fluxbore.design.identification import CORRELATED, Estimate
from fluxbore.design.units import DIMENSIONS, format_quantity
from fluxbore.identifying import Identification

DIGITS = 4
"""Significant ones; the intervals are rarely narrower."""


def identification_plain(result: Identification) -> dict[str, Any]:
    """For ``--json``: everything in SI units."""
    found = result.found
    return {
        "status": "ok",
        "reasons": [],
        "model": result.model.name,
        "data": found.source,
        "rows": result.rows,
        "level": found.level,
        "specification": result.own_spec,
        "taken": {name: value for name, (value, _) in result.taken.items()},
        "parameters": {
            name: {**_estimate_plain(estimate), **_difference_plain(result, name, estimate)}
            for name, estimate in found.parameters.items()
        },
        "derived": {
            name: {**_estimate_plain(estimate), **_difference_plain(result, name, estimate)}
            for name, estimate in found.derived.items()
        },
        "residual_deviation": found.residual_deviation,
        "degrees_of_freedom": found.degrees_of_freedom,
        "condition": found.condition,
        "correlated": [{"parameters": [first, second], "correlation": r} for first, second, r in found.correlated()],
        "toml": toml_lines(result),
    }


def identification_text(result: Identification) -> str:
    """A table for people."""
    found = result.found
    taken = f"; {_taken(result)}" if result.taken else ""
    level = f"{found.level * 100:g} % interval"
    theirs = "specification" if result.own_spec else "template"
    columns = ["parameter", "", "estimate", level, *([theirs, "difference"] if result.given else []), ""]
    rows = [columns]
    correlated: dict[str, list[str]] = {}
    for first, second, r in found.correlated():
        correlated.setdefault(first, []).append(f"correlation {r:.2f} with {second}")
    for name, estimate in found.parameters.items():
        notes = [f"at its {estimate.bound} bound"] if estimate.bound else []
        rows.append(_row(result, name, estimate, [*notes, *correlated.get(name, [])]))
    rows += [_row(result, name, estimate, ["follows"]) for name, estimate in found.derived.items()]
    widths = [max(len(row[column]) for row in rows) for column in range(len(columns))]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
    scatter = format_quantity(found.residual_deviation, result.model.measured, 3)
    notes = [f"scatter of the {len(found.residuals)} points about the model: {scatter}"]
    if correlated:
        notes.append(f"Parameters that correlate by more than {CORRELATED:g} trade off against each other.")
    lines_for_it = toml_lines(result)
    specification = ["", "For the specification:", "", lines_for_it] if lines_for_it else []
    heading = f"{result.model.name} from {found.source}: {result.rows} rows{taken}"
    return "\n".join([heading, "", *lines, "", *notes, *specification])


def toml_lines(result: Identification) -> str:
    """What was found as a specification holds it, each with where it comes from; nothing where none was gone by."""
    how = result.model.specified
    if how is None or result.spec is None:
        return ""
    lines: list[str] = []
    estimates = {**result.found.parameters, **result.found.derived}
    for name, key in how.keys.items():
        if name not in estimates:
            continue
        section, _, leaf = key.rpartition(".")
        if f"[{section}]" not in lines:
            lines.append(f"[{section}]")
        lines.append(_toml_line(result, leaf, estimates[name]))
    return "\n".join(lines)


def _toml_line(result: Identification, leaf: str, estimate: Estimate) -> str:
    low, high = (_number(value, estimate.dimension) for value in (estimate.low, estimate.high))
    value = _show(estimate.value, estimate)
    reason = one_line(
        f"identified from {result.found.source}, {result.found.level * 100:g} % interval {low} to {high}"
        + ("" if estimate.dimension is None else f" {DIMENSIONS[estimate.dimension].preferred}")
    )
    quoted = value if estimate.dimension is None else json.dumps(value)
    return f"{leaf} = {{ value = {quoted}, calibrated = {json.dumps(reason)} }}"


def _taken(result: Identification) -> str:
    """What the fit took as known, and from where."""
    how = result.model.specified
    template = "" if how is None else how.template
    origin = "the specification" if result.own_spec else f"the template {template}, for want of --spec"
    known = ", ".join(f"{name} {format_quantity(*value, DIGITS)}" for name, value in result.taken.items())
    return f"{known} of {origin}"


def _row(result: Identification, name: str, estimate: Estimate, notes: list[str]) -> list[str]:
    low, high = (_number(value, estimate.dimension) for value in (estimate.low, estimate.high))
    cells = [name, result.model.symbols.get(name, ""), _show(estimate.value, estimate), f"{low} to {high}"]
    if result.given:
        given = result.given.get(name)
        cells.append("" if given is None else _show(float(given), estimate))
        apart = None if given is None or not float(given) else estimate.value / float(given) - 1
        cells.append("" if apart is None else f"{apart * 100:+.1f} %")
    return [*cells, "; ".join(notes)]


def _estimate_plain(estimate: Estimate) -> dict[str, Any]:
    return {
        "value": estimate.value,
        "standard_error": estimate.standard_error,
        "low": estimate.low,
        "high": estimate.high,
        "unit": "" if estimate.dimension is None else DIMENSIONS[estimate.dimension].si,
        "bound": estimate.bound,
    }


def _difference_plain(result: Identification, name: str, estimate: Estimate) -> dict[str, Any]:
    given = result.given.get(name)
    if given is None:
        return {"given": None, "difference": None}
    return {"given": float(given), "difference": estimate.value - float(given)}


def _show(value: float, estimate: Estimate) -> str:
    """In the preferred unit."""
    if estimate.dimension is None:
        return f"{value:.{DIGITS}g}"
    return format_quantity(value, estimate.dimension, DIGITS)


def _number(value: float, dimension: str | None) -> str:
    """The same without its unit."""
    if dimension is None:
        return f"{value:.{DIGITS}g}"
    return format_quantity(value, dimension, DIGITS).partition(" ")[0]
