"""The figures of the piston's seal: from a specification to friction, contact, fit, leakage and wear of its fins.

`lip_of` and `friction_law` serve simulations too: for a fin that nobody has measured, the contact force without
pressure is that of its own lips.
"""

from __future__ import annotations

import math

from fluxbore.design import friction, lip, seal, seal_leakage
from fluxbore.design.errors import DesignError
from fluxbore.design.fin_fit import Fit, interferences
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.lip import Lip, Response
from fluxbore.design.materials import Material, lookup
from fluxbore.design.spec import Spec
from fluxbore.design.units import format_quantity

FINS = 2
"""One on each piston; pressure presses one of them."""

UNPRESSED = 1e-3
"""Pa; a smaller pressure is none, against which there is no margin."""


def lip_of(spec: Spec) -> Lip | None:
    """The fin's lip in its bore; None where the modulus or Poisson's ratio of its material is not known."""
    actuator: HybridActuator = spec.actuator
    material = _lip_material(spec)
    modulus = _modulus(spec)
    if modulus is None or material.poisson_ratio is None:
        return None
    fin = actuator.piston
    return Lip(
        actuator.cylinder.inner_diameter,
        fin.fin_outer_diameter,
        fin.fin_inner_diameter,
        fin.fin_length,
        fin.fin_thickness,
        modulus,
        material.poisson_ratio,
    )


def contact_force(spec: Spec) -> float | None:
    """F_0 (N) of equation (6): the measured one where the specification gives it, else guide and lips at the drawn
    interference; None where the lip's material does not tell."""
    if "actuator.seal.contact_force" in spec.values:
        return spec.number("actuator.seal.contact_force")
    found = lip_of(spec)
    if found is None:
        return None
    lips = FINS * lip.response(found).contact_force(seal.interference(spec.actuator), 0.0)
    return spec.number("actuator.seal.guide_force") + lips


def friction_law(spec: Spec) -> friction.SealFriction:
    """Equation (6) for the specification's fin.

    Raises DesignError where its contact force is neither given nor known from the lip's material.
    """
    force = contact_force(spec)
    if force is None:
        raise DesignError(
            "actuator.seal.contact_force must be given where the material of the fin's lip, "
            f'"{_lip_material(spec).name}", states no young_modulus or no poisson_ratio; got none.'
        )
    return _law(spec, force)


def figures(spec: Spec, actuator: HybridActuator) -> dict[str, float | None]:
    """The figures of the group "Seal", by name. A datum that a material lacks leaves its figures None.

    Closed forms, smooth in the specification's values but for `lip_stress` where one place gives way to another; about
    a millisecond.
    """
    pressure, speed = (spec.number(f"operating_point.{name}") for name in ("pressure", "speed"))
    area = seal.contact_area(actuator)
    force = contact_force(spec)
    found: dict[str, float | None] = {
        "fin_deformed_length": seal.deformed_length(actuator),
        "fin_contact_area": area,
        "fin_angle": seal.angle(actuator),
        "fin_wall": actuator.piston.fin_thickness,
    }
    if force is not None:
        law = _law(spec, force)
        sliding = friction.kinetic_friction(law, area, pressure, speed)
        found["seal_friction"] = sliding
        found["seal_friction_variation"] = sliding - friction.kinetic_friction(law, area, 0.0, speed)
    fit = _fit(spec, actuator)
    if fit is not None:
        found["fin_interference"], found["largest_interference"] = fit
    wall = lip_of(spec)
    if wall is not None:
        found |= _contact(spec, wall, seal.interference(actuator), fit, area, pressure)
    return found


def warnings(spec: Spec) -> tuple[str, ...]:
    """Where the lip leaves the range of its formulas, or its seal is none at the worst of its fit."""
    wall = lip_of(spec)
    if wall is None:
        return ()
    found = []
    if not lip.in_range(wall):
        found.append(
            f"The seal fin is beyond the formulas of its lip, which hold below a wall of {lip.THICKEST:g} radii and "
            f"{format_quantity(lip.STEEPEST, 'angle', 3)} of cone; it has {wall.thickness / wall.radius:.3g} and "
            f"{format_quantity(wall.angle, 'angle', 3)}."
        )
    pressure = spec.number("operating_point.pressure")
    fit = _fit(spec, spec.actuator)
    interference = fit[1] if fit is not None else seal.interference(spec.actuator)
    response = lip.response(wall)
    if response.touches(interference, pressure):
        found.append(
            "At operating_point.pressure the seal fin bulges against the bore behind its tip; its contact force is a "
            "lower bound and its stress an upper one."
        )
    if fit is not None:
        found += _loose(response, fit[0], seal.contact_area(spec.actuator), pressure)
    return tuple(found)


def _loose(response: Response, least: float, area: float, pressure: float) -> list[str]:
    """A seal that opens, at its least interference (m)."""
    found = []
    if least <= 0:
        found.append(
            "At the worst of tolerances and temperatures the seal fin does not touch the bore without pressure: "
            f"fin_interference is {format_quantity(least, 'length', 3)}, and seal_life is none."
        )
    margin = response.contact_force(least, pressure) / area / pressure if pressure > UNPRESSED else math.inf
    if margin < 1:
        found.append(
            f"At its least interference the seal fin presses with {margin:.3g} of operating_point.pressure, and air "
            "lifts it; air_leakage is that of a lip which stays down."
        )
    return found


def _contact(
    spec: Spec, wall: Lip, drawn: float, fit: tuple[float, float] | None, area: float, pressure: float
) -> dict[str, float | None]:
    """What one lip does at a pressure: drawn is its interference (m), fit the least and the largest."""
    response = lip.response(wall)
    pressed = response.contact_force(drawn, pressure) / area
    wear = seal_leakage.wear_rate(spec.number("actuator.seal.specific_wear"), pressed)
    found: dict[str, float | None] = {
        "lip_contact_force": pressed * area,
        "lip_contact_pressure": pressed,
        "seal_wear": wear,
    }
    if fit is None:
        return found
    least = response.contact_force(fit[0], pressure) / area
    stress, strength = response.worst_stress(fit, pressure), _lip_material(spec).yield_stress
    found |= {
        "sealing_margin": least / pressure if pressure > UNPRESSED else None,
        "lip_stress": stress,
        "lip_safety": strength / stress if strength is not None else None,
        "seal_life": fit[0] / wear,
    }
    if least > 0:
        opening = seal_leakage.gap(
            spec.number("actuator.seal.roughness"),
            spec.number("actuator.seal.roughness_wavelength"),
            least,
            wall.young_modulus,
            wall.poisson_ratio,
        )
        found["air_leakage"] = seal_leakage.leakage(wall.bore, area / seal.band_area(wall.bore, 1.0), opening, pressure)
    return found


def _fit(spec: Spec, actuator: HybridActuator) -> tuple[float, float] | None:
    """The least and the largest interference (m); None where an expansion is not known."""
    fin = _lip_material(spec).thermal_expansion
    key = "actuator.cylinder.material"
    bore = lookup(spec.word(key), key, spec.materials, Material).thermal_expansion
    if fin is None or bore is None:
        return None
    coldest, hottest = (spec.number(f"operating_point.{name}_temperature") for name in ("coldest", "hottest"))
    return interferences(
        Fit(actuator.piston.fin_outer_diameter, spec.number("actuator.piston.fin_tolerance"), fin),
        Fit(actuator.cylinder.inner_diameter, spec.number("actuator.cylinder.bore_tolerance"), bore),
        coldest,
        hottest,
    )


def _lip_material(spec: Spec) -> Material:
    key = "actuator.piston.fin_material"
    return lookup(spec.word(key), key, spec.materials, Material)


def _modulus(spec: Spec) -> float | None:
    key = "actuator.piston.fin_modulus"
    return spec.number(key) if key in spec.values else _lip_material(spec).young_modulus


def _law(spec: Spec, force: float) -> friction.SealFriction:
    static, coulomb, speed, viscous = (
        spec.number(f"actuator.seal.{name}")
        for name in ("static_coefficient", "coulomb_coefficient", "stribeck_speed", "viscous_coefficient")
    )
    return friction.SealFriction(static, coulomb, force, speed, viscous)
