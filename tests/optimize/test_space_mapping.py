"""Network first: whatever the network says, the mapping ends at the finite elements' optimum or says it did not."""

import math
import random

import numpy as np
import pytest
import toy

from fluxbore.design.performance import Performance
from fluxbore.design.study import Constraint, Objective, Variable
from fluxbore.optimize.archive import Archive
from fluxbore.optimize.evaluation import NOT_CONVERGED, OK, Evaluation, Norm, failure
from fluxbore.optimize.evaluator import Evaluator
from fluxbore.optimize.executor import SerialExecutor
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.problem import Merit, box, resolve_limits
from fluxbore.optimize.search import run_search
from fluxbore.optimize.space_mapping import run_mapping
from fluxbore.optimize.space_mapping_network import Coarse, network_model
from fluxbore.optimize.space_mapping_response import response
from fluxbore.optimize.space_mapping_surrogate import Sample, surrogate

X, Y = toy.X, toy.Y


class Pair:
    """A fine and a coarse model of two figures of x and y, counted.

    fine, coarse : functions of (x, y) -> (force, stray); the coarse one may leave the stray field out (None).
    """

    def __init__(self, fine, coarse, *, exact=True, fails=lambda fidelity, x, y: False):
        self.fine, self.coarse, self.exact, self.fails = fine, coarse, exact, fails
        self.calls = {"network": 0, "fem": 0}

    def __call__(self, design, fidelity="fem", gradient=()):
        self.calls[fidelity] += 1
        x, y = design.number(X), design.number(Y)
        if self.fails(fidelity, x, y):
            return failure(fidelity, NOT_CONVERGED, "No convergence.")
        model = self.fine if fidelity == "fem" else self.coarse
        force, stray = model(x, y)
        slopes = None
        if fidelity == "fem" and gradient and self.exact:
            slopes = {
                name: {X: _complex_step(self.fine, i, x, y, 0), Y: _complex_step(self.fine, i, x, y, 1)}
                for i, name in enumerate(("force_constant", "stray_field"))
            }
        performance = Performance(force_constant=force, stray_field=stray)
        return Evaluation(fidelity, OK, (), performance, gradient=slopes)


def _complex_step(function, figure, x, y, by):
    h = 1e-30
    return (function(x + 1j * h, y) if by == 0 else function(x, y + 1j * h))[figure].imag / h


def fine(x, y):
    """A hill whose top lies beyond the limit on the stray field, which bends."""
    force = 10 - (x - 1.2) ** 2 - 2 * (y - 0.9) ** 2 - 0.3 * x * y + 0.1 * x**3
    return force, 0.5 * x * x + 0.8 * y + 0.1 * x * y


def scaled(x, y):
    """20 % off in both figures."""
    force, stray = fine(x, y)
    return 0.8 * force, 1.2 * stray


def shifted(x, y):
    return fine(x + 0.3, y - 0.2)


def rotated(x, y):
    """Misaligned as in Bandler's examples: the coarse model's axes are turned and stretched."""
    return fine(1.1 * x - 0.2 * y + 0.1, 0.9 * y + 0.2 * x)


def blind(x, y):
    """A network as in life: 20 % off, unsaturated, and without a stray field."""
    return 12 - 1.3 * (x - 1.0) ** 2 - 1.5 * (y - 1.1) ** 2, None


def misleading(x, y):
    """Every slope of the objective is the opposite."""
    return 20 - fine(x, y)[0], fine(x, y)[1]


def study(x=0.2, y=0.2, limit=1.0, **options):
    return toy.spec(
        x=x,
        y=y,
        objective=Objective("force_constant", True),
        variables=(Variable(X, -2.0, 2.0), Variable(Y, -2.0, 2.0)),
        constraints=() if limit is None else (Constraint("stray_field", upper=limit),),
        **options,
    )


def setting(pair, spec, budget=60):
    """Archive, merit and held limits as a search makes them, and the start's scaled point."""
    base = spec.for_study()
    bounds = box(base, [])
    keys = tuple(bounds.keys) if pair.exact else ()
    evaluator = Evaluator(base, SerialExecutor(), None, "fem", pair, "search", keys)
    limits = resolve_limits(base, pair(base))
    archive = Archive(evaluator, bounds, spec.study.objective, limits, budget)
    start = bounds.point({key: base.number(key) for key in bounds.keys})
    return archive, Merit(spec.study.objective, 10.0), limits, network_model(archive, base, pair), start


def mapped(pair, spec=None, budget=60, tolerance=1e-9):
    archive, merit, held, network, start = setting(pair, spec or study(), budget)
    return archive, run_mapping(archive, merit, held, network, start, tolerance, tolerance / 10)


def optimum(limit=1.0):
    """The best force on the limit, by golden sections along it: y follows from x in closed form."""

    def force(x):
        return fine(x, (limit - 0.5 * x * x) / (0.8 + 0.1 * x))[0]

    low, high, golden = -0.5, 1.5, (math.sqrt(5) - 1) / 2
    while high - low > 1e-10:
        one, other = high - golden * (high - low), low + golden * (high - low)
        low, high = (low, other) if force(one) > force(other) else (one, high)
    return force(low)


NETWORKS = {"scaled": scaled, "shifted": shifted, "rotated": rotated, "blind": blind, "misleading": misleading}
STARTS = [(0.2, 0.2), (-1.5, 1.8), (1.9, -1.9)]


@pytest.mark.parametrize("network", NETWORKS)
@pytest.mark.parametrize("start", STARTS)
def test_it_ends_at_the_fine_optimum_whatever_the_network(network, start):
    """Catches an answer that is the network's: it is 20 % off, shifted, turned, blind to the limit or contrary."""
    pair = Pair(fine, NETWORKS[network])
    archive, result = mapped(pair, study(*start))
    assert result.converged
    assert result.exact
    assert archive.best.objective == pytest.approx(optimum(), abs=1e-6)
    assert archive.best.checks[0].satisfied
    assert archive.best.checks[0].active
    assert result.residual < 1e-4
    assert result.fem_designs == len(archive.history) == pair.calls["fem"] - 1  # the start's limits are asked for first
    assert result.network_calls == pair.calls["network"]
    assert result.fem_designs <= 10


@pytest.mark.parametrize("network", NETWORKS)
@pytest.mark.parametrize("start", STARTS[:2])
def test_without_slopes_it_measures_them_or_says_that_it_did_not_arrive(network, start):
    """Catches a claim of convergence by slopes that are only guessed."""
    archive, result = mapped(Pair(fine, NETWORKS[network], exact=False), study(*start), tolerance=1e-5)
    assert not result.exact
    assert "estimated slopes" in result.reason
    assert archive.best.checks[0].satisfied
    if result.converged:
        assert archive.best.objective == pytest.approx(optimum(), abs=3e-4)
    else:
        assert result.reason.startswith(("The mapping stopped", "The mapping ended where", "The mapping used up"))
    # A network that is right up to a factor leaves nothing to be measured but that it is.
    if network == "scaled":
        assert result.converged
        assert result.fem_designs <= 6


def test_the_network_spares_designs():
    """Catches a surrogate that ignores the network: without one the same steps must find the bends by themselves."""
    seldom, often = (mapped(Pair(fine, network), study(-1.5, 1.8))[1] for network in (scaled, silent))
    assert seldom.converged
    assert often.converged
    assert often.network_calls > 0
    assert seldom.fem_designs < often.fem_designs


def silent(x, y):
    raise ZeroDivisionError("no network")


def test_an_optimum_inside_the_limits():
    archive, result = mapped(Pair(fine, shifted), study(limit=None))
    assert result.converged
    # The gradient vanishes: x from the cubic's derivative with y = 0.9 - 0.075 x put in.
    roots = np.roots([0.3, -2 + 0.0225, 2.4 - 0.27])
    best = max(fine(x, 0.9 - 0.075 * x)[0] for x in roots[np.abs(roots) <= 2])
    assert archive.best.objective == pytest.approx(best, abs=1e-6)


def test_limits_that_cannot_be_met_are_said_to_be_missed():
    _, result = mapped(Pair(fine, scaled), study(limit=-5.0))
    assert not result.converged
    assert "no step brings the limits nearer: the worst is missed by" in result.reason


@pytest.mark.parametrize("budget", [1, 2, 3])
def test_a_used_up_budget_is_an_ending(budget):
    archive, result = mapped(Pair(fine, blind), budget=budget)
    assert len(archive.history) == budget
    assert not result.converged
    assert result.reason.startswith("The mapping used up its budget of FEM designs; KKT residual ")
    assert f"{budget} FEM designs and " in result.reason


@pytest.mark.parametrize("exact", [True, False])
@pytest.mark.parametrize("routes", [("fem",), ("fem", "network")])
def test_designs_that_fail_cost_themselves_only(exact, routes):
    """The optimum lies beyond what can be computed: the best is next to the edge, and not called an optimum."""
    pair = Pair(fine, blind, exact=exact, fails=lambda fidelity, x, y: fidelity in routes and x > 0.6)
    archive, result = mapped(pair, study(-0.5, 0.2), tolerance=1e-6)
    assert any(not made.evaluation.ok for made in archive.history) == ("network" not in routes)
    assert archive.best.values[X] <= 0.6
    edge = fine(0.6, (1.0 - 0.5 * 0.36) / 0.86)[0]
    assert archive.best.objective == pytest.approx(edge, abs=2e-2)
    assert not result.converged


@pytest.mark.parametrize("seed", range(4))
def test_designs_that_fail_on_the_way_do_not_keep_it_from_the_optimum(seed):
    """A third of all points fails, scattered at random and always the same ones."""

    def fails(fidelity, x, y):
        return fidelity == "fem" and (x, y) != (0.2, 0.2) and random.Random(f"{seed} {x!r} {y!r}").random() < 1 / 3

    archive, result = mapped(Pair(fine, blind, fails=fails), tolerance=1e-6)
    assert any(not made.evaluation.ok for made in archive.history)
    assert archive.best.objective == pytest.approx(optimum(), abs=1e-5)
    assert result.converged


def test_a_start_that_fails_is_an_ending():
    _, result = mapped_from_failing_start()
    assert not result.converged
    assert result.residual is None
    assert result.reason.startswith("The mapping could not begin")


def mapped_from_failing_start():
    pair = Pair(fine, blind)
    archive, merit, held, network, start = setting(pair, study())
    pair.fails = lambda fidelity, x, y: True
    return archive, run_mapping(archive, merit, held, network, start, 1e-6)


def test_an_interruption_passes_through_nlopt():
    """Catches Ctrl-C that is lost in a call of the network from NLopt's C code."""
    archive, merit, held, network, start = setting(Pair(fine, blind), study())
    calls = []

    def interrupted(point):
        calls.append(point)
        if len(calls) == 12:
            raise KeyboardInterrupt
        return network(point)

    with pytest.raises(KeyboardInterrupt):
        run_mapping(archive, merit, held, interrupted, start, 1e-6)
    assert len(archive.history) == 1


def test_it_replays():
    """Catches a step that depends on anything but what the designs say."""
    first, second = (mapped(Pair(fine, rotated), study(1.9, -1.9)) for _ in range(2))
    assert [made.values for made in first[0].history] == [made.values for made in second[0].history]
    assert first[1] == second[1]


def test_designs_known_beforehand_are_used():
    pair = Pair(fine, blind)
    archive, merit, held, network, start = setting(pair, study())
    run_mapping(archive, merit, held, network, start, 1e-9, 1e-9)
    again = run_mapping(archive, merit, held, network, archive.box.point(archive.best.values), 1e-9, 1e-9)
    assert again.converged
    assert again.fem_designs <= 1
    assert run_mapping(archive, merit, held, network, start, 1e-6, 1e-9).reason.startswith("The mapping converged: ")


def surrogate_of(pair, points):
    archive, merit, held, network, _ = setting(pair, study())
    coarse = Coarse(network, merit, held, archive.box)
    samples = []
    for point in points:
        fine_response = response(archive.at(point), merit, held, archive.box)
        samples.append(Sample(np.array(point), fine_response, coarse.with_slopes(np.array(point))))
    return surrogate(coarse, samples, samples[0], samples[0].fine.slopes), samples


@pytest.mark.parametrize("network", NETWORKS)
def test_values_and_slopes_agree_at_the_iterate(network):
    """And, but for the network's own bending there, the slopes at the nearest other design."""
    model, samples = surrogate_of(Pair(fine, NETWORKS[network]), [(0.4, 0.6), (0.5, 0.5), (0.9, 0.1)])
    here = samples[0]
    assert model.at(here.x) == pytest.approx(here.fine.values, abs=1e-12)
    assert model.slopes_at(here.x) == pytest.approx(here.fine.slopes, abs=1e-12)
    assert model.slopes_at(samples[1].x) == pytest.approx(samples[1].fine.slopes, abs=1e-9)


def test_the_network_counts_for_what_the_finite_elements_confirm():
    points = [(0.4, 0.6), (0.5, 0.5), (0.3, 0.8)]
    assert surrogate_of(Pair(fine, scaled), points)[0].a == pytest.approx([1 / 0.8, 1 / 1.2], rel=1e-5)
    assert surrogate_of(Pair(fine, fine), points)[0].a == pytest.approx([1.0, 1.0], rel=1e-5)
    assert surrogate_of(Pair(fine, misleading), points)[0].a[0] == 0.0
    assert surrogate_of(Pair(fine, blind), points)[0].a[1] == 0.0


def test_a_norm_lends_its_slope_to_the_maximum():
    archive, merit, held, _, _ = setting(Pair(fine, blind), study())
    slopes = {"force_constant": {X: 1.0, Y: 2.0}, "stray_field": {X: 0.1, Y: -0.2}}
    norms = {"stray_field": Norm(8.0, 0.5)}
    performance = Performance(force_constant=9.0, stray_field=0.6)
    made = Evaluation("fem", OK, (), performance, gradient=slopes, norms=norms)
    found = response(archive.adopt({X: 0.0, Y: 0.0}, made, False), merit, held, archive.box)
    assert found.values == pytest.approx([-0.9, -0.4])
    assert found.slopes[0] == pytest.approx([-0.4, -0.8])
    assert found.slopes[1] == pytest.approx([0.1 * 4 * 1.2, -0.2 * 4 * 1.2])


def test_a_search_with_it_replays_over_its_journal(tmp_path, monkeypatch):
    """Catches a study's `network = "manifold"` that is not heard, and a proposal that depends on what is remembered."""
    monkeypatch.setenv("TOY_LOG", str(tmp_path / "trace"))
    spec = toy.actuator_study(network="manifold")
    with Journal(tmp_path / "j") as journal:
        first = run_search(spec, journal, SerialExecutor(), None, toy.actuator_like)
    calls = (tmp_path / "trace").read_text().splitlines()
    with Journal(tmp_path / "j") as journal:
        second = run_search(spec, journal, SerialExecutor(), None, toy.actuator_like)
    assert first.stop_reason.startswith("The mapping converged: ")
    assert [made.values for made in second.history] == [made.values for made in first.history]
    assert second.stop_reason == first.stop_reason
    assert second.reused == len(second.history)
    assert len((tmp_path / "trace").read_text().splitlines()) == 2 * len(calls) - len(first.history)
    plain = run_search(
        toy.actuator_study(max_evaluations=400, relative_tolerance=1e-8),
        None,
        SerialExecutor(),
        None,
        toy.actuator_like,
    )
    assert first.best.objective == pytest.approx(plain.best.objective, rel=2e-4)
