"""One step of the electro-hydrostatic drive: the implicit midpoint rule, solved by Newton's method along the chain.

With the means of a step marked by a bar, v = (v_0 + v_1)/2 and so on, the equations of `hydrostatic_network` are

    2 M_1/h (v - v_0)      = F_m - A_1 p_1 - f_1(v, p_1),      F_m = K_p (v_w - v) + K_i z,  z' = v_w - v
    n_j(p_j, V_j) - n_j0   = h/2 (q_{j-1} - q_j),              drop_j(q_j) = e(p_j) - e(p_{j+1})
    2 M_2/h (v - v_0)      = A_2 p_3 - F_ret(x) - f_2(v, p_3)

In each iteration the three pressures follow from both velocities by a tridiagonal system, the velocities by two
equations v + g f(v) = c with each seal's friction in full, stiff or not. f falls where sliding starts, by less than 1/g
for any step below 0.5 ms, so that each has one solution.

Power is effort times flow of the means, which gains kinetic energy, springs of straight characteristic, and, to the
third order of the step, the fluid what the ports give them: the rule itself loses nothing. Stiff modes (a pressure
difference across a short hose, a piston that sticks) are followed in the means; at the ends of steps velocities ring
around them, by what a newton does to the mass in half a step, and die down.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from fluxbore.design.cylinder_friction import CylinderFriction
from fluxbore.design.dynamics.hydrostatic_network import Network
from fluxbore.design.errors import DesignError
from fluxbore.design.fluid import Fluid
from fluxbore.design.units import STANDARD_ATMOSPHERE

SETTLED, SMALL_SPEED = 1e-9, 1e-7
"""Last corrections of a piston's speed: a share of the linear piece's, and m/s, whose square is what is left."""

FAR = 40.0
"""c |v| beyond which the Stribeck force is nothing."""

ITERATIONS = 25
SMALL_PRESSURE, SMALL_FLOW = 300.0, 1e-7
"""Pa and m^3/s: Newton's last corrections, whose squares are what is left: 0.2 Pa at the least absolute pressures, and
0.1 Pa of a drop of some thousands."""

SMALL_FORCE = 1e-4
"""N, by which one piston's equation may be off by what the other's velocity changed at last."""

TENSION = -0.5 * STANDARD_ATMOSPHERE
"""Pa gauge; below it the straight line through the last two pressures is no place to begin."""

TABLE, REACH = 2048, 1.5
"""Places at which the links' drops are kept, up to this many times the flow at the motor's largest speed."""


@dataclass(slots=True)
class Motion:
    """The state at a step's end: speeds and ways of both pistons, z, contents of the three volumes.

    mean : of the step before it: pressures of the three volumes, flows of both links, both pistons' speeds. earlier :
    of the one before that; both tell where Newton's method begins. friction_1, friction_2, force : means too (N).
    """

    first: float
    second: float
    way_1: float
    way_2: float
    integral: float
    content: tuple[float, float, float]
    mean: tuple[float, ...]
    earlier: tuple[float, ...]
    friction_1: float = 0.0
    friction_2: float = 0.0
    force: float = 0.0


@dataclass(frozen=True, slots=True)
class Loop:
    """The velocity loop at the input piston: K_p (N s/m), K_i (N/m), and the motor's largest force (N)."""

    gain: float
    integral_gain: float
    limit: float


def tables(network: Network) -> tuple[list[list[float]], float]:
    """Drops (Pa) of the links at flows k/places (m^3/s), k = 0, 1, ..., and places; drops are odd in the flow.

    Straight lines between are within 0.01 Pa; beyond the last place its line goes on.
    """
    actuator = network.actuator
    largest = REACH * actuator.input_cylinder.area * actuator.maximum_velocity
    flows = [largest * k / (TABLE - 1) for k in range(TABLE)]
    found = {
        link: [link.resistance(q, network.rho, network.mu) * q for q in flows] for link in dict.fromkeys(network.links)
    }
    return [found[link] for link in network.links], (TABLE - 1) / largest


def stepper(network: Network, loop: Loop, step: float) -> Callable[[Motion, float], None]:
    """A function that moves a `Motion` on by one step (s) with a wanted velocity (m/s).

    Written out in floats, a for the input chamber, m for hose and block, b for the output chamber: the loop closes over
    friction, and small arrays would cost several times as much. Raises DesignError where the chain has no solution that
    Newton's method finds, or the fluid would have to bear tension.
    """
    actuator, half = network.actuator, step / 2
    first, second = actuator.input_cylinder, actuator.output_cylinder
    law_1, law_2, area_1, area_2 = first.friction, second.friction, first.area, second.area
    preload_1, pressed_1 = law_1.preload, law_1.pressure_coefficient
    preload_2, pressed_2 = law_2.preload, law_2.pressure_coefficient
    efficiency = actuator.ball_screw.efficiency
    driving, driven = (1 / efficiency - 1) * area_1, (1 - efficiency) * area_1
    mass_1, mass_2 = actuator.reflected_mass / half, second.moving_mass / half
    sweep_1, sweep_2 = half * area_1, half * area_2
    (empty_a, volume_m, empty_b), wall = network.volumes.tolist(), float(network.wall[1])
    (drops_1, drops_2), places = tables(network)
    top = len(drops_1) - 2
    state = _equation_of_state(network.fluid)
    slide_1, slide_2 = sliding(law_1), sliding(law_2)
    return_force, return_stiffness = network.return_force, network.return_stiffness
    k_p, k_i, limit = loop.gain, loop.integral_gain, loop.limit

    def advance(motion: Motion, wanted: float) -> None:
        p_a, p_m, p_b, q_1, q_2, v_1, v_2 = motion.mean
        then_a, then_m, then_b, then_1, then_2, slow_1, slow_2 = motion.earlier
        p_a, p_m, p_b = 2 * p_a - then_a, 2 * p_m - then_m, 2 * p_b - then_b
        q_1, q_2, v_1, v_2 = 2 * q_1 - then_1, 2 * q_2 - then_2, 2 * v_1 - slow_1, 2 * v_2 - slow_2
        if p_a < TENSION or p_m < TENSION or p_b < TENSION:
            p_a, p_m, p_b = motion.mean[:3]
        n_a, n_m, n_b = motion.content
        motor, limited = 0.0, False
        for _ in range(ITERATIONS):
            s_a, e_a, give_a = state(p_a)
            s_m, e_m, give_m = state(p_m)
            s_b, e_b, give_b = state(p_b)
            volume_a = empty_a - area_1 * (motion.way_1 + half * v_1)
            volume_b = empty_b + area_2 * (motion.way_2 + half * v_2)
            wide = 1 + p_m * wall
            # Links, straight about these flows.
            begun_1, begun_2 = q_1, q_2
            place = abs(q_1) * places
            k = min(int(place), top)
            rise = drops_1[k + 1] - drops_1[k]
            drop = drops_1[k] + (place - k) * rise
            slope_1 = half / (rise * places)
            q_1 += (e_a - e_m - (drop if q_1 >= 0 else -drop)) * slope_1 / half
            place = abs(q_2) * places
            k = min(int(place), top)
            rise = drops_2[k + 1] - drops_2[k]
            drop = drops_2[k] + (place - k) * rise
            slope_2 = half / (rise * places)
            q_2 += (e_m - e_b - (drop if q_2 >= 0 else -drop)) * slope_2 / half
            # Contents: by what the pressures must change, and by what more if the pistons move otherwise.
            across_a, across_1 = s_a * slope_1, s_m * slope_1
            across_b, across_2 = s_b * slope_2, s_m * slope_2
            stiff_a = 1 / (volume_a * give_a / s_a + across_a)
            stiff_b = 1 / (volume_b * give_b / s_b + across_b)
            more_a, more_b = sweep_1 / s_a * stiff_a, sweep_2 / s_b * stiff_b
            part_a = (n_a - volume_a / s_a - half * q_1) * stiff_a
            part_b = (n_b - volume_b / s_b + half * q_2) * stiff_b
            stiff_m = 1 / (
                volume_m / s_m * (wall + wide * give_m)
                + across_1 * (1 - across_a * stiff_a)
                + across_2 * (1 - across_b * stiff_b)
            )
            part_m = n_m - volume_m * wide / s_m + half * (q_1 - q_2) + across_a * part_a + across_b * part_b
            part_m *= stiff_m
            by_1, by_2 = across_a * more_a * stiff_m, -across_b * more_b * stiff_m
            part_a += across_1 * stiff_a * part_m
            part_b += across_2 * stiff_b * part_m
            a_1, a_2 = more_a + across_1 * stiff_a * by_1, across_1 * stiff_a * by_2
            b_1, b_2 = across_2 * stiff_b * by_1, across_2 * stiff_b * by_2 - more_b
            # Pistons: inertia_j v_j + cross_j v_other = push_j - f_j(v_j).
            way = motion.way_2 + half * v_2
            rate = half * return_stiffness(way)
            inertia_1, inertia_2 = mass_1 + area_1 * a_1, mass_2 - area_2 * b_2 + rate
            cross_1, cross_2 = area_1 * a_2, -area_2 * b_1
            push_1 = mass_1 * motion.first - area_1 * (p_a + part_a - a_1 * v_1 - a_2 * v_2)
            push_2 = mass_2 * motion.second + area_2 * (p_b + part_b - b_1 * v_1 - b_2 * v_2)
            push_2 += rate * v_2 - return_force(way)
            if limited:
                push_1 += motor
            else:
                inertia_1 += k_p + k_i * half
                push_1 += k_p * wanted + k_i * (motion.integral + half * wanted)
            load = p_a if p_a > 0 else 0.0
            level_1, level_2 = preload_1 + pressed_1 * load, preload_2 + pressed_2 * (p_b if p_b > 0 else 0.0)
            guess = v_2
            for _ in range(3):
                reach = (push_1 - cross_1 * guess) / inertia_1
                screw = (driving if reach >= 0 else driven) * load
                new_1, force_1 = slide_1(level_1 + screw, reach, 1 / inertia_1)
                new_2, force_2 = slide_2(level_2, (push_2 - cross_2 * new_1) / inertia_2, 1 / inertia_2)
                apart, guess = abs(cross_1 * (new_2 - guess)), new_2
                if apart < SMALL_FORCE:
                    break
            change_1, change_2 = new_1 - v_1, new_2 - v_2
            v_1, v_2 = new_1, new_2
            if not limited:
                motor = k_p * (wanted - v_1) + k_i * (motion.integral + half * (wanted - v_1))
                if abs(motor) > limit:
                    motor, limited = math.copysign(limit, motor), True
                    q_1, q_2 = begun_1, begun_2
                    continue
            change_a = part_a + a_1 * change_1 + a_2 * change_2
            change_m = part_m + by_1 * change_1 + by_2 * change_2
            change_b = part_b + b_1 * change_1 + b_2 * change_2
            p_a, p_m, p_b = p_a + change_a, p_m + change_m, p_b + change_b
            q_1 += (s_a * change_a - s_m * change_m) * slope_1 / half
            q_2 += (s_m * change_m - s_b * change_b) * slope_2 / half
            if (
                abs(q_1 - begun_1) < SMALL_FLOW
                and abs(q_2 - begun_2) < SMALL_FLOW
                and max(abs(change_a), abs(change_m), abs(change_b)) < SMALL_PRESSURE
            ):
                break
        else:
            raise DesignError(
                "The fluid's column has no state for a step to end in: the volumes of actuator.hose and of the "
                "cylinders must be larger, or the simulation's step smaller."
            )
        motion.content = n_a - step * q_1, n_m + step * (q_1 - q_2), n_b + step * q_2
        if not limited:
            motion.integral += step * (wanted - v_1)
        motion.way_1 += step * v_1
        motion.way_2 += step * v_2
        motion.first, motion.second = 2 * v_1 - motion.first, 2 * v_2 - motion.second
        motion.earlier, motion.mean = motion.mean, (p_a, p_m, p_b, q_1, q_2, v_1, v_2)
        motion.friction_1, motion.friction_2, motion.force = force_1, force_2, motor

    return advance


def _equation_of_state(fluid: Fluid) -> Callable[[float], tuple[float, float, float]]:
    """s, e and 1/beta at a gauge pressure (Pa): `fluid.state_of` in floats."""
    share, m, modulus, n = fluid.air_fraction, fluid.modulus_rise, fluid.bulk_modulus, fluid.air_exponent
    rest, power_l, power_g, rising = 1 - share, -1 / m, -1 / n, m / modulus
    energy_l, gas_modulus, isothermal = modulus / (m - 1), n * STANDARD_ATMOSPHERE, n == 1
    energy_g = STANDARD_ATMOSPHERE * (1.0 if isothermal else n / (n - 1))

    def state(pressure: float) -> tuple[float, float, float]:
        base, absolute = 1 + rising * pressure, 1 + pressure / STANDARD_ATMOSPHERE
        if absolute <= 0:
            raise DesignError(
                "The pressure of the fluid must stay above a vacuum; the column is torn apart, and the force of "
                "actuator.return_spring at rest must be larger."
            )
        liquid, gas = rest * base**power_l, share * absolute**power_g
        light = share * math.log(absolute) if isothermal else absolute * gas - share
        ratio = liquid + gas
        give = (liquid / (modulus * base) + gas / (gas_modulus * absolute)) / ratio
        return ratio, energy_l * (base * liquid - rest) + energy_g * light, give

    return state


def sliding(law: CylinderFriction) -> Callable[[float, float, float], tuple[float, float]]:
    """A function that gives the velocity v (m/s) and the friction f (N) with v + yielding f(v) = wanted, of the Coulomb
    level in this direction (N), the wanted velocity (m/s), and yielding (m/(N s)), above zero."""
    v_0, stribeck, decay = law.linear_speed, law.stribeck_force, law.stribeck_decay
    viscous = law.viscous_coefficient
    begun = stribeck * math.exp(-decay * v_0)
    settled, exp = SETTLED * v_0, math.exp

    def slide(coulomb: float, wanted: float, yielding: float) -> tuple[float, float]:
        size = abs(wanted)
        level = coulomb + begun
        if size <= v_0 + yielding * (level + viscous * v_0):
            v = size / (1 + yielding * (level / v_0 + viscous))
            for _ in range(20):  # the Stribeck force changes by a hundredth over the linear piece
                before = v
                v = size / (1 + yielding * ((coulomb + stribeck * exp(-decay * v)) / v_0 + viscous))
                if abs(v - before) <= settled:
                    break
        else:
            v = max((size - yielding * coulomb) / (1 + yielding * viscous), v_0)
            for _ in range(20):
                fading = stribeck * exp(-decay * v) if decay * v < FAR else 0.0
                surplus = v - size + yielding * (coulomb + fading + viscous * v)
                change = surplus / (1 + yielding * (viscous - decay * fading))
                v -= change
                if abs(change) <= SMALL_SPEED:
                    break
        force = (size - v) / yielding
        return (v, force) if wanted >= 0 else (-v, -force)

    return slide
