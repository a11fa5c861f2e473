"""A material's table, ``[materials.NAME]``: its keys, its JSON Schema and its reader."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from fluxbore.design import bh_curve
from fluxbore.design.bh_curve import BHCurve
from fluxbore.design.errors import SpecError
from fluxbore.design.keys import Key, Value
from fluxbore.design.material_kinds import Conductor, Material, PermanentMagnet, SoftIron, Structural
from fluxbore.design.units import ZERO_CELSIUS, quantity_pattern

_SHARED = (
    Key("source", "Where the data are published.", kind="word", default="given in the specification"),
    Key("density", "Mass density.", dimension="density", above=0.0),
    Key("young_modulus", "Young's modulus.", dimension="stress", above=0.0, optional=True),
    Key("poisson_ratio", "Poisson's ratio.", kind="number", above=-1.0, maximum=0.5, optional=True),
    Key("yield_stress", "Yield stress.", dimension="stress", above=0.0, optional=True),
    Key("thermal_conductivity", "At 20 degC.", dimension="thermal conductivity", above=0.0, optional=True),
    Key("thermal_expansion", "Of a length, at 20 degC.", dimension="temperature coefficient", optional=True),
)

_OWN: dict[str, tuple[Key, ...]] = {
    "soft iron": (
        Key("resistivity", "At 20 degC.", dimension="resistivity", above=0.0, optional=True),
        Key(
            "hysteresis_coefficient",
            "Loss of one cycle at 1 T, k_h of k_h f B^n.",
            dimension="energy density",
            minimum=0.0,
            optional=True,
        ),
        Key("hysteresis_exponent", "n of k_h f B^n.", kind="number", minimum=1.0, maximum=4.0, default=1.6),
    ),
    "magnet": (
        Key("remanence", "B_r at 20 degC.", dimension="flux density", above=0.0),
        Key("remanence_coefficient", "Relative change of B_r.", dimension="temperature coefficient", default=0.0),
        Key("intrinsic_coercivity", "H_cJ at 20 degC, positive.", dimension="field strength", above=0.0),
        Key("coercivity_coefficient", "Relative change of H_cJ.", dimension="temperature coefficient", default=0.0),
        Key("recoil_permeability", "mu_r of the recoil line.", kind="number", minimum=1.0, default=1.05),
        Key(
            "working_temperature",
            "Up to which the coefficients hold.",
            dimension="temperature",
            above=ZERO_CELSIUS,
            optional=True,
        ),
    ),
    "conductor": (
        Key("resistivity", "At 20 degC.", dimension="resistivity", above=0.0),
        Key("temperature_coefficient", "Of the resistivity.", dimension="temperature coefficient", default=0.0),
    ),
    "structural": (Key("resistivity", "At 20 degC.", dimension="resistivity", above=0.0, optional=True),),
}

_BH_DOC = "Magnetisation curve as pairs of bare numbers [B in T, H in A/m], both increasing; the origin is understood."
_BH_FILE_DOC = "A text file of the magnetisation curve, a line B,H in T and A/m a point; relative to this file."


def from_table(name: str, raw: Mapping[str, object], key_prefix: str = "", base: Path | None = None) -> Material:
    """The material that a table ``[materials.NAME]`` describes.

    key_prefix : the table's dotted key, by default ``materials.NAME``; sentences name keys below it.
    base : the folder to which ``bh_file`` is relative; the working folder by default.

    ``bh`` is the one place of a specification where numbers stand without a unit: pairs of T and A/m.
    Raises SpecError for a wrong key, unit or limit, MaterialError for a curve that no material has.
    """
    prefix = key_prefix or f"materials.{name}"
    if not isinstance(raw, Mapping):
        raise SpecError(f"{prefix} must be a section of its own, [{prefix}]; got {raw!r}.")
    kind = raw.get("type")
    if not isinstance(kind, str) or kind not in _OWN:
        found = "none" if kind is None else f'"{kind}"'
        raise SpecError(f"{prefix}.type must be one of {', '.join(_OWN)}; got {found}.")
    keys = _SHARED + _OWN[kind]
    curve_keys = ("bh", "bh_file") if kind == "soft iron" else ()
    known = ("type", *(key.name for key in keys), *curve_keys)
    for unknown in (key for key in raw if key not in known):
        raise SpecError(f'{prefix}.{unknown} is no key of a material of type "{kind}", which has {", ".join(known)}.')
    values: dict[str, Value | None] = {}
    for key in keys:
        if key.name in raw:
            values[key.name] = replace(key, name=f"{prefix}.{key.name}").read(raw[key.name])
        elif key.default is None and not key.optional:
            raise SpecError(f'{prefix}.{key.name} must be given for a material of type "{kind}"; got none.')
        else:
            values[key.name] = key.default
    curve = _curve(name, raw, prefix, str(values["source"]), base or Path()) if kind == "soft iron" else None
    return _build(name, kind, values, curve)


def schema() -> dict[str, object]:
    """The JSON Schema (2020-12) of one material's table."""
    return {"type": "object", "required": ["type"], "oneOf": [_schema_of(kind) for kind in _OWN]}


_KINDS: dict[str, type[Material]] = {
    "soft iron": SoftIron,
    "magnet": PermanentMagnet,
    "conductor": Conductor,
    "structural": Structural,
}
"""A table's ``type`` and what it becomes; the keys of a table are the fields' names."""


def _build(name: str, kind: str, values: Mapping[str, Value | None], curve: BHCurve | None) -> Material:
    fields: dict[str, Any] = dict(values)
    if curve is not None:
        fields["curve"] = curve
    return _KINDS[kind](name=name, **fields)


def _curve(name: str, raw: Mapping[str, object], prefix: str, source: str, base: Path) -> BHCurve:
    given = [key for key in ("bh", "bh_file") if key in raw]
    if len(given) != 1:
        raise SpecError(
            f"{prefix} must have exactly one of {prefix}.bh and {prefix}.bh_file; got {' and '.join(given) or 'none'}."
        )
    if given == ["bh"]:
        points = raw["bh"]
        if not isinstance(points, (list, tuple)):
            raise SpecError(f"{prefix}.bh must be a list of pairs [B in T, H in A/m]; got {points!r}.")
        return bh_curve.from_points(name, points, source, f"{prefix}.bh")
    path = raw["bh_file"]
    if not isinstance(path, str) or not path.strip():
        raise SpecError(f"{prefix}.bh_file must be a file's name in quotes; got {path!r}.")
    return bh_curve.read_csv(name, base / path, source, f"{prefix}.bh_file")


def _schema_of(kind: str) -> dict[str, object]:
    keys = _SHARED + _OWN[kind]
    properties: dict[str, object] = {"type": {"const": kind}, **{key.name: _property(key) for key in keys}}
    schema: dict[str, object] = {
        "title": kind,
        "type": "object",
        "properties": properties,
        "required": ["type", *(key.name for key in keys if key.default is None and not key.optional)],
        "additionalProperties": False,
    }
    if kind == "soft iron":
        pair = {"type": "array", "items": {"type": "number", "minimum": 0}, "minItems": 2, "maxItems": 2}
        properties["bh"] = {"description": _BH_DOC, "type": "array", "items": pair, "minItems": 2}
        properties["bh_file"] = {"description": _BH_FILE_DOC, "type": "string"}
        schema["oneOf"] = [{"required": ["bh"]}, {"required": ["bh_file"]}]
    return schema


def _property(key: Key) -> dict[str, object]:
    described: dict[str, object] = {"description": key.doc}
    if key.kind == "quantity":
        return described | {"type": "string", "pattern": quantity_pattern(key.dimension)}
    if key.kind == "number":
        limits = {"exclusiveMinimum": key.above, "minimum": key.minimum, "maximum": key.maximum}
        return described | {"type": "number"} | {word: limit for word, limit in limits.items() if limit is not None}
    return described | {"type": "string"}
