"""The iterations of the mapping: an iterate, its slopes, a trust region, and all designs that tell of them."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from fluxbore.design.performance import FIGURES
from fluxbore.optimize.archive import Archive
from fluxbore.optimize.gradient_search import View
from fluxbore.optimize.optimality import multipliers
from fluxbore.optimize.outcome import Candidate, Limit
from fluxbore.optimize.problem import FEASIBILITY, Merit, Point
from fluxbore.optimize.space_mapping_network import Coarse
from fluxbore.optimize.space_mapping_response import Array, response
from fluxbore.optimize.space_mapping_step import Step, best_step, merit_value, worst_miss
from fluxbore.optimize.space_mapping_surrogate import MEMORY, Sample, Surrogate, ratio, surrogate

FIRST_RADIUS = 0.25
"""Of the trust region, of each variable's range; a step is at most this long in each of them."""

SMALLEST_RADIUS = 1e-6

REFERENCE_RADIUS = 0.05
"""Gains are judged over at least this far: a small trust region must not pass for an optimum."""

FIRST_PENALTY = 10.0

CONFIRMED, GOOD = 0.05, 0.75
"""Shares of the expected gain: less does not count as a step; more widens the trust region."""

DIFFERENCE = 1e-3
"""Step (of the range) of the finite elements' own differences, where a model brings no slopes."""

NEAR = 10 * DIFFERENCE
"""Slopes measured within this distance need no new measurement, unless the first-order conditions do not hold."""


@dataclass(slots=True)
class Mapping:
    """The state of one run: the iterate ``centre``, its slopes, the trust region, and all samples.

    given_up : radius of the trust region before designs failed. measured : where the estimated slopes were last
    measured by differences.
    """

    archive: Archive
    merit: Merit
    held: tuple[Limit, ...]
    coarse: Coarse
    tolerance: float
    room: float
    centre: Sample | None = None
    jacobian: Array = None
    samples: list[Sample] = field(default_factory=list)
    radius: float = FIRST_RADIUS
    given_up: float = 0.0
    penalty: float = FIRST_PENALTY
    steps: int = 0
    measured: Array = None
    exact: bool = True

    def run(self, start: Point) -> tuple[str, bool]:
        """Step until nothing more is to be gained; returns the ending without its full stop, and if it converged."""
        if not self.begin(start):
            return "The mapping could not begin: no design that it may start from has all figures", False
        while True:
            assert self.centre is not None
            model = surrogate(self.coarse, self.samples, self.centre, self.jacobian)
            step = best_step(model, self.archive.box, self.radius, self.penalty, self.room)
            self.penalty = step.penalty
            gain = self.gain(step)
            settled = self.promise(model, gain) <= self.worth
            if not settled and gain > 0 and self.radius >= SMALLEST_RADIUS:
                self.take(model, step, gain)
            elif self.measured_within(0.0) or (self.measured_within(NEAR) and self.residual() <= self.small):
                return self.ending(settled)
            else:
                self.measure()

    def begin(self, start: Point) -> bool:
        """Take the start, or the best design known, for the first iterate."""
        origin = self.archive.box.tidy(start)
        others = sorted((math.dist(point, origin), point) for point, _ in self.archive.points if point != origin)
        first = self.sample(origin, self.archive.at(origin))
        known = [self.sample(point, self.archive.at(point)) for _, point in others[: MEMORY * len(origin)]]
        self.samples = [item for item in known if item is not None]
        if first is None and self.samples:
            first = min(self.samples, key=lambda item: self.merit_of(item.fine.values))
        if first is None:
            return False
        self.samples.append(first)
        self.centre = first
        self.jacobian = self.known_slopes(first, np.array([self.network_slopes(row) for row in range(self.rows)]))
        return True

    @property
    def rows(self) -> int:
        return 1 + len(self.held)

    def network_slopes(self, row: int) -> Array:
        assert self.centre is not None
        a = ratio(self.centre, row)
        if a == 0.0 or self.centre.coarse is None:
            return np.zeros(self.centre.x.size)
        return a * self.centre.coarse.slopes[row]

    def known_slopes(self, item: Sample, estimate: Array) -> Array:
        """The design's own slopes, and the estimate where it brings none."""
        known = np.isfinite(item.fine.slopes).all(axis=1)
        self.exact = bool(known.all())
        return np.where(known[:, None], item.fine.slopes, estimate)

    def sample(self, point: Point, made: Candidate) -> Sample | None:
        fine = response(made, self.merit, self.held, self.archive.box)
        if fine is None or not fine.complete:
            return None
        x = np.array(self.archive.box.tidy(point))
        coarse = self.coarse.with_slopes(x)
        if coarse is not None:  # a key that follows from the variables is the same by either route
            keys = [row for row, limit in enumerate(self.held, 1) if limit.subject not in FIGURES]
            fine.slopes[keys] = coarse.slopes[keys]
        return Sample(x, fine, coarse)

    def merit_of(self, values: Array) -> float:
        return merit_value(values, self.penalty, self.room)

    def measured_within(self, reach: float) -> bool:
        """Whether the slopes are the model's own or were measured no farther away than this."""
        assert self.centre is not None
        if self.exact:
            return True
        return self.measured is not None and float(np.abs(self.measured - self.centre.x).max()) <= reach

    def gain(self, step: Step) -> float:
        """What the surrogate expects of a step."""
        assert self.centre is not None
        return self.merit_of(self.centre.fine.values) - self.merit_of(step.expected)

    def promise(self, model: Surrogate, gain: float) -> float:
        """What it expects within `REFERENCE_RADIUS` at least, ``gain`` being what it expects of the trust region."""
        if self.radius >= REFERENCE_RADIUS:
            return gain
        return max(gain, self.gain(best_step(model, self.archive.box, REFERENCE_RADIUS, self.penalty, self.room)))

    @property
    def worth(self) -> float:
        """The least gain that is worth a design: a tenth of the tolerance.

        A thousandth of that where the model's own slopes say that the first-order conditions can be had more exactly,
        and the surrogate has proved good enough to say where.
        """
        least = self.tolerance / 10
        refine = self.exact and self.radius >= REFERENCE_RADIUS and self.residual() > 10 * self.tolerance
        return least / 1000 if refine else least

    @property
    def small(self) -> float:
        """What the first-order conditions may be off by.

        A residual r along which the loss bends by k promises a gain of r²/2k: with k = 10, less than half of what is
        worth a design. Measured slopes are themselves no better than their step.
        """
        return 3 * max(math.sqrt(self.tolerance / 10), 0.0 if self.exact else DIFFERENCE)

    def ending(self, settled: bool) -> tuple[str, bool]:
        """What is to be said where no further step is tried. settled : no gain worth a design is promised."""
        assert self.centre is not None
        missed = worst_miss(self.centre.fine.values, 0.0)
        if missed > FEASIBILITY:
            words = f"the worst is missed by {missed:.2g} of its size"
            return f"The mapping ended where no step brings the limits nearer: {words}", False
        if not settled or self.residual() > self.small:
            return "The mapping stopped: the finite elements confirm no step, however short", False
        reach = max(self.radius, REFERENCE_RADIUS)
        return (
            f"The mapping converged: within {reach:.0%} of the ranges less than {self.tolerance / 10:.0e} of the "
            "objective is to be gained"
        ), True

    def take(self, model: Surrogate, step: Step, gain: float) -> None:
        """Ask the finite elements for the step, and learn from what they say."""
        assert self.centre is not None
        point = self.archive.box.tidy(step.x)
        move = step.x - self.centre.x
        length = float(np.abs(move).max())
        found = self.sample(point, self.archive.at(point))
        if found is None:  # no figures there: nearer, then
            self.given_up = max(self.given_up, self.radius)
            self.radius = 0.5 * length
            return
        self.samples.append(found)
        share = (self.merit_of(self.centre.fine.values) - self.merit_of(found.fine.values)) / gain
        miss = found.fine.values - step.expected
        learnt = np.outer(miss, move) / float(move @ move)
        if share >= CONFIRMED:
            self.jacobian = self.known_slopes(found, model.slopes_at(step.x) + learnt)
            self.centre = found
            self.steps += 1
        elif not self.measured_within(0.0):
            self.jacobian = self.known_slopes(self.centre, self.jacobian + learnt)
        if share < 0.25:
            self.radius = 0.5 * length
            if share < CONFIRMED and not self.measured_within(NEAR):
                self.measure()
        elif share > GOOD and length >= 0.9 * self.radius:
            # Failures say nothing against the surrogate: half of what they took (in orders of magnitude) comes back.
            self.radius = min(max(2 * self.radius, math.sqrt(self.radius * self.given_up)), 1.0)
            self.given_up = 0.0

    def measure(self) -> None:
        """Measure the slopes that no model brings by differences of the finite elements, side by side.

        Only the part that the network leaves is differenced, so that the step's own error is that part's.
        """
        assert self.centre is not None
        x, size = self.centre.x, self.centre.x.size
        steps = [DIFFERENCE if value <= 0.5 else -DIFFERENCE for value in x]
        points = [self.archive.box.tidy(x + step * np.eye(size)[i]) for i, step in enumerate(steps)]
        self.archive.evaluate([self.archive.box.values(point) for point in points])
        estimate = self.jacobian.copy()
        for i, point in enumerate(points):
            there = self.sample(point, self.archive.at(point))
            if there is not None:
                estimate[:, i] = self.difference(there, i)
                self.samples.append(there)
        self.measured = x
        self.radius = max(self.radius, NEAR)  # it shrank for want of these slopes
        self.jacobian = self.known_slopes(self.centre, estimate)
        # As good as the model's own for what they say of the curvature.
        known = replace(self.centre, fine=replace(self.centre.fine, slopes=self.jacobian))
        self.samples = [known if item is self.centre else item for item in self.samples]
        self.centre = known

    def difference(self, there: Sample, i: int) -> Array:
        assert self.centre is not None
        change = there.fine.values - self.centre.fine.values
        step = there.x[i] - self.centre.x[i]
        if there.coarse is None or self.centre.coarse is None:
            return change / step
        a = np.array([ratio(self.centre, row) for row in range(self.rows)])
        network = np.nan_to_num(there.coarse.values - self.centre.coarse.values)
        return (change - a * network) / step + a * np.nan_to_num(self.centre.coarse.slopes[:, i])

    def residual(self) -> float:
        """Of the first-order conditions at the iterate, see `fluxbore.optimize.optimality.residual`."""
        assert self.centre is not None
        loss, *misses = (float(value) for value in self.centre.fine.values)
        slope, *rows = (tuple(row) for row in self.jacobian)
        return multipliers(View(loss, tuple(misses), slope, tuple(rows)), tuple(self.centre.x))[1]
