"""The rod: buckling against the column's own differential equation, and the stress of its section."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.column import (
    END_CONDITIONS,
    axial_stress,
    buckling_force,
    critical_force,
    free_length,
    section,
)
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.materials import Library
from fluxbore.geometry.hybrid_parts import assembly

E, YIELD = 193e9, 215e6


def _beam_load(ends: str, length: float, moment: float, elements: int = 24) -> float:
    """Critical load by cubic beam elements with their geometric stiffness: no K in it."""
    h, count = length / elements, 2 * (elements + 1)
    bend = E * moment / h**3 * np.array(
        [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h**2, -6 * h, 2 * h**2],
         [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h**2, -6 * h, 4 * h**2]]
    )  # fmt: skip
    push = 1 / (30 * h) * np.array(
        [[36, 3 * h, -36, 3 * h], [3 * h, 4 * h**2, -3 * h, -(h**2)],
         [-36, -3 * h, 36, -3 * h], [3 * h, -(h**2), -3 * h, 4 * h**2]]
    )  # fmt: skip
    stiffness, geometric = np.zeros((count, count)), np.zeros((count, count))
    for i in range(elements):
        at = slice(2 * i, 2 * i + 4)
        stiffness[at, at] += bend
        geometric[at, at] += push
    first, last = ends.split("-")
    held = {"free": [], "pinned": [0], "fixed": [0, 1]}
    fixed = held[first] + [count - 2 + i for i in held[last]]
    free = [i for i in range(count) if i not in fixed]
    loads = np.linalg.eigvals(np.linalg.solve(geometric[np.ix_(free, free)], stiffness[np.ix_(free, free)]))
    return float(min(load.real for load in loads if load.real > 0))


@pytest.mark.parametrize("ends", END_CONDITIONS)
def test_eulers_load_against_beam_elements(ends: str) -> None:
    """Catches a K of another way to hold the rod."""
    diameter, length = 4e-3, 0.5
    found = buckling_force(diameter, END_CONDITIONS[ends] * length, E, None)
    assert found == pytest.approx(_beam_load(ends, length, section(diameter)[1]), rel=1e-5)


def test_johnson_meets_euler_with_the_same_slope() -> None:
    """Catches a kink or a jump where the formulas change, which would trap a search."""
    diameter = 8e-3
    change = diameter / 4 * math.pi * math.sqrt(2 * E / YIELD)
    step = 1e-5 * change

    def force(length: float) -> float:
        found = buckling_force(diameter, length, E, YIELD)
        assert found is not None
        return found

    below, above = force(change * (1 - 1e-12)), force(change * (1 + 1e-12))
    assert below == pytest.approx(above, rel=1e-9)
    left = (force(change) - force(change - step)) / step
    right = (force(change + step) - force(change)) / step
    assert left == pytest.approx(right, rel=1e-3)


@given(diameter=st.floats(1e-3, 0.1), ratio=st.floats(0.01, 1000))
def test_no_rod_bears_more_than_its_yield_or_eulers_load(diameter: float, ratio: float) -> None:
    found = buckling_force(diameter, ratio * diameter, E, YIELD)
    assert found is not None
    assert 0 < found <= section(diameter)[0] * YIELD
    euler = buckling_force(diameter, ratio * diameter, E, None)
    assert euler is not None
    assert found <= euler * (1 + 1e-9)


def test_the_free_length_is_what_the_drawing_shows(table_ii: HybridActuator) -> None:
    """Catches a length that forgets piston, cap or half of the stroke: the drawn parts have their own coordinates."""
    parts = {part.name: part for part in assembly(table_ii, table_ii.mid_stroke + table_ii.mover.stroke / 2).parts}
    rod = max(z for _, z in parts["shaft"].profile)
    cap = max(z for _, z in parts["end cap, rod end"].profile)
    assert free_length(table_ii) == pytest.approx(rod - cap, abs=1e-12)
    assert free_length(table_ii) == pytest.approx(0.095, abs=1e-6)
    short = replace(table_ii, shaft=replace(table_ii.shaft, length=0.1))
    assert free_length(short) == 0.0


def test_the_prototypes_rod(table_ii: HybridActuator, library: Library) -> None:
    """95 mm of 8 mm steel, slenderness 95: Johnson's 160 MPa, below Euler's 211 MPa."""
    steel = library["stainless steel 304"]
    found = critical_force(table_ii, steel, "fixed-free")
    assert found == pytest.approx(160.25e6 * section(8e-3)[0], rel=1e-3)
    assert critical_force(table_ii, replace(steel, young_modulus=None), "fixed-free") is None
    assert buckling_force(8e-3, 0.0, E, None) is None
    assert axial_stress(table_ii, 100.0) == pytest.approx(100.0 / (math.pi * 4e-3**2))
