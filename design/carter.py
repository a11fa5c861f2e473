"""Carter's coefficient: how much longer slots make an air gap seem."""

from __future__ import annotations

import math


def carter_coefficient(gap: float, opening: float, pitch: float) -> float:
    """k_c >= 1, so that a slotted gap g conducts like a smooth one of k_c g.

    gap : g, opening : b of a slot, pitch : t from slot to slot, in the same unit.

        k_c = t / (t - gamma g),   gamma = 4/pi [x atan x - ln sqrt(1 + x^2)],   x = b / 2g

    Carter (1901), Electrician 47, 925, by conformal mapping of one infinitely deep slot in a plane gap. Good where the
    slot is deeper than it is wide, the radius large beside the gap, and the teeth (t - b) wide enough that
    neighbouring slots do not feel each other, t - b > g or so. gamma g < b, therefore k_c < t / (t - b).
    """
    x = opening / (2 * gap)
    # log1p keeps the limit of narrow slots, gamma -> (2/pi) x^2, where the two terms nearly cancel
    gamma = 4 / math.pi * (x * math.atan(x) - 0.5 * math.log1p(x * x))
    return pitch / (pitch - gamma * gap)
