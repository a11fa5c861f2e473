"""The last steps of a search: quadratic models of what was seen around the incumbent, and their optimum, evaluated.

COBYLA closes in on an optimum with linear models, from either side of a limit and at a linear rate. The designs it has
asked for determine quadratic models almost for nothing; a few designs at the models' optimum (Powell's idea
behind BOBYQA, with the limits modelled as well) do what a dozen smaller simplices would.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import combinations_with_replacement
from typing import Any

from fluxbore.optimize.archive import Archive
from fluxbore.optimize.nlopt_loop import minimise
from fluxbore.optimize.outcome import Limit
from fluxbore.optimize.problem import Merit, Point, violation

STEPS = 4
"""Designs that polishing may ask for."""

NEAR = 0.02
"""The models are trusted at least this far from the incumbent, of each variable's range."""


def polish(archive: Archive, merit: Merit, held: Sequence[Limit], back_off: float, tolerance: float) -> None:
    """Ask for up to `STEPS` designs, each where quadratic models of the nearest designs have their optimum.

    held : the limits to model; back_off : the room to leave to them; tolerance : the least gain (relative loss) that is
    worth another design. Raises BudgetUsedError. What is found stands in the archive.
    """
    trust = 1.0
    for _ in range(STEPS):
        before = archive.best
        point = _model_optimum(archive, merit, held, back_off, tolerance, trust)
        if point is None or archive.knows(point):
            return
        archive.at(point)
        if archive.best is before:
            trust /= 3  # the models promised too much that far out


def _model_optimum(
    archive: Archive, merit: Merit, held: Sequence[Limit], back_off: float, tolerance: float, trust: float
) -> Point | None:
    import numpy as np

    seen = [
        (point, loss, merit.misses(made, held))
        for point, made in archive.points
        if (loss := merit.loss(made)) is not None and not math.isinf(violation(made))
    ]
    if not seen:
        return None
    best = archive.best
    centre, loss, _ = (
        min(seen, key=lambda item: (max(item[2], default=0.0), item[1]))
        if best is None
        else next(item for item in seen if item[0] == archive.box.point(best.values))
    )
    size = len(centre)
    terms = (size + 1) * (size + 2) // 2
    near = sorted(seen, key=lambda item: _distance(item[0], centre))[: 2 * terms]
    if len(near) < terms:
        return None
    radius = max(_distance(near[-1][0], centre), NEAR)
    # Far designs say less about the curvature here than near ones.
    weights = np.array([1 / (1 + (_distance(point, centre) / radius) ** 2) for point, _, _ in near])
    local = np.array([[(x - c) / radius for x, c in zip(point, centre, strict=True)] for point, _, _ in near])
    targets = np.array([[loss, *misses] for _, loss, misses in near])
    models, *_ = np.linalg.lstsq(_monomials(local) * weights[:, None], targets * weights[:, None], rcond=1e-8)

    low = [max(c - trust * radius, 0.0) for c in centre]
    high = [min(c + trust * radius, 1.0) for c in centre]
    optimum: list[tuple[float, Point]] = []

    def place(u: Point) -> Point:
        return archive.box.tidy([a + x * (b - a) for x, a, b in zip(u, low, high, strict=True)])

    def model(u: Point) -> tuple[float, tuple[float, ...]]:
        point = place(u)
        offset = np.array([[(x - c) / radius for x, c in zip(point, centre, strict=True)]])
        predicted = (_monomials(offset) @ models)[0]
        misses = tuple(float(value) + back_off for value in predicted[1:])
        if all(miss <= 0 for miss in misses) and (not optimum or predicted[0] < optimum[0][0]):
            optimum[:] = [(float(predicted[0]), point)]
        return float(predicted[0]), misses

    start = tuple(min(max((c - a) / ((b - a) or 1.0), 0.0), 1.0) for c, a, b in zip(centre, low, high, strict=True))
    minimise(
        "COBYLA",
        model,
        len(held),
        start,
        step=0.25,
        objective_tolerance=1e-12,
        variable_tolerance=1e-6,
        seed=1,
        calls=1000,
    )
    if not optimum or (best is not None and optimum[0][0] > loss - tolerance):
        return None
    return optimum[0][1]


def _distance(one: Point, other: Point) -> float:
    return max(abs(a - b) for a, b in zip(one, other, strict=True))


def _monomials(x: Any) -> Any:
    """1, x_i and x_i x_j of the rows of ``x``: (m, n) -> (m, (n + 1)(n + 2)/2)."""
    import numpy as np

    count, size = x.shape
    pairs = [x[:, i] * x[:, j] for i, j in combinations_with_replacement(range(size), 2)]
    return np.column_stack([np.ones(count), x, *pairs])
