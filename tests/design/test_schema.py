"""The JSON Schema: it knows every key, and it takes and refuses what the reader takes and refuses."""

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fluxbore.design.errors import DesignError, FluxboreError, MaterialError
from fluxbore.design.schema import json_schema
from fluxbore.design.spec import KINDS, loads
from fluxbore.design.spec_file import _plain, template, to_toml

SCHEMA = json_schema()
EXAMPLES = Path(__file__).parents[2] / "examples"
RAW = tomllib.loads(template("ipehla"))
KEYS = {key.name: key for key in KINDS["hybrid"].keys}
TYPES: dict[str, tuple[type, ...]] = {
    "object": (dict,), "array": (list,), "string": (str,), "number": (int, float), "integer": (int,),
    "boolean": (bool,),
}  # fmt: skip
WORDS = {
    "type", "const", "enum", "pattern", "minimum", "maximum", "exclusiveMinimum", "items", "minItems",
    "maxItems", "maxLength", "properties", "additionalProperties", "required", "anyOf", "oneOf", "allOf", "if", "then",
}  # fmt: skip
REMARKS = {"$schema", "title", "description", "examples", "default"}


def fits(schema: Any, value: Any) -> bool:
    """Whether the value meets the schema: the part of JSON Schema 2020-12 that ours uses, and no other word."""
    if isinstance(schema, bool):
        return schema
    assert set(schema) <= WORDS | REMARKS, set(schema) - WORDS - REMARKS
    types = schema.get("type", [])
    types = [types] if isinstance(types, str) else types
    if types and not any(isinstance(value, TYPES[t]) and (isinstance(value, bool) == (t == "boolean")) for t in types):
        return False
    if "const" in schema and value != schema["const"]:
        return False
    if "enum" in schema and value not in schema["enum"]:
        return False
    if isinstance(value, str):
        pattern = schema.get("pattern", "")
        # ECMA's $ is the end of the text, Python's stands before a last line feed too.
        if not re.search(re.sub(r"\$$", r"\\Z", pattern), value) or len(value) > schema.get("maxLength", len(value)):
            return False
    elif isinstance(value, (int, float)):
        if not schema.get("minimum", value) <= value <= schema.get("maximum", value):
            return False
        if "exclusiveMinimum" in schema and not value > schema["exclusiveMinimum"]:
            return False
    elif isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            return False
        if not all(fits(schema.get("items", True), item) for item in value):
            return False
    elif isinstance(value, dict):
        known, others = schema.get("properties", {}), schema.get("additionalProperties", True)
        if not set(schema.get("required", ())) <= set(value):
            return False
        if not all(fits(known.get(key, others), item) for key, item in value.items()):
            return False
    branches = [fits(branch, value) for branch in schema.get("oneOf", ())]
    return (
        all(fits(branch, value) for branch in schema.get("allOf", ()))
        and (not schema.get("anyOf") or any(fits(branch, value) for branch in schema["anyOf"]))
        and (not branches or branches.count(True) == 1)
        and (not fits(schema.get("if", False), value) or fits(schema.get("then", True), value))
    )


def changed(name: str, value: Any) -> dict[str, Any]:
    """The example with another raw value at a dotted key."""
    *path, leaf = name.split(".")
    tree = tomllib.loads(template("ipehla"))
    table = tree
    for step in path:
        table = table.setdefault(step, {})
    table[leaf] = value
    return tree


def toml(tree: dict[str, Any]) -> str:
    return "\n".join(f"{key} = {_plain(value)}" for key, value in tree.items())


def reads(tree: dict[str, Any]) -> bool:
    """Whether the reader takes each value as such; that parts collide or keys contradict is beyond any schema."""
    try:
        loads(toml(tree))
    except DesignError:
        return True
    except FluxboreError as error:
        return isinstance(error, MaterialError) or any(
            word in str(error) for word in ("must lie within", "must not be below", "determined")
        )
    return True


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.toml")), ids=lambda path: path.stem)
def test_examples_and_what_is_written_fit(path):
    text = path.read_text(encoding="utf-8")
    assert fits(SCHEMA, tomllib.loads(text))
    assert fits(SCHEMA, tomllib.loads(to_toml(loads(text))))


def test_every_key_is_in_the_schema_with_its_meaning():
    """Catches a key that an editor would underline."""
    for name, key in KEYS.items():
        node = next(
            each
            for each in SCHEMA["oneOf"]
            if each["properties"]["actuator"]["properties"]["kind"] == {"const": "hybrid"}
        )
        for step in name.split("."):
            node = node["properties"][step]
        assert key.doc in node["description"]


def test_what_a_person_gets_wrong_most_is_refused():
    for name, value in {
        "actuator.back_yoke.thickness": 1,
        "actuator.back_yoke.thicknes": "1 mm",
        "actuator.yoke": {},
        "actuator.winding.turns": "584",
        "actuator.winding.sets_per_phase": 8.5,
        "actuator.kind": "rotary",
        "operating_point.pressure": "0.6 MPa",
        "solver.factorisation": "magic",
        "study.objective": "maximise thrust",
        "study.search": {"algorithm": "SIMPLEX"},
        "study.search.time_limit": 600,
        "study.search.max_evaluations": 10_000_000,
        "study.search.seed": 2**31,
        "study.goal": 1,
        "study.pareto": {"points": 5},
        "study.pareto.against": "minimise weight",
        "study.production": {"samples": 1000},
        "study.production.tolerances": [],
        "study.variables": [{"key": "actuator.mover.ring_width", "lower": "1 mm"}],
        "study.constraints": [{"key": "actuator.mover.ring_width", "upper": "1 T"}],
        "study.sweeps": [{"axes": [{"key": "actuator.mover.ring_width", "values": [1]}]}],
        "study.hold": "actuator.winding.turns_density",
        "materials": {"mine": {"type": "soft iron"}},
        "extra": {},
    }.items():
        assert fits(SCHEMA, RAW)
        assert not fits(SCHEMA, changed(name, value)), name
        assert not reads(changed(name, value)), name


YOKE, HEAT, SETS = (
    "actuator.back_yoke.thickness",
    "operating_point.magnet_temperature",
    "actuator.winding.sets_per_phase",
)


@pytest.mark.parametrize(
    "name, items",
    [
        ("variables", [{"key": SETS, "lower": 6, "upper": 9, "resolution": 1}]),
        ("variables", [{"key": SETS, "lower": 6.5, "upper": 9}]),
        ("variables", [{"key": "operating_point.positions", "lower": 6, "upper": 9}]),
        ("variables", [{"key": "actuator.name", "lower": 6, "upper": 9}]),
        ("production", {"tolerances": [{"key": YOKE}]}),
        ("production", {"tolerances": [{"key": YOKE, "tolerance": 0.01}]}),
        ("production", {"tolerances": [{"key": YOKE, "tolerance": "1 K"}]}),
        ("production", {"tolerances": [{"key": YOKE, "plus": "1 um"}]}),
        ("production", {"tolerances": [{"key": YOKE, "tolerance": "1 um", "plus": "1 um", "minus": "1 um"}]}),
        ("production", {"tolerances": [{"key": YOKE, "tolerance": "1 um", "distribution": "gauss"}]}),
        ("production", {"tolerances": [{"key": SETS, "tolerance": 1}]}),
        ("production", {"tolerances": [{"key": YOKE, "tolerance": "1 um"}], "yield": 1}),
        ("production", {"tolerances": [{"key": YOKE, "tolerance": "1 um"}], "samples": 1}),
        ("pareto", {"against": "minimise total_mass", "points": 2}),
        ("pareto", {"against": "minimise total_mass", "method": "weights"}),
        ("search", {"network": "on"}),
        ("search", {"time_limit": "600"}),
    ],
)
def test_what_is_wrong_in_a_study_is_wrong_to_both(name, items):
    assert not fits(SCHEMA, changed(f"study.{name}", items))
    assert not reads(changed(f"study.{name}", items))


STUDIES = {
    "study.variables": [
        {"key": "operating_point.magnet_temperature", "lower": "20 degC", "upper": "80 degC", "resolution": "5 K"},
        {"key": "actuator.winding.turns_density", "lower": "1 1/mm^2", "upper": "5 1/mm^2"},
        {"key": SETS, "lower": 6, "upper": 9},
    ],
    "study.pareto": {"against": "minimise total_mass", "points": 3, "method": "normal boundary intersection"},
    "study.search": {"algorithm": "auto", "time_limit": "10 min", "network": "off"},
    "study.production": {
        "yield": 0.9,
        "samples": 100,
        "tolerances": [
            {"key": YOKE, "tolerance": "0.05 mm"},
            {"key": HEAT, "plus": "5 K", "minus": "9 degF", "distribution": "uniform"},
            {"key": "actuator.mover.magnet_permeability", "tolerance": 0.01},
        ],
    },
    "study.constraints": [
        {"key": "actuator.mover.ring_width", "upper": "1.1 x start", "lower": "start"},
        {"key": "actuator.winding.sets_per_phase", "upper": 8.5},
        {"figure": "copper_loss", "upper": 3},
    ],
    "study.sweeps": [
        {"name": "a", "axes": [{"key": "actuator.winding.sets_per_phase", "from": 6, "to": 8, "step": 1}]},
        {"name": "b", "axes": [{"key": "actuator.mover.magnet_permeability", "values": [1, 1.05]}]},
        {"name": "c", "axes": [{"key": "operating_point.pressure", "values": ["2 bar absolute"]}]},
    ],
}


def test_studies_that_are_sound_fit():
    """Catches conditions on units that refuse what the reader takes."""
    for name, value in STUDIES.items():
        tree = changed(name, value)
        tree["study"]["hold"] = []
        assert fits(SCHEMA, tree), name
        assert reads(tree), name


values = st.one_of(
    st.sampled_from(
        [
            "1 mm",
            "0.3 T",
            "20 degC",
            "1 1/mm^2",
            "0.5 MPa gauge",
            "0.5 MPa",
            "1 m m",
            "1mm",
            "",
            " ",
            "1010",
            "N48",
            "1e3 um",
        ]
    ),
    st.sampled_from([0, 1, 4, -1, 1.0, 0.5, 1.2, 1e-9, 1e9, True, [], [1], {}]),
)


@given(st.sampled_from(sorted(KEYS)), values, st.sampled_from([None, "assumed", "calibrated", "guessed"]))
@settings(max_examples=300, deadline=None)
def test_reader_and_schema_agree_on_single_values(name, value, status):
    """Catches an editor that calls sound what fluxbore refuses, or the other way round.

    Limits of quantities are the exception: a pattern cannot compare "0 mm" with "1 um".
    """
    raw = value if status is None else {"value": value, status: "why"}
    key = KEYS[name]
    try:
        key.read(value)
        sound = status != "guessed"
    except FluxboreError as error:
        sound = key.kind == "quantity" and ("must exceed" in str(error) or " at " in str(error)) and status != "guessed"
    assert fits(SCHEMA, changed(name, raw)) == sound
    if sound and key.kind != "quantity":
        assert reads(changed(name, raw))
    if not sound:
        assert not reads(changed(name, raw))
