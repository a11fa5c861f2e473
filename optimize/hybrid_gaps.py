"""Why a figure that a study asks for is not given: the datum that a material lacks, or a load that is not there."""

from __future__ import annotations

from fluxbore.design.materials import Material, lookup
from fluxbore.design.performance import FIGURES, Performance
from fluxbore.design.spec import Spec

_DATA = {
    "cylinder_safety": ("actuator.cylinder.material", ("yield_stress",)),
    "bore_dilation": ("actuator.cylinder.material", ("young_modulus", "poisson_ratio")),
    "bore_clearance": ("actuator.cylinder.material", ("young_modulus", "poisson_ratio")),
    "eddy_loss": ("actuator.cylinder.material", ("resistivity",)),
    "iron_loss": ("actuator.back_yoke.material", ("hysteresis_coefficient", "resistivity")),
    "shaft_safety": ("actuator.shaft.material", ("yield_stress",)),
    "buckling_force": ("actuator.shaft.material", ("young_modulus",)),
    "buckling_safety": ("actuator.shaft.material", ("young_modulus",)),
    "lip_contact_force": ("actuator.piston.fin_material", ("young_modulus", "poisson_ratio")),
    "lip_contact_pressure": ("actuator.piston.fin_material", ("young_modulus", "poisson_ratio")),
    "seal_wear": ("actuator.piston.fin_material", ("young_modulus", "poisson_ratio")),
}
"""Figure -> the key of the material that it needs, and what of it."""

_OTHERWISE = {
    "cylinder_safety": "operating_point.pressure does not load the cylinder",
    "shaft_safety": "nothing loads the shaft at operating_point.pressure and operating_point.peak_current",
    "buckling_safety": "nothing pushes on the shaft at operating_point.pressure and operating_point.peak_current",
}
"""Figure -> why it is missing although the data are there."""

_SUPPLY = ("voltage_margin", "no_load_speed", "speed_limit")

_PEAK = ("peak_force", "saturation_ratio", "peak_demagnetised_fraction")

_OF_COILS = (
    "stored_energy",
    "central_flux_density",
    "stray_flux_density",
    "winding_flux_density",
    "quench_load",
    "joule_loss",
    "merit",
)


def gaps(spec: Spec, performance: Performance) -> tuple[str, ...]:
    """A sentence for each figure of the study's constraints and objective that is missing for a known reason."""
    study = spec.study
    wanted = [limit.subject for limit in study.constraints if limit.subject in FIGURES]
    wanted += [study.objective.figure] if study.objective is not None else []
    wanted += [study.pareto.against.figure] if study.pareto is not None else []
    missing = [name for name in dict.fromkeys(wanted) if getattr(performance, name) is None]
    return tuple(f"{name} is not given: {reason}." for name in missing if (reason := _reason(spec, name)) is not None)


def never(spec: Spec, figure: str) -> str | None:
    """Why no design of the specification's study has this figure, as far as that is known without a field.

    None where a design may have it. Materials cannot vary; what a variable moves is given.
    """
    moved = {variable.key for variable in spec.study.variables}
    if figure in _OF_COILS:
        return "only coils have it"
    for figures, key in ((_PEAK, "operating_point.peak_current"), (_SUPPLY, "operating_point.supply_voltage")):
        if figure in figures and key in moved:
            return None
    return _lacking(spec, figure)


def _reason(spec: Spec, figure: str) -> str | None:
    return _lacking(spec, figure) or _OTHERWISE.get(figure)


def _lacking(spec: Spec, figure: str) -> str | None:
    if figure in _DATA:
        key, data = _DATA[figure]
        material = lookup(spec.word(key), key, spec.materials, Material)
        lacking = [name for name in data if getattr(material, name, None) is None]
        if lacking:
            return f'{key} "{material.name}" states no {" and no ".join(lacking)}'
    if figure in _PEAK and "operating_point.peak_current" not in spec.given:
        return "operating_point.peak_current is not given"
    if figure in _SUPPLY and "operating_point.supply_voltage" not in spec.values:
        return "operating_point.supply_voltage is not given"
    return None
