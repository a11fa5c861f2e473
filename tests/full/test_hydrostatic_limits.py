"""Every key of an electro-hydrostatic actuator at its limits, in closed form and simulated (-m full)."""

import os
import random
import sys
from collections import Counter
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))

from hydrostatic_limits import cases, outcome

pytestmark = pytest.mark.full

SHARE = float(os.environ.get("FLUXBORE_SAMPLE", "1"))
"""Continuous integration takes a twentieth."""


def test_every_limit_has_figures_or_a_reason() -> None:
    """And most single limits leave a design that can be evaluated by both routes."""
    every = list(cases())
    drawn = random.Random(1).sample(every, max(round(SHARE * len(every)), 10))
    found: Counter[str] = Counter()
    for case in drawn:
        found.update(outcome(*case, "network", "fem").values())
    assert found["ok"] > found.total() / 4
