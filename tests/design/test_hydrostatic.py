"""The PREHydrA in closed form: the paper's figures, its limits by independent routes, and bad data."""

import math
from dataclasses import replace

import numpy as np
import pytest

from fluxbore.design.cylinder_friction import PUBLISHED, CylinderFriction, cylinder_friction, least_friction
from fluxbore.design.errors import DesignError
from fluxbore.design.hydrostatic import HydrostaticActuator, fluid_mass_at_piston
from fluxbore.design.hydrostatic_figures import (
    burst_factor,
    distal_mass,
    fluid_temperature,
    force_density,
    force_efficiency,
    force_frequency_limit,
    friction_at,
    ideal_force,
    least_wall,
    line_pressure_drop,
    maximum_velocity,
    pushing_force,
    rod_buckling_force,
    smallest_friction,
    stroke_force,
    total_mass,
)
from fluxbore.design.hydrostatic_range import demand, largest_amplitude, operating_map
from fluxbore.design.materials import standard
from fluxbore.design.prehydra_parameters import prehydra
from fluxbore.design.pressure_vessel import wall_stress
from fluxbore.design.return_element import ConstantReturn, CordReturn


@pytest.fixture(scope="module")
def actuator() -> HydrostaticActuator:
    return prehydra()


def test_published_figures(actuator: HydrostaticActuator) -> None:
    """Equation (4), Secs. IV and V; the least friction is 10.3 N by Table I where the text says 7 N."""
    assert force_frequency_limit(actuator) == pytest.approx(213, abs=0.5)
    assert maximum_velocity(actuator) == pytest.approx(0.47, abs=0.005)
    assert stroke_force(actuator) == pytest.approx(433, abs=0.5)
    assert ideal_force(actuator) == pytest.approx(1124, abs=1)
    assert smallest_friction(actuator) == pytest.approx(10.3, abs=0.1)
    assert friction_at(actuator, 0.45, 26e5) == pytest.approx(45.8, abs=0.3)
    shares = force_efficiency(actuator, 300.0, 0.45, 26e5)
    assert shares.one_cylinder == pytest.approx(0.87, abs=0.005)
    assert shares.both_cylinders == pytest.approx(0.766, abs=0.002)
    assert distal_mass(actuator) == pytest.approx(0.5, abs=0.05)
    assert force_density(actuator).distal == pytest.approx(2000, rel=0.1)
    assert force_density(actuator).total < 500
    assert 1e3 < pushing_force(actuator, 0.45) < pushing_force(actuator, 0.0)


def test_least_friction_is_the_least(actuator: HydrostaticActuator) -> None:
    speeds = np.geomspace(2e-4, 1.0, 4000)
    for law in (PUBLISHED, replace(PUBLISHED, stribeck_decay=3.0)):
        speed, force = least_friction(law)
        assert force <= np.min(cylinder_friction(law, speeds, 0.0)) + 1e-9
        assert force == pytest.approx(np.min(cylinder_friction(law, speeds, 0.0)), rel=1e-3)
        assert speed == pytest.approx(speeds[np.argmin(cylinder_friction(law, speeds, 0.0))], abs=1e-3)


def test_friction_is_odd_and_never_drives() -> None:
    v = np.linspace(-0.5, 0.5, 2001)
    force = cylinder_friction(PUBLISHED, v, 26e5)
    assert np.all(force * v >= 0)
    np.testing.assert_allclose(force, -force[::-1])


def test_limits_of_the_range(actuator: HydrostaticActuator) -> None:
    """Below 1 Hz the stroke limits, above it the speed, along (4)."""
    slow, why = largest_amplitude(actuator, 0.5, 45.0)
    assert why == "stroke"
    assert slow == pytest.approx(stroke_force(actuator) / 2, rel=1e-6)
    fast, why = largest_amplitude(actuator, 4.0, 45.0)
    assert why == "speed"
    assert fast == pytest.approx(force_frequency_limit(actuator) / 4, rel=1e-6)


def test_a_cord_is_drawn_out_to_the_end_of_the_stroke(actuator: HydrostaticActuator) -> None:
    """Its slope in the middle of the force would take 3 % off the force that the stroke allows."""
    cord = CordReturn(0.2, 4e-4, 1.3, 2e5, 0.0)
    elastic, stroke = replace(actuator, return_element=cord), actuator.output_cylinder.stroke
    found, why = largest_amplitude(elastic, 0.05, 130.0)
    assert why == "stroke"
    assert 130.0 + 2 * found == pytest.approx(cord.force(stroke), rel=1e-6)
    half = demand(elastic, (cord.force(stroke / 2) - 130.0) / 2, 0.05, 130.0)
    assert half.stroke == pytest.approx(0.5, rel=1e-6)
    assert demand(elastic, found + 1.0, 0.05, 130.0).stroke > 1


def test_weaker_parts_move_the_limit(actuator: HydrostaticActuator) -> None:
    """Each limit takes over where its own part is made weak."""
    low = replace(actuator, output_cylinder=replace(actuator.output_cylinder, rated_pressure=10e5))
    assert largest_amplitude(low, 0.5, 45.0)[1] == "pressure"
    limp = replace(actuator, motor=replace(actuator.motor, peak_torque=0.2, continuous_torque=0.2))
    assert largest_amplitude(limp, 0.5, 45.0)[1] == "torque"
    tame = replace(actuator, motor=replace(actuator.motor, rated_power=20.0))
    assert largest_amplitude(tame, 2.0, 45.0)[1] == "power"


def test_map_agrees_with_its_edge(actuator: HydrostaticActuator) -> None:
    largest, names = operating_map(actuator, [0.5, 4.0], [20.0, 100.0, 250.0], 45.0)
    assert largest.shape == (2, 3)
    assert names.tolist() == [["", "", "stroke"], ["", "speed", "power"]]
    assert np.all((largest > 1) == (names != ""))


def test_constant_force_asks_for_pressure_alone(actuator: HydrostaticActuator) -> None:
    found = demand(replace(actuator, return_element=ConstantReturn(100.0)), 50.0, 1.0, 100.0)
    assert found.speed == found.stroke == 0.0
    assert found.pressure == pytest.approx(200 / ideal_force(actuator))


def test_wall_by_lame_both_ways(actuator: HydrostaticActuator) -> None:
    """The wall for a stress has that stress; at 1e-4 of it the tube is thin: t = sqrt(3)/2 p r/sigma."""
    wall = least_wall(14.3e-3, 70e5, 60e6)
    inner = 14.3e-3 / 2
    assert wall_stress(inner, inner, inner + wall, 70e5).equivalent == pytest.approx(60e6)
    assert least_wall(14.3e-3, 6e3, 60e6) == pytest.approx(math.sqrt(3) / 2 * 6e3 * inner / 60e6, rel=1e-3)
    with pytest.raises(DesignError, match=r"rated_pressure must be below 5.774 MPa gauge"):
        least_wall(14.3e-3, 70e5, 10e6)
    steel = standard()["stainless steel 304"]
    assert steel.yield_stress is not None
    thick = replace(actuator.output_cylinder, wall_thickness=least_wall(14.3e-3, 70e5, steel.yield_stress / 3))
    assert burst_factor(thick, steel) == pytest.approx(3.0)
    with pytest.raises(DesignError, match=r"output_cylinder.material must have a yield stress; brass has none"):
        burst_factor(thick, standard()["brass"])


def test_rod_buckles_by_euler_when_slender(actuator: HydrostaticActuator) -> None:
    steel = standard()["stainless steel 304"]
    assert steel.young_modulus is not None
    inertia = math.pi / 64 * 6.35e-3**4
    euler = math.pi**2 * steel.young_modulus * inertia / (2 * 0.1524) ** 2
    assert rod_buckling_force(actuator.output_cylinder, steel) == pytest.approx(euler)


def test_warm_fluid_gives_off_what_it_takes(actuator: HydrostaticActuator) -> None:
    """More loss, more heat; none without loss; and a loss that cannot leave is told."""
    rise = [fluid_temperature(actuator, loss) - actuator.temperature for loss in (0.0, 2.0, 4.0)]
    assert rise[0] == 0.0
    assert 0 < rise[1] < rise[2] < 2 * rise[1]
    with pytest.raises(DesignError, match=r"losses in the fluid must be what cylinders and hose give off"):
        fluid_temperature(actuator, 1e4)


def test_line_and_fluid(actuator: HydrostaticActuator) -> None:
    """The column that the model leaves out is told: 0.46 kg at the piston, most of it in the hose."""
    assert line_pressure_drop(actuator, 0.44) == pytest.approx(-line_pressure_drop(actuator, -0.44))
    assert fluid_mass_at_piston(actuator) == pytest.approx(0.46, abs=0.01)
    assert actuator.fluid_volume == pytest.approx(56e-6, rel=0.02)
    assert total_mass(actuator) > distal_mass(actuator)


def test_bad_data_are_told(actuator: HydrostaticActuator) -> None:
    with pytest.raises(DesignError, match=r"actuator.motor.inertia is missing\."):
        replace(actuator.motor, inertia=None)  # type: ignore[arg-type]
    with pytest.raises(DesignError, match=r"actuator.input_cylinder.dead_volume must be finite and 0 or above; got -1"):
        replace(actuator.input_cylinder, dead_volume=-1e-6)
    with pytest.raises(DesignError, match=r"input_cylinder.stroke must displace .* 24.48 ml; got 16.06 ml\."):
        replace(actuator, input_cylinder=replace(actuator.input_cylinder, stroke=0.1))
    with pytest.raises(DesignError, match=r"actuator.output_cylinder.wall_thickness is missing"):
        burst_factor(replace(actuator.output_cylinder, wall_thickness=None), standard()["brass"])
    with pytest.raises(DesignError, match=r"actuator.ball_screw.efficiency must be above 0.5"):
        replace(actuator.ball_screw, efficiency=0.4)
    with pytest.raises(DesignError, match=r"actuator.friction.preload must be finite and 0 or above; got -1\."):
        CylinderFriction(-1.0, 0.0, 0.0, 0.0, 0.0)
    with pytest.raises(DesignError, match=r"actuator.motor.peak_torque must not be below"):
        replace(actuator.motor, peak_torque=0.1)
