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
from fluxbore.optimize.lead_screw_field import LeadScrewField, magnetised
from fluxbore.optimize.lead_screw_rates import Jacobian, rates
from fluxbore.optimize.partials import closed_gradient, differentiable, held

if TYPE_CHECKING:
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
    found, series, stall = rates(base, field, jacobian), field.series, performance.stall_force
    assert stall is not None
    share = series.peak[0] / series.pitch
    unit = _along_iron(field.screw, dict.fromkeys(found.passed, 1.0))
    figures = {name: getattr(performance, name) for name in unit}

    def completed(moved: Spec, step: float, key: str) -> Performance:
        place, screw = jacobian.keys.index(key), magnetised(moved)
        amplitude = series.amplitude + step * found.amplitude[:, place]
        changed = replace(series, amplitude=amplitude, pitch=screw.pitch)
        # The peak moves with the series', and the force there is all but level.
        shift = 0.0 if field.top is None else changed.peak[0] - share * screw.pitch
        passed = {
            member: figures[_name(member)] / unit[_name(member)] + step * by_keys[place]
            for member, by_keys in found.passed.items()
        }
        others: dict[str, float | None] = dict(_along_iron(screw, passed))
        if found.load is not None and performance.demagnetisation_load is not None:
            others["demagnetisation_load"] = performance.demagnetisation_load + step * found.load[place]
        return complete(moved, screw, changed, stall + step * found.stall[place] + found.stiffness * shift, others)

    return closed_gradient(base, jacobian.keys, completed, without=STEPWISE)


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
