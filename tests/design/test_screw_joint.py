"""The joint of end cap and tube: each of its four ways to fail by hand, and that the weakest decides."""

import math
from dataclasses import replace

import pytest

from fluxbore.design.screw_joint import SCREW_YIELD, ScrewJoint, capacity, safety
from fluxbore.design.threads import SCREWS

MM = 1e-3

JOINT = ScrewJoint(SCREWS["M3"], 4, 16.1 * MM, 1.95 * MM, 4 * MM, 2.7 * MM, 276e6, 276e6)


def test_the_weakest_of_four_decides() -> None:
    """N: a thin wall bears, a hole near the edge tears out, a shallow thread bears, else the screws are sheared."""
    assert capacity(JOINT) == pytest.approx(4 * math.pi / 4 * 2.45875e-3**2 * SCREW_YIELD / 3**0.5, rel=2e-5)
    assert capacity(replace(JOINT, wall=1 * MM, edge=9 * MM)) == pytest.approx(4 * 3e-3 * 1e-3 * 276e6)
    assert capacity(replace(JOINT, edge=2 * MM)) == pytest.approx(8 * 0.3e-3 * 1.95e-3 * 276e6 / 3**0.5)
    assert capacity(replace(JOINT, depth=0.5 * MM)) == pytest.approx(4 * 3e-3 * 0.5e-3 * 276e6)


def test_the_push_is_the_pressure_on_the_bore() -> None:
    """Catches gauge taken for absolute, a radius for a diameter, and a division by no pressure."""
    assert safety(JOINT, 0.6e6) == pytest.approx(capacity(JOINT) / 122.15, rel=1e-3)
    assert safety(JOINT, 0.0) is None
    assert capacity(replace(JOINT, count=8)) == pytest.approx(2 * capacity(JOINT))
