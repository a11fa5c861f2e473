"""Combinations of counts: which there are, and in which order they are searched."""

import pytest
import smooth
import toy

from fluxbore.design.errors import SpecError
from fluxbore.design.study import Constraint, Variable
from fluxbore.optimize.enumeration import MOST_COMBINATIONS, combinations, distance, in_turn
from fluxbore.optimize.evaluation import INVALID, failure
from fluxbore.optimize.executor import SerialExecutor, local_executor
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.outcome import Limit
from fluxbore.optimize.search import run_search
from fluxbore.optimize.table import results_table

PLANE = (Variable(toy.X, -2.0, 2.0), Variable(toy.Y, -2.0, 2.0))
COUNT = Variable(toy.N, 0, 6, integer=True)


def search(spec, journal=None, **options):
    return run_search(spec, journal, SerialExecutor(), None, smooth.counted, gradients=True, **options)


def test_every_combination_within_bounds_and_limits():
    spec = toy.spec(variables=(*PLANE, COUNT))
    assert [item[toy.N] for item in combinations(spec, [])] == [0, 1, 2, 3, 4, 5, 6]
    limits = [Limit(toy.N, ">=", 1.5), Limit(toy.N, "<=", 4.0), Limit(toy.X, "<=", 0.0)]
    assert [item[toy.N] for item in combinations(spec, limits)] == [2, 3, 4]
    assert combinations(toy.spec(variables=PLANE), []) == ({},)
    with pytest.raises(SpecError, match=r"no whole number for actuator\.n"):
        combinations(spec, [Limit(toy.N, ">=", 2.2), Limit(toy.N, "<=", 2.8)])


def test_too_many_combinations_are_refused():
    """Catches a slip in a bound that starts a search of weeks."""
    spec = toy.spec(variables=(Variable(toy.N, 1, MOST_COMBINATIONS + 1, integer=True),))
    with pytest.raises(SpecError, match=f"at most {MOST_COMBINATIONS} .* got {MOST_COMBINATIONS + 1}"):
        combinations(spec, [])


def test_each_combination_but_the_first_has_a_neighbour_before_it():
    found = [{"a": a, "b": b} for a in range(4) for b in range(3)]
    turns = in_turn(found, {"a": 2, "b": 1})
    assert turns[0] == {"a": 2, "b": 1}
    assert sorted(map(str, turns)) == sorted(map(str, found))
    for i in range(1, len(turns)):
        assert min(distance(turns[i], other) for other in turns[:i]) == 1


def test_the_best_count_is_found_with_the_best_lengths():
    """Catches counts that are rounded, forgotten in the design, or searched from the wrong neighbour."""
    spec = smooth.study(variables=(*PLANE, COUNT), max_evaluations=120)
    result = search(spec)
    assert result.best.values[toy.N] == 3
    assert isinstance(result.best.values[toy.N], int)
    assert result.best.objective == pytest.approx(9.956046925 + 3 - 9 / 6, rel=1e-5)
    assert {made.values[toy.N] for made in result.history} == set(range(7))
    assert "7 of 7 combinations" in result.stop_reason
    assert "actuator.n = 3" in result.stop_reason
    assert len(result.history) == len(result.best_so_far) <= 120
    assert spec.with_values(result.best.values).number(toy.N) == 3


def test_neighbours_share_what_they_found():
    """Catches cold starts: six warm ones cost less than five cold ones."""
    (alone,) = [len(search(smooth.study(max_evaluations=60, network="off")).history)]
    together = len(search(smooth.study(variables=(*PLANE, COUNT), max_evaluations=300, network="off")).history)
    assert together < 6 * alone


def test_a_small_budget_says_what_it_did_not_reach():
    result = search(smooth.study(variables=(*PLANE, COUNT), max_evaluations=5))
    assert len(result.history) <= 5
    assert "budget" in result.stop_reason


def test_counts_alone_and_a_limit_on_one():
    limits = (Constraint("stray_field", upper=5.0), Constraint(toy.N, upper=2.0))
    result = search(smooth.study(variables=(COUNT,), constraints=limits))
    assert result.best.values == {toy.N: 2}
    assert [made.values[toy.N] for made in result.history] == [1, 0, 2]


def test_a_start_whose_count_is_out_of_bounds():
    result = search(smooth.study(variables=(*PLANE, Variable(toy.N, 4, 5, integer=True)), max_evaluations=60))
    assert result.start.values[toy.N] == 1
    assert {made.values[toy.N] for made in result.history} == {4, 5}
    assert result.best.values[toy.N] == 4


def test_the_same_search_replays_over_its_journal(tmp_path, monkeypatch):
    """Catches combinations whose share or start depends on what is remembered, and workers that change the order."""
    monkeypatch.setenv("TOY_LOG", str(tmp_path / "trace"))
    spec = smooth.study(variables=(Variable(toy.X, -2.0, 2.0, 0.05), PLANE[1], COUNT), max_evaluations=90)
    with Journal(tmp_path / "j") as journal:
        first = search(spec, journal)
    records = (tmp_path / "j").read_bytes().splitlines(keepends=True)
    assert len(records) > 20
    (tmp_path / "j").write_bytes(b"".join(records[:17]) + records[17][:60])
    with Journal(tmp_path / "j") as journal:
        second = search(spec, journal)
    assert len((tmp_path / "j").read_bytes().splitlines()) == len(records)
    assert second.reused == 17
    assert results_table(spec, (), second.history) == results_table(spec, (), first.history)
    assert (second.best, second.rounded, second.optimality) == (first.best, first.rounded, first.optimality)
    with local_executor(2) as executor:
        third = run_search(spec, None, executor, None, smooth.counted, gradients=True)
    assert [made.values for made in third.history] == [made.values for made in first.history]


def impossible(design, fidelity="fem", gradient=()):
    """`smooth.counted` of which no design of two or four can be built, and none of five beyond x = -1.9."""
    count = design.number(toy.N)
    if count in (2, 4):
        return failure(fidelity, INVALID, f"{count:g} sets do not fit.")
    if count == 5 and design.number(toy.X) > -1.9:
        return failure(fidelity, INVALID, f"At {design.number(toy.X)!r} 5 sets do not fit.")
    return smooth.counted(design, fidelity, gradient)


@pytest.mark.parametrize("network", ["start", "off"])
def test_a_count_that_cannot_be_built_is_left_out_after_its_first_designs(network):
    """Catches a budget that goes to what fails whatever the variables, and one that fails in places taken for it."""
    spec = smooth.study(variables=(*PLANE, COUNT), max_evaluations=120, network=network)
    result = run_search(spec, None, SerialExecutor(), None, impossible, gradients=True)
    tried = [made.values[toy.N] for made in result.history]
    assert tried.count(2) == tried.count(4) == 2
    assert tried.count(5) > 2
    assert "5 of 7 combinations of counts were searched." in result.stop_reason
    for count in (2, 4):
        assert (
            f"Left out: actuator.n = {count}, where the first designs all fail alike: {count} sets do not fit."
        ) in result.stop_reason
    assert result.best.values[toy.N] == 3
    assert result.ending == "done"


def test_a_share_of_the_budget_is_not_called_all_of_it():
    """Catches "used up its budget of 30" after 4 designs of each count."""
    spec = smooth.study(variables=(*PLANE, COUNT), max_evaluations=30, network="off", relative_tolerance=1e-9)
    result = search(spec)
    assert "used up its share of the budget, " in result.stop_reason
    assert " of 30 FEM designs; the rest is for the other combinations" in result.stop_reason


def test_the_tolerance_that_is_named_is_the_one_asked_for():
    result = search(smooth.study(relative_tolerance=1e-4, max_evaluations=60))
    assert "changed by less than 0.0001 of its" in result.stop_reason
