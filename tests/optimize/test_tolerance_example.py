"""The example's production: the prototype within a workshop's tolerances, and what then stays as it is."""

from pathlib import Path

import pytest

from fluxbore.design.spec import load, loads
from fluxbore.optimize.executor import SerialExecutor
from fluxbore.optimize.tolerance import run_tolerance
from fluxbore.optimize.tolerance_model import production_design
from fluxbore.optimize.tolerance_robust import run_robust

EXAMPLE = Path(__file__).parents[2] / "examples" / "ipehla-tolerance.toml"
REMANENCE, BORE = "actuator.mover.remanence", "actuator.back_yoke.inner_diameter"
WINDING = "actuator.winding."

STORES = """
[study.production]
samples = 10000
checks = 300
yield = 0.99

[[study.production.tolerances]]
key = "actuator.coil_2.radius"
tolerance = "2 mm"

[[study.production.tolerances]]
key = "actuator.coil_2.thickness"
tolerance = "1 mm"

[[study.production.tolerances]]
key = "actuator.coil_1.current_density"
tolerance = "0.05 A/mm^2"
distribution = "uniform"
"""


def analyse(overrides, fidelity):
    return run_tolerance(load(EXAMPLE, overrides), None, SerialExecutor(), fidelity=fidelity)


def test_the_force_scatters_with_the_remanence_above_all():
    """By the network, which gives no stray field: a slope of the wrong unit, or a share of the wrong key.

    The force is nearly proportional to the remanence: 0.03/1.4/sqrt(3) is 1.24 % of it.
    """
    result = analyse(
        {"study.constraints.1": "", "study.production.checks": "100", "study.production.samples": "2000"}, "network"
    )
    force = result.figure("force_constant")
    assert result.effects[0].tolerance.key == REMANENCE
    assert force.shares[REMANENCE] > 0.8
    share_of_remanence = (force.sigma**2 * force.shares[REMANENCE]) ** 0.5 / force.nominal
    assert share_of_remanence == pytest.approx(0.03 / 1.4 / 3**0.5, rel=0.15)
    assert force.mean < force.nominal  # the magnets are ground below their size
    assert force.checked.error < 0.1 * force.sigma
    assert force.checked.mean.low <= force.mean + force.checked.bias <= force.checked.mean.high
    assert result.direct.low <= result.simulated.value <= result.direct.high
    assert not result.failures


def test_what_was_wound_stays_wound():
    """A yoke that is too thick must not add turns, nor change the winding's diameter, whatever the search holds."""
    spec = load(EXAMPLE)
    thicker = production_design(spec, spec.study.production.tolerances).with_values(
        {"actuator.back_yoke.thickness": spec.number("actuator.back_yoke.thickness") + 5e-5}
    )
    assert thicker.number(BORE) == pytest.approx(spec.number(BORE) - 1e-4)
    for key in (WINDING + "turns", WINDING + "outer_diameter"):
        assert thicker.number(key) == spec.number(key)


@pytest.mark.full
def test_the_finite_elements_agree_with_their_own_linear_model():
    """Derivatives that do not belong to the figures they stand beside: twelve actuators, computed one by one."""
    result = analyse({"operating_point.positions": "2"}, "fem")
    for name in ("force_constant", "stray_field"):
        spread = result.figure(name)
        assert spread.checked.count == 12
        assert spread.checked.error < 0.1 * spread.sigma
    assert result.effects[0].tolerance.key == REMANENCE
    assert 0.7 < result.simulated.value < 0.9


@pytest.mark.full
def test_an_energy_store_on_its_limit_is_made_good_by_backing_off():
    """With a real model's exact derivatives: half of the optimum's production fails, of the robust one's 1 %."""
    spec = loads((EXAMPLE.parent / "team22.toml").read_text(encoding="utf-8") + STORES)
    result = run_robust(spec, None, SerialExecutor())
    first, best = result.rounds[0], result.best
    assert first.production.simulated.value == pytest.approx(0.5, abs=0.02)
    assert result.reached
    assert best.production.direct.high >= 0.99
    assert best.production.figure("stored_energy").exact
    assert best.production.figure("stored_energy").checked.error < 0.1 * best.production.figure("stored_energy").sigma
    assert 0 < result.price < 0.05 * first.objective
