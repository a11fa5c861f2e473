"""Reads the study section of a specification into the frozen types of `fluxbore.design.study`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from fluxbore.design.errors import SpecError, shown
from fluxbore.design.keys import Alternatives, Key, Values
from fluxbore.design.study import Study
from fluxbore.design.study_constraint_reader import check_constraints, read_constraint
from fluxbore.design.study_fields import allow, read_objective, tables
from fluxbore.design.study_production_reader import read_production
from fluxbore.design.study_search_reader import read_pareto, read_search
from fluxbore.design.study_sweep_reader import read_sweep
from fluxbore.design.study_variable_reader import read_hold, read_variables

PARTS = ("objective", "hold", "variables", "constraints", "sweeps", "search", "pareto", "production")


def read_study(
    raw: Mapping[str, Any], keys: Sequence[Key], alternatives: Sequence[Alternatives], values: Values
) -> Study:
    """The study that the raw section describes. ``values`` are the start design's, every key resolved.

    Raises SpecError with the study's key, the limit and the value.
    """
    known = {key.name: key for key in keys}
    allow(raw, "study", PARTS)
    objective = read_objective(raw["objective"], "study.objective") if "objective" in raw else None
    variables = read_variables(raw, known, values)
    constraints = tuple(
        read_constraint(item, f"study.constraints.{i}", known) for i, item in enumerate(tables(raw, "constraints"))
    )
    check_constraints(constraints, variables, known)
    figure = objective.figure if objective is not None else None
    sweeps = tuple(read_sweep(item, f"study.sweeps.{i}", known, figure) for i, item in enumerate(tables(raw, "sweeps")))
    for i, sweep in enumerate(sweeps):
        if sweep.name in (other.name for other in sweeps[:i]):
            raise SpecError(f"study.sweeps.{i}.name must differ from the other sweeps' names; got {shown(sweep.name)}.")
    study = Study(
        objective=objective,
        variables=variables,
        constraints=constraints,
        sweeps=sweeps,
        hold=read_hold(raw.get("hold", []), alternatives, variables),
        search=read_search(raw.get("search", {})),
    )
    return replace(
        study,
        pareto=read_pareto(raw["pareto"], study) if "pareto" in raw else None,
        production=read_production(raw["production"], study, known, values) if "production" in raw else None,
    )
