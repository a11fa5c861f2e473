"""The output cylinder of an electro-hydrostatic actuator as parts."""

from __future__ import annotations

from fluxbore.design.hydrostatic_values import HydrostaticDesign
from fluxbore.geometry.assembly import Assembly, Colour, Part, rectangle

BODY: Colour = (0.78, 0.63, 0.30)
STEEL: Colour = (0.62, 0.64, 0.67)


def assembly(design: HydrostaticDesign, position: float) -> Assembly:
    """The cylinder with its piston at a position (m) from its end."""
    cylinder, shape = design.bare.output_cylinder, design.shapes["output_cylinder"]
    bore, outer = cylinder.bore / 2, cylinder.bore / 2 + (cylinder.wall_thickness or 0.0)
    rod = (cylinder.rod_diameter or cylinder.bore) / 2
    length = cylinder.stroke + shape.piston_length
    back = position + shape.piston_length
    return Assembly(
        design.name,
        (
            Part("tube", "tube", "stator", shape.material, BODY, rectangle(bore, outer, 0.0, length)),
            Part("piston", "piston", "mover", shape.rod, STEEL, rectangle(0.0, bore, position, back)),
            Part("rod", "rod", "mover", shape.rod, STEEL, rectangle(0.0, rod, back, back + length)),
        ),
        position,
    )
