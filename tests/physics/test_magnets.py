"""Magnets in free space against closed forms: field on the axis, Nagaoka's coefficient, forces by two routes."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from nodal_field import nodal_flux_density
from stress_force import axial_force

from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.problem import MagneticMaterial

FreeSpace = Callable[..., Any]
Loops = Callable[..., tuple[np.ndarray, np.ndarray]]

MU_0 = 4e-7 * np.pi


def work(solution: Solution) -> float:
    """∫ B_rem · B / μ0 dV (J): twice what the field gives back, at constant magnetisation, less a constant."""
    return float(2 * np.pi * solution.system.load @ solution.psi)


def axis_field(z: np.ndarray, remanence: float, radius: float, length: float) -> np.ndarray:
    """Axially magnetised cylinder, μ_r = 1, on its axis."""
    ends = [(z + sign * length / 2) / np.hypot(z + sign * length / 2, radius) for sign in (1, -1)]
    return np.asarray(remanence / 2 * (ends[0] - ends[1]))


def axis_error(solution: Solution, radius: float, length: float) -> float:
    """Root mean square over the axis within 1.5 lengths (T), for a remanence of 1.3 T."""
    nodes, field = nodal_flux_density(solution, np.arange(solution.problem.mesh.elements.shape[0]))
    place = solution.problem.mesh.nodes[nodes]
    axis = (place[:, 0] == 0) & (np.abs(place[:, 1]) < 1.5 * length)
    assert np.all(field[axis, 0] == 0)
    miss = field[axis, 1] - axis_field(place[axis, 1], 1.3, radius, length)
    return float(np.sqrt(np.mean(miss**2)))


def test_field_of_a_magnet_on_its_axis(free_space: FreeSpace) -> None:
    """Catches a wrong magnet load, a lost 2π, and an axis where the field loses an order: rate 2, 0.1 % at the end."""
    radius, length = 0.01, 0.02
    magnet = (MagneticMaterial.magnet((0.0, 1.3)), (0.0, radius), (-length / 2, length / 2))
    errors = [axis_error(free_space([magnet], refinement=k).solution, radius, length) for k in (1, 2, 3)]
    assert errors[-1] < 1e-3 * 1.3
    assert np.log(errors[0] / errors[1]) / np.log(2) > 1.8
    assert np.log(errors[1] / errors[2]) / np.log(1.5) > 1.8


def test_nagaoka_coefficient_of_a_magnet_as_long_as_wide(free_space: FreeSpace) -> None:
    """Catches a wrong flux through a thin solenoid, which a magnet of μ_r = 1 is: K(1) = 0.688423 (Nagaoka 1909)."""
    radius, length, remanence = 0.01, 0.02, 1.0
    magnet = (MagneticMaterial.magnet((0.0, remanence)), (0.0, radius), (-length / 2, length / 2))
    solution = free_space([magnet], far=0.6, refinement=3).solution
    volume = np.pi * radius**2 * length
    assert work(solution) / (remanence**2 / MU_0 * volume) == pytest.approx(0.688423, rel=1e-4)


def sheets_pull(
    loops: Loops, radius: float, z: tuple[float, float], other_radius: float, other_z: tuple[float, float]
) -> float:
    """Force in +z (N) on a magnet's current sheet from another's, J = 1.3 T: Maxwell's loops over both."""
    x, w = np.polynomial.legendre.leggauss(24)
    distance = (sum(other_z) + (other_z[1] - other_z[0]) * x)[None] / 2 - (sum(z) + (z[1] - z[0]) * x)[:, None] / 2
    pull = loops(radius, other_radius, distance)[1] * np.sign(distance)
    spans = (other_z[1] - other_z[0]) * (z[1] - z[0]) / 4
    return float((1.3 / MU_0) ** 2 * np.einsum("i,j,ij->", w, w, pull) * spans)


@pytest.mark.parametrize(("radius", "height", "force"), [(0.020, 0.040, 265.537), (0.015, 0.030, 111.490)])
def test_attraction_of_two_magnets_by_virtual_work(
    free_space: FreeSpace, loops: Loops, radius: float, height: float, force: float
) -> None:
    """Catches a wrong energy: half the change of ∫ B_rem·B/μ0 with distance is the force, J = 1.3 T.

    A magnet of 20 mm radius and 40 mm height pulls at one of the same and of another size, centres 50 mm apart.
    """
    magnet, step = MagneticMaterial.magnet((0.0, 1.3)), 2e-4
    lower = (-0.02, 0.02)
    assert sheets_pull(loops, 0.02, lower, radius, (0.05 - height / 2, 0.05 + height / 2)) == pytest.approx(
        force, rel=1e-5
    )

    def at(centres: float) -> float:
        parts = [
            (magnet, (0.0, 0.02), lower),
            (magnet, (0.0, radius), (centres - height / 2, centres + height / 2)),
        ]
        return work(free_space(parts, far=0.6, cells=6, refinement=2).solution) / 2

    attraction = (at(0.05 - step) - at(0.05 + step)) / (2 * step)
    assert attraction == pytest.approx(force, rel=1e-3)


def test_force_between_a_magnet_and_a_ring_by_the_stress_tensor(free_space: FreeSpace, loops: Loops) -> None:
    """Catches a wrong sign or factor of the stress tensor: against Maxwell's loops over both current sheets."""
    inner, outer, bore = 0.005, 0.015, 0.010
    z_magnet, z_ring, shell = (-0.005, 0.005), (0.001, 0.011), (0.006, 0.009)
    magnet = MagneticMaterial.magnet((0.0, 1.3))
    parts = [(magnet, (0.0, inner), z_magnet), (magnet, (bore, outer), z_ring)]
    solution = free_space(parts, far=0.2, cells=5, refinement=2, more_r=shell).solution
    exact = sheets_pull(loops, inner, z_magnet, outer, z_ring) - sheets_pull(loops, inner, z_magnet, bore, z_ring)
    assert axial_force(solution, shell) == pytest.approx(exact, rel=1e-3)


def test_action_equals_reaction(free_space: FreeSpace) -> None:
    """Catches a force that depends on where it is measured: the ring's own, as all minus the inside, is the opposite.

    What is inside a shell around both feels no force, since nothing is outside.
    """
    magnet, iron = MagneticMaterial.magnet((0.0, 1.3)), MagneticMaterial(1 / (500 * MU_0))
    parts = [(magnet, (0.0, 0.005), (-0.005, 0.005)), (iron, (0.010, 0.015), (0.001, 0.011))]
    near, middle, both = (0.006, 0.007), (0.008, 0.009), (0.02, 0.03)
    solution = free_space(parts, far=0.2, cells=5, refinement=3, more_r=(*near, *middle, *both)).solution
    pull = axial_force(solution, near)
    assert pull > 0.1
    assert axial_force(solution, middle) == pytest.approx(pull, rel=5e-3)
    assert axial_force(solution, both) == pytest.approx(0.0, abs=2e-3 * pull)


def test_no_force_in_a_symmetric_arrangement(free_space: FreeSpace) -> None:
    """Catches a mesh whose diagonals push: a magnet in the middle of a ring feels a thousandth of its pull."""
    magnet = MagneticMaterial.magnet((0.0, 1.3))

    def force(shift: float) -> float:
        parts = [(magnet, (0.0, 0.005), (-0.005, 0.005)), (magnet, (0.010, 0.015), (shift - 0.004, shift + 0.004))]
        solution = free_space(parts, far=0.2, cells=5, refinement=2, more_r=(0.006, 0.009)).solution
        return axial_force(solution, (0.006, 0.009))

    assert abs(force(0.0)) < 1e-3 * abs(force(0.003))
