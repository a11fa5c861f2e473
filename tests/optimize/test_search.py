"""The search: it finds known optima within its budget, keeps the best whatever happens, and replays exactly."""

import math
from dataclasses import replace

import pytest
import toy

from fluxbore.design.errors import OutputError, SpecError
from fluxbore.design.performance import Performance
from fluxbore.design.study import Axis, Constraint, Objective, Sweep, Variable
from fluxbore.optimize.evaluation import FAILED, INVALID
from fluxbore.optimize.executor import SerialExecutor, local_executor
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.problem import box
from fluxbore.optimize.search import check_study, network_optimum, one_at_a_time, run_search
from fluxbore.optimize.sweep import run_sweeps
from fluxbore.optimize.table import results_table

ROSENBROCK_ON_LIMIT = 9.956046925  # on x^2 + y^2 = 1, by bisection along the circle to 1e-12
ROSENBROCK = 10.0

# COBYLA and BOBYQA have the budget to converge; the global ones share it with the local search that follows them.
ALGORITHMS = {"COBYLA": 1e-3, "BOBYQA": 1e-3, "DIRECT-L": 1e-2, "CRS2": 1e-2, "ISRES": 1e-2}


def search(spec, model=toy.rosenbrock, journal=None, progress=None):
    return run_search(spec, journal, SerialExecutor(), progress, model)


def consistent(result, spec):
    """What holds for every result, however the search went."""
    assert len(result.history) <= spec.study.search.max_evaluations
    assert len(result.best_so_far) == len(result.history)
    best = None
    for made, index in zip(result.history, result.best_so_far, strict=True):
        if made.feasible and made.objective is not None and (best is None or made.objective > best.objective):
            best = made
        assert (None if index is None else result.history[index]) is best
        for variable in spec.study.variables:
            assert variable.lower <= made.values[variable.key] <= variable.upper
    assert result.best is best
    assert result.stop_reason.endswith(".")
    return result


def circle_optimum():
    """The best of `toy.rosenbrock` on the unit circle, by golden sections."""

    def force(angle):
        x, y = math.cos(angle), math.sin(angle)
        return 10 - (1 - x) ** 2 - 3 * (y - x * x) ** 2

    low, high, golden = 0.0, math.pi / 2, (math.sqrt(5) - 1) / 2
    while high - low > 1e-9:
        one, other = high - golden * (high - low), low + golden * (high - low)
        low, high = (low, other) if force(one) > force(other) else (one, high)
    return force(low)


@pytest.mark.parametrize("algorithm", ALGORITHMS)
@pytest.mark.parametrize("start", [(0.2, 0.2), (-0.5, 0.0), (1.9, -1.9)])
def test_it_finds_an_optimum_that_lies_on_a_limit(algorithm, start):
    """Catches a search that stops short of a limit, or beyond it: half of COBYLA's last points are infeasible."""
    spec = toy.rosenbrock_study(*start, algorithm=algorithm)
    result = consistent(search(spec), spec)
    assert circle_optimum() == pytest.approx(ROSENBROCK_ON_LIMIT, abs=1e-8)
    assert result.best.objective == pytest.approx(ROSENBROCK_ON_LIMIT, rel=ALGORITHMS[algorithm])
    assert result.best.objective <= ROSENBROCK_ON_LIMIT * (1 + 1e-9)
    assert result.best.checks[0].satisfied


def test_it_finds_an_optimum_inside():
    spec = toy.rosenbrock_study(limit=8.0)
    result = consistent(search(spec), spec)
    assert result.best.objective == pytest.approx(ROSENBROCK, rel=1e-4)
    assert not result.best.checks[0].active


@pytest.mark.parametrize("start", [(3.0, 0.9), (1.5, 0.9), (1.5, 1.2), (5.0, 0.7)])
def test_a_study_like_the_real_one_needs_at_most_forty_designs(start):
    """Catches a search that is too slow for the finite elements: two variables, a limit relative to the start."""
    spec = toy.actuator_study(*start)
    result = consistent(search(spec, toy.actuator_like), spec)
    reference = search(toy.actuator_study(*start, max_evaluations=400, relative_tolerance=1e-8), toy.actuator_like)
    assert len(result.history) <= 40
    assert result.best.objective == pytest.approx(reference.best.objective, rel=2e-4)
    assert result.best.checks[0].active
    assert result.best.values[toy.Y] >= 0.5
    assert result.best.objective >= result.start.objective
    assert result.ending == "done"
    assert result.network_start.evaluation.fidelity == "network"
    assert "converged" in result.stop_reason


def test_the_network_proposes_its_own_optimum():
    """Catches a network that is held to limits it cannot evaluate, or that stops at a local optimum's side."""
    spec = toy.rosenbrock_study()
    found = network_optimum(spec, box(spec, []), toy.rosenbrock)
    assert [found.values[toy.X], found.values[toy.Y]] == pytest.approx([0.5, 0.5], abs=1e-3)


@pytest.mark.parametrize("algorithm", ALGORITHMS)
@pytest.mark.parametrize("seed", range(4))
def test_failures_at_random_points_cost_those_points_only(algorithm, seed, monkeypatch):
    """Catches a search that ends with, or is led astray for good by, designs that raise, diverge or lack a figure."""
    monkeypatch.setenv("TOY_SEED", str(seed))
    spec = toy.rosenbrock_study(algorithm=algorithm)
    result = consistent(search(spec, toy.moody), spec)
    assert any(made.evaluation.status == FAILED for made in result.history)
    sound = [made for made in result.history if made.feasible and made.objective is not None]
    assert result.best.objective == max(made.objective for made in sound)
    assert result.best.objective > 9.3


def test_designs_that_cannot_be_built_are_history_not_endings():
    spec = toy.spec(
        x=8.0,
        y=8.0,
        objective=Objective("force_constant", True),
        variables=(Variable(toy.X, 0.0, 10.0), Variable(toy.Y, 0.0, 10.0)),
    )
    result = consistent(search(spec, total), spec)
    assert INVALID in {made.evaluation.status for made in result.history}
    assert result.best.objective > 18.5  # the corner beyond x = 9 and y = 9 cannot be built


def total(design, fidelity="fem"):
    return replace(
        toy.rosenbrock(design, fidelity),
        performance=Performance(force_constant=design.number(toy.X) + design.number(toy.Y)),
    )


@pytest.mark.parametrize("algorithm", ["COBYLA", "ISRES"])
def test_the_same_search_replays_over_its_journal(algorithm, tmp_path, monkeypatch):
    """Catches a seed that is not set, and a history that depends on the number of workers or on what is remembered."""
    monkeypatch.setenv("TOY_LOG", str(tmp_path / "trace"))
    spec = toy.rosenbrock_study(algorithm=algorithm)

    def trace():
        return (tmp_path / "trace").read_text().splitlines()

    with Journal(tmp_path / "j") as journal:
        first = search(spec, journal=journal)
    records = (tmp_path / "j").read_bytes().splitlines(keepends=True)
    computed = len(records)
    network = len(trace()) - computed
    # As a kill leaves it: some records, the last of them torn.
    (tmp_path / "j").write_bytes(b"".join(records[:11]) + records[11][:100])
    (tmp_path / "trace").unlink()
    with Journal(tmp_path / "j") as journal:
        second = search(spec, journal=journal)
    assert len(trace()) - network == computed - 11
    assert results_table(spec, (), second.history) == results_table(spec, (), first.history)
    assert second.best == first.best
    with local_executor(2) as executor:
        third = run_search(spec, None, executor, None, toy.rosenbrock)
    assert [made.values for made in third.history] == [made.values for made in first.history]
    assert third.rounded == first.rounded


def test_ctrl_c_gives_back_what_there_is():
    """Catches the loss of an hour's search, and an interruption that NLopt's C code swallows."""
    spec = toy.rosenbrock_study()
    seen = []

    def interrupt(state):
        seen.append(state)
        if state.done == 9:
            raise KeyboardInterrupt

    result = consistent(search(spec, progress=interrupt), spec)
    assert len(result.history) == 9
    assert result.stop_reason == "The search was interrupted."
    assert result.ending == "interrupted"
    assert seen[-1].best == result.best.objective


def test_a_full_disk_gives_back_what_there_is(tmp_path, monkeypatch):
    """Catches a search that loses what it found because it cannot write down the next design."""
    spec = toy.rosenbrock_study()
    journal = Journal(tmp_path / "j")
    put, calls = journal.put, []

    def full(*arguments):
        calls.append(arguments)
        if len(calls) > 12:
            raise OutputError("j cannot be written: No space left on device.")
        return put(*arguments)

    monkeypatch.setattr(journal, "put", full)
    result = consistent(search(spec, journal=journal), spec)
    assert result.stop_reason == "j cannot be written: No space left on device."
    assert result.ending == "failed"
    assert result.best is not None
    journal.close()


@pytest.mark.parametrize("budget", [1, 2, 3, 4, 7, 12])
@pytest.mark.parametrize("start", [(0.2, 0.2), (5.0, 0.0)])
def test_no_budget_is_overdrawn(budget, start, tmp_path, monkeypatch):
    """Catches designs beyond the budget: by the first ones, the simplex, the polishing, the rounding."""
    spec = toy.rosenbrock_study(*start, max_evaluations=budget)
    with Journal(tmp_path / "j") as journal:
        result = consistent(search(spec, journal=journal), spec)
        assert len(journal) <= budget
    assert "budget" in result.stop_reason
    assert result.ending == "done"


@pytest.mark.parametrize(("error", "ending"), [(KeyboardInterrupt, "interrupted"), (OutputError("Full."), "failed")])
def test_an_end_during_the_rounding_is_not_a_success(error, ending, monkeypatch):
    """Catches an exit status of 0 where the design that is made to the workshop's steps was never looked for."""

    def stop(*_):
        raise error

    monkeypatch.setattr("fluxbore.optimize.rounding.round_off", stop)
    spec = toy.rosenbrock_study()
    result = consistent(search(spec), spec)
    assert result.ending == ending
    assert result.best is not None


def test_an_infeasible_set_names_the_limit_that_is_nearest():
    spec = toy.rosenbrock_study()
    impossible = (Constraint("stray_field", upper=1.0), Constraint("total_mass", lower=1.5))
    spec = replace(spec, study=replace(spec.study, constraints=impossible))
    result = search(spec)
    assert result.best is result.rounded is result.chosen is None
    assert "No design met every limit; the nearest missed " in result.stop_reason


def test_a_start_without_figures_leaves_relative_limits_without_numbers():
    spec = toy.actuator_study(y=2.6)  # no winding
    result = search(spec, toy.actuator_like)
    assert result.best is None
    assert result.stop_reason.startswith("study.constraints cannot be held: stray_field of the start design")


def test_rounding_gives_steps_and_never_less_than_a_start_on_them():
    """Catches a rounded design that is worse than the start, which lies on the workshop's steps as well."""
    spec = toy.actuator_study(3.0, 0.9)
    result = consistent(search(spec, toy.actuator_like), spec)
    assert result.rounded in result.history
    assert result.rounded.feasible
    for value in result.rounded.values.values():
        assert value / 0.05 == pytest.approx(round(value / 0.05), abs=1e-9)
        assert len(repr(value)) <= 5, "1.75, not 1.7500000000000002"
    grid = [
        force
        for x in range(10, 121)
        for y in range(10, 51)
        if (force := feasible_force(spec, x / 20, y / 20, result.start)) is not None
    ]
    assert result.rounded.objective == pytest.approx(max(grid), rel=2e-4)
    assert result.rounded.objective >= result.start.objective


def feasible_force(spec, x, y, start):
    performance = toy.actuator_like(spec.with_values({toy.X: x, toy.Y: y})).performance
    stray, limit = performance.stray_field, start.evaluation.performance.stray_field
    return performance.force_constant if stray is not None and stray <= limit * (1 + 1e-9) else None


def test_without_resolution_nothing_is_rounded():
    spec = toy.rosenbrock_study()
    spec = replace(spec, study=replace(spec.study, variables=(Variable(toy.X, -2.0, 2.0), Variable(toy.Y, -2.0, 2.0))))
    result = search(spec)
    assert result.rounded is None
    assert result.chosen is result.best


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_one_variable_and_a_mass_to_minimise(algorithm):
    """Catches an algorithm that needs two variables, and a sign."""
    spec = toy.spec(
        x=1.5,
        y=0.0,
        objective=Objective("total_mass", False),
        variables=(Variable(toy.X, -2.0, 2.0, 0.1),),
        constraints=(Constraint("force_constant", lower=9.0),),
        search=replace(toy.spec().study.search, algorithm=algorithm),
    )
    result = search(spec)
    worst = min(x / 1e4 for x in range(-20000, 20000) if 10 - (1 - x / 1e4) ** 2 - 3 * (x / 1e4) ** 4 >= 9)
    assert result.best.objective == pytest.approx(worst, abs=5e-3)
    assert result.best.checks[0].satisfied
    assert len(result.history) <= 60


def test_a_search_without_an_objective_or_variables_is_an_error():
    with pytest.raises(SpecError, match=r"study\.objective must be given"):
        search(toy.spec())
    with pytest.raises(SpecError, match=r"study\.variables must be given"):
        search(toy.spec(objective=Objective("force_constant", True)))


@pytest.mark.parametrize(
    ("constraint", "words"),
    [
        (
            Constraint(toy.X, lower=3.0, relative_to_start=True),
            r"actuator\.x would have to be at least .*9.* at most .*6",
        ),
        (Constraint(toy.N, upper=0.5, relative_to_start=True), r"actuator\.n .* at most .*0\.5.* moves it from .*1"),
        (Constraint(toy.N, lower=2.0, relative_to_start=True), r"actuator\.n .* at least .*2.* moves it from .*1"),
    ],
)
def test_limits_on_keys_that_cannot_be_met_are_refused_before_anything_is_computed(constraint, words):
    """Catches "3 x start" on a variable whose bound is lower, found out after an hour of sweeps."""
    spec = toy.actuator_study()
    check_study(spec)
    held = Constraint(toy.N, upper=1.0, lower=1.0, relative_to_start=True)
    check_study(replace(spec, study=replace(spec.study, constraints=(held,))))
    spec = replace(spec, study=replace(spec.study, constraints=(*spec.study.constraints, constraint)))
    with pytest.raises(SpecError, match=words):
        check_study(spec)
    with pytest.raises(SpecError, match=words):
        search(spec, forbidden)
    check_study(replace(spec, study=replace(spec.study, variables=())))


def forbidden(design, fidelity="fem"):
    raise AssertionError("nothing is to be computed")


def test_one_at_a_time_without_a_start_is_none():
    """Catches a whole run that ends with "the input is wrong" because the start did not converge."""
    spec = toy.actuator_study(y=2.6)  # no winding
    spec = replace(spec, study=replace(spec.study, sweeps=(Sweep("y", (Axis(toy.Y, (0.4, 0.8)),)),)))
    results = run_sweeps(spec, None, SerialExecutor(), evaluate=toy.actuator_like)
    assert results[0].best("force_constant") is not None
    assert one_at_a_time(spec, results, None, SerialExecutor(), toy.actuator_like) is None


def test_one_at_a_time_is_the_best_of_each_sweep_together():
    """Catches the best of a grid of two axes taken for one choice, and a joint design that nobody evaluated."""
    spec = toy.actuator_study()
    axes = (Axis(toy.X, (0.5, 1.5, 2.5)), Axis(toy.Y, (0.4, 0.8, 1.2)), Axis(toy.N, (1.0, 2.0)))
    sweeps = tuple(Sweep(axis.key, (axis,)) for axis in axes) + (Sweep("both", axes[:2]),)
    spec = replace(spec, study=replace(spec.study, sweeps=sweeps))
    results = run_sweeps(spec, None, SerialExecutor(), evaluate=toy.actuator_like)
    best = [result.best("force_constant").values for result in results[:3]]
    found = one_at_a_time(spec, results, None, SerialExecutor(), toy.actuator_like)
    assert found.values == {**best[0], **best[1], **best[2]}
    assert found.objective == toy.actuator_like(spec.with_values(found.values)).performance.force_constant
    assert [item.limit.subject for item in found.checks] == ["stray_field", toy.Y]
    assert one_at_a_time(spec, results[3:], None, SerialExecutor(), toy.actuator_like) is None
