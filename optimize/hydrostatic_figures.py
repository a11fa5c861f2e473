"""The figures of an electro-hydrostatic actuator: in closed form, and with its operating point simulated in time.

The first route is named "network", the second "fem", as those of the other kinds are: what is quick, and what is exact.
Pressures and losses are the quasi-static cycle's in the one and the simulation's in the other; tracking errors are the
simulation's alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import OK, Evaluation
from fluxbore.optimize.hydrostatic_common import (
    common_figures,
    operating_cycle,
    operating_point,
    pressure_figures,
    weighed,
)
from fluxbore.optimize.hydrostatic_gaps import warnings
from fluxbore.optimize.partials import closed_gradient


def by_network(spec: Spec, gradient: Sequence[str] = ()) -> Evaluation:
    """The figures in closed form. Raises DesignError or MaterialError."""
    performance, details = _closed(spec)
    found = Evaluation("network", OK, (), performance, details=details, warnings=warnings(spec, performance))
    if not gradient:
        return found
    return replace(found, gradient=closed_gradient(spec, gradient, lambda moved, *_: _closed(moved)[0]), norms={})


def _closed(spec: Spec) -> tuple[Performance, dict[str, float]]:
    actuator = weighed(spec)
    cycle = operating_cycle(spec, actuator)
    performance = replace(
        common_figures(spec, actuator, cycle),
        **pressure_figures(
            spec, actuator, cycle.peak_output, cycle.peak_input, cycle.peak_input, cycle.least, cycle.loss
        ),
    )
    details = {"operating_speed": cycle.speed, "operating_way": cycle.way, "fluid_loss": cycle.loss}
    return performance, {**details, "peak_input_pressure": cycle.peak_input}


def by_fem(spec: Spec, gradient: Sequence[str] = ()) -> Evaluation:
    """The same, with pressures, losses and tracking errors simulated in time. Raises DesignError or MaterialError."""
    from fluxbore.optimize.hydrostatic_simulation import track

    actuator = weighed(spec)
    cycle = operating_cycle(spec, actuator)
    common = common_figures(spec, actuator, cycle)  # what cannot be built is refused before anything is simulated
    run = track(actuator, *operating_point(spec))
    performance = replace(
        common,
        tracking_error=run.error,
        mean_tracking_error=run.mean_error,
        energy_imbalance=run.imbalance,
        **pressure_figures(spec, actuator, run.peak_output, run.peak_input, run.peak_hose, run.least, run.loss),
    )
    details = {
        "operating_speed": cycle.speed,
        "operating_way": cycle.way,
        "fluid_loss": run.loss,
        "peak_input_pressure": run.peak_input,
        "simulated_time": run.time,
        "step": run.step,
    }
    return Evaluation("fem", OK, (), performance, details=details, warnings=warnings(spec, performance))
