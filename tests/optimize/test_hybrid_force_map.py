"""The force map of a design, by finite elements and by the network, and the benchmark on it."""

from dataclasses import replace

import numpy as np
import pytest
from mcfc_cases import EXAMPLE, example

from fluxbore.design.dynamics.contact_force import simulate
from fluxbore.design.errors import DesignError, SpecError
from fluxbore.design.spec import load
from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.hybrid_force_map import force_map_of, map_values


@pytest.fixture(scope="module")
def around():
    spec = load(EXAMPLE)
    return evaluate(spec.with_values(map_values(spec)))


def test_the_map_covers_the_way_and_is_the_fields(around):
    found = force_map_of(around)
    assert (found.position[0], found.position[-1]) == pytest.approx((26.45e-3, 27.5e-3))
    assert np.all(np.diff(found.position) > 0)
    assert found.mean_force_constant == pytest.approx(8.67, rel=0.01)
    assert [item.cogging_force for item in around.positions] == pytest.approx(found.cogging.tolist())
    for item in around.positions:
        force = found.force(np.array([item.position]), np.array([2.0]))[0]
        assert force == pytest.approx(2 * item.force_constant + item.cogging_force)


def test_positions_in_any_order_make_the_same_map(around):
    found = force_map_of(replace(around, positions=tuple(reversed(around.positions))))
    assert np.array_equal(found.position, force_map_of(around).position)


def test_the_network_knows_one_number():
    evaluation = evaluate(load(EXAMPLE), "network")
    found = force_map_of(evaluation)
    force = found.force(np.array([0.0, 1.0]), np.array([1.0, -2.0]))
    assert force == pytest.approx(evaluation.performance.force_constant * np.array([1.0, -2.0]))


def test_no_field_is_no_map():
    failed = evaluate(load(EXAMPLE).with_values({"solver.max_iterations": 1}))
    with pytest.raises(DesignError, match="A force map needs the design's field: At z"):
        force_map_of(failed)


def test_a_way_beyond_the_stroke_is_refused_before_anything_is_solved():
    with pytest.raises(SpecError, match=r"benchmark\.mcfc\.position, and benchmark\.mcfc\.stroke behind it"):
        map_values(example(position=0.0))


def test_the_prototype_on_its_field_is_the_papers(around):
    """One seed at the coarsest step; five seeds at the example's are in tests/full."""
    spec = example(time_step=1e-3)
    mass = around.performance.moving_mass
    figures = simulate(spec.actuator, spec.values, force_map_of(around), 1, moving_mass=mass).figures
    assert figures["median_rmse"]["P-N"] == pytest.approx(3.13, abs=0.15)
    assert figures["median_rmse"]["P-P"] == pytest.approx(2.94, abs=0.2)
    assert figures["median_rmse"]["P-E"] == pytest.approx(1.26, abs=0.2)
    assert figures["cells_lowest_P-E"] >= 34
    assert abs(figures["cells_P-P_below_P-N"] - 18) <= 2
