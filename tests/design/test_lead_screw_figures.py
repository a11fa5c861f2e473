"""Spring, gear and mass of a lead screw: the paper's numbers, limits, and simulated motion against closed figures."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from lead_screws import ARCS, PITCH, table_i
from radial_elements import RadialElements
from scipy.integrate import solve_ivp

from fluxbore.design.errors import DesignError
from fluxbore.design.force_series import ForceSeries
from fluxbore.design.helical_field import force_series, remanence_for_stall_force, stack, with_remanence
from fluxbore.design.lead_screw_figures import (
    back_drivable,
    back_driving_force,
    back_iron_flux_density,
    engaged_fraction,
    engaged_length,
    full_engagement,
    largest_acceleration,
    mover_mass,
    natural_frequency,
    reflected_inertia,
    reflected_mass,
    rotor_inertia,
    rotor_mass,
    sinusoidal_spring_constant,
    slip_work,
    spring_constant,
    sudden_load_limit,
    torque,
    transfer_ratio,
    translator_magnet_mass,
)

SCREW = table_i()
SERIES = force_series(with_remanence(SCREW, remanence_for_stall_force(SCREW, 192.0)))
SINE = ForceSeries(np.array([192.0]), PITCH)


def test_transfer_ratio_and_torque() -> None:
    """2 pi/l_p, and the torque that turns the rotor by what the force moves the mover: power in is power out."""
    assert transfer_ratio(SCREW) == pytest.approx(2 * math.pi / PITCH)
    x = np.array([0.1e-3, 1e-3])
    assert torque(SCREW, SERIES, x) * transfer_ratio(SCREW) == pytest.approx(SERIES.force(x))
    assert float(torque(SCREW, SERIES, PITCH / 4)) == pytest.approx(192.0 * 8.185e-4, rel=1e-3)


def test_spring_constants_of_the_paper() -> None:
    """F_stall/h is 234.6 kN/m, the paper's identified K_s 220; the third harmonic adds 6 % at rest, where it counts
    thrice and the peak is that much less than the fundamental."""
    assert sinusoidal_spring_constant(192.0, PITCH) == pytest.approx(234.57e3, rel=1e-4)
    assert spring_constant(SINE) == pytest.approx(sinusoidal_spring_constant(192.0, PITCH))
    assert spring_constant(SERIES) / spring_constant(SINE) == pytest.approx(1.068, abs=1e-3)


def test_sudden_load() -> None:
    """The mover thrown by a load a little below the limit comes back; a little above, it slips."""
    limit = sudden_load_limit(SINE)
    assert limit == pytest.approx(0.724611 * 192.0, rel=1e-5)
    for spring in (SINE, SERIES):
        limit = sudden_load_limit(spring)
        assert limit < spring.peak[1]
        reached = []
        for share in (0.999, 1.001):
            found = solve_ivp(
                lambda t, y, load=share * limit, law=spring: [y[1], (load - float(law.force(y[0]))) / 2.55],
                (0.0, 0.2),
                [0.0, 0.0],
                rtol=1e-8,
                atol=1e-12,
            )
            reached.append(float(np.max(found.y[0])))
        assert reached[0] < PITCH / 2 < PITCH < reached[1]


def test_slip() -> None:
    """Over a pitch the spring gives back what it took: all of the load's work is left in the mover."""
    x = np.linspace(0, PITCH, 4001)
    assert float(np.mean(200.0 - SERIES.force(x[:-1]))) * PITCH == pytest.approx(slip_work(SERIES, 200.0), rel=1e-9)


def test_back_driving() -> None:
    """A rotor of so much friction that the load would need more than the stall force is not driven back: it slips."""
    assert back_driving_force(SCREW, 0.05) == pytest.approx(0.05 * transfer_ratio(SCREW))
    most = 192.0 * SCREW.h
    assert back_drivable(SCREW, SERIES, 0.99 * most)
    assert not back_drivable(SCREW, SERIES, 1.01 * most)


def test_engagement_along_the_stroke() -> None:
    """Whole in the middle, half where the rotor's middle is at the translator's end, none when it has left."""
    end, reach = full_engagement(SCREW), SCREW.translator_length / 2
    places = np.array([0.0, end, -end, reach, -reach, reach + SCREW.active_length / 2, 1.0])
    assert engaged_fraction(SCREW, places) == pytest.approx([1, 1, 1, 0.5, 0.5, 0, 0], abs=1e-12)
    assert engaged_length(SCREW, reach) == pytest.approx(SCREW.active_length / 2)


def test_masses_of_rings() -> None:
    """Against the density integrated over the rings in slices; arcs and narrow magnets weigh their share."""
    plain = replace(SCREW, rotor=replace(SCREW.rotor, iron_thickness=1e-3), carried_mass=2.0)
    mass = inertia = 0.0
    radii = np.linspace(18.25e-3, 26.25e-3, 8001)
    middle, width = (radii[1:] + radii[:-1]) / 2, np.diff(radii)
    density = np.select(
        [middle < 20.75e-3, middle < 21.75e-3], [7500.0 * 2 * PITCH, 7850.0 * 2 * PITCH], 1400.0 * 65e-3
    )
    mass = float(np.sum(2 * np.pi * middle * width * density))
    inertia = float(np.sum(2 * np.pi * middle**3 * width * density))
    assert rotor_mass(plain) == pytest.approx(mass, rel=1e-6)
    assert rotor_inertia(plain) == pytest.approx(inertia, rel=1e-6)
    assert mover_mass(plain) == pytest.approx(mass + 2.0)
    whole = translator_magnet_mass(SCREW)
    assert whole == pytest.approx(7500 * np.pi * (17.45**2 - 14.95**2) * 1e-6 * 85e-3)
    half = replace(SCREW, translator=replace(SCREW.translator, magnet_width=PITCH / 4, arcs=replace(ARCS, per_turn=3)))
    assert translator_magnet_mass(half) == pytest.approx(whole / 4)


def test_reflected_inertia_keeps_the_kinetic_energy() -> None:
    """Table II's rotor of 7.68e-5 kg m^2 is 115 kg to the load; J omega^2 = m v^2 with v = h omega."""
    assert reflected_mass(SCREW, 7.68e-5) == pytest.approx(114.6, abs=0.05)
    assert reflected_inertia(SCREW, reflected_mass(SCREW, 7.68e-5)) == pytest.approx(7.68e-5)


def test_natural_frequencies_are_those_of_the_two_masses() -> None:
    """(4), (5) with a linear spring: eigenvalues of its matrices in the rotor's angle and the mover's displacement."""
    k, h, j, m = 220e3, SCREW.h, 7.68e-5, 2.55
    stiffness = np.array([[h * h * k, -h * k], [-h * k, k]])
    values = np.linalg.eigvals(np.linalg.solve(np.diag([j, m]), stiffness))
    assert natural_frequency(k, m, reflected_mass(SCREW, j)) == pytest.approx(math.sqrt(max(values)) / (2 * math.pi))
    assert natural_frequency(k, m) == pytest.approx(math.sqrt(k / m) / (2 * math.pi))


def test_acceleration() -> None:
    assert largest_acceleration(192.0, 2.55, 90.0) == pytest.approx(40.0)
    with pytest.raises(DesignError, match=r"^A load must be at most the stall force 192 N; got 193 N\.$"):
        largest_acceleration(192.0, 2.55, 193.0)


def test_flux_along_the_back_iron() -> None:
    """By elements' fluxes and, in half the iron, twice as dense; None where there is no iron."""
    translator, rotor = back_iron_flux_density(SCREW)
    assert translator is not None
    assert rotor is not None
    odd = np.arange(1, 32, 2)
    passed = np.zeros(2)
    for n in odd:
        elements = RadialElements(stack(SCREW), 2 * np.pi * n / PITCH, n, 100)
        # b_n and the sine at a quarter of the pitch change sign alike: all harmonics add there.
        passed += 4 / (np.pi * n) * PITCH / (2 * np.pi * n) * (np.array(elements.flux(0)) + np.array(elements.flux(2)))
    # Behind its magnets r B_r is r b_n from there on: the rest of the sum of 1/n^2, pi^2/8 in all.
    rest = np.pi**2 / 8 - np.sum(1 / odd**2)
    passed += 2 * PITCH / np.pi**2 * rest * np.array([14.95e-3, 20.75e-3])
    sections = np.array([14.95e-3**2 - 9.95e-3**2, 25.75e-3**2 - 20.75e-3**2]) / 2
    slant = np.hypot(1, SCREW.h / np.array([12.45e-3, 23.25e-3]))
    assert (translator, rotor) == pytest.approx(tuple(passed / sections / slant), rel=3e-3)
    assert back_iron_flux_density(table_i(False, False)) == (None, None)
    thin = replace(SCREW, rotor=replace(SCREW.rotor, iron_thickness=0.25e-3))
    thick = replace(SCREW, rotor=replace(SCREW.rotor, iron_thickness=0.5e-3))
    ratio = (back_iron_flux_density(thin)[1] or 0.0) / (back_iron_flux_density(thick)[1] or 1.0)
    assert ratio == pytest.approx(2.0, rel=0.01)
