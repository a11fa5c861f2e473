"""What arcs add to the force of a lead screw beyond their mean: ripple over the rotor's angle.

Cut into N arcs a turn of the angle beta, the n-th harmonic of a member's remanence, b_n exp(i n k z) around the axis,
is no longer exp(-i n s theta) alone (s starts), but

    sum_q c_q exp(-i (n s + N q) theta),    c_q = f sin(a)/a,    f = N beta/2 pi,
    a = (n s + N q) beta/2 where the arcs lie across the axis, in steps,    a = N q beta/2 where they follow the helix

q = 0 is the mean that `helical_field` takes. Each of the others has a field of its own, of order |n s + N q|, in the
same layers, and makes a force only with a harmonic of the other member that has the same order: N q = N' q' for its
N' arcs. One member with arcs and one without, therefore, make no ripple at all; two with as many make the most. With
m = n s + N q, over the rotor's angle theta and the displacement x_d,

    F = sum A_nm n k sin(n k x_d + (m - n s) theta),    T_s = sum A_nm m sin(n k x_d + (m - n s) theta)
    A_nm = L pi b_n^t b_n^r c^t c^r G(n k, |m|)

from one coenergy, at theta = 0 with an arc of each over the other. Only for q = 0 is the torque h times the force; over
a turn at a constant x_d both have the mean of `force_series`. Valid as there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluxbore.design.helical_field import ROTOR, TRANSLATOR, harmonics, pattern, stack
from fluxbore.design.lead_screw import Arcs, LeadScrew
from fluxbore.design.radial_stack import solve

Floats = NDArray[np.float64]

FAR = 16.0
"""Decay lengths across the gap beyond which a term is left out: exp(-16) is 1e-7 of the first."""

SAMPLES = 400
"""Of a period of the ripple."""


@dataclass(frozen=True, slots=True, eq=False)
class SteppedSeries:
    """The terms of F and T_s, (terms,) each; those of no ripple, m = n s, among them."""

    coenergy: Floats  # A_nm, J
    wave: Floats  # n k, 1/m
    order: Floats  # m, of either sign
    ripple: Floats  # m - n s, periods per turn of the rotor

    def force(self, displacement: ArrayLike, angle: ArrayLike) -> Floats:
        """N, at displacements x_d (m) and angles of the rotor (rad), which broadcast."""
        return np.asarray(self._sines(displacement, angle) @ (self.coenergy * self.wave))

    def torque(self, displacement: ArrayLike, angle: ArrayLike) -> Floats:
        """T_s (N m) on the rotor, against the motor."""
        return np.asarray(self._sines(displacement, angle) @ (self.coenergy * self.order))

    def _sines(self, displacement: ArrayLike, angle: ArrayLike) -> Floats:
        x, theta = np.asarray(displacement, dtype=np.float64), np.asarray(angle, dtype=np.float64)
        return np.asarray(np.sin(x[..., None] * self.wave + theta[..., None] * self.ripple))


def stepped_series(screw: LeadScrew) -> SteppedSeries:
    """F and T_s over displacement and angle, with what the arcs of both members make together."""
    both = screw.translator.arcs, screw.rotor.arcs
    wave, order = harmonics(screw)
    apart = _common_period(*both)
    most = math.ceil(FAR * screw.bore_radius / screw.gap / apart) if apart else 0
    q = np.arange(-most, most + 1)
    ripple = np.tile(q * float(apart), len(wave))
    k, m = np.repeat(wave, len(q)), np.repeat(order, len(q)) + ripple
    kept = (ripple == 0) | (np.hypot(k, m / screw.bore_radius) * screw.gap < FAR)
    k, m, ripple = k[kept], m[kept], ripple[kept]
    # The field of m is that of -m.
    fields, place = np.unique(np.stack([k, np.abs(m)]), axis=1, return_inverse=True)
    coenergy = np.pi * screw.active_length * solve(stack(screw), *fields).interaction(TRANSLATOR, ROTOR)[place.ravel()]
    for member in (screw.translator, screw.rotor):
        whole = pattern(screw, replace(member, arcs=None), len(wave))
        coenergy = coenergy * np.repeat(whole, len(q))[kept] * _share(member.arcs, m, ripple)
    return SteppedSeries(coenergy, k, m, ripple)


def force_ripple(screw: LeadScrew, displacement: float) -> float:
    """Peak to peak (N) of the force over a turn of the rotor at a constant displacement x_d (m)."""
    series = stepped_series(screw)
    period = _common_period(screw.translator.arcs, screw.rotor.arcs)
    if not period:
        return 0.0
    angles = np.linspace(0.0, 2 * math.pi / period, SAMPLES, endpoint=False)
    return float(np.ptp(series.force(displacement, angles)))


def _common_period(first: Arcs | None, second: Arcs | None) -> int:
    """Periods per turn that the arcs of both have in common; none where a member is whole."""
    if first is None or second is None:
        return 0
    return math.lcm(first.per_turn, second.per_turn)


def _share(arcs: Arcs | None, order: Floats, ripple: Floats) -> Floats:
    """c_q at the order m = n s + N q, for m - n s = N q."""
    if arcs is None:
        return np.where(ripple == 0, 1.0, 0.0)
    # numpy's sinc has the pi within.
    return np.asarray(arcs.fill * np.sinc((order if arcs.stepped else ripple) * arcs.angle / (2 * np.pi)))
