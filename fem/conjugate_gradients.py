"""The method of conjugate gradients with a preconditioner (Hestenes and Stiefel 1952)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

FAIR_TRIAL = 4
"""Iterations before the rate is judged: the first ones say little of it."""


@dataclass(frozen=True, slots=True, eq=False)
class Iterated:
    """x : (n,) the last iterate. residual : (n,) of it. iterations : made. reached : whether the tolerance holds.

    definite : False where a direction has shown that matrix or preconditioner is not positive definite.
    """

    x: Floats
    residual: Floats
    iterations: int
    reached: bool
    definite: bool = True


def conjugate_gradients(
    multiply: Callable[[Floats], Floats],
    precondition: Callable[[Floats], Floats],
    right: Floats,
    tolerance: float,
    limit: int,
    prospects: bool = False,
) -> Iterated:
    """x with |right − A x| <= tolerance |right|, from zero.

    right : (n,). limit : iterations at most. prospects : whether to end early where the rate so far, kept up, would
    not reach the tolerance within the limit.
    """
    x = np.zeros(right.size)
    r = np.array(right, dtype=float)
    first = float(np.linalg.norm(r))
    goal = tolerance * first
    direction, before = x, 1.0
    for iteration in range(limit):
        size = float(np.linalg.norm(r))
        if size <= goal:
            return Iterated(x, r, iteration, True)
        if prospects and iteration >= FAIR_TRIAL and not (size / first) ** (limit / iteration) <= tolerance:
            return Iterated(x, r, iteration, False)
        z = precondition(r)
        now = float(r @ z)
        direction = z if iteration == 0 else z + (now / before) * direction
        image = multiply(direction)
        curvature = float(direction @ image)
        if not (now > 0 and curvature > 0):
            return Iterated(x, r, iteration, False, False)
        step = now / curvature
        x = x + step * direction
        r = r - step * image
        before = now
    return Iterated(x, r, limit, float(np.linalg.norm(r)) <= goal)
