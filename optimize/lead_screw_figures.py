"""The figures of a magnetic lead screw: from the analytic field, and from finite elements over one pitch.

Both routes fill the same `Performance` from a force over displacement; what neither field decides (masses, inertia, the
gear) is computed once, by the same functions, for both.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from fluxbore.design.lead_screw import LeadScrew
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import NOT_CONVERGED, OK, Evaluation, failure
from fluxbore.optimize.lead_screw_common import amplitudes, common_figures, complete, warnings
from fluxbore.optimize.lead_screw_field import check_force, field_figures, magnetised, periods, solve_field
from fluxbore.optimize.partials import closed_gradient

if TYPE_CHECKING:
    from fluxbore.design.force_series import ForceSeries


def by_network(spec: Spec, gradient: Sequence[str] = ()) -> Evaluation:
    """The analytic field's figures, iron taken for infinitely permeable. Raises DesignError or MaterialError."""
    screw = magnetised(spec)
    series, performance = _analytic(spec, screw)
    details = {"stall_displacement": series.peak[0], **amplitudes(series)}
    told = warnings(spec, performance, ideal_iron=True)
    found = Evaluation("network", OK, (), performance, details=details, warnings=told)
    if not gradient:
        return found
    slopes = closed_gradient(spec, gradient, lambda moved, *_: _analytic(moved, magnetised(moved))[1])
    return replace(found, gradient=slopes, norms={})


def _analytic(spec: Spec, screw: LeadScrew) -> tuple[ForceSeries, Performance]:
    """The closed form's force over displacement, and all figures. Raises DesignError where no force pulls back."""
    from fluxbore.design.helical_field import force_series
    from fluxbore.design.lead_screw_figures import back_iron_flux_density

    series = force_series(screw)
    check_force(spec, series.peak[1])
    inside, outside = back_iron_flux_density(screw)
    field = {"translator_iron_flux_density": inside, "rotor_iron_flux_density": outside}
    return series, complete(spec, screw, series, series.peak[1], field)


def by_fem(spec: Spec, gradient: Sequence[str] = ()) -> Evaluation:
    """The helical field's figures, with the iron's curves. Raises DesignError or MaterialError."""
    from fluxbore.fem.helical_force import force, torque

    screw = magnetised(spec)
    common_figures(spec, screw)  # what cannot be built is refused before anything is solved
    field = solve_field(spec, screw)
    if field.failure is not None:
        where, convergence = field.failure
        return failure("fem", NOT_CONVERGED, where + convergence.sentence())
    series, states = field.series, list(field.solved)
    stall = force(field.stall) * periods(screw)
    performance = complete(spec, screw, series, stall, field_figures(spec, field))
    place, topology = field.stall.section.displacement, field.rest.system.topology
    details = {
        "elements": float(topology.elements.shape[0]),
        "unknowns": float(topology.unknowns),
        "newton_iterations": float(sum(item.convergence.iterations for item in states)),
        "largest_residual": max(item.convergence.residual for item in states),
        "stall_displacement": place,
        "torque_over_h_force": torque(field.stall) / (screw.h * force(field.stall)),
        "series_miss": float(series.force(place)) / stall - 1,
        **amplitudes(series),
    }
    told = warnings(spec, performance, ideal_iron=False)
    found = Evaluation("fem", OK, (), performance, details=details, warnings=told)
    if not gradient:
        return found
    from fluxbore.optimize import lead_screw_gradient

    return replace(found, gradient=lead_screw_gradient.gradient(spec, field, performance, gradient), norms={})
