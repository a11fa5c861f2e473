"""The tolerance analysis against productions whose yield, mean and variance are known exactly."""

import csv
import io
import math
from dataclasses import replace

import pytest
import tolerance_toy as models
import toy
from tolerance_toy import normal_share, production
from toy import X, Y

from fluxbore.design.errors import DesignError, SpecError
from fluxbore.design.study import Constraint, Objective, Tolerance
from fluxbore.optimize.evaluation import Norm
from fluxbore.optimize.executor import SerialExecutor, local_executor
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.outcome import Limit
from fluxbore.optimize.tolerance import run_tolerance
from fluxbore.optimize.tolerance_table import HEADER, tolerance_table


def study(made, *, x=1.0, y=1.0, limits=(), objective="force_constant"):
    goal = Objective(objective, True) if objective else None
    return toy.spec(x=x, y=y, objective=goal, constraints=tuple(limits), production=made)


def analyse(spec, model=models.linear, journal=None, progress=None, executor=None, **options):
    return run_tolerance(spec, journal, executor or SerialExecutor(), progress, model, **options)


def plain(result):
    """The result without what differs from run to run."""
    return replace(result, seconds=0.0, reused=0)


def test_first_order_of_a_linear_model_is_exact():
    """A share that does not belong to its tolerance, a variance that adds up wrongly, a worst case on the wrong side.

    Sigma of x 0.1, of y 0.2: that of the force is sqrt(0.3^2 + 0.2^2).
    """
    result = analyse(study(production(0.3, 0.6)))
    force = result.figure("force_constant")
    assert (force.nominal, force.mean) == (12.0, pytest.approx(12.0))
    assert force.sigma == pytest.approx(math.sqrt(0.13))
    assert (force.worst_low, force.worst_high) == (pytest.approx(12 - 1.5), pytest.approx(12 + 1.5))
    assert force.shares == {X: pytest.approx(9 / 13), Y: pytest.approx(4 / 13)}
    assert force.exact
    assert [item.subject for item in result.figures] == ["force_constant", "stray_field"]


def test_asymmetric_limits_move_the_mean():
    result = analyse(study(production((0.0, 0.6), (-0.3, 0.0))))
    force = result.figure("force_constant")
    assert force.mean == pytest.approx(12 + 3 * 0.3 + 0.15)
    assert force.sigma == pytest.approx(math.hypot(3 * 0.1, 0.05))
    assert (force.worst_low, force.worst_high) == (pytest.approx(12.0), pytest.approx(12 + 1.8 + 0.3))


def test_the_yield_of_normal_scatter_is_phi_of_the_margin():
    """Stray field 3 +- sqrt(0.2^2 + 0.2^2); the limit is 1.5 standard deviations off."""
    sigma = math.hypot(0.2, 0.2)
    spec = study(production(0.3, 0.6), limits=[Constraint("stray_field", upper=3 + 1.5 * sigma)])
    result = analyse(spec)
    [held] = result.requirements
    assert held.margin == pytest.approx(1.5)
    assert held.expected == pytest.approx(normal_share(1.5), abs=1e-8)  # the search's own slack
    assert held.simulated.low <= normal_share(1.5) <= held.simulated.high
    assert held.simulated == result.simulated
    assert held.cost == pytest.approx(1 - result.simulated.value)


def test_uniform_scatter_yields_as_irwin_and_hall_say():
    """x and y of +-0.5: the stray field 2 x + y is a trapezium about 3, of which 1/16 is above 4."""
    spec = study(production(0.5, 0.5, distribution="uniform"), limits=[Constraint("stray_field", upper=4.0)])
    [held] = analyse(spec).requirements
    assert held.expected == pytest.approx(15 / 16, abs=1e-4)
    assert held.simulated.low <= 15 / 16 <= held.simulated.high


def test_limits_to_both_sides_and_on_keys_count_together():
    """Independent x and y, two limits on each of them: the joint yield is the product."""
    limits = [Constraint(X, upper=1.1, lower=0.9), Constraint(Y, lower=0.8)]
    result = analyse(study(production(0.3, 0.6), limits=limits))
    assert [(item.limit.subject, item.limit.sense) for item in result.requirements] == [(X, ">="), (X, "<="), (Y, ">=")]
    assert [item.margin for item in result.requirements] == pytest.approx([1.0, 1.0, 1.0])
    joint = (2 * normal_share(1) - 1) * normal_share(1)
    assert result.simulated.low <= joint <= result.simulated.high


def test_the_simulated_yield_covers_the_truth_over_200_seeds():
    """An interval of the wrong count, or samples that are not independent."""
    truth = (2 * normal_share(1) - 1) * normal_share(1)
    limits = [Constraint(X, upper=1.1, lower=0.9), Constraint(Y, lower=0.8)]
    covered = 0
    for seed in range(200):
        made = analyse(study(production(0.3, 0.6, samples=100, seed=seed), limits=limits)).simulated
        covered += made.low <= truth <= made.high
    assert covered >= 180


def test_start_is_the_nominal_design_unless_limits_are_given():
    spec = study(production(0.3), limits=[Constraint("stray_field", upper=1.0, relative_to_start=True)])
    assert analyse(spec).requirements[0].expected == pytest.approx(0.5)
    given = analyse(spec, limits=[Limit("stray_field", "<=", 3.2)])
    assert given.requirements[0].expected == pytest.approx(normal_share(1.0))


def test_the_tolerance_that_hurts_most_comes_first():
    """Halving y, which has no part in the limit on x, buys nothing; halving x turns 1 sigma into 2."""
    result = analyse(study(production(0.3, 0.6, samples=20_000), limits=[Constraint(X, upper=1.1)]))
    first, second = result.effects
    assert (first.tolerance.key, second.tolerance.key) == (X, Y)
    assert first.halved == pytest.approx(normal_share(2.0), abs=0.006)
    assert first.gain == pytest.approx(first.halved - result.simulated.value)
    assert (first.shares, second.shares) == ((1.0,), (0.0,))
    assert second.gain == 0.0


def test_a_maximum_scatters_with_its_norm():
    """The norm of 2 and 1 rises by dx/norm-ish; the maximum by the same share of itself."""
    result = analyse(
        study(production(0.3), x=2.0, limits=[Constraint("stray_field", upper=2.3)], objective=None), models.largest
    )
    spread = result.figure("stray_field")
    norm = ((2**8 + 1) / 2) ** 0.125
    assert spread.nominal == 2.0
    assert spread.slopes[X] == pytest.approx(norm**-7 * 2**7 / 2 * 2 / norm)
    assert spread.slopes[X] == pytest.approx(1.0, abs=0.005)


@pytest.mark.parametrize(("offset", "norm"), [(-5.0, 2.0), (0.0, 0.0), (0.0, -2.0)])
def test_a_norm_never_turns_a_slope_round(offset, norm):
    """A maximum below zero, or a norm that is not above it: no common share, so that the figure itself is differenced.

    The model is max(x, y) + offset about x = 2, y = 1, and rises with x at the rate 1 whatever its norm is.
    """

    def model(design, fidelity="fem", gradient=()):
        made = models.largest(design, fidelity, gradient)
        figures = replace(made.performance, stray_field=made.performance.stray_field + offset)
        return replace(made, performance=figures, norms={"stray_field": Norm(8, norm)})

    limits = [Constraint("stray_field", upper=2.3)]
    spread = analyse(study(production(0.3), x=2.0, limits=limits, objective=None), model).figure("stray_field")
    assert spread.slopes[X] == pytest.approx(1.0)
    assert not spread.exact


def test_a_model_without_derivatives_is_differenced():
    """Said in a warning, five evaluations in place of one, and for a linear model the same numbers."""
    spec = study(production(0.3, 0.6), limits=[Constraint("stray_field", upper=3.4)])
    rough, exact = analyse(spec, models.without_slopes), analyse(spec)
    assert (rough.evaluations, exact.evaluations) == (5, 1)
    assert rough.figure("stray_field").slopes == {X: pytest.approx(2.0), Y: pytest.approx(1.0)}
    assert not rough.figure("stray_field").exact
    assert any("central differences" in text for text in rough.warnings)
    assert not any("central differences" in text for text in exact.warnings)
    assert rough.simulated.value == pytest.approx(exact.simulated.value)


def test_checks_find_the_bias_of_a_curved_figure():
    """The mean of 10 + x + x^2/2 about x = 0 is 10 + sigma^2/2, which the linear model puts at 10."""
    sigma = 0.5
    result = analyse(study(production(3 * sigma, checks=400), x=0.0), models.curved)
    force = result.figure("force_constant")
    assert force.mean == 10.0
    assert force.checked.mean.low <= 10 + sigma**2 / 2 <= force.checked.mean.high
    assert force.checked.mean.low > 10
    assert force.checked.error == pytest.approx(math.sqrt(3) * sigma**2 / 2, rel=0.3)
    assert any("linear model of force_constant is not good enough" in text for text in result.warnings)


def test_checks_of_a_linear_model_change_nothing():
    result = analyse(study(production(0.3, 0.6, checks=60), limits=[Constraint("stray_field", upper=3.4)]))
    assert result.checked.value == result.simulated.value
    assert result.checked.low < result.simulated.value < result.checked.high
    assert result.figure("stray_field").checked.error == pytest.approx(0.0, abs=1e-12)
    assert result.warnings == ()


def test_checked_yields_of_a_curved_figure_cover_the_truth():
    """Force at most 10.2: the linear model says x <= 0.2, the truth is x between -1 -+ sqrt(1.4)."""
    sigma, limit = 0.5, Constraint("force_constant", upper=10.2)
    high, low = -1 + math.sqrt(1.4), -1 - math.sqrt(1.4)
    truth = normal_share(high / sigma) - normal_share(low / sigma)
    covered = 0
    for seed in range(40):
        spec = study(production(3 * sigma, checks=50, samples=500, seed=seed), x=0.0, limits=[limit])
        made = analyse(spec, models.curved).checked
        covered += made.low <= truth <= made.high
    assert covered >= 37


def test_a_small_error_moves_the_yield_of_the_linear_model():
    """Force at most 10.15 about x = 0 with sigma 0.1: eight checks of a model near it tell what none can count.

    The truth is x between -1 -+ sqrt(1.3); the linear model has x <= 0.15.
    """
    limit, sigma = Constraint("force_constant", upper=10.15), 0.1
    truth = normal_share((-1 + math.sqrt(1.3)) / sigma)
    covered, widths = 0, []
    for seed in range(40):
        spec = study(production(3 * sigma, checks=8, samples=1000, seed=seed), x=0.0, limits=[limit])
        result = analyse(spec, models.curved)
        assert result.best_estimate == result.shifted == result.requirements[0].best_estimate
        widths.append([item.high - item.low for item in (result.shifted, result.checked)])
        covered += result.shifted.low <= truth <= result.shifted.high
    assert covered >= 35
    shifted, checked = (sum(column) for column in zip(*widths, strict=True))
    assert shifted < 0.5 * checked


def test_a_failed_check_leaves_the_counted_yield():
    failed = analyse(study(production(0.3, checks=300), limits=[Constraint("stray_field", upper=9.0)]), models.fragile)
    assert failed.shifted is None
    assert failed.best_estimate == failed.checked


def test_a_figure_whose_error_is_a_parabola_is_known_exactly_where_it_was_computed():
    """10 + x + x^2/2 with sigma 0.5: the linear model misses it by 0.4 sigma, the parabola by nothing."""
    limit, sigma = Constraint("force_constant", upper=10.5), 0.5
    truth = normal_share((-1 + math.sqrt(2)) / sigma) - normal_share((-1 - math.sqrt(2)) / sigma)
    result = analyse(study(production(3 * sigma, checks=20), x=0.0, limits=[limit]), models.curved)
    assert any("not good enough" in text for text in result.warnings)
    assert result.shifted.low <= truth <= result.shifted.high
    assert abs(result.shifted.value - truth) < 0.02 < abs(result.simulated.value - truth)


def test_without_checks_the_reader_is_told():
    assert "not checked" in analyse(study(production(0.3))).warnings[-1]


def test_what_cannot_be_built_is_a_reject_with_its_reason():
    """Beyond x = y = 9 no toy can be built: about (9.1, 9.1) that is the share Phi(1)^2."""
    result = analyse(study(production(0.3, 0.3, samples=2000), x=8.9, y=9.1))
    share = normal_share(-1) * normal_share(1)
    [reject] = result.rejects
    assert "must not exceed 9 m" in reject.reason
    assert reject.count == 2000 - round(result.simulated.value * 2000)
    assert result.simulated.low <= 1 - share <= result.simulated.high


def test_two_tolerances_that_decide_together_are_tried_again_in_every_sample():
    """No toy has x and y above 9. Nearer x = 8.9 fewer are, nearer y = 9.1 more: half of y's tolerance does harm."""
    result = analyse(study(production(0.3, 0.3, samples=4000), x=8.9, y=9.1))
    found = {item.tolerance.key: item for item in result.effects}
    assert found[X].halved == pytest.approx(1 - normal_share(-2) * normal_share(1), abs=0.01)
    assert found[Y].halved == pytest.approx(1 - normal_share(-1) * normal_share(2), abs=0.01)
    assert found[Y].gain < 0 < found[X].gain


def test_samples_whose_field_fails_are_rejects_of_the_checks():
    """Two standard deviations above x = 1 nothing converges; the linear model does not know that."""
    result = analyse(study(production(0.3, checks=300), limits=[Constraint("stray_field", upper=9.0)]), models.fragile)
    [failed] = result.failures
    assert failed.reason.startswith("No convergence at x = 1.")
    assert result.simulated.value == 1.0
    assert result.direct.value == 1 - failed.count / 300
    assert result.checked.low <= normal_share(2) <= result.checked.high
    assert result.figure("stray_field").checked.count == 300 - failed.count


def test_a_nominal_design_beyond_a_limit_is_said():
    result = analyse(study(production(0.3), limits=[Constraint("stray_field", upper=2.9)]))
    assert result.warnings[0].startswith("The nominal design itself misses stray_field <= 2.9 T")
    assert result.requirements[0].margin == pytest.approx(-0.5)


def test_a_limit_on_what_does_not_scatter_is_met_or_missed_whole():
    limits = [Constraint(Y, lower=0.9), Constraint(Y, upper=0.5)]
    met, missed = analyse(study(production(0.3), limits=limits)).requirements
    assert (met.margin, met.expected, met.simulated.value) == (math.inf, 1.0, 1.0)
    assert (missed.margin, missed.expected, missed.simulated.value) == (-math.inf, 0.0, 0.0)


def test_the_same_seed_gives_the_same_result(tmp_path, monkeypatch):
    """And neither workers nor a journal change it."""
    spec = study(production(0.3, 0.6, checks=12), limits=[Constraint("stray_field", upper=3.4)])
    with Journal(tmp_path / "j") as journal, local_executor(2) as executor:
        apart = analyse(spec, journal=journal, executor=executor)
    assert plain(apart) == plain(analyse(spec))
    other = replace(spec, study=replace(spec.study, production=production(0.3, 0.6, checks=12, seed=2)))
    assert plain(analyse(other)) != plain(apart)


def test_a_killed_analysis_goes_on(tmp_path, monkeypatch):
    """A check computed twice, or one that differs from the first run's."""
    monkeypatch.setenv("TOY_LOG", str(tmp_path / "trace"))
    spec = study(production(0.3, 0.6, checks=10), limits=[Constraint("stray_field", upper=3.4)])
    with Journal(tmp_path / "j") as journal, pytest.raises(models.Interrupted):
        analyse(spec, journal=journal, progress=models.interrupting(5))
    with Journal(tmp_path / "j") as journal:
        result = analyse(spec, journal=journal)
    computed = (tmp_path / "trace").read_text().splitlines()
    assert len(computed) == len(set(computed)) == 11
    assert (result.evaluations, result.reused) == (11, 5)
    assert plain(result) == plain(analyse(spec))


def test_what_is_asked_wrongly_is_one_sentence():
    with pytest.raises(SpecError, match=r"study\.production must be given"):
        analyse(toy.spec())
    counts = replace(production(0.3), tolerances=(Tolerance(toy.N, -1.0, 1.0),))
    with pytest.raises(SpecError, match=r"must name a continuous quantity; got actuator\.n"):
        analyse(study(counts))
    with pytest.raises(DesignError, match=r"No convergence at x = 1\.3"):
        analyse(study(production(0.3), x=1.3), models.fragile)
    with pytest.raises(DesignError, match="total_mass of the design is not known"):
        analyse(study(production(0.3), limits=[Constraint("total_mass", upper=1.0)]))


def test_the_table_holds_every_number():
    """A column that was shifted, or a number that was cut."""
    limits = [Constraint("stray_field", upper=3.4), Constraint(X, lower=0.8)]
    result = analyse(study(production(0.3, 0.6, checks=5), limits=limits))
    text = tolerance_table(result)
    rows = list(csv.DictReader(io.StringIO(text)))
    assert text.splitlines()[0] == ",".join(HEADER)
    assert all(None not in row and None not in row.values() for row in rows)

    def cell(part, subject="", key="", quantity=""):
        found = [row for row in rows if (row["part"], row["subject"], row["key"]) == (part, subject, key)]
        return next(row for row in found if row["quantity"] == quantity)

    whole = cell("yield", quantity="simulated")
    assert [float(whole[end]) for end in ("value", "low", "high")] == [
        result.simulated.value,
        result.simulated.low,
        result.simulated.high,
    ]
    assert float(cell("limit", "stray_field <=", quantity="expected yield")["value"]) == result.requirements[0].expected
    assert float(cell("tolerance", key=X, quantity="plus")["value"]) == 0.3
    assert float(cell("figure", "stray_field", X, "share of variance")["value"]) == pytest.approx(0.5)
