"""How loads and linkages of coils change with mesh, windows and turns: differences of the densities themselves."""

from dataclasses import replace

import numpy as np
import pytest
from small_motor import difference, small_section, solved, with_lines

from fluxbore.fem.coil_windows import WindowDerivative, Windows, circuits
from fluxbore.fem.mapped import MappedMesh
from fluxbore.geometry.cross_section import CoilWindow

Array = np.ndarray
PHASES = ("U", "V", "W")


@pytest.fixture(scope="module")
def grid() -> MappedMesh:
    return solved(small_section()).grid


@pytest.fixture(scope="module")
def coils() -> tuple[CoilWindow, ...]:
    """The motor's, with turns that differ, so that a mix-up shows."""
    return tuple(replace(coil, turns=coil.turns + 3 * k) for k, coil in enumerate(small_section().coils))


@pytest.fixture(scope="module")
def fields(grid: MappedMesh) -> dict[str, Array]:
    """(n, 2) of each phase; nothing on the axis."""
    rng = np.random.default_rng(2)
    s = grid.mesh.nodes[:, :1]
    return {phase: s * rng.uniform(-1, 1, (s.size, 2)) for phase in PHASES}


def linked(grid: MappedMesh, coils: tuple[CoilWindow, ...], fields: dict[str, Array]) -> Array:
    """(2,) Σ density · v."""
    return np.sum([circuit.density @ fields[circuit.name] for circuit in circuits(grid, coils)], axis=0)


@pytest.fixture(scope="module")
def found(grid: MappedMesh, coils: tuple[CoilWindow, ...], fields: dict[str, Array]) -> WindowDerivative:
    return Windows(grid, coils).derivative(fields)


def test_by_mesh_lines(
    grid: MappedMesh, coils: tuple[CoilWindow, ...], fields: dict[str, Array], found: WindowDerivative
) -> None:
    """Catches points that move with the mesh where they should stay in space.

    The winding's two radii are lines, with which the windows move.
    """
    s, z = grid.r_lines**2 / 2, grid.z_lines
    for axis, (lines, by_lines) in enumerate(((s, found.s), (z, found.z))):
        for k in range(1 - axis, lines.size):
            reach = float(np.diff(lines)[max(k - 1, 0) : k + 1].min())
            # The line's own radius, where it is one of the windows'.
            sides = [j for j in range(2) if axis == 0 and np.isclose(grid.r_lines[k], coils[0].r[j], rtol=1e-12)]

            def at(step: float, k: int = k, axis: int = axis, reach: float = reach, sides: list[int] = sides) -> Array:
                moved = [s.copy(), z.copy()]
                moved[axis][k] += step * reach
                radii = tuple(np.sqrt(2 * moved[0][k]) if j in sides else coils[0].r[j] for j in range(2))
                windows = tuple(replace(coil, r=(float(radii[0]), float(radii[1]))) for coil in coils)
                return linked(with_lines(grid, *moved), windows, fields)

            expected = difference(at, 1e-3) / reach
            own = by_lines[k] + sum((found.windows[:, j].sum(axis=0) / grid.r_lines[k] for j in sides), np.zeros(2))
            scale = np.abs(linked(grid, coils, fields)).max() / reach
            assert own == pytest.approx(expected, rel=1e-6, abs=1e-8 * scale), (axis, k)


def test_by_windows(
    grid: MappedMesh, coils: tuple[CoilWindow, ...], fields: dict[str, Array], found: WindowDerivative
) -> None:
    """Catches a stretch whose turns per area stay: both ends of every coil in z, and its outer radius; the inner one
    is a mesh line, on which ∂v/∂r jumps."""
    for k, coil in enumerate(coils):
        for side in (1, 2, 3):

            def at(step: float, k: int = k, coil: CoilWindow = coil, side: int = side) -> Array:
                limits = [*coil.r, *coil.z]
                limits[side] += step
                moved = replace(coil, r=(limits[0], limits[1]), z=(limits[2], limits[3]))
                return linked(grid, (*coils[:k], moved, *coils[k + 1 :]), fields)

            expected = difference(at, 1e-6)
            assert found.windows[k, side] == pytest.approx(expected, rel=1e-6, abs=1e-7 * np.abs(found.windows).max())


def test_by_turns(
    grid: MappedMesh, coils: tuple[CoilWindow, ...], fields: dict[str, Array], found: WindowDerivative
) -> None:
    """Catches a coil's turns on another coil: linear in them, so one step tells all; and their sum is the whole."""
    here = linked(grid, coils, fields)
    for k, coil in enumerate(coils):
        more = linked(grid, (*coils[:k], replace(coil, turns=coil.turns + 1.0), *coils[k + 1 :]), fields)
        assert found.turns[k] == pytest.approx(more - here, rel=1e-9, abs=1e-12 * np.abs(here).max())
    assert np.array([coil.turns for coil in coils]) @ found.turns == pytest.approx(here, rel=1e-12)


def test_a_moved_winding(grid: MappedMesh, coils: tuple[CoilWindow, ...]) -> None:
    """Catches a window's derivative that is not its field's at the ends: v = z links Σ turns · middle."""
    z = grid.mesh.nodes[:, 1]
    found = Windows(grid, coils).derivative(dict.fromkeys(PHASES, z))
    turns = np.array([coil.turns for coil in coils])
    # Turns times z over the area; a window that shifts by one shifts the middle by one.
    assert found.windows[:, 2:, 0].sum(axis=1) == pytest.approx(turns, rel=1e-9)
    assert found.windows[:, :2, 0] == pytest.approx(0.0, abs=1e-6 * turns.max())
    middles = np.array([sum(coil.z) / 2 for coil in coils])
    assert found.turns[:, 0] == pytest.approx(middles, abs=1e-12)
