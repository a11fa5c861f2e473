"""Actuators that several rooms are tested on."""

from fluxbore.design.hybrid import BackYoke, Cylinder, EndCaps, HybridActuator, Mover, Piston, Shaft, Winding

MM = 1e-3


def table_ii() -> HybridActuator:
    """The prototype of Nakata and Noda (2023), Tables II and III; tube length, fin thickness and caps are assumed."""
    return HybridActuator(
        name="iPEHLA",
        back_yoke=BackYoke(27 * MM, 25 * MM, 3 * MM, 10 * MM, "1010"),
        winding=Winding(24.2 * MM, 8, 584, 0.4 * MM, "copper"),
        cylinder=Cylinder(20 * MM, 16.1 * MM, 16 * MM, 220 * MM, "aluminium 6061"),
        mover=Mover(12 * MM, 1.5 * MM, 4, 15.9 * MM, "N48", 1.4, 1.05, "1010", 88 * MM),
        shaft=Shaft(8 * MM, 235 * MM, "stainless steel 304"),
        piston=Piston(8 * MM, 16.3 * MM, 15.4 * MM, 1.8 * MM, 0.3 * MM, "POM"),
        end_caps=EndCaps(27 * MM, 12 * MM, 3 * MM, 0.05 * MM, "aluminium 6061", "M5", 6 * MM),
    )
