"""A lead screw over its pitch: what is varied, what stays, and where it ends."""

import re
from pathlib import Path

import pytest

from fluxbore.design.spec import load
from fluxbore.optimize import pitch_curve as module
from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.evaluation import INVALID, failure
from fluxbore.optimize.pitch_curve import PITCH, PitchCurve, pitch_curve

ROTLIN = Path(__file__).parents[2] / "examples" / "rotlin.toml"
SHORT = {
    "actuator.rotor.magnet_width": "2.3 mm",
    "actuator.translator.length": "20 mm",
    "operating_point.stroke": "5 mm",
}
"""Magnets of one width, and a translator that the rotor's poles outgrow within the curve's reach."""


def curve_of(monkeypatch: pytest.MonkeyPatch, overrides: dict[str, str]) -> PitchCurve:
    monkeypatch.setattr(module, "POINTS", 5)
    monkeypatch.setattr(module, "SOLVED", 2)
    spec = load(ROTLIN, overrides)
    found = pitch_curve(spec, evaluate(spec, "network"))
    assert found is not None
    return found


def test_curve_reaches_around_the_design_and_passes_through_it(monkeypatch: pytest.MonkeyPatch) -> None:
    found = curve_of(monkeypatch, {})
    own = found.design
    assert own.pitch == load(ROTLIN).number(PITCH)
    assert found.network[0].pitch == pytest.approx(0.4 * own.pitch)
    assert found.network[-1].pitch == pytest.approx(2.5 * own.pitch)
    assert (found.least, found.most) == ("", "")
    there = next(item for item in found.network if item.pitch == own.pitch)
    assert there.evaluation.performance == own.evaluation.performance
    assert [item.evaluation.fidelity for item in found.fem] == ["fem", "fem"]
    for item in found.fem:
        near = min(found.network, key=lambda other: abs(other.pitch - item.pitch))
        assert item.evaluation.performance.stall_force == pytest.approx(
            near.evaluation.performance.stall_force, rel=2e-3
        )
    for item in found.network:
        assert item.active_length == pytest.approx(2 * item.pitch)


def test_curve_ends_where_nothing_can_be_built_and_says_why(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "evaluate", lambda spec, fidelity: evaluate(spec, "network"))
    found = curve_of(monkeypatch, SHORT)
    assert found.network[0].pitch == pytest.approx(4.6e-3)
    assert found.network[-1].pitch == pytest.approx(10e-3)
    assert found.least.startswith("actuator.pitch must be at least two magnet widths, 4.6 mm")
    assert found.most.startswith("actuator.translator.length must be at least")
    # The sentences are told of a pitch well beyond the limit: no two numbers that differ in their tenth digit.
    numbers = re.findall(r"[\d.]+\d", found.least + found.most)
    assert len(numbers) == 4
    assert all(len(number) < 8 for number in numbers)


def test_a_design_without_figures_has_no_curve() -> None:
    assert pitch_curve(load(ROTLIN), failure("fem", INVALID, "It cannot be built.")) is None
