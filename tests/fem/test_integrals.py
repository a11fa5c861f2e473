"""Block integrals on fields that quadratic elements hold exactly, and against each other on one they do not."""

import sys
from functools import cache
from pathlib import Path as File

import numpy as np
import pytest

sys.path.insert(0, str(File(__file__).parents[2] / "docs" / "validation"))

from cases.drawing import Drawing

from fluxbore.design.errors import SpecError
from fluxbore.fem.body_force import lorentz_force
from fluxbore.fem.femm_solution import FemmSolution, solve_model
from fluxbore.fem.integrals import INTEGRALS, block_integral, block_integrals
from fluxbore.fem.line_text import parse_line
from fluxbore.fem.line_values import line_values

MU_0 = 4e-7 * np.pi
MM = 1e-3
DEPTH = 0.05
J, SIGMA = 2e6, 5e7
LEFT, WALL = 1e-3, 3e-3
"""A (Wb/m) at the walls at x = −10 mm and x = 10 mm."""


@cache
def sheet() -> FemmSolution:
    """A sheet of current 4 mm thick (group 1) between two walls, and air (group 2) of which the left is of μ_r = 3."""
    drawing = Drawing(axisymmetric=False, depth=50.0)
    left, right = drawing.boundary("left", a0=LEFT), drawing.boundary("right", a0=WALL)
    drawing.line((-10, 0), (-10, 20), boundary=left)
    drawing.line((10, 0), (10, 20), boundary=right)
    for x in (-2, 2):
        drawing.line((x, 0), (x, 20))
    for y in (0, 20):
        drawing.line((-10, y), (-2, y), (2, y), (10, y))
    copper = drawing.material("copper", density=J, conductivity=SIGMA)
    drawing.label(-5, 3, drawing.material("ferrite", 3.0), group=2)
    drawing.label(0, 3, copper, group=1)
    drawing.label(5, 3, drawing.material("air"), group=2)
    return solve_model(drawing.model())


def slope() -> tuple[float, float]:
    """H_y on the left and on the right of the sheet: it jumps by the current, and −∫B_y dx = WALL − LEFT."""
    # With H on the left: B = 3 μ0 H over 8 mm, μ0 (H + J (x + 2 mm)) over 4 mm, μ0 (H + J 4 mm) over 8 mm.
    left = -((WALL - LEFT) / MU_0 + J * (4 * MM) ** 2 / 2 + J * 4 * MM * 8 * MM) / ((3 * 8 + 4 + 8) * MM)
    return left, left + J * 4 * MM


@cache
def ring() -> FemmSolution:
    """A ball of radius 10 mm, a solid ring (group 1) and one of wire (group 2) around an axial magnet."""
    drawing = Drawing(axisymmetric=True)
    drawing.half_disc(10, boundary=drawing.boundary("far"))
    solid, wire = drawing.circuit("solid", 100.0), drawing.circuit("wire", 2.0)
    copper, air = drawing.material("copper", conductivity=SIGMA), drawing.material("air")
    drawing.rectangle((3, 5), (-2, 0))
    drawing.rectangle((2, 4), (2, 4))
    drawing.rectangle((0, 1.5), (-1, 1))
    drawing.label(4, -1, copper, solid, group=1)
    drawing.label(3, 3, air, wire, turns=-50, group=2)
    drawing.label(0.5, 0, drawing.material("magnet", 1.05, remanence=1.0), group=3)
    drawing.label(8, 0, air)
    return solve_model(drawing.model(), groups=(1, 2), accuracy=0.01)


def test_the_blocks_of_a_plane() -> None:
    """Catches a missing depth, a density that is integrated over the wrong blocks, and a wrong sign of J × B."""
    found = block_integrals(sheet(), 1)
    left, right = slope()
    area, current = 4 * MM * 20 * MM, J * 4 * MM * 20 * MM
    assert found["area"] == pytest.approx(area)
    assert found["volume"] == pytest.approx(area * DEPTH)
    assert found["current"] == pytest.approx(current)
    mean = MU_0 * (left + right) / 2
    assert found["mean_B"] == pytest.approx((0.0, mean), rel=1e-6, abs=1e-9)
    # The sheet's A: from its left face on, A' = −B, with B linear.
    start = LEFT - 3 * MU_0 * left * 8 * MM
    t = 4 * MM
    mean_a = start - MU_0 * (left * t / 2 + J * t**2 / 6)
    assert found["mean_A"] == pytest.approx(mean_a, rel=1e-6)
    assert found["A.J"] == pytest.approx(mean_a * current * DEPTH, rel=1e-6)
    square = (left**2 + left * right + right**2) / 3
    assert found["energy"] == found["coenergy"] == pytest.approx(MU_0 * square / 2 * area * DEPTH, rel=1e-6)
    assert found["lorentz_force"] == pytest.approx((-mean * current * DEPTH, 0.0), rel=1e-6, abs=1e-9)
    # About the origin: the force acts 10 mm above it.
    assert found["lorentz_torque"] == pytest.approx(mean * current * DEPTH * 10 * MM, rel=1e-6)
    assert found["resistive_loss"] == pytest.approx(J**2 / SIGMA * area * DEPTH)


def test_blocks_of_two_materials() -> None:
    """Catches a group of which only one block is counted."""
    left, right = slope()
    size = 8 * MM * 20 * MM * DEPTH
    found = block_integrals(sheet(), 2)
    assert found["energy"] == pytest.approx(MU_0 * (3 * left**2 + right**2) / 2 * size, rel=1e-6)
    assert block_integral(sheet(), 9, 2) == pytest.approx((MU_0 * (3 * left + right) * size,), rel=1e-6)
    assert (found["current"], found["A.J"], found["resistive_loss"]) == (0, 0, 0)


def test_all_blocks_are_the_problem() -> None:
    """Catches energies that do not add up, and a work theorem without its magnets."""
    for solution in (sheet(), ring()):
        found = block_integrals(solution)
        assert (found["energy"], found["coenergy"]) == pytest.approx(solution.energies, rel=1e-12)
        groups = {label.group for label in solution.model.labels}
        for name in ("energy", "area", "volume", "current", "A.J"):
            parts = [block_integral(solution, name, group)[0] for group in groups]
            assert block_integral(solution, name)[0] == pytest.approx(sum(parts), rel=1e-9)


def test_blocks_round_an_axis() -> None:
    """Catches a section that is taken for a volume, and a solid ring's current that is not as 1/r."""
    found = block_integrals(ring(), 1)
    assert found["area"] == pytest.approx(4 * MM**2)
    assert found["volume"] == pytest.approx(np.pi * (5**2 - 3**2) * 2 * MM**3)
    assert found["current"] == pytest.approx(100.0)
    # J = k/r: I = k ln(5/3) h, loss = 2π k² ln(5/3) h / σ.
    assert found["resistive_loss"] == pytest.approx(2 * np.pi * 100.0**2 / (np.log(5 / 3) * 2 * MM) / SIGMA, rel=1e-6)
    assert block_integral(ring(), 25, 1) == pytest.approx((4 * MM, -1 * MM))
    assert block_integral(ring(), 24, 1) == pytest.approx((np.pi / 2 * (5**4 - 3**4) * 2 * MM**5,), rel=1e-6)
    assert block_integral(ring(), "current", 2) == pytest.approx((-100.0,))
    ball = block_integral(ring(), 10)[0], block_integral(ring(), 5)[0]
    assert ball == pytest.approx((4 / 3 * np.pi * (10 * MM) ** 3, np.pi / 2 * (10 * MM) ** 2), rel=1e-4)


def test_linkage_is_a_j_per_ampere() -> None:
    """Catches a source that is not the circuit's: ∫ A·J dV = I λ for every coil, wound or solid."""
    linkages = ring().linkages
    assert block_integral(ring(), 0, 1)[0] / 100.0 == pytest.approx(linkages[0], rel=1e-9)
    assert block_integral(ring(), 0, 2)[0] / 2.0 == pytest.approx(linkages[1], rel=1e-9)


@pytest.mark.parametrize("group", [1, 2])
def test_two_ways_to_the_force_on_a_coil(group: int) -> None:
    """Catches φ × B of the wrong sign, and a stress tensor's weight on the wrong blocks."""
    regions = ring().regions(group)
    lorentz = lorentz_force(ring().solution, regions)
    assert lorentz is not None
    assert block_integral(ring(), "lorentz_force", group) == pytest.approx(lorentz.force, rel=1e-12)
    assert block_integral(ring(), 19, group) == pytest.approx(block_integral(ring(), 12, group), rel=0.02)
    assert block_integral(ring(), 18, group) == (0.0,)


def test_the_flux_of_a_block_obeys_stokes() -> None:
    """Catches B components that are swapped: ∫ B_z dV over a block is 2π ∫ (ψ outside − ψ inside) dz."""
    sides = []
    for r in (3, 5):
        values = line_values(ring(), *parse_line(f"{r},-2:{r},0:4001", MM)).field.potential
        sides.append(float(np.mean((values[1:] + values[:-1]) / 2)) * 2 * MM)
    assert block_integral(ring(), 9, 1)[0] == pytest.approx(2 * np.pi * (sides[1] - sides[0]), rel=1e-5)


@pytest.mark.parametrize("which", ["flux", 3, 99, -1])
def test_an_integral_that_is_none(which: str | int) -> None:
    """Catches a KeyError."""
    with pytest.raises(SpecError, match=r"must be one of area, volume, .*FEMM's number 0, 1, 2, 4"):
        block_integral(sheet(), which)


def test_a_group_without_blocks() -> None:
    """Catches a sum over nothing that looks like an answer."""
    with pytest.raises(SpecError, match="--group must be"):
        block_integrals(sheet(), 77)


def test_names_and_numbers_are_unique() -> None:
    """Catches two rows of the table of which one is never found."""
    names = [item.name for item in INTEGRALS]
    numbers = [number for item in INTEGRALS for number in item.numbers]
    assert len(set(names)) == len(names)
    assert len(set(numbers)) == len(numbers)
