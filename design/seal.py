"""The piston's sealing fin pressed into the bore: how much of it bends, and over which area it touches.

Nakata and Noda (2023), equations (4) and (5) with Table III:

    dl = (D_f - D_c')/(D_f - d) sqrt(l^2 + ((D_f - d)/2)^2)      (4)
    s  = pi D_c' dl                                              (5)

(4) holds with the bore D_c' as drawn: the paper writes D_c, the cylinder's outside, which would give a negative
length. Table III's rounded inputs give dl = 0.412 mm where the paper prints 0.407 mm; the published s of 20.6 mm^2
follows from the published dl, and 20.9 mm^2 from the inputs.

The fin's cone angle is taken as unchanged, and only its tip, what stands over the bore, as bent along the wall. Valid
for D_f > D_c' > d and l > 0, which `HybridActuator.check` sees to.
"""

from __future__ import annotations

import math

from fluxbore.design.hybrid import HybridActuator


def deformed_length(actuator: HybridActuator) -> float:
    """dl, the axial length of the fin that the bore bends (m): equation (4)."""
    fin, bore = actuator.piston, actuator.cylinder.inner_diameter
    taper = fin.fin_outer_diameter - fin.fin_inner_diameter
    return (fin.fin_outer_diameter - bore) / taper * math.hypot(fin.fin_length, taper / 2)


def band_area(bore: float, length: float) -> float:
    """s of a band of this axial length (m) on a bore of this diameter (m), in m^2: equation (5)."""
    return math.pi * bore * length


def contact_area(actuator: HybridActuator) -> float:
    """s, of the fin on the pressurised side with the bore (m^2): equation (5) at the length of (4)."""
    return band_area(actuator.cylinder.inner_diameter, deformed_length(actuator))


def interference(actuator: HybridActuator) -> float:
    """(D_f - D_c')/2 (m): radial, as drawn."""
    return (actuator.piston.fin_outer_diameter - actuator.cylinder.inner_diameter) / 2


def angle(actuator: HybridActuator) -> float:
    """theta (rad), of the fin's cone to its axis."""
    fin = actuator.piston
    return math.atan2((fin.fin_outer_diameter - fin.fin_inner_diameter) / 2, fin.fin_length)
