"""Reads how a study searches: its algorithm and budget, and the front between two objectives."""

from __future__ import annotations

from fluxbore.design.errors import SpecError
from fluxbore.design.keys import Key
from fluxbore.design.study import ALGORITHMS, NETWORK_ROLES, PARETO_METHODS, Objective, Pareto, Search, Study
from fluxbore.design.study_fields import read_objective, read_settings

LARGEST_SEED = 2**31 - 1
"""What NLopt's and numpy's generators both take."""

_SEARCH = Search()
_PARETO = Pareto(Objective("", False))

SEARCH_KEYS = (
    Key("study.search.algorithm", "NLopt's algorithm", "word", choices=ALGORITHMS, default="auto"),
    Key(
        "study.search.max_evaluations",
        "most designs by finite elements",
        "integer",
        minimum=1,
        maximum=1_000_000,
        default=_SEARCH.max_evaluations,
    ),
    Key(
        "study.search.relative_tolerance",
        "change of the objective at which the search stops, relative",
        "number",
        above=0.0,
        maximum=0.5,
        default=_SEARCH.relative_tolerance,
    ),
    Key("study.search.seed", "of random numbers", "integer", minimum=0, maximum=LARGEST_SEED, default=_SEARCH.seed),
    Key("study.search.time_limit", "after which no further design is begun", dimension="time", above=0.0),
    Key(
        "study.search.network", "what the network does for the search", "word", choices=NETWORK_ROLES,
        default=_SEARCH.network,
    ),
)  # fmt: skip
"""The keys of ``[study.search]``."""

PARETO_KEYS = (
    Key(
        "study.pareto.points",
        "designs on the front, both ends included",
        "integer",
        minimum=3,
        maximum=1000,
        default=_PARETO.points,
    ),
    Key(
        "study.pareto.method",
        "how the points are spread",
        "word",
        choices=PARETO_METHODS,
        default=_PARETO.method,
    ),
)
"""The keys of ``[study.pareto]`` besides ``against``."""


def read_search(raw: object) -> Search:
    """``[study.search]``; an absent one is the default."""
    return Search(**read_settings(raw, "study.search", SEARCH_KEYS))


def read_pareto(raw: object, study: Study) -> Pareto:
    """``[study.pareto]`` of a study whose other parts are read."""
    settings = read_settings(raw, "study.pareto", PARETO_KEYS, ("against",))
    if not isinstance(raw, dict) or "against" not in raw:
        raise SpecError('study.pareto.against is missing: a front needs a second goal, such as "minimise total_mass".')
    against = read_objective(raw["against"], "study.pareto.against")
    if study.objective is None:
        raise SpecError(
            "study.objective must be given for study.pareto, which sets another figure against it; got none."
        )
    if not study.variables:
        raise SpecError("study.variables must be given for study.pareto; got none.")
    counts = [variable.key for variable in study.variables if variable.integer]
    if counts:
        raise SpecError(f"study.variables must be continuous for study.pareto; got the count {counts[0]}.")
    if against.figure == study.objective.figure:
        raise SpecError(f"study.pareto.against must differ from study.objective; got {against.figure} for both.")
    return Pareto(against, **settings)
