"""VTK files as VTK reads them."""

import sys
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import pyvista

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases.drawing import Drawing

from fluxbore.fem.femm_solution import FemmSolution, solve_model
from fluxbore.fem.field_file import vtu

MU_0 = 4e-7 * np.pi
MM = 1e-3
B_X, B_Z = 0.3, 0.4


@cache
def two_materials() -> FemmSolution:
    """B = (B_X, 0) through air (group 7) on the left of x = 0 and something of μ_r = 4 (group 9) on its right."""
    drawing = Drawing(axisymmetric=False, depth=50.0)
    edge = drawing.boundary("far", a2=B_X * MM)
    drawing.rectangle((-10, 10), (-10, 10), edge)
    drawing.line((0, -10), (0, 10))
    drawing.label(-5, 0, drawing.material('air & "gas"'), group=7)
    drawing.label(5, 0, drawing.material("Stahl µ=4", 4.0), group=9)
    return solve_model(drawing.model())


@cache
def ball() -> FemmSolution:
    drawing = Drawing(axisymmetric=True)
    drawing.half_disc(10, boundary=drawing.boundary("far", a1=B_Z / 2 * MM))
    drawing.label(3, 0, drawing.material("air"))
    return solve_model(drawing.model())


def read(solution: FemmSolution, folder: Path) -> pyvista.UnstructuredGrid:
    path = folder / "field.vtu"
    path.write_bytes(vtu(solution))
    grid = pyvista.read(path)
    assert isinstance(grid, pyvista.UnstructuredGrid)
    return grid


def test_the_elements_are_the_meshs(tmp_path: Path) -> None:
    """Catches nodes in another order than VTK's, lost elements, and lengths in millimetres."""
    solution = ball()
    grid = read(solution, tmp_path)
    mesh = solution.solution.problem.mesh
    assert grid.n_cells == mesh.region.size
    assert set(grid.celltypes) == {22}
    assert grid.points[grid.cells.reshape(-1, 7)[:, 1:]][..., :2] == pytest.approx(mesh.positions[mesh.elements])
    # Of the curved elements: VTK cuts them into pieces to measure them.
    area = grid.compute_cell_sizes(length=False, volume=False)["Area"].sum()
    assert area == pytest.approx(np.pi / 2 * (10 * MM) ** 2, rel=1e-3)


def test_the_field_of_a_uniform_ball(tmp_path: Path) -> None:
    """Catches a swapped component, a division by zero on the axis, and r A for A."""
    grid = read(ball(), tmp_path)
    r = grid.points[:, 0]
    assert grid["A"] == pytest.approx(B_Z / 2 * r, rel=1e-6, abs=1e-12)
    assert grid["r A"] == pytest.approx(B_Z / 2 * r**2, rel=1e-6, abs=1e-14)
    assert grid["B"] == pytest.approx(np.tile([0, B_Z, 0], (r.size, 1)), rel=1e-5, abs=1e-5)
    assert grid["H"] == pytest.approx(grid["B"] / MU_0, rel=1e-6)


def test_an_interface_has_two_sides(tmp_path: Path) -> None:
    """Catches nodes that two blocks share, whose H would be smeared over both."""
    grid = read(two_materials(), tmp_path)
    block = np.empty(grid.n_points, dtype=int)
    block[grid.cells.reshape(-1, 7)[:, 1:]] = grid.cell_data["block"][:, None]
    expected = np.where(block == 0, 1.0, 0.25) * B_X / MU_0
    assert grid["H"][:, 0] == pytest.approx(expected, rel=1e-6)
    on_face = np.flatnonzero(grid.points[:, 0] == 0)
    assert np.count_nonzero(block[on_face] == 0) == np.count_nonzero(block[on_face] == 1) > 2
    assert "r A" not in grid.point_data


def test_cells_know_what_they_are(tmp_path: Path) -> None:
    """Catches numbers from one instead of zero, and names that break the XML."""
    grid = read(two_materials(), tmp_path)
    left = grid.cell_centers().points[:, 0] < 0
    assert np.array_equal(grid.cell_data["group"], np.where(left, 7, 9))
    assert np.array_equal(grid.cell_data["material"], np.where(left, 0, 1))
    assert list(grid.field_data["material names"]) == ['air & "gas"', "Stahl µ=4"]


def test_the_same_solution_is_the_same_file() -> None:
    """Catches a date or a random order in the file."""
    assert vtu(two_materials()) == vtu(two_materials())
