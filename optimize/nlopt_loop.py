"""One run of an NLopt algorithm on a scaled problem, and in words why it ended."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from fluxbore.optimize.problem import Point

Function = Callable[[Point], tuple[float, tuple[float, ...]]]
"""Scaled point -> the loss to minimise, and the misses that must not be positive. Finite numbers, always."""

PENALTY = 10.0
"""Loss per relative miss, for algorithms without constraints of their own. It is exact where a limit's multiplier is
smaller: where giving way by 1 % buys less than 10 % of the objective."""

_NAMES = {
    "COBYLA": "LN_COBYLA",
    "BOBYQA": "LN_BOBYQA",
    "DIRECT-L": "GN_DIRECT_L",
    "CRS2": "GN_CRS2_LM",
    "ISRES": "GN_ISRES",
}
_NATIVE = ("COBYLA", "ISRES")
GLOBAL = ("DIRECT-L", "CRS2", "ISRES")


@dataclass(frozen=True, slots=True)
class Ending:
    """Why a run of NLopt ended: a sentence, and the exception that the function stopped it with, if it did.

    failed : whether NLopt gave up with one of its failure codes; what it saw until then stands all the same.
    """

    reason: str
    stopped_by: BaseException | None = None
    failed: bool = False


def minimise(
    algorithm: str,
    function: Function,
    constraints: int,
    start: Point,
    *,
    step: float,
    objective_tolerance: float,
    variable_tolerance: float,
    seed: int,
    calls: int,
) -> Ending:
    """Let NLopt look for the smallest loss in the unit box; whoever calls keeps the points that ``function`` saw.

    constraints : how many misses the function gives. step : first step, of the box.
    objective_tolerance : relative; variable_tolerance : of the box. calls : of the function, repeated points included.

    The algorithms' own treatment of constraints is used where there is one (COBYLA, ISRES); BOBYQA gets them through
    an augmented Lagrangian, the other global ones through an exact penalty.
    """
    import nlopt

    nlopt.srand(seed)
    if algorithm == "BOBYQA" and len(start) < 2:
        algorithm = "COBYLA"  # BOBYQA's quadratic model needs two variables
    native = algorithm in _NATIVE
    lagrangian = algorithm == "BOBYQA" and constraints > 0
    stopped: list[BaseException] = []

    def call(x: Any) -> tuple[float, tuple[float, ...]]:
        try:
            return function(tuple(float(value) for value in x))
        except BaseException as error:  # nothing may pass through NLopt's C code but its own stop
            stopped.append(error)
            raise nlopt.ForcedStop from None

    def loss(x: Any, _gradient: Any) -> float:
        value, misses = call(x)
        if native or lagrangian:
            return value
        return value + PENALTY * sum(max(miss, 0.0) for miss in misses)

    def misses(result: Any, x: Any, _gradient: Any) -> None:
        result[:] = call(x)[1]

    opt = _optimiser(algorithm, lagrangian, len(start), step, objective_tolerance, variable_tolerance, calls)
    opt.set_min_objective(loss)
    if constraints and (native or lagrangian):
        opt.add_inequality_mconstraint(misses, [0.0] * constraints)
    return run(opt, start, stopped, objective_tolerance, variable_tolerance)


def _optimiser(
    algorithm: str, lagrangian: bool, size: int, step: float, objective: float, variable: float, calls: int
) -> Any:
    """NLopt's object for the unit box, with its stop rule; the tolerances are those of `minimise`."""
    import nlopt
    import numpy as np

    def made(name: str) -> Any:
        opt = nlopt.opt(getattr(nlopt, name), size)
        opt.set_ftol_rel(objective)
        opt.set_xtol_abs(variable)
        opt.set_maxeval(calls)
        return opt

    opt = made("AUGLAG" if lagrangian else _NAMES[algorithm])
    if lagrangian:
        opt.set_local_optimizer(made(_NAMES[algorithm]))
    opt.set_lower_bounds(np.zeros(size))
    opt.set_upper_bounds(np.ones(size))
    opt.set_initial_step(np.full(size, step))
    if algorithm in ("CRS2", "ISRES"):
        # NLopt's default populations are meant for thousands of evaluations.
        opt.set_population(max(3 * (size + 1), min(10 * (size + 1), calls // 10)))
    return opt


def run(opt: Any, start: Any, stopped: Sequence[BaseException], objective: float, variable: float) -> Ending:
    """Run NLopt's object; ``stopped`` is where its functions leave what they were stopped by.

    objective, variable : the tolerances, for the sentence.
    """
    import nlopt
    import numpy as np

    try:
        opt.optimize(np.asarray(start, dtype=float))
    except nlopt.RoundoffLimited:
        if not stopped:
            return Ending(_WORDS[-4])
    except _failures() as error:
        if not stopped:
            words = " ".join(str(error).split()) or type(error).__name__
            return Ending(_WORDS.get(_code(opt), f"NLopt gave up: {words}."), failed=True)
    if stopped:
        return Ending("The search was stopped.", stopped[0])
    return Ending(_WORDS.get(_code(opt), "The search ended.").format(objective=objective, variable=variable))


def _failures() -> tuple[type[BaseException], ...]:
    """What NLopt raises for its failure codes: its wrapper's own exceptions, which are none of the built-in ones."""
    import nlopt

    own = getattr(nlopt, "exception", None)  # absent from older wrappers, which raise the built-in ones
    built_in = (nlopt.ForcedStop, RuntimeError, ValueError, MemoryError)
    return built_in if own is None else (*built_in, own)


def _code(opt: Any) -> int:
    return int(opt.last_optimize_result())


_WORDS = {
    1: "The search converged.",
    2: "The search reached the objective value it was to stop at.",
    3: "The search converged: the objective changed by less than {objective:g} of its value.",
    4: "The search converged: every variable changed by less than {variable:g} of its range.",
    5: "The search asked for the largest number of points it may, many of them again and again.",
    6: "The search reached its time limit.",
    -1: "NLopt gave up without saying why.",
    -2: "NLopt found its arguments invalid.",
    -3: "NLopt ran out of memory.",
    -4: "Rounding errors left the search no progress to make.",
    -5: "The search was stopped.",
}
