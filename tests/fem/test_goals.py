"""Goals: their values are the figures, their gradients the figures' derivatives, their scales never nothing."""

import sys
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases import air_coils
from manufactured import solved_levels

from fluxbore.fem.adapt import Goal
from fluxbore.fem.energy import energies
from fluxbore.fem.goals import EnergyGoal, ForceGoal, LinkageGoal, PointGoal
from fluxbore.fem.linkage import flux_linkages
from fluxbore.fem.magnetostatics import Solution


@cache
def coils() -> Solution:
    return solved_levels(air_coils.two_coils().model, 1)[0]


GOALS: list[Goal] = [
    LinkageGoal("lower", 0),
    LinkageGoal("upper", 1),
    ForceGoal("force", (0,), "z"),
    PointGoal("beside", (0.03, 0.02)),
    PointGoal("on the axis", (0.0, 0.02)),
]


@pytest.mark.parametrize("goal", GOALS, ids=lambda goal: goal.name)
def test_gradient_is_the_derivative(goal: Goal) -> None:
    """Catches an adjoint of another figure. B's direction at a point is held, which is exact to first order."""
    solution = coils()
    direction = np.random.default_rng(1).normal(size=solution.psi.size) * solution.psi
    step = 1e-5
    up, down = (goal.measure(replace(solution, psi=solution.psi + k * step * direction)).value for k in (1, -1))
    gradient = goal.measure(solution).gradient
    assert gradient is not None
    assert gradient @ direction == pytest.approx((up - down) / (2 * step), rel=1e-4)


def test_values() -> None:
    """Catches a goal that is not what is reported."""
    solution = coils()
    assert EnergyGoal().measure(solution).value == energies(solution)[0]
    assert EnergyGoal().measure(solution).gradient is None
    for index in (0, 1):
        found = LinkageGoal("", index).measure(solution).value
        assert found == pytest.approx(float(flux_linkages(solution)[index]), rel=1e-12)


@pytest.mark.parametrize("goal", [*GOALS, EnergyGoal()], ids=lambda goal: goal.name)
def test_scales(goal: Goal) -> None:
    """Catches an error held against nothing, or a goal without a field that never ends."""
    assert goal.measure(coils()).scale > 0
    still = replace(coils(), psi=np.zeros_like(coils().psi))
    measure = goal.measure(still)
    assert measure.value == 0
    assert np.isfinite(measure.scale)


def test_field_across_itself_is_nothing() -> None:
    """Catches the component across taken along."""
    found = PointGoal("", (0.03, 0.02), across=True).measure(coils())
    assert abs(found.value) < 1e-12 * found.scale
    assert found.scale == pytest.approx(abs(PointGoal("", (0.03, 0.02)).measure(coils()).value))
