"""The weights of a force: one on the body, zero on what else is magnetic, and what touches what."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases.drawing import Drawing
from manufactured import solved_levels

from fluxbore.fem.mesh import Floats
from fluxbore.fem.problem import Problem
from fluxbore.fem.weight import Weight, layer_weight, smooth_weight


def problem(touching: bool = False, axisymmetric: bool = False) -> Problem:
    """Region 0 iron, 1 iron above it, 2 air; in a box, with the first on its lower edge or on the axis."""
    drawing = Drawing(axisymmetric)
    wall = drawing.boundary("A=0")
    drawing.rectangle((0, 40), (0, 40), wall)
    drawing.rectangle((0 if axisymmetric else 10, 15), (8, 14))
    drawing.rectangle((8, 18), (14 if touching else 20, 26))
    iron = drawing.material("Iron", mu=100)
    drawing.label(12, 11, iron)
    drawing.label(12, 23, iron)
    drawing.label(30, 30, drawing.material("Air"))
    (solution,) = solved_levels(drawing.model(), 1)
    return solution.problem


def on(problem: Problem, weight: Weight, region: int) -> Floats:
    return weight.nodal[np.unique(problem.mesh.elements[problem.mesh.region == region])]


@pytest.mark.parametrize("axisymmetric", [False, True])
@pytest.mark.parametrize("make", [smooth_weight, layer_weight])
def test_one_on_the_body_and_zero_on_others(make: type, axisymmetric: bool) -> None:
    """Catches a body that is stretched, or another that is moved along."""
    found = problem(axisymmetric=axisymmetric)
    weight = make(found, (0,))
    assert np.all(on(found, weight, 0) == 1.0)
    assert np.all(on(found, weight, 1) == 0.0)
    assert weight.nodal.min() >= -1e-9
    assert weight.nodal.max() <= 1 + 1e-9
    assert weight.touched == ()


def test_shell_is_air_alone() -> None:
    """Catches the stress tensor of vacuum taken in iron."""
    found = problem()
    for weight in (smooth_weight(found, (0,)), layer_weight(found, (0,))):
        assert np.all(found.mesh.region[weight.shell] == 2)


def test_smooth_weight_falls_over_many_elements() -> None:
    """Catches a weight that falls in one layer: values of all sizes, in five times as many elements."""
    found = problem()
    smooth, layer = smooth_weight(found, (0,)), layer_weight(found, (0,))
    between = smooth.nodal[(smooth.nodal > 1e-6) & (smooth.nodal < 1 - 1e-6)]
    assert np.histogram(between, 10, (0, 1))[0].min() > 0
    assert smooth.shell.size > 3 * layer.shell.size


def test_zero_on_the_rim() -> None:
    """Catches the far boundary pulled along with the body."""
    found = problem()
    weight = smooth_weight(found, (0,))
    space = found.mesh.positions
    rim = np.any(np.isclose(space, 0.0) | np.isclose(space, 0.04), axis=1)
    assert np.abs(weight.nodal[rim]).max() < 1e-12


def test_contact_is_told() -> None:
    """Catches a force between bodies that touch, which nothing defines, given without a word."""
    found = problem(touching=True)
    assert smooth_weight(found, (0,)).touched == (1,)
    assert smooth_weight(found, (0, 1)).touched == ()


def test_a_body_of_two_regions_is_one() -> None:
    """Catches regions taken one by one."""
    found = problem(touching=True)
    weight = smooth_weight(found, (0, 1))
    assert np.all(on(found, weight, 0) == 1.0)
    assert np.all(on(found, weight, 1) == 1.0)
