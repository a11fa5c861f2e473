"""Distorted magnetic poles found without a force sensor: the zero-force line x_d0 over the rotor's angle, (19)-(24).

The poles of a screw made of blocks do not lie where its pitch says. Where its force vanishes, x_d = h theta - x is not
zero but x_d0(theta). Run unloaded, forward and backward at one steady speed, the spring holds the friction alone, which
turns its sign with the direction, (21)-(23), so that

    x_d0 = (x_df + x_db)/2        (24),        friction = F_s((x_df - x_db)/2)

The first is the paper's; the second, half of the gap through the spring's law, it does not use. Both hold where the
mover's inertia asks for nothing, at a steady speed with the ringing of its start faded (48 Hz on the paper's actuator,
so a smooth start), and where x_d0 hangs on the angle alone: what hangs on the mover's position is found along with it,
as far as x = h theta, and stays out by x_d times its slope under load.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluxbore.design.dynamics.magnetic_spring import SpringLaw
from fluxbore.design.dynamics.motion_log import MotionLog
from fluxbore.design.errors import IdentificationError

Floats = NDArray[np.float64]

NODES_PER_TURN = 128
"""Averages of a 128th of a turn take 0.4 % off a ripple of six periods a turn, and hold some twenty samples each at
10 kHz and 10 mm/s, which average the encoders' counts out."""

STEADY = 0.1
"""Of the speed that half of a run has or exceeds: what is nearer to it counts as steady."""

SMOOTHED = 0.05
"""s, over which the speed is taken to judge that: more than one period of the ringing."""

ALIKE = 0.05
"""Of the forward speed, by which the backward one may differ: friction is (23) equal at equal speeds."""


@dataclass(frozen=True, slots=True, eq=False)
class PoleDistortion:
    """x_d0 (m), (nodes,), at the angles `first` + k `spacing` (rad): straight between them, level beyond the ends."""

    first: float
    spacing: float
    offset: Floats

    def __call__(self, angle: ArrayLike) -> Floats:
        """x_d0 (m) at angles (rad); the shape is kept."""
        place = np.clip((np.asarray(angle, dtype=np.float64) - self.first) / self.spacing, 0.0, len(self.offset) - 1)
        node = np.minimum(place.astype(np.intp), len(self.offset) - 2)
        return np.asarray(self.offset[node] + (place - node) * (self.offset[node + 1] - self.offset[node]))

    @property
    def last(self) -> float:
        return self.first + self.spacing * (len(self.offset) - 1)

    def covers(self, angle: ArrayLike) -> NDArray[np.bool_]:
        """Whether angles (rad) are within what was measured."""
        angles = np.asarray(angle, dtype=np.float64)
        return np.asarray((angles >= self.first) & (angles <= self.last))


def one_by_one(distortion: PoleDistortion) -> Callable[[float], float]:
    """The same for one angle (rad) at a time, ten times as quick there: for a control loop."""
    first, spacing = distortion.first, distortion.spacing
    offset = distortion.offset.tolist()
    last = len(offset) - 1

    def at(angle: float) -> float:
        place = min(max((angle - first) / spacing, 0.0), last)
        node = min(int(place), last - 1)
        return float(offset[node] + (place - node) * (offset[node + 1] - offset[node]))

    return at


@dataclass(frozen=True, slots=True, eq=False)
class Detection:
    """What the two runs tell: the distortion; half of the gap between them (m), (nodes,); their speed (rad/s)."""

    distortion: PoleDistortion
    half_gap: Floats
    speed: float

    def friction(self, law: SpringLaw) -> float:
        """The mover's friction (N) at that speed, by a spring's law."""
        return float(np.mean(law.force(self.half_gap)))


def detect_distortion(log: MotionLog, transfer_ratio: float, *, nodes_per_turn: int = NODES_PER_TURN) -> Detection:
    """x_d0 from a log that holds a run forward and one backward, unloaded, over the same angles.

    transfer_ratio : h (m/rad), of l_p itself: rounded to 8.19e-4 it drifts by 40 um over the stroke of the paper's
    actuator, which comes out as distortion.

    Raises IdentificationError where a run is missing, their speeds differ, or they leave angles out.
    """
    spacing = 2 * math.pi / nodes_per_turn
    speed = _smoothed_speed(log)
    runs = [_steady(log, speed, sense) for sense in (1, -1)]
    speeds = [float(np.median(np.abs(speed[run]))) for run in runs]
    if abs(speeds[0] - speeds[1]) > ALIKE * speeds[0]:
        raise IdentificationError(
            f"{log.source}: the runs forward and backward must be at speeds within {ALIKE * 100:g} % of one another, "
            f"so that friction cancels; got {speeds[0]:.4g} rad/s and {speeds[1]:.4g} rad/s."
        )
    ends = [(float(np.min(log.angle[run])), float(np.max(log.angle[run]))) for run in runs]
    low = math.ceil(max(first for first, _ in ends) / spacing + 0.5)
    high = math.floor(min(last for _, last in ends) / spacing - 0.5)
    if high - low < 1:
        raise IdentificationError(
            f"{log.source}: the runs forward and backward must share two {nodes_per_turn}ths of a turn or more; "
            f"they go from {ends[0][0]:.4g} rad to {ends[0][1]:.4g} rad and from {ends[1][0]:.4g} rad to "
            f"{ends[1][1]:.4g} rad."
        )
    displacement = transfer_ratio * log.angle - log.position
    forward, backward = (_means(log, run, displacement, spacing, low, high) for run in runs)
    found = PoleDistortion(low * spacing, spacing, (forward + backward) / 2)
    return Detection(found, (forward - backward) / 2, sum(speeds) / 2)


def _smoothed_speed(log: MotionLog) -> Floats:
    """(n,) rad/s over a window about each sample, shorter at the ends."""
    half = max(1, round(SMOOTHED / log.period / 2))
    rows = np.arange(len(log.angle))
    early, late = np.maximum(rows - half, 0), np.minimum(rows + half, len(rows) - 1)
    return np.asarray((log.angle[late] - log.angle[early]) / ((late - early) * log.period))


def _steady(log: MotionLog, speed: Floats, sense: int) -> NDArray[np.intp]:
    """The rows of a direction whose speed is steady."""
    along = sense * speed
    moving = along > STEADY * float(np.max(np.abs(speed)))
    if np.count_nonzero(moving) < 2:
        words = "forward" if sense > 0 else "backward"
        raise IdentificationError(f"{log.source} must hold a run forward and one backward; it has none {words}.")
    typical = float(np.median(along[moving]))
    return np.flatnonzero(np.abs(along - typical) <= STEADY * typical)


def _means(log: MotionLog, run: NDArray[np.intp], displacement: Floats, spacing: float, low: int, high: int) -> Floats:
    """The mean of x_d within half a spacing of each node."""
    if high - low + 1 > len(run):
        raise IdentificationError(
            f"{log.source}: both runs must have a sample within each {spacing:.3g} rad of their way; "
            f"one has {len(run)} for {high - low + 1} of them."
        )
    node = np.round(log.angle[run] / spacing).astype(np.intp) - low
    inside = (node >= 0) & (node <= high - low)
    count = np.bincount(node[inside], minlength=high - low + 1)
    if np.min(count) == 0:
        empty = (low + int(np.argmin(count))) * spacing
        raise IdentificationError(
            f"{log.source}: both runs must have a sample within each {spacing:.3g} rad of their way; "
            f"one has none about {empty:.4g} rad."
        )
    total = np.bincount(node[inside], weights=displacement[run][inside], minlength=high - low + 1)
    return np.asarray(total / count)
