"""The parts of the pneumatic-electromagnetic hybrid actuator, as turned profiles (Nakata and Noda 2023, Figs. 5 and 9).

What the paper does not dimension is drawn as a workshop would, from the actuator's own parameters:
`fluxbore.geometry.hybrid_layout` says where every detail stands, `hybrid_stator`, `hybrid_caps` and `hybrid_mover` draw
it, `hybrid_checks` refuses what cannot be made. Set screws stand across the axis and are not drawn.
"""

from __future__ import annotations

from fluxbore.design.errors import DesignError
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.units import format_quantity
from fluxbore.geometry import hybrid_checks, hybrid_layout, hybrid_stator
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.hybrid_caps import end_caps
from fluxbore.geometry.hybrid_mover import mover


def assembly(actuator: HybridActuator, position: float) -> Assembly:
    """All parts with the mover at this position (m), as `fluxbore.design.hybrid` defines it.

    The stator comes first: yoke, coils, tube, caps with their rings and bush; then shaft, magnets and rings from the
    cap end, pistons and snap rings.
    Raises DesignError where the parts do not fit one another or the position is beyond the stroke.
    """
    actuator.check()
    hybrid_checks.check_mover(actuator)
    hybrid_checks.check_caps(actuator)
    low = actuator.mid_stroke - actuator.mover.stroke / 2
    high = actuator.mid_stroke + actuator.mover.stroke / 2
    if not low - hybrid_checks.SLACK <= position <= high + hybrid_checks.SLACK:
        span = " to ".join(format_quantity(place, "length", 6) for place in (low, high))
        got = format_quantity(position, "length", 6)
        raise DesignError(f"The position must lie within the stroke, {span}; got {got}.")
    spigot = hybrid_layout.spigot(actuator)
    moving = mover(actuator, position)
    return Assembly(
        name=actuator.name,
        parts=(
            hybrid_stator.back_yoke(actuator),
            *hybrid_stator.coils(actuator),
            hybrid_stator.tube(actuator, spigot),
            *end_caps(actuator, spigot),
            *moving,
        ),
        position=position,
        squeezes=tuple((part.name, "cylinder tube") for part in moving if part.role == "piston"),
    )
