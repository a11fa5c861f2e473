"""The force of a magnetic lead screw's spring and of its load, from the two encoders: equations (20) and (25)-(29).

    x_dn = h theta - x - x_d0(theta)        (20)
    F_s  = law(x_dn), or with memory F_stall (w sin(x_dn/h) + (1 - w) sin(x_s/h)), x_s by x_dn   (25), (26)

and the load's force by `load_observer`. Every part of the paper's method can be left out or replaced: the law by the
linear or a polynomial one, its memory, the distortion x_d0.

One thing is added, and left out unless asked for: `play` between x_dn and the memory, of one count of the encoders.

`estimate` goes on by one sample, for a control loop; `estimate_record` takes a log at once. They agree to rounding.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluxbore.design.dynamics.bouc_wen import advance, states
from fluxbore.design.dynamics.load_observer import LoadObserver, Observed, at_rest, observe, observe_record
from fluxbore.design.dynamics.magnetic_hysteresis import HysteresisSpring
from fluxbore.design.dynamics.magnetic_spring import SpringLaw
from fluxbore.design.dynamics.motion_log import MotionLog
from fluxbore.design.dynamics.play import follow, follow_record
from fluxbore.design.dynamics.pole_distortion import PoleDistortion
from fluxbore.design.errors import DesignError, MeasurementError
from fluxbore.design.units import format_quantity

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class ForceEstimator:
    """spring : law, or law with memory. transfer_ratio : h (m/rad). observer : of the load. distortion : x_d0, or None
    for poles that lie where the pitch says; beyond the angles it knows it stays at its last value. play : of x_dn (m)
    before it moves the memory, one count of the encoders to keep their counts out of it; zero in the paper.

    Raises DesignError for a play below zero.
    """

    spring: SpringLaw | HysteresisSpring
    transfer_ratio: float
    observer: LoadObserver
    distortion: PoleDistortion | None = None
    play: float = 0.0

    def __post_init__(self) -> None:
        if not 0 <= self.play < math.inf:
            got = format_quantity(self.play, "length", 6)
            raise DesignError(f"The play of a force estimator must be finite and 0 mm or above; got {got}.")


class Estimated(NamedTuple):
    """After a sample: x_dn behind its play (m), x_s (m), what the load's observer keeps; the forces (N) of the spring
    and of the load."""

    followed: float
    memory: float
    observed: Observed
    spring_force: float
    load_force: float


def first_estimate(estimator: ForceEstimator, angle: float, position: float, memory: float = 0.0) -> Estimated:
    """At the first sample, angle (rad) and position (m), at rest. memory : x_s (m) there."""
    x_dn = float(displacements(estimator, angle, position))
    spring = estimator.spring
    force = float(spring.at(x_dn, memory) if isinstance(spring, HysteresisSpring) else spring.force(x_dn))
    return Estimated(x_dn, memory, at_rest(force, position), force, force)


def estimate(estimator: ForceEstimator, before: Estimated, angle: float, position: float) -> Estimated:
    """One sample on: angle (rad), position (m)."""
    x_dn, memory = float(displacements(estimator, angle, position)), before.memory
    followed = follow(before.followed, x_dn, estimator.play)
    if isinstance(estimator.spring, HysteresisSpring):
        memory = advance(estimator.spring.memory, memory, followed - before.followed)
        force = float(estimator.spring.at(x_dn, memory))
    else:
        force = float(estimator.spring.force(x_dn))
    observed, load = observe(estimator.observer, before.observed, force, position)
    return Estimated(followed, memory, observed, force, load)


@dataclass(frozen=True, slots=True, eq=False)
class EstimatedRecord:
    """Over a log: the spring's and the load's force (N), (n,) each."""

    spring_force: Floats
    load_force: Floats


def estimate_record(
    estimator: ForceEstimator, angle: ArrayLike, position: ArrayLike, memory: float = 0.0
) -> EstimatedRecord:
    """The same over (n,) angles (rad) and positions (m), a period of the observer apart, from rest."""
    x_dn = displacements(estimator, angle, position)
    spring = estimator.spring
    if isinstance(spring, HysteresisSpring):
        force = spring.at(x_dn, states(spring.memory, follow_record(x_dn, estimator.play), memory))
    else:
        force = spring.force(x_dn)
    return EstimatedRecord(force, observe_record(estimator.observer, force, position))


def estimate_log(estimator: ForceEstimator, log: MotionLog, memory: float = 0.0) -> EstimatedRecord:
    """The same over a log from a file, checked against the estimator.

    Raises MeasurementError for another period, or for angles whose distortion is not known.
    """
    period = estimator.observer.period
    if abs(log.period - period) > 0.01 * period:
        raise MeasurementError(f"{log.source} must have the observer's period of {period:g} s; got {log.period:g} s.")
    known = estimator.distortion
    if known is not None and not np.all(known.covers(log.angle)):
        worst = float(log.angle[int(np.argmin(known.covers(log.angle)))])
        raise MeasurementError(
            f"{log.source}: angle must be from {known.first:.4g} rad to {known.last:.4g} rad, where the distortion of "
            f"the poles is known; got {worst:.4g} rad."
        )
    return estimate_record(estimator, log.angle, log.position, memory)


def displacements(estimator: ForceEstimator, angle: ArrayLike, position: ArrayLike) -> Floats:
    """x_dn (m), (20), at angles (rad) and positions (m); they broadcast."""
    theta = np.asarray(angle, dtype=np.float64)
    x_d = estimator.transfer_ratio * theta - np.asarray(position, dtype=np.float64)
    return np.asarray(x_d if estimator.distortion is None else x_d - estimator.distortion(theta))
