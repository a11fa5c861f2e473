"""The cylinder's friction law from forces at constant velocity, with intervals, and the experiment that tells it.

    F_f = (F_preload + f_C p + F_S0 e^(-c |v|)) sgn v + f_v v

equations (1) and (2) of the paper on the PREHydrA, from points of velocity, gauge pressure and friction. For a given c
the law is linear: the fit begins at the best c of a grid. It is robust (Huber 1981, Robust Statistics, chapter 7):
residuals beyond 1.345 scatters count with their sign alone, the scatter is the median of their sizes over 0.6745, and
the standard errors are those of the pseudo-residuals K psi(r)/mean psi', K = 1 + n/m var psi'/(mean psi')^2, which with
normal scatter are a few per cent above those of least squares.

The Stribeck force fades within 3/c, 25 mm/s for Table I. Of speeds evenly spaced to 0.45 m/s one or two lie there, and
neither c nor F_S0 is told from what is left; spaced geometrically from 1 mm/s, half of them do. f_C is told by
pressures that differ at alike speeds; the paper found it apart and gives it no error: `known_pressure_coefficient` does
the same.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluxbore.design.cylinder_friction import CylinderFriction
from fluxbore.design.errors import DesignError, IdentificationError
from fluxbore.design.friction_points import FrictionPoints, suction
from fluxbore.design.identification import Identified, Parameter, Residual, identify, not_identifiable

Floats = NDArray[np.float64]

HUBER = 1.345
"""Scatters beyond which a residual counts with its sign alone: 95 % of least squares' efficiency."""

GRID = 80
"""Values of c at which the fit is tried first."""

DISTINCT = 0.02
"""Two speeds closer than this share are one; pressures, of the largest."""

NAMES = ("preload", "stribeck_force", "stribeck_decay", "viscous_coefficient", "pressure_coefficient")


def identify_cylinder_friction(
    points: FrictionPoints,
    *,
    level: float = 0.95,
    known_pressure_coefficient: float | None = None,
    robust: bool = True,
) -> Identified:
    """The parameters by the names of `CylinderFriction`, with their intervals.

    known_pressure_coefficient : f_C (N/Pa), taken as it is; otherwise it is found, which takes two pressures. Raises
    IdentificationError where the data do not tell a parameter, and names it.
    """
    v, p, f = points.velocity, points.pressure, points.friction
    if np.min(p) < 0:
        raise IdentificationError(suction(f"{points.source}: pressure", float(np.min(p))))
    if not np.mean(f * np.sign(v)) > 0:
        raise IdentificationError(
            f"{points.source}: force must be friction, which is positive at positive velocities; "
            f"got {np.mean(f * np.sign(v)):g} N on average against the motion."
        )
    f_C = known_pressure_coefficient
    rest = f if f_C is None else f - np.sign(v) * f_C * p
    parameters = _parameters(v, p, rest, free=f_C is None)
    _check_spread(points, parameters)

    def model(x: Floats) -> Floats:
        return _columns(v, p, x[2], free=f_C is None) @ np.delete(x, 2)

    def jacobian(x: Floats) -> Floats:
        J = np.insert(_columns(v, p, x[2], free=f_C is None), 2, 0.0, axis=1)
        J[:, 2] = -x[1] * v * np.exp(-x[2] * np.abs(v))
        return J

    target = rest
    if robust and len(v) > len(parameters):
        start = np.array([each.start for each in parameters])
        target = _pseudo_values(model, jacobian, rest, start, parameters)
    return identify(lambda x: model(x) - target, parameters, source=points.source, jacobian=jacobian, level=level)


def cylinder_law(found: Identified, known_pressure_coefficient: float = 0.0) -> CylinderFriction:
    """The law that was found."""
    value = {name: each.value for name, each in found.parameters.items()}
    return CylinderFriction(
        value["preload"],
        value.get("pressure_coefficient", known_pressure_coefficient),
        value["stribeck_force"],
        value["stribeck_decay"],
        value["viscous_coefficient"],
    )


@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """Speeds to measure (m/s), in both directions each; the standard errors to expect, by parameter; and for c its
    standard error over its value."""

    speeds: Floats
    errors: Mapping[str, float]
    decay_share: float


def expected_errors(
    law: CylinderFriction, velocity: ArrayLike, scatter: float, pressure: ArrayLike | None = None
) -> dict[str, float]:
    """Standard errors of the parameters from points at velocities (m/s), of a scatter (N), before they are measured.

    pressure : Pa gauge, as many; without it f_C is taken as known. From the law's slopes at its own parameters.
    """
    v = np.asarray(velocity, dtype=np.float64)
    free = pressure is not None
    p = np.zeros_like(v) if pressure is None else np.asarray(pressure, dtype=np.float64)
    J = np.insert(_columns(v, p, law.stribeck_decay, free=free), 2, 0.0, axis=1)
    J[:, 2] = -law.stribeck_force * v * np.exp(-law.stribeck_decay * np.abs(v))
    names = NAMES if free else NAMES[:-1]
    size = np.linalg.norm(J, axis=0)
    if len(v) < len(names) or np.min(size) == 0:
        return dict.fromkeys(names, math.inf)
    inverse = np.linalg.pinv((J / size).T @ (J / size), hermitian=True)
    return dict(zip(names, (scatter * np.sqrt(np.diag(inverse)) / size).tolist(), strict=True))


def plan(law: CylinderFriction, slowest: float, fastest: float, count: int, scatter: float) -> Plan:
    """Geometric spacing between two speeds (m/s), a point in each direction.

    Raises DesignError for a range of speeds that is none, or fewer than three speeds.
    """
    if not 0 < slowest < fastest < math.inf:
        raise DesignError(
            f"The slowest speed of a plan must be above 0 m/s and below the fastest, {fastest:g} m/s; "
            f"got {slowest:g} m/s."
        )
    if count < 3:
        raise DesignError(f"A plan must have 3 speeds or more, in both directions each; got {count}.")
    speeds = np.geomspace(slowest, fastest, count)
    errors = expected_errors(law, np.concatenate((speeds, -speeds)), scatter)
    share = errors["stribeck_decay"] / law.stribeck_decay if law.stribeck_decay > 0 else math.inf
    return Plan(speeds, errors, share)


def _columns(v: Floats, p: Floats, decay: float, *, free: bool) -> Floats:
    """The law's slopes by its linear parameters, (m, 3 or 4)."""
    sign = np.sign(v)
    columns = [sign, sign * np.exp(-decay * np.abs(v)), v]
    return np.stack([*columns, sign * p] if free else columns, axis=1)


def _parameters(v: Floats, p: Floats, rest: Floats, *, free: bool) -> list[Parameter]:
    """With the best of a grid of c to start from."""
    slowest, fastest = float(np.min(np.abs(v))), float(np.max(np.abs(v)))
    best = (math.inf, np.zeros(4 if free else 3), 0.0)
    for decay in np.geomspace(1 / fastest, 5 / slowest, GRID):
        columns = _columns(v, p, float(decay), free=free)
        size = np.linalg.norm(columns, axis=0)
        size[size == 0] = 1.0
        x = np.linalg.lstsq(columns / size, rest, rcond=1e-12)[0] / size
        miss = float(np.sum((columns @ np.maximum(x, 0.0) - rest) ** 2))
        if miss < best[0]:
            best = (miss, np.maximum(x, 0.0), float(decay))
    _, x, decay = best
    mean = float(np.mean(np.abs(rest))) or 1.0
    largest = float(np.max(p)) or 1.0
    parameters = [
        Parameter(
            "preload", float(x[0]), 0.0, dimension="force", scale=mean, told_by="speeds beyond the Stribeck effect"
        ),
        Parameter(
            "stribeck_force", float(x[1]), 0.0, dimension="force", scale=mean, told_by="speeds below a third of 1/c"
        ),
        Parameter(
            "stribeck_decay",
            decay,
            0.0,
            20 / slowest,
            scale=1 / slowest,
            told_by="speeds spaced geometrically, several of them below 1/c",
        ),
        Parameter(
            "viscous_coefficient",
            float(x[2]),
            0.0,
            dimension="viscous friction",
            scale=mean / fastest,
            told_by="fast motion, far beyond 3/c",
        ),
    ]
    if free:
        parameters.append(
            Parameter(
                "pressure_coefficient",
                float(x[3]),
                0.0,
                dimension="area",
                scale=mean / largest,
                told_by="pressures far enough apart for friction to change by more than its scatter",
            )
        )
    return parameters


def _pseudo_values(
    model: Residual, jacobian: Residual, rest: Floats, start: Floats, parameters: list[Parameter]
) -> Floats:
    """What least squares has to be given to find what Huber's estimator finds, with its standard errors."""
    from scipy.optimize import least_squares

    scale = np.array([each.scale or 1.0 for each in parameters])
    lower = np.array([each.lower for each in parameters])
    upper = np.array([each.upper for each in parameters])
    x, scatter = start, 0.0
    for _ in range(10):
        r = model(x) - rest
        before, scatter = scatter, float(np.median(np.abs(r))) / 0.6745
        if scatter <= 1e-9 * float(np.mean(np.abs(rest))):
            return rest
        if abs(scatter - before) <= 1e-3 * scatter:
            break
        # SciPy's Huber is quadratic up to one: residuals over HUBER scatters.
        bound = HUBER * scatter
        x = (
            least_squares(
                lambda u, bound=bound: (model(u * scale) - rest) / bound,
                np.clip(x, lower, upper) / scale,
                jac=lambda u, bound=bound: jacobian(u * scale) * scale / bound,
                bounds=(lower / scale, upper / scale),
                loss="huber",
                xtol=1e-10,
                ftol=1e-10,
                gtol=1e-10,
                max_nfev=100,
            ).x
            * scale
        )
    r = rest - model(x)
    kept = np.clip(r, -HUBER * scatter, HUBER * scatter)
    inside = max(float(np.mean(np.abs(r) < HUBER * scatter)), 0.5)
    correction = 1 + len(x) / len(r) * (1 - inside) / inside
    return np.asarray(model(x) + kept * correction / inside)


def _check_spread(points: FrictionPoints, parameters: list[Parameter]) -> None:
    """Refuse too few speeds or pressures before the fit: scatter hides that they tell nothing."""
    by_name = {each.name: each for each in parameters}
    speeds = np.sort(np.abs(points.velocity))
    count = 1 + int(np.sum(np.diff(speeds) > DISTINCT * speeds[1:])) if len(speeds) else 0
    if count < 4:
        words = f"{count} speed" + ("s" if count != 1 else "")
        raise not_identifiable(
            [by_name["stribeck_force"], by_name["stribeck_decay"]], f"it has {words} of the 4 needed", points.source
        )
    largest = float(np.max(points.pressure))
    if "pressure_coefficient" in by_name and not np.ptp(points.pressure) > DISTINCT * largest:
        raise not_identifiable(
            [by_name["pressure_coefficient"], by_name["preload"]],
            "it has 1 pressure of the 2 needed",
            points.source,
        )
