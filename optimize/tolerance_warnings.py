"""What the reader of a tolerance analysis must know before the numbers are believed, in whole sentences."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fluxbore.design.performance import FIGURES
from fluxbore.design.spec import Spec
from fluxbore.design.study import Production
from fluxbore.optimize.problem import show_limit
from fluxbore.optimize.tolerance_result import FigureSpread, Interval, Requirement
from fluxbore.optimize.tolerance_shift import good_enough
from fluxbore.optimize.tolerance_yield import meets


def warnings(
    spec: Spec,
    figures: Sequence[FigureSpread],
    requirements: Sequence[Requirement],
    simulated: Interval,
    direct: Interval | None,
    production: Production,
) -> tuple[str, ...]:
    """The sentences, the gravest first. Of figures only the objective and those of limits are judged."""
    found = []
    for item in requirements:
        limit = item.limit
        if not meets(limit, np.array([item.nominal]))[0]:
            found.append(f"The nominal design itself misses {limit.subject} {limit.sense} {show_limit(spec, limit)}.")
    objective = spec.study.objective
    judged = {item.limit.subject for item in requirements} | ({objective.figure} if objective else set())
    for spread in figures:
        if spread.subject not in judged or spread.checked is None:
            continue
        error = spread.checked.error
        if not good_enough(error, spread.sigma, spread.nominal):
            size = f"{error / spread.sigma:.2g} of its standard deviation" if spread.sigma else "all of its scatter"
            found.append(
                f"The linear model of {spread.subject} is not good enough: it misses the samples computed in full by "
                f"{size} (root mean square), so that only the checked numbers count."
            )
    if direct is not None and not direct.low <= simulated.value <= direct.high:
        found.append(
            f"The yield by the linear model, {simulated.value:.2%}, is outside what the samples computed in full "
            f"allow, {direct.low:.2%} to {direct.high:.2%}."
        )
    rough = [spread.subject for spread in figures if not spread.exact and spread.subject in FIGURES]
    if rough:
        found.append(
            f"The model has no exact derivatives of {', '.join(rough)}; their slopes are central differences over one "
            "standard deviation to both sides."
        )
    if not production.checks:
        found.append("No sample was computed in full (study.production.checks is 0): the linear model is not checked.")
    return tuple(found)
