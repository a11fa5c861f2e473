"""Sweeps: one row for every design whatever becomes of it, and nothing computed twice."""

import json
from dataclasses import replace

import pytest
import toy

from fluxbore.design.errors import SpecError
from fluxbore.design.keys import Alternatives
from fluxbore.design.study import Axis, Sweep
from fluxbore.optimize.evaluation import FAILED, INVALID, NOT_CONVERGED, OK
from fluxbore.optimize.evaluator import Evaluator
from fluxbore.optimize.executor import SerialExecutor, local_executor
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.sweep import recorded_sweeps, run_sweeps
from fluxbore.optimize.table import results_table


@pytest.fixture
def trace(tmp_path, monkeypatch):
    """The file in which every evaluation leaves a line."""
    monkeypatch.setenv("TOY_LOG", str(tmp_path / "trace"))
    return tmp_path / "trace"


def lines(path):
    return path.read_text().splitlines() if path.exists() else []


def test_rows_stand_in_grid_order_with_their_reasons():
    """Catches rows in the order of their completion, and a grid that ends at a design that cannot be built."""
    square, counts = run_sweeps(toy.two_sweeps(), None, SerialExecutor(), evaluate=toy.plain)
    assert [tuple(row.values.values()) for row in square.rows] == [
        (2.5 * i, 2.5 * j) for i in range(5) for j in range(5)
    ]
    statuses = [row.evaluation.status for row in square.rows]
    assert statuses == [OK] * 10 + [NOT_CONVERGED] * 5 + [OK] * 9 + [INVALID]
    assert square.rows[-1].evaluation.reasons[0].startswith("actuator.x must not exceed 9 m")
    assert [row.values[toy.N] for row in counts.rows] == [0, 1, 2, 3]
    assert all(isinstance(row.values[toy.N], int) for row in counts.rows)
    assert square.best("force_constant").evaluation.ok


def test_a_value_outside_its_keys_limits_is_a_row():
    sweep = Sweep("too far", (Axis(toy.X, (0.0, 200.0)),))
    (result,) = run_sweeps(toy.spec(sweeps=(sweep,)), None, SerialExecutor(), evaluate=toy.plain)
    assert result.rows[1].evaluation.reasons == ("actuator.x must be at most 100000 mm; got 200000 mm.",)


def test_a_crash_costs_one_row():
    """Catches a crashed worker that takes its neighbours' rows with it, or the whole sweep."""
    with local_executor(2) as executor:
        square, counts = run_sweeps(toy.two_sweeps(), None, executor, evaluate=toy.crashing)
    healthy = run_sweeps(toy.two_sweeps(), None, SerialExecutor(), evaluate=toy.plain)
    assert [row.evaluation.status for row in square.rows[:5]] == [FAILED] * 5
    reasons = [row.evaluation.reasons[0] for row in square.rows[:5]]
    for reason, words in zip(reasons, ["status 7", "SIGKILL", "SIGSEGV", "out of memory", "ZeroDivision"], strict=True):
        assert words in reason
    table, sound = (results_table(toy.two_sweeps(), r).splitlines() for r in ((square, counts), healthy))
    assert table[6:] == sound[6:]


def test_nothing_is_computed_twice(trace, tmp_path):
    """Catches a design computed again: in the same sweep, in another of the study, or in the next run."""
    spec = toy.spec(sweeps=(toy.square(3), Sweep("again", (Axis(toy.X, (0.0, 0.0, 10.0)), Axis(toy.Y, (0.0,))))))
    seen = []
    with Journal(tmp_path / "j") as journal:
        first = run_sweeps(spec, journal, SerialExecutor(), progress=seen.append, evaluate=toy.plain)
    assert len(lines(trace)) == len(set(lines(trace))) == 8
    assert (seen[-1].done, seen[-1].total, seen[-1].reused, seen[-1].failed) == (12, 12, 3, 4)
    with Journal(tmp_path / "j") as journal:
        second = run_sweeps(spec, journal, SerialExecutor(), progress=seen.append, evaluate=toy.plain)
    assert len(lines(trace)) == 8
    assert seen[-1].reused == 11  # the twelfth cannot be built, so there is nothing to reuse
    assert results_table(spec, first) == results_table(spec, second)


def test_recorded_sweeps_are_those_that_the_journal_holds_whole(trace, tmp_path):
    """Catches the rows of an earlier sweep that are lost from the table, and designs computed for the sake of it."""
    spec = toy.two_sweeps()
    square = replace(spec, study=replace(spec.study, sweeps=spec.study.sweeps[:1]))
    assert recorded_sweeps(spec, None) == ()
    with Journal(tmp_path / "j") as journal:
        assert recorded_sweeps(spec, journal, evaluate=toy.plain) == ()
        made = run_sweeps(square, journal, SerialExecutor(), evaluate=toy.plain)
        computed = lines(trace)
        found = recorded_sweeps(spec, journal, evaluate=toy.plain)
        assert results_table(square, found) == results_table(square, made)
        assert recorded_sweeps(spec, journal, "network", toy.plain) == ()
        made = run_sweeps(spec, journal, SerialExecutor(), evaluate=toy.plain)
        assert len(lines(trace)) == len(computed) + 4
        assert results_table(spec, recorded_sweeps(spec, journal, evaluate=toy.plain)) == results_table(spec, made)


def test_what_a_kind_refuses_beyond_its_parameters_is_a_row():
    """Catches figures of a window outside the stroke, which reading refuses and a sweep would compute."""

    def check(values):
        if values[toy.N] > 1:
            raise SpecError(f"actuator.n must be at most 1; got {values[toy.N]}.")

    spec = toy.two_sweeps()
    spec = replace(spec, kind=replace(spec.kind, check=check))
    rows = run_sweeps(spec, None, SerialExecutor(), evaluate=toy.plain)[1].rows
    assert [row.evaluation.status for row in rows] == [OK, OK, INVALID, INVALID]
    assert rows[2].evaluation.reasons == ("actuator.n must be at most 1; got 2.",)


def test_what_crashed_is_computed_again(trace, tmp_path):
    """Catches a power cut or a lack of memory that stays in the table for ever."""
    spec = toy.two_sweeps(3)
    with Journal(tmp_path / "j") as journal:
        square, _ = run_sweeps(spec, journal, SerialExecutor(), evaluate=toy.plain)
        key = json.loads(journal.path.read_text().splitlines()[0])
        failed = {**key, "evaluation": {**key["evaluation"], "status": FAILED}}
    (tmp_path / "j").write_text(json.dumps(failed) + "\n")
    with Journal(tmp_path / "j") as journal:
        again, _ = run_sweeps(spec, journal, SerialExecutor(), evaluate=toy.plain)
    assert again.rows[0].evaluation.status == square.rows[0].evaluation.status == OK


def test_progress_counts_and_knows_the_best(trace):
    """Catches a best that is not sound, and a count that does not reach its total."""
    seen = []
    square, _ = run_sweeps(toy.two_sweeps(), None, SerialExecutor(), progress=seen.append, evaluate=toy.plain)
    assert [state.done for state in seen] == list(range(1, 30))
    assert (seen[-1].total, seen[-1].failed, seen[-1].figure) == (29, 6, "force_constant")
    assert seen[-1].best == max(r.evaluation.performance.force_constant or 0 for r in (*square.rows, *_.rows))
    assert seen[-1].seconds_left == 0


def test_axes_that_over_determine_the_actuator_are_an_error():
    """Catches a table in which every single row repeats what is wrong with the specification."""
    either = Alternatives((toy.X, toy.Y), 1, "y = 1 - x")
    spec = toy.spec(sweeps=(toy.square(),))
    kind = replace(toy.TOY, alternatives=(either,), resolve=lambda given: {toy.Y: 1 - given[toy.X], **given})
    spec = replace(spec, kind=kind, given={toy.X: 1.0, toy.N: 1})
    with pytest.raises(SpecError, match="over-determined"):
        run_sweeps(spec, None, SerialExecutor(), evaluate=toy.plain)


def sloped(design, fidelity="fem", gradient=()):
    """The toy with derivatives that are no more than there."""
    made = toy.plain(design, fidelity)
    return replace(made, gradient={"force_constant": dict.fromkeys(gradient, 0.5)}) if gradient else made


def test_a_sweep_takes_from_a_gradient_search_what_it_computed(trace, tmp_path):
    """Catches the second computation of a design whose figures stand in the journal beside their derivatives."""
    spec = toy.two_sweeps(3)
    designs = [{toy.X: 0.0, toy.Y: 0.0}, {toy.X: 0.0, toy.Y: 5.0}]
    with Journal(tmp_path / "j") as journal:
        search = Evaluator(spec.for_study(), SerialExecutor(), journal, "fem", sloped, "search", (toy.X,))
        first = search.all(designs)
        assert [item.evaluation.gradient for item in first] == [{"force_constant": {toy.X: 0.5}}] * 2
        found = run_sweeps(spec, journal, SerialExecutor(), evaluate=sloped)
        assert [item.reused for item in search.all(designs)] == [True, True]
    assert len(lines(trace)) == len(set(lines(trace)))
    fresh = run_sweeps(spec, None, SerialExecutor(), evaluate=sloped)
    assert results_table(spec, found) == results_table(spec, fresh)
    assert [row.evaluation.gradient for row in found[0].rows] == [None] * 9
