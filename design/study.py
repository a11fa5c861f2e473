"""What a specification asks to be studied: variables, objective, constraints, sweeps. Frozen data, no behaviour.

All numbers are SI. The finite elements, the search and the report read these types; `fluxbore.design.spec` makes them.
"""

from __future__ import annotations

from dataclasses import dataclass

GRADIENT_ALGORITHMS = ("SLSQP", "MMA", "CCSAQ", "MLSL")
"""Those of NLopt's searches that ask for derivatives; MLSL starts SLSQP from many places."""

FREE_ALGORITHMS = ("COBYLA", "BOBYQA", "DIRECT-L", "CRS2", "ISRES")
"""Those of NLopt's searches that need no derivatives."""

ALGORITHMS = ("auto", *GRADIENT_ALGORITHMS, *FREE_ALGORITHMS)
"""The searches that a specification can name; "auto" is SLSQP where the model gives gradients, else COBYLA."""

NETWORK_ROLES = ("start", "manifold", "off")
"""What the analytic network does for a search: proposes where it starts; is corrected by the finite elements all the
way (manifold mapping); nothing."""

DISTRIBUTIONS = ("normal", "uniform", "triangular")
"""How a dimension scatters within its tolerance: a normal one has its limits at three standard deviations."""

PARETO_METHODS = ("epsilon constraint", "normal boundary intersection")


@dataclass(frozen=True, slots=True)
class Variable:
    """A key that the search may move between two bounds; ``resolution`` is the workshop's step, or None.

    integer : a count, which the search enumerates.
    """

    key: str
    lower: float
    upper: float
    resolution: float | None = None
    integer: bool = False


@dataclass(frozen=True, slots=True)
class Constraint:
    """A limit on a figure (a `Performance` name) or on a key.

    subject : the figure's name or the dotted key.
    upper, lower : SI limits; None where there is none.
    relative_to_start : the limit is the start design's own value ("no higher than the prototype's"); then ``upper``
        or ``lower`` holds the factor to multiply it by.
    """

    subject: str
    upper: float | None = None
    lower: float | None = None
    relative_to_start: bool = False


@dataclass(frozen=True, slots=True)
class Objective:
    """The figure to maximise or to minimise."""

    figure: str
    maximise: bool


@dataclass(frozen=True, slots=True)
class Axis:
    """The grid points of one key in a sweep, in order."""

    key: str
    values: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Sweep:
    """A full grid over one or more axes (the last axis runs fastest).

    reference : published optimum of the single axis (SI) with its source, to be drawn beside the curve, or None.
    published : published points of the single axis, its value and that of the study's objective there (SI).
    """

    name: str
    axes: tuple[Axis, ...]
    reference: float | None = None
    reference_source: str = ""
    published: tuple[tuple[float, float], ...] = ()

    @property
    def size(self) -> int:
        size = 1
        for axis in self.axes:
            size *= len(axis.values)
        return size


@dataclass(frozen=True, slots=True)
class Search:
    """How the search runs: NLopt's algorithm, its budget of FEM designs and its stop rule.

    relative_tolerance : of the objective. time_limit : s after which no further design is begun, or None.
    network : one of `NETWORK_ROLES`.
    """

    algorithm: str = "auto"
    max_evaluations: int = 60
    relative_tolerance: float = 1e-4
    seed: int = 1
    time_limit: float | None = None
    network: str = "start"


@dataclass(frozen=True, slots=True)
class Pareto:
    """A front: the study's objective against a second one.

    points : designs on the front, its two ends among them. method : one of `PARETO_METHODS`.
    """

    against: Objective
    points: int = 9
    method: str = "epsilon constraint"


@dataclass(frozen=True, slots=True)
class Tolerance:
    """What a workshop may miss a key's nominal value by: from ``minus`` below (<= 0) to ``plus`` above (>= 0), SI.

    distribution : one of `DISTRIBUTIONS` between these two; with unequal ones its middle is not the nominal value.
    """

    key: str
    minus: float
    plus: float
    distribution: str = "normal"


@dataclass(frozen=True, slots=True)
class Production:
    """What comes off the line: the scatter of the dimensions and how many actuators are to meet the constraints.

    samples : of the Monte Carlo on the linear model. checks : of these, how many are computed by the study's route.
    target_yield : share of actuators that must meet every constraint, for which the search backs off; None asks for
    the yield alone.
    """

    tolerances: tuple[Tolerance, ...]
    samples: int = 10_000
    checks: int = 0
    seed: int = 1
    target_yield: float | None = None


@dataclass(frozen=True, slots=True)
class Study:
    """The whole study section; any part may be empty.

    hold : keys that keep the start design's value while others move, in place of the alternatives the spec gives (a
        held turns density instead of a number of turns, for one).
    """

    objective: Objective | None = None
    variables: tuple[Variable, ...] = ()
    constraints: tuple[Constraint, ...] = ()
    sweeps: tuple[Sweep, ...] = ()
    hold: tuple[str, ...] = ()
    search: Search = Search()
    pareto: Pareto | None = None
    production: Production | None = None
