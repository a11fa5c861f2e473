"""Coil windows over a mesh: exact shares wherever their ends lie."""

from collections.abc import Callable
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fluxbore.fem.coil_windows import circuits
from fluxbore.fem.mapped import MappedMesh, Subdivision, mapped_mesh
from fluxbore.fem.mesh import Floats
from fluxbore.geometry.cross_section import Breakpoints, CoilWindow, CrossSection

Build = Callable[..., MappedMesh]
R = (0.02, 0.05)


def shells(cells: int = 3, wobble: float = 0.0, order: int = 4) -> MappedMesh:
    """Air with mesh lines at the window's radii; ``wobble`` moves the z lines between them."""
    section = CrossSection(
        Breakpoints((0.0, *R, 0.08), ("a", "b", "c")),
        Breakpoints((0.0, 0.07 + wobble, 0.2), ("d", "e")),
        (),
        np.zeros((2, 3), dtype=int),
        (),
        (),
        R,
    )
    return mapped_mesh(
        section, dict.fromkeys("abc", Subdivision(cells)), dict.fromkeys("de", Subdivision(4)), order=order
    )


MESH = shells()


def coil_density(grid: MappedMesh, coil: CoilWindow) -> Floats:
    return circuits(grid, (coil,))[0].density


def moment(grid: MappedMesh, coil: CoilWindow, power: int, rise: int) -> float:
    """Σ density · s^power z^rise: the window's integral of a function that cells hold, up to their order."""
    s, z = grid.mesh.nodes.T
    return float(coil_density(grid, coil) @ (s**power * z**rise))


def exact(coil: CoilWindow, power: int, rise: int) -> float:
    """∫ (turns/area) (r²/2)^power z^rise dr dz over the window."""
    (a, b), (low, high) = coil.r, coil.z
    radial = (b ** (2 * power + 1) - a ** (2 * power + 1)) / ((2 * power + 1) * 2**power)
    axial = (high ** (rise + 1) - low ** (rise + 1)) / (rise + 1)
    return coil.turns / coil.area * radial * axial


@given(st.floats(0.0, 0.199), st.floats(1e-4, 0.2))
@settings(max_examples=60, deadline=None)
def test_shares_are_exact_wherever_the_ends_lie(start: float, length: float) -> None:
    """Catches a wrong clip, a lost sliver, a weight that is not 1/r: all moments up to the order, any window."""
    coil = CoilWindow("u", 73.0, R, (start, min(start + length, 0.2)))
    for power, rise in product(range(5), repeat=2):
        assert moment(MESH, coil, power, rise) == pytest.approx(exact(coil, power, rise), rel=1e-9), (power, rise)


@given(st.floats(0.0, 0.07), st.floats(1e-3, 0.08))
@settings(max_examples=30, deadline=None)
def test_radii_need_not_be_lines(inner: float, thickness: float) -> None:
    """Catches a winding that snaps to the mesh lines beside it."""
    coil = CoilWindow("u", 73.0, (inner, min(inner + thickness, 0.08)), (0.033, 0.0701))
    for power, rise in product(range(3), repeat=2):
        assert moment(shells(order=2), coil, power, rise) == pytest.approx(exact(coil, power, rise), rel=1e-9)


@given(st.floats(0.01, 0.15))
@settings(max_examples=20, deadline=None)
def test_two_halves_make_the_whole(cut: float) -> None:
    """Catches a window whose ends overlap or leave a gap; each node's share depends on where a cell is cut by 1e-6."""
    whole = coil_density(MESH, CoilWindow("u", 150.0, R, (0.01, 0.16)))
    parts = [
        coil_density(MESH, CoilWindow("u", 1000.0 * (high - low), R, (low, high)))
        for low, high in ((0.01, cut), (cut, 0.16))
        if high - low > 1e-12
    ]
    np.testing.assert_allclose(sum(parts), whole, atol=2e-6 * np.abs(whole).max())


@pytest.mark.parametrize("wobble", [-0.021, 1e-12, 0.0137])
def test_mesh_lines_do_not_matter(wobble: float) -> None:
    """Catches a window that snaps to lines: mesh lines elsewhere, same integral of a quadratic function."""
    coil = CoilWindow("u", 73.0, R, (0.033, 0.0701))
    for power, rise in ((0, 0), (1, 1), (0, 2)):
        assert moment(shells(5, wobble), coil, power, rise) == pytest.approx(exact(coil, power, rise), rel=1e-11)


def test_thin_winding_near_the_axis() -> None:
    """Catches a Gauss rule that is too short for 1/r: a window whose radii are one to twenty in three cells."""
    section = CrossSection(
        Breakpoints((0.0, 0.001, 0.02, 0.03), ("a", "b", "c")),
        Breakpoints((0.0, 0.1), ("d",)),
        (),
        np.zeros((1, 3), dtype=int),
        (),
        (),
        R,
    )
    mesh = mapped_mesh(section, dict.fromkeys("abc", Subdivision(3)), {"d": Subdivision(3)})
    coil = CoilWindow("u", 10.0, (0.001, 0.02), (0.02, 0.05))
    assert moment(mesh, coil, 0, 0) == pytest.approx(10.0, rel=1e-12)


def test_nothing_outside_the_window() -> None:
    """Catches a load on elements that the window does not touch."""
    density = coil_density(MESH, CoilWindow("u", 1.0, R, (0.08, 0.1)))
    loaded = MESH.mesh.positions[np.abs(density) > 1e-15]
    assert loaded[:, 0].min() >= R[0] - 1e-12
    assert loaded[:, 0].max() <= R[1] + 1e-12
    assert loaded[:, 1].min() > 0.03
    assert loaded[:, 1].max() < 0.15


def test_circuits_gather_their_coils() -> None:
    """Catches coils of one name that overwrite one another, a lost winding direction, another order."""
    coils = [
        CoilWindow("U", 10.0, R, (0.00, 0.02)),
        CoilWindow("V", 7.0, R, (0.02, 0.04)),
        CoilWindow("U", -4.0, R, (0.04, 0.06)),
    ]
    u, v = circuits(MESH, coils)
    assert (u.name, v.name) == ("U", "V")
    assert u.density.sum() == pytest.approx(6.0)
    assert v.density.sum() == pytest.approx(7.0)
    np.testing.assert_allclose(u.density, coil_density(MESH, coils[0]) + coil_density(MESH, coils[2]))


def test_window_narrower_than_one_cell(block: Build) -> None:
    """Catches a window that is lost between two lines."""
    mesh = block(4)
    radii = (0.025, 0.075)  # lines of the four equal cells of 0.1 m
    coil = CoilWindow("u", 3.0, radii, (0.1234, 0.1235))
    assert coil_density(mesh, coil).sum() == pytest.approx(3.0)
