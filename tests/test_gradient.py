"""`evaluate --gradient` and its Python form, with a model whose derivatives are known."""

import json
from pathlib import Path

import pytest

import fluxbore
from fluxbore.cli import main
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.design.spec_file import template
from fluxbore.gradient_messages import gradient_text
from fluxbore.optimize.evaluate import MODELS, Model
from fluxbore.optimize.evaluation import OK, Evaluation, Norm

RING, YOKE = "actuator.mover.ring_width", "actuator.back_yoke.thickness"
SLOPES = {RING: -302.1, YOKE: 44.0}


def smooth(spec: Spec, gradient=()) -> Evaluation:
    """A model with two figures; it notes by which keys it was given, as a held key must be."""
    assert set(gradient) <= set(spec.given)
    found = Evaluation("fem", OK, (), Performance(force_constant=8.5, stray_field=5e-4))
    if not gradient:
        return found
    slopes = {
        "force_constant": {key: SLOPES.get(key, 1.0) for key in gradient},
        "stray_field": dict.fromkeys(gradient, -2e-2),
        "bore_dilation": dict.fromkeys(gradient, 0.0),
    }
    return Evaluation(
        "fem", OK, (), found.performance, gradient=slopes, norms={"stray_field": Norm(exponent=20.0, value=4.9e-4)}
    )


def without(spec: Spec, gradient=()) -> Evaluation:
    return Evaluation("network", OK, (), Performance(force_constant=9.0))


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    (tmp_path / "spec.toml").write_text(template("ipehla"))
    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(MODELS, "hybrid", Model(without, smooth, gradients=True))


def test_the_json_has_derivatives_by_dotted_keys_and_the_maximum_beside_its_norm(capsys):
    assert main(["evaluate", "spec.toml", "--fidelity", "fem", "--gradient", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["gradient"] == {
        "force_constant": SLOPES,
        "stray_field": {RING: -2e-2, YOKE: -2e-2},
        "bore_dilation": {RING: 0.0, YOKE: 0.0},
    }
    assert found["norms"] == {"stray_field": {"exponent": 20.0, "value": 4.9e-4}}
    assert found["performance"]["stray_field"] == 5e-4


def test_without_being_asked_nothing_is_derived(capsys):
    assert main(["evaluate", "spec.toml", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["gradient"] is None


def test_people_get_millimetres(capsys):
    assert main(["evaluate", "spec.toml", "--gradient"]) == 0
    out = capsys.readouterr().out
    lines = [line.split() for line in out.splitlines()]
    assert [RING, "-0.3021", "N/A", "per", "mm"] in lines
    assert [YOKE, "+0.044", "N/A", "per", "mm"] in lines
    assert [YOKE, "-0.02", "mT", "per", "mm"] in lines
    assert out.endswith("None of them moves bore_dilation.\n")
    assert "\nstray_field (by its 20-norm, 0.49 mT; the figure itself is 0.5 mT)\n" in out


def test_figures_without_derivatives_are_named_and_noise_is_none():
    """Catches a figure that is missing without a word, and a slope of rounding errors beside real ones."""
    spec = fluxbore.load("spec.toml")
    made = Performance(force_constant=8.5, stray_field=5e-4, turns=60.0, demagnetised_fraction=0.01)
    slopes = {"force_constant": {RING: -302.1, YOKE: 1e-9}, "stray_field": {RING: 1e-15, YOKE: 0.0}}
    lines = gradient_text(spec, Evaluation("fem", OK, (), made, gradient=slopes)).splitlines()
    assert lines[3].split() == [YOKE, "+0", "N/A", "per", "mm"]
    assert lines[4:] == [
        "None of them moves stray_field.",
        "No derivatives, for they count points: demagnetised_fraction.",
        "No derivatives: turns.",
    ]


def test_a_model_without_derivatives_says_so(capsys):
    assert main(["evaluate", "spec.toml", "--fidelity", "network", "--gradient", "--json"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err == "fluxbore: gradient must be left out: an actuator of kind hybrid has none by the network.\n"


def test_a_script_may_ask_for_other_keys():
    """A key that follows from others takes its alternative's place, as a variable of a study does."""
    key = "actuator.back_yoke.inner_diameter"
    found = fluxbore.evaluate(Path("spec.toml"), gradient=[RING, key])
    assert found.gradient is not None
    assert list(found.gradient["force_constant"]) == [RING, key]
    assert fluxbore.evaluate("spec.toml", gradient=True).gradient is not None
    keys = [key, YOKE, "actuator.back_yoke.outer_diameter"]
    with pytest.raises(fluxbore.FluxboreError, match="over-determined"):
        fluxbore.evaluate("spec.toml", gradient=keys)
