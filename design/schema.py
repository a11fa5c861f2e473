"""The JSON Schema of a specification, so that editors complete and check it while one types."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from fluxbore.design.keys import LONGEST_WORD, Key
from fluxbore.design.material_table import schema as material_schema
from fluxbore.design.performance import FIGURES
from fluxbore.design.spec import KINDS
from fluxbore.design.study import DISTRIBUTIONS
from fluxbore.design.study_fields import PERCENTAGE
from fluxbore.design.study_production_reader import PRODUCTION_KEYS
from fluxbore.design.study_search_reader import PARETO_KEYS, SEARCH_KEYS
from fluxbore.design.study_variable_reader import movable
from fluxbore.design.units import DIMENSIONS, example, quantity_pattern

_PERCENTAGE = {"type": "string", "pattern": PERCENTAGE.pattern, "examples": ["99 %"]}


def json_schema() -> dict[str, Any]:
    """The schema (JSON Schema draft 2020-12) of every kind of actuator's specification."""
    kinds = [_of_kind(kind.name, kind.keys) for kind in KINDS.values()]
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "fluxbore specification",
        **(kinds[0] if len(kinds) == 1 else {"oneOf": kinds}),
    }


def _of_kind(name: str, keys: tuple[Key, ...]) -> dict[str, Any]:
    tree: dict[str, Any] = {"type": "object", "properties": {}, "additionalProperties": False}
    for key in keys:
        node = tree
        for step in key.section.split("."):
            node = node["properties"].setdefault(
                step, {"type": "object", "properties": {}, "additionalProperties": False}
            )
        node["properties"][key.leaf] = _annotatable(key)
    tree["properties"]["actuator"]["properties"]["kind"] = {"const": name}
    tree["properties"]["actuator"]["required"] = ["kind"]
    tree["properties"]["materials"] = {"type": "object", "additionalProperties": material_schema()}
    tree["properties"]["study"] = _study([key for key in keys if key.kind != "word" and key.of_design])
    tree["required"] = ["actuator"]
    return tree


def _annotatable(key: Key) -> dict[str, Any]:
    """The key's value, plain or with the reason why it is assumed or calibrated."""
    value = _value(key)
    noted = [
        {
            "type": "object",
            "properties": {"value": value, status: {"type": "string"}},
            "required": ["value", status],
            "additionalProperties": False,
        }
        for status in ("assumed", "calibrated")
    ]
    symbol = f" ({key.symbol})" if key.symbol else ""
    return {"description": key.doc + symbol, "anyOf": [value, *noted]}


def _value(key: Key) -> dict[str, Any]:
    if key.kind == "quantity":
        return _quantity(key.dimension)
    if key.kind == "word":
        return {"type": "string", "enum": list(key.choices)} if key.choices else _text()
    limits = {"exclusiveMinimum": key.above, "minimum": key.minimum, "maximum": key.maximum}
    kind = "integer" if key.kind == "integer" else "number"
    value = {"type": kind, **{name: limit for name, limit in limits.items() if limit is not None}}
    return {"anyOf": [value, _PERCENTAGE]} if key.dimension == "fraction" else value


def _text() -> dict[str, Any]:
    """Text with something to see in it."""
    return {"type": "string", "pattern": r"\S", "maxLength": LONGEST_WORD}


def _quantity(dimension: str) -> dict[str, Any]:
    units = ", ".join(DIMENSIONS[dimension].units)
    return {
        "type": "string",
        "pattern": quantity_pattern(dimension),
        "description": f"{dimension}: one number and one of {units}",
        "examples": [example(dimension).strip('"')],
    }


def _bounds(
    keys: Iterable[Key],
    values: Iterable[str],
    steps: Iterable[str] = (),
    *,
    relative: bool = False,
    stepped: bool = True,
) -> Any:
    """Conditions: where ``key`` names a length, ``values`` and ``steps`` are lengths, and so on.

    stepped : whether counts have ``steps`` too.
    """
    kinds: dict[tuple[str, str], list[Key]] = {}
    for key in keys:
        kinds.setdefault((key.kind, key.dimension if key.kind == "quantity" else ""), []).append(key)
    conditions = []
    for alike in kinds.values():
        value, step = (_measure(key, relative=relative) for key in (alike[0], alike[0].difference))
        counted = alike[0].kind == "integer" and not stepped
        then: dict[str, Any] = dict.fromkeys(values, value) | dict.fromkeys(steps, False if counted else step)
        if "values" in then:
            then["values"] = {"type": "array", "items": value, "minItems": 1}
        named = {"properties": {"key": {"enum": [key.name for key in alike]}}, "required": ["key"]}
        conditions.append({"if": named, "then": {"properties": then}})
    return {"allOf": conditions}


def _measure(key: Key, *, relative: bool) -> dict[str, Any]:
    """A value of a key without the key's own limits; ``relative`` ones may refer to the start design."""
    if key.kind == "quantity":
        value = _quantity(key.dimension)
    else:
        value = {"type": "integer" if key.kind == "integer" and not relative else "number"}
    return {"anyOf": [value, {"type": "string", "pattern": "start *$"}]} if relative else value


def _study(numeric: Sequence[Key]) -> dict[str, Any]:
    bound = {"type": ["string", "number"]}
    key = {"enum": [item.name for item in numeric]}
    continuous = [item for item in numeric if item.kind != "integer"]
    axis = _table(
        {"key": key, "from": bound, "to": bound, "step": bound, "values": {"type": "array", "items": bound}}, ("key",)
    ) | _bounds(numeric, ("from", "to", "values"), ("step",))
    figure = {"enum": list(FIGURES)}
    goal = {"enum": [f"{verb} {name}" for verb in ("maximise", "minimise") for name in FIGURES]}
    moved = [item for item in numeric if movable(item)]
    return _table(
        {
            "objective": goal,
            "hold": {"type": "array", "items": {"type": "string"}},
            "variables": _tables(
                {
                    "key": {"enum": [item.name for item in moved]},
                    "lower": bound,
                    "upper": bound,
                    "resolution": bound,
                },
                ("key", "lower", "upper"),
                _bounds(moved, ("lower", "upper"), ("resolution",), stepped=False),
            ),
            "constraints": _tables(
                {"figure": figure, "key": key, "upper": bound, "lower": bound},
                (),
                _bounds(numeric, ("lower", "upper"), relative=True),
            ),
            "sweeps": _tables(
                {
                    "name": _text(),
                    "axes": {"type": "array", "items": axis, "minItems": 1},
                    "published_optimum": bound,
                    "published": {
                        "type": "array",
                        "items": {"type": "array", "items": bound, "minItems": 2, "maxItems": 2},
                        "minItems": 1,
                    },
                    "source": _text(),
                },
                ("axes",),
            ),
            "search": _table(_settings(SEARCH_KEYS)),
            "pareto": _table({"against": goal, **_settings(PARETO_KEYS)}, ("against",)),
            "production": _production(continuous),
        }
    )


def _settings(keys: Iterable[Key]) -> dict[str, Any]:
    """The properties of a table that is read by these keys."""
    return {key.leaf: _value(key) | {"description": key.doc} for key in keys}


def _production(continuous: Sequence[Key]) -> dict[str, Any]:
    size = {"type": ["string", "number"]}
    tolerances = _tables(
        {
            "key": {"enum": [item.name for item in continuous]},
            "tolerance": size,
            "plus": size,
            "minus": size,
            "distribution": {"enum": list(DISTRIBUTIONS)},
        },
        ("key",),
        _bounds(continuous, (), ("tolerance", "plus", "minus"))
        | {
            "oneOf": [
                {"required": ["tolerance"], "properties": {"plus": False, "minus": False}},
                {"required": ["plus", "minus"], "properties": {"tolerance": False}},
            ]
        },
    )
    return _table({**_settings(PRODUCTION_KEYS), "tolerances": tolerances | {"minItems": 1}}, ("tolerances",))


def _table(properties: dict[str, Any], required: tuple[str, ...] = ()) -> dict[str, Any]:
    return {
        "type": "object",
        "properties": properties,
        "required": list(required),
        "additionalProperties": False,
    }


def _tables(
    properties: dict[str, Any], required: tuple[str, ...], conditions: dict[str, Any] | None = None
) -> dict[str, Any]:
    return {"type": "array", "items": _table(properties, required) | (conditions or {})}
