"""Air-cored coils against closed forms: inductance, mutual inductance, reciprocity, the far boundary."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from fluxbore.fem.linkage import flux_linkages
from fluxbore.geometry.cross_section import CoilWindow

FreeSpace = Callable[..., Any]

MU_0 = 4e-7 * np.pi
INCH = 0.0254
THICK_COIL = CoilWindow("coil", 1000, (INCH / 2, 1.5 * INCH), (-INCH, INCH))


def thick_coil_inductance(turns: float, inner: float, outer: float, length: float) -> float:
    """∫ over k of the loops' Bessel integral, each loop of the section with each: free space, uniform current."""
    from scipy.integrate import quad
    from scipy.special import j0, j1, struve

    def radial(k: float) -> float:
        """∫ r J1(kr) dr over the section."""
        ends = [
            np.pi * r / (2 * k) * (j1(k * r) * struve(0, k * r) - j0(k * r) * struve(1, k * r)) for r in (inner, outer)
        ]
        return float(ends[1] - ends[0])

    def integrand(x: float) -> float:
        k = x / outer
        return radial(k) ** 2 * 2 * (length / k + np.expm1(-k * length) / k**2) / outer

    pieces = [quad(integrand, a, b, limit=200)[0] for a, b in ((1e-9, 1), (1, 5), (5, 20), (20, 100), (100, 400))]
    return float(MU_0 * np.pi * turns**2 / ((outer - inner) * length) ** 2 * sum(pieces))


def test_inductance_of_a_thick_coil(free_space: FreeSpace) -> None:
    """Catches a wrong coil load or linkage: 22.945 mH (1 in bore, 3 in outside, 2 in long, 1000 turns)."""
    exact = thick_coil_inductance(1000, INCH / 2, 1.5 * INCH, 2 * INCH)
    assert exact == pytest.approx(22.945e-3, rel=1e-4)
    solution = free_space([], [THICK_COIL], far=1.6, currents=[1.0], cells=6, refinement=2).solution
    assert flux_linkages(solution)[0] == pytest.approx(exact, rel=1e-4)


def test_coil_ends_need_not_be_mesh_lines(free_space: FreeSpace) -> None:
    """Catches a window that snaps to the mesh: the same coil with its ends inside cells, to 1e-5."""
    solution = free_space(
        [], [THICK_COIL], far=1.6, currents=[1.0], cells=6, refinement=2, more_z=(-0.031, 0.0, 0.029)
    ).solution
    exact = thick_coil_inductance(1000, INCH / 2, 1.5 * INCH, 2 * INCH)
    assert flux_linkages(solution)[0] == pytest.approx(exact, rel=2e-4)


def test_far_boundary_counts_with_the_cube_of_its_distance(free_space: FreeSpace) -> None:
    """Catches an open boundary that is not: twice as far, the missing inductance is an eighth."""
    exact = thick_coil_inductance(1000, INCH / 2, 1.5 * INCH, 2 * INCH)
    missing = [
        exact - flux_linkages(free_space([], [THICK_COIL], far=far, currents=[1.0], cells=8, refinement=2).solution)[0]
        for far in (0.1, 0.2, 0.4)
    ]
    assert missing[0] > 0
    assert 5 < missing[0] / missing[1] < 9
    assert 5 < missing[1] / missing[2] < 9


def test_mutual_inductance_of_two_rings(
    free_space: FreeSpace, loops: Callable[..., tuple[np.ndarray, np.ndarray]]
) -> None:
    """Catches a linkage that belongs to another coil, and M12 ≠ M21: rings of 0.1 m at 0.1 m, by Maxwell's loops."""
    assert loops(0.1, 0.1, np.array(0.1))[0] == pytest.approx(4.940784631e-8, rel=1e-9)
    assert loops(0.1, 0.1, np.array(0.1))[1] == pytest.approx(7.183656729e-7, rel=1e-9)
    radius, half = 0.1, 0.002
    rings = [
        CoilWindow(name, 1, (radius - half, radius + half), (z - half, z + half))
        for name, z in (("a", 0.0), ("b", 0.1))
    ]
    x, w = np.polynomial.legendre.leggauss(3)
    exact = sum(
        wi * wj * wk * wl / 16 * loops(radius + half * ri, radius + half * rj, radius + half * (zk - zl))[0]
        for ri, wi in zip(x, w, strict=True)
        for rj, wj in zip(x, w, strict=True)
        for zk, wk in zip(x, w, strict=True)
        for zl, wl in zip(x, w, strict=True)
    )
    lines = {"more_z": (-0.01, 0.01, 0.05, 0.09, 0.11), "more_r": (0.03, 0.06, 0.09, 0.11, 0.14)}
    there, back = (
        flux_linkages(free_space([], rings, far=4.0, currents=currents, cells=5, refinement=2, **lines).solution)
        for currents in ([1.0, 0.0], [0.0, 1.0])
    )
    assert there[1] == pytest.approx(exact, rel=3e-4)
    assert there[1] == pytest.approx(back[0], rel=1e-10)
    assert there[0] == pytest.approx(back[1], rel=1e-3)
