"""The exact values of docs/validation, each against a route of its own: quadrature, images, balance or a limit."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from scipy import integrate
from scipy.integrate import dblquad

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from exact import arrays, coils, cylinders, layers, loops, spheres, transverse, wires
from exact.loops import MU_0

INCH = 0.0254
COIL = coils.Coil(400, 2.0, 0.02, 0.03, -0.01, 0.01)
SMALL = coils.Coil(100, 3.0, 0.01, 0.02, 0.03, 0.05)


def quad(function: Callable[..., float], start: float, end: float) -> float:
    """An integral to 1e-10 of itself: the library's own absolute tolerance is far above fields in SI units."""
    return float(integrate.quad(function, start, end, epsabs=1e-14, epsrel=1e-10, limit=200)[0])


def loops_of(coil: coils.Coil, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Radii, heights and shares of the turns of a Gauss rule over a winding."""
    points, weights = np.polynomial.legendre.leggauss(count)
    r = (coil.inner + coil.outer) / 2 + (coil.outer - coil.inner) / 2 * points
    z = (coil.lower + coil.upper) / 2 + (coil.upper - coil.lower) / 2 * points
    radii, heights = np.meshgrid(r, z, indexing="ij")
    return radii.ravel(), heights.ravel(), (np.outer(weights, weights) / 4).ravel()


def test_loops_by_biot_and_savart() -> None:
    """Catches a wrong elliptic modulus: M by Neumann's integral, F by −dM/dz, B by Biot and Savart's sum."""
    a, b, z = 0.1, 0.07, 0.04
    neumann = quad(lambda t: np.cos(t) / np.sqrt(a**2 + b**2 + z**2 - 2 * a * b * np.cos(t)), 0, np.pi)
    assert loops.mutual_inductance(a, b, z) == pytest.approx(MU_0 * a * b * neumann, rel=1e-10)
    step = 1e-5
    slope = (loops.mutual_inductance(a, b, z + step) - loops.mutual_inductance(a, b, z - step)) / (2 * step)
    assert loops.force(a, b, z) == pytest.approx(-slope, rel=1e-7)
    angle = np.arange(2000) * np.pi / 1000
    place = np.array([0.03, 0.0, z])
    wire = a * np.column_stack((np.cos(angle), np.sin(angle), 0 * angle))
    along = a * np.pi / 1000 * np.column_stack((-np.sin(angle), np.cos(angle), 0 * angle))
    gap = place - wire
    field = MU_0 / (4 * np.pi) * np.sum(np.cross(along, gap) / np.linalg.norm(gap, axis=1)[:, None] ** 3, axis=0)
    assert loops.flux_density(a, 0.03, z) == pytest.approx(field[[0, 2]], rel=1e-9)


def test_loops_known_value_and_axis() -> None:
    """Catches a lost factor: the known M and F at a = b = z, and B on the axis."""
    assert loops.mutual_inductance(0.1, 0.1, 0.1) == pytest.approx(4.940784631e-8, rel=1e-9)
    assert loops.force(0.1, 0.1, 0.1) == pytest.approx(7.183656729e-7, rel=1e-9)
    exact = MU_0 * 0.1**2 / (2 * (0.1**2 + 0.05**2) ** 1.5)
    assert loops.flux_density(0.1, [0.0, 1e-9], 0.05)[:, 1] == pytest.approx(exact, rel=1e-9)


def test_sheet_by_loops() -> None:
    """Catches a wrong term of Derby and Olbert: a sheet's field is that of its loops, inside and outside."""
    for r, z in ((0.0, 0.0), (0.013, 0.004), (0.03, 0.001), (0.021, 0.05)):

        def of_loop(h: float, k: int, r: float = r, z: float = z) -> float:
            return float(loops.flux_density(0.02, r, z - h)[k])

        summed = [quad(partial(of_loop, k=k), -0.03, 0.03) for k in (0, 1)]
        assert MU_0 * cylinders.sheet_flux_density(0.02, 0.03, r, z) == pytest.approx(np.array(summed), rel=1e-8)


def test_magnet_on_and_off_its_axis() -> None:
    """Catches a magnet that is not the sheet: closed form on the axis, no divergence off it."""
    on_axis = cylinders.magnet_flux_density(1.2, 0.01, 0.02, 0.0, [0.0, 0.005, 0.02])[:, 1]
    assert on_axis == pytest.approx(cylinders.magnet_flux_density_on_axis(1.2, 0.01, 0.02, [0.0, 0.005, 0.02]))
    flux_out = quad(lambda r: 2 * np.pi * r * cylinders.magnet_flux_density(1.2, 0.01, 0.02, r, 0.015)[1], 0, 0.03)
    flux_in = quad(lambda r: 2 * np.pi * r * cylinders.magnet_flux_density(1.2, 0.01, 0.02, r, 0.012)[1], 0, 0.03)
    side = quad(lambda z: 2 * np.pi * 0.03 * cylinders.magnet_flux_density(1.2, 0.01, 0.02, 0.03, z)[0], 0.012, 0.015)
    assert flux_out - flux_in + side == pytest.approx(0.0, abs=1e-11)


@pytest.mark.parametrize(("other", "known"), [((1.3, 0.02, 0.04), 265.537), ((1.3, 0.015, 0.03), 111.490)])
def test_magnet_force_by_currents_and_by_charges(other: cylinders.Cylinder, known: float) -> None:
    """Catches a force that holds in one picture of a magnet only."""
    one = (1.3, 0.02, 0.04)
    by_currents = cylinders.magnet_force(one, other, 0.05)
    assert by_currents == pytest.approx(known, abs=5e-4)
    assert cylinders.magnet_force_of_discs(one, other, 0.05) == pytest.approx(by_currents, rel=1e-9)


def test_nagaoka_by_sheets() -> None:
    """Catches a misremembered coefficient: its table's value, and the linkage of two sheets."""
    assert cylinders.nagaoka(1.0) == pytest.approx(0.688423, abs=5e-7)
    radius, length = 0.02, 0.08
    twice = 2 * quad(lambda u: (length - u) * loops.mutual_inductance(radius, radius, u), 0, length)
    ideal = MU_0 * np.pi * radius**2 * length
    assert cylinders.nagaoka(2 * radius / length) == pytest.approx(twice / ideal, rel=1e-7)


def test_thick_coil_inductance() -> None:
    """Catches a lost factor in the Bessel integral: the known 22.945 mH, and filaments with Maxwell's self-term."""
    known = coils.Coil(1000, 1.0, INCH / 2, 1.5 * INCH, -INCH, INCH)
    assert coils.inductance(known, known) == pytest.approx(22.945e-3, abs=5e-7)
    across = 24
    side = 0.01 / across
    r, z = np.meshgrid(0.02 + side * (np.arange(across) + 0.5), side * (np.arange(2 * across) + 0.5))
    r, z = r.ravel(), z.ravel()
    apart = z[:, None] - z + np.eye(r.size)  # the diagonal is replaced below
    table = loops.mutual_inductance(r[:, None], r, apart)
    np.fill_diagonal(table, MU_0 * r * (np.log(8 * r / (0.44705 * side)) - 2))
    assert coils.inductance(COIL, COIL) == pytest.approx(400**2 * table.mean(), rel=2e-4)


def test_thick_coil_is_thin_in_the_limit() -> None:
    """Catches a self-inductance that is right for one shape only."""
    thin = coils.Coil(50, 1.0, 0.0199, 0.0201, -0.02, 0.02)
    sheet = MU_0 * 50**2 * np.pi * 0.02**2 / 0.04 * cylinders.nagaoka(1.0)
    assert coils.inductance(thin, thin) == pytest.approx(sheet, rel=5e-3)


def test_thick_coil_field_by_loops() -> None:
    """Catches a wrong cut at the point's own radius: outside against loops, inside by Ampère's law."""
    assert coils.coil_flux_density((COIL,), 0.0, 0.0)[1] == pytest.approx(0.018840, abs=5e-7)
    r, z, share = loops_of(COIL, 24)
    for at in ((0.005, 0.002), (0.045, 0.005), (0.02, 0.03)):
        summed = 800 * share @ loops.flux_density(r, at[0], at[1] - z)
        assert coils.coil_flux_density((COIL,), *at) == pytest.approx(summed, rel=1e-8)

    def axial(r: float, z: float) -> float:
        return float(coils.coil_flux_density((COIL,), r, z)[1])

    def radial(z: float, r: float) -> float:
        return float(coils.coil_flux_density((COIL,), r, z)[0])

    points, weights = np.polynomial.legendre.leggauss(6)
    z_path, r_path = 0.004 + 0.003 * points, 0.025 + 0.002 * points
    around = 0.003 * sum(w * (axial(0.023, s) - axial(0.027, s)) for w, s in zip(weights, z_path, strict=True))
    around += 0.002 * sum(w * (radial(0.007, s) - radial(0.001, s)) for w, s in zip(weights, r_path, strict=True))
    assert around == pytest.approx(MU_0 * COIL.current_density * 0.006 * 0.004, rel=1e-8)


def test_coils_mutual_inductance_and_force_by_loops() -> None:
    """Catches a sign or a factor: the Bessel integrals against Maxwell's loops, and action against reaction."""
    a, y, u = loops_of(COIL, 12)
    b, z, v = loops_of(SMALL, 12)
    shares = np.outer(u, v)
    mutual = 40000 * np.sum(shares * loops.mutual_inductance(a[:, None], b, z - y[:, None]))
    assert coils.inductance(COIL, SMALL) == pytest.approx(mutual, rel=1e-8)
    pull = 40000 * 6 * np.sum(shares * loops.force(a[:, None], b, z - y[:, None]))
    assert coils.attraction(COIL, SMALL) == pytest.approx(pull, rel=1e-8)
    assert coils.attraction(SMALL, COIL) == pytest.approx(-pull, rel=1e-8)


def test_spheres_conditions_at_the_surface() -> None:
    """Catches a wrong moment: B_n and H_t do not jump on an iron sphere; B_n does not on a magnet."""
    angle, radius, mu_r = 0.7, 0.01, 50.0
    normal, tangent = np.array([np.sin(angle), np.cos(angle)]), np.array([np.cos(angle), -np.sin(angle)])
    inside, outside = ((1 + e) * radius * normal for e in (-1e-9, 1e-9))
    b_in = spheres.iron_sphere_flux_density(mu_r, 0.1, radius, *inside)
    b_out = spheres.iron_sphere_flux_density(mu_r, 0.1, radius, *outside)
    assert b_in @ normal == pytest.approx(b_out @ normal, rel=1e-7)
    assert b_in @ tangent / mu_r == pytest.approx(b_out @ tangent, rel=1e-7)
    b_in = spheres.magnetised_sphere_flux_density(1.2, radius, *inside)
    b_out = spheres.magnetised_sphere_flux_density(1.2, radius, *outside)
    assert b_in @ normal == pytest.approx(b_out @ normal, rel=1e-7)
    assert (b_in - np.array([0, 1.2])) @ tangent == pytest.approx(b_out @ tangent, rel=1e-7)


def test_ball_and_coil_by_the_force_on_the_coil() -> None:
    """Catches a wrong multipole: what pulls the ball pulls the coil the other way, by J × B of the ball's field."""
    coil = coils.Coil(300, 2.0, 0.012, 0.02, 0.015, 0.025)
    pull = spheres.force_on_sphere(coil, 1000.0, 0.01)
    c = spheres.multipoles(coil, 30)
    on_axis = MU_0 * sum(-n * c[n] * 0.003 ** (n - 1) for n in range(1, 31))
    assert coils.coil_flux_density((coil,), 0.0, 0.003)[1] == pytest.approx(on_axis, rel=1e-8)
    d = spheres.induced(c, 1000.0, 0.01)
    r, z, share = loops_of(coil, 12)
    radial = np.array([spheres.induced_flux_density(d, float(p), float(q))[0] for p, q in zip(r, z, strict=True)])
    assert pull == pytest.approx(600 * np.sum(2 * np.pi * r * share * radial), rel=1e-8)
    assert pull > 0  # towards the coil, which is above


def test_confined_wire() -> None:
    """Catches a wrong image: A = 0 all round the circle, B is the curl of A, the force pushes to the middle."""
    offset, radius = 0.004, 0.02
    rim = radius * np.exp(1j * np.linspace(0, 6, 7))
    assert [wires.confined_potential(5.0, offset, radius, at) for at in rim] == pytest.approx([0.0] * 7, abs=1e-18)
    everything = ((5.0, complex(offset)), *wires.confined_images(5.0, offset, radius))
    at, step = 0.007 + 0.005j, 1e-7

    def a(z: complex) -> float:
        return wires.confined_potential(5.0, offset, radius, z)

    curl = ((a(at + 1j * step) - a(at - 1j * step)) - 1j * (a(at + step) - a(at - step))) / (2 * step)
    assert wires.flux_density(everything, at) == pytest.approx(curl, rel=1e-6)
    assert wires.force(everything[1:], everything[:1]).real < 0
    # The energy falls along the push at constant current: F = I²/2 dL/dd.
    slope = (
        wires.confined_inductance(0.001, offset + step, radius)
        - wires.confined_inductance(0.001, offset - step, radius)
    ) / (2 * step)
    assert wires.force(everything[1:], everything[:1]).real == pytest.approx(12.5 * slope, rel=1e-6)


def test_wires_pair() -> None:
    """Catches a factor of two between force and inductance: F = −I²/2 dL/dd for a pair out and back."""
    step = 1e-6
    slope = (wires.pair_inductance(0.002, 0.02 + step) - wires.pair_inductance(0.002, 0.02 - step)) / (2 * step)
    assert wires.pair_force(10.0, -10.0, 0.02) == pytest.approx(-100 / 2 * slope, rel=1e-6)
    pull = wires.force(((10.0, 0.02 + 0j),), ((10.0, 0j),))
    assert pull == pytest.approx(wires.pair_force(10.0, 10.0, 0.02), rel=1e-12)


def test_wires_beside_iron() -> None:
    """Catches a wrong image in iron: B_n and H_t do not jump at the cylinder's face."""
    sources = ((100.0, 0.02 + 0j), (-100.0, 0.03 + 0.004j))
    mu_r, radius = 200.0, 0.01
    for angle in (0.2, 1.4, 3.0):
        normal = np.exp(1j * angle)
        outside = wires.flux_density((*sources, *wires.iron_images(sources, mu_r, radius)), radius * normal)
        inside = wires.iron_inside(mu_r) * wires.flux_density(sources, radius * normal)
        local_in, local_out = inside * np.conj(normal), outside * np.conj(normal)
        assert local_in.real == pytest.approx(local_out.real, rel=1e-9)
        assert local_in.imag / mu_r == pytest.approx(local_out.imag, rel=1e-9)


def test_coaxial_cable_by_its_energy() -> None:
    """Catches a wrong term of the shell: L = 2W/I² with W from B."""
    core, inner, outer = 0.002, 0.006, 0.007

    def density(r: float) -> float:
        return 2 * np.pi * r * wires.coaxial_flux_density(1.0, core, inner, outer, r) ** 2 / MU_0

    energy = sum(quad(density, a, b) for a, b in ((1e-12, core), (core, inner), (inner, outer)))
    assert wires.coaxial_inductance(core, inner, outer) == pytest.approx(energy, rel=1e-8)


def test_cylinders_across_conditions_at_the_surface() -> None:
    """Catches a conjugate too many: normal and tangential field at the face of a magnet and of iron."""
    normal = np.exp(0.6j)
    inside, outside = ((1 + e) * 0.01 * normal for e in (-1e-9, 1e-9))
    br = 1.2 * np.exp(0.3j)
    jump = (
        transverse.magnetised_cylinder(br, 0.01, outside) - transverse.magnetised_cylinder(br, 0.01, inside)
    ) * np.conj(normal)
    assert jump.real == pytest.approx(0.0, abs=1e-8)
    assert jump.imag == pytest.approx(-(br * np.conj(normal)).imag, rel=1e-6)
    b_in = transverse.iron_cylinder(30.0, 0.1, 0.01, 0.05, inside) * np.conj(normal)
    b_out = transverse.iron_cylinder(30.0, 0.1, 0.01, 0.05, outside) * np.conj(normal)
    assert b_in.real == pytest.approx(b_out.real, rel=1e-7)
    assert b_in.imag / 30 == pytest.approx(b_out.imag, rel=1e-6)
    # The flux through the half circle at the boundary is that of A = B0 y.
    flux = quad(
        lambda t: (
            0.05 * (transverse.iron_cylinder(30.0, 0.1, 0.01, 0.05, 0.05 * np.exp(1j * t)) * np.exp(-1j * t)).real
        ),
        -np.pi / 2,
        np.pi / 2,
    )
    assert flux == pytest.approx(0.1 * 0.1, rel=1e-9)


def test_halbach_cylinder_by_charges() -> None:
    """Catches ln(ro/ri) from memory: the field at the centre of all volume and surface charge of M(cos, sin)."""
    inner, outer, remanence = 0.01, 0.025, 1.2

    def share(r: float, density: float) -> float:
        """B_x at the centre of a cosine of charge on a circle: −density/2, whatever its radius."""
        return quad(lambda t: -density * np.cos(t) ** 2 * r / (2 * np.pi * r), 0, 2 * np.pi)

    volume = quad(lambda r: share(r, -2 * remanence / r), inner, outer)
    total = volume + share(outer, remanence) + share(inner, -remanence)
    assert transverse.halbach_cylinder(remanence, inner, outer) == pytest.approx(total, rel=1e-9)


def test_torque_by_the_moment_of_surface_currents() -> None:
    """Catches a wrong area or sign: ∮ x × (K × B) with K = M_t on the cylinder's face."""
    br, radius, field, angle = 1.2, 0.01, 0.1, 0.8

    def moment(t: float) -> float:
        current = br / MU_0 * np.sin(t)  # M × n, out of the page, with M along x
        push = 1j * current * field * np.exp(1j * angle)
        return float((np.conj(radius * np.exp(1j * t)) * push).imag * radius)

    by_currents = quad(moment, 0, 2 * np.pi)
    assert transverse.torque(br, radius, field, angle) == pytest.approx(by_currents, rel=1e-9)
    assert transverse.torque(br, radius, field, angle) > 0  # M turns towards B


def test_halbach_array_by_charges() -> None:
    """Catches the strong side mistaken: the field of the top's, bottom's and volume's charge waves."""
    br, wavelength, height = 1.2, 0.02, 0.004
    k = 2 * np.pi / wavelength
    x, above = 0.0033, 0.002

    def wave(depth: float, amplitude: float) -> float:
        """B_y of a sheet of charge amplitude cos kx, `depth` below: half of it, fading."""
        return amplitude / 2 * np.exp(-k * depth) * np.cos(k * x)

    total = wave(above, br) + wave(above + height, -br) + quad(lambda y: wave(above + y, br * k), 0, height)
    assert arrays.halbach_array(br, wavelength, height, x, above)[1] == pytest.approx(total, rel=1e-9)


def test_slotless_machine_by_line_charges() -> None:
    """Catches a wrong series: strips of charge between two plates of zero potential, by conformal mapping."""
    machine = arrays.Slotless(1.2, 1.0, 0.012, 0.7, 0.004, 0.01)
    x, y, gap, source = 0.0045, 0.0075, 0.01, 0.004

    def upward(at: float) -> float:
        """H_y of a unit line charge at height `source` between grounded plates."""
        u = np.pi * (x - at) / gap
        plus, minus = np.pi * (y + source) / gap, np.pi * (y - source) / gap
        up = np.sin(plus) / (np.cosh(u) - np.cos(plus)) - np.sin(minus) / (np.cosh(u) - np.cos(minus))
        return float(-up / (4 * gap))

    half = 0.7 * 0.012 / 2
    total = sum((-1) ** n * quad(upward, n * 0.012 - half, n * 0.012 + half) for n in range(-6, 7))
    assert machine.flux_density(x, y)[1] == pytest.approx(1.2 * total, rel=1e-7)


def test_slotless_machine_force_and_potential() -> None:
    """Catches a thrust that is not J × B, and A that is not B's potential."""
    machine = arrays.Slotless(1.2, 1.05, 0.012, 1.0, 0.004, 0.01)
    x, y = (0.003, 0.008), (0.006, 0.009)
    by_field = dblquad(lambda v, u: machine.flux_density(u, v)[1], *x, *y, epsrel=1e-8)[0]
    assert machine.thrust(200.0, x, y) == pytest.approx(-200.0 / (0.005 * 0.003) * by_field, rel=1e-7)
    step = 1e-7
    slope = (machine.potential(0.004 + step, 0.007) - machine.potential(0.004 - step, 0.007)) / (2 * step)
    assert machine.flux_density(0.004, 0.007)[1] == pytest.approx(-slope, rel=1e-6)


def test_steel_law() -> None:
    """Catches an energy that is not the area beside its curve, and a table that is not the law."""
    steel = layers.Steel()
    assert steel.coenergy(5e3) == pytest.approx(quad(steel.flux_density, 0, 5e3), rel=1e-8)
    assert steel.energy(5e3) == pytest.approx(quad(steel.field, 0, steel.flux_density(5e3)), rel=1e-6)
    rows = np.array(steel.table())
    assert np.all(np.diff(rows, axis=0) > 0)
    assert np.all(np.diff(rows[:, 0]) / np.diff(rows[:, 1]) > MU_0)


def test_long_solenoid_balance() -> None:
    """Catches a linkage without the winding's share: energy + coenergy = I λ per metre, for any steel."""
    solenoid = layers.LongSolenoid(layers.Steel(), 8e3, 0.01, 0.011, 0.015)
    assert sum(solenoid.energies()) == pytest.approx(8e3 * solenoid.flux_per_turn(), rel=1e-9)


def test_ring_balance() -> None:
    """Catches a wrong volume element: energy + coenergy = I × flux around a wire."""
    flux, energy, coenergy = layers.ring(layers.Steel(), 300.0, 0.01, 0.03)
    assert energy + coenergy == pytest.approx(300.0 * flux, rel=1e-9)


def test_stacked_sheets() -> None:
    """Catches the two directions swapped: along the sheets they carry in parallel, across them in series."""
    assert layers.stacked(1000.0, 1.0, along=True) == layers.stacked(1000.0, 1.0, along=False) == 1000.0
    assert layers.stacked(1000.0, 0.9, along=True) == pytest.approx(900.1)
    assert layers.stacked(1e12, 0.9, along=False) == pytest.approx(10.0)


def test_mixed_slab() -> None:
    """Catches a sign of the mixed condition, and B that is not −dA/dx."""
    density, width, c0, c1 = 1e6, 0.02, 2e6, 500.0

    def a(x: float) -> float:
        return layers.mixed_slab(density, width, c0, c1, x)[0]

    edge, field = layers.mixed_slab(density, width, c0, c1, width)
    assert -field / MU_0 + c0 * edge + c1 == pytest.approx(0.0, abs=1e-9 * abs(field / MU_0))
    assert (a(0.011) - a(0.009)) / 0.002 == pytest.approx(-layers.mixed_slab(density, width, c0, c1, 0.01)[1], rel=1e-9)
    assert a(0.0) == 0.0


def test_magnet_and_coil_by_lorentz() -> None:
    """Catches a sign of the end loops: F = −J ∫ B_r of the magnet over the winding, and 2π r A of its flux."""
    coil, magnet = coils.Coil(200, 2.0, 0.012, 0.016, 0.004, 0.014), (1.2, 0.01, 0.02)
    r, z, share = loops_of(coil, 16)
    radial = cylinders.magnet_flux_density(*magnet, r, z)[:, 0]
    assert coils.force_by_magnet(coil, *magnet) == pytest.approx(
        -400 * np.sum(2 * np.pi * r * share * radial), rel=1e-8
    )
    step = 1e-6
    ends = [
        coils.linkage_by_magnet(coils.Coil(200, 2.0, 0.012, 0.016, 0.004 + h, 0.014 + h), *magnet)
        for h in (-step, step)
    ]
    assert coils.force_by_magnet(coil, *magnet) == pytest.approx(2 * (ends[1] - ends[0]) / (2 * step), rel=1e-5)
    thin = coils.Coil(1, 1.0, 0.01399, 0.01401, 0.00499, 0.00501)
    through = quad(lambda r: 2 * np.pi * r * float(cylinders.magnet_flux_density(*magnet, r, 0.005)[1]), 1e-9, 0.01)
    through += quad(lambda r: 2 * np.pi * r * float(cylinders.magnet_flux_density(*magnet, r, 0.005)[1]), 0.01, 0.014)
    assert coils.linkage_by_magnet(thin, *magnet) == pytest.approx(through, rel=1e-5)
