"""The benchmark that estimates and controls a lead screw's force without a sensor: RotLin paper, Sec. IV, in simulated
time.

Two unloaded runs find the zero-force line; experiments 1 to 3 press a load up to their peaks under three estimates of
its force; the force control takes two steps, with the line that was found and without; the static loops and the poles
of the linearised control stand beside them. Nothing in it is drawn by chance: one set of parameters gives one result.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.estimation_run import PlantRun
from fluxbore.design.dynamics.estimation_trials import Estimators, detect, estimators, experiment
from fluxbore.design.dynamics.force_control import no_distortion
from fluxbore.design.dynamics.force_estimation import estimate_record
from fluxbore.design.dynamics.force_limits import check
from fluxbore.design.dynamics.force_parameters import ForceParameters
from fluxbore.design.dynamics.force_poles import LARGEST_K_E, nominal_loop, pole_set, survey
from fluxbore.design.dynamics.force_stand import controller_of, stand_of
from fluxbore.design.dynamics.force_step import ForceStep, simulate_step
from fluxbore.design.dynamics.force_step_figures import step_figures
from fluxbore.design.dynamics.linearised import OBSERVER_SPEEDS
from fluxbore.design.dynamics.magnetic_hysteresis import peak_force, steady_branches, steady_loop
from fluxbore.design.dynamics.pole_distortion import PoleDistortion, one_by_one
from fluxbore.design.dynamics.simulation import Simulation, Trace, Trial
from fluxbore.design.errors import DesignError, FluxboreError
from fluxbore.design.statistics import root_mean_square

Floats = NDArray[np.float64]

BENCHMARK = "force"

LOWER = "3, lower peak"
"""The number of the run that reads experiment 3's peak otherwise."""

TRACE_POINTS = 4000
"""At most, of a kept trace."""

BRANCH_POINTS = 401
"""Of either branch of a static loop, in a trace."""


def simulate(parameters: ForceParameters, seed: int, *, traces: bool = False) -> Simulation:
    """Every run of the benchmark; the seed is noted, and changes nothing.

    A trial's setting names its run ("detection", "experiment", "step", "step without x_d0", "loop"), its number and
    its force (N). Raises SpecError or DesignError for what the actuator cannot do.
    """
    check(parameters)
    p = parameters
    with _told("the unloaded runs"):
        known = estimators(p, detect(p))
    trials = [_detection(p, known, traces)]
    trials += [_experiment(p, number, peak, known, traces) for number, peak in {**p.peaks, LOWER: p.lower_peak}.items()]
    trials += [_step(p, reference, known, traces) for reference in p.references]
    trials += [_step(p, reference, None, traces) for reference in p.references]
    trials += [_loop(p, tip, traces) for tip in (p.first_loop, p.second_loop)]
    figures = {**_figures(tuple(trials)), **_spring(p), **_poles(p)}
    dominant = figures["dominant_pole"]
    figures["step_t63_by_pole"] = {force: -t63 * dominant[force] for force, t63 in figures["step_t63"].items()}
    return Simulation(BENCHMARK, seed, tuple(trials), figures)


def _detection(p: ForceParameters, known: Estimators, traces: bool) -> Trial:
    """How well the unloaded runs tell the zero-force line; where the mover lies on it, x = h theta."""
    line = known.detection.distortion
    angle = line.first + line.spacing * np.arange(len(line.offset), dtype=np.float64)
    true = p.zero_force_line(angle, p.transfer_ratio * angle)
    figures = {
        "zero_force_line_error": _detection_error(p, line),
        "friction_found": known.detection.friction(p.spring.law),
    }
    time = (angle - angle[0]) / known.detection.speed
    signals = {"angle": angle, "zero_force_line": true, "zero_force_line_found": line.offset}
    return Trial(_setting("detection", "", 0.0), figures, Trace(time, signals) if traces else None)


def _detection_error(p: ForceParameters, line: PoleDistortion) -> float:
    """The root mean square (m) of x_d0's error over the angles that it covers, between its nodes too."""
    angle = np.linspace(line.first, line.last, 20_000)
    return root_mean_square(line(angle) - p.zero_force_line(angle, p.transfer_ratio * angle))


def _experiment(p: ForceParameters, number: str, peak: float, known: Estimators, traces: bool) -> Trial:
    with _told(f"experiment {number}"):
        run = experiment(p, peak)
    estimates = {
        name: estimate_record(each, run.log.angle, run.log.position).load_force for name, each in known.by_name.items()
    }
    errors = {f"rmse_{name}": root_mean_square(force - run.load) for name, force in estimates.items()}
    trace = _experiment_trace(p, run, estimates) if traces else None
    return Trial(_setting("experiment", number, peak), {**errors, "largest_load": float(np.max(run.load))}, trace)


def _experiment_trace(p: ForceParameters, run: PlantRun, estimates: Mapping[str, Floats]) -> Trace:
    signals = {
        "angle": run.angle,
        "position": run.position,
        "displacement": p.transfer_ratio * run.angle - run.position,
        "load_force": run.load,
        **estimates,
    }
    return _thinned(p.control_period * np.arange(len(run.load), dtype=np.float64), signals)


def _step(p: ForceParameters, reference: float, known: Estimators | None, traces: bool) -> Trial:
    """known : whose zero-force line the controller takes, if any."""
    line = no_distortion if known is None else one_by_one(known.detection.distortion)
    word = "step" if known is not None else "step without x_d0"
    with _told(f"the {word}, to {reference:g} N"):
        run = simulate_step(stand_of(p), controller_of(p, distortion=line), reference, p.duration)
    figures = {**asdict(step_figures(run)), "largest_current": float(np.max(np.abs(run.current)))}
    return Trial(_setting(word, f"{reference:g}", reference), figures, _step_trace(run) if traces else None)


def _step_trace(run: ForceStep) -> Trace:
    signals = {
        "angle": run.angle,
        "position": run.position,
        "load_force": run.force,
        "reference": np.full(len(run.time), run.reference),
        "spring_force": run.spring_force,
        "current": run.current,
    }
    return _thinned(run.time, signals)


def _loop(p: ForceParameters, tip: float, traces: bool) -> Trial:
    """A static loop about zero, once round in a period of the experiments' movement."""
    amplitude = p.transfer_ratio * math.asin(tip / p.stall_force)
    found = steady_loop(p.spring, amplitude)
    way, up, down = steady_branches(p.spring, amplitude, BRANCH_POINTS)
    signals = {"displacement": np.concatenate((way, way[::-1])), "spring_force": np.concatenate((up, down[::-1]))}
    trace = Trace(np.linspace(0, 1 / p.frequency, 2 * BRANCH_POINTS), signals) if traces else None
    return Trial(_setting("loop", f"{tip:g}", tip), asdict(found), trace)


def _figures(trials: tuple[Trial, ...]) -> dict[str, Any]:
    """What the trials tell, JSON-ready."""
    by_run: dict[str, dict[str, Mapping[str, float]]] = {}
    for trial in trials:
        by_run.setdefault(str(trial.setting["run"]), {})[str(trial.setting["number"])] = trial.figures
    errors = {
        number: {name: figures[f"rmse_{name}"] for name in ("linear", "polynomial", "proposed")}
        for number, figures in by_run["experiment"].items()
    }
    step, blind, loop = by_run["step"], by_run["step without x_d0"], by_run["loop"]
    return {
        "estimation_rmse": {number: found for number, found in errors.items() if number != LOWER},
        "estimation_rmse_lower_peak": errors[LOWER],
        "proposed_over_polynomial": {
            number: found["proposed"] / found["polynomial"] for number, found in errors.items() if number != LOWER
        },
        "linear_over_polynomial": {
            number: found["linear"] / found["polynomial"] for number, found in errors.items() if number != LOWER
        },
        **by_run["detection"][""],
        "step_t63": {force: found["t63"] for force, found in step.items()},
        "step_t98": {force: found["t98"] for force, found in step.items()},
        "step_error": {force: found["error"] for force, found in step.items()},
        "step_error_share": {force: abs(found["error"]) / float(force) for force, found in step.items()},
        "step_overshoot": {force: found["overshoot"] for force, found in step.items()},
        "step_error_without_line": {force: found["error"] for force, found in blind.items()},
        "loop_height": {force: found["height"] for force, found in loop.items()},
        "loop_area": {force: found["area"] for force, found in loop.items()},
    }


def _spring(p: ForceParameters) -> dict[str, float]:
    """memory_bound : of |x_s| (m). peak_hysteresis_force : the largest that (17) gives (N)."""
    return {"memory_bound": p.spring.memory.bound, "peak_hysteresis_force": peak_force(p.spring)}


def _poles(p: ForceParameters) -> dict[str, Any]:
    """Real parts in 1/s, of the published loop and, as `filtered`, of the one whose observer can be built."""
    published, built = (survey(p, speed) for speed in OBSERVER_SPEEDS)
    wall = nominal_loop(p).with_values({"K_e": LARGEST_K_E})
    nominal = pole_set(nominal_loop(p))
    return {
        "poles": [[float(pole.real), float(pole.imag)] for pole in nominal],
        "dominant_pole": {
            f"{force:g}": float(pole_set(nominal_loop(p, force))[0].real) for force in (0.0, *p.references)
        },
        "largest_pole_real_part": published.largest,
        "largest_pole_real_part_filtered": built.largest,
        "grid_points": published.points,
        "grid_points_unstable": published.unstable,
        "grid_points_unstable_filtered": built.unstable,
        "stiffest_load_pole_real_part": float(pole_set(wall, OBSERVER_SPEEDS[0])[0].real),
        "stiffest_load_pole_real_part_filtered": float(pole_set(wall, OBSERVER_SPEEDS[1])[0].real),
    }


@contextmanager
def _told(run: str) -> Iterator[None]:
    """What a run cannot do begins with which of the benchmark's runs it is."""
    try:
        yield
    except FluxboreError as error:
        raise DesignError(f"benchmark.force cannot be run as it is given, in {run}: {error}") from error


def _setting(run: str, number: str, force: float) -> dict[str, str | float]:
    return {"run": run, "number": number, "force": force}


def _thinned(time: Floats, signals: Mapping[str, Floats]) -> Trace:
    stride = -(-len(time) // TRACE_POINTS)
    return Trace(
        np.ascontiguousarray(time[::stride]),
        {name: np.ascontiguousarray(signal[::stride]) for name, signal in signals.items()},
    )
