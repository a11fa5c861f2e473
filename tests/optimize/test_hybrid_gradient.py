"""Gradients of a hybrid actuator's figures by its specification's keys: right, free of factorisations, and honest about
what they cannot give."""

import sys
from pathlib import Path

import numpy as np
import pytest
from counted_solutions import counted_solutions
from short_motor import EXAMPLE, short_spec

from fluxbore.design.performance import to_mapping
from fluxbore.design.spec import Spec, load
from fluxbore.fem.cell_band import CellFactor
from fluxbore.fem.threads import one_thread
from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.hybrid_field import field_figures, position_result, solve_field
from fluxbore.optimize.hybrid_gradient import STEPWISE, field_gradient
from fluxbore.optimize.partials import differentiable

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))

from gradient_differences import Designs, scale, size

PITCH, YOKE, RING = "actuator.mover.pole_pitch", "actuator.back_yoke.thickness", "actuator.mover.ring_width"
REMANENCE, LAST = "actuator.mover.remanence", "operating_point.last_position"
PEAK = "operating_point.peak_current"
Array = np.ndarray


@pytest.fixture(scope="module")
def spec() -> Spec:
    return short_spec()


@pytest.fixture(scope="module")
def found(spec: Spec) -> Evaluation:
    """By every continuous key."""
    return evaluate(spec, "fem", differentiable(spec, list(spec.given)))


@pytest.fixture(scope="module")
def designs(spec: Spec) -> Designs:
    with one_thread():
        return Designs(spec, solve_field(spec))


@pytest.mark.parametrize("key", [PITCH, pytest.param(LAST, marks=pytest.mark.full), PEAK])
def test_against_differences(designs: Designs, found: Evaluation, key: str) -> None:
    """Catches a wrong weight between positions, states, norms and keys: every figure by keys of each kind.

    The full tier does so for every key of 50 designs. What the differences cannot tell is not asked.
    """
    assert found.gradient is not None
    with one_thread():
        differences = designs.derivatives(key)
    told = 0
    for name, own in differences.items():
        if name in STEPWISE:
            continue
        size_of_error = scale(own.value, designs.own[name], size(designs.spec, key)) or 1.0
        if own.doubt > 3e-7 * size_of_error:
            continue
        told += 1
        assert found.gradient[name][key] == pytest.approx(own.value, abs=1e-6 * size_of_error), name
    assert told > 40


def test_some_figures_alone(spec: Spec, found: Evaluation) -> None:
    """Catches a figure whose derivative depends on which others are wanted, and work on those that are not."""
    assert found.gradient is not None
    with one_thread():
        field = solve_field(spec)
        positions = tuple(position_result(item, spec.actuator.mover.pole_pitch) for item in field.window)
        keys = list(found.gradient["force_constant"])
        every, norms = field_gradient(spec, field, positions, keys)
        assert set(every) == set(field_figures(spec, field, positions)) - set(STEPWISE)
        for names in ({"cogging_force", "peak_force"}, {"force_constant"}, {"stray_field", "phase_inductance"}):
            some, their_norms = field_gradient(spec, field, positions, keys, names)
            assert set(some) == names
            assert set(their_norms) == set(norms) & names
            for name in names:
                scale = max(abs(value) for value in found.gradient[name].values())
                assert some[name] == pytest.approx(found.gradient[name], abs=1e-8 * scale)


def test_norms_are_those_of_the_differences(designs: Designs, found: Evaluation) -> None:
    """Catches a gradient of another smooth figure than the one that is told: its value beside the maximum, below it."""
    assert found.norms is not None
    exact = to_mapping(found.performance)
    assert {"stray_field", "yoke_flux_density", "cogging_force", "demagnetisation_load"} == set(found.norms)
    for name, value in designs.own.items():
        expected = found.norms[name].value if name in found.norms else exact[name]
        assert value == pytest.approx(expected, rel=1e-9), name
    for name in ("stray_field", "yoke_flux_density", "cogging_force"):
        largest = exact[name]
        assert largest is not None
        assert 0.8 * largest < found.norms[name].value < largest


INDEPENDENT = {
    REMANENCE: ("total_mass", "winding_resistance", "hoop_stress", "pneumatic_force_advance", "fill_factor"),
    YOKE: ("pneumatic_force_advance", "hoop_stress", "bore_dilation"),
    "operating_point.pressure": ("force_constant", "stray_field", "cogging_force", "phase_inductance", "total_mass"),
    "operating_point.speed": ("force_constant", "yoke_flux_density", "demagnetisation_load", "peak_force"),
    PEAK: ("force_constant", "stray_field", "yoke_flux_density", "copper_loss"),
    "actuator.winding.turns": ("cogging_force", "ring_flux_density", "gap_flux_density", "hoop_stress"),
}


def test_a_part_that_meets_another_costs_no_design_its_figures() -> None:
    """Catches a derivative by the position that does not exist, for keys that do not move the positions: the magnets
    begin where the yoke does, and one step further they do not."""
    spec = load(
        EXAMPLE,
        {
            "actuator.back_yoke.back_overhang": "0 mm",
            "actuator.mover.stroke": "96 mm",
            "operating_point.first_position": "-4 mm",
            "operating_point.last_position": "-4 mm",
            "operating_point.positions": "1",
        },
    )
    assert spec.actuator.yoke_start == pytest.approx(-4e-3)
    found = evaluate(spec, "fem", (YOKE,))
    assert found.ok
    assert found.gradient is not None
    assert YOKE in found.gradient["force_constant"]


@pytest.mark.parametrize("key", list(INDEPENDENT))
def test_what_a_figure_does_not_depend_on(found: Evaluation, key: str) -> None:
    """Catches noise where there is nothing: exactly zero, so that a search does not follow it."""
    assert found.gradient is not None
    for name in INDEPENDENT[key]:
        assert found.gradient[name][key] == 0.0, name


def test_turns_are_a_factor(spec: Spec, found: Evaluation) -> None:
    """Catches a wrong power of the turns, without differences: by them the force constant is linear, the inductance
    square, and cogging nothing."""
    assert found.gradient is not None
    turns, key = spec.number("actuator.winding.turns"), "actuator.winding.turns"
    for name, power in (("force_constant", 1), ("force_constant_linkage", 1), ("phase_inductance", 2), ("back_emf", 1)):
        value = getattr(found.performance, name)
        assert found.gradient[name][key] * turns == pytest.approx(power * value, rel=1e-9), name


def test_current_and_turns_are_ampere_turns(spec: Spec, found: Evaluation) -> None:
    """Catches a peak state whose load misses one of the two: the peak force depends on their product alone."""
    assert found.gradient is not None
    slopes = found.gradient["peak_force"]
    by_turns = slopes["actuator.winding.turns"] * spec.number("actuator.winding.turns")
    assert slopes[PEAK] * spec.number(PEAK) == pytest.approx(by_turns, rel=1e-8)
    assert by_turns != 0


def test_counts_of_points_have_none(found: Evaluation) -> None:
    """Catches a derivative of zero for a figure that is a staircase."""
    assert found.gradient is not None
    assert found.performance.demagnetised_fraction is not None
    assert found.performance.peak_demagnetised_fraction is not None
    assert not set(STEPWISE) & set(found.gradient)


def test_a_key_that_is_no_quantity_is_passed_over(spec: Spec) -> None:
    """Catches a gradient that is lost because a count was asked for beside a length."""
    cheap = evaluate(spec, "fem", ["actuator.mover.pole_pairs", RING])
    assert cheap.gradient is not None
    assert set(cheap.gradient["force_constant"]) == {RING}
    none = evaluate(spec, "fem", ["actuator.mover.pole_pairs"])
    assert none.gradient == {}
    assert none.norms == {}


def test_a_key_that_changes_the_topology_is_passed_over() -> None:
    """Catches a derivative across a mesh that jumps: rings of nothing have no interval of their own."""
    found = evaluate(short_spec(mover__ring_width=0.0), "fem", [YOKE, RING])
    assert found.ok
    assert found.gradient is not None
    assert set(found.gradient["force_constant"]) == {YOKE}


def test_what_a_gradient_costs(spec: Spec, monkeypatch: pytest.MonkeyPatch) -> None:
    """Catches a factorisation for a gradient, sweeps that grow with the keys, and more than one adjoint for a figure
    and position (each refined to its accuracy in up to three more sweeps)."""
    factors: list[int] = []
    columns = counted_solutions(monkeypatch)
    monkeypatch.setattr(CellFactor, "__init__", lambda self: factors.append(1))

    def cost(keys: list[str]) -> tuple[int, int]:
        factors.clear()
        columns.clear()
        assert evaluate(spec, "fem", keys).ok
        return len(factors), sum(columns)

    plain, one, several = cost([]), cost([RING]), cost([RING, YOKE, PITCH, REMANENCE, PEAK, LAST])
    assert plain[0] == one[0] == several[0] > 0
    assert one[1] == several[1]
    # Of each of two positions six figures need an adjoint of their own, the force constant, the linkage and the
    # inductance those of Clarke's two axes; the force's is at hand. Of the two peak states the magnets' load needs one.
    fields = 2 * (6 + 2) + 2
    assert several[1] - plain[1] <= 4 * fields
