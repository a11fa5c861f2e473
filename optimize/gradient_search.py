"""One run of a gradient search of NLopt (SLSQP, MMA, CCSAQ) on a problem in plain numbers.

Sources: SLSQP: Kraft (1994), ACM Trans. Math. Softw. 20, 262; MMA and CCSAQ: Svanberg (2002), SIAM J. Optim. 12, 555.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from fluxbore.optimize.nlopt_loop import PENALTY, Ending, run
from fluxbore.optimize.problem import Point

_NAMES = {"SLSQP": "LD_SLSQP", "MMA": "LD_MMA", "CCSAQ": "LD_CCSAQ"}

NO_START = "The gradient search had no sound design to start from."


@dataclass(frozen=True, slots=True)
class View:
    """The problem at one point x of n variables: what to minimise, what must not be positive, and their derivatives.

    loss : number. misses : (k,). slope : (n,) d loss / d x. miss_slopes : (k, n) d misses / d x. Finite, always.
    """

    loss: float
    misses: tuple[float, ...]
    slope: tuple[float, ...]
    miss_slopes: tuple[tuple[float, ...], ...]


Function = Callable[[Point], View | None]
"""Point -> what is there; None where there is nothing, such as a design that cannot be built."""


def minimise(
    function: Function,
    start: Sequence[float],
    lower: Sequence[float],
    upper: Sequence[float],
    *,
    algorithm: str = "SLSQP",
    objective_tolerance: float = 1e-6,
    variable_tolerance: float = 1e-6,
    miss_tolerance: float = 1e-8,
    calls: int = 500,
    asked_tolerance: float | None = None,
) -> Ending:
    """Let NLopt look for the smallest loss between the bounds; whoever calls keeps the points that ``function`` saw.

    start, lower, upper : (n,), scaled so that a step of 0.1 is worth while and losses and misses are near 1 in size.
    objective_tolerance : relative. variable_tolerance : absolute. calls : of the function. miss_tolerance : a miss that
    the stop rule overlooks: from outside a limit is reached in the limit only. Whoever must not miss at all adds as
    much to his misses. asked_tolerance : of the objective, the one that the sentence names where whoever calls stops
    at a tighter one than was asked of him.

    What ``function`` raises (a used-up budget, Ctrl-C) ends the run and stands in `Ending.stopped_by`. A point at which
    it gives None is seen as a smooth bowl around the best sound point, above it in loss and misses alike: line searches
    and conservative models turn back from it. Without a sound start there is no run, and the reason is `NO_START`.
    """
    import nlopt
    import numpy as np

    low, high = np.asarray(lower, dtype=float), np.asarray(upper, dtype=float)
    origin = np.clip(np.asarray(start, dtype=float), low, high)
    seen = _Seen(function, lambda: nlopt.ForcedStop())
    try:
        first = seen(origin)
    except nlopt.ForcedStop:
        return Ending("The search was stopped.", seen.stopped[0])
    if first is None:
        return Ending(NO_START)

    def loss(x: Any, gradient: Any) -> float:
        view = seen.finite(x)
        if gradient.size:
            gradient[:] = view.slope
        return view.loss

    def misses(result: Any, x: Any, gradient: Any) -> None:
        view = seen.finite(x)
        result[:] = view.misses
        if gradient.size:
            gradient[:] = view.miss_slopes

    opt = nlopt.opt(getattr(nlopt, _NAMES[algorithm]), len(origin))
    opt.set_lower_bounds(low)
    opt.set_upper_bounds(high)
    opt.set_ftol_rel(objective_tolerance)
    opt.set_xtol_abs(variable_tolerance)
    opt.set_maxeval(calls)
    opt.set_min_objective(loss)
    if first.misses:
        opt.add_inequality_mconstraint(misses, np.full(len(first.misses), miss_tolerance))
    return run(opt, origin, seen.stopped, asked_tolerance or objective_tolerance, variable_tolerance)


class _Seen:
    """The function as NLopt's C code may call it: one call for a point, no exception but NLopt's own, no gaps."""

    def __init__(self, function: Function, stop: Callable[[], BaseException]) -> None:
        self._function, self._stop = function, stop
        self.stopped: list[BaseException] = []
        self._latest: tuple[Point, View | None] | None = None
        self._best: tuple[Point, View] | None = None

    def __call__(self, x: Any) -> View | None:
        point = tuple(float(value) for value in x)
        if self._latest is None or self._latest[0] != point:
            try:
                view = self._function(point)
            except BaseException as error:
                self.stopped.append(error)
                raise self._stop() from None
            self._latest = point, view
            if view is not None and (self._best is None or _merit(view) < _merit(self._best[1])):
                self._best = point, view
        return self._latest[1]

    def finite(self, x: Any) -> View:
        """The view at ``x``, or the bowl |x - best|^2 on top of the best sound point where there is none."""
        view = self(x)
        if view is not None:
            return view
        assert self._best is not None
        centre, best = self._best
        offset = [float(value) - c for value, c in zip(x, centre, strict=True)]
        rise, slope = sum(d * d for d in offset), tuple(2 * d for d in offset)
        return View(best.loss + rise, tuple(m + rise for m in best.misses), slope, (slope,) * len(best.misses))


def _merit(view: View) -> float:
    return view.loss + PENALTY * sum(max(miss, 0.0) for miss in view.misses)
