"""The figures of a magnetic lead screw: from the analytic field, and from finite elements over one pitch."""

from __future__ import annotations

from collections.abc import Sequence

from fluxbore.design.lead_screw_figures import spring_constant
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import NOT_CONVERGED, OK, Evaluation, failure
from fluxbore.optimize.lead_screw_field import check_force, magnetised, periods, solve_field


def by_network(spec: Spec, gradient: Sequence[str] = ()) -> Evaluation:
    """The analytic field's figures, iron taken for infinitely permeable. Raises DesignError or MaterialError."""
    from fluxbore.design.helical_field import force_series

    series = force_series(magnetised(spec))
    check_force(spec, series.peak[1])
    return Evaluation(
        "network", OK, (), Performance(stall_force=series.peak[1], spring_constant=spring_constant(series))
    )


def by_fem(spec: Spec, gradient: Sequence[str] = ()) -> Evaluation:
    """The helical field's figures, with the iron's curves. Raises DesignError or MaterialError."""
    from fluxbore.fem.helical_force import force

    screw = magnetised(spec)
    field = solve_field(spec, screw)
    if field.failure is not None:
        where, convergence = field.failure
        return failure("fem", NOT_CONVERGED, where + convergence.sentence())
    stall = force(field.stall) * periods(screw)
    return Evaluation("fem", OK, (), Performance(stall_force=stall, spring_constant=spring_constant(field.series)))
