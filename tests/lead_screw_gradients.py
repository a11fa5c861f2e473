"""Lead screws whose gradients tests of several lengths look at, and how they do."""

from pathlib import Path

import numpy as np
import pytest

from fluxbore.design.performance import to_mapping
from fluxbore.design.spec import Spec, load
from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.evaluation import Evaluation, Fidelity, Gradient
from fluxbore.optimize.partials import differentiable, held

ROTLIN = Path(__file__).parents[1] / "examples" / "rotlin.toml"

STEPWISE = ("demagnetised_fraction",)
"""Counts of points."""

SATURATED = {
    "actuator.translator.iron_thickness": "0.25 mm",
    "actuator.rotor.iron_thickness": "0.2 mm",
    "actuator.translator.magnet_fill": "0.8",
    "actuator.rotor.magnet_width": "1.9 mm",
    "operating_point.friction_torque": "0.01 N m",
}
"""Thin iron, unlike magnets with air between them."""

ARCS = {
    "actuator.starts": "3",
    "actuator.translator.iron_thickness": "0 mm",
    "actuator.translator.magnet_fill": "0.85",
    "actuator.translator.magnets": "stepped arcs",
    "actuator.translator.arc_angle": "50 deg",
    "actuator.translator.arcs_per_turn": "6",
    "actuator.rotor.magnets": "helical arcs",
    "actuator.rotor.arc_angle": "70 deg",
    "actuator.rotor.arcs_per_turn": "5",
}
"""Three starts, arcs of either form, iron behind the rotor alone."""


BARE = {
    "actuator.translator.iron_thickness": "0 mm",
    "actuator.rotor.iron_thickness": "0 mm",
    "actuator.translator.magnet_fill": "0.9",
    "operating_point.friction_torque": "0.01 N m",
}
"""No iron: the cheapest."""


def rotlin(changes: dict[str, str]) -> Spec:
    return load(ROTLIN, {"actuator.translator.thickness": "", "solver.tolerance": "1e-10", **changes})


def continuous(spec: Spec) -> list[str]:
    """Every key that it can be derived by and differenced about: not those at zero, beyond which there is nothing."""
    found = differentiable(spec, [key.name for key in spec.kind.keys])
    return [key for key in found if spec.number(key) > 0]


def figures(found: Evaluation) -> dict[str, float]:
    assert found.ok, found.reasons
    return {name: value for name, value in to_mapping(found.performance).items() if value is not None}


def differences(spec: Spec, fidelity: Fidelity, directions: dict[str, float], step: float) -> dict[str, float]:
    """All figures' along one direction in shares of the keys' values, extrapolated from two steps."""
    base = held(spec.pinned(directions), list(directions))

    def at(length: float) -> dict[str, float]:
        values = {key: base.number(key) + length * share for key, share in directions.items()}
        return figures(evaluate(base.with_values(values), fidelity))

    sides = [(at(length), at(-length), length) for length in (step, step / 2)]
    rough, fine = (
        {name: (ahead[name] - behind[name]) / (2 * length) for name in ahead} for ahead, behind, length in sides
    )
    return {name: (4 * fine[name] - rough[name]) / 3 for name in fine}


def along(gradient: Gradient, directions: dict[str, float]) -> dict[str, float]:
    return {name: sum(slopes[key] * share for key, share in directions.items()) for name, slopes in gradient.items()}


def random_direction(spec: Spec, keys: list[str]) -> dict[str, float]:
    """All keys at once, each by a share of its value."""
    rng = np.random.default_rng(11)
    return {key: float(rng.normal()) * spec.number(key) for key in keys}


def check_every_figure(fidelity: Fidelity, spec: Spec, within: float, without: tuple[str, ...] = STEPWISE) -> None:
    """Every figure along a random direction in all keys, against differences; relative to itself or its value."""
    keys = continuous(spec)
    found = evaluate(spec, fidelity, keys)
    assert found.gradient is not None
    values = figures(found)
    assert values.keys() - found.gradient.keys() == set(STEPWISE) & values.keys()
    assert all(slopes.keys() == set(keys) for slopes in found.gradient.values())
    directions = random_direction(spec, keys)
    expected = differences(spec, fidelity, directions, 1e-3)
    for name, slope in along(found.gradient, directions).items():
        if name not in without:
            assert slope == pytest.approx(expected[name], rel=within, abs=within * abs(values[name])), name
