"""Helical poles built of arcs: what of their remanence is still a helix, and what is not the same all round.

An arc in steps lies square to the axis, at the helix' height at its middle. Seen in ζ = z − h θ its edges sweep over h
times its angle, and what is not the same all round the screw follows from a Fourier series in θ: a remanence
Re c exp(2πi n u) of a continuous helix, u = ζ/period, becomes

    Re c Σ_m w_m exp(i (n k z − ν θ)) ,   ν = n σ − m N ,   w_m = (N α/2π) sin(ν α/2)/(ν α/2) ,   k = 2π/period ,

with N arcs of the angle α in a turn and σ = lead/period starts. m = 0 is a helix again, weaker than the continuous one:
the mean over all angles. Each other m is a helix of another lead, ν · period/n. Arcs that follow the helix have m N in
place of ν in the sine.
"""

from __future__ import annotations

from itertools import pairwise
from math import pi

import numpy as np

from fluxbore.design.lead_screw import Arcs
from fluxbore.geometry.helical_bands import SMALLEST, Bands, Floats, Segment


def wave_weight(arcs: Arcs | None, azimuthal: float, ripple: float) -> float:
    """w of the part with the order ν around the axis, relative to the continuous helix; None for such a helix itself.

    ripple : m N, how often the part repeats in a turn against the helix: zero for the mean.
    """
    if arcs is None:
        return 1.0 if ripple == 0 else 0.0
    swept = azimuthal if arcs.stepped else ripple
    return float(arcs.fill * np.sinc(swept * arcs.angle / (2 * pi)))


def averaged(bands: Bands, arcs: Arcs, starts: float) -> Bands:
    """The mean over all angles of bands built of arcs: the part m = 0 of every harmonic.

    starts : lead/period. The profile is the bands' own, averaged over ``starts`` · angle/2π of the period where arcs
    are in steps (sloping edges in place of jumps), and thinned by the share of the turn that the arcs fill. It is all
    taken for magnet, air between arcs too, for a permeability cannot be averaged so.
    """
    width = abs(starts) * arcs.angle / (2 * pi) if arcs.stepped else 0.0
    filled = arcs.fill
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
