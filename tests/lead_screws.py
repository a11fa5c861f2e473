"""The lead screw of the RotLin paper for tests of several rooms: Table I, and what it leaves open."""

import math
from dataclasses import replace

from fluxbore.design.lead_screw import Arcs, HelicalMagnets, LeadScrew

PITCH = 36e-3 / 7  # 5.1429 mm
MAGNETS = HelicalMagnets(2.5e-3, PITCH / 2, 1.0, 1.05, iron_thickness=5e-3)
ARCS = Arcs(math.radians(60.0), 6, stepped=True)


def table_i(translator_iron: bool = True, rotor_iron: bool = True) -> LeadScrew:
    """Iron behind both is what the paper's analytic model has; its prototype has none behind the rotor's magnets.

    Remanence 1 T, touching magnets, recoil permeability and all lengths but the radii are not published.
    """
    return LeadScrew(
        pitch=PITCH,
        poles=4,
        translator_radius=17.45e-3,
        gap=0.8e-3,
        translator=replace(MAGNETS, iron_thickness=5e-3 if translator_iron else 0.0),
        rotor=replace(MAGNETS, iron_thickness=5e-3 if rotor_iron else 0.0),
        translator_length=85e-3,
        frame_radius=26.25e-3,
        frame_length=65e-3,
    )
