"""The Python interface to identification: a model's parameters from a file of measurements, for a specification."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from fluxbore.design.errors import SpecError, shown
from fluxbore.design.identification import Identified, check_level
from fluxbore.design.keys import Value
from fluxbore.design.spec import Spec, loads
from fluxbore.design.spec_file import template
from fluxbore.reading import as_spec

if TYPE_CHECKING:
    from fluxbore.design.measurements import Measurements


@dataclass(frozen=True, slots=True, eq=False)
class Model:
    """What can be identified.

    kind : of actuator. template : the specification to go by where none is given. section : of the keys that bear the
    parameters' names. symbols : parameter -> its symbol. free : parameters that are found only where asked for.
    measured : the dimension of what the model gives, and of the scatter about it. taken : what the fit takes as known
    from a specification, in SI with its dimension. read, fit : a file's measurements, and the parameters that follow
    from them; fit's last arguments are the level and the parameters asked for.
    """

    name: str
    kind: str
    template: str
    section: str
    symbols: Mapping[str, str]
    free: tuple[str, ...]
    measured: str
    read: Callable[[Path | str], Measurements]
    taken: Callable[[Spec], Mapping[str, tuple[float, str]]]
    fit: Callable[[Measurements, Spec, float, Sequence[str]], Identified]


@dataclass(frozen=True, slots=True, eq=False)
class Identification:
    """A model's parameters from a file.

    spec : that the fit went by, the model's template where `own_spec` is false. rows : of the file. taken : what the
    fit took from it as known, in SI with its dimension. given : the specification's own values of the parameters.
    """

    model: Model
    found: Identified
    spec: Spec
    own_spec: bool
    rows: int
    taken: Mapping[str, tuple[float, str]]
    given: Mapping[str, Value]


def identify(
    model: str,
    data: Path | str,
    *,
    spec: Spec | Path | str | None = None,
    level: float = 0.95,
    free: Sequence[str] = (),
) -> Identification:
    """The parameters of a model ("friction") from a CSV file, with their intervals at a level of confidence.

    spec : the actuator that was measured; without it the model's template. free : parameters that stay as they are
    unless asked for, such as "viscous_coefficient".

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
    by = loads(template(known.template)) if spec is None else as_spec(spec)
    if by.kind.name != known.kind:
        raise SpecError(f'actuator.kind must be "{known.kind}" to identify {model}; got "{by.kind.name}".')
    measured = known.read(data)
    found = known.fit(measured, by, level, free)
    keys = {name: f"{known.section}.{name}" for name in found.parameters}
    given = {name: by.values[key] for name, key in keys.items() if key in by.values}
    return Identification(known, found, by, spec is not None, len(measured), known.taken(by), given)


def _read_friction(path: Path | str) -> Measurements:
    from fluxbore.design.friction_points import COLUMNS, RECORD_COLUMNS
    from fluxbore.design.measurements import read_measurements

    return read_measurements(path, COLUMNS, optional=RECORD_COLUMNS)


def _contact_area(spec: Spec) -> Mapping[str, tuple[float, str]]:
    from fluxbore.design.seal import contact_area

    return {"contact area": (contact_area(spec.actuator), "area")}


def _fit_friction(measured: Measurements, spec: Spec, level: float, free: Sequence[str]) -> Identified:
    from fluxbore.design.friction_identification import identify_friction
    from fluxbore.design.friction_points import friction_points
    from fluxbore.design.pneumatics import piston_area
    from fluxbore.design.seal import contact_area

    points = friction_points(measured, piston_area=piston_area(spec.actuator))
    viscous = "viscous_coefficient" in free
    return identify_friction(points, contact_area(spec.actuator), level=level, viscous=viscous)


MODELS = {
    model.name: model
    for model in (
        Model(
            name="friction",
            kind="hybrid",
            template="ipehla",
            section="actuator.seal",
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
            taken=_contact_area,
            fit=_fit_friction,
        ),
    )
}
"""What `identify` knows, by name; another model is another line."""
