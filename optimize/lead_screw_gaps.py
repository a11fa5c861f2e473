"""Why a lead screw lacks a figure that a study asks for."""

from __future__ import annotations

from dataclasses import fields

from fluxbore.design.lead_screw_performance import LeadScrewFigures
from fluxbore.design.performance import FIGURES, Performance
from fluxbore.design.spec import Spec

_SHARED = (
    "demagnetised_fraction",
    "demagnetisation_load",
    "moving_mass",
    "total_mass",
    "outer_diameter",
    "length",
)
"""Figures of other kinds of actuators that a lead screw has too."""

_OWN = frozenset((*(item.name for item in fields(LeadScrewFigures)), *_SHARED))

_IRON = {f"{member}_iron_flux_density": f"actuator.{member}.iron_thickness" for member in ("translator", "rotor")}

_OTHERWISE = {
    "load_displacement": "operating_point.load_force is beyond the stall force",
    "slip_margin": "operating_point.load_force and operating_point.acceleration load nothing",
    "natural_frequency": "the spring has no positive slope at rest",
}
"""Figure -> why it is missing in a design that can have it."""


def gaps(spec: Spec, performance: Performance) -> tuple[str, ...]:
    """A sentence for each figure of the study's constraints and objective that is missing for a known reason."""
    study = spec.study
    wanted = [limit.subject for limit in study.constraints if limit.subject in FIGURES]
    wanted += [study.objective.figure] if study.objective is not None else []
    wanted += [study.pareto.against.figure] if study.pareto is not None else []
    missing = [name for name in dict.fromkeys(wanted) if getattr(performance, name) is None]
    return tuple(f"{name} is not given: {reason}." for name in missing if (reason := _reason(spec, name)) is not None)


def never(spec: Spec, figure: str) -> str | None:
    """Why no design of the specification's study has this figure, None where one may have it."""
    if figure not in _OWN:
        return "a magnetic lead screw has no such figure"
    moved = {variable.key for variable in spec.study.variables}
    if figure in _IRON and _IRON[figure] in moved:
        return None
    if figure == "motor_current" and "actuator.motor.torque_constant" in moved:
        return None
    return _lacking(spec, figure)


def _reason(spec: Spec, figure: str) -> str | None:
    return never(spec, figure) or _lacking(spec, figure) or _OTHERWISE.get(figure)


def _lacking(spec: Spec, figure: str) -> str | None:
    if figure in _IRON and spec.number(_IRON[figure]) == 0:
        return f"{_IRON[figure]} is 0"
    if figure == "motor_current" and "actuator.motor.torque_constant" not in spec.values:
        return "actuator.motor.torque_constant is not given"
    if figure.startswith("demagneti"):
        cut = [key for key in ("actuator.translator.arc_angle", "actuator.rotor.arc_angle") if key in spec.values]
        if cut:
            return f"{cut[0]} is given, and of magnets in arcs only their mean over a turn is computed"
    return None
