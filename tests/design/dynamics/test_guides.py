"""The guides' friction step by step, against the bristles over whole records and against energy."""

import numpy as np
import pytest

from fluxbore.design.bristle import Bristle, bristle_force, bristle_record
from fluxbore.design.dynamics.guides import Guides, rubbing_of
from fluxbore.design.errors import DesignError
from fluxbore.design.friction import SealFriction

GUIDES = Guides(0.85, 85e3, 30.0)
STEP = 1e-4
TIME = STEP * np.arange(4001)
POSITION = 2e-4 * np.sin(30 * TIME) + 3e-5 * np.sin(170 * TIME)


def rubbed(guides, position, velocity):
    step = rubbing_of(guides)
    moves = np.diff(position)
    return np.array([step(moved, v) for moved, v in zip(moves.tolist(), velocity.tolist(), strict=True)])


def test_it_is_the_bristles_of_a_constant_level():
    """The one law, written twice: over records for seals that pressure presses, and one number at a time."""
    law = SealFriction(1.0, 1.0, GUIDES.level, 1.0, 0.0)
    bristle = Bristle(law, 0.0, GUIDES.stiffness, GUIDES.damping)
    velocity = np.diff(POSITION) / STEP
    deflection = bristle_record(bristle, velocity, 0.0, STEP).deflection
    expected = bristle_force(bristle, deflection[1:], velocity, 0.0)
    assert np.ptp(expected) > 1.5
    assert rubbed(GUIDES, POSITION, velocity) == pytest.approx(expected, rel=1e-9, abs=1e-12)


def test_sliding_takes_the_level_either_way():
    for sense in (1.0, -1.0):
        way = sense * np.linspace(0.0, 1e-3, 101)
        assert rubbed(GUIDES, way, np.full(100, sense * 0.1))[-1] == pytest.approx(sense * GUIDES.level, rel=1e-9)


def test_a_rest_keeps_the_force():
    step = rubbing_of(Guides(0.85, 85e3))
    pushed = step(3e-6, 0.0)
    assert 0 < pushed < 3e-6 * 85e3
    assert step(0.0, 0.0) == pushed


def test_no_level_is_no_friction():
    assert rubbing_of(Guides())(1.0, 1.0) == 0.0


@pytest.mark.parametrize("values", [(-1.0, 1.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, -1.0)])
def test_values_that_no_guides_have_are_told(values):
    with pytest.raises(DesignError, match="of the guides must be finite and"):
        Guides(*values)
