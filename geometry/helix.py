"""Outlines of what follows a helix z = c + lead θ/2π, in the unrolled plane (θ, z): bands, arcs, sectors.

Right-handed where the lead is positive: seen along +z it goes away while it turns clockwise.
"""

from __future__ import annotations

import math

from fluxbore.geometry.unrolled import TURN, Outline


def band(lead: float, width: float, height: float, length: float) -> Outline:
    """A helix as wide as `width` along the axis, cut flat at z = -length/2 and length/2: no way round it is left out.

    lead : m per turn, not 0. height : c, where its middle crosses θ = 0. m.
    Its area is width · length · 2π/|lead|: a band loses at neither end what it would gain by running out of the length.
    """
    half, slope = length / 2, lead / TURN
    low, high = (-half - height) / slope, (half - height) / slope
    reach = width / 2 / abs(slope)
    return (low - reach, -half), (low + reach, -half), (high + reach, half), (high - reach, half)


def arc(lead: float, width: float, angle: float, theta: float, height: float) -> Outline:
    """A piece of the helix around (theta, height), its ends along generators.

    lead : m per turn; 0 makes a sector of a ring, square to the axis. angle : about the axis (rad). m.
    Its area is width · angle, whatever the lead.
    """
    start, end = theta - angle / 2, theta + angle / 2
    rise, half = lead * angle / TURN / 2, width / 2
    return (
        (start, height - rise - half),
        (end, height + rise - half),
        (end, height + rise + half),
        (start, height - rise + half),
    )


def places(lead: float, height: float, per_turn: int, length: float) -> list[tuple[float, float]]:
    """Middles (θ, z) of the arcs of one helix, `per_turn` of them in a turn, one at θ = 0 a whole number of turns on.

    They are those with -length/2 <= z < length/2, so that a length of whole turns has `per_turn` for each. m.
    """
    step, half = lead / per_turn, length / 2
    # Middles that rounding puts on either side of an end.
    slack = 1e-9 * step
    first = math.ceil((-half - height - slack) / step)
    last = math.ceil((half - height - slack) / step)
    return [(TURN * i / per_turn, height + i * step) for i in range(first, last)]
