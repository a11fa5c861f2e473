"""What a lead screw's specification has for the parameters of its magnetic spring's laws."""

from __future__ import annotations

import math
from collections.abc import Mapping

from fluxbore.design.errors import SpecError
from fluxbore.design.force_benchmark_keys import PREFIX
from fluxbore.design.specification import Spec

FIXED = ("phi", "eta")
"""Of the memory (18): its identification has them at one."""


def spring_parameters(spec: Spec, law: str) -> Mapping[str, float]:
    """By the names of `identify_spring`, in SI: for "linear", "sine" or "hysteresis".

    Stall force and spring constant are those of the section benchmark.force; where it leaves them out, those of the
    analytic field. Raises SpecError for a memory of another phi or eta than one, whose psi and xi mean something else;
    DesignError or MaterialError for a screw that has no field.
    """
    if law == "linear":
        return {"spring_constant": _own(spec, "spring_constant")}
    pitch = spec.number("actuator.pitch")
    stall, ratio = _own(spec, "stall_force"), pitch / math.tau
    sine = {"stall_force": stall, "transfer_ratio": ratio, "spring_constant": stall / ratio, "pitch": pitch}
    if law == "sine":
        return sine
    for name in FIXED:
        if (value := spec.number(PREFIX + name)) != 1.0:
            raise SpecError(f"{PREFIX}{name} must be 1, as the memory is identified with it; got {value:g}.")
    psi, xi = spec.number(PREFIX + "psi"), spec.number(PREFIX + "xi")
    return {
        **sine,
        "weight": spec.number(PREFIX + "elastic_share"),
        "rising_rate": psi + xi,
        "falling_rate": psi - xi,
        "psi": psi,
        "xi": xi,
    }


def _own(spec: Spec, name: str) -> float:
    """The stand's value, else the design's."""
    if PREFIX + name in spec.values:
        return spec.number(PREFIX + name)
    from fluxbore.design.helical_field import force_series
    from fluxbore.design.lead_screw_figures import spring_constant

    series = force_series(spec.actuator.magnetised(spec.materials, spec.number("operating_point.magnet_temperature")))
    return series.peak[1] if name == "stall_force" else spring_constant(series)
