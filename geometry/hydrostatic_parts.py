"""The hydraulic cylinders of an electro-hydrostatic actuator as turned parts, and what they weigh.

Tube, cap end with port and bleed screw, rod-end cap with the rod's bush and wiper and a vent, piston with its O-ring,
rod; `fluxbore.geometry.hydrostatic_layout` says where they stand. Both cylinders are drawn alike; the export shows the
output's, which is the one that is sized. Connector, hose and return element, which are not on the axis, are not drawn.
"""

from __future__ import annotations

from fluxbore.design.errors import DesignError
from fluxbore.design.hydrostatic_keys import CYLINDERS
from fluxbore.design.hydrostatic_values import HydrostaticDesign
from fluxbore.design.materials import Library
from fluxbore.design.return_spring_mass import least_mass
from fluxbore.design.units import format_quantity
from fluxbore.geometry import hydrostatic_caps, hydrostatic_mover
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.fits import fits
from fluxbore.geometry.hydrostatic_checks import checked
from fluxbore.geometry.hydrostatic_layout import LEAD_IN, CylinderLayout, layout
from fluxbore.geometry.hydrostatic_measures import gland_detail, measures
from fluxbore.geometry.mass import part_masses, total
from fluxbore.geometry.part import Colour, Part

OUTPUT = "output_cylinder"

SLACK = 1e-9
"""m; rounding allowed where a position is compared with the ends of the stroke."""

TUBE: Colour = (0.80, 0.66, 0.34)


def assembly(design: HydrostaticDesign, position: float, cylinder: str = OUTPUT) -> Assembly:
    """One cylinder with its piston at a position (m) from the cap end.

    Raises DesignError where the parts do not fit one another or the position is beyond the stroke.
    """
    place, shape = checked(layout(design, cylinder)), design.shapes[cylinder]
    if not -SLACK <= position <= place.stroke + SLACK:
        raise DesignError(
            f"The position must lie within the stroke, 0 mm to {format_quantity(place.stroke, 'length', 6)}; "
            f"got {format_quantity(position, 'length', 6)}."
        )
    return Assembly(
        design.name,
        (
            _tube(place, shape.material),
            hydrostatic_caps.cap_end(place, shape.material),
            hydrostatic_caps.bleed_screw(place),
            *hydrostatic_caps.rod_end(place, shape.material),
            hydrostatic_mover.piston(place, shape.rod, position),
            hydrostatic_mover.ring(place, position),
            hydrostatic_mover.rod(place, shape.rod, position),
        ),
        position,
        measures=measures(place, position),
        details=(gland_detail(place, position),),
    )


def _tube(place: CylinderLayout, material: str) -> Part:
    """With a lead-in for the O-ring at both ends, since it may be turned around."""
    (low, high), inner, outer = place.tube, place.r_bore, place.r_outside
    wide, long = inner + place.lead_in, LEAD_IN * place.lead_in
    profile = ((wide, low), (outer, low), (outer, high), (wide, high), (inner, high - long), (inner, low + long))
    sizes = fits(("bore", 2 * inner, "H8"))
    return Part("cylinder tube", "cylinder", "stator", material, TUBE, profile, fits=sizes)


def masses(design: HydrostaticDesign, library: Library) -> dict[str, float]:
    """Every mass (kg) that `design` leaves to its parts as drawn, by its name: what `design.weighed` takes.

    moving_mass : piston, O-ring and rod. mass : of the whole cylinder, these with it. return_spring.mass : of the
    lightest spring or cord that does it. Raises DesignError where a cylinder that is to be weighed does not fit.
    """
    found: dict[str, float] = {}
    for name in CYLINDERS:
        wanted = [leaf for leaf in ("moving_mass", "mass") if f"{name}.{leaf}" in design.unweighed]
        if wanted:
            rows = part_masses(assembly(design, 0.0, name), library)
            drawn = {"moving_mass": total(rows, "mover"), "mass": total(rows)}
            found.update({f"{name}.{leaf}": drawn[leaf] for leaf in wanted})
    if "return_spring.mass" in design.unweighed:
        found["return_spring.mass"] = least_mass(design.bare.return_element, design.bare.output_cylinder.stroke)
    return found
