"""What the pitch does to a magnetic lead screw: the same design with other pitches, by both routes."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, log

from fluxbore.design.errors import FluxboreError
from fluxbore.design.lead_screw_values import LeadScrewActuator
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.evaluation import Evaluation, Fidelity

PITCH = "actuator.pitch"

REACH = 0.4, 2.5
"""Least and largest pitch, of the design's."""

POINTS = 41
"""Of the analytic field's curve, in equal ratios."""

SOLVED = 5
"""Of them by finite elements, the ends among them, besides the design itself."""

NEAR = 0.02
"""Of the design's pitch; what is nearer is the design for the eye."""

STEPS = 40
"""Halvings of the ratio between a pitch that can be built and one that cannot."""


@dataclass(frozen=True, slots=True)
class PitchPoint:
    """One pitch (m) with the length of the rotor's poles that follows (m) and its figures."""

    pitch: float
    active_length: float
    evaluation: Evaluation


@dataclass(frozen=True, slots=True)
class PitchCurve:
    """Designs that differ from one another by their pitch, and by what follows from it.

    design : the design itself, by finite elements. network : by the analytic field, from the least pitch to the
    largest. fem : a few by finite elements. Designs without a result are left out.
    least, most : why no smaller or larger pitch can be built, a sentence; empty where the curve ends of itself.
    """

    design: PitchPoint
    network: tuple[PitchPoint, ...]
    fem: tuple[PitchPoint, ...]
    least: str
    most: str


def pitch_curve(spec: Spec, design: Evaluation) -> PitchCurve | None:
    """The figures over the pitch around the design's own; what the study holds stays, all else as it is given.

    None where the design has no figures.
    """
    if not design.ok:
        return None
    base = spec.for_study()
    own = spec.number(PITCH)
    low, least = _limit(base, own, own * REACH[0])
    high, most = _limit(base, own, own * REACH[1])
    if not high > low:
        return PitchCurve(_point(base, own, design), (), (), least, most)
    pitches = [low * exp(log(high / low) * i / (POINTS - 1)) for i in range(POINTS)]
    solved = [pitch for pitch in pitches[:: (POINTS - 1) // (SOLVED - 1)] if abs(pitch - own) > NEAR * own]
    network = _points(base, sorted({*pitches, own}), "network")
    return PitchCurve(_point(base, own, design), network, _points(base, solved, "fem"), least, most)


def _points(base: Spec, pitches: list[float], fidelity: Fidelity) -> tuple[PitchPoint, ...]:
    found = [(pitch, evaluate(base.with_values({PITCH: pitch}), fidelity)) for pitch in pitches]
    return tuple(_point(base, pitch, evaluation) for pitch, evaluation in found if evaluation.ok)


def _point(base: Spec, pitch: float, evaluation: Evaluation) -> PitchPoint:
    actuator: LeadScrewActuator = base.with_values({PITCH: pitch}).actuator
    return PitchPoint(pitch, actuator.shape.active_length, evaluation)


def _limit(base: Spec, own: float, end: float) -> tuple[float, str]:
    """The pitch nearest to `end` that can be built from the design's own on, and why none beyond."""
    reason = _obstacle(base, end)
    if not reason:
        return end, ""
    inside, outside = own, end
    for _ in range(STEPS):
        middle = (inside * outside) ** 0.5
        inside, outside = (inside, middle) if _obstacle(base, middle) else (middle, outside)
    # Well beyond the limit, so that its sentence does not name two numbers that look alike.
    beyond = float(f"{(outside * end) ** 0.5:.2g}")
    return inside, _obstacle(base, beyond) or reason


def _obstacle(base: Spec, pitch: float) -> str:
    """Why a pitch cannot be built, a sentence; empty where it can."""
    try:
        changed = base.with_values({PITCH: pitch})
        if changed.kind.check is not None:
            changed.kind.check(changed.values)
        _ = changed.actuator
    except FluxboreError as error:
        return str(error)
    return ""
