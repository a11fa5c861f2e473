"""What a workshop makes of a design: how wire fills the winding's window."""

from __future__ import annotations

from fluxbore.design.hybrid import HybridActuator


def winding_layers(actuator: HybridActuator, insulated_diameter: float) -> float:
    """Layers of wire in a coil: turns times wire diameter (m) over the coil's width.

    A continuous number, so that it has a derivative; a winder needs the next whole one. The wires of one layer touch.
    """
    return actuator.turns_per_coil * insulated_diameter / actuator.coil_width


def winding_room(actuator: HybridActuator, insulated_diameter: float) -> float:
    """Radial room (m) that the layers leave in the window; negative where they do not fit.

    Layers lie straight on one another, wires in squares, as in a coil wound by hand; nested in hexagons they would be
    lower by up to 13 %.
    """
    height = (actuator.winding.outer_diameter - actuator.cylinder.outer_diameter) / 2
    return height - winding_layers(actuator, insulated_diameter) * insulated_diameter
