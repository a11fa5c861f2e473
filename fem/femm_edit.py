"""Changes to a FEMM model by keys and values, so that a file can be swept like a specification.

    circuit.NAME.current            A
    group.N.magnetisation           degrees, or a formula of x, y, r, z, theta and R
    group.N.turns
    group.N.displacement.x, .y      a length, in planar files; .z in axisymmetric ones
    group.N.rotation                degrees about the origin, in planar files
    material.NAME.mu_x, mu_y, coercivity (A/m), current_density (MA/m^2), conductivity (MS/m), fill
    boundary.NAME.a0, a1, a2, phase (degrees), c0, c1
    point.NAME.potential (Wb/m), current (A)
    depth                           a length

A bare number has the unit given here, a length that of the file. Names hold dots and spaces as they are; one with an
equals sign must be quoted. Changes apply in their order: displacement after rotation is not rotation after it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from decimal import ROUND_FLOOR, Decimal
from math import degrees
from typing import Protocol, TypeVar

from fluxbore.design.errors import SpecError, one_line, shown
from fluxbore.design.units import parse_quantity
from fluxbore.fem.femm_model import BlockLabel, BlockProperty, CircuitProperty, FemmModel, PointProperty
from fluxbore.fem.femm_move import Motion, moved
from fluxbore.fem.femm_value import (
    CONDUCTIVITY,
    CURRENT,
    DENSITY,
    FIELD,
    FILL,
    PERMEABILITY,
    PLAIN,
    Value,
    bare_number,
    spelt,
)
from fluxbore.fem.formula import parse_formula


class _Named(Protocol):
    @property
    def name(self) -> str: ...


_N = TypeVar("_N", bound=_Named)

CIRCUIT = {"current": CURRENT}
POINT = {"potential": PLAIN, "current": CURRENT}
MATERIAL = {
    "mu_x": PERMEABILITY,
    "mu_y": PERMEABILITY,
    "coercivity": FIELD,
    "current_density": DENSITY,
    "conductivity": CONDUCTIVITY,
    "fill": FILL,
}
BOUNDARY = {"a0": PLAIN, "a1": PLAIN, "a2": PLAIN, "phase": PLAIN, "c0": PLAIN, "c1": PLAIN}
KIND_OF_BOUNDARY = {"a0": "prescribed", "a1": "prescribed", "a2": "prescribed", "phase": "prescribed"}
"""What a boundary must be for its numbers to mean something; c0 and c1 are a mixed one's."""

MOST_VALUES = 10_000
"""Of a sweep."""


def setting(text: str) -> tuple[str, str]:
    """Key and value of KEY=VALUE. Raises SpecError where there is none of either."""
    quoted = False
    for at, sign in enumerate(text):
        quoted ^= sign == '"'
        if sign == "=" and not quoted:
            key, value = text[:at].strip(), text[at + 1 :].strip()
            if key and value:
                return key, value
            break
    raise SpecError(f"A change must be KEY=VALUE, such as circuit.coil.current=2; got {shown(text)}.")


def sweep_values(text: str) -> tuple[str, tuple[str, ...]]:
    """The key and the values of KEY=FIRST:LAST:STEP or KEY=VALUE,VALUE,...; a unit after LAST or STEP is every value's.

    Decimal arithmetic: 0:1:0.1 has 0.3, not its neighbour. Raises SpecError, also for more than `MOST_VALUES`.
    """
    key, values = setting(text)
    if ":" not in values:
        return key, _counted(key, [part.strip() for part in values.split(",")])
    parts = [part.strip() for part in values.split(":")]
    last, unit = _with_unit(parts[-1])
    numbers = [bare_number(part) for part in (*parts[:-1], last)]
    known = [Decimal(repr(number)) for number in numbers if number is not None]
    if len(known) != 3:
        raise SpecError(f"{spelt(key)} must be swept by FIRST:LAST:STEP, such as -2:2:0.5; got {shown(values)}.")
    first, end, step = known
    if step == 0 or (end - first) * step < 0:
        raise SpecError(f"{spelt(key)} must be swept by a step that leads from first to last; got {shown(values)}.")
    count = ((end - first) / step).to_integral_value(ROUND_FLOOR) + 1
    if count > MOST_VALUES:
        raise SpecError(f"{spelt(key)} must take at most {MOST_VALUES} values; got {count:.4g}.")
    tail = f" {unit}" if unit else ""
    return key, tuple(f"{float(first + k * step):.15g}{tail}" for k in range(int(count)))


def _counted(key: str, values: list[str]) -> tuple[str, ...]:
    if len(values) > MOST_VALUES:
        raise SpecError(f"{spelt(key)} must take at most {MOST_VALUES} values; got {len(values)}.")
    if not all(values):
        raise SpecError(f"{spelt(key)} must have a value between commas; got none.")
    return tuple(values)


def _with_unit(text: str) -> tuple[str, str]:
    """A number and the unit behind it, each perhaps empty."""
    match = re.fullmatch(r"([-+0-9.]*(?:[eE][-+]?[0-9]+)?)\s*(.*)", text, re.DOTALL)
    return (match[1], match[2]) if match else ("", text)


def edit(model: FemmModel, changes: Mapping[str, str]) -> FemmModel:
    """The model with every change made, in their order.

    Raises SpecError, one sentence that names the key and what is possible; MeshError where a group of labels without
    lines of its own is moved in a drawing without faces.
    """
    for key, text in changes.items():
        model = _changed(model, key, text)
    return model


def _changed(model: FemmModel, key: str, text: str) -> FemmModel:
    kind, _, rest = key.partition(".")
    known = key in ("depth", *KINDS) or kind in KINDS
    if not known:
        raise SpecError(f"{spelt(key)} must begin with {', '.join(KINDS)} or be depth; it does not.")
    if kind == "depth":
        if model.axisymmetric or rest:
            raise SpecError(f"{spelt(key)} must be the depth of a planar file; this one has none.")
        return replace(model, depth=_length(model, key, text, 1e-12))
    return KINDS[kind](model, key, rest, text)


def _circuit(model: FemmModel, key: str, rest: str, text: str) -> FemmModel:
    chosen, what = _chosen("circuit", model.circuits, key, rest, CIRCUIT)
    current = CIRCUIT[what].read(spelt(key), text)
    items = model.circuits
    return replace(
        model,
        circuits=tuple(CircuitProperty(c.name, current, c.series) if k in chosen else c for k, c in enumerate(items)),
    )


def _point(model: FemmModel, key: str, rest: str, text: str) -> FemmModel:
    chosen, what = _chosen("point", model.points, key, rest, POINT)
    value = POINT[what].read(spelt(key), text)

    def new(item: PointProperty) -> PointProperty:
        if what == "current" and not value:  # FEMM knows no point that does nothing but one of A = 0
            raise SpecError(f"{spelt(key)} must not be zero, which would prescribe the potential; got {shown(text)}.")
        return PointProperty(item.name, value) if what == "potential" else PointProperty(item.name, None, value)

    return replace(model, points=tuple(new(p) if k in chosen else p for k, p in enumerate(model.points)))


def _material(model: FemmModel, key: str, rest: str, text: str) -> FemmModel:
    chosen, what = _chosen("material", model.materials, key, rest, MATERIAL)
    value = MATERIAL[what].read(spelt(key), text)

    def new(item: BlockProperty) -> BlockProperty:
        if what in ("mu_x", "mu_y") and item.curve:
            raise SpecError(f"{spelt(key)} must be of a material without a B-H curve; {shown(item.name)} has one.")
        match what:
            case "mu_x":
                return replace(item, mu_x=value)
            case "mu_y":
                return replace(item, mu_y=value)
            case "coercivity":
                return replace(item, coercivity=value)
            case "current_density":
                return replace(item, current_density=value)
            case "conductivity":
                return replace(item, conductivity=value)
            case _:
                return replace(item, fill=value)

    return replace(model, materials=tuple(new(m) if k in chosen else m for k, m in enumerate(model.materials)))


def _boundary(model: FemmModel, key: str, rest: str, text: str) -> FemmModel:
    chosen, what = _chosen("boundary", model.boundaries, key, rest, BOUNDARY)
    value = BOUNDARY[what].read(spelt(key), text)
    wanted = KIND_OF_BOUNDARY.get(what, "mixed")
    items = list(model.boundaries)
    for number in chosen:
        item = items[number]
        if item.kind != wanted:
            raise SpecError(f"{spelt(key)} must be of a {wanted} boundary; {shown(item.name)} is {item.kind}.")
        old = {name: getattr(item, name) for name in BOUNDARY}
        items[number] = type(item)(item.name, item.kind, **{**old, what: value})
    return replace(model, boundaries=tuple(items))


def _group(model: FemmModel, key: str, rest: str, text: str) -> FemmModel:
    name, _, what = rest.partition(".")
    known = sorted(groups(model))
    if name.strip().removeprefix("-").isdecimal() and int(name) in known:
        group = int(name)
    else:
        numbers = ", ".join(map(str, known[:20])) + (", ..." if len(known) > 20 else "")
        raise SpecError(f"{spelt(key)} must name a group of the file, one of {numbers}; got {shown(name)}.")
    motions = ("displacement.z",) if model.axisymmetric else ("displacement.x", "displacement.y", "rotation")
    if what in motions:
        if group == 0:
            raise SpecError(f"{spelt(key)} must move a numbered group; group 0 is whatever belongs to none.")
        if what == "rotation":
            motion = Motion(angle=_degrees(key, text))
        elif what == "displacement.x":
            motion = Motion(x=_length(model, key, text))
        else:
            motion = Motion(y=_length(model, key, text))
        return moved(model, group, motion)
    if what not in ("magnetisation", "turns"):
        chart = "an axisymmetric" if model.axisymmetric else "a planar"
        can = ", ".join(("magnetisation", "turns", *motions))
        raise SpecError(f"{spelt(key)} must end in one of {can}, in {chart} file; got {shown(what)}.")
    new: Callable[[BlockLabel], BlockLabel]
    if what == "magnetisation":
        direction = _direction(key, text)
        members = [k for k, label in enumerate(model.labels) if label.group == group]

        def new(label: BlockLabel) -> BlockLabel:
            return replace(label, magnetisation=direction)
    else:
        turns = Value(least=-1e9, most=1e9).read(spelt(key), text)
        members = [k for k, label in enumerate(model.labels) if label.group == group and label.circuit is not None]

        def new(label: BlockLabel) -> BlockLabel:
            return replace(label, turns=turns)

    if not members:
        missing = "a block label" if what == "magnetisation" else "a block label with a circuit"
        raise SpecError(f"{spelt(key)} must name a group with {missing}; group {group} has none.")
    return replace(model, labels=tuple(new(label) if k in members else label for k, label in enumerate(model.labels)))


def groups(model: FemmModel) -> set[int]:
    """Every number that anything of the file carries."""
    kinds = (model.nodes, model.segments, model.arcs, model.holes, model.labels)
    return {item.group for kind in kinds for item in kind}


KINDS: dict[str, Callable[[FemmModel, str, str, str], FemmModel]] = {
    "circuit": _circuit,
    "group": _group,
    "material": _material,
    "boundary": _boundary,
    "point": _point,
}


def _chosen(
    kind: str, items: Sequence[_N], key: str, rest: str, properties: Mapping[str, Value]
) -> tuple[set[int], str]:
    """The items that a key names and which of their properties: of several names that fit, the longest one's."""
    fits = []
    for name in {item.name for item in items}:
        for written in (name, f'"{name}"'):
            if rest.startswith(f"{written}."):
                what = rest[len(written) + 1 :]
                fits.append((what in properties, len(written), name, what))
    if not fits:
        names = ", ".join(f'"{one_line(item.name)}"' for item in items[:20])
        there = f"one of {names}{', ...' if len(items) > 20 else ''}" if items else "of which the file has none"
        raise SpecError(f"{spelt(key)} must name a {kind} of the file, {there}, and one of {', '.join(properties)}.")
    right, _, name, what = max(fits)
    if not right:
        raise SpecError(f"{spelt(key)} must end in one of {', '.join(properties)}; got {shown(what)}.")
    return {number for number, item in enumerate(items) if item.name == name}, what


def _direction(key: str, text: str) -> float | str:
    """Degrees, or a formula that can be read."""
    number = bare_number(text)
    if number is not None:
        return number
    if text.strip().endswith(("deg", "rad")):
        return _degrees(key, text)
    formula = text.strip().strip('"')
    try:
        parse_formula(formula)
    except SpecError as error:
        raise SpecError(f"{spelt(key)}: {error}") from error
    return formula


def _degrees(key: str, text: str) -> float:
    number = bare_number(text)
    # As rad / (pi / 180) a right angle would miss itself by a rounding.
    return number if number is not None else round(degrees(parse_quantity(text, "angle", spelt(key))), 12)


def _length(model: FemmModel, key: str, text: str, least: float = -1e6) -> float:
    """In the file's unit. least : m."""
    metres = Value("length", bare=model.metres, least=least, most=1e6).read(spelt(key), text)
    number = bare_number(text)
    return number if number is not None else metres / model.metres
