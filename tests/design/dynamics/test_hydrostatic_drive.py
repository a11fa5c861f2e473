"""The electro-hydrostatic drive: against SciPy's solver, its energy, its steps, and runs that cannot be."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from fluxbore.design.cylinder_friction import cylinder_friction
from fluxbore.design.dynamics.force_reference import ForceReference, force_reference, rate, value
from fluxbore.design.dynamics.hydrostatic_drive import DriveRun, feed_forward, resting, simulate, velocity_loop
from fluxbore.design.dynamics.hydrostatic_network import network
from fluxbore.design.dynamics.hydrostatic_ports import copper_loss, energy_audit, fluid_loss, ports, screw_friction
from fluxbore.design.dynamics.hydrostatic_step import sliding
from fluxbore.design.errors import DesignError
from fluxbore.design.fluid import bulk_modulus, specific_enthalpy, volume_ratio
from fluxbore.design.hydrostatic import HydrostaticActuator
from fluxbore.design.prehydra_parameters import prehydra
from fluxbore.design.return_element import ConstantReturn, CordReturn, LinearReturn

Floats = NDArray[np.float64]
SIGNAL = ForceReference(45.0, 45.0, 30.0, 6.0, ramp=0.1)
DURATION = 0.27


@pytest.fixture(scope="module")
def actuator() -> HydrostaticActuator:
    return prehydra()


@pytest.fixture(scope="module")
def run(actuator: HydrostaticActuator) -> DriveRun:
    return simulate(actuator, SIGNAL, DURATION)


def scipy_force(actuator: HydrostaticActuator, signal: ForceReference, duration: float) -> Floats:
    """F_out (N) at the control samples, by SciPy's LSODA on pressures in place of contents, friction regularised as
    the paper has it, every sample a new start."""
    from scipy.integrate import solve_ivp

    chain = network(actuator)
    first, second, fluid = actuator.input_cylinder, actuator.output_cylinder, actuator.fluid
    loop, period, screw = velocity_loop(actuator), actuator.drive.force_period, actuator.ball_screw
    grid = 2.5e-4 * np.linspace(-1.0, 1.0, 4001) ** 3
    drops = [[link.resistance(q, chain.rho, chain.mu) * q for q in grid.tolist()] for link in chain.links]

    def slopes(_: float, y: Floats, wanted: float) -> Floats:
        v_1, v_2, x_1, x_2, z = y[:5]
        p = y[5:] * 1e5
        ratio, e = volume_ratio(fluid, p), specific_enthalpy(fluid, p)
        q = [np.interp(e[j] - e[j + 1], drops[j], grid) for j in range(2)]
        volume = chain.volume(x_1, x_2)
        moved = np.array([-first.area * v_1, 0.0, second.area * v_2])
        gained = np.append(0.0, q) - np.append(q, 0.0) - moved / ratio
        wall = chain.wall + (1 + p * chain.wall) / bulk_modulus(fluid, p)
        share = (1 / screw.efficiency - 1) if v_1 >= 0 else (1 - screw.efficiency)
        lost = share * first.area * p[0] * np.clip(v_1 / first.friction.linear_speed, -1.0, 1.0)
        rub_1 = float(cylinder_friction(first.friction, v_1, p[0])) + lost
        rub_2 = float(cylinder_friction(second.friction, v_2, p[2]))
        motor = loop.gain * (wanted - v_1) + loop.integral_gain * z
        return np.concatenate(
            [
                [(motor - first.area * p[0] - rub_1) / actuator.reflected_mass],
                [(second.area * p[2] - rub_2 - chain.return_force(x_2)) / second.moving_mass],
                [v_1, v_2, wanted - v_1],
                gained / (volume / ratio * wall) / 1e5,
            ]
        )

    start = resting(chain)
    y = np.array([0.0, 0.0, 0.0, 0.0, start.integral, *(p / 1e5 for p in start.mean[:3])])
    count = round(duration / period)
    times = period * np.arange(count, dtype=np.float64)
    ahead, forces = feed_forward(chain, signal, times), [chain.return_force(0.0)]
    for sample in range(count):
        wanted = ahead[sample] + actuator.drive.force_gain * (value(signal, times[sample]) - forces[-1])
        found = solve_ivp(
            slopes, (0.0, period), y, "LSODA", args=(float(wanted),), t_eval=[period], rtol=1e-6, atol=1e-8
        )
        y = found.y[:, -1]
        forces.append(chain.return_force(float(y[3])))
    return np.array(forces)


@pytest.mark.parametrize("duration", [0.014, pytest.param(0.1, marks=pytest.mark.full)])
def test_fast_solver_agrees_with_scipys(actuator: HydrostaticActuator, duration: float) -> None:
    """0.02 N at any sample, from the first breaking away; the long run over the ramp into the cosine and its turns."""
    signal = replace(SIGNAL, ramp=0.025, frequency=20.0, swing=5.0)
    exact = scipy_force(actuator, signal, duration)
    fast = simulate(actuator, signal, duration)
    steps = round(actuator.drive.force_period / fast.step)
    assert np.max(np.abs(fast.force[::steps] - exact)) < 0.02


def test_energy_that_enters_is_stored_or_lost(run: DriveRun) -> None:
    """To 1e-6 of what enters, in every component and over the chain; friction takes most of it."""
    audit = energy_audit(run)
    assert audit.imbalance < 1e-6
    assert all(part.lost >= 0 for part in audit.components)
    whole = sum(part.stored + part.lost for part in audit.components)
    assert whole == pytest.approx(float(np.sum(ports(run)[0].power)) * run.step, rel=1e-6)
    assert audit.lost["output piston"] > audit.lost["output line"] > 0
    assert copper_loss(run) == audit.copper > 0
    assert 0 < fluid_loss(audit, DURATION) < audit.entered / DURATION


def test_ports_carry_the_same_flow_through_each_link(run: DriveRun) -> None:
    by_name = {port.name: port for port in ports(run)}
    first, second = by_name["input line, first"], by_name["input line, second"]
    np.testing.assert_array_equal(first.flow, second.flow)
    assert np.all((first.effort - second.effort) * first.flow >= -1e-9)
    assert by_name["motor shaft"].units == ("N m", "rad/s")


def test_screw_never_drives(run: DriveRun) -> None:
    speed = (run.velocity[1:, 0] + run.velocity[:-1, 0]) / 2
    assert np.all(screw_friction(run) * speed >= 0)


def test_halving_the_step_changes_little(actuator: HydrostaticActuator, run: DriveRun) -> None:
    """Figures by less than 1 %, and the force at any time by less than the reference solver's margin."""
    fine = simulate(actuator, SIGNAL, DURATION, step=run.step / 2)
    assert np.max(np.abs(fine.force[::2] - run.force)) < 0.02
    coarse_error, fine_error = (np.abs(r.reference - r.force)[r.time >= 0.1] for r in (run, fine))
    assert np.max(coarse_error) == pytest.approx(np.max(fine_error), rel=0.01)
    assert np.mean(coarse_error) == pytest.approx(np.mean(fine_error), rel=0.01)


def test_mass_of_fluid_stays(run: DriveRun) -> None:
    total = np.sum(run.content, axis=1)
    assert np.ptp(total) < 1e-12 * total[0]


def test_step_size_must_divide_the_period(actuator: HydrostaticActuator) -> None:
    with pytest.raises(
        DesignError, match=r"The step must be a whole share of the control period 0.001 s; got 0.0003 s"
    ):
        simulate(actuator, SIGNAL, 0.1, step=3e-4)
    with pytest.raises(DesignError, match=r"duration of a run must be finite and above 0 s; got 0 s"):
        simulate(actuator, SIGNAL, 0.0)


def test_light_pistons_take_short_steps(actuator: HydrostaticActuator) -> None:
    """Of 20 g the equation of a piston under falling friction has one solution below 23 us alone."""
    light = replace(actuator, output_cylinder=replace(actuator.output_cylinder, moving_mass=0.02))
    with pytest.raises(DesignError, match=r"The step must be at most 2\.28\de-05 s .*; got 0.000125 s\."):
        simulate(light, SIGNAL, 0.1, step=125e-6)
    found = simulate(light, SIGNAL, 0.02)
    assert found.step < 12e-6
    assert energy_audit(found).imbalance < 1e-6


def test_a_delay_comes_late_by_itself(actuator: HydrostaticActuator) -> None:
    """From rest, a delay of two steps moves the whole force by that time, until feedback matters."""
    late = replace(actuator, drive=replace(actuator.drive, delay=500e-6, force_gain=0.0))
    prompt = replace(actuator, drive=replace(actuator.drive, force_gain=0.0))
    a, b = (simulate(each, SIGNAL, 0.05, step=250e-6) for each in (prompt, late))
    np.testing.assert_allclose(b.force[2:], a.force[:-2], atol=2e-4)


def test_weak_motor_is_held_at_its_limit(actuator: HydrostaticActuator) -> None:
    """Its torque never exceeds the peak, and energy still balances."""
    motor = replace(actuator.motor, peak_torque=0.15, continuous_torque=0.1)
    weak = simulate(replace(actuator, motor=motor), SIGNAL, 0.15)
    torque = weak.motor_force * actuator.ball_screw.ratio
    assert np.max(np.abs(torque)) == pytest.approx(0.15, rel=1e-12)
    assert energy_audit(weak).imbalance < 1e-6


def test_what_cannot_run_is_told(actuator: HydrostaticActuator) -> None:
    large = force_reference(300.0, 0.5, "half", 45.0, 45.0)
    with pytest.raises(DesignError, match=r"must not exceed .* 477.8 N; got 645 N\."):
        simulate(actuator, large, 0.1)
    still = replace(actuator, return_element=ConstantReturn(100.0))
    with pytest.raises(DesignError, match=r"return_spring must grow stiffer with the stroke"):
        simulate(still, SIGNAL, 0.1)
    slack = replace(actuator, return_element=LinearReturn(2840.0, 0.0))
    with pytest.raises(DesignError, match=r"must stay within .*stroke 152.4 mm; got -1.\d+ mm at 0.1\d* s\."):
        simulate(slack, ForceReference(0.0, 0.0, 60.0, 8.0, ramp=0.03), 0.2)
    tight = replace(actuator.output_cylinder.friction, preload=80.0)
    dry = replace(slack, output_cylinder=replace(actuator.output_cylinder, friction=tight))
    with pytest.raises(DesignError, match=r"must not fall below the fluid's vapour pressure, .* got .* MPa gauge\."):
        simulate(dry, ForceReference(0.0, 0.0, 60.0, 3.0, ramp=0.15), 0.35, step=250e-6)
    with pytest.raises(DesignError, match=r'reading of an amplitude must be "half" or "peak-to-peak"; got "rms"'):
        force_reference(50.0, 4.0, "rms", 45.0, 45.0)


def test_rubber_cord_and_series_spring_return_the_piston(actuator: HydrostaticActuator) -> None:
    """Other return elements follow the same reference: feed-forward takes their slope where the force is."""
    cord = CordReturn(0.25, 4e-4, 1.05, 0.25e6, 0.08e6)
    signal = ForceReference(cord.force(0.0), cord.force(0.0), 15.0, 4.0, ramp=0.1)
    found = simulate(replace(actuator, return_element=cord), signal, 0.2)
    assert np.max(np.abs(found.reference - found.force)) < 5.0
    series = replace(actuator, series_stiffness=1000.0)
    stiff = simulate(series, SIGNAL, 0.2)
    assert stiff.way[-1, 1] < simulate(actuator, SIGNAL, 0.2).way[-1, 1]


@pytest.mark.parametrize("yielding", [1e-5, 1e-4])
@pytest.mark.parametrize("wanted", [0.0, 1e-9, 1e-4, 1.5e-3, 3e-3, 0.02, 0.5, -0.003, -0.4])
def test_sliding_solves_its_equation(actuator: HydrostaticActuator, wanted: float, yielding: float) -> None:
    """With the friction of the paper, at any place of the law."""
    law = actuator.output_cylinder.friction
    v, force = sliding(law)(law.preload, wanted, yielding)
    assert v + yielding * force == pytest.approx(wanted, abs=1e-15)
    assert force == pytest.approx(float(cylinder_friction(law, v, 0.0)), rel=1e-2 if abs(v) < 1e-4 else 1e-9, abs=1e-9)


def test_reference_is_smooth_and_reads_both_ways() -> None:
    """Value and slope of ramp and cosine meet; the slope is that of the value; half reading swings twice as far."""
    signal = force_reference(50.0, 4.0, "half", 45.0, 45.0)
    t = np.linspace(0.0, 4.0, 4001)
    np.testing.assert_allclose(rate(signal, t)[1:-1], np.gradient(value(signal, t), t)[1:-1], atol=8.0)
    assert value(signal, 2.0) == value(signal, 2.0 - 1e-12) == pytest.approx(145.0)
    after = value(signal, t[t >= 2])
    assert float(np.min(after)) == pytest.approx(45.0, abs=0.01)
    assert float(np.max(after)) == pytest.approx(145.0)
    assert force_reference(50.0, 4.0, "peak-to-peak", 45.0, 45.0).peak == 95.0
    assert math.isclose(float(np.ptp(after)), 100.0, rel_tol=1e-3)
