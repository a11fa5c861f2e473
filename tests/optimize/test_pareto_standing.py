"""What is dominated, what is repeated, and how much a front dominates; the conditions and slopes in plain numbers."""

import math
from dataclasses import replace
from itertools import pairwise

import pytest
import toy
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.performance import Performance
from fluxbore.design.study import Objective
from fluxbore.optimize.evaluation import OK, Evaluation
from fluxbore.optimize.outcome import Candidate
from fluxbore.optimize.pareto_result import FrontPoint
from fluxbore.optimize.pareto_scalar import Scale, Seen, best_of, boundary_intersection
from fluxbore.optimize.pareto_slope import Conditions
from fluxbore.optimize.pareto_standing import hypervolume, jumps, summary, with_standing

BOTH = (Objective("force_constant", False), Objective("total_mass", False))
UNIT = Scale(BOTH)
LOSSES = st.lists(st.tuples(st.floats(0, 1), st.floats(0, 1)), max_size=12)


def point(pair, position=0.5):
    """A point with these two figures; None for one that failed."""
    if pair is None:
        return FrontPoint(position, None, None, None, None, "failed", "Nothing.")
    figures = Performance(force_constant=pair[0], total_mass=pair[1])
    design = Candidate({toy.X: pair[0]}, Evaluation("fem", OK, (), figures), pair[0], ())
    return FrontPoint(position, None, design, *pair, "front", "Found.")


def standings(*pairs, tolerance=1e-3):
    return [item.standing for item in with_standing([point(pair) for pair in pairs], UNIT, tolerance)]


def test_dominated_and_repeated_points_are_marked():
    assert standings((0, 1), (0.5, 0.5), (1, 0)) == ["front"] * 3
    assert standings((0, 1), (0.5, 0.6), None, (0.5, 0.5), (1, 0)) == ["front", "dominated", "failed", "front", "front"]
    assert standings((0, 1), (0.5, 0.5), (0.5004, 0.4998), (1, 0)) == ["front", "front", "repeated", "front"]


def test_what_the_search_cannot_tell_apart_is_not_dominated():
    """Catches a front that loses points to the last digit of its searches."""
    assert standings((0.5, 0.5), (0.4995, 0.4995)) == ["front", "repeated"]
    assert standings((0.5, 0.5), (0.4995, 0.4995), tolerance=1e-5) == ["dominated", "front"]


@given(LOSSES)
def test_the_front_is_what_nothing_dominates(pairs):
    found = with_standing([point(pair) for pair in pairs], UNIT, 0.0)
    for item, own in zip(found, pairs, strict=True):
        beaten = any(a <= own[0] and b <= own[1] and (a, b) != own for a, b in pairs)
        assert (item.standing == "dominated") == beaten
    assert not pairs or any(item.standing == "front" for item in found)


def test_a_jump_is_where_the_secant_leaves_the_slopes():
    """Catches a second look at every bend, and none at a gap."""

    def along(*items):
        points = [replace(point((u, v), i), slope=slope) for i, (u, v, slope) in enumerate(items)]
        return jumps(with_standing(points, UNIT, 1e-3))

    assert along((0.0, 1.0, 0.0), (0.25, 0.25, -1.0), (1.0, 0.0, None)) == []
    assert along((0.0, 1.0, -0.1), (0.04, 0.8, -0.3), (0.8, 0.7, -0.3), (1.0, 0.0, -0.3)) == [(1, 2)]
    assert along((0.0, 1.0, -2.0), (0.1, 0.2, -2.0)) == [(0, 1)]
    assert along((0.0, 1.0, -2.0), (0.1, 0.2, None)) == []


def test_the_hypervolume_of_known_fronts():
    assert hypervolume([point(pair) for pair in [(0, 1), (1, 0)]], UNIT) == 0
    assert hypervolume([point(pair) for pair in [(0, 1), (0, 0)]], UNIT) == 1
    assert hypervolume([point(pair) for pair in [(0.25, 0.5), (0.5, 0.25), None, (0.6, 0.6)]], UNIT) == 0.5


@given(LOSSES)
def test_the_hypervolume_is_the_area_that_is_dominated(pairs):
    """Catches steps counted twice: the area summed over the cells between all coordinates."""
    us = sorted({0.0, 1.0, *(u for u, _ in pairs)})
    vs = sorted({0.0, 1.0, *(v for _, v in pairs)})
    area = math.fsum(
        (right - left) * (top - bottom)
        for left, right in pairwise(us)
        for bottom, top in pairwise(vs)
        if any(u <= left and v <= bottom for u, v in pairs)
    )
    assert hypervolume([point(pair) for pair in pairs], UNIT) == pytest.approx(area, abs=1e-12)


def test_the_summary_counts():
    found = with_standing([point(pair) for pair in [(0, 1), (0.5, 0.5), (0.6, 0.6), None, (1, 0)]], UNIT, 1e-3)
    assert summary(found) == (
        "The front has 3 of the 5 points asked for; 1 is dominated by others, 1 is without a feasible design."
    )


def test_scaled_losses_run_from_0_to_1_whatever_the_sign():
    """Catches a figure to be maximised that is scaled the wrong way round."""
    scale = Scale((Objective("force_constant", True), Objective("total_mass", False)), (-8.0, 0.5), (6.0, 0.25))
    assert scale.scaled((8.0, 0.5)) == (0, 0)
    assert scale.scaled((2.0, 0.75)) == (1, 1)
    assert (scale.figure(0, 1.0), scale.figure(1, 1.0)) == (2.0, 0.75)
    # du/dv = -1 is 6 N/A for 0.25 kg; more mass, more force.
    assert Conditions(0.0, (1.0, 1.0)).slope(scale) == pytest.approx(24.0)
    assert Conditions(0.0, (0.0, 1.0)).slope(scale) is None


@given(st.floats(0, 1), st.floats(0, 1), st.floats(0.05, 0.95))
def test_the_slack_of_the_intersection_is_what_the_rows_allow(u, v, position):
    """Catches rows that do not belong to the point on the line: both hold with the best slack, one of them just so."""
    problem = boundary_intersection(position)
    t = problem.slack(u, v)
    rows = [row.at(u, v, t) for row in problem.rows]
    assert max(rows) == pytest.approx(0, abs=1e-12)
    assert problem.score(u, v) == pytest.approx((0, -t), abs=1e-12)
    on_line = problem.score(position, 1 - position)
    assert on_line == pytest.approx((0, 0), abs=1e-12)


@pytest.mark.parametrize("problem", [boundary_intersection(0.3), best_of(0, 0.4), best_of(1), best_of(1, 0.2)])
def test_what_nlopt_sees_has_its_own_slopes(problem):
    """Catches a derivative of another row, or of the slack by its own value in place of its variable."""
    slopes, miss_slopes = ((0.7, -0.2), (-0.4, 0.9)), ((0.1, 0.3),)

    def seen(x):
        shift = [sum(a * b for a, b in zip(row, x, strict=True)) for row in (*slopes, *miss_slopes)]
        return Seen((0.5 + shift[0], 0.25 + shift[1]), (-0.1 + shift[2],), slopes, miss_slopes)

    start = (0.2, 0.4, *problem.begin(seen((0.2, 0.4))))
    here = problem.view(seen(start[:2]), start[2:])
    for i in range(len(start)):
        moved = [x + 1e-6 * (i == j) for j, x in enumerate(start)]
        there = problem.view(seen(moved[:2]), moved[2:])
        assert (there.loss - here.loss) / 1e-6 == pytest.approx(here.slope[i], abs=1e-8)
        for k, miss in enumerate(there.misses):
            assert (miss - here.misses[k]) / 1e-6 == pytest.approx(here.miss_slopes[k][i], abs=1e-8)
