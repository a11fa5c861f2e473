"""Derivatives of closed forms: steps, walls on one side or both, keys that are no continuous quantity."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fluxbore.design.errors import DesignError
from fluxbore.design.manufacture import winding_room
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec, load
from fluxbore.optimize.partials import closed_gradient, differentiable, moved, slope

PITCH, RING = "actuator.mover.pole_pitch", "actuator.mover.ring_width"
SPEED = "operating_point.speed"
ENAMEL, WIRE = "actuator.winding.insulated_diameter", "actuator.winding.wire_diameter"


@pytest.fixture(scope="module")
def spec() -> Spec:
    return load(Path(__file__).parents[2] / "examples" / "ipehla.toml")


def test_a_central_difference(spec: Spec) -> None:
    """Catches a step that is not the one that was taken: d sin(x/mm) by the pole pitch of 12 mm."""
    found = slope(spec, PITCH, lambda there, _: np.array([np.sin(there.number(PITCH) * 1e3), 5.0]))
    assert found == pytest.approx([1e3 * np.cos(12.0), 0.0], rel=1e-8, abs=1e-12)
    # The step is told to the function, to the last bit.
    assert slope(spec, PITCH, lambda there, step: there.number(PITCH) - 0.012 - step) == pytest.approx(0.0, abs=1e-15)


def test_a_key_that_is_zero_has_a_step(spec: Spec) -> None:
    """Catches a division by a step of nothing."""
    still = moved(spec, SPEED, 0.0)
    assert slope(still, SPEED, lambda there, _: 3 * there.number(SPEED)) == pytest.approx(3.0)


@pytest.mark.parametrize("side", [1, -1])
def test_a_wall_on_one_side(spec: Spec, side: int) -> None:
    """Catches a design on its bound that loses its derivatives, or that has half of them."""

    def at(there: Spec, _: float) -> float:
        x = there.number(PITCH)
        if side * (x - 0.012) > 0:
            raise DesignError("There is a wall.")
        return 7 * x**2

    assert slope(spec, PITCH, at) == pytest.approx(14 * 0.012, rel=1e-8)


def test_walls_on_both_sides(spec: Spec) -> None:
    """Catches a derivative of a design that cannot move at all; a failed formula is a wall too."""

    def at(there: Spec, _: float) -> float:
        if there.number(PITCH) > 0.012:
            raise DesignError("There is a wall.")
        return 1 / (there.number(PITCH) - there.number(PITCH))

    assert slope(spec, PITCH, at) is None


def test_which_keys_are_continuous(spec: Spec) -> None:
    """Catches derivatives by counts, words, solver settings and keys that follow from others, and none by defaults."""
    asked = [
        RING,
        "actuator.mover.pole_pairs",
        "actuator.mover.magnet",
        "actuator.mover.magnet_thickness",
        "solver.tolerance",
        "study.objective",
        ENAMEL,
        SPEED,
    ]
    assert ENAMEL not in spec.given
    assert differentiable(spec, asked) == [RING, ENAMEL, SPEED]


def test_a_default_stays_while_what_it_follows_moves(spec: Spec) -> None:
    """Catches a wire whose enamel grows with it in one derivative and not in the other. Room for the winding is
    height - N/(8 x width) d^2: it has a slope by the insulated diameter and none by the bare one."""

    def complete(there: Spec, step: float, key: str) -> Performance:
        return Performance(winding_room=winding_room(there.actuator, there.number(ENAMEL)))

    row = closed_gradient(spec, [ENAMEL, WIRE], complete)["winding_room"]
    actuator = spec.actuator
    assert row[WIRE] == 0.0
    per_layer = actuator.turns_per_coil / actuator.coil_width
    assert row[ENAMEL] == pytest.approx(-2 * per_layer * spec.number(ENAMEL), rel=1e-6)
    alone = closed_gradient(spec, [WIRE], complete)["winding_room"]
    assert alone[WIRE] == pytest.approx(1.1 * row[ENAMEL], rel=1e-6)


def test_figures_by_keys(spec: Spec) -> None:
    """Catches a figure that is said to have a derivative by a key by which it has none, and one that is left out."""

    def complete(there: Spec, step: float, key: str) -> Performance:
        mass = 2 * there.number(PITCH) + there.number(SPEED)
        return Performance(total_mass=mass, stray_field=step if key == PITCH else None, turns=1.0)

    found = closed_gradient(spec, [PITCH, SPEED, "actuator.mover.magnet"], complete, without=["turns"])
    assert set(found) == {"total_mass"}
    assert found["total_mass"] == pytest.approx({PITCH: 2.0, SPEED: 1.0})
    alone = closed_gradient(spec, [PITCH], complete)
    assert alone["stray_field"] == pytest.approx({PITCH: 1.0})
    assert alone["turns"] == {PITCH: 0.0}


def test_a_key_by_its_alternative(spec: Spec) -> None:
    """Catches a derivative at fixed ring width where the magnets' thickness was asked for at a fixed pitch."""
    thickness = "actuator.mover.magnet_thickness"

    def complete(there: Spec, *_: object) -> Performance:
        return Performance(length=there.number(RING))

    assert closed_gradient(spec, [thickness], complete)["length"] == pytest.approx({thickness: -1.0})
    assert closed_gradient(spec, [PITCH], complete)["length"] == {PITCH: 0.0}


def test_limits_of_keys_do_not_apply(spec: Spec) -> None:
    """Catches a derivative that stops at a bound of its key: half of its differences would look beyond it."""
    at_most = replace(spec, given={**spec.given, "operating_point.duty": 1.0})
    assert slope(at_most, "operating_point.duty", lambda there, _: there.number("operating_point.duty") ** 2) == (
        pytest.approx(2.0)
    )
