"""Parameters of a model from measured data, by least squares, with intervals; the same for every model.

    min over p of sum r_i(p)^2,    C = s^2 (J^T J)^-1,    s^2 = sum r_i^2/(m - n),    p_j +- t(m - n) sqrt(C_jj)

r: residuals of m rows, J: their derivatives by the n parameters at the solution, t: Student's quantile (Seber and Wild
1989, Nonlinear Regression, sec. 5.1). The intervals are those of the model made straight at its solution: they hold
where the model is right, the scatter of the rows is independent, alike and near to normal, and the parameters are known
well enough for the model to be straight across the interval. `docs/identification.md` tells how often they cover.

A parameter that the data do not tell is no result. It is refused, by name, where

- a singular value of J (each column times its parameter's scale) is below `SINGULAR` of the largest: to change the
  parameters along that singular vector changes nothing that was measured; or
- its interval is wider than its scale to either side: anything from nothing to twice the value fits.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.errors import IdentificationError, SpecError
from fluxbore.design.units import format_quantity

Floats = NDArray[np.float64]
Residual = Callable[[Floats], Floats]

SINGULAR = 1e-8
"""Of the largest singular value: what central differences resolve."""

SHARE = 0.2
"""Of a singular vector's largest entry: a parameter below that has no part in what cannot be told."""

CORRELATED = 0.95
"""Correlations above this in size are worth telling: the two parameters trade off against each other."""


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter to be found: name, start and bounds in SI; its dimension, None for a plain number.

    scale : what counts as large a change of it; without it, its own value at the solution.
    told_by : what data would tell it, in words.
    """

    name: str
    start: float
    lower: float = -math.inf
    upper: float = math.inf
    dimension: str | None = None
    scale: float | None = None
    told_by: str = "more data of less scatter"

    def show(self, value: float, digits: int = 4) -> str:
        """A value of it in its preferred unit."""
        return f"{value:.{digits}g}" if self.dimension is None else format_quantity(value, self.dimension, digits)


@dataclass(frozen=True, slots=True)
class Estimate:
    """A parameter as found, in SI: value, standard error, and the interval at the level asked for, within the bounds.

    bound : "lower" or "upper" where the value is at that bound, else empty.
    """

    value: float
    standard_error: float
    low: float
    high: float
    dimension: str | None = None
    bound: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Identified:
    """A model's parameters by name, and how well the data tell them.

    derived : what follows from them, with intervals of its own. covariance, correlation : (n, n), in the order of
    `parameters`. residual_deviation : s, in the unit of the residuals. condition : of J, each column scaled.
    """

    source: str
    parameters: Mapping[str, Estimate]
    derived: Mapping[str, Estimate]
    level: float
    covariance: Floats
    correlation: Floats
    residual_deviation: float
    degrees_of_freedom: int
    condition: float
    residuals: Floats = field(repr=False)

    def correlated(self) -> list[tuple[str, str, float]]:
        """The pairs of parameters whose correlation exceeds `CORRELATED` in size, with it."""
        names = list(self.parameters)
        return [
            (names[i], names[j], float(self.correlation[i, j]))
            for i in range(len(names))
            for j in range(i)
            if abs(self.correlation[i, j]) > CORRELATED
        ]


def check_level(level: float) -> None:
    """Raises SpecError for a level of confidence that is none."""
    if not 0.5 <= level <= 0.9999:
        raise SpecError(f"level must be from 0.5 to 0.9999; got {level:g}.")


def identify(
    residual: Residual,
    parameters: Sequence[Parameter],
    *,
    source: str,
    jacobian: Residual | None = None,
    starts: Sequence[Sequence[float]] = (),
    level: float = 0.95,
    derived: Mapping[str, tuple[Callable[[Floats], float], str | None]] | None = None,
) -> Identified:
    """Least squares from the best of the starts.

    residual : (n,) parameters in SI -> (m,) differences of model and measurement. jacobian : -> (m, n); by central
    differences without it. starts : further starts, each (n,). derived : name -> function of the parameters, dimension.
    source : the data's name, as sentences quote it.

    Raises IdentificationError where the data do not tell the parameters, and names which.
    """
    check_level(level)
    solved = [_solve(residual, jacobian, parameters, start) for start in ([p.start for p in parameters], *starts)]
    x, bounds, J = min(solved, key=lambda each: float(np.sum(residual(each[0]) ** 2)))
    r = residual(x)
    freedom = len(r) - len(x)
    if freedom < 1:
        raise IdentificationError(
            f"{source} must have more rows than the {len(x)} parameters of the model; got {len(r)}."
        )
    scale = np.array([_scale(p, value) for p, value in zip(parameters, x, strict=True)])
    singular, vectors = np.linalg.svd(J * scale, full_matrices=False)[1:]
    _refuse_singular(parameters, singular, vectors, source)
    deviation = math.sqrt(float(r @ r) / freedom)
    inverse = vectors.T / singular * scale[:, np.newaxis]  # D V / S, whose product with itself is (J^T J)^-1
    covariance = deviation**2 * inverse @ inverse.T
    errors = np.sqrt(np.diag(inverse @ inverse.T))
    half = _quantile(level, freedom)
    _refuse_wide(parameters, x, deviation * errors * half, scale, level, source)
    estimates = {
        p.name: Estimate(
            float(value),
            float(error),
            max(p.lower, float(value - half * error)),
            min(p.upper, float(value + half * error)),
            p.dimension,
            bound,
        )
        for p, value, error, bound in zip(parameters, x, deviation * errors, bounds, strict=True)
    }
    return Identified(
        source,
        estimates,
        {
            name: _derived(function, x, covariance, half, dimension)
            for name, (function, dimension) in (derived or {}).items()
        },
        level,
        covariance,
        inverse @ inverse.T / np.outer(errors, errors),
        deviation,
        freedom,
        float(singular[0] / singular[-1]),
        r,
    )


def _solve(
    residual: Residual, jacobian: Residual | None, parameters: Sequence[Parameter], start: Sequence[float]
) -> tuple[Floats, list[str], Floats]:
    """The parameters at the minimum that a start leads to, the bounds that they are at, and J there."""
    from scipy.optimize import least_squares

    lower, upper = (np.array([getattr(p, side) for p in parameters]) for side in ("lower", "upper"))
    inside = np.clip(np.asarray(start, dtype=np.float64), lower, upper)
    scale = np.array([_scale(p, value) for p, value in zip(parameters, inside, strict=True)])
    # In units of the scales: the solver's bounds and differences are about one then.
    found = least_squares(
        lambda u: residual(u * scale),
        inside / scale,
        jac="3-point" if jacobian is None else lambda u: jacobian(u * scale) * scale,
        bounds=(lower / scale, upper / scale),
        xtol=1e-10,
        ftol=1e-10,
        gtol=1e-10,
        max_nfev=100,
    )
    words = {-1: "lower", 0: "", 1: "upper"}
    x = np.where(found.active_mask == -1, lower, np.where(found.active_mask == 1, upper, found.x * scale))
    return x, [words[int(mask)] for mask in found.active_mask], found.jac / scale


def _scale(parameter: Parameter, value: float) -> float:
    if parameter.scale is not None:
        return parameter.scale
    return abs(value) or abs(parameter.start) or 1.0


def _quantile(level: float, freedom: int) -> float:
    """Student's t for a two-sided interval."""
    from scipy.special import stdtrit

    return float(stdtrit(freedom, (1 + level) / 2))


def _derived(
    function: Callable[[Floats], float], x: Floats, covariance: Floats, half: float, dimension: str | None
) -> Estimate:
    """By the slope of the function, over steps of a hundredth of each standard error (or a millionth of the value)."""
    steps = np.maximum(np.sqrt(np.diag(covariance)) / 100, np.abs(x) * 1e-6)
    slope = np.zeros_like(x)
    for j, step in enumerate(steps):
        if step > 0:
            change = np.zeros_like(x)
            change[j] = step
            slope[j] = (function(x + change) - function(x - change)) / (2 * step)
    value, error = float(function(x)), math.sqrt(max(float(slope @ covariance @ slope), 0.0))
    return Estimate(value, error, value - half * error, value + half * error, dimension)


def _refuse_singular(parameters: Sequence[Parameter], singular: Floats, vectors: Floats, source: str) -> None:
    lost = vectors[singular <= SINGULAR * singular[0]] if singular[0] > 0 else np.eye(len(parameters))
    if len(lost) == 0:
        return
    part = np.sqrt(np.sum(lost**2, axis=0))
    unknown = [p for p, size in zip(parameters, part, strict=True) if size >= SHARE * np.max(part)]
    reason = (
        "the measured values would be the same for any value of it"
        if len(unknown) == 1
        else "they can change together without a change of the measured values"
    )
    raise not_identifiable(unknown, reason, source)


def _refuse_wide(
    parameters: Sequence[Parameter], x: Floats, half: Floats, scale: Floats, level: float, source: str
) -> None:
    wide = [j for j in range(len(x)) if not half[j] < scale[j]]
    if not wide:
        return
    worst = max(wide, key=lambda j: float(half[j] / scale[j]))
    p = parameters[worst]
    of_it = f" of {p.name}" if len(wide) > 1 else ""
    reason = (
        f"the {level * 100:g} % interval{of_it} would be {p.show(float(x[worst]))} "
        f"\N{PLUS-MINUS SIGN} {_difference(p, float(half[worst]))}"
    )
    raise not_identifiable([parameters[j] for j in wide], reason, source)


def _difference(parameter: Parameter, value: float) -> str:
    return parameter.show(value, 3)


def not_identifiable(parameters: Sequence[Parameter], reason: str, source: str) -> IdentificationError:
    """The error for parameters that the data do not tell: which, why, and what would tell them."""
    names = [p.name for p in parameters]
    listed = names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
    needed = "; ".join(dict.fromkeys(p.told_by for p in parameters))
    return IdentificationError(f"{source} does not identify {listed}: {reason}; it takes {needed}.")
