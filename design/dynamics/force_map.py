"""What a simulation knows of the field: force constant and cogging over the mover's position."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class ForceMap:
    """Electromagnetic force F(z, i) = force_constant(z) i + cogging(z), as a field model computed it.

    position : (n,) of the mover, ascending (m). force_constant : (n,) N per ampere of amplitude on the q axis.
    cogging : (n,) axial force at no current (N).
    """

    position: Floats
    force_constant: Floats
    cogging: Floats

    def force(self, position: Floats, current: Floats) -> Floats:
        """(n,) force (N) at positions (m) and currents (A); linear between the map's positions, constant beyond."""
        constant = np.interp(position, self.position, self.force_constant)
        return np.asarray(constant * current + np.interp(position, self.position, self.cogging))

    @property
    def mean_force_constant(self) -> float:
        """Over the map's positions (N/A)."""
        return float(np.mean(self.force_constant))

    def within(self, low: float, high: float) -> ForceMap:
        """The same map between two positions (m), both with values of their own."""
        inside = self.position[(self.position > low) & (self.position < high)]
        position = np.unique(np.concatenate(([low], inside, [high])))
        return ForceMap(
            position,
            np.interp(position, self.position, self.force_constant),
            np.interp(position, self.position, self.cogging),
        )
