"""Electro-hydrostatic actuators with one key at its limit, and what may come of one: figures, or one sentence."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import fields
from pathlib import Path

from fluxbore.design.errors import FluxboreError
from fluxbore.design.hydrostatic_keys import HYDROSTATIC_KEYS
from fluxbore.design.keys import Key, Value
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec, load
from fluxbore.optimize.evaluate import evaluate

EXAMPLE = Path(__file__).parent.parent / "examples" / "prehydra.toml"

NEAR, FAR = 1e-9, 1e-3
"""Of a largest value and of the example's: how close to an open limit, and how far below what is usual."""

CORD: dict[str, Value] = {
    "actuator.return_spring.element": "rubber cord",
    "actuator.return_spring.cord_length": 0.2,
    "actuator.return_spring.cord_area": 4e-4,
    "actuator.return_spring.cord_stretch": 1.3,
    "actuator.return_spring.cord_first": 2e5,
    "operating_point.least_force": 130.0,
}
"""A rubber cord in place of the springs, in SI."""


def cases() -> Iterator[tuple[str, float]]:
    """Every number's key with its limits, a value next to an open one, and the example's times and over a thousand."""
    spec = load(EXAMPLE)
    for key in HYDROSTATIC_KEYS:
        if key.kind in ("quantity", "number", "count") and not key.name.startswith("benchmark."):
            for value in _limits(key, spec):
                yield key.name, value


def _limits(key: Key, spec: Spec) -> list[float]:
    found = [item for item in (key.minimum, key.maximum) if item is not None]
    if key.above is not None and key.maximum is not None:
        found.append(key.above + NEAR * key.maximum)
    own = spec.values.get(key.name)
    if isinstance(own, float) and own > 0:
        found += [
            value
            for value in (own * FAR, own / FAR)
            if (key.minimum is None or value >= key.minimum) and (key.maximum is None or value <= key.maximum)
        ]
    return list(dict.fromkeys(found))


def moved(name: str, value: float) -> Spec:
    """The example with one key at a value (SI); one of the cord's keys brings the cord. Raises FluxboreError."""
    spec = load(EXAMPLE)
    return spec.with_values({**CORD, name: value} if "cord_" in name else {name: value})


def outcome(name: str, value: float, *routes: str) -> dict[str, str]:
    """Status by route, "refused" for a specification that is none; AssertionError where that is no honest answer."""
    try:
        spec = moved(name, value)
    except FluxboreError as error:
        assert_sentence(str(error))
        return dict.fromkeys(routes, "refused")
    found = {}
    for route in routes:
        evaluation = evaluate(spec, "fem" if route == "fem" else "network")
        found[route] = evaluation.status
        if not evaluation.ok:
            assert evaluation.reasons
        for reason in (*evaluation.reasons, *evaluation.warnings):
            assert_sentence(reason)
            assert not reason.startswith("The evaluation stopped with"), reason
        if evaluation.ok:
            for field in fields(Performance):
                figure = getattr(evaluation.performance, field.name)
                assert not isinstance(figure, float) or math.isfinite(figure), field.name
    return found


def assert_sentence(text: str) -> None:
    assert text.endswith("."), text
    assert "\n" not in text, text
    assert " nan" not in text, text
