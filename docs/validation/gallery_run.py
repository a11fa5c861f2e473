"""Where the gallery meets the solver: a case in, a result of the JSON contract and a field to draw out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from cases.case import Case
from cases.exterior import with_exterior

from fluxbore.fem.femm_solution import solve_model
from fluxbore.fem.field import FluxMap, flux_map


@dataclass(frozen=True, slots=True, eq=False)
class Run:
    """result : as `fluxbore solve --json` prints it, and each group's force by its second route, "force_by_layer"."""

    result: Mapping[str, Any]
    field: FluxMap


def run(case: Case, accuracy: float | None = None) -> Run:
    """Solve a case. accuracy : relative, the default without. Raises FluxboreError."""
    model = with_exterior(case.model) if case.open_boundary else case.model
    solved = solve_model(model, case.groups, case.points, accuracy)
    energy, coenergy = solved.energies
    result: dict[str, Any] = {
        "mesh": {"unknowns": solved.adapted.levels[-1].unknowns, "elements": solved.adapted.levels[-1].elements},
        "convergence": {"status": "converged" if solved.adapted.reached else "accuracy not reached"},
        "energy": energy,
        "coenergy": coenergy,
        "circuits": {
            item.name: {"current": item.current, "flux_linkage": float(linked)}
            for item, linked in zip(model.circuits, solved.linkages, strict=True)
        },
        "groups": {},
        "points": [],
    }
    for group in case.groups:
        found = solved.force(group)
        result["groups"][str(group)] = {
            "force": found.by_stress.force,
            "torque": found.by_stress.torque,
            "force_error": found.error,
            "force_by_layer": found.by_layer.force,
        }
    if case.points:
        probed = solved.probe(np.array(case.points, dtype=float))
        for at, a, b in zip(case.points, probed.potential, probed.flux_density, strict=True):
            result["points"].append({"at": at, "A": float(a), "B": b.tolist()})
    return Run(result, flux_map(solved.solution))
