"""Springs one displacement at a time, against the same laws over whole records."""

import numpy as np
import pytest

from fluxbore.design.dynamics.bouc_wen import BoucWen
from fluxbore.design.dynamics.magnetic_hysteresis import HysteresisSpring, force_record
from fluxbore.design.dynamics.magnetic_spring import LinearSpring, PolynomialSpring, SineSpring
from fluxbore.design.dynamics.stepped_spring import initial_stiffness, stepped

TIME = np.linspace(0.0, 1.0, 700)
WAY = 7e-4 * np.sin(11 * TIME) + 2e-4 * np.sin(53 * TIME)
SINE = SineSpring(192.0, 8.185e-4)
CUBIC = PolynomialSpring((2.2e5, -4e10))


@pytest.mark.parametrize(
    "spring",
    [
        HysteresisSpring(SINE, 0.96),
        HysteresisSpring(SINE, 0.5, BoucWen(1.0, 2000.0, -500.0)),
        HysteresisSpring(CUBIC, 0.9, BoucWen(1.0, 1e5, 5e4, 1.5)),
    ],
)
def test_a_spring_with_memory_is_the_record(spring):
    """Both senses and both signs of x_s: the way that is written out and the one that is not."""
    step = stepped(spring)
    assert step(0.0) == 0.0
    found = np.array([step(x) for x in WAY.tolist()])
    assert found == pytest.approx(force_record(spring, WAY), rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("law", [SINE, CUBIC, LinearSpring(2.2e5)])
def test_a_law_without_memory_is_itself(law):
    step = stepped(law)
    assert np.array([step(x) for x in WAY.tolist()]) == pytest.approx(law.force(WAY), rel=1e-12)


def test_each_run_has_a_memory_of_its_own():
    spring = HysteresisSpring(SINE, 0.5)
    first = stepped(spring)
    loaded = first(5e-4)
    first(-5e-4)
    assert stepped(spring)(5e-4) == loaded
    assert first(5e-4) != loaded


def test_stiffness_at_rest():
    assert initial_stiffness(HysteresisSpring(SINE, 0.96)) == pytest.approx(192.0 / 8.185e-4)
    assert initial_stiffness(CUBIC) == pytest.approx(2.2e5)
