"""The closed field of a lead screw: the paper's harmonic ratios and remanence, stress against energy, and limits."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lead_screws import ARCS, PITCH, table_i
from radial_elements import RadialElements

from fluxbore.design.bh_curve import MU_0
from fluxbore.design.errors import DesignError
from fluxbore.design.helical_field import (
    ROTOR,
    TRANSLATOR,
    engagement_force,
    field_constants,
    force_series,
    gap_field,
    harmonic_ratios,
    harmonics,
    remanence_for_stall_force,
    stack,
    with_remanence,
)
from fluxbore.design.lead_screw import Arcs, LeadScrew
from fluxbore.design.radial_stack import solve

SCREW = table_i()
STALL_FORCE = 192.0  # N, Table II

screws = st.builds(
    lambda pitch, starts, gap, thickness, widths, radius, iron, mu: LeadScrew(
        pitch=pitch,
        poles=4,
        translator_radius=radius,
        gap=gap,
        translator=replace(
            SCREW.translator,
            magnet_thickness=thickness,
            magnet_width=widths[0] * pitch / 2,
            magnet_permeability=mu,
            iron_thickness=2e-3 * iron[0],
        ),
        rotor=replace(
            SCREW.rotor,
            magnet_thickness=thickness,
            magnet_width=widths[1] * pitch / 2,
            magnet_permeability=mu,
            iron_thickness=2e-3 * iron[1],
        ),
        translator_length=0.5,
        frame_radius=0.1,
        frame_length=0.1,
        starts=starts,
    ),
    st.floats(4e-3, 40e-3),
    st.integers(1, 4),
    st.floats(0.4e-3, 3e-3),
    st.floats(1e-3, 5e-3),
    st.tuples(st.floats(0.5, 1.0), st.floats(0.5, 1.0)),
    st.floats(8e-3, 40e-3),
    st.tuples(st.integers(0, 1), st.integers(0, 1)),
    st.floats(1.0, 1.2),
)


def test_harmonic_ratios_of_the_paper() -> None:
    """1.58 % and 0.08 % (Sec. III-A), of iron behind both, a full period and one start."""
    second, third = harmonic_ratios(SCREW)
    assert second == pytest.approx(1.58e-2, abs=0.02e-2)
    assert third == pytest.approx(0.080e-2, abs=0.002e-2)
    constants = field_constants(SCREW)
    assert constants[1] / constants[0] == pytest.approx(second, rel=1e-12)


def test_other_readings_miss_the_ratio() -> None:
    """Less iron, and l_p as the distance of two opposite poles: the reading with both irons and a full period is it."""
    assert harmonic_ratios(table_i(rotor_iron=False))[0] == pytest.approx(1.66e-2, abs=0.005e-2)
    assert harmonic_ratios(table_i(False, False))[0] == pytest.approx(1.74e-2, abs=0.005e-2)
    double = 2 * PITCH
    member = replace(SCREW.rotor, magnet_width=PITCH)
    assert harmonic_ratios(replace(SCREW, pitch=double, rotor=member, translator=member))[0] > 4e-2


@pytest.mark.parametrize(
    ("irons", "expected"), [((True, True), 1.216), ((True, False), 1.245), ((False, False), 1.276)]
)
def test_remanence_for_the_measured_stall_force(irons: tuple[bool, bool], expected: float) -> None:
    """Between 1.15 and 1.30 T, as magnets are; and the force of that remanence is the stall force again."""
    screw = table_i(*irons)
    remanence = remanence_for_stall_force(screw, STALL_FORCE)
    assert 1.15 < remanence < 1.30
    assert remanence == pytest.approx(expected, abs=1e-3)
    assert force_series(with_remanence(screw, remanence)).peak[1] == pytest.approx(STALL_FORCE, rel=1e-12)


def test_equations_7_to_9() -> None:
    """F of p_a poles from J_c of (8) and K_n: the sum over n as the paper writes it."""
    current = 1.0 / (1.05 * MU_0)
    x = PITCH / 7
    constants, wave = field_constants(SCREW), harmonics(SCREW)[0]
    force = 4 * np.pi * 4 * current * np.sum(constants * np.sin(wave * x))
    assert float(force) == pytest.approx(float(force_series(SCREW).force(x)), rel=1e-12)


@settings(max_examples=12)
@given(screw=screws, share=st.floats(0.05, 0.95), height=st.floats(0.0, 1.0))
def test_stress_in_the_gap_is_the_slope_of_the_coenergy(screw: LeadScrew, share: float, height: float) -> None:
    """Maxwell's stress over any cylinder in the gap against virtual work; and torque = h x force, by its own stress."""
    displacement = share * screw.pitch / 2
    _, low, high, _ = screw.radii
    radius = low + height * (high - low)
    zeta = np.linspace(0, screw.pitch, 512, endpoint=False)
    b_r, b_theta, b_z = gap_field(screw, radius, zeta, displacement)
    area = 2 * np.pi * radius * screw.active_length
    force = area * np.mean(b_r * b_z) / MU_0
    torque = -area * radius * np.mean(b_r * b_theta) / MU_0
    series = force_series(screw)
    assert float(force) == pytest.approx(float(series.force(displacement)), rel=1e-6, abs=1e-8 * series.peak[1])
    assert float(torque) == pytest.approx(screw.h * float(force), rel=1e-12)


@settings(max_examples=6)
@given(screw=screws)
def test_the_force_by_finite_elements_of_each_harmonic(screw: LeadScrew) -> None:
    """Patterns, factors and all: the peak by a route without Bessel functions, within its own error."""
    wave, order = harmonics(screw)
    found = []
    for n in (1, 3, 5):
        k = 2 * np.pi * n / screw.pitch
        elements = RadialElements(stack(screw), k, n * screw.starts, 60)
        b_t, b_r = (
            4 / (np.pi * n) * np.sin(n * np.pi * member.magnet_width / screw.pitch)
            for member in (screw.translator, screw.rotor)
        )
        found.append(np.pi * screw.active_length * k * b_t * b_r * elements.interaction(TRANSLATOR, ROTOR))
    amplitude = force_series(screw).amplitude[:3]
    assert amplitude == pytest.approx(found[: len(amplitude)], rel=1e-3, abs=1e-5 * found[0])
    assert (wave[0], order[0]) == (2 * np.pi / screw.pitch, screw.starts)


def test_planar_limit_of_the_ratios() -> None:
    """Thick magnets far from the axis: K_2/K_1 = e^{-2kg}/9, K_3/K_1 = e^{-4kg}/25."""
    member = replace(SCREW.rotor, magnet_thickness=20e-3, magnet_permeability=1.0)
    far = replace(SCREW, translator_radius=100.0, translator=member, rotor=member, frame_radius=101.0)
    kg = 2 * np.pi / PITCH * 0.8e-3
    assert harmonic_ratios(far) == pytest.approx((np.exp(-2 * kg) / 9, np.exp(-4 * kg) / 25), rel=1e-4)


def test_axisymmetric_limit_of_the_ratios() -> None:
    """h -> 0: orders 0 instead of n change the ratios in the third digit only, for h/r is small here."""
    wave = harmonics(SCREW)[0][:3]
    odd = np.array([1.0, 3.0, 5.0])
    amplitude = wave / odd**2 * solve(stack(SCREW), wave, 0 * odd).interaction(TRANSLATOR, ROTOR)
    assert amplitude[1:] / amplitude[0] == pytest.approx([1.586e-2, 0.0809e-2], rel=1e-3)
    slight = wave / odd**2 * solve(stack(SCREW), wave, 1e-7 * odd).interaction(TRANSLATOR, ROTOR)
    assert slight == pytest.approx(amplitude, rel=1e-9)


def test_arcs() -> None:
    """Helical arcs lose their share of the circumference; stepped ones the mean of the step too, 3/pi of 60 deg."""
    whole = force_series(SCREW).amplitude
    for stepped, factor in ((False, 0.75), (True, 0.75 * 2 * np.sin(np.pi / 8) / (np.pi / 4))):
        member = replace(SCREW.translator, arcs=Arcs(np.pi / 4, 6, stepped))
        assert force_series(replace(SCREW, translator=member)).amplitude[0] == pytest.approx(factor * whole[0])
    stepped_arcs = force_series(replace(SCREW, translator=replace(SCREW.translator, arcs=ARCS))).amplitude
    assert stepped_arcs[:3] / whole[:3] == pytest.approx([3 / np.pi, 2 / np.pi, 0.6 / np.pi])


def test_the_mean_over_a_step_is_the_average_of_shifted_helices() -> None:
    """A step of the angle beta is off the helix by -h beta/2 to h beta/2: force averaged over those, harmonic by
    harmonic."""
    shifts = (np.arange(2000) + 0.5) / 2000 * SCREW.h * ARCS.angle - SCREW.h * ARCS.angle / 2
    stepped = replace(SCREW, translator=replace(SCREW.translator, arcs=ARCS))
    for x in (0.3e-3, 1.2e-3):
        mean = float(np.mean(force_series(SCREW).force(x + shifts)))
        assert float(force_series(stepped).force(x)) == pytest.approx(mean, rel=1e-6)


def test_engagement_pulls_in_and_follows_the_coenergy() -> None:
    """Its modulated part is what the force moves along: -dF_end/dx_d x L = F; and nothing pulls where all is air and
    the magnets stand half a period apart, but for the odd harmonics' pushing."""
    x, step = np.array([0.2e-3, 0.9e-3, 2.0e-3]), 1e-7
    slope = (engagement_force(SCREW, x + step) - engagement_force(SCREW, x - step)) / (2 * step)
    series = force_series(SCREW)
    assert -slope * SCREW.active_length == pytest.approx(series.force(x), rel=1e-5)
    air = table_i(False, False)
    plain = replace(
        air,
        translator=replace(air.translator, magnet_permeability=1.0),
        rotor=replace(air.rotor, magnet_permeability=1.0),
    )
    aligned, opposed = engagement_force(plain, [0.0, PITCH / 2])
    assert float(aligned) == pytest.approx(-float(opposed), rel=1e-9)
    assert float(aligned) == pytest.approx(force_series(plain).barrier / (2 * plain.active_length), rel=1e-9)


@pytest.mark.parametrize("member", ["translator", "rotor"])
def test_iron_is_attracted_by_the_other_members_magnets(member: str) -> None:
    """One member without remanence but with iron: the pull does not depend on the displacement, and is by elements'
    self-energies the same."""
    screw = replace(SCREW, **{member: replace(getattr(SCREW, member), remanence=0.0)})
    pull = engagement_force(screw, [0.0, PITCH / 3])
    assert float(pull[0]) == pytest.approx(float(pull[1]))
    layer = ROTOR if member == "translator" else TRANSLATOR
    engaged = stack(screw)
    alone = (
        replace(engaged, permeability=(1.0, 1.0, 1.05), inner_iron=False)
        if member == "translator"
        else replace(engaged, permeability=(1.05, 1.0, 1.0), outer_iron=False)
    )
    expected = 0.0
    for n in (1, 3, 5, 7):
        k = 2 * np.pi * n / PITCH
        gained = RadialElements(engaged, k, n, 200).interaction(layer, layer)
        gained -= RadialElements(alone, k, n, 200).interaction(layer, layer)
        expected += np.pi / 2 * (4 / (np.pi * n)) ** 2 * gained
    assert float(pull[0]) > 0
    assert float(pull[0]) == pytest.approx(expected, rel=2e-3)


def test_gap_that_no_field_crosses() -> None:
    """A gap so wide that not even the first harmonic crosses it."""
    with pytest.raises(DesignError) as error:
        force_series(replace(SCREW, gap=50e-3, frame_radius=0.1))
    assert str(error.value) == "actuator.gap must let the field across, at most 32.74 mm at this pitch; got 50 mm."


@pytest.mark.parametrize("starts", [1, 20, 150, 1000])
def test_many_starts(starts: int) -> None:
    """A lead so long that its Bessel functions are no doubles: against elements, first harmonic and third."""
    screw = replace(SCREW, starts=starts, gap=0.05e-3)
    amplitude = force_series(screw).amplitude
    for place, n in enumerate((1, 3)):
        k = 2 * np.pi * n / PITCH
        found = RadialElements(stack(screw), k, n * starts, 1500).interaction(TRANSLATOR, ROTOR)
        expected = np.pi * screw.active_length * k * (4 / (np.pi * n)) ** 2 * found
        assert float(amplitude[place]) == pytest.approx(expected, rel=1e-5)


def test_figures_that_cannot_be_asked_for() -> None:
    with pytest.raises(DesignError, match=r"^A stall force must be finite and above 0 N; got 0 N\.$"):
        remanence_for_stall_force(SCREW, 0.0)
    with pytest.raises(
        DesignError, match=r"^A radius in the gap must be from 0\.01745 m to 0\.01825 m; got 0\.02 m\.$"
    ):
        gap_field(SCREW, 0.02, 0.0, 0.0)
