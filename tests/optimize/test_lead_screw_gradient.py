"""Exact gradients of a lead screw's figures by the specification's keys: differences, scaling, what has none."""

import math

import pytest
from lead_screw_gradients import BARE, SATURATED, along, check_every_figure, continuous, figures, rotlin

from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.evaluation import Fidelity


def test_every_figure_by_every_key_at_once() -> None:
    """Catches a figure or key that is left out, or a wrong share of any."""
    check_every_figure("fem", rotlin(BARE), 1e-6)


def test_scaling() -> None:
    """Catches a length left out, with no difference at all: Euler's rule for all lengths together."""
    spec = rotlin({})
    kinds = {key.name: key for key in spec.kind.keys}
    lengths = [key for key in continuous(spec) if (kinds[key].kind, kinds[key].dimension) == ("quantity", "length")]
    found = evaluate(spec, "fem", lengths)
    values, degree = figures(found), along(found.gradient or {}, {key: spec.number(key) for key in lengths})
    expected = {
        "stall_force": 2,
        "spring_constant": 1,
        "stall_force_density": -1,
        "spring_energy": 3,
        "harmonic_ratio_2": 0,
        "translator_iron_flux_density": 0,
        "demagnetisation_load": 0,
        "transfer_ratio": -1,
        "magnet_mass": 3,
        "slip_work": 1,
    }
    for name, power in expected.items():
        assert degree[name] == pytest.approx(power * values[name], rel=1e-6, abs=1e-6 * values[name]), name


@pytest.mark.parametrize("fidelity", ["network", "fem"])
def test_force_goes_with_both_remanences(fidelity: Fidelity) -> None:
    """Without iron the field is linear: once with each member's remanence, and the frequency as its root."""
    spec = rotlin(BARE)
    remanences = {key: spec.number(key) for key in ("actuator.translator.remanence", "actuator.rotor.remanence")}
    found = evaluate(spec, fidelity, list(remanences))
    values, degree = figures(found), along(found.gradient or {}, remanences)
    for figure, power in (("stall_force", 2), ("spring_constant", 2), ("natural_frequency", 1)):
        assert degree[figure] == pytest.approx(power * values[figure], rel=1e-8)


def test_closed_forms() -> None:
    """The gear by hand: 1/h = 2 pi/(s l_p), the motor's torque by load and friction."""
    spec = rotlin(SATURATED)
    keys = ["actuator.pitch", "operating_point.load_force", "operating_point.friction_torque"]
    gradient = evaluate(spec, "network", keys).gradient
    assert gradient is not None
    pitch = spec.number("actuator.pitch")
    assert gradient["transfer_ratio"]["actuator.pitch"] == pytest.approx(-2 * math.pi / pitch**2, rel=1e-9)
    assert gradient["motor_torque"]["operating_point.load_force"] == pytest.approx(pitch / (2 * math.pi), rel=1e-9)
    assert gradient["motor_torque"]["operating_point.friction_torque"] == pytest.approx(1.0, rel=1e-9)
    assert gradient["stall_force"]["operating_point.load_force"] == 0.0


def test_what_has_no_derivative() -> None:
    """Counts, iron that is not there, magnets that touch and must not follow the pitch: no entry, the others stay."""
    spec = rotlin({"actuator.translator.iron_thickness": "0 mm"})
    keys = ["actuator.poles", "actuator.translator.iron_thickness", "actuator.rotor.magnet_width", "actuator.gap"]
    gradient = evaluate(spec, "fem", keys).gradient
    assert gradient is not None
    assert "demagnetised_fraction" not in gradient
    assert set(gradient["stall_force"]) == {"actuator.gap"}
