"""Backed-off limits and the search that reaches a yield, on productions whose answers are known."""

import math
from dataclasses import replace

import pytest
import tolerance_toy as models
import toy
from tolerance_toy import hill_study, normal_share, production
from toy import X, Y

from fluxbore.design.errors import SpecError
from fluxbore.design.study import Constraint, Objective
from fluxbore.optimize.executor import SerialExecutor
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.outcome import Limit
from fluxbore.optimize.search import run_search
from fluxbore.optimize.tolerance import run_tolerance
from fluxbore.optimize.tolerance_backoff import backed_off
from fluxbore.optimize.tolerance_result import RobustResult
from fluxbore.optimize.tolerance_robust import made_design, run_robust


def analysed(made, limits, *, x=1.0, y=1.0, model=models.linear):
    spec = toy.spec(x=x, y=y, production=made)
    return run_tolerance(spec, None, SerialExecutor(), None, model, limits=limits)


def robust(spec, model=models.hill, journal=None) -> RobustResult:
    return run_robust(spec, journal, SerialExecutor(), None, model)


def test_one_limit_backs_off_by_k_sigma():
    """For 99 % of normal scatter k is 2.326; a little more as the samples' lower confidence limit must reach it."""
    limits = (Limit("stray_field", "<=", 3.0),)
    result = analysed(production(0.3, 0.6, samples=10_000), limits)
    [moved] = backed_off(limits, result, 0.99)
    sigma = math.hypot(0.2, 0.2)
    assert 2.31 < (3.0 - moved.limit) / sigma < 2.45
    assert (moved.subject, moved.sense) == ("stray_field", "<=")


def test_a_lower_limit_moves_up():
    limits = (Limit("force_constant", ">=", 12.0),)
    [moved] = backed_off(limits, analysed(production(0.3, 0.6, samples=10_000), limits), 0.9)
    assert 1.28 < (moved.limit - 12.0) / math.sqrt(0.13) < 1.35


def test_uniform_scatter_backs_off_by_its_width_at_most():
    """k sigma of a normal distribution would be 4 sigma here, 2.3 half widths."""
    limits = (Limit(X, "<=", 1.0),)
    [moved] = backed_off(limits, analysed(production(0.5, distribution="uniform"), limits), 0.9999)
    assert 0.499 < 1.0 - moved.limit <= 0.5


def test_two_limits_that_bind_back_off_further_than_one():
    """x and y apart, both at their limits: each must hold with the root of 90 %."""
    one, two = (Limit(X, "<=", 1.0),), (Limit(X, "<=", 1.0), Limit(Y, "<=", 1.0))
    made = production(0.3, 0.3, samples=10_000)
    alone, both = (backed_off(limits, analysed(made, limits), 0.9)[0].limit for limits in (one, two))
    assert normal_share((1 - alone) / 0.1) == pytest.approx(0.9, abs=0.011)
    assert normal_share((1 - both) / 0.1) == pytest.approx(math.sqrt(0.9), abs=0.011)


def test_limits_that_fail_together_are_not_paid_for_twice():
    """The stray field is 2 x + 1 where x alone scatters: a limit on x that fails in the same actuators is free."""
    limits = (Limit("stray_field", "<=", 3.0), Limit(X, "<=", 1.0))
    made = production(0.3, samples=10_000)
    alone = backed_off(limits[:1], analysed(made, limits[:1]), 0.9)[0]
    assert backed_off(limits, analysed(made, limits), 0.9)[0].limit == pytest.approx(alone.limit, abs=1e-6)


def test_a_limit_far_away_costs_the_binding_one_nothing():
    near, far = Limit(X, "<=", 1.0), Limit(Y, "<=", 5.0)
    made = production(0.3, 0.3)
    alone = backed_off((near,), analysed(made, (near,)), 0.95)[0]
    assert backed_off((near, far), analysed(made, (near, far)), 0.95)[0].limit == pytest.approx(alone.limit, abs=1e-9)


def test_a_mean_that_moves_inwards_never_moves_a_limit_out():
    limits = (Limit(X, "<=", 1.0),)
    [moved] = backed_off(limits, analysed(production((-0.6, -0.3)), limits), 0.9)
    assert moved.limit == 1.0


def test_the_search_reaches_its_yield_and_names_the_price():
    """At the optimum half of the production fails; the robust one gives up what the backed-off limit costs."""
    spec = hill_study(0.95)
    result = robust(spec)
    first, best = result.rounds[0], result.best
    assert first.production.simulated.value == pytest.approx(0.5, abs=0.03)
    assert result.reached
    assert 0.95 <= best.production.simulated.value < 0.97
    assert result.price == pytest.approx(first.objective - best.objective)
    assert "The yield reached" in result.stop_reason
    assert "asked for 95.00%" in result.stop_reason

    alone = run_search(
        replace(spec, study=replace(spec.study, constraints=(Constraint("stray_field", upper=best.limits[0].limit),))),
        None,
        SerialExecutor(),
        None,
        models.hill,
    )
    assert best.objective == pytest.approx(alone.best.objective, rel=1e-4)
    assert 0 < result.price < 1


def test_a_round_that_overshoots_gives_back_what_it_gave_away():
    """x^3 <= 4 at x = 1.59 scatters by more than further in: its slopes back off to 98 % where 95 % is asked for.

    The exact answer has x^3 = 4 where x is 1.645 standard deviations, of 0.1, further out.
    """
    result = robust(hill_study(0.95, limit=4.0, samples=4000), models.cubic)
    second, best = result.rounds[1], result.best
    assert second.production.best_estimate.value > 0.975
    assert result.reached
    assert 0.95 <= best.production.best_estimate.value < 0.965
    assert best.objective == max(
        item.objective for item in result.rounds if item.production.best_estimate.value >= 0.95
    )
    exact = 10 - (2 - (4 ** (1 / 3) - 0.1645)) ** 2
    assert exact - best.objective < 0.35 * (exact - second.objective)
    assert f"The yield reached {best.production.best_estimate.value:.2%}" in result.stop_reason


def test_a_later_round_that_falls_short_does_not_undo_an_earlier_one():
    """The third round of the same search is short of 95 %; ended there, the second one is the answer, and reaches."""
    result = run_robust(hill_study(0.95, limit=4.0, samples=4000), None, SerialExecutor(), None, models.cubic, rounds=3)
    assert result.rounds[2].production.best_estimate.value < 0.95
    assert (result.chosen, result.reached) == (1, True)
    assert "The yield reached 98" in result.stop_reason


def test_a_smaller_tolerance_makes_the_yield_cheaper():
    wide, narrow = robust(hill_study(0.95, width=0.3)), robust(hill_study(0.95, width=0.1))
    assert wide.reached
    assert narrow.reached
    assert narrow.price < 0.5 * wide.price


def test_a_design_that_has_the_yield_already_costs_one_round():
    result = robust(hill_study(0.95, limit=9.0))
    assert (len(result.rounds), result.reached, result.price) == (1, True, 0.0)


def test_a_yield_beyond_reach_says_so_and_keeps_the_first_round():
    """The stray field falls below 1 nowhere where y is at least 1, but there it scatters."""
    result = robust(hill_study(0.99, limit=1.01, floor=1.0))
    assert not result.reached
    assert result.best is not None
    assert "No design" in result.stop_reason or "leave no design" in result.stop_reason


def test_limits_that_rule_out_every_design_end_in_a_sentence():
    """A limit on a variable that is backed off beyond the variable's bound."""
    spec = hill_study(0.99, floor=3.9, limit=50.0)
    made = replace(spec.study.production, tolerances=(replace(spec.study.production.tolerances[0], key=Y),))
    spec = replace(spec, study=replace(spec.study, objective=Objective("stray_field", maximise=False), production=made))
    result = robust(spec)
    assert not result.reached
    assert "leave no design" in result.stop_reason
    assert len(result.rounds) == 1


def test_samples_in_full_are_for_designs_that_reach_the_yield():
    """And the yield they say counts: with them the last round has a checked estimate, the first has none."""
    result = robust(hill_study(0.9, checks=100))
    assert result.rounds[0].production.checked is None
    assert result.best.production.checked is not None
    assert result.best.production.checked.value >= 0.9


def test_the_journal_makes_a_repeat_free(tmp_path, monkeypatch):
    monkeypatch.setenv("TOY_LOG", str(tmp_path / "trace"))
    spec = hill_study(0.9, checks=20)
    with Journal(tmp_path / "j") as journal:
        first = robust(spec, models.hill, journal)
    with Journal(tmp_path / "j") as journal:
        again = robust(spec, models.hill, journal)
    assert [item.objective for item in again.rounds] == [item.objective for item in first.rounds]
    assert again.best.limits == first.best.limits
    production = again.best.production
    assert production.reused == production.evaluations
    assert all(item.search.reused == len(item.search.history) for item in again.rounds)


def test_a_yield_must_be_asked_for():
    with pytest.raises(SpecError, match=r"study\.production\.yield must be given"):
        robust(hill_study(None))


def test_a_found_design_is_made_from_what_its_specification_gives():
    found = run_search(hill_study(), None, SerialExecutor(), None, models.hill)
    made = made_design(found.best, hill_study())
    assert {key: made.number(key) for key in (X, Y)} == found.best.values
    assert set(made.given) == set(hill_study().given)
