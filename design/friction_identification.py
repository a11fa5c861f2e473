"""The seal's friction law from measured force, velocity and pressure.

    f_k = (mu_C + (mu_S - mu_C) exp(-(v/v_s)^2)) (s P + F_0) sgn v + sigma_2 v          (6)

of Nakata and Noda (2023), to be fitted to the friction at several pressures and speeds (their Fig. 15, Table IV). The
contact area s is known from the drawing: without it mu_C, mu_S and F_0 would hold up to a common factor. mu_C and F_0
trade off even so, and their product, friction without pressure, is known better than either.

sigma_2 stays zero unless asked for. It raises the friction in proportion to the speed, mu_C by a constant, and over a
short range of speeds above v_s the two look alike; the paper gives 0.00 N s/m for it. Asked for, it needs four speeds.

Least speeds and pressures: mu_C, mu_S and v_s are three numbers of a curve over the speed, so three speeds; F_0 is told
from mu_C by two pressures.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.errors import IdentificationError
from fluxbore.design.friction import SealFriction, seal_friction
from fluxbore.design.friction_points import FrictionPoints, suction
from fluxbore.design.identification import Identified, Parameter, identify, not_identifiable

Floats = NDArray[np.float64]

DISTINCT = 0.02
"""Two speeds closer than this share of the larger one are one; pressures, of the largest."""

CHANCE = 0.01
"""At which scatter may pass for a friction that changes with the speed."""

LEAST_RISE = 1e-3
"""Of the mean friction, over all pressures: with less, the pressures say nothing of where to start."""

START_COEFFICIENT, START_RATIO = 0.15, 1.3
"""mu_C to start from where the pressures say nothing of it, and mu_S/mu_C."""


def identify_friction(points: FrictionPoints, area: float, *, level: float = 0.95, viscous: bool = False) -> Identified:
    """mu_S, mu_C, F_0, v_s (and sigma_2, where `viscous`) with their intervals, for the contact area s (m^2).

    The parameters bear the names of `SealFriction`; `coulomb_force` and `static_force`, mu_C F_0 and mu_S F_0 (N),
    follow from them. Raises IdentificationError where the data do not tell one of them, and names it.
    """
    v, P, f = points.velocity, points.pressure, points.friction
    if np.min(P) < 0:
        raise IdentificationError(suction(f"{points.source}: pressure", float(np.min(P))))
    if not np.mean(f * np.sign(v)) > 0:
        raise IdentificationError(
            f"{points.source}: force must be friction, which is positive at positive velocities; "
            f"got {np.mean(f * np.sign(v)):g} N on average against the motion."
        )
    parameters, starts = _parameters(points, area, viscous)
    _check_spread(points, parameters)

    def residual(x: Floats) -> Floats:
        return seal_friction(law(x), area, P, v) - f

    def jacobian(x: Floats) -> Floats:
        mu_S, mu_C, F_0, v_s = x[:4]
        share = np.exp(-((v / v_s) ** 2))
        normal, sign = area * P + F_0, np.sign(v)
        columns = [
            sign * share * normal,
            sign * (1 - share) * normal,
            sign * (mu_C + (mu_S - mu_C) * share),
            sign * (mu_S - mu_C) * share * 2 * v**2 / v_s**3 * normal,
            v,
        ]
        return np.stack(columns[: len(x)], axis=1)

    try:
        return identify(
            residual,
            parameters,
            source=points.source,
            jacobian=jacobian,
            starts=starts,
            level=level,
            derived={
                "static_force": (lambda x: float(x[0] * x[2]), "force"),
                "coulomb_force": (lambda x: float(x[1] * x[2]), "force"),
            },
        )
    except IdentificationError as error:
        if len(v) > len(parameters) and not _falls_with_speed(points):
            # The fit may have laid a curve through scatter anywhere; what is missing is the curve.
            raise not_identifiable(
                [p for p in parameters if p.name in ("static_coefficient", "stribeck_speed")],
                "friction changes with the speed by no more than its scatter",
                points.source,
            ) from error
        raise


def law(values: Sequence[float] | Floats) -> SealFriction:
    """Of mu_S, mu_C, F_0, v_s and, where it is there, sigma_2."""
    return SealFriction(*(float(value) for value in values), *([0.0] if len(values) == 4 else []))


def _parameters(points: FrictionPoints, area: float, viscous: bool) -> tuple[list[Parameter], list[list[float]]]:
    """With starts for Stribeck speeds all over the measured range: where it lies is what the fit finds last."""
    speed, size = np.abs(points.velocity), points.friction * np.sign(points.velocity)
    spread, mean = float(np.ptp(points.pressure)), float(np.mean(size))
    slope, level = (float(value) for value in np.polyfit(points.pressure, size, 1)) if spread > 0 else (0.0, mean)
    mu_C = slope / area if slope * spread > LEAST_RISE * mean and level > 0 else START_COEFFICIENT
    F_0 = max(level / mu_C, LEAST_RISE * mean)
    slowest, fastest = float(np.min(speed)), float(np.max(speed))
    parameters = [
        Parameter(
            "static_coefficient",
            START_RATIO * mu_C,
            0.0,
            told_by="slow motion, below the Stribeck speed",
        ),
        Parameter("coulomb_coefficient", mu_C, 0.0, told_by="motion at twice the Stribeck speed and above"),
        Parameter(
            "contact_force",
            F_0,
            0.0,
            dimension="force",
            told_by="pressures far enough apart for friction to change by more than its scatter",
        ),
        Parameter(
            "stribeck_speed",
            slowest,
            slowest / 100,
            fastest * 100,
            dimension="speed",
            told_by="three or more speeds on both sides of the Stribeck speed",
        ),
    ]
    if viscous:
        parameters.append(
            Parameter(
                "viscous_coefficient",
                0.0,
                0.0,
                dimension="viscous friction",
                scale=mean / fastest,
                told_by="four or more speeds, the fastest far above the Stribeck speed",
            )
        )
    starts = [
        [START_RATIO * mu_C, mu_C, F_0, v_s, 0.0][: len(parameters)] for v_s in np.geomspace(slowest, fastest, 5)[1:]
    ]
    return parameters, starts


def _falls_with_speed(points: FrictionPoints) -> bool:
    """Whether a parabola over the logarithm of the speed takes more off the residuals of a friction that pressure alone
    changes than scatter would in `CHANCE` of all cases: an F test."""
    from scipy.special import fdtrc

    speed, size = np.log(np.abs(points.velocity)), points.friction * np.sign(points.velocity)
    flat = np.stack([np.ones_like(size), points.pressure / (np.max(points.pressure) or 1.0)], axis=1)
    curved = np.column_stack([flat, speed, speed**2])
    with_curve, without = (
        float(np.sum((size - basis @ np.linalg.lstsq(basis, size, rcond=None)[0]) ** 2)) for basis in (curved, flat)
    )
    freedom = len(size) - 4
    if freedom < 1 or with_curve <= 0:
        return True
    return bool(fdtrc(2, freedom, (without - with_curve) / 2 / (with_curve / freedom)) < CHANCE)


def _distinct(speeds: Floats, most: int) -> int:
    """How many speeds there are, each beyond the last one counted by more than `DISTINCT` of itself; at most `most`."""
    ordered, count = np.sort(speeds), 1
    last = ordered[0]
    while count < most:
        beyond = np.searchsorted(ordered * (1 - DISTINCT), last, side="right")
        if beyond == len(ordered):
            break
        last, count = ordered[beyond], count + 1
    return count


def _check_spread(points: FrictionPoints, parameters: Sequence[Parameter]) -> None:
    """Refuse too few speeds or pressures before the fit: scatter hides that they tell nothing."""
    by_name = {p.name: p for p in parameters}
    over_speed = [name for name in ("stribeck_speed", "viscous_coefficient", "static_coefficient") if name in by_name]
    needed = len(over_speed) + 1
    count = _distinct(np.abs(points.velocity), needed)
    if count < needed:
        words = f"{count} speed" + ("s" if count > 1 else "")
        raise not_identifiable(
            [by_name[name] for name in over_speed[: needed - count]],
            f"it has {words} of the {needed} needed",
            points.source,
        )
    pressures = np.unique(points.pressure)
    if not np.ptp(pressures) > DISTINCT * pressures[-1]:
        raise not_identifiable(
            [by_name["contact_force"], by_name["coulomb_coefficient"], by_name["static_coefficient"]],
            "it has 1 pressure of the 2 needed, and tells their products alone",
            points.source,
        )
