"""Reads what a study is told of the workshop: tolerances, and the share of actuators that must be good."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal
from typing import Any

from fluxbore.design.errors import SpecError, shown
from fluxbore.design.keys import Key, Values
from fluxbore.design.study import DISTRIBUTIONS, Production, Study, Tolerance
from fluxbore.design.study_fields import allow, check_at, fraction, numeric_key, read_settings, read_value, tables
from fluxbore.design.study_search_reader import LARGEST_SEED

_DEFAULT = Production(())

HIGHEST_YIELD = 0.9999
"""Beyond it the tails of the distributions decide, which nobody knows."""

PRODUCTION_KEYS = (
    Key(
        "study.production.samples",
        "actuators in the Monte Carlo on the linear model",
        "integer",
        minimum=100,
        maximum=10_000_000,
        default=_DEFAULT.samples,
    ),
    Key(
        "study.production.checks",
        "of these, how many are computed in full",
        "integer",
        minimum=0,
        maximum=1_000_000,
        default=_DEFAULT.checks,
    ),
    Key("study.production.seed", "of the scatter", "integer", minimum=0, maximum=LARGEST_SEED, default=_DEFAULT.seed),
    Key(
        "study.production.yield",
        "share of actuators that must meet every constraint",
        "number",
        "fraction",
        above=0.0,
        maximum=HIGHEST_YIELD,
    ),
)
"""The keys of ``[study.production]`` besides ``tolerances``."""

DISTRIBUTION = Key("distribution", "of the scatter", "word", choices=DISTRIBUTIONS, default=DISTRIBUTIONS[0])


def read_production(raw: object, study: Study, known: Mapping[str, Key], values: Values) -> Production:
    """``[study.production]`` of a study whose other parts are read; ``values`` are the start design's."""
    settings = read_settings(_with_yield(raw), "study.production", PRODUCTION_KEYS, ("tolerances",))
    assert isinstance(raw, Mapping)
    target = settings.pop("yield")
    if settings["checks"] > settings["samples"]:
        raise SpecError(
            f"study.production.checks must be at most study.production.samples {settings['samples']}; "
            f"got {settings['checks']}."
        )
    items = tables(raw, "production.tolerances")
    if not items:
        raise SpecError(
            "study.production.tolerances must hold at least one table, [[study.production.tolerances]]; got none."
        )
    tolerances: list[Tolerance] = []
    for i, item in enumerate(items):
        found = _tolerance(item, f"study.production.tolerances.{i}", study, known, values)
        if any(found.key == other.key for other in tolerances):
            raise SpecError(f"study.production.tolerances must name each key once; got {found.key} twice.")
        tolerances.append(found)
    if target is not None:
        for name, part in (
            ("objective", study.objective),
            ("variables", study.variables),
            ("constraints", study.constraints),
        ):
            if not part:
                raise SpecError(
                    f"study.{name} must be given for a search that reaches study.production.yield; got none."
                )
    return Production(tuple(tolerances), target_yield=target, **settings)


def _with_yield(raw: object) -> object:
    """The table with a number for a yield that is written as a percentage; a bare 99 is told what it would be."""
    where = "study.production.yield"
    if not isinstance(raw, Mapping) or "yield" not in raw:
        return raw
    target = fraction(raw["yield"], where)
    if isinstance(target, (int, float)) and not isinstance(target, bool) and 1 < target <= 100:
        meant = Decimal(repr(target)).scaleb(-2).normalize()
        raise SpecError(
            f'{where} must be at most {HIGHEST_YIELD:g}, such as {meant:f} or "{target:g} %"; '
            f"got {shown(raw['yield'])}."
        )
    return {**raw, "yield": target}


def _tolerance(raw: Mapping[str, Any], where: str, study: Study, known: Mapping[str, Key], values: Values) -> Tolerance:
    allow(raw, where, ("key", "tolerance", "plus", "minus", "distribution"))
    key = numeric_key(raw, where, known, integers=False)
    given = [name for name in ("tolerance", "plus", "minus") if name in raw]
    if given not in (["tolerance"], ["plus", "minus"]):
        raise SpecError(
            f"{where} must hold tolerance alone, or plus and minus together, for {key.name}; "
            f"got {' and '.join(given) or 'none'}."
        )
    step = key.difference
    sizes = {name: read_value(raw[name], step, f"{where}.{name}") for name in given}
    for name, size in sizes.items():
        if size < 0:
            raise SpecError(
                f"{where}.{name} must be at least {step.show(0.0)}, for it is the distance from the nominal value; "
                f"got {step.show(size)}."
            )
    plus, minus = sizes.get("plus", sizes.get("tolerance", 0.0)), sizes.get("minus", sizes.get("tolerance", 0.0))
    if plus == minus == 0:
        raise SpecError(f"{where} must let {key.name} scatter; got {step.show(0.0)} to both sides.")
    if key.name not in values:
        raise SpecError(f"{where}.key must have a value in the specification; {key.name} has none.")
    variable = next((item for item in study.variables if item.key == key.name), None)
    lowest, highest = (variable.lower, variable.upper) if variable else (float(values[key.name]),) * 2
    check_at(key, lowest - minus, f"{where}.{given[-1]}")
    check_at(key, highest + plus, f"{where}.{given[0]}")
    distribution = DISTRIBUTION.default
    if "distribution" in raw:
        named = Key(f"{where}.distribution", DISTRIBUTION.doc, "word", choices=DISTRIBUTIONS)
        distribution = named.read(raw["distribution"])
    # Not -minus alone: a minus of zero would become -0.0, which prints otherwise than it is typed.
    return Tolerance(key.name, -minus if minus else 0.0, plus, str(distribution))
