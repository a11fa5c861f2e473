"""Searches by exact gradients from end to end: optimum, multipliers, maxima with norms, failures, rounding, replay."""

import itertools
import math
from dataclasses import replace

import nlopt
import pytest
import smooth
import toy
from hypothesis import given, settings
from hypothesis import strategies as st

from fluxbore.design.study import GRADIENT_ALGORITHMS, Constraint, Variable
from fluxbore.optimize import nlopt_loop, rounding
from fluxbore.optimize.executor import SerialExecutor, local_executor
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.network_start import objective_size
from fluxbore.optimize.outcome import Candidate
from fluxbore.optimize.problem import Box
from fluxbore.optimize.search import run_search
from fluxbore.optimize.table import results_table

ON_LIMIT = 9.956046925  # on x^2 + y^2 = 1, see test_search
PRICE = 0.1168486  # d force / d limit there, by re-solving at limits 1 -+ 1e-4 to 1e-10


def search(spec, model=smooth.rosenbrock, journal=None, gradients=True, progress=None):
    return run_search(spec, journal, SerialExecutor(), progress, model, gradients)


def on_circle(square, steps=200_000):
    """The best force of `smooth.rosenbrock` on x^2 + y^2 = square, by a fine grid of angles and one parabola."""
    radius = math.sqrt(square)

    def force(angle):
        x, y = radius * math.cos(angle), radius * math.sin(angle)
        return 10 - (1 - x) ** 2 - 3 * (y - x * x) ** 2

    step = 2 * math.pi / steps
    middle = max((force(i * step), i * step) for i in range(steps // 4))[1]
    low, at, high = force(middle - step), force(middle), force(middle + step)
    return at - (high - low) ** 2 / (8 * (low - 2 * at + high))


def test_the_price_of_the_limit_is_what_moving_it_buys():
    """Catches a multiplier with a wrong sign, unit or scale."""
    bought = (on_circle(1.0001) - on_circle(0.9999)) / 2e-4
    assert bought == pytest.approx(PRICE, rel=1e-4)
    result = search(smooth.study(relative_tolerance=1e-6))
    (price,) = result.optimality.multipliers
    assert (price.subject, price.sense, price.limit, price.bound) == ("stray_field", "<=", 1.0, False)
    assert price.per_unit == pytest.approx(bought, rel=1e-3)
    assert result.optimality.residual < 1e-5


@pytest.mark.parametrize("algorithm", ["auto", *GRADIENT_ALGORITHMS])
@pytest.mark.parametrize("start", [(0.2, 0.2), (-0.5, 0.0), (1.9, -1.9), (-1.9, 1.9), (3.0, 0.0)])
def test_it_finds_the_optimum_on_the_limit(algorithm, start):
    """Catches a search that stops short or beyond, or needs more designs than searches without derivatives."""
    result = search(smooth.study(*start, algorithm=algorithm))
    assert result.best.objective == pytest.approx(ON_LIMIT, rel=2e-5)
    assert result.best.feasible
    assert result.optimality.residual < 1e-2
    assert result.algorithm == ("SLSQP" if algorithm == "auto" else algorithm)
    if algorithm == "auto":
        assert len(result.history) <= 20


def test_bounds_have_prices_too():
    """max of mass = x + y with y <= 0.5 and the stray field at 1: at the corner of bound and limit."""
    variables = (Variable(toy.X, -2.0, 2.0), Variable(toy.Y, -2.0, 0.5))
    result = search(smooth.study(figure="total_mass", variables=variables))
    x = math.sqrt(0.75)
    assert result.best.objective == pytest.approx(x + 0.5, rel=1e-4)
    prices = {(item.subject, item.bound): item.per_unit for item in result.optimality.multipliers}
    # d(x + y)/d limit = 1/(2x);  d/dy of y + sqrt(1 - y^2) = 1 - y/x
    assert prices == pytest.approx({("stray_field", False): 1 / (2 * x), (toy.Y, True): 1 - 0.5 / x}, rel=1e-3)


@pytest.mark.parametrize("maximise", [True, False])
def test_a_limit_from_below_and_a_figure_to_minimise(maximise):
    """Catches a sign: raising a lower limit costs, whatever the objective's direction."""
    limits = (Constraint("total_mass", lower=1.0),) if not maximise else (Constraint("stray_field", lower=3.0),)
    figure = "total_mass" if maximise else "stray_field"
    result = search(smooth.study(1.5, 1.0, limits, figure=figure, maximise=maximise))
    prices = {item.subject: item.per_unit for item in result.optimality.multipliers}
    if maximise:
        assert prices == pytest.approx({toy.X: 1.0, toy.Y: 1.0}, rel=1e-6)
    else:  # min x^2 + y^2 with x + y >= 1: value limit^2 / 2
        assert prices == pytest.approx({"total_mass": 1.0}, rel=1e-3)
        assert result.best.objective == pytest.approx(0.5, rel=1e-4)


def test_limits_on_keys_that_follow_have_differences():
    """A limit on the count's key is none that moves; one on x of a study in which only y moves has slope zero."""
    limits = (Constraint("stray_field", upper=1.0), Constraint(toy.X, upper=0.2))
    result = search(smooth.study(constraints=limits, variables=(Variable(toy.Y, -2.0, 2.0),)))
    assert result.best.values[toy.Y] == pytest.approx(0.04, abs=1e-3)
    assert result.optimality.residual < 1e-3


def test_a_maximum_meets_its_limit_itself_not_by_its_norm():
    """Catches a norm, 7 % below the maximum, that is taken for the limit's value: the optimum would be infeasible."""
    result = search(smooth.study(), smooth.ridge)
    assert result.best.feasible
    assert result.best.checks[0].active
    grid = [
        (force, x, y)
        for x, y in itertools.product([i / 20 - 2 for i in range(81)], repeat=2)
        if smooth.ridge_peak(x, y) <= 1.0 and (force := 5 + x + 2 * y - 0.1 * (x * x + y * y))
    ]
    assert result.best.objective >= max(grid)[0]


@pytest.mark.parametrize("model", [smooth.half])
@pytest.mark.parametrize("algorithm", GRADIENT_ALGORITHMS)
def test_half_a_domain_that_fails_costs_no_incumbent(model, algorithm):
    """Catches a search that dies of, or is led astray by, designs that raise, diverge or give no figure."""
    result = search(smooth.study(algorithm=algorithm), model)
    assert result.ending == "done"
    assert any(not made.evaluation.ok for made in result.history)
    assert result.best.objective > 9.88  # at x = 0.7, y = 0.49 it is 9.91
    assert result.best.objective == max(made.objective for made in result.history if made.feasible)


def test_crashing_designs_cost_a_row_each():
    with local_executor(1) as executor:
        result = run_search(smooth.study(max_evaluations=4), None, executor, None, smooth.crash, True)
    assert any("ended" in " ".join(made.evaluation.reasons) or not made.evaluation.ok for made in result.history)
    assert result.best.objective > 9.0


@settings(max_examples=25, deadline=None)
@given(
    x=st.floats(-2, 2),
    y=st.floats(-2, 2),
    limit=st.floats(0.05, 4),
    budget=st.integers(1, 25),
    algorithm=st.sampled_from(GRADIENT_ALGORITHMS),
    model=st.sampled_from([smooth.rosenbrock, smooth.half]),
)
def test_the_incumbent_is_never_lost_and_never_infeasible(x, y, limit, budget, algorithm, model):
    limits = (Constraint("stray_field", upper=limit),)
    result = search(smooth.study(x, y, limits, algorithm=algorithm, max_evaluations=budget, network="off"), model)
    feasible = [made for made in result.history if made.feasible and made.objective is not None]
    assert len(result.history) <= budget
    assert result.ending == "done"
    assert (result.best is None) == (not feasible)
    if result.best is not None:
        assert result.best.objective == max(made.objective for made in feasible)
        assert result.best.evaluation.performance.stray_field <= limit * (1 + 1e-9)
        assert result.conflict is None


def test_a_model_without_derivatives_is_said():
    """Catches a gradient search that fails where it could do without."""
    result = search(smooth.study(algorithm="MMA"), gradients=False)
    assert result.algorithm == "COBYLA"
    assert result.stop_reason.startswith("MMA needs derivatives")
    assert result.optimality is None
    assert result.best.objective == pytest.approx(ON_LIMIT, rel=1e-3)
    promised = search(smooth.study(), smooth.unkept)
    assert "no derivative of stray_field, so COBYLA searched" in promised.stop_reason
    assert promised.best.objective == pytest.approx(ON_LIMIT, rel=1e-3)


def test_a_search_without_derivatives_tells_the_prices_all_the_same():
    result = search(smooth.study(algorithm="COBYLA"))
    assert result.optimality.multipliers[0].per_unit == pytest.approx(PRICE, rel=0.1)
    assert all(made.evaluation.gradient is None for made in result.history)


def test_slanting_steps_are_rounded_by_derivatives():
    """Catches a rounding to the nearest step, which the limit forbids here, and a budget that it overdraws."""
    spec = smooth.study(variables=(Variable(toy.X, -2.0, 2.0, 0.05), Variable(toy.Y, -2.0, 2.0, 0.05)))
    result = search(spec)
    steps = [i / 20 for i in range(-40, 41)]
    best = max(
        10 - (1 - x) ** 2 - 3 * (y - x * x) ** 2
        for x, y in itertools.product(steps, repeat=2)
        if x * x + y * y <= 1 + 1e-9
    )
    assert result.rounded.feasible
    assert result.rounded.objective == pytest.approx(best, rel=1e-9)
    assert len(result.history) <= 60


def test_steps_further_away_are_tried_where_the_nearest_miss_a_limit(monkeypatch):
    """Catches a search that gives its start, which is on the steps, since no step beside the optimum is feasible."""
    monkeypatch.setattr(rounding, "_REACH", {})
    variables = (Variable(toy.X, -2.0, 2.0, 0.06), Variable(toy.Y, -2.0, 2.0, 0.07))
    spec = smooth.study(0.66, 0.7, variables=variables)
    limits = (*spec.study.constraints, Constraint("total_mass", lower=1.345))
    result = search(replace(spec, study=replace(spec.study, constraints=limits)))
    assert result.rounded.feasible
    assert result.rounded.values == pytest.approx({toy.X: 0.72, toy.Y: 0.63})


@pytest.mark.parametrize("algorithm", GRADIENT_ALGORITHMS)
def test_the_same_search_replays_over_its_journal(algorithm, tmp_path):
    """Catches a seed that is not set, and rounds that depend on what is remembered."""
    spec = smooth.study(algorithm=algorithm, variables=(Variable(toy.X, -2.0, 2.0, 0.05), Variable(toy.Y, -2.0, 2.0)))
    with Journal(tmp_path / "j") as journal:
        first = search(spec, journal=journal)
    records = (tmp_path / "j").read_bytes().splitlines(keepends=True)
    (tmp_path / "j").write_bytes(b"".join(records[:6]) + records[6][:100])
    with Journal(tmp_path / "j") as journal:
        second = search(spec, journal=journal)
    assert len((tmp_path / "j").read_bytes().splitlines()) == len(records)
    assert second.reused == 6
    assert results_table(spec, (), second.history) == results_table(spec, (), first.history)
    assert replace(second, seconds=0.0, reused=0) == replace(first, seconds=0.0, reused=0)


def test_no_time_is_a_reason():
    """Catches a time limit that is not asked before a design, or that loses the incumbent."""
    result = search(smooth.study(time_limit=1e-9))
    assert "time limit" in result.stop_reason
    assert result.ending == "done"
    assert len(result.history) <= 3
    assert result.best is not None


def test_ctrl_c_gives_back_what_there_is():
    def interrupt(state):
        if state.done == 6:
            raise KeyboardInterrupt

    result = search(smooth.study(), progress=interrupt)
    assert (result.ending, len(result.history)) == ("interrupted", 6)
    assert result.best is not None


def test_a_failure_code_of_nlopt_ends_in_words_and_the_search_goes_on(monkeypatch):
    """Catches NLopt's own exceptions, which are none of the built-in ones, and a search that dies of them."""
    optimize = nlopt.opt.optimize

    def fail(opt, x):
        if opt.get_algorithm() == nlopt.LD_SLSQP:
            raise nlopt.runtime_error("nlopt failure")
        return optimize(opt, x)

    monkeypatch.setattr(nlopt.opt, "optimize", fail)
    result = search(smooth.study(constraints=(Constraint("stray_field", upper=10.0),), network="off"))
    assert result.ending == "done"
    assert "COBYLA searched on in place of SLSQP" in result.stop_reason
    assert result.best.objective == pytest.approx(10.0, abs=1e-2)


def test_an_argument_that_nlopt_refuses_is_an_ending():
    ending = nlopt_loop.minimise(
        "COBYLA", lambda x: (x[0], ()), 0, (2.0,), step=0.1, objective_tolerance=1e-6, variable_tolerance=1e-6, seed=1,
        calls=10,
    )  # fmt: skip
    assert ending.failed
    assert ending.stopped_by is None
    assert ending.reason.endswith(".")


def test_a_start_next_to_zero_does_not_set_the_scale():
    """Catches slopes of a million that a start objective of 1e-9 makes of a smooth problem."""
    bounds = Box((toy.X, toy.Y), (-2.0, -2.0), (2.0, 2.0))

    def start(objective, slope):
        evaluation = smooth.made({"force_constant": objective}, {"force_constant": {toy.X: slope}}, (toy.X, toy.Y))
        return Candidate({}, evaluation, objective, ())

    assert objective_size(start(1e-9, 3.0), None, "force_constant", bounds) == 12.0
    assert objective_size(start(1e-9, 3.0), start(-20.0, 0.0), "force_constant", bounds) == 20.0
    assert objective_size(start(5.0, 3.0), start(20.0, 0.0), "force_constant", bounds) == 5.0
    assert objective_size(start(0.0, 0.0), None, "force_constant", bounds) == 1.0
