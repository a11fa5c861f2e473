"""Newton's method with the differential reluctivity and backtracking on the residual norm."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from fluxbore.fem.linear import Factor, SingularMatrixError
from fluxbore.fem.mesh import Floats

Status = Literal["converged", "stalled", "iteration limit", "singular matrix"]

SHORTEST_STEP = 2.0**-12
"""Of a full Newton step; shorter ones mean that the residual has met rounding, or that something is wrong."""


@dataclass(frozen=True, slots=True)
class Convergence:
    """How an iteration ended.

    residual : relative to the load. iterations : factorisations.
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
) -> tuple[Floats, Convergence, Factor | None]:
    """Solve residual(x) = 0 from ``start``.

    tangent : factorises d residual / dx, symmetric positive definite. scale : the norm that residuals are relative
    to; where it is zero, the first residual's.

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
        try:
            factor = tangent(x)
            step = factor.solve(-r)
        except SingularMatrixError:
            return x, Convergence("singular matrix", iteration, size / scale), factor
        length = 1.0
        while True:
            trial = x + length * step
            r_trial = residual(trial)
            size_trial = float(np.linalg.norm(r_trial))
            # A merit that must fall in proportion to the step (Armijo with 1e-4) keeps overshoot from passing.
            if size_trial <= (1 - 1e-4 * length) * size:
                break
            length /= 2
            if length < SHORTEST_STEP:
                return x, Convergence("stalled", iteration + 1, size / scale), factor
        x, r, size = trial, r_trial, size_trial
    status: Status = "converged" if size <= tolerance * scale else "iteration limit"
    return x, Convergence(status, max_iterations, size / scale), factor
