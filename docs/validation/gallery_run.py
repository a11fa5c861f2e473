"""Where the gallery meets the solver: a case in, what `fluxbore solve --json` prints and the solution out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from cases.case import Case

from fluxbore.fem.femm_solution import FemmSolution
from fluxbore.solution_messages import solution_plain
from fluxbore.solving import solve


@dataclass(frozen=True, slots=True, eq=False)
class Run:
    """result : as `fluxbore solve --json` prints it."""

    result: Mapping[str, Any]
    solution: FemmSolution


def run(case: Case, accuracy: float | None = None) -> Run:
    """Solve a case. accuracy : relative, the default without. Raises FluxboreError."""
    solution = solve(
        case.model, groups=case.groups, points=case.points, accuracy=accuracy, open_boundary=case.open_boundary
    )
    return Run(solution_plain(solution, case.groups, case.points), solution)
