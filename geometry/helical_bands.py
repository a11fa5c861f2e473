"""Radial remanence of helical magnets over one period, as plain numbers.

Magnets that follow a helix are bands in u = ζ/period, with ζ = z − h θ: their remanence is a function of u alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.errors import DesignError

Floats = NDArray[np.float64]

SMALLEST = 1e-9
"""Relative: what differs by less is the same."""


@dataclass(frozen=True, slots=True)
class Segment:
    """A stretch of the period on which the remanence is a straight line.

    start, end : of the period, plain numbers. first, last : T there, positive outwards.
    magnet : whether magnets fill it; air does otherwise.
    """

    start: float
    end: float
    first: float
    last: float
    magnet: bool = True


@dataclass(frozen=True, slots=True)
class Bands:
    """Segments that follow one another and cover one period."""

    segments: tuple[Segment, ...]

    def __post_init__(self) -> None:
        joined = all(abs(a.end - b.start) < 1e-12 for a, b in pairwise(self.segments))
        assert joined
        assert all(part.end > part.start for part in self.segments)
        assert abs(self.segments[-1].end - self.segments[0].start - 1.0) < 1e-12

    @property
    def breaks(self) -> tuple[float, ...]:
        """Where segments begin: increasing, less than one from first to last."""
        return tuple(part.start for part in self.segments)

    def remanence(self, share: Floats) -> Floats:
        """(...) T at u (...), any period of it."""
        part, along = self.located(share)
        first = np.array([segment.first for segment in self.segments])[part]
        last = np.array([segment.last for segment in self.segments])[part]
        return np.asarray(first + (last - first) * along)

    def magnets(self, share: Floats) -> NDArray[np.bool_]:
        """(...) whether there is magnet at u (...)."""
        part, _ = self.located(share)
        return np.array([segment.magnet for segment in self.segments])[part]

    @property
    def antisymmetric(self) -> bool:
        """Whether half a period on everything is the same with its sign changed, as of like north and south bands."""
        half = len(self.segments) // 2
        return len(self.segments) == 2 * half and all(
            part.magnet == opposite.magnet
            and abs(opposite.start - part.start - 0.5) < SMALLEST
            and abs(part.first + opposite.first) <= SMALLEST * abs(part.first)
            and abs(part.last + opposite.last) <= SMALLEST * abs(part.last)
            for part, opposite in zip(self.segments[:half], self.segments[half:], strict=True)
        )

    def harmonic(self, order: int) -> complex:
        """c (T) of the part Re c exp(2πi n u), n >= 1 being the order: exact, by parts on each segment."""
        wave = -2j * np.pi * order
        total = 0j
        for part in self.segments:
            slope = (part.last - part.first) / (part.end - part.start)
            at_start, at_end = np.exp(wave * part.start), np.exp(wave * part.end)
            total += (part.last * at_end - part.first * at_start) / wave - slope * (at_end - at_start) / wave**2
        return complex(2 * total)

    def located(self, share: Floats) -> tuple[NDArray[np.int_], Floats]:
        """Segment at each u, and how far along it u lies, from 0 to 1."""
        starts = np.array(self.breaks)
        ends = np.array([part.end for part in self.segments])
        inside = starts[0] + np.mod(share - starts[0], 1.0)
        part = np.clip(np.searchsorted(starts, inside, side="right") - 1, 0, starts.size - 1)
        return part, np.asarray((inside - starts[part]) / (ends[part] - starts[part]))


@dataclass(frozen=True, slots=True)
class Wave:
    """One harmonic alone: amplitude · cos(2π n (u − phase)). amplitude : T. order : n. phase : of the period."""

    amplitude: float
    order: int = 1
    phase: float = 0.0

    @property
    def breaks(self) -> tuple[float, ...]:
        return (self.phase,)

    @property
    def antisymmetric(self) -> bool:
        return self.order % 2 == 1

    def remanence(self, share: Floats) -> Floats:
        """(...) T at u (...)."""
        return np.asarray(self.amplitude * np.cos(2 * np.pi * self.order * (share - self.phase)))

    def magnets(self, share: Floats) -> NDArray[np.bool_]:
        """(...) all of it is magnet."""
        return np.ones(np.shape(share), dtype=bool)

    def harmonic(self, order: int) -> complex:
        """c (T) of the part Re c exp(2πi n u)."""
        return self.amplitude * complex(np.exp(-2j * np.pi * order * self.phase)) if order == self.order else 0j


Profile = Bands | Wave
"""Radial remanence over a period."""


def alternating(remanence: float, fraction: float = 1.0, phase: float = 0.0) -> Bands:
    """A north and a south band in each period, their middles half a period apart.

    remanence : T. fraction : of its half of the period that a band takes, the rest being air. phase : u of the north
    band's middle.

    Raises DesignError for a fraction that is not above 0 and at most 1.
    """
    if not 0 < fraction <= 1:
        raise DesignError(
            f"A helical magnet must take more than none and at most all of its half period; got {fraction:.4g} of it."
        )
    half = fraction / 4
    edges = (phase - half, phase + half, phase + 0.5 - half, phase + 0.5 + half, phase + 1 - half)
    segments = [
        Segment(edges[0], edges[1], remanence, remanence),
        Segment(edges[1], edges[2], 0.0, 0.0, magnet=False),
        Segment(edges[2], edges[3], -remanence, -remanence),
        Segment(edges[3], edges[4], 0.0, 0.0, magnet=False),
    ]
    if fraction < 1:
        return Bands(tuple(segments))
    middle, end = phase + 0.25, phase + 0.75
    return Bands(
        (Segment(edges[0], middle, remanence, remanence), Segment(middle, end, -remanence, -remanence)),
    )
