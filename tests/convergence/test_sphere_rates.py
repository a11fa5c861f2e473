"""Rates at a sphere of iron in a uniform field, and at a magnetised one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from manufactured import ENERGY_RATE, FIELD_RATE, VACUUM, field_error, levels, manufactured, over_rectangle, slope

from fluxbore.fem.conditions import Conditions, Prescribed
from fluxbore.fem.energy import energies
from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.mesh import Floats
from fluxbore.fem.outline import Curve, Outline, Seed
from fluxbore.fem.problem import MagneticMaterial


@dataclass(frozen=True)
class Ball:
    """A sphere of permeability mu in a field of 1 T along z, or a magnet of remanence 1 T by itself, mu = 0; ν0 = 1."""

    mu: float
    radius: float = 0.4

    @property
    def inside(self) -> float:
        return 3 * self.mu / (self.mu + 2) if self.mu else 2 / 3

    @property
    def outside(self) -> float:
        return 1.0 if self.mu else 0.0

    @property
    def dipole(self) -> float:
        return (self.mu - 1) / (self.mu + 2) if self.mu else 1 / 3

    def field(self, points: Floats) -> Floats:
        r, z = points[..., 0], points[..., 1]
        distance = np.maximum(np.hypot(r, z), self.radius)
        away = np.stack((3 * r * z, 3 * z**2 - distance**2), axis=-1) / distance[..., None] ** 2
        around = away * self.dipole * ((self.radius / distance) ** 3)[..., None] + (0.0, self.outside)
        within = np.broadcast_to((0.0, self.inside), around.shape)
        return np.where((np.hypot(r, z) < self.radius)[..., None], within, around)

    def potential(self, points: Floats) -> Floats:
        """A_φ outside."""
        return np.asarray(
            points[:, 0] / 2 * (self.outside + 2 * self.dipole * (self.radius / np.hypot(*points.T)) ** 3)
        )

    def energy(self, far: float) -> float:
        """Up to a radius: that of a magnet is counted from its remanence."""

        def shell(at: Floats) -> Floats:
            distance, angle = at[..., 0], at[..., 1]
            points = np.stack((distance * np.sin(angle), distance * np.cos(angle)), axis=-1)
            return np.asarray(np.pi * np.sum(self.field(points) ** 2, axis=-1) * points[..., 0] * distance)

        own = self.inside**2 / self.mu if self.mu else (1 - self.inside) ** 2
        return over_rectangle(shell, (self.radius, far), (0, np.pi)) + 2 / 3 * np.pi * self.radius**3 * own

    def solved(self, count: int) -> list[Solution]:
        points = np.array([(0, -1), (0, -self.radius), (0, self.radius), (0, 1)])
        curves = Curve(0, 1), Curve(1, 2), Curve(2, 3), Curve(1, 2, np.pi), Curve(0, 3, np.pi, condition=0)
        outline = Outline("axisymmetric", points, curves, (Seed((0.7, 0.0), 0), Seed((0.1, 0.0), 1)))
        core = MagneticMaterial(1 / self.mu) if self.mu else MagneticMaterial.magnet((0.0, 1.0), 1.0)
        far = Conditions([Prescribed(self.potential)])
        return [manufactured(level, (*VACUUM, core)) for level in levels(outline, far, count)]


@pytest.mark.parametrize("mu", [0.0, 5.0, 1000.0])
def test_sphere(mu: float) -> None:
    """Catches a sphere's face that costs an order: iron in a field, and a magnet (0). Three halves without its arc."""
    body = Ball(mu)
    solved = body.solved(3)
    assert slope([energies(s)[0] / body.energy(1.0) - 1 for s in solved]) > ENERGY_RATE
    assert slope([field_error(s, body.field) for s in solved]) > FIELD_RATE - 0.1


def test_energy_of_a_sphere() -> None:
    """Catches what little of the order is lost near the axis."""
    body = Ball(5.0)
    assert slope([energies(s)[0] / body.energy(1.0) - 1 for s in body.solved(4)[1:]]) > ENERGY_RATE
