"""What a magnetic lead screw is as a spring, a gear and a mass, from its parameters and its force over displacement.

Equations (1) to (6) and (14) of the RotLin paper, where it has them; the rest follows from energy and from Newton's
law for the two-mass system (4), (5). Friction, hysteresis and eddy currents are left out.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluxbore.design.errors import DesignError
from fluxbore.design.force_series import ForceSeries
from fluxbore.design.helical_field import ROTOR, TRANSLATOR, harmonics, pattern, stack
from fluxbore.design.lead_screw import HelicalMagnets, LeadScrew
from fluxbore.design.radial_stack import solve

Floats = NDArray[np.float64]

FIELD_SAMPLES = 181
"""Of zeta over a quarter of a period, where the flux along the iron is read."""


def transfer_ratio(screw: LeadScrew) -> float:
    """1/h (rad/m): 2 pi over the lead, by (3) of one start; turns of the rotor per way of the mover, times 2 pi."""
    return 1 / screw.h


def torque(screw: LeadScrew, series: ForceSeries, displacement: ArrayLike) -> Floats:
    """T_s = h F_s (N m), that the spring holds against the motor at a displacement x_d (m); equation (6)."""
    return screw.h * series.force(displacement)


def sinusoidal_spring_constant(stall_force: float, pitch: float) -> float:
    """dF/dx_d (N/m) at rest of (14), F_stall sin(2 pi x_d/l_p): what (1) linearises. Stall force in N, pitch in m."""
    return 2 * math.pi * stall_force / pitch


def spring_constant(series: ForceSeries) -> float:
    """K_s (N/m) of (1) at rest, with all harmonics."""
    return float(series.stiffness(0.0))


def sudden_load_limit(series: ForceSeries) -> float:
    """The load (N) that, put on at once with the rotor held, just does not slip the mover over the next pole.

    The mover overshoots to where load and spring have done equal work, F x = U(x); at the limit that is where it
    stands still on the far slope, F = F_s(x). A sinusoidal spring bears 0.7246 of its stall force so.
    """
    top, half = series.peak[0], series.pitch / 2
    low, high = top, half
    # Beyond the peak U(x) - x F_s(x) rises from below zero to U(l_p/2) > 0.
    while (middle := (low + high) / 2) not in (low, high):
        short = float(series.energy(middle)) < middle * float(series.force(middle))
        low, high = (middle, high) if short else (low, middle)
    return float(series.energy(high)) / high


def slip_work(series: ForceSeries, load: float) -> float:
    """What a load (N) puts into the mover (J) at each slip by one pitch: nothing is stored, all is to be braked."""
    return load * series.pitch


def back_driving_force(screw: LeadScrew, friction_torque: float) -> float:
    """Load (N) that turns the rotor against a torque of friction or cogging (N m): T/h."""
    return friction_torque / screw.h


def back_drivable(screw: LeadScrew, series: ForceSeries, friction_torque: float) -> bool:
    """Whether the load turns the rotor before the screw slips: T/h below the stall force."""
    return back_driving_force(screw, friction_torque) < series.peak[1]


def engaged_length(screw: LeadScrew, position: ArrayLike) -> Floats:
    """Overlap (m) of the members' magnets, the rotor's middle being `position` (m) from the translator's."""
    apart = np.abs(np.asarray(position, dtype=np.float64))
    overlap = (screw.translator_length + screw.active_length) / 2 - apart
    return np.clip(overlap, 0.0, screw.active_length)


def engaged_fraction(screw: LeadScrew, position: ArrayLike) -> Floats:
    """Share of the stall force and of the spring constant that is left at a position (m): overlap over active length.

    Linear, since each pole pulls for itself; the fringes at the ends, of a pole or so, are left out.
    """
    return engaged_length(screw, position) / screw.active_length


def full_engagement(screw: LeadScrew) -> float:
    """How far (m) the rotor's middle may be from the translator's, to either side, with all its poles engaged."""
    return (screw.translator_length - screw.active_length) / 2


def rotor_mass(screw: LeadScrew) -> float:
    """kg, of magnets, back iron and frame, the frame as a solid ring from the iron to its outside."""
    return sum(mass for mass, _ in _rotor_rings(screw))


def rotor_inertia(screw: LeadScrew) -> float:
    """J (kg m^2) of the same about the axis: a motor's magnets count through the frame's density."""
    return sum(inertia for _, inertia in _rotor_rings(screw))


def mover_mass(screw: LeadScrew) -> float:
    """M (kg): the rotor and whatever it carries along the axis."""
    return rotor_mass(screw) + screw.carried_mass


def translator_magnet_mass(screw: LeadScrew) -> float:
    """kg, of the translator's magnets over all its length."""
    inner, outer, _, _ = screw.radii
    return _magnet_ring(screw, screw.translator, inner, outer, screw.translator_length)[0]


def rotor_magnet_mass(screw: LeadScrew) -> float:
    """kg, of the rotor's magnets."""
    _, _, bore, magnets = screw.radii
    return _magnet_ring(screw, screw.rotor, bore, magnets, screw.active_length)[0]


def translator_mass(screw: LeadScrew, carrier_radius: float, carrier_density: float) -> float:
    """kg, of the translator's magnets, back iron and carrier, which is a ring from `carrier_radius` (m) outwards."""
    inner = screw.radii[0]
    iron = inner - screw.translator.iron_thickness
    length = screw.translator_length
    return (
        translator_magnet_mass(screw)
        + _ring(iron, inner, length, screw.translator.iron_density)[0]
        + _ring(carrier_radius, iron, length, carrier_density)[0]
    )


def reflected_mass(screw: LeadScrew, inertia: float) -> float:
    """kg that the rotor's inertia (kg m^2) is to a load: J/h^2."""
    return inertia / screw.h**2


def reflected_inertia(screw: LeadScrew, mass: float) -> float:
    """kg m^2 that the mover's mass (kg) is to the motor: M h^2."""
    return mass * screw.h**2


def natural_frequency(stiffness: float, mass: float, reflected: float | None = None) -> float:
    """Hz, of the mover (kg) on the spring (N/m): the rotor held, or free with its inertia as `reflected` mass (kg)."""
    compliance = 1 / mass + (0.0 if reflected is None else 1 / reflected)
    return math.sqrt(stiffness * compliance) / (2 * math.pi)


def largest_acceleration(stall_force: float, mass: float, load: float = 0.0) -> float:
    """m/s^2 that the motor can give the mover (kg) against a load (N) before the screw slips.

    Raises DesignError for a load that alone is beyond the stall force (N).
    """
    if load > stall_force:
        raise DesignError(f"A load must be at most the stall force {stall_force:g} N; got {load:g} N.")
    return (stall_force - load) / mass


def back_iron_flux_density(screw: LeadScrew) -> tuple[float | None, float | None]:
    """Largest mean flux density (T) along the translator's and the rotor's back iron; None where there is none.

    At rest, x_d = 0, where both members' fluxes add: what enters over a quarter of a period runs across the helix in
    the iron's section. Of infinitely permeable iron; beyond 1.5 T or so it would saturate and the force fall short.
    A magnet's own flux behind it does not fall off with n as what crosses the gap: with the harmonics up to n = 199 it
    is 0.2 % short.
    """
    wave, order = harmonics(screw, across=False)
    field = solve(stack(screw), wave, order)
    flux = sum(
        pattern(screw, member, len(wave))[:, None] * field.flux(layer)
        for layer, member in ((TRANSLATOR, screw.translator), (ROTOR, screw.rotor))
    )
    zeta = np.linspace(0.0, screw.pitch / 4, FIELD_SAMPLES)
    passed = np.max(np.abs(np.sin(zeta[:, None] * wave) @ (np.asarray(flux) / wave[:, None])), axis=0)
    inner, outer = screw.radii[0], screw.radii[-1]
    inside = (inner - screw.translator.iron_thickness, inner)
    outside = (outer, outer + screw.rotor.iron_thickness)
    return along_iron(screw, float(passed[0]), *inside), along_iron(screw, float(passed[1]), *outside)


def along_iron(screw: LeadScrew, passed: float, inner: float, outer: float) -> float | None:
    """T, of a flux per angle (T m^2) in a ring of iron: across a helix the way is shorter than along the axis."""
    if outer <= inner:
        return None
    slant = math.hypot(1.0, 2 * screw.h / (inner + outer))
    return 2 * passed / ((outer**2 - inner**2) * slant)


def _rotor_rings(screw: LeadScrew) -> list[tuple[float, float]]:
    _, _, bore, magnets = screw.radii
    iron = screw.rotor_iron_radius
    return [
        _magnet_ring(screw, screw.rotor, bore, magnets, screw.active_length),
        _ring(magnets, iron, screw.active_length, screw.rotor.iron_density),
        _ring(iron, screw.frame_radius, screw.frame_length, screw.frame_density),
    ]


def _magnet_ring(
    screw: LeadScrew, member: HelicalMagnets, inner: float, outer: float, length: float
) -> tuple[float, float]:
    share = 2 * member.magnet_width / screw.pitch * (member.arcs.fill if member.arcs is not None else 1.0)
    return _ring(inner, outer, length, share * member.magnet_density)


def _ring(inner: float, outer: float, length: float, density: float) -> tuple[float, float]:
    """Mass (kg) and moment of inertia about the axis (kg m^2) of a hollow cylinder."""
    mass = density * math.pi * (outer**2 - inner**2) * length
    return mass, mass * (inner**2 + outer**2) / 2
