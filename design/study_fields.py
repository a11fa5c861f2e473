"""What every part of a study is read with: tables, dotted keys, figures, and values of a key's dimension."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from decimal import Decimal
from typing import Any

from fluxbore.design.errors import SpecError, shown
from fluxbore.design.keys import Key
from fluxbore.design.performance import FIGURES
from fluxbore.design.specification import suggestion
from fluxbore.design.study import Objective
from fluxbore.design.units import DIMENSIONS

PERCENTAGE = re.compile(r"^ *([+-]?[0-9]{1,17}(?:\.[0-9]{1,17})?) *% *$")
"""A fraction as people write it."""


def tables(raw: Mapping[str, Any], name: str) -> list[dict[str, Any]]:
    """The list of tables at ``study.NAME``; an absent one is empty."""
    items = raw.get(name.rpartition(".")[2], [])
    if not isinstance(items, list) or not all(isinstance(item, dict) for item in items):
        raise SpecError(f"study.{name} must be a list of tables, each headed [[study.{name}]]; got {shown(items)}.")
    return items


def allow(raw: object, where: str, allowed: Sequence[str]) -> None:
    """Refuse what is no table at ``where``, and keys that it does not have."""
    if not isinstance(raw, Mapping):
        raise SpecError(f"{where} must be a section of keys; got {shown(raw)}.")
    for key in raw:
        if key not in allowed:
            hint = suggestion(key, allowed)
            raise SpecError(
                f"{where}.{key} is not a key of this specification{hint}; {where} has {', '.join(allowed)}."
            )


def known_figure(name: object, where: str) -> str:
    """The name, if it is a figure's."""
    if not isinstance(name, str) or name not in FIGURES:
        hint = suggestion(name, FIGURES) if isinstance(name, str) else ""
        raise SpecError(f"{where} must name a figure, such as force_constant or total_mass{hint}; got {shown(name)}.")
    return name


def figure_key(name: str) -> Key:
    """How a value of this figure is read and written."""
    dimension = FIGURES[name].dimension
    return Key(name, "", "quantity" if dimension in DIMENSIONS else "number", dimension)


def numeric_key(raw: Mapping[str, Any], where: str, known: Mapping[str, Key], *, integers: bool) -> Key:
    """The key that the table ``raw`` names under ``key``: a quantity or a number, or with ``integers`` any count."""
    name = raw.get("key")
    key = known.get(name) if isinstance(name, str) else None
    if key is None:
        hint = suggestion(name, known) if isinstance(name, str) else ""
        raise SpecError(f"{where}.key must be a dotted key of this specification{hint}; got {shown(name)}.")
    if key.kind == "word" or (key.kind == "integer" and not integers) or not key.of_design:
        kinds = "a dimension, a number or a count" if integers else "a continuous quantity"
        raise SpecError(f"{where}.key must name {kinds}; got {key.name}, which is {_kind_word(key)}.")
    return key


def _kind_word(key: Key) -> str:
    if not key.of_design:
        return f"a setting of the {key.name.partition('.')[0]}"
    return {"word": "a word", "integer": "a count"}.get(key.kind, "a quantity")


def read_value(raw: object, key: Key, where: str) -> float:
    """A number of ``key``'s dimension that stands at ``where`` in the file; the key's limits do not apply."""
    if key.dimension == "fraction":
        raw = fraction(raw, where)
    return float(Key(where, key.doc, key.kind, key.dimension).read(raw))


def fraction(raw: object, where: str) -> object:
    """The number for a percentage in quotes, anything else but a text as it is. Raises SpecError at other texts."""
    if not isinstance(raw, str):
        return raw
    match = PERCENTAGE.match(raw)
    if match is None:
        raise SpecError(f'{where} must be a fraction, such as 0.55 or "55 %"; got {shown(raw)}.')
    return float(Decimal(match.group(1)).scaleb(-2))  # 99 % is the float 0.99, which 99 / 100 need not be


def check_at(key: Key, value: float, where: str) -> None:
    """Hold a value of the study against its key's own limits."""
    try:
        key.check(value)
    except SpecError as error:
        raise SpecError(f"{where}: {error}") from error


def loose(key: Key) -> Key:
    """A count's limit may be a fraction; the limit of a quantity keeps its dimension."""
    return Key(key.name, key.doc, "number" if key.kind == "integer" else key.kind, key.dimension)


def read_objective(raw: object, where: str) -> Objective:
    """The figure to maximise or to minimise that the text at ``where`` names."""
    words = raw.split() if isinstance(raw, str) else []
    if len(words) != 2 or words[0] not in ("maximise", "minimise"):
        raise SpecError(
            f'{where} must be "maximise FIGURE" or "minimise FIGURE", such as "maximise force_constant"; '
            f"got {shown(raw)}."
        )
    return Objective(known_figure(words[1], where), words[0] == "maximise")


def read_settings(raw: object, where: str, keys: Sequence[Key], others: Sequence[str] = ()) -> dict[str, Any]:
    """Leaf -> value of the table at ``where``, the keys' defaults where it is silent.

    others : keys that the table may hold besides, and that are read elsewhere.
    """
    allow(raw, where, (*others, *(key.leaf for key in keys)))
    assert isinstance(raw, Mapping)
    return {key.leaf: key.read(raw[key.leaf]) if key.leaf in raw else key.default for key in keys}
