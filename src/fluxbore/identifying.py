"""The Python interface to identification: a model's parameters from a file of measurements, for a specification."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from fluxbore.design.errors import SpecError, shown
from fluxbore.design.identification import Identified, check_level
from fluxbore.design.spec import Spec, loads
from fluxbore.design.spec_file import template
from fluxbore.design.specification import KINDS
from fluxbore.reading import as_spec

if TYPE_CHECKING:
    from fluxbore.design.measurements import Measurements


@dataclass(frozen=True, slots=True, eq=False)
class Specified:
    """How a model goes by a specification.

    kind : of actuator. keys : parameter -> the key that holds it. own : what the specification itself has for a
    parameter, in SI. template : the specification to go by where none is given; None where the fit needs none. taken :
    what the fit takes as known from it, in SI with its dimension.
    """

    kind: str
    keys: Mapping[str, str]
    own: Callable[[Spec], Mapping[str, float]]
    template: str | None = None
    taken: Callable[[Spec], Mapping[str, tuple[float, str]]] = lambda spec: {}


@dataclass(frozen=True, slots=True, eq=False)
class Model:
    """What can be identified.

    symbols : parameter -> its symbol. free : parameters that are found only where asked for. measured : the dimension
    of what the model gives, and of the scatter about it. read, fit : a file's measurements, and the parameters that
    follow from them; fit's last arguments are the level and the parameters asked for; its specification is None where
    none is given and none needed. specified : None where no specification holds what is found.
    """

    name: str
    symbols: Mapping[str, str]
    free: tuple[str, ...]
    measured: str
    read: Callable[[Path | str], Measurements]
    fit: Callable[[Measurements, Spec | None, float, Sequence[str]], Identified]
    specified: Specified | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Identification:
    """A model's parameters from a file.

    spec : that the fit went by, the model's template where `own_spec` is false, None where it went by the data alone.
    rows : of the file. taken : what the fit took from it as known, in SI with its dimension. given : what the
    specification itself has for the parameters and for what follows from them.
    """

    model: Model
    found: Identified
    spec: Spec | None
    own_spec: bool
    rows: int
    taken: Mapping[str, tuple[float, str]]
    given: Mapping[str, float]


def identify(
    model: str,
    data: Path | str,
    *,
    spec: Spec | Path | str | None = None,
    level: float = 0.95,
    free: Sequence[str] = (),
) -> Identification:
    """The parameters of a model ("friction", "cylinder-friction") from a CSV file, with intervals at a level.

    spec : the actuator that was measured; without it the model's template, if it has one. free : parameters that stay
    as they are unless asked for, such as "viscous_coefficient".

    Raises MeasurementError where the file cannot be read, IdentificationError where it does not tell a parameter, and
    names which; SpecError for a model, a level or a parameter that is none.
    """
    if model not in MODELS:
        raise SpecError(f"model must be one of {', '.join(MODELS)}; got {shown(model)}.")
    known = MODELS[model]
    check_level(level)
    for name in free:
        if name not in known.free:
            raise SpecError(f"free must be one of {', '.join(known.free)} for {model}; got {shown(name)}.")
    by, taken, own = _specified(known, spec)
    measured = known.read(data)
    found = known.fit(measured, by, level, free)
    taken = {name: each for name, each in taken.items() if name not in free}
    given = {name: own[name] for name in (*found.parameters, *found.derived) if name in own}
    return Identification(known, found, by, spec is not None, len(measured), taken, given)


def _specified(
    model: Model, spec: Spec | Path | str | None
) -> tuple[Spec | None, Mapping[str, tuple[float, str]], Mapping[str, float]]:
    """What a fit goes by: the specification, what it takes from it as known, and what that has for the parameters."""
    how = model.specified
    if how is None and spec is not None:
        raise SpecError(f"--spec must be left out: {model.name} is identified from its data alone.")
    if how is None or (spec is None and how.template is None):
        return None, {}, {}
    by = loads(template(str(how.template))) if spec is None else as_spec(spec)
    if by.kind.name != how.kind:
        raise SpecError(f'actuator.kind must be "{how.kind}" to identify {model.name}; got "{by.kind.name}".')
    return by, how.taken(by), how.own(by)


def _read_friction(path: Path | str) -> Measurements:
    from fluxbore.design.friction_points import COLUMNS, RECORD_COLUMNS
    from fluxbore.design.measurements import read_measurements

    return read_measurements(path, COLUMNS, optional=RECORD_COLUMNS)


def _contact_area(spec: Spec) -> Mapping[str, tuple[float, str]]:
    from fluxbore.design.seal import contact_area

    return {"contact area": (contact_area(spec.actuator), "area")}


_FRICTION_KEYS = {
    name: f"actuator.seal.{name}"
    for name in (
        "static_coefficient",
        "coulomb_coefficient",
        "contact_force",
        "stribeck_speed",
        "viscous_coefficient",
    )
}


def _own_friction(spec: Spec) -> Mapping[str, float]:
    return {name: spec.number(key) for name, key in _FRICTION_KEYS.items()}


def _fit_friction(measured: Measurements, spec: Spec | None, level: float, free: Sequence[str]) -> Identified:
    from fluxbore.design.friction_identification import identify_friction
    from fluxbore.design.friction_points import friction_points
    from fluxbore.design.pneumatics import piston_area
    from fluxbore.design.seal import contact_area

    assert spec is not None  # the model has a template to go by
    points = friction_points(measured, piston_area=piston_area(spec.actuator))
    viscous = "viscous_coefficient" in free
    return identify_friction(points, contact_area(spec.actuator), level=level, viscous=viscous)


def _read_spring(path: Path | str) -> Measurements:
    from fluxbore.design.measurements import read_measurements
    from fluxbore.design.spring_identification import COLUMNS, TIME

    return read_measurements(path, COLUMNS, optional=(TIME,))


def _spring(
    name: str,
    law: str,
    symbols: Mapping[str, str],
    free: tuple[str, ...] = ("zero_displacement",),
    keys: Mapping[str, str] | None = None,
) -> Model:
    """A law of the magnetic spring, from displacement and force. keys : parameters that a specification holds."""

    def own(spec: Spec) -> Mapping[str, float]:
        from fluxbore.design.lead_screw_spring import spring_parameters

        return spring_parameters(spec, law)

    def fit(measured: Measurements, _: Spec | None, level: float, free: Sequence[str]) -> Identified:
        from fluxbore.design.spring_identification import identify_spring

        return identify_spring(law, measured, level=level, free=free)

    return Model(
        name,
        {**symbols, "zero_displacement": "x_0"},
        free,
        "force",
        _read_spring,
        fit,
        None if keys is None else Specified("lead-screw", keys, own),
    )


_CYLINDER_KEYS = {
    name: f"actuator.friction.{name}"
    for name in ("preload", "stribeck_force", "stribeck_decay", "viscous_coefficient", "pressure_coefficient")
}


def _read_cylinder(path: Path | str) -> Measurements:
    from fluxbore.design.friction_points import COLUMNS
    from fluxbore.design.measurements import read_measurements

    return read_measurements(path, COLUMNS)


def _own_cylinder(spec: Spec) -> Mapping[str, float]:
    return {name: spec.number(key) for name, key in _CYLINDER_KEYS.items()}


def _pressure_coefficient(spec: Spec) -> Mapping[str, tuple[float, str]]:
    key = _CYLINDER_KEYS["pressure_coefficient"]
    return {"pressure_coefficient": (spec.number(key), spec.kind.known(key).dimension)}


def _fit_cylinder(measured: Measurements, spec: Spec | None, level: float, free: Sequence[str]) -> Identified:
    from fluxbore.design.friction_points import friction_points
    from fluxbore.design.hydrostatic_friction_identification import identify_cylinder_friction

    taken = spec is not None and "pressure_coefficient" not in free
    known = spec.number(_CYLINDER_KEYS["pressure_coefficient"]) if spec is not None and taken else None
    found = identify_cylinder_friction(friction_points(measured), level=level, known_pressure_coefficient=known)
    # In the dimensions of the specification's keys.
    parameters = {
        name: replace(each, dimension=KINDS["hydrostatic"].known(_CYLINDER_KEYS[name]).dimension)
        for name, each in found.parameters.items()
    }
    return replace(found, parameters=parameters)


_STALL = {"stall_force": "benchmark.force.stall_force"}
_SINE = {"stall_force": "F_stall", "transfer_ratio": "h", "spring_constant": "F_stall/h", "pitch": "l_p"}

MODELS = {
    model.name: model
    for model in (
        Model(
            name="friction",
            symbols={
                "static_coefficient": "mu_S",
                "coulomb_coefficient": "mu_C",
                "contact_force": "F_0",
                "stribeck_speed": "v_s",
                "viscous_coefficient": "sigma_2",
                "static_force": "mu_S F_0",
                "coulomb_force": "mu_C F_0",
            },
            free=("viscous_coefficient",),
            measured="force",
            read=_read_friction,
            fit=_fit_friction,
            specified=Specified("hybrid", _FRICTION_KEYS, _own_friction, "ipehla", _contact_area),
        ),
        _spring(
            "magnetic-spring",
            "hysteresis",
            {
                **_SINE,
                "weight": "w",
                "rising_rate": "psi + xi",
                "falling_rate": "psi - xi",
                "psi": "psi",
                "xi": "xi",
                "start_state": "x_s(0)",
            },
            ("zero_displacement", "start_state"),
            {
                **_STALL,
                "weight": "benchmark.force.elastic_share",
                "psi": "benchmark.force.psi",
                "xi": "benchmark.force.xi",
            },
        ),
        _spring("magnetic-spring-sine", "sine", _SINE, keys=_STALL),
        _spring(
            "magnetic-spring-linear",
            "linear",
            {"spring_constant": "K_s"},
            keys={"spring_constant": "benchmark.force.spring_constant"},
        ),
        _spring("magnetic-spring-polynomial", "polynomial", {"k1": "k_1", "k3": "k_3", "k5": "k_5"}),
        Model(
            name="cylinder-friction",
            symbols={
                "preload": "F_preload",
                "stribeck_force": "F_S0",
                "stribeck_decay": "c",
                "viscous_coefficient": "f_v",
                "pressure_coefficient": "f_C",
            },
            free=("pressure_coefficient",),
            measured="force",
            read=_read_cylinder,
            fit=_fit_cylinder,
            specified=Specified("hydrostatic", _CYLINDER_KEYS, _own_cylinder, taken=_pressure_coefficient),
        ),
    )
}
"""What `identify` knows, by name; another model is another line."""
