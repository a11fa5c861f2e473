"""The winding's figures against the paper, against sampling, and where they must not change."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design import winding
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.materials import Conductor, Library


@pytest.fixture(scope="module")
def copper(library: Library) -> Conductor:
    conductor = library["copper"]
    assert isinstance(conductor, Conductor)
    return conductor


def test_published_resistance(table_ii: HybridActuator, copper: Conductor) -> None:
    """Catches a wrong turn length or wire area, and a temperature coefficient that is not applied."""
    assert winding.resistance(table_ii, copper) == pytest.approx(5.55, abs=0.005)
    assert winding.resistance(table_ii, copper, 273.15 + 27) == pytest.approx(5.70, abs=0.005)


def test_resistance_is_that_of_turns_spread_over_the_window(table_ii: HybridActuator, copper: Conductor) -> None:
    """Catches a diameter that is not the mean: circumferences of turns spread evenly over the window, summed up."""
    diameters = np.linspace(20e-3, 24.2e-3, 2001)
    length = 584 * math.pi * diameters.mean()
    expected = 1.72e-8 * length / (math.pi * 0.2e-3**2)
    assert winding.resistance(table_ii, copper) == pytest.approx(expected, rel=1e-9)


def test_winding_factor_of_three_coils_side_by_side(table_ii: HybridActuator) -> None:
    """Catches a mechanical angle where the electrical one belongs: sin 60 deg / (pi/3)."""
    assert winding.winding_factor(table_ii) == pytest.approx(math.sin(math.pi / 3) / (math.pi / 3), rel=1e-12)


def test_electric_loading_of_one_ampere(table_ii: HybridActuator) -> None:
    """Catches rms or power-invariant currents (10672 and 6162 A/m in place of 7546)."""
    assert winding.electric_loading(table_ii, 1.0) == pytest.approx(7546.0, abs=1.0)
    assert winding.electric_loading(table_ii, 2.5) == pytest.approx(2.5 * winding.electric_loading(table_ii, 1.0))


@given(angle=st.floats(0.0, 2 * math.pi))
def test_electric_loading_is_the_fundamental_of_the_current_sheet(table_ii: HybridActuator, angle: float) -> None:
    """Catches a factor of the closed form: the sheet U V W of one period sampled, its fundamental by Fourier transform.

    At any electrical angle the amplitude must be the same, or the wave would not travel evenly.
    """
    samples = 3 * 4096
    coil = np.arange(samples) * 3 // samples  # which of the three coils of a period a sample lies in
    # U V W in space order need currents that advance by 120 degrees from coil to coil for one travelling wave
    currents = np.cos(angle - 2 * math.pi / 3 * np.arange(3))
    sheet = 73 * currents[coil] / 8e-3
    fundamental = 2 * abs(np.fft.rfft(sheet)[1]) / samples
    assert winding.electric_loading(table_ii, 1.0) == pytest.approx(fundamental, rel=1e-6)


def test_copper_of_table_ii(table_ii: HybridActuator, copper: Conductor) -> None:
    """Catches the mass of one phase for that of three, and a fill that counts the bare window twice."""
    assert winding.copper_fill(table_ii) == pytest.approx(4.345e6 * math.pi * 0.2e-3**2, rel=1e-3)
    window = math.pi / 4 * (24.2e-3**2 - 20e-3**2) * 192e-3
    assert winding.copper_volume(table_ii) == pytest.approx(winding.copper_fill(table_ii) * window, rel=1e-9)
    assert winding.copper_mass(table_ii, copper) == pytest.approx(8960.0 * winding.copper_volume(table_ii), rel=1e-12)


@given(current=st.floats(0.01, 100.0), resistance=st.floats(0.01, 100.0), constant=st.floats(0.1, 100.0))
def test_motor_constant_is_force_over_the_root_of_loss(current: float, resistance: float, constant: float) -> None:
    """Catches a motor constant and a copper loss with different conventions of the current."""
    loss = winding.copper_loss(resistance, current)
    assert winding.motor_constant(constant, resistance) == pytest.approx(constant * current / math.sqrt(loss))


@given(current=st.floats(0.1, 10.0), angle=st.floats(0.0, 2 * math.pi))
def test_copper_loss_is_the_sum_over_three_phases(current: float, angle: float) -> None:
    """Catches a factor of 2 or 3: the three instantaneous losses add to the same at every angle."""
    phases = [current * math.cos(angle - k * 2 * math.pi / 3) for k in range(3)]
    assert winding.copper_loss(5.55, current) == pytest.approx(5.55 * sum(i**2 for i in phases), rel=1e-9)


@given(factor=st.floats(0.5, 2.0))
def test_copper_loss_at_a_given_loading_does_not_depend_on_the_wire(
    table_ii: HybridActuator, copper: Conductor, factor: float
) -> None:
    """Catches turns or wire area in the wrong power: n times the turns of 1/n the area, at I/n, lose the same."""
    rewound = replace(
        table_ii,
        winding=replace(
            table_ii.winding,
            turns=table_ii.winding.turns * factor,
            wire_diameter=table_ii.winding.wire_diameter / math.sqrt(factor),
        ),
    )
    assert winding.electric_loading(rewound, 1.0 / factor) == pytest.approx(winding.electric_loading(table_ii, 1.0))
    before = winding.copper_loss(winding.resistance(table_ii, copper), 1.0)
    after = winding.copper_loss(winding.resistance(rewound, copper), 1.0 / factor)
    assert after == pytest.approx(before, rel=1e-9)
