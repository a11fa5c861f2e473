"""Force and torque by independent routes: stress, virtual work, energy, and Maxwell's stress in three dimensions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from rotlin_section import PERIOD, backed, ideal

from fluxbore.design.materials import standard
from fluxbore.fem.element import kernel, positions
from fluxbore.fem.helical import HelicalSolution, solve
from fluxbore.fem.helical_force import coenergy, force, torque, virtual_force
from fluxbore.fem.magnetostatics import Settings
from fluxbore.geometry.helical_bands import alternating
from fluxbore.geometry.helical_section import HelicalSection

BANDS = alternating(1.25)
STEEL = standard()["1010"].curve
TIGHT = Settings(tolerance=1e-11, method="auto")
MU_0 = 4e-7 * np.pi

SECTIONS: dict[str, HelicalSection] = {
    "ideal": ideal(BANDS, BANDS, 0.2 * PERIOD),
    "saturated": backed(BANDS, curve=STEEL, thickness=0.3e-3, displacement=0.31 * PERIOD),
    "long lead": ideal(BANDS, alternating(1.1, 0.8), 0.12 * PERIOD, 16 * PERIOD),
    "left-hand": ideal(BANDS, BANDS, 0.4 * PERIOD, -2 * PERIOD),
}


@pytest.fixture(params=SECTIONS, scope="module")
def solved(request: pytest.FixtureRequest) -> HelicalSolution:
    return solve(SECTIONS[request.param], settings=TIGHT)


def test_stress_is_virtual_work(solved: HelicalSolution) -> None:
    """Catches a wrong sign, radius or weight of either: they are one number of the discrete field."""
    assert virtual_force(solved) == pytest.approx(force(solved), rel=1e-10)


def test_force_is_minus_the_slope_of_the_coenergy(solved: HelicalSolution) -> None:
    """Catches a coenergy that is not stationary, and iron's own left out: two whole fields on one set of lines."""
    step = 1e-3 * PERIOD
    ahead, behind = (
        coenergy(solve(replace(solved.section, displacement=solved.section.displacement + part), settings=TIGHT))
        for part in (step, -step)
    )
    assert -(ahead - behind) / (2 * step) == pytest.approx(force(solved), rel=1e-4)


def test_torque_is_h_times_force(solved: HelicalSolution) -> None:
    """Catches H_θ of the wrong sign or size: the torque is integrated from its own stress, B_r H_θ r."""
    assert torque(solved) == pytest.approx(solved.section.transfer_ratio * force(solved), rel=1e-12)


def test_force_and_torque_in_three_dimensions(solved: HelicalSolution) -> None:
    """Catches the helix' coordinates themselves: Maxwell's stress tensor in Cartesian axes.

    The potential's slopes in (r, ζ) are carried to x, y, z by differencing r = √(x² + y²) and ζ = z − h atan2(y, x), at
    every quadrature point of the gap placed at many angles; thrust and twist are n·T·e_z and x t_y − y t_x.
    """
    h = solved.section.transfer_ratio
    system, gap = solved.system, solved.system.grid.gap
    rows = kernel(system.mesh, gap).curl
    slopes = np.einsum("mqkn,mn->mqk", rows, solved.phi[system.mesh.elements[gap]])
    at = positions(system.mesh, gap)
    first, last = solved.section.gap_radii
    # Of volume, per radian and per gap: what remains to be averaged over the angle.
    weight = system.kernel.weight[gap] * system.grid.copies * 2 * np.pi / (last - first)
    thrust, twist = [], []
    for theta in np.linspace(0.1, 0.1 + 2 * np.pi, 7, endpoint=False):
        theta = float(np.mod(theta + np.pi, 2 * np.pi) - np.pi)
        place = np.stack((at[..., 0] * np.cos(theta), at[..., 0] * np.sin(theta), at[..., 1] + h * theta))
        field = -np.stack([_along(place, axis, h, slopes) for axis in range(3)])
        normal = np.array([np.cos(theta), np.sin(theta), 0.0])[:, None, None]
        stress = MU_0 * (np.sum(field * normal, axis=0) * field - np.sum(field**2, axis=0) / 2 * normal)
        thrust.append(np.sum(weight * stress[2]))
        twist.append(np.sum(weight * (place[0] * stress[1] - place[1] * stress[0])))
    assert np.mean(thrust) == pytest.approx(force(solved), rel=1e-6)
    # On the inner member; the outer one feels the opposite.
    assert -np.mean(twist) == pytest.approx(torque(solved), rel=1e-6)


def _along(place: np.ndarray, axis: int, h: float, slopes: np.ndarray) -> np.ndarray:
    """∂φ/∂(x, y or z) from ∂φ/∂r and ∂φ/∂ζ, the coordinates differenced."""
    step = np.zeros((3, 1, 1))
    step[axis] = 1e-6
    coordinates: list[Callable[[np.ndarray], np.ndarray]] = [
        lambda p: np.hypot(p[0], p[1]),
        lambda p: p[2] - h * np.arctan2(p[1], p[0]),
    ]
    turned = [(of(place + step) - of(place - step)) / 2e-6 for of in coordinates]
    return np.asarray(turned[0] * slopes[..., 0] + turned[1] * slopes[..., 1])


def test_aligned_members_are_stable() -> None:
    """Catches a sign of the force: a rotor ahead pulls the translator after it, one behind draws it back."""
    ahead, at_rest, behind = (force(solve(ideal(BANDS, BANDS, x * PERIOD))) for x in (0.1, 0.0, -0.1))
    assert ahead > 0
    assert abs(at_rest) < 1e-9 * ahead
    assert behind == pytest.approx(-ahead, rel=1e-6)


def test_coenergy_of_linear_layers_is_half_the_magnets_work() -> None:
    """Catches a factor in the coenergy: at its least value ½ ∫ μ H² + ∫ B_rem·H is −½ ∫ μ H²."""
    found = solve(ideal(BANDS, BANDS, 0.1 * PERIOD), settings=TIGHT)
    system = found.system
    h = found.field_strength()
    stored = np.sum(system.kernel.weight * system.mu[:, None] * np.sum(h**2, axis=-1)) / 2
    assert coenergy(found) == pytest.approx(-2 * np.pi * system.grid.copies * stored, rel=1e-9)
