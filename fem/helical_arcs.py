"""Lead screws with magnets of arcs: the force of the averaged helix, and what the arcs' steps leave as ripple.

Both members' remanences are sums of waves exp(i (n k z − ν θ)) (`geometry/helical_arcs.py`), and in linear materials
only waves of one n and one ν in both give a mean force. Such a pair is itself a helical problem, of the lead
ν · period/n, and is solved as one. With x the displacement of the outer member along ζ and α its angle, counted from
where an arc's middle stands over another's, the pair's force goes as sin(n k x + (n σ − ν) α + a phase): ν = n σ is the
averaged helix, all others ripple with the angle, and their torque is ν/(n k) times their force instead of h times it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import lcm, pi

import numpy as np

from fluxbore.design.errors import DesignError
from fluxbore.design.lead_screw import Arcs
from fluxbore.fem.helical import solve
from fluxbore.fem.helical_force import force
from fluxbore.fem.mesh import Floats
from fluxbore.geometry.helical_arcs import wave_weight
from fluxbore.geometry.helical_bands import Wave
from fluxbore.geometry.helical_section import HelicalSection, Layer


@dataclass(frozen=True, slots=True)
class ArcHarmonic:
    """One pair of waves, per period of the screw's length.

    order : n along the axis. azimuthal : ν around it. ripple : n σ − ν, how often it repeats in a turn, zero for the
    averaged helix. amplitude : N, of the axial force on the inner member. phase : rad. transfer : ν/(n k) (m/rad),
    torque on the outer member per force.
    """

    order: int
    azimuthal: int
    ripple: int
    amplitude: float
    phase: float
    transfer: float


def arc_harmonics(
    section: HelicalSection,
    inner: Arcs | None,
    outer: Arcs | None,
    orders: Sequence[int] = (1, 3, 5),
    reach: int = 6,
    refinement: int = 1,
) -> tuple[ArcHarmonic, ...]:
    """The waves that make up force and torque of a screw whose members' magnets are arcs; None for a continuous helix.

    reach : how many ripples on either side of each order; with six arcs a turn six of them leave out 0.2 % of the force
    and, for waves that turn fast count more there, 4 % of the torque. Iron with a curve is taken at its largest
    permeability, for waves add up in linear materials only.

    Raises DesignError where the lead is no whole number of periods: arcs could not close a turn.
    """
    starts = round(section.lead / section.period)
    if abs(section.lead - starts * section.period) > 1e-6 * section.period:
        raise DesignError(
            f"The lead of a screw built of arcs must be a whole number of periods of {section.period * 1e3:.6g} mm; "
            f"got {section.lead * 1e3:.6g} mm."
        )
    # A continuous helix has no wave but its own, and arcs share those whose m N agree.
    shared = lcm(inner.per_turn, outer.per_turn) if inner and outer else 0
    found = []
    for order in orders:
        for step in range(-reach, reach + 1) if shared else (0,):
            ripple = step * shared
            azimuthal = order * starts - ripple
            amplitude, phase = _pair(section, order, azimuthal, refinement)
            amplitude *= wave_weight(inner, azimuthal, ripple) * wave_weight(outer, azimuthal, ripple)
            transfer = azimuthal * section.period / (2 * pi * order)
            found.append(ArcHarmonic(order, azimuthal, ripple, amplitude, phase, transfer))
    return tuple(found)


def arc_force(
    harmonics: Sequence[ArcHarmonic], period: float, displacement: Floats | float, angle: Floats | float
) -> Floats:
    """(...) axial force (N) on the inner member, per period, at displacements x (m) along ζ and angles α (rad)."""
    return np.asarray(sum(_force(part, period, displacement, angle) for part in harmonics))


def arc_torque(
    harmonics: Sequence[ArcHarmonic], period: float, displacement: Floats | float, angle: Floats | float
) -> Floats:
    """(...) torque (N m) on the outer member, per period, at the same."""
    return np.asarray(sum(part.transfer * _force(part, period, displacement, angle) for part in harmonics))


def _force(part: ArcHarmonic, period: float, displacement: Floats | float, angle: Floats | float) -> Floats:
    k = 2 * np.pi * part.order / period
    return np.asarray(part.amplitude * np.sin(k * np.asarray(displacement) + part.ripple * angle + part.phase))


def _pair(section: HelicalSection, order: int, azimuthal: int, refinement: int) -> tuple[float, float]:
    """Amplitude (N) and phase of the force that one wave of continuous helices gives, from a quarter wave's fields."""
    layers = tuple(_wave(layer, order) for layer in section.layers)
    lead = azimuthal * section.period / order
    waves = replace(section, layers=layers, lead=lead, displacement=0.0)
    if not all(layer.magnets is None or layer.magnets.harmonic(order) for layer in layers):
        return 0.0, 0.0
    at_rest, apart = (
        force(solve(replace(waves, displacement=moved), refinement)) for moved in (0.0, section.period / (4 * order))
    )
    return float(np.hypot(at_rest, apart)), float(np.arctan2(at_rest, apart))


def _wave(layer: Layer, order: int) -> Layer:
    """A layer with one harmonic of its magnets, its iron linear."""
    if layer.curve is not None:
        return replace(layer, curve=None, permeability=layer.curve.maximum_permeability)
    if layer.magnets is None:
        return layer
    c = layer.magnets.harmonic(order)
    return replace(layer, magnets=Wave(abs(c), order, -float(np.angle(c)) / (2 * np.pi * order)))
