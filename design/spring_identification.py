"""The laws of a magnetic spring from measured displacement and force, each with its parameters' intervals.

    linear      F = K_s x                                    (1)
    sine        F = F_stall sin(x/h)                         (14)
    polynomial  F = k_1 x + k_3 x^3 + k_5 x^5
    hysteresis  F = F_stall (w sin(x/h) + (1 - w) sin(x_s/h)), x_s of (18) with phi = eta = 1    (17), (18)

of the paper on the RotLin actuator, x = x_d - x_0. x_0, the displacement where the encoders are zero, stays zero unless
asked for, and so does the state x_s at the first row of a record with hysteresis.

phi stays one: x_s goes with it in proportion, and (1 - w) phi is nearly all that the force tells of either. psi and xi
are found as psi + xi > 0, the rate (1/m) at which the state nears its bound, and psi - xi >= 0, at which it comes back:
within these limits the model is valid. eta is not sought: with one the state has its closed form.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.bouc_wen import BoucWen, states
from fluxbore.design.dynamics.magnetic_hysteresis import HysteresisSpring
from fluxbore.design.dynamics.magnetic_spring import LinearSpring, PolynomialSpring, SineSpring
from fluxbore.design.dynamics.motion_log import check_rising, even_period
from fluxbore.design.errors import IdentificationError, SpecError, shown
from fluxbore.design.identification import Identified, Parameter, identify
from fluxbore.design.measurements import Column, Measurements
from fluxbore.design.units import format_quantity

Floats = NDArray[np.float64]

COLUMNS = (Column("displacement", "length", -1e3, 1e3), Column("force", "force", -1e9, 1e9))
"""Of the rotor against the translator, h theta - x, and of the spring on the mover."""

TIME = Column("time", "time", -1e9, 1e9)
"""May stand beside them. Rows are in the order in which they were measured in any case."""

ZERO, START = "zero_displacement", "start_state"
"""The parameters that are sought where asked for."""

POWERS = (1, 3, 5)

LEAST_REACH, LEAST_SLOPE = 1e-9, 1e-3
"""m, N/m: below either there is no spring of magnets in the data."""

LAWS = ("linear", "sine", "polynomial", "hysteresis")


def identify_spring(law: str, data: Measurements, *, level: float = 0.95, free: Sequence[str] = ()) -> Identified:
    """The parameters of one of `LAWS`, from a table of `COLUMNS`. free : `ZERO`, and `START` for hysteresis.

    Raises MeasurementError where time does not rise, or has gaps in a record with hysteresis; IdentificationError where
    the data do not tell a parameter, and names it; SpecError for a law or a parameter that is none.
    """
    if law not in LAWS:
        raise SpecError(f"law must be one of {', '.join(LAWS)}; got {shown(law)}.")
    known = (ZERO, START) if law == "hysteresis" else (ZERO,)
    for name in free:
        if name not in known:
            raise SpecError(f"free must be one of {', '.join(known)} for {law}; got {shown(name)}.")
    if TIME.name in data:
        (even_period if law == "hysteresis" and len(data) > 2 else check_rising)(data)
    x, f = data["displacement"], data["force"]
    reach = float(np.max(np.abs(x)))
    if not reach >= LEAST_REACH:
        raise IdentificationError(
            f"{data.source}: displacement must reach {format_quantity(LEAST_REACH, 'length')} or more from zero; "
            f"got {format_quantity(reach, 'length', 4)}."
        )
    slope = float((x / reach) @ f) / float((x / reach) @ (x / reach)) / reach
    if not slope >= LEAST_SLOPE:
        raise IdentificationError(
            f"{data.source}: force must rise with the displacement by {LEAST_SLOPE:g} N/m or more, as a spring's does; "
            f"got {slope:g} N/m along the rows."
        )
    if law == "linear":
        return _linear(data, slope, reach, level, free)
    if law == "sine":
        return _sine(data, slope, reach, level, free)
    if law == "polynomial":
        return _polynomial(data, reach, level, free)
    return _hysteresis(data, slope, reach, level, free)


def linear_spring(found: Identified) -> LinearSpring:
    return LinearSpring(_value(found, "spring_constant"))


def sine_spring(found: Identified) -> SineSpring:
    return SineSpring(_value(found, "stall_force"), _value(found, "transfer_ratio"))


def polynomial_spring(found: Identified) -> PolynomialSpring:
    return PolynomialSpring(tuple(_value(found, f"k{power}") for power in POWERS))


def hysteresis_spring(found: Identified) -> HysteresisSpring:
    """Of `identify_spring("hysteresis", ...)`."""
    rising, falling = _value(found, "rising_rate"), _value(found, "falling_rate")
    return HysteresisSpring(sine_spring(found), _value(found, "weight"), _memory(rising, falling))


def _value(found: Identified, name: str) -> float:
    return found.parameters[name].value


def _memory(rising: float, falling: float) -> BoucWen:
    return BoucWen(1.0, (rising + falling) / 2, (rising - falling) / 2)


def _zero(reach: float, free: Sequence[str]) -> list[Parameter]:
    told = "displacements on both sides of no force"
    return [Parameter(ZERO, 0.0, dimension="length", scale=reach, told_by=told)] if ZERO in free else []


def _linear(data: Measurements, slope: float, reach: float, level: float, free: Sequence[str]) -> Identified:
    x, f = data["displacement"], data["force"]
    parameters = [Parameter("spring_constant", slope, 0.0, dimension="stiffness"), *_zero(reach, free)]

    def residual(p: Floats) -> Floats:
        return np.asarray(p[0] * (x - _extra(p, 1)) - f)

    return identify(residual, parameters, source=data.source, level=level)


def _polynomial(data: Measurements, reach: float, level: float, free: Sequence[str]) -> Identified:
    x, f = data["displacement"], data["force"]
    scaled = np.stack([(x / reach) ** power for power in POWERS], axis=1)
    found = np.linalg.lstsq(scaled, f, rcond=None)[0]
    largest = float(np.max(np.abs(f)))
    parameters = [
        Parameter(
            f"k{power}",
            float(k) / reach**power,
            dimension="stiffness" if power == 1 else None,
            scale=largest / reach**power,
            told_by="displacements of three or more sizes, the largest near a quarter of the pitch",
        )
        for power, k in zip(POWERS, found, strict=True)
    ]

    def residual(p: Floats) -> Floats:
        return np.asarray(PolynomialSpring(tuple(p[: len(POWERS)])).force(x - _extra(p, len(POWERS))) - f)

    return identify(residual, [*parameters, *_zero(reach, free)], source=data.source, level=level)


def _sine_parameters(data: Measurements, slope: float, reach: float) -> tuple[list[Parameter], list[list[float]]]:
    """With starts at which the reach is 0.5, 1 or 1.5 of h: up to about a quarter of the pitch."""
    largest = float(np.max(np.abs(data["force"])))
    parameters = [
        Parameter(
            "stall_force",
            largest * 1.2,
            largest * 1e-3,
            dimension="force",
            told_by="forces near the stall force, a quarter of the pitch on",
        ),
        Parameter(
            "transfer_ratio",
            reach / 1.2,
            reach * 1e-3,
            dimension="length",
            told_by="displacements up to about a quarter of the pitch",
        ),
    ]
    starts = [[slope * reach / math.sin(share), reach / share] for share in (1.5, 1.0, 0.5)]
    return parameters, starts


_DERIVED: dict[str, tuple[Callable[[Floats], float], str | None]] = {
    "spring_constant": (lambda p: float(p[0] / p[1]), "stiffness"),
    "pitch": (lambda p: float(math.tau * p[1]), "length"),
}


def _sine(data: Measurements, slope: float, reach: float, level: float, free: Sequence[str]) -> Identified:
    x, f = data["displacement"], data["force"]
    parameters, starts = _sine_parameters(data, slope, reach)
    zero = _zero(reach, free)

    def residual(p: Floats) -> Floats:
        return np.asarray(p[0] * np.sin((x - _extra(p, 2)) / p[1]) - f)

    return identify(
        residual,
        [*parameters, *zero],
        source=data.source,
        starts=[[*start, *(0.0 for _ in zero)] for start in starts],
        level=level,
        derived=_DERIVED,
    )


def _hysteresis(data: Measurements, slope: float, reach: float, level: float, free: Sequence[str]) -> Identified:
    x, f = data["displacement"], data["force"]
    parameters, _ = _sine_parameters(data, slope, reach)
    loops = "closed loops, up to several times the way in which the hysteresis builds up"
    parameters += [
        Parameter("weight", 0.95, 0.0, 1.0, scale=0.1, told_by=loops),
        Parameter("rising_rate", 5 / reach, 1e-3 / reach, 1e6 / reach, "wave number", told_by=loops),
        Parameter("falling_rate", 2 / reach, 0.0, 1e6 / reach, "wave number", scale=5 / reach, told_by=loops),
    ]
    extra = _zero(reach, free)
    if START in free:
        extra.append(Parameter(START, 0.0, dimension="length", scale=reach / 5, told_by="a record from rest on"))
    zero_at = len(parameters) if ZERO in free else None
    start_at = len(parameters) + len(extra) - 1 if START in free else None

    def residual(p: Floats) -> Floats:
        shifted = x if zero_at is None else x - p[zero_at]
        start = 0.0 if start_at is None else float(p[start_at])
        inner = states(_memory(float(p[3]), float(p[4])), shifted, start)
        return np.asarray(p[0] * (p[2] * np.sin(shifted / p[1]) + (1 - p[2]) * np.sin(inner / p[1])) - f)

    plain = _sine(data, slope, reach, level, ())
    begun = [plain.parameters[name].value for name in ("stall_force", "transfer_ratio")]
    return identify(
        residual,
        [*parameters, *extra],
        source=data.source,
        starts=[[*begun, 0.95, rate / reach, rate / 2 / reach, *(0.0 for _ in extra)] for rate in (1.5, 4.0, 12.0)],
        level=level,
        derived={
            **_DERIVED,
            "psi": (lambda p: float(p[3] + p[4]) / 2, "wave number"),
            "xi": (lambda p: float(p[3] - p[4]) / 2, "wave number"),
        },
    )


def _extra(p: Floats, place: int) -> float:
    """x_0 where it is sought."""
    return float(p[place]) if len(p) > place else 0.0
