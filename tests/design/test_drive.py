"""The drive: power's balance, phase by phase in time, and the supply's limit."""

import itertools
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.drive import back_emf, phase_voltage, speed_limit, voltage_demand

K, R, L, TAU = 8.67, 5.7, 2.5e-3, 0.012


@given(speed=st.floats(0.01, 10), current=st.floats(0.1, 20))
def test_the_voltages_of_three_phases_in_time(speed: float, current: float) -> None:
    """Catches a factor 2/3 or sqrt(2), and an angular speed of the wrong pole pitch: phases made of their flux linkages
    lambda cos(pi z/tau - 120 deg), differentiated in time, with what 3/2 (pi/tau) lambda = K says of lambda."""
    linkage = K / (1.5 * math.pi / TAU)

    def flux(phase: int, z: float) -> float:
        angle = math.pi * z / TAU - 2 * math.pi * phase / 3
        # The current on the q axis stands a quarter period ahead of the flux.
        return linkage * math.cos(angle) - L * current * math.sin(angle)

    h = 1e-9
    waves = []
    for i in range(720):
        z = 2 * TAU * i / 720
        induced = speed * (flux(0, z + h) - flux(0, z - h)) / (2 * h)
        waves.append(induced - R * current * math.sin(math.pi * z / TAU))
    amplitude = math.sqrt(2 * sum(u * u for u in waves) / len(waves))
    assert voltage_demand(K, R, L, TAU, current, speed) == pytest.approx(amplitude, rel=1e-4)


@given(speed=st.floats(0.01, 10), current=st.floats(0.1, 20))
def test_electrical_power_is_copper_loss_and_work(speed: float, current: float) -> None:
    electrical = 1.5 * current * (R * current + back_emf(K, speed))
    assert electrical == pytest.approx(1.5 * R * current**2 + K * current * speed, rel=1e-12)


@given(current=st.floats(0, 5), inductance=st.sampled_from([0.0, 1e-4, 2.5e-3, 0.05]), supply=st.floats(1, 400))
def test_at_the_speed_limit_the_demand_is_the_supply(current: float, inductance: float, supply: float) -> None:
    """Catches the wrong root, for motors that the supply can and cannot hold at rest."""
    voltage = phase_voltage(supply)
    limit = speed_limit(K, R, inductance, TAU, current, voltage)
    assert limit is not None
    x = math.pi * inductance / TAU * current
    if (2 / 3 * K * voltage) ** 2 + x**2 * (voltage**2 - (R * current) ** 2) < 0:
        assert limit < 0
        return
    assert voltage_demand(K, R, inductance, TAU, current, limit) == pytest.approx(voltage, rel=1e-8)
    assert (limit < 0) == (R * current > voltage)


def test_without_current_the_limit_is_the_no_load_speed() -> None:
    """24 V: 24/sqrt(3) V over 2/3 of 8.67 V s/m."""
    assert speed_limit(K, R, L, TAU, 0.0, phase_voltage(24.0)) == pytest.approx(24 / math.sqrt(3) / (2 / 3 * 8.67))
    assert speed_limit(0.0, R, L, TAU, 1.0, 10.0) is None


def test_inductance_only_slows() -> None:
    limits = [speed_limit(K, R, inductance, TAU, 1.0, 14.0) for inductance in (0.0, 1e-3, 5e-3, 2e-2)]
    assert limits == sorted(limits, key=lambda limit: -(limit or 0.0))


def test_beyond_every_speed_the_limit_goes_on_falling() -> None:
    """Catches a gap, a jump, or a slope that turns where no speed is left: 20 mH, 14 V, currents up to far too many."""
    limits = [speed_limit(K, R, 20e-3, TAU, 2.0 + i / 1000, 14.0) for i in range(4000)]
    found = [limit for limit in limits if limit is not None]
    assert len(found) == len(limits)
    assert all(later < earlier for earlier, later in itertools.pairwise(found))
    assert max(earlier - later for earlier, later in itertools.pairwise(found)) < 0.02
    assert found[0] > 0 > found[-1]
