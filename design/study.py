"""What a specification asks to be studied: variables, objective, constraints, sweeps. Frozen data, no behaviour.

All numbers are SI. The finite elements, the search and the report read these types; `fluxbore.design.spec` makes them.
"""

from __future__ import annotations

from dataclasses import dataclass

ALGORITHMS = ("COBYLA", "BOBYQA", "DIRECT-L", "CRS2", "ISRES")
"""The searches that a specification can name; all are NLopt's and need no derivatives."""


@dataclass(frozen=True, slots=True)
class Variable:
    """A key that the search may move between two bounds; ``resolution`` is the workshop's step, or None."""

    key: str
    lower: float
    upper: float
    resolution: float | None = None


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
    """

    name: str
    axes: tuple[Axis, ...]
    reference: float | None = None
    reference_source: str = ""

    @property
    def size(self) -> int:
        size = 1
        for axis in self.axes:
            size *= len(axis.values)
        return size


@dataclass(frozen=True, slots=True)
class Search:
    """How the search runs: NLopt's algorithm, its budget of FEM designs and its stop rule."""

    algorithm: str = "COBYLA"
    max_evaluations: int = 60
    relative_tolerance: float = 1e-4
    seed: int = 1


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
