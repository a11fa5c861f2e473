"""The lead screw's figures that need no field, what follows from its force over displacement, and its warnings.

`common_figures` needs nothing but the specification. `complete` adds to it what a route's series and field gave, and
all that follows from them in closed form; both routes call it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from fluxbore.design.lead_screw import LeadScrew
from fluxbore.design.lead_screw_keys import MEMBERS
from fluxbore.design.lead_screw_values import LeadScrewActuator
from fluxbore.design.materials import Material, PermanentMagnet, lookup
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.design.units import format_quantity
from fluxbore.optimize import lead_screw_gaps

if TYPE_CHECKING:
    from fluxbore.design.force_series import ForceSeries

NOTABLE_FRACTION = 0.01
"""Of the magnets' volume; the field at the edges where poles meet takes a little of it in any design."""

SATURATED = 1.5
"""T along iron taken for ideal, from which its permeability would tell."""


def common_figures(spec: Spec, screw: LeadScrew) -> Performance:
    """Masses, inertia, size and the gear, of a screw with its materials.

    Raises MaterialError, and DesignError for a bearing that does not fit.
    """
    from fluxbore.design import lead_screw_figures as figures
    from fluxbore.geometry.lead_screw_fittings import fitting_masses

    actuator: LeadScrewActuator = spec.actuator
    held = fitting_masses(actuator, spec.materials)
    carrier = lookup(actuator.translator.body, "actuator.translator.carrier", spec.materials, Material)
    moving = figures.mover_mass(screw) + held.moving
    inertia = figures.rotor_inertia(screw) + actuator.motor_inertia + held.inertia
    load, acceleration, friction = (
        spec.number(f"operating_point.{name}") for name in ("load_force", "acceleration", "friction_torque")
    )
    torque = screw.h * (load + moving * acceleration) + inertia * acceleration / screw.h + friction
    radii = [
        held.diameter / 2,
        screw.frame_radius,
        *([] if actuator.motor_radius is None else [actuator.motor_radius]),
    ]
    lengths = [
        held.length,
        screw.translator_length,
        screw.frame_length,
        *([] if actuator.motor_length is None else [actuator.motor_length]),
    ]
    return Performance(
        slip_work=load * screw.pitch,
        transfer_ratio=figures.transfer_ratio(screw),
        motor_torque=torque,
        motor_current=None if actuator.torque_constant is None else torque / actuator.torque_constant,
        back_driving_force=figures.back_driving_force(screw, friction),
        rotor_inertia=inertia,
        reflected_mass=figures.reflected_mass(screw, inertia),
        magnet_mass=figures.translator_magnet_mass(screw) + figures.rotor_magnet_mass(screw),
        moving_mass=moving,
        total_mass=moving + figures.translator_mass(screw, actuator.carrier_radius, carrier.density) + held.fixed,
        outer_diameter=2 * max(radii),
        length=max(lengths),
    )


def complete(
    spec: Spec, screw: LeadScrew, series: ForceSeries, stall_force: float, field: Mapping[str, float | None]
) -> Performance:
    """All figures, from the force over the displacement and what else of the field a route has, by name.

    stall_force : N, the largest of the series, or what the field says at that place. Smooth in the specification's
    values, in the series and the stall force. Raises MaterialError.
    """
    from fluxbore.design import lead_screw_figures as figures

    actuator: LeadScrewActuator = spec.actuator
    common = common_figures(spec, screw)
    moving, load = common.moving_mass, spec.number("operating_point.load_force")
    assert moving is not None
    stiffness = figures.spring_constant(series)
    driven = load + moving * spec.number("operating_point.acceleration")
    first, second, third = series.amplitude[0], *_padded(series)
    return replace(
        common,
        stall_force=stall_force,
        stall_force_density=stall_force / _volume(actuator, screw),
        stall_torque=screw.h * stall_force,
        slip_margin=stall_force / driven if driven > 0 else None,
        sudden_load_limit=figures.sudden_load_limit(series),
        stroke_end_force=stall_force * float(figures.engaged_fraction(screw, actuator.stroke / 2)),
        force_ripple=_ripple(screw),
        spring_constant=stiffness,
        load_displacement=series.rest(load),
        spring_energy=series.barrier,
        natural_frequency=figures.natural_frequency(stiffness, moving) if stiffness > 0 else None,
        largest_acceleration=(stall_force - load) / moving,
        harmonic_ratio_2=float(second / first) if first else None,
        harmonic_ratio_3=float(third / first) if first else None,
        **field,
    )


def amplitudes(series: ForceSeries) -> dict[str, float]:
    """The series for the details: `force_amplitude_1` and so on by the order n (N), as far as they count."""
    least = 1e-9 * float(abs(series.amplitude).max())
    orders = series.orders or range(1, 2 * series.amplitude.size, 2)
    named = {n: float(value) for n, value in zip(orders, series.amplitude, strict=True) if abs(value) > least}
    return {f"force_amplitude_{n}": named[n] for n in sorted(named)}


def warnings(spec: Spec, performance: Performance, ideal_iron: bool) -> tuple[str, ...]:
    """What sound figures do not say by themselves: a load that slips, everywhere or at the ends of the stroke, magnets
    beyond their temperature or their coercivity, ideal iron that would saturate, figures that the study asks for and
    the data do not allow."""
    return (
        *_slipping(spec, performance),
        *_running_out(spec, performance),
        *_hot(spec),
        *_weakened(performance),
        *(_saturated(performance) if ideal_iron else ()),
        *lead_screw_gaps.gaps(spec, performance),
    )


def _padded(series: ForceSeries) -> tuple[float, float]:
    """F_3 and F_5 (N), zero where the gap lets none across. Odd orders come first."""
    second, third = (float(series.amplitude[i]) if i < series.amplitude.size else 0.0 for i in (1, 2))
    return second, third


def _volume(actuator: LeadScrewActuator, screw: LeadScrew) -> float:
    """m^3, to which the stall force is related."""
    if actuator.reference_volume is not None:
        return actuator.reference_volume
    return math.pi * screw.frame_radius**2 * screw.frame_length


def _ripple(screw: LeadScrew) -> float:
    """Peak to peak of the analytic force at its stall, over that force, with ideal iron in either route."""
    if screw.translator.arcs is None or screw.rotor.arcs is None:
        return 0.0
    from fluxbore.design.helical_field import force_series
    from fluxbore.design.step_ripple import force_ripple

    place, peak = force_series(screw).peak
    return force_ripple(screw, place) / peak


def _slipping(spec: Spec, performance: Performance) -> list[str]:
    if performance.slip_margin is None or performance.slip_margin > 1:
        return []
    load, stall = spec.number("operating_point.load_force"), performance.stall_force
    assert stall is not None
    return [
        "The screw slips: operating_point.load_force with the mover accelerated should stay below the stall force, "
        f"{format_quantity(stall, 'force', 4)}; the load alone is {format_quantity(load, 'force', 4)}."
    ]


def _running_out(spec: Spec, performance: Performance) -> list[str]:
    """Where the screw holds the load in the middle, and no more at the ends of its stroke."""
    load, stall, left = spec.number("operating_point.load_force"), performance.stall_force, performance.stroke_end_force
    if stall is None or left is None or not left < load <= stall:
        return []
    return [
        "The load slips at the ends of operating_point.stroke, where the poles run out of the translator: "
        f"{format_quantity(left, 'force', 4)} of the stall force is left; operating_point.load_force is "
        f"{format_quantity(load, 'force', 4)}."
    ]


def _hot(spec: Spec) -> list[str]:
    actuator: LeadScrewActuator = spec.actuator
    temperature, found = spec.number("operating_point.magnet_temperature"), {}
    for member, name in zip(MEMBERS, (actuator.translator.magnet, actuator.rotor.magnet), strict=True):
        grade = lookup(name, f"actuator.{member}.magnet", spec.materials, PermanentMagnet)
        if grade.working_temperature is not None and temperature > grade.working_temperature:
            found[grade.name] = grade.working_temperature
    return [
        f"operating_point.magnet_temperature should not exceed the working temperature of {name}, "
        f"{format_quantity(limit, 'temperature', 4)}; it is {format_quantity(temperature, 'temperature', 4)}."
        for name, limit in found.items()
    ]


def _weakened(performance: Performance) -> list[str]:
    fraction = performance.demagnetised_fraction
    if fraction is None or fraction <= NOTABLE_FRACTION:
        return []
    return [
        f"At this temperature {fraction:.1%} of the magnets' volume is beyond its intrinsic coercivity when the screw "
        "slips; the figures take it as still magnetised."
    ]


def _saturated(performance: Performance) -> list[str]:
    found = [
        f"the {member}'s {format_quantity(value, 'flux density', 3)}"
        for member in MEMBERS
        if (value := getattr(performance, f"{member}_iron_flux_density")) is not None and value > SATURATED
    ]
    if not found:
        return []
    return [
        f"Iron is taken for infinitely permeable, and would saturate beyond {SATURATED:g} T along it: "
        f"{' and '.join(found)}; by finite elements the force is lower."
    ]
