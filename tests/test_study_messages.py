"""What is said of optima, conflicts, fronts and yields: units, signs, and the words that carry them."""

import json
import math
from dataclasses import replace

import pytest

from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec, loads
from fluxbore.design.spec_file import template
from fluxbore.design.study import Objective, Production, Tolerance
from fluxbore.optimality_messages import conflict_lines, optimality_lines
from fluxbore.optimize.evaluation import OK, Evaluation
from fluxbore.optimize.outcome import Candidate, Check, Clash, Conflict, Limit, Multiplier, Optimality, SearchResult
from fluxbore.optimize.pareto_result import FrontPoint, ParetoResult
from fluxbore.optimize.tolerance_result import (
    FigureSpread,
    Interval,
    Reject,
    Requirement,
    RobustResult,
    RobustRound,
    ToleranceEffect,
    ToleranceResult,
)
from fluxbore.optimize.verdict import shortfall
from fluxbore.pareto_messages import pareto_plain, pareto_text
from fluxbore.plain_values import finite
from fluxbore.search_messages import robust_design_text, search_plain, search_text
from fluxbore.tolerance_messages import tolerance_plain, tolerance_text

RING, YOKE = "actuator.mover.ring_width", "actuator.back_yoke.thickness"
FORCE = Objective("force_constant", True)


@pytest.fixture(scope="module")
def spec() -> Spec:
    return loads(template("ipehla"))


def said(lines: list[str], subject: str) -> str:
    (line,) = [line for line in lines if line.strip().startswith(subject)]
    return line.strip()


def test_a_multiplier_says_what_a_handy_step_buys(spec):
    """50 N/A per tesla at a limit of 0.42 mT: 0.01 mT more is 0.0005 N/A; a lower limit gives way downwards."""
    found = Optimality(
        2.5e-7,
        (
            Multiplier("stray_field", "<=", 4.2e-4, 4.2e-4, 50.0, 0.002),
            Multiplier(YOKE, ">=", 5e-4, 5e-4, -400.0, 0.02),
            Multiplier(RING, "<=", 6e-3, 6e-3, 30.0, 0.02, bound=True),
            Multiplier("total_mass", "<=", 0.85, 0.85, 0.0, 0.0),
        ),
    )
    lines = optimality_lines(spec, FORCE, found)
    assert "residual: 2.5e-07" in lines[0]
    assert said(lines, "stray_field") == (
        "stray_field at most 0.42 mT: 0.01 mT more would raise force_constant by 0.0005 N/A"
    )
    assert said(lines, YOKE) == f"{YOKE} at least 0.5 mm: 0.01 mm less would raise force_constant by 0.004 N/A"
    assert said(lines, RING) == (
        f"{RING} at most 6 mm, its own bound: 0.1 mm more would raise force_constant by 0.003 N/A"
    )
    assert said(lines, "total_mass") == "total_mass at most 850 g: more room would not change force_constant"


def test_what_is_minimised_is_lowered(spec):
    found = Optimality(0.0, (Multiplier("force_constant", ">=", 8.0, 8.0, 0.05, 0.5),))
    line = said(optimality_lines(spec, Objective("total_mass", False), found), "force_constant")
    assert line == "force_constant at least 8 N/A: 0.1 N/A less would lower total_mass by 5 g"


def test_a_conflict_says_who_clashes_and_by_how_much(spec):
    conflict = Conflict(
        {RING: 2e-3},
        0.125,
        (
            Clash("stray_field", "<=", 4e-4, 4.5e-4, 5e-5, 0.125, 0.6, 8e-5),
            Clash(RING, "<=", 2e-3, 2e-3, 0.0, 0.0, 0.4, 3e-4, True),
        ),
        settled=True,
    )
    lines = conflict_lines(spec, conflict)
    assert lines[0].endswith("misses the worst of them by 12.5 %:")
    assert said(lines, "stray_field") == (
        "stray_field at most 0.4 mT: found 0.45 mT, missed by 0.05 mT (12.5 %), weight 60 %, alone 0.08 mT would do"
    )
    assert said(lines, RING) == f"{RING} at most 2 mm, its own bound: found 2 mm, alone 0.3 mm would do"
    assert lines[0].startswith("These limits exclude one another; ")
    unsettled = conflict_lines(spec, replace(conflict, settled=False))[0]
    assert unsettled == (
        "These limits could not be met, as far as the search went; the nearest design misses the worst by 12.5 %:"
    )
    alone = conflict_lines(spec, replace(conflict, clashes=conflict.clashes[:1]))[0]
    assert alone.startswith("This limit cannot be met around the nearest design, whatever the others; ")
    found = conflict_lines(spec, replace(conflict, clashes=conflict.clashes[:1], settled=False))[0]
    assert found.startswith("This limit could not be met, as far as the search went; ")


def test_a_miss_of_a_limit_of_zero_has_a_unit_and_no_share(spec):
    """Catches a per cent of nothing: what is missed is relative to the start's value, which the reader does not see."""
    clash = Clash("winding_room", ">=", 0.0, -1e-5, 1e-5, 0.025, 1.0, 1e-5, scale=4e-4)
    lines = conflict_lines(spec, Conflict({RING: 2e-3}, 0.025, (clash,), settled=True))
    assert lines[0].endswith("; it is missed by 0.01 mm:")
    assert said(lines, "winding_room") == (
        "winding_room at least 0 mm: found -0.01 mm, missed by 0.01 mm, weight 100 %, alone 0.01 mm would do"
    )


def candidate(ring: float, force: float, stray: float = 4e-4, *, held: bool = True) -> Candidate:
    evaluation = Evaluation("fem", OK, (), Performance(force_constant=force, stray_field=stray))
    check = Check(Limit("stray_field", "<=", 4.2e-4), stray, 0.1 if held else -0.1, held, False)
    return Candidate({RING: ring}, evaluation, force, (check,))


def test_the_price_of_rounding_is_told(spec):
    """And a rounded design that misses a limit is not quietly taken or dropped."""
    start, best, rounded = candidate(1e-3, 8.0), candidate(1.234e-3, 8.5), candidate(1.25e-3, 8.33)
    result = SearchResult(start, None, (start, best, rounded), (0, 1, 1), best, rounded, "It converged.", 3.0)
    assert "force_constant 8.5 N/A -> 8.33 N/A (-2 %)" in search_text(spec, result)
    missed = replace(result, rounded=candidate(1.25e-3, 8.33, 4.3e-4, held=False))
    assert "the rounded design misses stray_field <= 0.42 mT." in search_text(spec, missed)
    assert "3 designs by finite elements, in 3 s." in search_text(spec, result)
    aided = replace(result, network_calls=211, algorithm="MMA, then SLSQP")
    assert "Search by MMA, then SLSQP: 3 designs by finite elements and 211 by the magnetic network, in 3 s." in (
        search_text(spec, aided)
    )
    assert search_plain(aided)["network_calls"] == 211
    plain = search_plain(missed)
    assert plain["rounded"]["feasible"] is False
    assert plain["chosen"]["objective"] == 8.5
    assert plain["optimality"] is None


def test_what_is_said_belongs_to_a_design(spec):
    """Catches limits of the rounded design beside multipliers of the other one without a word on which is which."""
    start, best, rounded = candidate(-1e-14, 8.0), candidate(1.234e-3, 8.5), candidate(1.25e-3, 8.33)
    result = SearchResult(
        start, None, (start, best, rounded), (0, 1, 1), best, rounded, "It converged.", 3.0,
        optimality=Optimality(1e-5, ()),
    )  # fmt: skip
    text = search_text(spec, result)
    assert f"{RING}: 0 mm -> 1.25 mm (1.234 mm before rounding)" in text
    assert "Limits at the rounded design:\n  stray_field <= 0.42 mT: 0.4 mT, met" in text
    assert "At the best design before rounding:\nKarush" in text
    plain = search_text(spec, replace(result, rounded=None))
    assert f"{RING}: 0 mm -> 1.234 mm\n" in plain
    assert "Limits at this design:" in plain
    assert "At this design:\nKarush" in plain


def test_a_missed_limit_is_told_once(spec):
    start = candidate(1e-3, 8.0, held=False)
    conflict = Conflict({RING: 1e-3}, 0.1, (Clash("stray_field", "<=", 4e-4, 4.4e-4, 4e-5, 0.1),))
    reason = "The search converged." + shortfall(spec, [start], conflict)
    assert "stray_field" in reason
    result = SearchResult(start, None, (start,), (None,), None, None, reason, 3.0, conflict=conflict)
    assert search_text(spec, result).count("stray_field") == 1
    assert search_plain(result)["stop_reason"] == reason


def test_a_robust_search_shows_its_design(spec):
    """Catches a yield without the dimensions that have it."""
    start, best = candidate(1e-3, 8.0), candidate(1.5e-3, 8.4)
    search = SearchResult(
        start, None, (start, best), (0, 1), best, None, "The search converged.", 3.0, optimality=Optimality(1e-5, ())
    )
    result = RobustResult(0.9, (RobustRound((), search, tolerances(), 8.4),), 0, True, 0.0, "Reached.")
    assert robust_design_text(spec, result).splitlines() == [
        "Design of round 1:",
        f"  {RING}: 1 mm -> 1.5 mm",
        "  The search converged. Karush-Kuhn-Tucker residual: 1e-05.",
    ]
    assert robust_design_text(spec, replace(result, chosen=None)) == ""


def test_an_infeasible_search_prints_its_conflict(spec):
    start = candidate(1e-3, 8.0, held=False)
    conflict = Conflict({RING: 1e-3}, 0.1, (Clash("stray_field", "<=", 4e-4, 4.4e-4, 4e-5, 0.1),))
    result = SearchResult(start, None, (start,), (None,), None, None, "It ended.", 3.0, conflict=conflict)
    assert "missed by 0.04 mT (10 %)" in search_text(spec, result)
    plain = search_plain(result)
    assert plain["status"] == "no feasible design"
    assert plain["conflict"]["clashes"][0]["missed"] == 4e-5


def test_a_front_shows_what_is_exchanged(spec):
    first, last = candidate(1e-3, 8.5), candidate(2e-3, 7.0)
    points = (
        FrontPoint(0.0, None, first, 8.5, 0.85, "front", "Done.", 1e-8, None, 5),
        FrontPoint(0.5, 0.7, None, None, None, "failed", "Nothing met the limits.", designs=4),
        FrontPoint(1.0, None, last, 7.0, 0.6, "front", "Done.", 1e-8, 4.0, 6),
    )
    result = ParetoResult(
        FORCE, Objective("total_mass", False), "epsilon constraint", first, points, (first, last), (7.0, 0.85), 0.6,
        "The front has 2 of the 3 points asked for.", 2.0,
    )  # fmt: skip
    text = pareto_text(spec, result)
    lines = [" ".join(line.split()) for line in text.splitlines()]
    assert "8.5 N/A 850 g - front ring_width 1 mm" in lines
    assert "7 N/A 600 g +0.04 N/A per 10 g front ring_width 2 mm" in lines
    assert "- - - failed Nothing met the limits." in lines
    plain = pareto_plain(result)
    assert plain["status"] == "ok"
    assert [point["standing"] for point in plain["points"]] == ["front", "failed", "front"]
    json.dumps(plain, allow_nan=False)


def test_a_front_without_conflict_names_the_figure_that_does_not_move(spec):
    """Catches the same sentence twice, and a reader who is not told why there is nothing to trade."""
    first, last = candidate(1e-3, 8.5), candidate(2e-3, 7.0)
    reason = "The objectives do not conflict: one design is the best in both, and the front is that one point."
    point = FrontPoint(0.0, None, first, 8.5, 4e-4, "front", "Done.", 1e-8, None, 5)
    result = ParetoResult(
        FORCE, Objective("stray_field", False), "epsilon constraint", first, (point,), (first, last), None, None,
        reason, 2.0, conflicting=False,
    )  # fmt: skip
    text = pareto_text(spec, result)
    assert "No variable moves stray_field: it is 0.4 mT in every design of the search." in text
    assert text.count("conflict") == 1
    assert "No variable moves force_constant" not in text


def tolerances() -> ToleranceResult:
    slip = Tolerance(YOKE, -2e-5, 5e-5, "uniform")
    sure = Interval(0.912, 0.905, 0.918)
    limit = Limit("stray_field", "<=", 4.2e-4)
    spread = FigureSpread(
        "stray_field", 4e-4, 4.01e-4, 1e-5, 3.7e-4, 4.4e-4, {YOKE: -0.4}, {YOKE: 1.0}, True, {0.5: sure}
    )
    return ToleranceResult(
        production=Production((slip,), samples=5000),
        values={YOKE: 1e-3},
        held=("actuator.back_yoke.outer_diameter",),
        nominal=Evaluation("fem", OK, (), Performance(stray_field=4e-4)),
        figures=(spread,),
        requirements=(
            Requirement(limit, 4e-4, 1.9, 0.91, sure, 0.088),
            Requirement(Limit(YOKE, ">=", 1e-4), 1e-3, math.inf, 1.0, Interval(1.0, 0.999, math.inf), 0.0),
        ),
        simulated=sure,
        examined=5000,
        effects=(ToleranceEffect(slip, 0.98, 0.068, (1.0,)),),
        rejects=(Reject("No such yoke.", 3),),
        evaluations=7,
    )


def test_a_yield_is_told_with_its_confidence_and_its_causes(spec):
    text = tolerance_text(spec, tolerances())
    assert text.startswith("Yield: 91.2 % (90.5 to 91.8 % with 95 % confidence); 5000 samples")
    assert "the mean is 1.9 standard deviations inside, without this limit the yield would gain 8.8 points" in text
    assert "the mean is inside and does not scatter" in text
    assert f"{YOKE} 1 mm +0.05 mm / -0.02 mm, uniform: half of it would gain 6.8 points" in text
    assert f"stray_field: 0.401 mT, 0.01 mT, 0.37 mT to 0.44 mT; 100 % of the variance by {YOKE}" in text
    assert "3 cannot be made, such as: No such yoke." in text


def test_a_limit_s_share_is_its_best_estimate(spec):
    """Catches the share of the linear model alone where samples computed in full have moved it."""
    found = tolerances()
    moved = replace(found.requirements[0], checked=Interval(0.8, 0.7, 0.9), shifted=Interval(0.85, 0.84, 0.86))
    text = tolerance_text(spec, replace(found, requirements=(moved,)))
    assert "stray_field <= 0.42 mT: 85 % (84 to 86 % with 95 % confidence) hold it" in text


def test_what_is_infinite_is_null_in_the_json():
    plain = finite(tolerance_plain(tolerances()))
    found = json.loads(json.dumps(plain, allow_nan=False))
    assert found["requirements"][1]["margin"] is None
    assert found["requirements"][1]["simulated"] == {"value": 1.0, "low": 0.999, "high": None}
    assert found["yield"]["value"] == 0.912
    assert found["figures"][0]["quantiles"] == {"0.5": {"value": 0.912, "low": 0.905, "high": 0.918}}
