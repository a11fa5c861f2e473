"""A periodic magnetic spring as the sum of its harmonics: force, stiffness and energy over the displacement."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

SAMPLES = 720
"""Over a quarter or half of a period, from which the top of the force is refined."""


ALIKE = 1e-3
"""Of the force: two tops that differ by no more are equal but for the mesh they were computed on."""


@dataclass(frozen=True, eq=False)
class ForceSeries:
    """F(x_d) = sum F_n sin(m_n x_d), equation (9) of the RotLin paper, with F_n = 4 pi p_a J_c K_n.

    amplitude : F_n (N), (H,).   pitch : l_p (m), the full period; m_n = 2 pi n/l_p.
    orders : n of each, in any order; n = 1, 3, 5 ... without them. Iron that saturates adds even ones: then poles that
    attract are not the mirror of those that repel.
    """

    amplitude: Floats
    pitch: float
    orders: tuple[int, ...] | None = None

    @cached_property
    def wave(self) -> Floats:
        """m_n (1/m), (H,)."""
        orders = 2.0 * np.arange(len(self.amplitude)) + 1 if self.orders is None else np.array(self.orders, dtype=float)
        return np.asarray(2 * np.pi / self.pitch * orders)

    def force(self, displacement: ArrayLike) -> Floats:
        """N, that pulls the displacement (m) back to zero, of any shape."""
        return np.asarray(np.sin(self._angles(displacement)) @ self.amplitude)

    def stiffness(self, displacement: ArrayLike) -> Floats:
        """dF/dx_d (N/m) at a displacement (m) of any shape."""
        return np.asarray(np.cos(self._angles(displacement)) @ (self.amplitude * self.wave))

    def curvature(self, displacement: float) -> float:
        """d2F/dx_d2 (N/m^2) at a displacement (m)."""
        return float(-np.sin(self._angles(displacement)) @ (self.amplitude * self.wave**2))

    def energy(self, displacement: ArrayLike) -> Floats:
        """What the spring holds (J) beyond its rest at x_d = 0; 1 - cos as 2 sin^2, for small ones."""
        return np.asarray(np.sin(self._angles(displacement) / 2) ** 2 @ (2 * self.amplitude / self.wave))

    @cached_property
    def barrier(self) -> float:
        """J, of the top at half a period, over which the spring slips."""
        return float(self.energy(self.pitch / 2))

    @cached_property
    def peak(self) -> tuple[float, float]:
        """The displacement (m) of the largest force, first met from zero, and that force (N).

        Every odd harmonic is even about a quarter of the period, so that the first quarter holds it. With even ones it
        is in the first half, and of two tops that are `ALIKE` the nearer counts.
        """
        reach = self.pitch / 4 if self.orders is None else self.pitch / 2
        places = np.linspace(0.0, reach, SAMPLES + 1)
        forces = self.force(places)
        best = int(np.argmax(forces))
        if best == SAMPLES:
            return reach, float(self.force(reach))
        if self.orders is not None and best > 0:
            tops = np.flatnonzero((forces[1:-1] >= forces[:-2]) & (forces[1:-1] >= forces[2:])) + 1
            best = int(tops[forces[tops] >= (1 - ALIKE) * forces[best]][0])
        low, high = places[max(best - 1, 0)], places[best + 1]
        top = self._falling(float(low), float(high))
        return top, float(self.force(top))

    def rest(self, load: float) -> float | None:
        """The stable displacement (m) under a load (N), between zero and the peak; None where the load is too large.

        A load against the spring's own direction has a negative displacement.
        """
        top, stall = self.peak
        if abs(load) > stall:
            return None
        low, high = 0.0, top
        while (middle := (low + high) / 2) not in (low, high):
            low, high = (middle, high) if self.force(middle) < abs(load) else (low, middle)
        return math.copysign(high, load) if load else 0.0

    def _falling(self, low: float, high: float) -> float:
        """Where the stiffness turns negative between two displacements, to rounding."""
        while (middle := (low + high) / 2) not in (low, high):
            low, high = (middle, high) if self.stiffness(middle) > 0 else (low, middle)
        return high

    def _angles(self, displacement: ArrayLike) -> Floats:
        return np.asarray(displacement, dtype=np.float64)[..., None] * self.wave
