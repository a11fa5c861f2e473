"""What a reader of an electro-hydrostatic actuator's figures must know, and why a figure is missing."""

from __future__ import annotations

from dataclasses import fields

from fluxbore.design.hydrostatic_performance import HydrostaticFigures
from fluxbore.design.hydrostatic_values import HydrostaticDesign
from fluxbore.design.performance import FIGURES, Performance
from fluxbore.design.spec import Spec

_SHARED = (
    "hoop_stress",
    "shaft_stress",
    "shaft_safety",
    "buckling_force",
    "buckling_safety",
    "moving_mass",
    "total_mass",
    "outer_diameter",
    "length",
)
"""Figures of other kinds of actuators that this one has too."""

_OWN = frozenset((*(item.name for item in fields(HydrostaticFigures)), *_SHARED))

_DATUM = {
    "burst_factor": ("output_cylinder.material", "yield_stress"),
    "shaft_safety": ("output_cylinder.rod", "yield_stress"),
    "buckling_force": ("output_cylinder.rod", "young_modulus"),
    "buckling_safety": ("output_cylinder.rod", "young_modulus"),
}
"""Figure -> the key of a material, and what that must state."""

_LOADS = {
    "speed_load": "speed",
    "torque_load": "torque",
    "power_load": "power",
    "pressure_load": "pressure",
}


def warnings(spec: Spec, performance: Performance) -> tuple[str, ...]:
    """An operating point beyond a limit, a gland outside the standard's rules, figures that the study asks for and the
    data do not allow."""
    return (*_overloaded(performance), *_squeezed(spec), *gaps(spec, performance))


def gaps(spec: Spec, performance: Performance) -> tuple[str, ...]:
    """A sentence for each figure of the study's constraints and objective that is missing for a known reason."""
    study = spec.study
    wanted = [limit.subject for limit in study.constraints if limit.subject in FIGURES]
    wanted += [study.objective.figure] if study.objective is not None else []
    wanted += [study.pareto.against.figure] if study.pareto is not None else []
    missing = [name for name in dict.fromkeys(wanted) if getattr(performance, name) is None]
    return tuple(f"{name} is not given: {reason}." for name in missing if (reason := never(spec, name)) is not None)


def never(spec: Spec, figure: str) -> str | None:
    """Why no design of the specification's study has this figure, None where one may have it."""
    if figure not in _OWN:
        return "an electro-hydrostatic actuator has no such figure"
    if figure in _DATUM:
        leaf, datum = _DATUM[figure]
        name = str(spec.values[f"actuator.{leaf}"])
        if name in spec.materials and getattr(spec.materials[name], datum) is None:
            return f'"{name}" states no {datum}'
    if figure == "power_load" and "actuator.motor.rated_power" not in spec.values:
        return "actuator.motor.rated_power is not given"
    if figure == "force_frequency_limit" and spec.values["actuator.return_spring.element"] == "constant force":
        return "a constant force asks for no speed"
    return None


def _overloaded(performance: Performance) -> list[str]:
    found = [
        f"{value:.1%} of the {word}"
        for figure, word in _LOADS.items()
        if (value := getattr(performance, figure)) is not None and value > 1 + 1e-9
    ]
    return [f"The operating point asks for more than there is: {' and '.join(found)}."] if found else []


def _squeezed(spec: Spec) -> list[str]:
    from fluxbore.design.errors import DesignError
    from fluxbore.design.seal_gland import check_gland

    design: HydrostaticDesign = spec.actuator
    try:
        check_gland(design.gland)
    except DesignError as error:
        return [f"The piston's gland is outside the handbook's rules: {error}"]
    return []
