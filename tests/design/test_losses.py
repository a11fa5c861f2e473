"""Losses of the moving field: sums over small rings, a magnet falling in a pipe, and a conductor that thinks for
itself about its own field."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from fluxbore.design import losses
from fluxbore.design.bh_curve import MU_0
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.materials import Library, from_table

RHO = 3.99e-8


@given(gap=st.floats(0.05, 1.0), ring=st.floats(0.0, 7e-3), bore=st.floats(8e-3, 9.9e-3))
def test_the_walls_integral_is_the_sum_over_its_shells(
    table_ii: HybridActuator, gap: float, ring: float, bore: float
) -> None:
    """Catches a slip in the integral in closed form: shell by shell, the flux of a pole through its own height."""
    actuator = replace(
        table_ii,
        mover=replace(table_ii.mover, ring_width=ring),
        cylinder=replace(table_ii.cylinder, inner_diameter=2 * bore),
    )
    outer, mover_radius = actuator.cylinder.outer_diameter / 2, actuator.mover.outer_diameter / 2
    height = ring + 2 * (outer - mover_radius)
    flux = gap * 2 * math.pi * outer * height

    def shell(r: float) -> float:
        tube = ring + 2 * (r - mover_radius)
        return (flux / (2 * math.pi * r * tube)) ** 2 * 2 * math.pi * r * tube

    expected = 8 * quad(shell, bore, outer, epsabs=0, epsrel=1e-10)[0]
    assert losses.wall_square_field(actuator, gap) == pytest.approx(expected, rel=1e-8)


def test_a_ring_as_wide_as_the_magnets_is_no_exception(table_ii: HybridActuator) -> None:
    """Catches the division by zero where tau_f = D_m; the integral runs smoothly through it."""

    def at(ring: float) -> float:
        mover = replace(table_ii.mover, pole_pitch=0.04, ring_width=ring)
        return losses.wall_square_field(replace(table_ii, mover=mover), 0.5)

    width = table_ii.mover.outer_diameter
    assert at(width) == pytest.approx((at(width - 1e-6) + at(width + 1e-6)) / 2, rel=1e-7)


def test_the_drag_of_a_dipole_in_a_pipe() -> None:
    """Equation (a) against the published drag of a magnet in a thin pipe, 45 mu_0^2 m^2 sigma w / (1024 a^4)."""
    moment, radius, wall = 0.5, 10e-3, 0.1e-3

    def radial(z: float) -> float:
        distance = math.hypot(radius, z)
        return 3 * MU_0 * moment / (4 * math.pi) * radius * z / distance**5

    integral = quad(lambda z: radial(z) ** 2, -1.0, 1.0, points=[0.0], limit=400)[0] * 2 * math.pi * radius * wall
    published = 45 * MU_0**2 * moment**2 / RHO * wall / (1024 * radius**4)
    assert losses.drag_coefficient(RHO, integral) == pytest.approx(published, rel=1e-6)


@pytest.mark.parametrize(("speed", "error"), [(0.1, 0.01), (1.0, 0.02), (100.0, None)])
def test_the_drag_of_a_sheet_that_feels_its_own_field(speed: float, error: float | None) -> None:
    """The limit of validity: a travelling wave over a conducting sheet whose induced field is solved for. While the
    skin depth is well above the wall and mu_0 sigma v d/2 is small (a) holds; far beyond it is too large."""
    pitch, wall, applied = 0.012, 1.95e-3, 0.3
    k = math.pi / pitch
    # A_y = a(x) exp(i k z) in the sheet's frame: a'' = (k^2 + i omega mu_0 sigma) a, continuous with free space.
    omega = k * speed
    gamma = np.sqrt(k**2 + 1j * omega * MU_0 / RHO)
    # Incident exp(-k x) from below, amplitude such that B = i k A is `applied` amid an absent sheet.
    incident = applied / k * math.exp(k * wall / 2)
    system = np.array(
        [
            [1, -1, -1, 0],
            [k, gamma, -gamma, 0],
            [0, np.exp(-gamma * wall), np.exp(gamma * wall), -np.exp(-k * wall)],
            [0, -gamma * np.exp(-gamma * wall), gamma * np.exp(gamma * wall), k * np.exp(-k * wall)],
        ],
        dtype=complex,
    )
    _, falling, growing, _ = np.linalg.solve(system, [-incident, k * incident, 0, 0])
    x = np.linspace(0, wall, 2001)
    inside = falling * np.exp(-gamma * x) + growing * np.exp(gamma * x)
    true_loss = float(np.trapezoid(np.abs(omega * inside) ** 2, x)) / (2 * RHO)
    square = float(np.trapezoid((k * incident * np.exp(-k * x)) ** 2, x)) / 2
    simple = losses.drag_coefficient(RHO, square) * speed**2
    depth = losses.skin_depth(RHO, pitch, speed)
    if error is None:
        assert depth < 3 * wall
        assert simple > 1.3 * true_loss
    else:
        assert depth > 3 * wall
        assert simple == pytest.approx(true_loss, rel=error)


@given(amplitude=st.floats(0.1, 2.0))
def test_the_yokes_integral_is_that_of_a_sine_of_flux(table_ii: HybridActuator, amplitude: float) -> None:
    """Catches a factor of 2, 3 or pi: flux B_y A sin(pi z/tau) enters at the inside and fades linearly in the wall."""
    yoke, pitch = table_ii.back_yoke, table_ii.mover.pole_pitch
    area = math.pi / 4 * (yoke.outer_diameter**2 - yoke.inner_diameter**2)
    z = (np.arange(2000) + 0.5) / 2000 * table_ii.array_length
    entering = np.gradient(amplitude * area * np.sin(math.pi * z / pitch), z) / (math.pi * yoke.inner_diameter)
    depth = (np.arange(200) + 0.5) / 200
    mean_square = float(np.mean(entering**2)) * float(np.mean((1 - depth) ** 2))
    expected = mean_square * area * table_ii.array_length
    assert losses.yoke_square_field(table_ii, amplitude) == pytest.approx(expected, rel=2e-3)


def test_hysteresis_is_one_loop_a_period(table_ii: HybridActuator) -> None:
    """Steinmetz: 1000 J/m^3 at 1 T, 1.6 as exponent, in the 7.84 cm^3 of yoke beside 96 mm of magnets, over 24 mm."""
    table = {"type": "soft iron", "density": "7.8 g/cm^3", "bh": [[0.5, 50.0], [1.0, 100.0], [1.5, 900.0]]}
    data = {"resistivity": "1.5e-7 ohm m", "hysteresis_coefficient": "1 kJ/m^3"}
    found = losses.yoke_drag(table_ii, from_table("iron", table | data), 1.2)
    assert found is not None
    hysteresis, eddy = found
    volume = math.pi / 4 * (0.027**2 - 0.025**2) * 0.096
    assert losses.yoke_volume(table_ii) == pytest.approx(volume)
    assert hysteresis * 0.024 == pytest.approx(1000 * 1.2**1.6 * volume)
    assert eddy == pytest.approx(losses.yoke_square_field(table_ii, 1.2) / 1.5e-7)
    assert losses.yoke_drag(table_ii, from_table("iron", table), 1.2) is None


def test_steinmetzs_coefficient_in_todays_units(library: Library) -> None:
    """eta in erg/cm^3 and gauss: 0.0033 of annealed iron at 6000 G is 3660 erg/cm^3 of one cycle."""
    iron = library["pure iron"]
    assert iron.hysteresis_coefficient * 0.6**1.6 == pytest.approx(0.1 * 0.0033 * 6000**1.6, rel=2e-3)  # type: ignore[attr-defined]
