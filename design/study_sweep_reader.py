"""Reads a study's sweeps: grids over the values of one or more keys."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from fluxbore.design.errors import SpecError, shown
from fluxbore.design.keys import Key
from fluxbore.design.study import Axis, Sweep
from fluxbore.design.study_fields import allow, check_at, figure_key, loose, numeric_key, read_value

LARGEST_GRID = 1_000_000
"""Designs in one sweep; a slip in ``step`` asks for more than this."""


def read_sweep(raw: Mapping[str, Any], where: str, known: Mapping[str, Key], figure: str | None = None) -> Sweep:
    """One table of ``study.sweeps``. figure : the study's objective, which published points are of."""
    allow(raw, where, ("name", "axes", "published_optimum", "published", "source"))
    axes_raw = raw.get("axes")
    if not isinstance(axes_raw, list) or not axes_raw:
        raise SpecError(f"{where}.axes must be a list of at least one table; got {shown(axes_raw)}.")
    axes = tuple(_axis(item, f"{where}.axes.{i}", known) for i, item in enumerate(axes_raw))
    names = [axis.key for axis in axes]
    if len(set(names)) < len(names):
        raise SpecError(f"{where}.axes must name each key once; got {', '.join(names)}.")
    reference = None
    if "published_optimum" in raw:
        if len(axes) != 1:
            raise SpecError(f"{where}.published_optimum needs exactly one axis; got {len(axes)}.")
        reference = read_value(raw["published_optimum"], loose(known[names[0]]), f"{where}.published_optimum")
    published = _published(raw["published"], f"{where}.published", axes, known, figure) if "published" in raw else ()
    name, source = (
        str(Key(f"{where}.{word}", "", "word").read(raw[word])) if word in raw else default
        for word, default in (("name", " x ".join(names)), ("source", ""))
    )
    sweep = Sweep(name, axes, reference, source, published)
    if sweep.size > LARGEST_GRID:
        raise SpecError(f"{where} must have at most {LARGEST_GRID} designs; got {sweep.size}.")
    return sweep


def _published(
    raw: object, where: str, axes: tuple[Axis, ...], known: Mapping[str, Key], figure: str | None
) -> tuple[tuple[float, float], ...]:
    """Pairs of the axis's value and the objective's; none without an objective."""
    if len(axes) != 1:
        raise SpecError(f"{where} needs exactly one axis; got {len(axes)}.")
    if figure is None:  # a sweep without a goal draws no curve that they could stand beside
        return ()
    if not isinstance(raw, list) or not raw or not all(isinstance(pair, list) and len(pair) == 2 for pair in raw):
        raise SpecError(f"{where} must be a list of pairs [value, {figure}]; got {shown(raw)}.")
    key, value = loose(known[axes[0].key]), figure_key(figure)
    return tuple(
        (read_value(x, key, f"{where}.{i}.0"), read_value(y, value, f"{where}.{i}.1")) for i, (x, y) in enumerate(raw)
    )


def _axis(raw: object, where: str, known: Mapping[str, Key]) -> Axis:
    allow(raw, where, ("key", "from", "to", "step", "values"))
    assert isinstance(raw, Mapping)
    key = numeric_key(raw, where, known, integers=True)
    if "values" in raw:
        if len(raw) != 2:
            raise SpecError(
                f"{where} must hold key with values = [...], or with from, to and step; got {', '.join(raw)}."
            )
        items = raw["values"]
        if not isinstance(items, list) or not items:
            raise SpecError(f"{where}.values must be a list of at least one value; got {shown(items)}.")
        values = tuple(read_value(item, key, f"{where}.values.{i}") for i, item in enumerate(items))
        for i, value in enumerate(values):
            check_at(key, value, f"{where}.values.{i}")
        return Axis(key.name, values)
    for name in ("from", "to", "step"):
        if name not in raw:
            raise SpecError(f"{where}.{name} is missing: an axis needs from, to and step, or values.")
    first, last = (read_value(raw[name], key, f"{where}.{name}") for name in ("from", "to"))
    for name, value in (("from", first), ("to", last)):
        check_at(key, value, f"{where}.{name}")
    step = read_value(raw["step"], key.difference, f"{where}.step")
    got = key.difference.show(step)
    if step == 0 or (last - first) / step < 0:
        raise SpecError(f"{where}.step must lead from {key.show(first)} to {key.show(last)}; got {got}.")
    intervals = (last - first) / step
    if intervals > LARGEST_GRID:
        raise SpecError(f"{where} must have at most {LARGEST_GRID} points; got {intervals:.3g}.")
    if abs(intervals - round(intervals)) > 1e-6:
        raise SpecError(
            f"{where}.step must divide the range from {key.show(first)} to {key.show(last)} evenly; got {got}."
        )
    # Rounded to 12 digits so that 0.0005 * 3 is the 0.0015 that a person would type.
    return Axis(key.name, tuple(float(f"{first + step * i:.12g}") for i in range(round(intervals) + 1)))
