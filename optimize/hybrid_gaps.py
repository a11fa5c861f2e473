"""Why a figure that a study asks for is not given: the datum that a material lacks, or a load that is not there."""

from __future__ import annotations

from fluxbore.design.materials import Material, lookup
from fluxbore.design.performance import FIGURES, Performance
from fluxbore.design.spec import Spec

_TUBE, _LIP = "actuator.cylinder.material", "actuator.piston.fin_material"

_ELASTIC = (_LIP, ("young_modulus", "poisson_ratio"))
_FIT = ((_LIP, ("thermal_expansion",)), (_TUBE, ("thermal_expansion",)))

_DATA: dict[str, tuple[tuple[str, tuple[str, ...]], ...]] = {
    "cylinder_safety": ((_TUBE, ("yield_stress",)),),
    "cap_safety": ((_TUBE, ("yield_stress",)), ("actuator.end_caps.material", ("yield_stress",))),
    "bore_dilation": ((_TUBE, ("young_modulus", "poisson_ratio")),),
    "bore_clearance": ((_TUBE, ("young_modulus", "poisson_ratio")),),
    "eddy_loss": ((_TUBE, ("resistivity",)),),
    "iron_loss": (("actuator.back_yoke.material", ("hysteresis_coefficient", "resistivity")),),
    "shaft_safety": (("actuator.shaft.material", ("yield_stress",)),),
    "buckling_force": (("actuator.shaft.material", ("young_modulus",)),),
    "buckling_safety": (("actuator.shaft.material", ("young_modulus",)),),
    "seal_friction": (_ELASTIC,),
    "seal_friction_variation": (_ELASTIC,),
    "fin_interference": _FIT,
    "largest_interference": _FIT,
    "lip_contact_force": (_ELASTIC,),
    "lip_contact_pressure": (_ELASTIC,),
    "seal_wear": (_ELASTIC,),
    "sealing_margin": (_ELASTIC, *_FIT),
    "lip_stress": (_ELASTIC, *_FIT),
    "lip_safety": (_ELASTIC, (_LIP, ("yield_stress",)), *_FIT),
    "air_leakage": (_ELASTIC, *_FIT),
    "seal_life": (_ELASTIC, *_FIT),
}
"""Figure -> the keys of the materials that it needs, and what of each."""

_FRICTION = ("seal_friction", "seal_friction_variation")

_OTHERWISE = {
    "cylinder_safety": "operating_point.pressure does not load the cylinder",
    "cap_safety": "no set screws hold the end caps, or operating_point.pressure does not push them",
    "shaft_safety": "nothing loads the shaft at operating_point.pressure and operating_point.peak_current",
    "buckling_safety": "nothing pushes on the shaft at operating_point.pressure and operating_point.peak_current",
    "sealing_margin": "operating_point.pressure leaves nothing to seal",
    "air_leakage": "the fin does not press on the bore at the worst of tolerances and temperatures",
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
    measured = figure in _FRICTION and "actuator.seal.contact_force" in spec.values
    for key, data in () if measured else _DATA.get(figure, ()):
        material = lookup(spec.word(key), key, spec.materials, Material)
        own = key == _LIP and "actuator.piston.fin_modulus" in spec.values
        known = {"young_modulus"} if own else set()
        lacking = [name for name in data if name not in known and getattr(material, name, None) is None]
        if lacking:
            return f'{key} "{material.name}" states no {" and no ".join(lacking)}'
    if figure in _PEAK and "operating_point.peak_current" not in spec.given:
        return "operating_point.peak_current is not given"
    if figure in _SUPPLY and "operating_point.supply_voltage" not in spec.values:
        return "operating_point.supply_voltage is not given"
    return None
