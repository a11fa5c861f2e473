"""What the benchmark of a lead screw's force asks that its screw cannot do: refused before anything is simulated."""

from __future__ import annotations

import math

from fluxbore.design.dynamics.force_parameters import ForceParameters
from fluxbore.design.dynamics.magnetic_hysteresis import peak_force
from fluxbore.design.errors import SpecError
from fluxbore.design.force_benchmark_keys import PREFIX
from fluxbore.design.units import format_quantity

LEAST_PERIODS = 1000
"""Of control in a run: fewer show no movement."""

DIGITS = 6


def check(parameters: ForceParameters) -> None:
    """Raises SpecError, one sentence with key, limit and value, for forces, ways and times beyond the actuator's.

    DesignError for a hysteresis outside its range of validity.
    """
    p = parameters
    _check_hysteresis(p)
    hold = peak_force(p.spring) - p.friction
    known = p.stall_force - p.smooth_friction - p.friction_jump
    for name in ("first_peak", "second_peak", "third_peak", "lower_peak"):
        peak = float(getattr(p, name))
        if not peak < hold:
            raise _beyond(name, "below the largest force of (17) less the guides' friction", hold, peak, "force")
        way = peak / p.load_stiffness
        if way > p.travel:
            raise SpecError(
                f"{PREFIX}{name} must press the load no further than the way over which all poles are engaged, "
                f"{_show(p.travel, 'length')}; got {_show(peak, 'force')}, which takes {_show(way, 'length')}."
            )
    for name in ("first_step", "second_step"):
        reference = float(getattr(p, name))
        if not reference < min(hold, known):
            raise _beyond(name, "below what the screw holds less its friction", min(hold, known), reference, "force")
    for name in ("first_loop", "second_loop"):
        tip = float(getattr(p, name))
        if not tip < p.stall_force:
            raise _beyond(name, "below the stall force", p.stall_force, tip, "force")
    for first, second in (("first_step", "second_step"), ("first_loop", "second_loop")):
        one, other = float(getattr(p, first)), float(getattr(p, second))
        if f"{one:g}" == f"{other:g}":  # what the figures of either go by
            raise _beyond(second, f"another than {PREFIX}{first}", one, other, "force")
    slowest = 0.5 / p.duration if p.duration > 0 else math.inf
    least = LEAST_PERIODS * p.control_period
    if not p.duration >= least * (1 - 1e-9):
        raise _beyond("duration", f"at least {LEAST_PERIODS} control periods", least, p.duration, "time")
    if not p.frequency >= slowest * (1 - 1e-9):
        raise _beyond("frequency", "at least that of half a movement in a run", slowest, p.frequency, "frequency")


def _check_hysteresis(p: ForceParameters) -> None:
    if p.xi > p.psi:
        raise _beyond("xi", f"at most {PREFIX}psi", p.psi, p.xi, "wave number")


def _beyond(name: str, limit: str, most: float, value: float, dimension: str) -> SpecError:
    return SpecError(f"{PREFIX}{name} must be {limit}, {_show(most, dimension)}; got {_show(value, dimension)}.")


def _show(value: float, dimension: str) -> str:
    return format_quantity(value, dimension, DIGITS)
