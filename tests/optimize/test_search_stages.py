"""What a search does one after the other, and what it says of it: the network, the mapping, what takes over."""

from dataclasses import replace

import pytest
import smooth
import toy

from fluxbore.design.errors import DesignError
from fluxbore.design.study import Constraint, Variable
from fluxbore.optimize.executor import SerialExecutor
from fluxbore.optimize.search import run_search

ON_LIMIT = 9.956046925  # on x^2 + y^2 = 1, see test_search


def search(spec, model=smooth.rosenbrock, gradients=True):
    return run_search(spec, None, SerialExecutor(), None, model, gradients)


@pytest.mark.parametrize("algorithm", ["auto", "COBYLA", "MMA"])
def test_a_mapping_has_derivatives_whatever_would_follow_it(algorithm):
    """Catches a mapping that measures slopes by differences because another algorithm was named beside it."""
    result = search(smooth.study(algorithm=algorithm, network="manifold"))
    assert all(made.evaluation.gradient is not None for made in result.history)
    assert "by the finite elements' slopes" in result.stop_reason
    assert result.algorithm == "manifold mapping"
    assert result.best.objective == pytest.approx(ON_LIMIT, rel=2e-5)


def test_what_a_mapping_leaves_is_searched_by_what_was_named():
    """Derivatives of the wrong sign stop the mapping; COBYLA, which asks for none, has the rest of the budget."""
    result = search(smooth.study(algorithm="COBYLA", network="manifold", max_evaluations=120), smooth.contrary)
    assert not result.stop_reason.startswith("The mapping converged")
    assert "COBYLA went on from its best." in result.stop_reason
    assert result.algorithm == "manifold mapping, then COBYLA"
    assert result.best.objective == pytest.approx(ON_LIMIT, rel=1e-3)


def test_a_budget_that_the_mapping_used_up_is_told_once():
    result = search(smooth.study(network="manifold", max_evaluations=3))
    assert "used up its budget" in result.stop_reason
    assert "went on" not in result.stop_reason
    assert len(result.history) == 3


@pytest.mark.parametrize(
    "algorithm, ran",
    [
        ("auto", "SLSQP"),
        ("MLSL", "MLSL"),
        ("COBYLA", "COBYLA"),
        ("BOBYQA", "BOBYQA"),
        ("DIRECT-L", "DIRECT-L, then COBYLA"),
    ],
)
def test_what_ran_is_named(algorithm, ran):
    assert search(smooth.study(algorithm=algorithm)).algorithm == ran


def test_what_ran_instead_is_named():
    assert search(smooth.study(), smooth.unkept).algorithm == "COBYLA"
    assert search(smooth.study(algorithm="MMA"), gradients=False).algorithm == "COBYLA"
    one = smooth.study(algorithm="BOBYQA", variables=(Variable(toy.X, -2.0, 2.0),))
    assert search(one).algorithm == "COBYLA", "BOBYQA needs two variables"


def test_the_network_s_calls_are_counted(tmp_path, monkeypatch):
    """Catches a count that leaves out the start, or the mapping; the finite elements' designs are not among them."""
    for network in ("off", "start", "manifold"):
        monkeypatch.setenv("TOY_LOG", str(tmp_path / network))
        result = search(smooth.study(network=network))
        computed = len((tmp_path / network).read_text().splitlines())
        assert result.network_calls == computed - len(result.history)
        assert (result.network_calls == 0) == (network == "off")


@pytest.mark.parametrize("start", [(0.5, 0.0), (1.0, 0.0)])
def test_a_start_at_which_a_part_vanishes_does_not_end_the_search(start):
    """Without derivatives by y at y = 0, its own bound, a neighbour's serve; catches COBYLA or an early end."""
    variables = (Variable(toy.X, 0.1, 2.0), Variable(toy.Y, 0.0, 2.0))
    result = search(smooth.study(*start, variables=variables, network="off"), smooth.vanishing)
    assert result.algorithm == "SLSQP"
    assert result.best.objective == pytest.approx(ON_LIMIT, rel=2e-5)
    assert len(result.history) <= 25


def test_a_neighbour_that_cannot_be_built_is_passed_over():
    """As rings may be of no width, or of 20 um and more: what lies between cannot lend its derivatives."""

    def built(values):
        if 0 < values[toy.Y] < 0.01:
            raise DesignError(f"actuator.y must be 0 m or at least 0.01 m; got {values[toy.Y]}.")
        return toy.from_values(values)

    variables = (Variable(toy.X, 0.1, 2.0), Variable(toy.Y, 0.0, 2.0))
    spec = smooth.study(0.5, 0.0, variables=variables, network="off")
    result = search(replace(spec, kind=replace(toy.TOY, from_values=built)), smooth.vanishing)
    assert result.algorithm == "SLSQP"
    assert result.best.objective == pytest.approx(ON_LIMIT, rel=2e-5)
    assert all(made.evaluation.ok for made in result.history)


def test_an_optimum_at_which_a_part_vanishes_is_found_and_priced():
    """min x + y with x >= 0.5 by a limit and y at its bound: lowering each bound lowers the sum by as much."""
    variables = (Variable(toy.X, 0.1, 2.0), Variable(toy.Y, 0.0, 2.0))
    limits = (Constraint("stray_field", lower=0.25),)
    spec = smooth.study(1.0, 0.1, limits, variables, "total_mass", maximise=False, network="off")
    result = search(spec, smooth.vanishing)
    assert result.algorithm == "SLSQP"
    assert result.best.values == pytest.approx({toy.X: 0.5, toy.Y: 0.0}, abs=1e-4)
    prices = {(item.subject, item.bound): item.per_unit for item in result.optimality.multipliers}
    # min x + y, x^2 + y^2 >= s: d(sum)/ds = 1/(2x); by y's bound 1 - y/x
    assert prices == pytest.approx({("stray_field", False): 1.0, (toy.Y, True): 1.0}, rel=5e-3)


def test_a_neighbour_counts_as_a_design():
    """And one that fails, too, leaves the search alive."""
    variables = (Variable(toy.X, 0.1, 2.0), Variable(toy.Y, 0.0, 2.0))

    result = search(smooth.study(0.5, 0.0, variables=variables, network="off"), smooth.vanishing)
    assert any(0 < made.values[toy.Y] < 0.0021 for made in result.history)
    fails = search(smooth.study(0.5, 0.0, variables=variables, network="off"), smooth.edge)
    assert (fails.ending, fails.algorithm) == ("done", "SLSQP"), "the second neighbour serves"
    assert fails.best.objective == pytest.approx(ON_LIMIT, rel=2e-5)


@pytest.mark.parametrize(
    "figure, maximise, limits",
    [
        ("total_mass", True, Constraint("stray_field", upper=2.0)),
        ("stray_field", False, Constraint("total_mass", lower=2.0)),
        ("force_constant", True, Constraint("total_mass", lower=2.5)),
        ("force_constant", True, Constraint("total_mass", upper=1.5)),
        ("stray_field", False, Constraint("force_constant", lower=9.9)),
    ],
)
def test_prices_are_what_moving_the_limit_buys(figure, maximise, limits):
    """Either direction of the objective, either sense of the limit, by solving again beside it; catches any sign."""

    def best(shift):
        moved = replace(
            limits,
            upper=None if limits.upper is None else limits.upper + shift,
            lower=None if limits.lower is None else limits.lower + shift,
        )
        spec = smooth.study(
            0.9, 0.9, (moved,), figure=figure, maximise=maximise, relative_tolerance=1e-9, network="off"
        )
        return search(spec)

    step = 1e-3
    bought = (best(step).best.objective - best(-step).best.objective) / (2 * step)
    (price,) = best(0.0).optimality.multipliers
    assert price.subject == limits.subject
    assert price.per_unit == pytest.approx(bought, rel=1e-2)
    assert (price.per_unit > 0) == ((price.sense == "<=") == maximise)


def test_a_limit_relative_to_the_start_is_the_start_s_maximum():
    """Catches the start's norm, 7 % below its maximum, as the limit, and a search that leaves the difference unused."""
    limit = Constraint("stray_field", upper=1.0, relative_to_start=True)
    result = search(smooth.study(-1.0, 0.5, (limit,), network="off"), smooth.ridge)
    own = smooth.ridge_peak(-1.0, 0.5)
    (check,) = result.best.checks
    assert check.limit.limit == own == result.start.evaluation.performance.stray_field
    assert check.active
    assert check.satisfied
    assert result.best.objective > result.start.objective + 1


def test_the_residual_of_a_corner_is_nil():
    """max x + y with a limit and a bound active, and another limit near by that has no part in it."""
    variables = (Variable(toy.X, -2.0, 2.0), Variable(toy.Y, -2.0, 0.5))
    limits = (Constraint("stray_field", upper=1.0), Constraint("force_constant", lower=9.7))
    result = search(smooth.study(constraints=limits, figure="total_mass", variables=variables, relative_tolerance=1e-8))
    assert result.best.objective == pytest.approx(0.75**0.5 + 0.5, rel=1e-6)
    assert result.optimality.residual < 1e-6
    assert {item.subject for item in result.optimality.multipliers} == {"stray_field", toy.Y}


def test_a_variable_that_limits_leave_no_room_stays():
    """Catches a division by a range of zero."""
    limits = (Constraint(toy.X, lower=0.3, upper=0.3), Constraint("stray_field", upper=1.0))
    result = search(smooth.study(0.3, 0.5, limits, network="off"))
    assert result.best.values[toy.X] == 0.3
    assert result.best.values[toy.Y] == pytest.approx(0.09, abs=1e-3)
    assert result.optimality.residual < 1e-3
