"""front.csv: one line for each point of a Pareto front, SI units, floats that read back exactly."""

from __future__ import annotations

import csv
import io

from fluxbore.optimize.pareto_result import FrontPoint, ParetoResult

FILE_NAME = "front.csv"


def front_table(result: ParetoResult) -> str:
    """The text of front.csv, in order along the front.

    Header: ``position``, ``limit``, ``standing``, the two figures' names, the variables' dotted keys, ``slope`` (the
    derivative of the first figure by the second), ``residual``, ``designs``, ``reason``.
    """
    keys = list(dict.fromkeys(key for made in result.history for key in made.values))
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    figures = [result.objective.figure, result.against.figure]
    writer.writerow(["position", "limit", "standing", *figures, *keys, "slope", "residual", "designs", "reason"])
    for point in result.points:
        writer.writerow(_row(point, keys))
    return buffer.getvalue()


def _row(point: FrontPoint, keys: list[str]) -> list[str]:
    values = {} if point.design is None else point.design.values
    return [
        *_shown(point.position, point.limit),
        point.standing,
        *_shown(point.first, point.second, *(values.get(key) for key in keys), point.slope, point.residual),
        str(point.designs),
        " ".join(point.reason.split()),
    ]


def _shown(*values: float | None) -> list[str]:
    return ["" if value is None else repr(value) for value in values]
