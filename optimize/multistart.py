"""Gradient searches from many places: multi-level single linkage (Rinnooy Kan and Timmer 1987, Math. Prog. 39, 57).

Samples are evaluated side by side; a local search begins at each that has no better sample, and no optimum that is
known, within a critical distance that shrinks as samples are added. More follow until they lead to nothing better.
"""

from __future__ import annotations

import math
from typing import Any

from fluxbore.optimize.gradient_stage import GradientStage
from fluxbore.optimize.outcome import Candidate
from fluxbore.optimize.problem import Point, violation

SIGMA = 2.0
"""Of the critical distance; with 2 the expected number of local searches stays finite however many the samples."""


def search_from_many(stage: GradientStage, seed: int) -> str:
    """Batches of samples and the local searches from them; returns why it ended. Raises what stops it from within."""
    import numpy as np

    archive, size = stage.archive, len(stage.archive.box.keys)
    batch = max(4 * (size + 1), 8)
    random = np.random.default_rng(seed)
    optima: list[Point] = []
    samples: list[Point] = [point for point, _ in archive.points]
    searches = batches = 0
    while True:
        batches += 1
        wanted = min(batch, max(archive.left // 3, 1))
        drawn = [archive.box.tidy(row) for row in _latin(random, wanted, size)]
        archive.evaluate([archive.box.values(point) for point in drawn])
        samples += drawn
        before = archive.best
        for point in _starts(stage, samples, optima):
            stage.run("SLSQP", archive.at(point))
            searches += 1
            optima.append(stage.ended)
        if batches > 1 and _same(stage, before):
            return (
                f"The search converged: {searches} local searches from {len(samples)} places, the last {wanted} of "
                "which led to nothing better."
            )


def critical_distance(samples: int, size: int) -> float:
    """Of points in the unit box: (Gamma(1 + n/2) sigma ln N / N)^(1/n) / sqrt(pi), N samples in n variables."""
    return float((math.gamma(1 + size / 2) * SIGMA * math.log(samples) / samples) ** (1 / size) / math.sqrt(math.pi))


def _latin(random: Any, count: int, size: int) -> list[list[float]]:
    """(count, size) points of a Latin hypercube: every variable's range is covered evenly."""
    columns = [(random.permutation(count) + random.random(count)) / count for _ in range(size)]
    return [[float(column[i]) for column in columns] for i in range(count)]


def _starts(stage: GradientStage, samples: list[Point], optima: list[Point]) -> list[Point]:
    """The samples that local searches begin at, the best first."""
    reach = critical_distance(max(len(samples), 2), len(samples[0]))
    ranked = sorted(
        (
            (violation(made), stage.slopes.merit.loss(made), point)
            for made, point in ((stage.archive.at(point), point) for point in samples)
        ),
        key=lambda item: (item[0], math.inf if item[1] is None else item[1], item[2]),
    )
    chosen = []
    for i, (miss, loss, point) in enumerate(ranked):
        if loss is None or math.isinf(miss):
            continue
        better = [other for _, _, other in ranked[:i]] + optima
        if all(math.dist(point, other) > reach for other in better):
            chosen.append(point)
    return chosen


def _same(stage: GradientStage, before: Candidate | None) -> bool:
    """Whether the best design is no better than before, by the search's tolerance."""
    best = stage.archive.best
    old, new = (None if made is None else stage.slopes.merit.loss(made) for made in (before, best))
    return old == new or (old is not None and new is not None and old - new <= stage.tolerance)
