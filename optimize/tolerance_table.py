"""tolerance.csv: one line for each number of a tolerance analysis, SI units, floats that read back exactly."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator

from fluxbore.optimize.tolerance_result import FigureSpread, Interval, Requirement, ToleranceEffect, ToleranceResult

FILE_NAME = "tolerance.csv"

HEADER = ("part", "subject", "key", "quantity", "value", "low", "high", "text")
"""``low`` and ``high`` are ends of a confidence interval; ``text`` a distribution, a reason or a warning."""

_Line = tuple[str | float | int, ...]


def tolerance_table(result: ToleranceResult) -> str:
    """The text of tolerance.csv: the yield, the limits, the tolerances, the figures, the rejects, the warnings."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(HEADER)
    for line in _lines(result):
        cells = ["" if isinstance(cell, float) and not math.isfinite(cell) else cell for cell in line]
        writer.writerow([repr(cell) if isinstance(cell, float) else cell for cell in cells])
    return buffer.getvalue()


def _lines(result: ToleranceResult) -> Iterator[_Line]:
    for quantity, interval in (
        ("simulated", result.simulated),
        ("checked", result.checked),
        ("direct", result.direct),
        ("shifted", result.shifted),
    ):
        if interval is not None:
            yield "yield", "", "", quantity, *_interval(interval), ""
    yield "yield", "", "", "samples", result.examined, "", "", ""
    for requirement in result.requirements:
        yield from _requirement(requirement)
    for effect in result.effects:
        yield from _effect(effect, result)
    for spread in result.figures:
        yield from _figure(spread)
    for part, rejects in (("reject", result.rejects), ("failed check", result.failures)):
        for reject in rejects:
            yield part, "", "", "count", reject.count, "", "", " ".join(reject.reason.split())
    for key in result.held:
        yield "held", "", key, "", "", "", "", ""
    for warning in result.warnings:
        yield "warning", "", "", "", "", "", "", warning


def _requirement(item: Requirement) -> Iterator[_Line]:
    name = f"{item.limit.subject} {item.limit.sense}"
    for quantity, value in (
        ("limit", item.limit.limit),
        ("nominal", item.nominal),
        ("margin in sigmas", item.margin),
        ("expected yield", item.expected),
    ):
        yield "limit", name, "", quantity, value, "", "", ""
    yield "limit", name, "", "simulated yield", *_interval(item.simulated), ""
    if item.checked is not None:
        yield "limit", name, "", "checked yield", *_interval(item.checked), ""
    if item.shifted is not None:
        yield "limit", name, "", "shifted yield", *_interval(item.shifted), ""
    yield "limit", name, "", "cost in yield", item.cost, "", "", ""


def _effect(effect: ToleranceEffect, result: ToleranceResult) -> Iterator[_Line]:
    tolerance = effect.tolerance
    for quantity, value in (
        ("nominal", result.values[tolerance.key]),
        ("minus", tolerance.minus),
        ("plus", tolerance.plus),
        ("yield when halved", effect.halved),
        ("gain when halved", effect.gain),
    ):
        yield "tolerance", "", tolerance.key, quantity, value, "", "", tolerance.distribution
    for requirement, share in zip(result.requirements, effect.shares, strict=True):
        name = f"{requirement.limit.subject} {requirement.limit.sense}"
        yield "tolerance", name, tolerance.key, "share of variance", share, "", "", tolerance.distribution


def _figure(spread: FigureSpread) -> Iterator[_Line]:
    for quantity, value in (
        ("nominal", spread.nominal),
        ("mean", spread.mean),
        ("sigma", spread.sigma),
        ("worst low", spread.worst_low),
        ("worst high", spread.worst_high),
    ):
        yield "figure", spread.subject, "", quantity, value, "", "", ""
    for share, interval in spread.quantiles.items():
        yield "figure", spread.subject, "", f"quantile {share:g}", *_interval(interval), ""
    how = "exact" if spread.exact else "central difference"
    for key, slope in spread.slopes.items():
        yield "figure", spread.subject, key, "slope", slope, "", "", how
        yield "figure", spread.subject, key, "share of variance", spread.shares[key], "", "", ""
    if spread.checked is not None:
        yield "figure", spread.subject, "", "checked mean", *_interval(spread.checked.mean), ""
        yield "figure", spread.subject, "", "bias of the linear model", spread.checked.bias, "", "", ""
        yield "figure", spread.subject, "", "error of the linear model", spread.checked.error, "", "", ""


def _interval(interval: Interval) -> tuple[float, float, float]:
    return interval.value, interval.low, interval.high
