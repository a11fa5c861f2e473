"""The exact field and energy of solid windings: against closed forms, published inductances and loops of current."""

import json
import math
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from scipy.special import ellipe, ellipk

from fluxbore.cli import main
from fluxbore.design.bh_curve import MU_0
from fluxbore.design.coils import Coil
from fluxbore.design.coils_energy import mutual_energy, stored_energy
from fluxbore.design.coils_field import flux_density
from fluxbore.design.coils_surface import hottest, magnitude, place

COIL = Coil("coil_1", 0.0127, 0.0381, -0.0254, 0.0254, 1e6)
"""Inner diameter 1 in, outer 3 in, length 2 in."""

STORE = (
    Coil("coil_1", 1.865, 2.135, -0.8, 0.8, 22.5e6),
    Coil("coil_2", 3.08 - 0.197, 3.08 + 0.197, -0.239, 0.239, -22.5e6),
)
"""The published design of TEAM problem 22."""


def loops(coil, r, z, points=40):
    """The field (T) from circular loops on Gauss points of the winding, by elliptic integrals; valid outside it."""
    nodes, weights = leggauss(points)
    a = (coil.inner_radius + coil.outer_radius + (coil.outer_radius - coil.inner_radius) * nodes[:, None]) / 2
    d = z - (coil.lower + coil.upper + (coil.upper - coil.lower) * nodes[None, :]) / 2
    section = (coil.outer_radius - coil.inner_radius) * (coil.upper - coil.lower) / 4
    m = 4 * a * r / ((a + r) ** 2 + d**2)
    root, near = np.sqrt((a + r) ** 2 + d**2), (a - r) ** 2 + d**2
    axial = (ellipk(m) + (a**2 - r**2 - d**2) / near * ellipe(m)) / root
    radial = d / (r * root) * ((a**2 + r**2 + d**2) / near * ellipe(m) - ellipk(m))
    scale = MU_0 * coil.current_density * section / (2 * math.pi)
    return scale * (weights @ radial @ weights), scale * (weights @ axial @ weights)


@pytest.mark.parametrize("r, z", [(0.005, 0.01), (0.06, 0.0), (0.02, 0.045), (0.045, -0.03), (1.0, 0.5), (0.03, 3.0)])
def test_outside_it_is_the_field_of_its_loops(r, z):
    """Catches a slip in either closed form: loops share nothing with it but Biot and Savart."""
    expected = loops(COIL, r, z)
    size = math.hypot(*expected)
    for found, loop in zip(flux_density(COIL, r, z), expected, strict=True):
        assert abs(float(found) - loop) < 1e-9 * size


@pytest.mark.parametrize("z", [0.0, 0.0254, 0.1, -0.03])
def test_on_the_axis_it_is_the_closed_form(z):
    """Catches a field that the nearness of the axis spoils, or that divides by r there."""

    def half(length):
        ratio = (COIL.outer_radius + math.hypot(COIL.outer_radius, length)) / (
            COIL.inner_radius + math.hypot(COIL.inner_radius, length)
        )
        return length * math.log(ratio)

    expected = MU_0 * COIL.current_density / 2 * (half(0.0254 - z) + half(0.0254 + z))
    radial, axial = flux_density(COIL, 0.0, z)
    assert float(axial) == pytest.approx(expected, rel=1e-12)
    assert abs(float(radial)) < 1e-8 * expected


def test_inside_ampere_and_gauss_hold():
    """Catches a wrong branch of a logarithm or an arc tangent within the winding, where loops cannot be used.

    Around a square in the winding ∮ B dl = mu0 J area, and out of the ring that it makes flows no flux.
    """
    r, z, side = 0.022, 0.007, 0.004
    nodes, weights = leggauss(16)
    along = side / 2 * nodes
    low, high = (flux_density(COIL, r + along, z + sign * side / 2) for sign in (-1, 1))
    near, far = (flux_density(COIL, r + sign * side / 2, z + along) for sign in (-1, 1))
    circulation = side / 2 * (weights @ (high[0] - low[0]) + weights @ (near[1] - far[1]))
    assert circulation == pytest.approx(MU_0 * COIL.current_density * side**2, rel=1e-10)
    # The turn is from z to r, which is positive along +phi.
    outwards = weights @ ((high[1] - low[1]) * (r + along)) + weights @ (
        far[0] * (r + side / 2) - near[0] * (r - side / 2)
    )
    assert abs(outwards) < 1e-10 * r * float(np.abs(near[1]).max())


@pytest.mark.parametrize("name, r, z", [("skin", 0.0127, 0.004), ("end", 0.02, 0.0254), ("corner", 0.0381, 0.0254)])
def test_on_the_skin_it_is_the_limit_from_both_sides(name, r, z):
    """Catches a rule that misses the logarithm on the skin: B is continuous, its slope mu0 J ln(size/distance)."""
    there = np.array(flux_density(COIL, r, z))
    steps = (1e-4, 1e-6, 1e-8)
    for sign in (-1, 1):
        gaps = [np.abs(np.array(flux_density(COIL, r + sign * step, z + sign * step)) - there).max() for step in steps]
        assert all(after < before / 30 for before, after in pairwise(gaps))
        assert gaps[-1] < MU_0 * COIL.current_density * steps[-1] * math.log(COIL.inner_radius / steps[-1])


def test_the_quadrature_converges_and_its_default_has_converged():
    """Catches a default rule that is cut too short for the weakest digits of the worst place, the corner."""
    places = np.array([0.0127, 0.0381, 0.02, 0.05]), np.array([0.0254, -0.0254, 0.0254, 0.01])
    exact = np.array(flux_density(COIL, *places, nodes=200))
    errors = [np.abs(np.array(flux_density(COIL, *places, nodes=n)) - exact).max() for n in (16, 32, 64)]
    assert errors[1] < errors[0] / 30
    assert errors[2] < 1e-10 * np.abs(exact).max()


def test_the_published_inductance():
    """22.945 mH: 1000 turns on inner diameter 1 in, outer 3 in, length 2 in (the FEMM manual's example)."""
    current = COIL.current_density * 0.0254 * 0.0508 / 1000
    assert mutual_energy(COIL, COIL) / current**2 == pytest.approx(22.945e-3, abs=0.0005e-3)


def test_a_thin_solenoid_has_nagaokas_inductance():
    """Catches lost digits of thin windings. A solenoid as long as wide: L = K mu0 pi a^2 N^2/l with K = 0.688423.

    Nagaoka 1909, Journal of the College of Science, Tokyo, 27. The winding's thickness leaves K by nearly as much.
    """
    gaps = []
    for thickness in (1e-3, 1e-4, 1e-5):
        sheet = Coil("coil_1", 0.5 - thickness / 2, 0.5 + thickness / 2, -0.5, 0.5, 1 / thickness)
        gaps.append(0.688423 - float(mutual_energy(sheet, sheet)) / (MU_0 * math.pi * 0.25))
    assert gaps[0] / gaps[1] == pytest.approx(10, rel=0.02)
    assert abs(gaps[2]) < 1e-5


def test_the_mutual_energy_of_two_is_the_same_either_way():
    """Catches an asymmetry of the two closed integrals: one winding's radius is integrated numerically only."""
    for one, other in ((STORE[0], STORE[1]), (COIL, replace(COIL, lower=0.03, upper=0.05, current_density=-2e6))):
        assert mutual_energy(one, other) == pytest.approx(mutual_energy(other, one), rel=1e-11)


def test_far_apart_two_windings_are_dipoles():
    """Catches a wrong factor: M I1 I2 -> mu0 m1 m2 / (2 pi d^3) on a common axis."""
    distance = 4.0
    other = replace(COIL, lower=distance - 0.0254, upper=distance + 0.0254)
    moment = COIL.current_density * 0.0508 * math.pi * (0.0381**3 - 0.0127**3) / 3
    expected = MU_0 * moment**2 / (2 * math.pi * distance**3)
    assert mutual_energy(COIL, other) == pytest.approx(expected, rel=1e-3)


def test_the_energy_of_one_cut_in_two_is_that_of_the_whole():
    """Catches an error that touching windings make: their common skin is singular for both."""
    across = replace(COIL, outer_radius=0.03), replace(COIL, inner_radius=0.03)
    along = replace(COIL, upper=0.01), replace(COIL, lower=0.01)
    whole = stored_energy((COIL,))
    assert stored_energy(across) == pytest.approx(whole, rel=1e-10)
    assert stored_energy(along) == pytest.approx(whole, rel=1e-10)


def test_work_of_the_force_is_the_energys_derivative():
    """Catches a derivative along the imaginary axis that loses digits: F = J ∫ B_r dV = -d(M I1 I2)/dz, exactly."""
    other = replace(COIL, lower=0.03, upper=0.06)
    moved = mutual_energy(COIL, replace(other, lower=0.03 + 1e-30j, upper=0.06 + 1e-30j)).imag / 1e-30
    nodes, weights = leggauss(40)
    r = (0.0381 + 0.0127 + 0.0254 * nodes) / 2
    z = 0.045 + 0.015 * nodes
    radial, _ = flux_density(COIL, r[:, None] + 0 * z, z + 0 * r[:, None])
    # The force on the other along z is -J B_r; it does the work that a growing mutual energy at held currents is.
    force = -other.current_density * 2 * math.pi * 0.0127 * 0.015 * (weights * r) @ radial @ weights
    assert moved == pytest.approx(force, rel=1e-8)


def test_the_field_is_largest_on_the_skin():
    """Catches a quench limit held at the wrong place: nowhere in either winding of the store is |B| larger."""
    for i, coil in enumerate(STORE):
        spot = hottest(STORE, i)
        largest = float(magnitude(STORE, *place(coil, spot.side, spot.share)))
        share = (np.arange(60) + 0.5) / 60
        r = coil.inner_radius + share[:, None] * (coil.outer_radius - coil.inner_radius) + 0 * share
        z = coil.lower + share * (coil.upper - coil.lower) + 0 * share[:, None]
        inside = magnitude(STORE, r, z)
        assert 0.97 * largest < inside.max() < largest


def test_the_hottest_spot_is_a_maximum_to_ten_digits():
    """Catches a refinement that stops beside the maximum."""
    spot = hottest(STORE, 0)
    best = float(magnitude(STORE, *place(STORE[0], spot.side, spot.share)))
    around = magnitude(STORE, *place(STORE[0], spot.side, spot.share + np.linspace(-0.01, 0.01, 2001)))
    assert best >= around.max() * (1 - 1e-10)


def test_the_finite_elements_find_the_same_energy_and_field(tmp_path, capsys):
    """Catches an error that all closed forms share: the exported model, solved in open space, knows none of them."""
    store = Path(__file__).parents[2] / "examples" / "team22.toml"
    sizes = [f"actuator.coil_2.{name}" for name in ("radius=3.08 m", "half_height=0.239 m", "thickness=0.394 m")]
    changes = [word for size in sizes for word in ("--set", size)]
    assert main(["export", str(store), "--format", "fem", "-o", str(tmp_path), *changes]) == 0
    capsys.readouterr()
    (model,) = tmp_path.glob("*.fem")
    assert main(["solve", str(model), "--open-boundary", "--json", "--point", "0,0", "--point", "10000,4000"]) == 0
    found = json.loads(capsys.readouterr().out)
    figures = found["accuracy"]["figures"]
    assert figures["energy"]["relative"] < 1e-3
    assert abs(found["energy"] - float(stored_energy(STORE))) < 3 * figures["energy"]["error"]
    for point, place_ in zip(found["points"], ((0.0, 0.0), (10.0, 4.0)), strict=True):
        expected = sum(np.array(flux_density(coil, *place_)) for coil in STORE)
        assert np.abs(np.array(point["B"]) - expected).max() < 2e-3 * np.hypot(*expected)
