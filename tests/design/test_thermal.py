"""The winding's heat: energy's balance, the heat equation of its shell, and one current found by two ways."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from fluxbore.design import thermal
from fluxbore.design.convection import heat_transfer
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.materials import Conductor, Library
from fluxbore.design.thermal import ThermalNetwork
from fluxbore.design.winding import copper_loss, resistance

AMBIENT = 293.15


@pytest.fixture(scope="module")
def copper(library: Library) -> Conductor:
    found = library["copper"]
    assert isinstance(found, Conductor)
    return found


@pytest.fixture(scope="module")
def net(table_ii: HybridActuator, copper: Conductor, library: Library) -> ThermalNetwork:
    return thermal.network(
        table_ii, copper, library["aluminium 6061"], insulation_conductivity=0.2, emissivity=0.1, ambient=AMBIENT
    )


def _off(net: ThermalNetwork, area: float, diameter: float, kelvin: float) -> float:
    return area * heat_transfer(diameter, kelvin, net.ambient, net.emissivity) * (kelvin - net.ambient)


@given(
    rise=st.floats(0.0, 1500),
    yoke_loss=st.floats(0, 1e4),
    tube_loss=st.floats(0, 1e4),
    blocked=st.booleans(),
    emissivity=st.floats(0, 1),
)
def test_what_comes_in_goes_out(
    net: ThermalNetwork, rise: float, yoke_loss: float, tube_loss: float, blocked: bool, emissivity: float
) -> None:
    """Catches heat that is lost or made in the network: winding, yoke and tube give the air what they have."""
    net = replace(net, along_tube=None if blocked else net.along_tube, emissivity=emissivity)
    heat = thermal.heat_at(net, AMBIENT + rise, yoke_loss, tube_loss)
    # A winding held cold amid kilowatts would need surfaces below no temperature at all.
    assume(min(heat.yoke, heat.caps) > 2 * thermal.COLDEST)
    leaving = _off(net, net.yoke_area, net.yoke_diameter, heat.yoke)
    if not blocked:
        leaving += _off(net, net.cap_area, net.cap_diameter, heat.caps)
    through = abs(heat.winding_heat) + yoke_loss + tube_loss
    assert leaving == pytest.approx(heat.winding_heat + yoke_loss + tube_loss, rel=1e-9, abs=1e-9 * (1 + through))


def test_a_heated_shell_against_its_heat_equation() -> None:
    """Catches a slip in R_o, R_i or R_m: (k r T')'/r = -q by finite differences, the mean over the section, for any
    two temperatures of its surfaces."""
    inner, outer, length, k, heat, cold, warm = 10e-3, 12.1e-3, 0.192, 0.7, 8.0, 5.0, 11.0
    n = 4000
    r = np.linspace(inner, outer, n + 1)
    h = r[1] - r[0]
    q = heat / (math.pi * (outer**2 - inner**2) * length)
    lower, upper = (r[1:-1] - h / 2) / h**2, (r[1:-1] + h / 2) / h**2
    right = -q * r[1:-1] / k
    right[0] -= lower[0] * cold
    right[-1] -= upper[-1] * warm
    from scipy.linalg import solve_banded

    bands = np.zeros((3, n - 1))
    bands[0, 1:], bands[1], bands[2, :-1] = upper[:-1], -(lower + upper), lower[1:]
    t = np.concatenate([[cold], solve_banded((1, 1), bands, right), [warm]])
    mean = float(np.trapezoid(t * r, r) / np.trapezoid(r, r))
    out, inn, middle = thermal.shell_resistances(inner, outer, length, k)
    star = (heat + cold / inn + warm / out) / (1 / inn + 1 / out)
    assert star + middle * heat == pytest.approx(mean, rel=1e-6)
    outwards = -k * 2 * math.pi * outer * length * (3 * t[-1] - 4 * t[-2] + t[-3]) / (2 * h)
    assert (star - warm) / out == pytest.approx(outwards, rel=1e-4)


def test_wires_in_their_insulation(copper: Conductor) -> None:
    """The limits of the mixture: all insulation, all copper, and the 0.5 to 1 W/(m K) of wound coils between."""
    assert thermal.winding_conductivity(0.0, 401, 0.2) == pytest.approx(0.2)
    assert thermal.winding_conductivity(1.0, 401, 0.2) == pytest.approx(401)
    assert 0.5 < thermal.winding_conductivity(0.546, 401, 0.2) < 1.0


@settings(max_examples=30)
@given(current=st.floats(0.05, 1.6), duty=st.floats(0.2, 1.0), loss=st.floats(0, 1))
def test_the_continuous_current_of_a_temperature_makes_that_temperature(
    net: ThermalNetwork, table_ii: HybridActuator, copper: Conductor, current: float, duty: float, loss: float
) -> None:
    """Two ways to one current: the temperature it makes (by a root), and the current for that temperature."""
    made = thermal.winding_temperature(
        net, lambda kelvin: duty * copper_loss(resistance(table_ii, copper, kelvin), current), loss, loss
    )
    assert made is not None
    found = thermal.continuous_current(net, resistance(table_ii, copper, made), made, duty, loss, loss)
    assert found == pytest.approx(current, rel=1e-9)


def test_the_temperature_by_plain_iteration(net: ThermalNetwork, table_ii: HybridActuator, copper: Conductor) -> None:
    """The fixed point of temperature -> resistance -> loss -> temperature at 1 A, without the root finder."""

    def loss(kelvin: float) -> float:
        return copper_loss(resistance(table_ii, copper, kelvin), 1.0)

    kelvin = AMBIENT
    for _ in range(200):
        wanted, low, high = loss(kelvin), AMBIENT, 1000.0
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if thermal.heat_at(net, middle).winding_heat < wanted else (low, middle)
        kelvin = (low + high) / 2
    assert thermal.winding_temperature(net, loss) == pytest.approx(kelvin, rel=1e-9)
    assert 80 < kelvin - 273.15 < 110


def test_a_winding_that_runs_away_has_a_measure_of_it(
    net: ThermalNetwork, table_ii: HybridActuator, copper: Conductor
) -> None:
    """Catches an endless search, a gap at 2000 K, and a stand-in that does not grow with the current."""

    def at(current: float) -> float:
        return thermal.winding_temperature(
            net, lambda kelvin: copper_loss(resistance(table_ii, copper, kelvin), current)
        )

    found = [at(current) for current in (2.0, 4.0, 8.0, 16.0, 32.0)]
    assert found == sorted(found)
    assert found[0] < thermal.HOTTEST < found[-1] < math.inf
    low, high = 2.0, 32.0
    while high - low > 1e-9:
        middle = (low + high) / 2
        low, high = (middle, high) if at(middle) < thermal.HOTTEST else (low, middle)
    assert at(high) - at(low) < 1e-3
    assert thermal.winding_temperature(net, lambda kelvin: 0.0) == AMBIENT


def test_other_losses_alone_can_pass_the_limit(net: ThermalNetwork) -> None:
    assert thermal.continuous_current(net, 6.0, AMBIENT + 20, 1.0, 50.0, 0.0) < 0


def test_the_prototypes_resistances(net: ThermalNetwork) -> None:
    """Sizes by hand: 2.1 mm of 0.68 W/(m K) over 133 cm^2, 0.4 mm of air over 145 cm^2, 192 mm of tube."""
    assert net.outwards == pytest.approx(0.116 + 0.4e-3 / (0.0257 * 0.01484), rel=0.05)
    assert net.mean < 0
    assert net.along_tube == pytest.approx((0.192 / 12 + 0.028 / 4) / (167 * 110.6e-6), rel=1e-3)
    assert net.yoke_area == pytest.approx(math.pi * 0.027 * 0.205)


def test_the_temperature_is_smooth_enough_to_difference(
    net: ThermalNetwork, table_ii: HybridActuator, copper: Conductor
) -> None:
    """Catches a root or an iteration that stops early: second differences of steps of 1e-4 A are those of 1e-2 A."""

    def kelvin(current: float) -> float:
        found = thermal.winding_temperature(
            net, lambda kelvin: copper_loss(resistance(table_ii, copper, kelvin), current), 0.1, 0.5
        )
        assert found is not None
        return found

    slopes = [(kelvin(1 + step) - kelvin(1 - step)) / (2 * step) for step in (1e-3, 1e-5, 1e-6)]
    assert slopes[1] == pytest.approx(slopes[0], rel=1e-5)
    assert slopes[2] == pytest.approx(slopes[1], rel=1e-7)
