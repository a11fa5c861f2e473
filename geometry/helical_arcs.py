"""Helical poles built of arcs: rings of straight magnets, each ring's arcs stepped along the axis after the helix.

An arc lies square to the axis, at the helix' height at its middle. Seen in ζ = z − h θ its edges sweep over h times its
angle, and what is not the same all round the screw follows from a Fourier series in θ: a remanence Re c exp(2πi n u)
of a continuous helix, u = ζ/period, becomes

    Re c Σ_m w_m exp(i (n k z − ν θ)) ,   ν = n σ − m N ,   w_m = (N α/2π) sin(ν α/2)/(ν α/2) ,   k = 2π/period ,

with N arcs of the angle α in a turn and σ = lead/period starts. m = 0 is a helix again, weaker than the continuous one:
the mean over all angles. Each other m is a helix of another lead, ν · period/n.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import isfinite, pi

import numpy as np

from fluxbore.design.errors import DesignError
from fluxbore.geometry.helical_bands import SMALLEST, Bands, Floats, Segment


@dataclass(frozen=True, slots=True)
class Arcs:
    """Arcs in a turn and the angle (rad) of each.

    Raises DesignError for arcs that overlap, or for none.
    """

    count: int
    angle: float

    def __post_init__(self) -> None:
        if self.count < 1:
            raise DesignError(f"There must be at least one magnet arc in a turn; got {self.count}.")
        most = 2 * pi / self.count
        if not (isfinite(self.angle) and 0 < self.angle <= most * (1 + 1e-12)):
            raise DesignError(
                f"Each of {self.count} magnet arcs in a turn must take more than 0 and at most {np.degrees(most):.6g} "
                f"deg, or they overlap; got {np.degrees(self.angle):.6g} deg."
            )

    def weight(self, azimuthal: float) -> float:
        """w of the part with this order ν around the axis, relative to the continuous helix: plain number."""
        return float(self.count * self.angle / (2 * pi) * np.sinc(azimuthal * self.angle / (2 * pi)))


def averaged(bands: Bands, arcs: Arcs, starts: float) -> Bands:
    """The mean over all angles of bands built of arcs: the part m = 0 of every harmonic.

    starts : lead/period. The profile is the bands' own, averaged over ``starts`` · angle/2π of the period (sloping
    edges in place of jumps) and thinned by the share of the turn that the arcs fill. It is all taken for magnet, air
    between arcs too, for a permeability cannot be averaged so.
    """
    width = abs(starts) * arcs.angle / (2 * pi)
    filled = arcs.count * arcs.angle / (2 * pi)
    if width == 0.0:
        return Bands(
            tuple(Segment(s.start, s.end, filled * s.first, filled * s.last) for s in bands.segments),
        )
    corners: list[float] = []
    for place in sorted((edge + side * width / 2) % 1.0 for edge in bands.breaks for side in (-1, 1)):
        if not corners or (place - corners[-1] > SMALLEST and place - corners[0] < 1.0 - SMALLEST):
            corners.append(place)
    places = np.array([*corners, corners[0] + 1.0])
    values = filled * (_integral(bands, places + width / 2) - _integral(bands, places - width / 2)) / width
    points = list(zip(places.tolist(), values.tolist(), strict=True))
    return Bands(tuple(Segment(a, b, first, last) for (a, first), (b, last) in pairwise(points)))


def _integral(bands: Bands, share: Floats) -> Floats:
    """(k,) ∫ remanence du from the first break to u (T), of bands that are constant on each segment."""
    assert all(part.first == part.last for part in bands.segments)
    edges = np.array([*bands.breaks, bands.segments[-1].end])
    sums = np.concatenate(([0.0], np.cumsum([part.first * (part.end - part.start) for part in bands.segments])))
    turns = np.floor(share - edges[0])
    return np.asarray(np.interp(share - turns, edges, sums) + turns * sums[-1])
