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

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from math import degrees
from typing import Protocol, TypeVar

from fluxbore.design.errors import SpecError, one_line, shown
from fluxbore.design.units import parse_quantity
from fluxbore.fem.femm_model import BlockProperty, CircuitProperty, FemmModel, PointProperty
from fluxbore.fem.femm_move import Motion, members, moved
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


def edit(model: FemmModel, changes: Mapping[str, str]) -> FemmModel:
    """The model with every change made, in their order.

    Raises SpecError, one sentence that names the key and what is possible; MeshError where a group of labels without
    lines of its own is moved in a drawing without faces.
    """
    drawn = model  # what belongs to a group is told from the file: half of a motion may lead through a wall
    for key, text in changes.items():
        model = _changed(model, key, text, drawn)
    return model


def _changed(model: FemmModel, key: str, text: str, drawn: FemmModel) -> FemmModel:
    kind, _, rest = key.partition(".")
    known = key in ("depth", *KINDS) or kind in KINDS
    if not known:
        raise SpecError(f"{spelt(key)} must begin with {', '.join(KINDS)} or be depth; it does not.")
    if kind == "depth":
        if model.axisymmetric or rest:
            raise SpecError(f"{spelt(key)} must be the depth of a planar file; this one has none.")
        return replace(model, depth=_length(model, key, text, 1e-12))
    if kind == "group":
        return _group(model, key, rest, text, drawn)
    return PROPERTIES[kind](model, key, rest, text)


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


def _group(model: FemmModel, key: str, rest: str, text: str, drawn: FemmModel) -> FemmModel:
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
        return moved(model, group, members(drawn, group), motion)
    if what == "magnetisation":
        direction = _direction(key, text)
        labels = [replace(b, magnetisation=direction) if b.group == group else b for b in model.labels]
        missing = "a block label"
    elif what == "turns":
        turns = Value(least=-1e9, most=1e9).read(spelt(key), text)
        labels = [replace(b, turns=turns) if b.group == group and b.circuit is not None else b for b in model.labels]
        missing = "a block label with a circuit"
    else:
        chart = "an axisymmetric" if model.axisymmetric else "a planar"
        can = ", ".join(("magnetisation", "turns", *motions))
        raise SpecError(f"{spelt(key)} must end in one of {can}, in {chart} file; got {shown(what)}.")
    if not any(b.group == group and (what != "turns" or b.circuit is not None) for b in model.labels):
        raise SpecError(f"{spelt(key)} must name a group with {missing}; group {group} has none.")
    return replace(model, labels=tuple(labels))


def groups(model: FemmModel) -> set[int]:
    """Every number that anything of the file carries."""
    kinds = (model.nodes, model.segments, model.arcs, model.holes, model.labels)
    return {item.group for kind in kinds for item in kind}


PROPERTIES: dict[str, Callable[[FemmModel, str, str, str], FemmModel]] = {
    "circuit": _circuit,
    "material": _material,
    "boundary": _boundary,
    "point": _point,
}
KINDS = ("circuit", "group", "material", "boundary", "point")


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
