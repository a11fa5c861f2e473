"""Newton's method with the differential reluctivity and backtracking on the residual norm.

Where the tangent's solver iterates, a step need not be exact while it is far from the solution: each is solved to

    |r + K s| <= η |r| ,   η = 0.9 (|r| / |r before|)² ,

which keeps the order (Eisenstat and Walker 1996, choice 2).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, Protocol, runtime_checkable

import numpy as np

from fluxbore.fem.factors import Factor, SingularMatrixError
from fluxbore.fem.mesh import Floats

Status = Literal["converged", "stalled", "iteration limit", "singular matrix"]

SHORTEST_STEP = 2.0**-12
"""Of a full Newton step; shorter ones mean that the residual has met rounding, or that something is wrong."""

ROUGHEST = 0.1
"""η at most: rougher steps save little, since half of their cost is the tangent."""

FINEST = 1e-3
"""Of the tolerance: a step need not reduce the residual below it."""

NEAR = 100.0
"""Times the tolerance: a step that would leave less than this may be the last."""

FLAT = 0.5
"""Of the energy's slope along a step, where that is taken for the minimum."""


@runtime_checkable
class Iterative(Protocol):
    """A matrix that can be solved for less where less accuracy will do."""

    def within(self, right: Floats, tolerance: float) -> Floats:
        """x with |right − A x| <= tolerance |right|."""
        ...


def solved(factor: Factor, right: Floats, accuracy: float) -> Floats:
    """x (n, k) to this accuracy of its residual where the factor can do with less than all."""
    return factor.within(right, accuracy) if accuracy and isinstance(factor, Iterative) else factor.solve(right)


@dataclass(frozen=True, slots=True)
class Convergence:
    """How an iteration ended.

    residual : relative to the load. iterations : steps.
    """

    status: Status
    iterations: int
    residual: float

    @property
    def converged(self) -> bool:
        return self.status == "converged"

    def sentence(self) -> str:
        """What a person needs to know about a failure."""
        steps = "one step" if self.iterations == 1 else f"{self.iterations} steps"
        return (
            f"Newton's iteration ended with status '{self.status}' after {steps} "
            f"at a relative residual of {self.residual:.2e}."
        )


def newton(
    residual: Callable[[Floats], Floats],
    tangent: Callable[[Floats], Factor],
    start: Floats,
    scale: float,
    tolerance: float,
    max_iterations: int,
    forcing: float = ROUGHEST,
) -> tuple[Floats, Convergence, Factor | None]:
    """Solve residual(x) = 0 from ``start``.

    tangent : factorises d residual / dx, symmetric positive definite. scale : the norm that residuals are relative
    to; where it is zero, the first residual's. forcing : η of the first step; zero for a linear problem, which is
    then solved in one.

    Returns the last x, how it ended, and the last tangent's factor (None where the start was good enough); raises
    nothing for a failure.
    """
    x = start
    factor: Factor | None = None
    r = residual(x)
    size = float(np.linalg.norm(r))
    scale = scale or size or 1.0  # without a load, what a start brings along is the measure
    for iteration in range(max_iterations):
        if not np.isfinite(size):
            return x, Convergence("stalled", iteration, float("inf")), factor
        if size <= tolerance * scale:
            return x, Convergence("converged", iteration, size / scale), factor
        factor = None  # its memory, still in the cache, is the next one's
        try:
            factor = tangent(x)
            step = _step(factor, r, forcing, tolerance * scale / size)
        except SingularMatrixError:
            return x, Convergence("singular matrix", iteration, size / scale), factor
        found = _line_search(residual, x, r, step)
        if found is None:
            return x, Convergence("stalled", iteration + 1, size / scale), factor
        trial, r_trial = found
        size_trial = float(np.linalg.norm(r_trial))
        forcing = min(0.9 * (size_trial / size) ** 2, ROUGHEST)
        x, r, size = trial, r_trial, size_trial
    status: Status = "converged" if size <= tolerance * scale else "iteration limit"
    return x, Convergence(status, max_iterations, size / scale), factor


def _step(factor: Factor, r: Floats, forcing: float, goal: float) -> Floats:
    """s with |r + K s| <= η |r|; goal : of the residual, relative to r.

    One that may be the last is made as good as an exact one: the field's error is greater than the residual.
    """
    if not isinstance(factor, Iterative):
        return factor.solve(-r)
    finest = FINEST * goal
    return factor.within(-r, finest if forcing < NEAR * goal else max(forcing, finest))


def _line_search(
    residual: Callable[[Floats], Floats], x: Floats, r: Floats, step: Floats
) -> tuple[Floats, Floats] | None:
    """The next x and its residual; None where no step helps.

    The residual is the gradient of a convex energy, so its product with the step grows along the step, from a negative
    value through zero at the energy's minimum. The whole step is taken if it reduces the residual's norm, any other if
    it comes near that minimum: the norm, which knows nothing of the mesh, would allow only the shorter steps the finer
    the mesh is. Where rounding hides the slope, the norm decides again.
    """
    size, slope = float(np.linalg.norm(r)), float(r @ step)
    best: tuple[Floats, Floats] | None = None
    low, slope_low, high, slope_high, length = 0.0, slope, 1.0, 0.0, 1.0
    while high > SHORTEST_STEP and high - low > SHORTEST_STEP * high:
        trial = x + length * step
        r_trial = residual(trial)
        size_trial, slope_trial = float(np.linalg.norm(r_trial)), float(r_trial @ step)
        if slope < slope_trial and abs(slope_trial) <= FLAT * abs(slope):
            return trial, r_trial
        # A merit that must fall in proportion to the step (Armijo with 1e-4) keeps overshoot from passing.
        if size_trial <= (1 - 1e-4 * length) * size:
            if length == 1:
                return trial, r_trial
            best = best or (trial, r_trial)
        if slope < slope_trial < 0:
            if length == 1:  # the energy falls all the way, and the next step goes on from there
                return trial, r_trial
            low, slope_low = length, slope_trial
        else:
            high, slope_high = length, slope_trial
        share = -slope_low / (slope_high - slope_low) if slope_high > 0 else 0.5
        length = low + min(max(share, 0.1), 0.5) * (high - low)
    return best
