"""Whether a simulated screw still holds: its control the rotor, and its spring the mover."""

from __future__ import annotations

from fluxbore.design.errors import DesignError
from fluxbore.design.units import format_quantity

FARTHEST = 1e6
"""rad: a rotor that turns as far is not held by its control any more."""


def holds(angle: float, displacement: float, slip: float) -> bool:
    """Of the rotor's angle (rad), and of the displacement x_d (m) against half of the pitch, `slip` (m); not of NaN."""
    return -FARTHEST < angle < FARTHEST and -slip <= displacement <= slip


def lost(angle: float, slip: float, period: float, samples: int) -> DesignError:
    """What to raise where it does not hold, so many `samples` of the control's period (s) after the beginning."""
    after = format_quantity(period * samples, "time", 4)
    if not -FARTHEST < angle < FARTHEST:
        return DesignError(
            f"The control does not hold the rotor at a period of {format_quantity(period, 'time')}: it turns by more "
            f"than {FARTHEST:g} rad within {after}."
        )
    return DesignError(
        f"The screw slips: after {after} rotor and mover are further apart than half of the pitch, "
        f"{format_quantity(slip, 'length', 4)}."
    )
