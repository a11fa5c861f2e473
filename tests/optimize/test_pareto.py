"""The front: known ones are found by both methods, its ends, its slopes, its standing; it survives and replays."""

import csv
import io
import math
import random
from dataclasses import replace
from functools import partial

import pareto_toys as toys
import pytest
import toy

from fluxbore.design.errors import OutputError, SpecError
from fluxbore.design.study import PARETO_METHODS, Objective, Variable
from fluxbore.optimize.evaluation import FAILED, NOT_CONVERGED
from fluxbore.optimize.executor import SerialExecutor, local_executor
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.pareto import front_table, run_pareto
from fluxbore.optimize.table import results_table

EPSILON, BOUNDARY = PARETO_METHODS


def front(spec, model, journal=None, progress=None):
    return consistent(run_pareto(spec, journal, SerialExecutor(), progress, model), spec)


def consistent(result, spec):
    """What holds for every front, however its search went."""
    points = result.points
    assert [point.position for point in points] == sorted(point.position for point in points)
    assert result.stop_reason.endswith(".")
    assert len(result.history) <= 3 + spec.study.search.max_evaluations * spec.study.pareto.points
    values = [tuple(made.values.items()) for made in result.history]
    assert len(set(values)) == len(values)
    for point in points:
        assert (point.design is None) == (point.standing == "failed")
        assert point.reason
        if point.design is not None:
            assert point.design in result.history
            assert point.design.feasible
    return result


def curve(result):
    return [(point.first, point.second) for point in result.front]


def scaled(result, point):
    """The point's two figures, 0 at the best and 1 at the other end."""
    first, last = result.points[0], result.points[-1]
    u = (point.first - first.first) / (last.first - first.first)
    return u, (point.second - last.second) / (first.second - last.second)


@pytest.mark.parametrize("method", PARETO_METHODS)
def test_a_convex_front_is_found_with_its_slopes(method):
    """Catches points beside the front, a multiplier without its scale, and cold starts: a point needs a few designs."""
    result = front(toys.study(method=method), toys.quadratic)
    assert [point.standing for point in result.points] == ["front"] * 9
    for point in result.points:
        x = math.sqrt(point.first)
        assert x + math.sqrt(point.second) == pytest.approx(1, abs=5e-4)
        assert point.residual < 1e-3
        assert point.slope == pytest.approx(-x / (1 - x), rel=0.02, abs=2e-4)
        assert "converged" in point.reason
    assert len(result.history) <= 8 * 9
    assert result.ending == "done"
    assert result.conflicting
    assert result.stop_reason == "The front has 9 of the 9 points asked for."


def test_the_epsilon_constraint_is_spread_evenly_over_the_second_objective():
    result = front(toys.study(points=6), toys.quadratic)
    ends = [point.second for point in (result.points[0], result.points[-1])]
    for i, point in enumerate(result.points[1:-1], 1):
        assert point.limit == pytest.approx(ends[0] + i / 5 * (ends[1] - ends[0]), rel=1e-12)
        assert point.second == pytest.approx(point.limit, abs=2e-4)
    assert result.points[0].limit is result.points[-1].limit is None


def test_boundary_intersection_goes_along_the_normal():
    """Catches a quasi-normal of the wrong scale: each point lies on the normal through its place on the line."""
    result = front(toys.study(points=6, method=BOUNDARY), toys.quadratic)
    for point in result.points:
        u, v = scaled(result, point)
        assert u - v == pytest.approx(2 * point.position - 1, abs=5e-4)
        assert point.limit is None


@pytest.mark.parametrize("method", PARETO_METHODS)
@pytest.mark.parametrize(
    ("model", "bounds", "known"),
    [
        (toys.fonseca, (-1.0, 2.0), lambda u: 1 - math.exp(-((2 - math.sqrt(-math.log(1 - u))) ** 2))),
        (toys.zdt1, (0.0, 1.0), lambda u: 1 - math.sqrt(u)),
        (toys.zdt2, (0.0, 1.0), lambda u: 1 - u * u),
        (toys.lazy, (0.0, 2.0), lambda u: (1 - u) ** 2),
    ],
)
def test_published_fronts_convex_and_concave(model, bounds, known, method):
    """Catches a method that finds the ends of a concave front only, or stays on a side of it."""
    result = front(toys.study(method=method, lower=bounds[0], upper=bounds[1]), model)
    assert len(result.front) == 9
    for u, v in curve(result):
        assert v == pytest.approx(known(u), abs=2e-3)
    for point in result.points:
        u, v = scaled(result, point)
        place = v - 1 if method == EPSILON else (v - u - 1) / 2
        assert place == pytest.approx(-point.position, abs=1e-3)


@pytest.mark.parametrize("method", PARETO_METHODS)
@pytest.mark.parametrize("seed", range(5))
def test_the_front_of_two_random_quadratics(method, seed):
    """Catches points beside the front of badly scaled problems: there one gradient is the other's negative multiple,
    and the multiple is the slope."""
    draw = random.Random(seed)

    def quadratic():
        a, e = 10 ** draw.uniform(-1, 1), 10 ** draw.uniform(-1, 1)
        return a, draw.uniform(-0.8, 0.8) * math.sqrt(a * e), e, draw.uniform(-0.8, 1.8), draw.uniform(-0.8, 1.8)

    first, second = quadratic(), quadratic()
    model = partial(toys.ellipses, first=first, second=second)
    result = front(toys.study(method=method, lower=-3.0, upper=4.0, points=7), model)
    assert len(result.front) == 7
    assert max(point.residual for point in result.points) < 1e-3
    # No end was left short of its optimum: the front is scaled to where it ends.
    assert result.reference == (result.points[-1].first, result.points[0].second)
    for point in result.points[1:-1]:
        x, y = point.design.values[toy.X], point.design.values[toy.Y]
        (gx, gy), (hx, hy) = (
            (a * (x - c) + b * (y - d), b * (x - c) + e * (y - d)) for a, b, e, c, d in (first, second)
        )
        assert gx * hy - gy * hx == pytest.approx(0, abs=0.02 * math.hypot(gx, gy) * math.hypot(hx, hy))
        assert gx * hx + gy * hy < 0
        assert point.slope == pytest.approx(-math.hypot(gx, gy) / math.hypot(hx, hy), rel=0.02)
    assert len(result.history) < 15 * 7


def test_a_front_in_five_pieces():
    """Catches a walk that stops where the front does: ZDT3's five pieces, none of the folds between them."""
    spec = toys.study(points=17, lower=0.0, upper=1.0, network="start")
    result = front(spec, toys.zdt3)

    def wave(u):
        return 1 - math.sqrt(u) - u * math.sin(10 * math.pi * u)

    grid = [(i / 20000, wave(i / 20000)) for i in range(20001)]
    for u, v in curve(result):
        assert v == pytest.approx(wave(u), abs=2e-3)
        assert not any(a < u - 0.02 and b < v - 0.02 for a, b in grid)
    pieces = [(0.0, 0.0830), (0.1823, 0.2578), (0.4093, 0.4539), (0.6184, 0.6525), (0.8233, 0.8519)]
    for low, high in pieces:
        assert any(low - 1e-3 <= u <= high + 1e-3 for u, _ in curve(result))


def test_of_the_designs_that_share_the_best_the_end_is_the_undominated_one():
    """Catches an end that the objective alone decides: with `lazy` any y would do."""
    result = front(toys.study(lower=0.0, upper=2.0), toys.lazy)
    assert result.points[0].design.values[toy.Y] == pytest.approx(0, abs=1e-4)
    assert result.points[0].second == pytest.approx(1, abs=1e-4)


def test_the_slope_at_an_end_in_a_corner_is_the_one_sided_one():
    """Catches a multiplier that the bound's may stand in for: ZDT2 with x and y >= 0.2, so v = 2.8 - u^2/2.8."""
    result = front(toys.study(points=3, x=0.4, lower=0.2, upper=1.0), toys.zdt2)
    assert [point.first for point in result.anchors] == pytest.approx([0.2, 1.0])
    assert [point.slope for point in result.anchors] == pytest.approx([-2.8 / 0.4, -2.8 / 2.0], rel=1e-3)


@pytest.mark.parametrize("method", PARETO_METHODS)
def test_objectives_without_a_conflict_have_a_front_of_one_point(method):
    result = front(toys.study(method=method, lower=-1.0, upper=5.0), toys.friends)
    (only,) = result.points
    assert (only.first, only.second) == pytest.approx((1.0, 5.0), abs=1e-4)
    assert not result.conflicting
    assert only.slope is None
    assert "do not conflict" in result.stop_reason
    assert result.hypervolume is result.reference is None


@pytest.mark.parametrize("method", PARETO_METHODS)
def test_a_limit_of_the_study_holds_all_along(method):
    """Catches a front that ends where the unconstrained one does: 1 + x^2 <= 1.25 ends it at x = 1/2."""
    result = front(toys.study(stray=1.25, method=method), toys.quadratic)
    assert len(result.front) == 9
    assert result.points[-1].second == pytest.approx(0.25, abs=2e-4)
    assert result.points[-1].design.checks[0].active
    assert all(point.design.checks[0].satisfied for point in result.front)


@pytest.mark.parametrize("method", PARETO_METHODS)
def test_a_maximum_is_held_itself_and_not_its_norm(method):
    """Catches a front on limits that the smooth stand-in meets and the maximum does not: x <= 0.7 ends this one."""
    result = front(toys.study(stray=0.9, method=method), toys.rough)
    assert result.points[-1].first == pytest.approx(0.49, abs=1e-3)
    assert result.points[-1].second == pytest.approx(0.09, abs=1e-3)
    assert all(point.design.evaluation.performance.stray_field <= 0.9 * (1 + 1e-9) for point in result.front)


@pytest.mark.parametrize("method", PARETO_METHODS)
def test_signs_and_sizes_of_the_figures_do_not_matter(method):
    """Catches a scale that is left out: the same front, one figure a million times larger and to be maximised."""
    plain = front(toys.study(method=method), toys.quadratic)
    other = front(toys.study(method=method, maximise=(True, False)), toys.upside_down)
    for one, two in zip(plain.points, other.points, strict=True):
        assert two.design.values == pytest.approx(one.design.values, abs=3e-3)
        assert two.first == pytest.approx(-1e6 * one.first, abs=2e3)
        assert two.second == pytest.approx(1e-3 * one.second, abs=2e-6)
    assert [point.slope for point in other.points[1:-1]] == pytest.approx(
        [-1e9 * point.slope for point in plain.points[1:-1]], rel=0.01
    )
    assert other.hypervolume == pytest.approx(plain.hypervolume, abs=2e-3)


@pytest.mark.parametrize("method", PARETO_METHODS)
def test_without_gradients_the_front_is_the_same(method):
    """Catches a front that needs derivatives, or claims multipliers without them."""
    result = front(toys.study(points=5, method=method, max_evaluations=100), toys.free)
    for point in result.front:
        assert math.sqrt(point.first) + math.sqrt(point.second) == pytest.approx(1, abs=3e-3)
        assert point.slope is point.residual is None
    assert len(result.front) == 5
    assert all(made.evaluation.gradient is None for made in result.history)


def test_an_algorithm_without_gradients_is_obeyed():
    result = front(toys.study(points=3, algorithm="COBYLA"), toys.quadratic)
    assert all(made.evaluation.gradient is None for made in result.history)


def test_a_model_that_promises_gradients_and_has_none_gets_cobyla():
    result = front(toys.study(points=3, max_evaluations=80), toys.promising)
    assert len(result.front) == 3
    assert all(point.residual is None for point in result.points)


@pytest.mark.parametrize("method", PARETO_METHODS)
@pytest.mark.parametrize("model", [toys.moody, toys.moody_free])
def test_designs_that_fail_cost_themselves_only(method, model):
    """Catches a search that ends at, or is led astray by, designs that diverge or raise."""
    result = front(toys.study(points=5, method=method, x=0.6, y=0.5, upper=1.5, max_evaluations=80), model)
    statuses = {made.evaluation.status for made in result.history}
    assert statuses & {FAILED, NOT_CONVERGED}
    assert len(result.front) == 5
    for point in result.front:
        assert math.sqrt(point.first) + math.sqrt(point.second) == pytest.approx(1, abs=3e-3)


@pytest.mark.parametrize(("limit", "missed"), [(0.5, "0.5 T by 100.00%."), (0.0, "0 T by 1 T.")])
def test_a_study_that_nothing_meets_says_what_is_missed(limit, missed):
    """Catches a share of a limit of zero, which has no size."""
    result = front(toys.study(stray=limit, points=3), toys.quadratic)
    assert result.front == ()
    assert len(result.failed) == 2
    assert f"stray_field <= {missed}" in result.stop_reason
    assert result.anchors == (None, None)
    assert result.hypervolume is None
    assert result.ending == "done"


@pytest.mark.parametrize("budget", [1, 2, 3])
@pytest.mark.parametrize("method", PARETO_METHODS)
def test_no_points_budget_is_overdrawn(budget, method):
    result = front(toys.study(method=method, max_evaluations=budget), toys.quadratic)
    assert all(point.designs <= budget for point in result.points)
    assert any("used up its budget" in point.reason for point in result.points)


@pytest.mark.parametrize("method", PARETO_METHODS)
def test_the_same_front_replays_over_its_journal(method, tmp_path, monkeypatch):
    """Catches a front that depends on threads, on the number of workers or on memory, and work done twice."""
    monkeypatch.setenv("TOY_LOG", str(tmp_path / "trace"))
    spec = toys.study(method=method)

    with Journal(tmp_path / "j") as journal:
        first = front(spec, toys.quadratic, journal)
    records = (tmp_path / "j").read_bytes().splitlines(keepends=True)
    assert len(records) == len(first.history)
    # As a kill leaves it: some records, the last of them torn.
    (tmp_path / "j").write_bytes(b"".join(records[:20]) + records[20][:100])
    (tmp_path / "trace").unlink()
    with Journal(tmp_path / "j") as journal:
        second = front(spec, toys.quadratic, journal)
    assert len((tmp_path / "trace").read_text().splitlines()) == len(records) - 20
    assert second.reused == 20
    assert front_table(second) == front_table(first)
    assert results_table(spec, (), second.history) == results_table(spec, (), first.history)
    with local_executor(2) as executor:
        third = run_pareto(spec, None, executor, None, toys.quadratic)
    assert front_table(third) == front_table(first)
    assert [made.values for made in third.history] == [made.values for made in first.history]


@pytest.mark.parametrize("when", [2, 12, 40])
def test_ctrl_c_gives_back_what_there_is(when):
    """Catches the loss of the points that were found, and threads that outlive the run."""
    import threading

    before = threading.active_count()

    def interrupt(state):
        if state.done == when:
            raise KeyboardInterrupt

    result = front(toys.study(), toys.quadratic, progress=interrupt)
    assert result.ending == "interrupted"
    assert result.stop_reason == "The front was interrupted."
    assert len(result.history) == when
    assert threading.active_count() == before
    assert all(point.reason == "The run ended before this point." for point in result.failed)
    if when == 40:
        assert len(result.front) >= 3


def test_a_full_disk_gives_back_what_there_is(tmp_path, monkeypatch):
    journal = Journal(tmp_path / "j")
    put, calls = journal.put, []

    def full(*arguments):
        calls.append(arguments)
        if len(calls) > 40:
            raise OutputError("j cannot be written: No space left on device.")
        return put(*arguments)

    monkeypatch.setattr(journal, "put", full)
    result = front(toys.study(), toys.quadratic, journal)
    assert result.stop_reason == "j cannot be written: No space left on device."
    assert result.ending == "failed"
    assert len(result.front) >= 3
    journal.close()


def test_a_time_limit_lets_no_further_design_begin():
    result = front(toys.study(time_limit=1e-9), toys.quadratic)
    assert len(result.history) == 1
    assert "time limit" in result.stop_reason
    assert result.ending == "done"


def test_a_start_outside_the_bounds_is_in_the_history_and_nowhere_else():
    result = front(toys.study(x=5.0, points=3), toys.quadratic)
    assert result.history[0].values[toy.X] == 5.0
    assert all(point.design.values[toy.X] <= 2.0 for point in result.front)
    assert len(result.front) == 3


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"objective": None}, r"study\.objective must be given for a front; got none\."),
        ({"pareto": None}, r"study\.pareto must be given for a front; got none\."),
        ({"variables": ()}, r"study\.variables must be given for a front; got none\."),
        ({"objective": Objective(toys.SECOND, True)}, r"study\.pareto\.against must be another figure .* total_mass"),
        ({"variables": (Variable(toy.N, 1, 3, integer=True),)}, r"study\.variables must be continuous .*actuator\.n"),
    ],
)
def test_a_study_without_a_front_is_refused(change, words):
    spec = toys.study()
    with pytest.raises(SpecError, match=words):
        front(replace(spec, study=replace(spec.study, **change)), toys.quadratic)


def test_the_table_reads_back_exactly():
    result = front(toys.study(points=3), toys.quadratic)
    rows = list(csv.DictReader(io.StringIO(front_table(result))))
    assert [float(row["position"]) for row in rows] == [0.0, 0.5, 1.0]
    assert [row["limit"] == "" for row in rows] == [True, False, True]
    assert [float(row[toys.FIRST]) for row in rows] == [point.first for point in result.points]
    assert [float(row["slope"]) for row in rows] == [point.slope for point in result.points]
    assert [float(row[toy.X]) for row in rows] == [point.design.values[toy.X] for point in result.points]
    assert {row["standing"] for row in rows} == {"front"}
