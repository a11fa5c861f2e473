"""The field of a magnetic lead screw in closed form, and the force it makes: equations (7) to (10) of the RotLin paper.

Radially magnetised helices are square waves along zeta = z - h theta, of the odd harmonics n = 1, 3, 5 ... with

    b_n = 4 B_rem/(pi n) sin(n pi w/l_p),    k_n = m_n = 2 pi n/l_p,    p_n = h k_n = n x starts

w being the width of one magnet. `RadialStack` gives the radial field of one member's harmonic within the other's
magnets, per tesla: with G_n = int r H_r dr over them, the coenergy of both and the force on the displacement are

    W' = L pi sum b_n^t b_n^r G_n cos(k_n x_d),    F = L pi sum k_n b_n^t b_n^r G_n sin(k_n x_d) = sum F_n sin(m_n x_d)
    F_n = 4 pi p_a J_c K_n,    J_c = B_rem/(mu_r mu_0)                                                     (8), (9)

over the active length L = p_a l_p/2. The torque is h F exactly, since all depends on z - h theta alone.

Valid for linear magnets and iron that does not saturate (infinitely permeable, or none), and members long beside the
pitch: the last pole of each end has one neighbour only. The space between magnets narrower than l_p/2, and between
arcs, is taken as permeable as the magnets, a fault of the order (mu_r - 1) times its share. Arcs enter by their share
of the circumference and, where they climb in steps, by the mean over a step, sin(n s beta/2)/(n s beta/2) for s starts
and the angle beta; what the steps add beyond the mean meets no partner in the other member, and makes no force, unless
that climbs in steps too (`step_ripple`).
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluxbore.design.bh_curve import MU_0
from fluxbore.design.errors import DesignError
from fluxbore.design.force_series import ForceSeries
from fluxbore.design.lead_screw import HelicalMagnets, LeadScrew
from fluxbore.design.radial_stack import REACH, Harmonics, RadialStack, shapes, solve
from fluxbore.design.units import format_quantity

Floats = NDArray[np.float64]

MOST_HARMONICS = 100
"""Odd ones, up to n = 199: F_n falls as 1/n^2 at least, and as exp(-k_n gap) once the gap is passed."""

TRANSLATOR, GAP, ROTOR = 0, 1, 2
"""The layers of the stack, from the inside."""


def force_series(screw: LeadScrew) -> ForceSeries:
    """F(x_d) of the whole active length. Raises DesignError where `harmonics` does."""
    wave, order = harmonics(screw)
    field = solve(stack(screw), wave, order)
    amplitude = screw.active_length * wave * _coenergy(screw, field)
    return ForceSeries(amplitude, screw.pitch)


def field_constants(screw: LeadScrew) -> Floats:
    """K_n (N m/A, that is Wb) of (7) for n = 1, 3, 5 ..., (H,), with J_c of the rotor's magnets by (8)."""
    current = screw.rotor.remanence / (screw.rotor.magnet_permeability * MU_0)
    return np.asarray(force_series(screw).amplitude / (4 * np.pi * screw.poles * current))


def harmonic_ratios(screw: LeadScrew) -> tuple[float, float]:
    """K_2/K_1 and K_3/K_1: the third and the fifth harmonic, which the paper counts as its second and third."""
    amplitude = force_series(screw).amplitude
    padded = np.append(amplitude, [0.0, 0.0])
    return float(padded[1] / padded[0]), float(padded[2] / padded[0])


def remanence_for_stall_force(screw: LeadScrew, stall_force: float) -> float:
    """B_rem (T) of both members' magnets with which the largest force is this one (N): the force goes with its square.

    Raises DesignError for a stall force that is not above zero.
    """
    if not (math.isfinite(stall_force) and stall_force > 0):
        raise DesignError(f"A stall force must be finite and above 0 N; got {stall_force:g} N.")
    return math.sqrt(stall_force / force_series(with_remanence(screw, 1.0)).peak[1])


def engagement_force(screw: LeadScrew, displacement: ArrayLike) -> Floats:
    """Force (N) that pulls the members into each other while they overlap in part, at the displacement x_d (m).

    W'/L of the engaged members less that of each alone, per metre of overlap: the attraction of magnets, which the
    displacement modulates, and of magnets to the other member's iron, which it does not. Free of the fringe at the
    ends: the mean over a pitch or so of overlap. Of arcs in steps their mean alone counts.
    """
    wave, order = harmonics(screw)
    engaged = stack(screw)
    without_translator = replace(engaged, permeability=(1.0, *engaged.permeability[1:]), inner_iron=False)
    without_rotor = replace(engaged, permeability=(*engaged.permeability[:2], 1.0), outer_iron=False)
    field = solve(engaged, wave, order)
    attraction = 0.0
    pairs = ((without_rotor, TRANSLATOR, screw.translator), (without_translator, ROTOR, screw.rotor))
    for alone, layer, member in pairs:
        gained = field.interaction(layer, layer) - solve(alone, wave, order).interaction(layer, layer)
        # Both members' own pattern: half of the product, as of every self-energy.
        attraction += float(np.sum(np.pi / 2 * pattern(screw, member, len(wave)) ** 2 * gained))
    cosines = np.cos(np.asarray(displacement, dtype=np.float64)[..., None] * wave)
    return np.asarray(attraction + cosines @ _coenergy(screw, field))


def gap_field(screw: LeadScrew, radius: float, zeta: ArrayLike, displacement: float) -> tuple[Floats, Floats, Floats]:
    """B_r, B_theta and B_z (T) at a radius (m) in the gap, at zeta = z - h theta (m) of any shape.

    zeta is counted from the middle of a magnet of the translator; the rotor's stand `displacement` x_d (m) further.
    Raises DesignError for a radius outside the gap.
    """
    _, inner, outer, _ = screw.radii
    if not inner <= radius <= outer:
        raise DesignError(f"A radius in the gap must be from {inner:g} m to {outer:g} m; got {radius:g} m.")
    wave, order = harmonics(screw)
    field = solve(stack(screw), wave, order)
    at = np.full((len(wave), 1), radius)
    values = np.concatenate(shapes(wave, order, inner, outer, at), axis=1)
    slopes = np.concatenate(shapes(wave, order, inner, outer, at, derivative=True), axis=1)
    angles = np.asarray(zeta, dtype=np.float64)[..., None] * wave
    radial, axial = np.zeros(angles.shape[:-1]), np.zeros(angles.shape[:-1])
    for layer, member, shift in ((TRANSLATOR, screw.translator, 0.0), (ROTOR, screw.rotor, displacement)):
        ends = field.potentials(layer)[:, GAP : GAP + 2] * pattern(screw, member, len(wave))[:, None]
        phase = angles - wave * shift
        radial -= MU_0 * np.cos(phase) @ np.sum(ends * slopes, axis=1)
        axial += MU_0 * np.sin(phase) @ (wave * np.sum(ends * values, axis=1))
    return radial, -screw.h / radius * axial, axial


def stack(screw: LeadScrew) -> RadialStack:
    """The members' magnets with the gap between; iron behind them wherever the member has any thickness of it."""
    return RadialStack(
        screw.radii,
        (screw.translator.magnet_permeability, 1.0, screw.rotor.magnet_permeability),
        inner_iron=screw.translator.iron_thickness > 0,
        outer_iron=screw.rotor.iron_thickness > 0,
    )


def harmonics(screw: LeadScrew, across: bool = True) -> tuple[Floats, Floats]:
    """k_n (1/m) and p_n, both (H,): of the harmonics that reach across the gap, or of `MOST_HARMONICS` without this.

    Raises DesignError where the gap lets not even the first across.
    """
    odd = 2.0 * np.arange(MOST_HARMONICS) + 1
    wave, order = np.asarray(2 * np.pi / screw.pitch * odd), np.asarray(screw.starts * odd)
    decay = np.hypot(wave, order / screw.bore_radius)
    if decay[0] * screw.gap >= REACH:
        raise DesignError(
            f"actuator.gap must let the field across, at most {format_quantity(REACH / float(decay[0]), 'length', 4)} "
            f"at this pitch; got {format_quantity(screw.gap, 'length')}."
        )
    kept = decay * screw.gap < REACH if across else np.full(MOST_HARMONICS, True)
    return wave[kept], order[kept]


def pattern(screw: LeadScrew, member: HelicalMagnets, count: int) -> Floats:
    """b_n (T), (count,): the cosines of a member's radial remanence about the middle of a magnet."""
    odd = 2.0 * np.arange(count) + 1
    found = 4 * member.remanence / (np.pi * odd) * np.sin(odd * np.pi * member.magnet_width / screw.pitch)
    if member.arcs is None:
        return np.asarray(found)
    # numpy's sinc has the pi within.
    step = odd * screw.starts * member.arcs.angle / (2 * np.pi) if member.arcs.stepped else 0.0 * odd
    return np.asarray(found * member.arcs.fill * np.sinc(step))


def with_remanence(screw: LeadScrew, remanence: float) -> LeadScrew:
    """The same screw with this remanence (T) in both members' magnets."""
    return replace(
        screw,
        translator=replace(screw.translator, remanence=remanence),
        rotor=replace(screw.rotor, remanence=remanence),
    )


def _coenergy(screw: LeadScrew, field: Harmonics) -> Floats:
    """pi b_n^t b_n^r G_n (J/m), (H,): of both members' fields together, along the axis."""
    count = len(field.matrix)
    both = pattern(screw, screw.translator, count) * pattern(screw, screw.rotor, count)
    return np.asarray(np.pi * both * field.interaction(TRANSLATOR, ROTOR))
