"""Where nothing is feasible: the least infeasible design, the limits in conflict, and what giving way would do."""

import math
from pathlib import Path

import pytest
import smooth
import toy
from hypothesis import given, settings
from hypothesis import strategies as st

from fluxbore.design.errors import DesignError
from fluxbore.design.performance import Performance
from fluxbore.design.spec import load
from fluxbore.design.study import Constraint, Variable
from fluxbore.optimize.evaluation import OK, Evaluation
from fluxbore.optimize.executor import SerialExecutor
from fluxbore.optimize.outcome import Limit
from fluxbore.optimize.problem import Merit, box, candidate
from fluxbore.optimize.search import run_search
from fluxbore.optimize.slopes import Slopes

APART = (Constraint("stray_field", upper=1.0), Constraint("total_mass", lower=1.5))


def search(spec, model=smooth.rosenbrock, gradients=True):
    return run_search(spec, None, SerialExecutor(), None, model, gradients)


def least_worst():
    """min t with x^2 + y^2 <= 1 + t and x + y >= 1.5 (1 - t): x = y = 0.75 (1 - t), so 1.125 (1 - t)^2 = 1 + t."""
    # 1.125 t^2 - 3.25 t + 0.125 = 0
    return (3.25 - math.sqrt(3.25**2 - 4 * 1.125 * 0.125)) / 2.25


def test_the_conflict_is_named_with_misses_and_weights():
    """Catches a search that only says "nothing found", and a least infeasible design that is not the least."""
    result = search(smooth.study(constraints=APART))
    assert result.best is result.chosen is result.optimality is None
    found = result.conflict
    worst = least_worst()
    assert found.settled
    assert found.worst == pytest.approx(worst, rel=1e-3)
    clashes = {clash.subject: clash for clash in found.clashes}
    assert set(clashes) == {"stray_field", "total_mass"}
    assert sum(clash.weight for clash in found.clashes) == pytest.approx(1.0, abs=1e-3)
    # Stationarity: w1 2 x = w2 / 1.5 with x = 0.75 (1 - t)
    ratio = clashes["total_mass"].weight / clashes["stray_field"].weight
    assert ratio == pytest.approx(2 * 0.75 * (1 - worst) * 1.5, rel=1e-2)
    for clash in found.clashes:
        assert clash.relative == pytest.approx(worst, rel=1e-3)
        assert clash.missed == pytest.approx(clash.relative * clash.limit, rel=1e-12)
    assert "In conflict are " in result.stop_reason
    assert "No design met every limit; the nearest missed " in result.stop_reason


def test_giving_way_as_far_as_it_says_makes_the_problem_feasible():
    """Catches a relief of the wrong size: the limit is raised by what ``alone`` says, and 2 % for the curvature."""
    clash = next(c for c in search(smooth.study(constraints=APART)).conflict.clashes if c.subject == "stray_field")
    assert clash.alone == pytest.approx(0.125, rel=0.05)  # to x = y = 0.75, x^2 + y^2 = 1.125
    eased = (Constraint("stray_field", upper=1.0 + 1.02 * clash.alone + 0.002), APART[1])
    assert search(smooth.study(constraints=eased)).best is not None
    still = (Constraint("stray_field", upper=1.0 + 0.9 * clash.alone), APART[1])
    assert search(smooth.study(constraints=still)).best is None


def test_a_limit_that_takes_no_part_is_not_named():
    """Catches a list of everything that is missed."""
    limits = (*APART, Constraint("force_constant", lower=1.0))
    found = search(smooth.study(constraints=limits)).conflict
    assert {clash.subject for clash in found.clashes} == {"stray_field", "total_mass"}


def test_a_bound_can_take_part():
    """x + y >= 1.5 with x <= 0.4 and y <= 0.5: the limit clashes with two bounds, which give way range by range."""
    variables = (Variable(toy.X, -2.0, 0.4), Variable(toy.Y, -2.0, 0.5))
    found = search(smooth.study(constraints=APART[1:], variables=variables)).conflict
    clashes = {clash.subject: clash for clash in found.clashes}
    assert set(clashes) == {"total_mass", toy.X, toy.Y}
    assert [clashes[key].bound for key in ("total_mass", toy.X, toy.Y)] == [False, True, True]
    assert clashes["total_mass"].missed == pytest.approx(0.6, rel=1e-3)
    assert clashes[toy.X].alone == pytest.approx(0.6, rel=1e-2)
    assert clashes[toy.X].weight == pytest.approx(2.4 / 1.5, rel=1e-2)


@pytest.mark.parametrize("algorithm", ["COBYLA", "BOBYQA", "ISRES", "DIRECT-L"])
def test_without_derivatives_it_names_what_the_nearest_design_misses(algorithm):
    result = search(smooth.study(constraints=APART, algorithm=algorithm), gradients=False)
    assert result.best is None
    assert not result.conflict.settled
    assert result.conflict.worst < 0.06
    assert {clash.subject for clash in result.conflict.clashes} <= {"stray_field", "total_mass"}
    assert all(clash.weight is None and clash.missed > 0 for clash in result.conflict.clashes)


@settings(max_examples=20, deadline=None)
@given(x=st.floats(-2, 2), y=st.floats(-2, 2), gap=st.floats(1e-3, 0.05))
def test_a_small_feasible_set_is_found_from_anywhere(x, y, gap):
    """Catches a search that calls a problem infeasible which is not: a lens as thin as ``gap``."""
    limits = (Constraint("stray_field", upper=1.0), Constraint("total_mass", lower=math.sqrt(2) * (1 - gap)))
    result = search(smooth.study(x, y, limits, network="off"))
    assert result.best is not None
    assert result.conflict is None


def test_the_nearest_of_all_counts_is_told():
    variables = (Variable(toy.X, -2.0, 2.0), Variable(toy.N, 0, 2, integer=True))
    result = search(smooth.study(constraints=APART, variables=variables, max_evaluations=90), smooth.counted)
    assert result.best is None
    assert result.conflict.clashes
    assert set(result.conflict.values) == {toy.X, toy.N}


def test_nothing_sound_is_no_conflict():
    result = search(smooth.study(constraints=APART), smooth.nothing)
    assert result.conflict is None
    assert result.stop_reason.endswith("None of its designs could be evaluated. The first: No convergence.")


def test_a_figure_that_no_design_gives_is_named():
    """Catches designs that were evaluated in full and are said not to have been."""
    result = search(smooth.study(constraints=(Constraint("speed_limit", lower=1.0),), max_evaluations=20))
    assert all(made.evaluation.ok for made in result.history)
    assert result.stop_reason.endswith("No design gives every figure that is limited; missing are speed_limit.")


def test_a_search_without_an_objective_has_not_converged():
    spec = smooth.study(figure="peak_force", constraints=(), max_evaluations=20)
    result = search(spec)
    assert "converged" not in result.stop_reason
    assert result.stop_reason.endswith(
        "It found no design to go by. None of its designs gives peak_force, the objective."
    )


def test_combinations_none_of_which_can_be_built_say_why():
    def unbuilt(design, fidelity="fem", gradient=()):
        raise DesignError(f"actuator.n must be odd; got {int(design.number(toy.N))}.")

    variables = (Variable(toy.N, 0, 2, integer=True),)
    result = search(smooth.study(constraints=(), variables=variables), unbuilt)
    assert result.best is None
    assert result.stop_reason.endswith(
        "None of its designs could be evaluated. The first: actuator.n must be odd; got 1."
    )


def test_a_key_that_follows_from_the_variables_has_its_slope():
    """The yoke's bore follows its thickness; catches a limit on it that a gradient search takes for flat."""
    spec = load(Path(__file__).parents[2] / "examples" / "ipehla.toml").for_study()
    bounds = box(spec, [])
    merit = Merit(spec.study.objective, 1.0)
    limit = Limit("actuator.back_yoke.inner_diameter", "<=", 0.03)
    evaluation = Evaluation("fem", OK, (), Performance(force_constant=5.0), gradient=flat(bounds))
    made = candidate(spec, spec.study.objective, [limit], bounds.keys, evaluation)
    view = Slopes(spec, bounds, merit, [limit]).view(made, {})
    j = bounds.keys.index("actuator.back_yoke.thickness")
    span = bounds.upper[j] - bounds.lower[j]
    (row,) = view.miss_slopes
    step = 1e-4
    moved = spec.with_values({**made.values, bounds.keys[j]: made.values[bounds.keys[j]] + step})
    change = moved.number(limit.subject) - spec.number(limit.subject)
    assert change != 0
    assert row[j] == pytest.approx(change / step * span / 0.03, rel=1e-6)
    assert row[1 - j] == pytest.approx(0.0, abs=1e-12)


def flat(bounds):
    return {"force_constant": dict.fromkeys(bounds.keys, 0.0)}
