"""Friction of contacts that give before they slide: the bristle model (LuGre), stepped exactly.

Canudas de Wit, Olsson, Astrom and Lischinsky (1995), with the level of Nakata and Noda (2023), equation (6), for g:

    dz/dt = v - a z,   a = sigma_0 |v| / g(v, P)
    F     = sigma_0 z + sigma_1 dz/dt + sigma_2 v

z is the mean deflection of the bristles (m). It is linear in z, so that over a step h of constant v and P

    z_{k+1} = e^{-ah} z_k + h v phi(ah),              phi(x) = (1 - e^{-x})/x
    mean z  = g sgn v/sigma_0 + (z_k - g sgn v/sigma_0) phi(ah)

without error, at any length of step and any stiffness: |z| never exceeds the largest of its start and g/sigma_0. The
force that a step reports is its mean, so that force times way is the work exactly; at a sample itself there is
`bristle_force`. In steady sliding z = g sgn v/sigma_0, and F is (6).

The work that goes in is never less than what the bristles store, sigma_0 z^2/2, where sigma_1 = 0; with sigma_1 it
holds while |v| <= 4 mu_C (s P + F_0)/sigma_1, since sigma_1 (x - 1) <= g x^2/|v| for every x = sigma_0 |z|/g then.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluxbore.design.errors import DesignError
from fluxbore.design.friction import SealFriction, sliding_level
from fluxbore.design.recurrence import recurrence

Floats = NDArray[np.float64]

LEAST_LEVEL = 1e-12
"""N, below which a contact that nothing presses is taken as this light, so that a stays finite."""


@dataclass(frozen=True, slots=True)
class Bristle:
    """The friction of `law` over the contact area s (m^2), by bristles of stiffness sigma_0 (N/m) and damping sigma_1
    (N s/m).

    Raises DesignError for a stiffness that is not above zero, or a damping below zero.
    """

    law: SealFriction
    area: float
    stiffness: float
    damping: float = 0.0

    def __post_init__(self) -> None:
        if not (math.isfinite(self.stiffness) and self.stiffness > 0):
            raise DesignError(f"The stiffness of bristles must be finite and above 0 N/m; got {self.stiffness:g} N/m.")
        if not (math.isfinite(self.damping) and self.damping >= 0):
            raise DesignError(f"The damping of bristles must be finite and 0 or above; got {self.damping:g} N s/m.")


@dataclass(frozen=True, slots=True, eq=False)
class BristleRecord:
    """Over n steps: the deflection (m) at their n + 1 ends, and the mean force (N) of each; (n,) or (n, runs)."""

    deflection: Floats
    force: Floats


def advance(
    bristle: Bristle, deflection: ArrayLike, velocity: ArrayLike, pressure: ArrayLike, step: float
) -> tuple[Floats, Floats]:
    """One step (s) at constant velocity (m/s) and pressure (Pa gauge): the deflection (m) at its end, the mean force
    (N) over it. All broadcast; the force opposes the motion, and has its sign."""
    v = np.asarray(velocity, dtype=np.float64)
    z = np.asarray(deflection, dtype=np.float64)
    kept, gained, phi, steady = _coefficients(bristle, v, pressure, step)
    after = kept * z + gained
    return after, _mean_force(bristle, z, after, v, phi, steady, step)


def bristle_record(
    bristle: Bristle, velocity: ArrayLike, pressure: ArrayLike, step: float, start: ArrayLike = 0.0
) -> BristleRecord:
    """The whole record at once: velocity (m/s) and pressure (Pa gauge) of each step (s), (n,) or (n, runs).

    start : the deflection (m) before the first step, () or (runs,). A pressure (n, runs) may stand beside a velocity
    (n, 1), or the other way round.
    """
    v = np.asarray(velocity, dtype=np.float64)
    kept, gained, phi, steady = _coefficients(bristle, v, pressure, step)
    z = recurrence(kept, gained, start)
    return BristleRecord(z, _mean_force(bristle, z[:-1], z[1:], v, phi, steady, step))


def bristle_force(bristle: Bristle, deflection: ArrayLike, velocity: ArrayLike, pressure: ArrayLike) -> Floats:
    """F (N) at an instant, of deflection (m), velocity (m/s) and pressure (Pa gauge)."""
    v = np.asarray(velocity, dtype=np.float64)
    z = np.asarray(deflection, dtype=np.float64)
    rate = v - _rate(bristle, v, pressure)[0] * z
    return bristle.stiffness * z + bristle.damping * rate + bristle.law.viscous_coefficient * v


def _rate(bristle: Bristle, v: Floats, pressure: ArrayLike) -> tuple[Floats, Floats]:
    """a (1/s), and g (N)."""
    level = np.maximum(sliding_level(bristle.law, bristle.area, pressure, v), LEAST_LEVEL)
    return bristle.stiffness * np.abs(v) / level, level


def _coefficients(
    bristle: Bristle, v: Floats, pressure: ArrayLike, step: float
) -> tuple[Floats, Floats, Floats, Floats]:
    """e^{-ah}, h v phi(ah), phi(ah), and the steady deflection g sgn v/sigma_0."""
    rate, level = _rate(bristle, v, pressure)
    x = rate * step
    with np.errstate(invalid="ignore", divide="ignore"):
        phi = np.where(x > 0, -np.expm1(-x) / x, 1.0)
    return np.exp(-x), step * v * phi, phi, np.sign(v) * level / bristle.stiffness


def _mean_force(
    bristle: Bristle, before: Floats, after: Floats, v: Floats, phi: Floats, steady: Floats, step: float
) -> Floats:
    # At rest phi is one and the steady deflection zero: the mean is what it was before.
    mean = steady + (before - steady) * phi
    damped = bristle.damping * (after - before) / step
    return bristle.stiffness * mean + damped + bristle.law.viscous_coefficient * v
