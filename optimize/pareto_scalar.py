"""One point of a front as a problem with one objective: epsilon constraint and normal boundary intersection.

Both losses are scaled to the front's ends: u is 0 at the best of the first objective and 1 at the other end, v the
other way round, so that the straight line between the ends (Das and Dennis's convex hull of individual minima) is
u + v = 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from fluxbore.design.study import Objective
from fluxbore.optimize.gradient_search import View
from fluxbore.optimize.outcome import Candidate
from fluxbore.optimize.problem import Point


@dataclass(frozen=True, slots=True)
class Seen:
    """A design in plain numbers: u and v, the misses of the study's limits, their gradients by the scaled variables.

    losses : (2,). misses : (limits,). slopes : (2, variables), None without gradients.
    miss_slopes : (limits, variables).
    """

    losses: tuple[float, float]
    misses: tuple[float, ...]
    slopes: tuple[tuple[float, ...], tuple[float, ...]] | None = None
    miss_slopes: tuple[tuple[float, ...], ...] = ()


@dataclass(frozen=True, slots=True)
class Row:
    """A linear form of the two scaled losses and the slack:  first u + second v + slack t + constant."""

    first: float
    second: float
    slack: float = 0.0
    constant: float = 0.0

    def at(self, u: float, v: float, t: float) -> float:
        return self.first * u + self.second * v + self.slack * t + self.constant


@dataclass(frozen=True, slots=True)
class Scalarisation:
    """Minimise ``loss`` with every row of ``rows`` <= 0.

    lifted : whether the slack t is a variable of the problem, from -1 to 1, to be made as large as the rows let it be.
    """

    loss: Row
    rows: tuple[Row, ...] = ()
    lifted: bool = False

    def slack(self, u: float, v: float) -> float:
        """The largest t that the rows allow at these losses; 0 where t is no variable."""
        return min(-row.at(u, v, 0.0) / row.slack for row in self.rows) if self.lifted else 0.0

    def score(self, u: float, v: float) -> tuple[float, float]:
        """The worst miss of the rows (0 where they hold) and the loss; smaller is better."""
        t = self.slack(u, v)
        return max([0.0, *(row.at(u, v, t) for row in self.rows)]), self.loss.at(u, v, t)

    def begin(self, seen: Seen) -> Point:
        """The slack at a start, as a variable from 0 to 1; nothing where it is none."""
        t = self.slack(*seen.losses)
        return (min(max((t + 1) / 2, 0.0), 1.0),) if self.lifted else ()

    def view(self, seen: Seen, slack: Sequence[float]) -> View:
        """The problem at a design: rows and the study's limits are its misses; without gradients, slopes are empty.

        slack : as of `begin`; its variable is the last one of the slopes.
        """
        (u, v), t = seen.losses, 2 * slack[0] - 1 if self.lifted else 0.0
        loss, misses = self.loss.at(u, v, t), (*(row.at(u, v, t) for row in self.rows), *seen.misses)
        if seen.slopes is None:
            return View(loss, misses, (), ())
        extra = 1 if self.lifted else 0
        by_u, by_v = seen.slopes

        def slope(row: Row) -> tuple[float, ...]:
            own = tuple(row.first * a + row.second * b for a, b in zip(by_u, by_v, strict=True))
            return (*own, *(2 * row.slack,) * extra)

        studys = tuple((*row, *(0.0,) * extra) for row in seen.miss_slopes)
        return View(loss, misses, slope(self.loss), (*(slope(row) for row in self.rows), *studys))


def best_of(which: int, other_at_most: float | None = None) -> Scalarisation:
    """The least of one loss (0: u, 1: v), the other held to a bound: the epsilon constraint (Haimes et al. 1971)."""
    loss, other = (Row(1.0, 0.0), Row(0.0, 1.0)) if which == 0 else (Row(0.0, 1.0), Row(1.0, 0.0))
    if other_at_most is None:
        return Scalarisation(loss)
    return Scalarisation(loss, (Row(other.first, other.second, constant=-other_at_most),))


def boundary_intersection(position: float) -> Scalarisation:
    """As far as the feasible region goes along the quasi-normal from a point of the line between the ends.

    maximise t  with  u <= position - t,  v <= 1 - position - t

    I. Das and J. E. Dennis, SIAM J. Optim. 8 (1998) 631, eq. (NBI_beta), with the quasi-normal -(1, 1); its equations
    are inequalities here, so that no solution is dominated by another one along the normal, where the equations would
    also give points in the folds of a front that is not convex.
    """
    rows = (Row(1.0, 0.0, 1.0, -position), Row(0.0, 1.0, 1.0, position - 1.0))
    return Scalarisation(Row(0.0, 0.0, -1.0), rows, lifted=True)


@dataclass(frozen=True, slots=True)
class Scale:
    """The two figures as losses: (sign x figure - origin)/span, smaller is better.

    origin, span : of the signed figures (SI).
    """

    objectives: tuple[Objective, Objective]
    origin: tuple[float, float] = (0.0, 0.0)
    span: tuple[float, float] = (1.0, 1.0)

    @property
    def signs(self) -> tuple[float, float]:
        first, second = (-1.0 if objective.maximise else 1.0 for objective in self.objectives)
        return first, second

    def figures(self, design: Candidate) -> tuple[float, float] | None:
        """The design's two figures (SI); None where it has not both."""
        if not design.evaluation.ok:
            return None
        first, second = (getattr(design.evaluation.performance, item.figure) for item in self.objectives)
        return None if first is None or second is None else (float(first), float(second))

    def losses(self, design: Candidate) -> tuple[float, float] | None:
        """The design's u and v; None where it has not both figures."""
        figures = self.figures(design)
        return None if figures is None else self.scaled(figures)

    def scaled(self, figures: Sequence[float]) -> tuple[float, float]:
        u, v = (
            (sign * figure - origin) / span
            for figure, sign, origin, span in zip(figures, self.signs, self.origin, self.span, strict=True)
        )
        return u, v

    def figure(self, which: int, loss: float) -> float:
        """The figure (SI) that has this loss."""
        return self.signs[which] * (self.origin[which] + self.span[which] * loss)
