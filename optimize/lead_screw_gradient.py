"""Exact gradients of a magnetic lead screw's figures: adjoints for the fields, closed forms for the rest.

The adjoint fields give what is read off each displacement's field by all that is continuous in its section
(`fem.helical_gradient`); the section's dimensions by the specification's keys, and the figures by what the fields give
and by the dimensions, are closed forms (`partials`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from fluxbore.design.lead_screw_keys import MEMBERS
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import Gradient
from fluxbore.optimize.lead_screw_common import complete
from fluxbore.optimize.lead_screw_field import LeadScrewField, magnetised, peak_share, periods
from fluxbore.optimize.lead_screw_rates import Jacobian, Rates, rates
from fluxbore.optimize.partials import closed_gradient, differentiable, held

if TYPE_CHECKING:
    from fluxbore.design.force_series import ForceSeries
    from fluxbore.design.lead_screw import LeadScrew

STEPWISE = ("demagnetised_fraction",)
"""Figures that count points: their derivative is zero or does not exist. `demagnetisation_load` stands in for it."""


def gradient(spec: Spec, field: LeadScrewField, performance: Performance, keys: Sequence[str]) -> Gradient:
    """Figure -> key -> derivative (SI), of the figures of a converged field.

    Keys that are not continuous are passed over, and those by which the section changes its topology.
    """
    base = spec.pinned(keys)
    wanted = differentiable(base, keys)
    base = held(base, wanted)
    jacobian = Jacobian(base, field, wanted)
    if not jacobian.keys:
        return {}
    found, series = rates(base, field, jacobian), field.series
    unit = _along_iron(field.screw, dict.fromkeys(found.passed, 1.0))
    figures = {name: getattr(performance, name) for name in unit}

    def completed(moved: Spec, step: float, key: str) -> Performance:
        place, screw = jacobian.keys.index(key), magnetised(moved)
        amplitude = series.amplitude + step * found.amplitude[:, place]
        changed = replace(series, amplitude=amplitude, pitch=screw.pitch)
        passed = {
            member: figures[_name(member)] / unit[_name(member)] + step * by_keys[place]
            for member, by_keys in found.passed.items()
        }
        others: dict[str, float | None] = dict(_along_iron(screw, passed))
        if found.load is not None and performance.demagnetisation_load is not None:
            others["demagnetisation_load"] = performance.demagnetisation_load + step * found.load[place]
        return complete(moved, screw, changed, _stall(field, changed, found, place, step), others)

    return closed_gradient(base, jacobian.keys, completed, without=STEPWISE)


def _stall(field: LeadScrewField, changed: ForceSeries, found: Rates, key: int, step: float) -> float:
    """The largest force (N) after a step of a key, with the series that it changes: at the peak's own new place."""
    from fluxbore.fem.helical_force import force

    before, pitch = field.series.peak[0] / field.series.pitch, field.screw.pitch
    after = changed.peak[0] / changed.pitch
    top, *beside = (
        force(state) * periods(field.screw) + step * by_keys[key]
        for state, by_keys in zip((field.stall, *field.beside), found.stall, strict=True)
    )
    if not beside:
        return float(top)
    below, above = (
        value + slope * (after - before) * pitch for value, slope in zip(beside, found.stiffness[1:], strict=True)
    )
    shift = peak_share(changed, after, below, above) - field.stall.section.displacement / pitch
    return float(top + found.stiffness[0] * shift * pitch)


def _along_iron(screw: LeadScrew, passed: dict[str, float]) -> dict[str, float]:
    """The figures of the flux (Wb/rad) that passes along the members' iron."""
    from fluxbore.design.lead_screw_figures import along_iron

    found = {}
    for member, flux in passed.items():
        own = getattr(screw, member)
        inner = screw.radii[0] - own.iron_thickness if member == MEMBERS[0] else screw.radii[-1]
        value = along_iron(screw, flux, inner, inner + own.iron_thickness)
        assert value is not None
        found[_name(member)] = value
    return found


def _name(member: str) -> str:
    return f"{member}_iron_flux_density"
