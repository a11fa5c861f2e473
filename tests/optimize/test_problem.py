"""Limits with numbers, held against designs; bounds and scaling."""

import math
from dataclasses import replace

import pytest
import smooth
import toy
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.errors import DesignError, SpecError
from fluxbore.design.performance import Performance
from fluxbore.design.study import Constraint, Variable
from fluxbore.optimize.evaluation import OK, Evaluation, failure
from fluxbore.optimize.executor import SerialExecutor
from fluxbore.optimize.outcome import Limit
from fluxbore.optimize.problem import Box, box, check, resolve_limits, show_miss
from fluxbore.optimize.search import run_search


def evaluation(fidelity="fem", **figures):
    return Evaluation(fidelity, OK, (), Performance(**figures))


def test_limits_get_their_numbers_from_the_start():
    spec = toy.spec(
        x=2.0,
        constraints=(
            Constraint("stray_field", upper=1.1, relative_to_start=True),
            Constraint("total_mass", lower=1.0, upper=3.0),
            Constraint(toy.X, upper=0.5, relative_to_start=True),
        ),
    )
    assert resolve_limits(spec, evaluation(stray_field=0.2)) == (
        Limit("stray_field", "<=", 1.1 * 0.2),
        Limit("total_mass", ">=", 1.0),
        Limit("total_mass", "<=", 3.0),
        Limit(toy.X, "<=", 1.0),
    )
    assert [limit.subject for limit in resolve_limits(spec, evaluation("network"))] == ["total_mass"] * 2 + [toy.X]
    with pytest.raises(DesignError, match=r"stray_field of the start design is not known\. No convergence\.$"):
        resolve_limits(spec, failure("fem", "not converged", "No convergence."))


def test_factors_of_a_negative_start_keep_their_sides():
    """Catches limits that swap: 0.9 and 1.1 times -0.2 are -0.18 and -0.22, between which nothing would be."""
    spec = toy.spec(constraints=(Constraint("voltage_margin", lower=0.9, upper=1.1, relative_to_start=True),))
    lower, upper = resolve_limits(spec, evaluation(voltage_margin=-0.2))
    assert (lower.sense, upper.sense) == (">=", "<=")
    assert (lower.limit, upper.limit) == pytest.approx((-0.22, -0.18))


@pytest.mark.parametrize("limit", [0.0, 1e-9])
def test_a_limit_of_zero_is_measured_in_the_starts_value(limit):
    """Catches misses of 1e-5 for millimetres, which no tolerance of a search would mind."""
    spec = toy.spec(constraints=(Constraint("winding_room", lower=limit),))
    (room,) = resolve_limits(spec, evaluation(winding_room=4e-4))
    (item,) = check([room], {}, Performance(winding_room=limit - 1e-5))
    assert item.margin == pytest.approx(-1e-5 / 4e-4)
    assert show_miss(spec, item) == "0.01 mm"
    (unknown,) = resolve_limits(toy.spec(constraints=(Constraint("winding_room", lower=0.0),)), evaluation())
    assert unknown.size == 1e-3
    (ordinary,) = resolve_limits(
        toy.spec(constraints=(Constraint("winding_room", lower=1e-4),)), evaluation(winding_room=4e-4)
    )
    assert ordinary.size == 1e-4


def test_a_limit_is_held_to_the_last_digits_that_rounding_leaves():
    """Catches an incumbent that is feasible by the search's tolerance only."""
    limits = (Limit("stray_field", "<=", 0.1), Limit(toy.X, ">=", 2.0))
    for miss, satisfied in ((0.0, True), (5e-10, True), (2e-9, False), (-1e-12, True)):
        (upper, lower) = check(limits, {toy.X: 2.0 * (1 - miss)}, Performance(stray_field=0.1 * (1 + miss)))
        assert (upper.satisfied, lower.satisfied) == (satisfied, satisfied)
        assert upper.active
        assert lower.active
        assert upper.margin == pytest.approx(-miss, abs=1e-15)
    (far, _) = check(limits, {toy.X: 2.0}, Performance(stray_field=0.05))
    assert (far.satisfied, far.active, far.margin) == (True, False, 0.5)


def test_a_figure_that_is_not_known_counts_against_the_finite_elements_only():
    limits = (Limit("stray_field", "<=", 0.1),)
    assert not check(limits, {}, Performance(), "fem")[0].satisfied
    (skipped,) = check(limits, {}, Performance(), "network")
    assert (skipped.satisfied, skipped.value, skipped.margin, skipped.active) == (True, None, None, False)
    assert not check(limits, {}, Performance(stray_field=math.nan), "fem")[0].satisfied


@pytest.mark.parametrize("figure", ["cylinder_safety", "cap_safety", "shaft_safety", "buckling_safety"])
def test_no_load_meets_every_limit_on_safety(figure):
    """Catches a cylinder without pressure that misses its factor of safety, and a rod that buckles under a pull."""
    (limit, above) = (Limit(figure, ">=", 3.0), Limit(figure, "<=", 9.0))
    stress = "hoop_stress" if figure in ("cylinder_safety", "cap_safety") else "shaft_stress"
    held, missed = check([limit, above], {}, Performance(**{stress: 0.0}))
    assert (held.satisfied, held.value, held.active) == (True, None, False)
    assert not missed.satisfied
    assert not check([limit], {}, Performance(**{stress: 1e6}))[0].satisfied  # such as a yield stress that is missing
    assert check([limit], {}, Performance(**{stress: -1e6}))[0].satisfied == (figure == "buckling_safety")
    assert not check([limit], {}, Performance())[0].satisfied


def test_a_search_under_a_safety_without_load_is_a_search_by_gradients():
    """Catches a limit without a value that robs the others of their multipliers."""

    def unloaded(design, fidelity="fem", gradient=()):
        made = smooth.rosenbrock(design, fidelity, gradient)
        return replace(made, performance=replace(made.performance, hoop_stress=0.0))

    limits = (Constraint("stray_field", upper=1.0), Constraint("cylinder_safety", lower=3.0))
    result = run_search(smooth.study(constraints=limits), None, SerialExecutor(), None, unloaded, True)
    assert result.algorithm == "SLSQP"
    assert result.best.objective == pytest.approx(9.956046925, rel=1e-4)  # as without it, see test_search
    assert [item.subject for item in result.optimality.multipliers] == ["stray_field"]


def test_limits_on_variables_narrow_their_bounds():
    spec = toy.spec(variables=(Variable(toy.X, 0.0, 4.0), Variable(toy.Y, 1.0, 2.0)))
    bounds = box(spec, [Limit(toy.X, ">=", 0.5), Limit(toy.X, "<=", 9.0), Limit("stray_field", "<=", 0.0)])
    assert (bounds.lower, bounds.upper) == ((0.5, 1.0), (4.0, 2.0))
    with pytest.raises(SpecError, match=r"actuator\.x would have to be at least 5000 mm and at most 4000 mm"):
        box(spec, [Limit(toy.X, ">=", 5.0)])


@given(
    low=st.floats(-1e3, 1e3),
    span=st.floats(1e-3, 1e3),
    x=st.floats(-0.5, 1.5),
)
def test_scaling_never_leaves_the_bounds_and_is_settled_after_one_way(low, span, x):
    """Catches a bound that is overstepped by a rounding error, and a point that drifts with every conversion."""
    bounds = Box(("k",), (low,), (low + span,))
    point = bounds.tidy([x])
    values = bounds.values(point)
    assert low <= values["k"] <= low + span
    assert bounds.contains(values)
    assert bounds.point(values)[0] == pytest.approx(point[0], abs=2e-9)


def test_a_bound_without_room_is_no_division_by_zero():
    bounds = Box(("k",), (2.0,), (2.0,))
    assert bounds.values(bounds.point({"k": 7.0})) == {"k": 2.0}
