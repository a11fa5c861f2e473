"""Rates on general meshes: curves, axis, saturation, every condition, and forces, each against an exact field."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest
from manufactured import (
    circle,
    field_error,
    levels,
    manufactured,
    misses,
    over_disc,
    over_rectangle,
    polygon,
    rates,
    slope,
    solved_levels,
)

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases import Case, air_coils, conductors, iron, magnets
from cases.exterior import with_exterior
from exact import layers, transverse

from fluxbore.design.bh_curve import BHCurve
from fluxbore.fem.body_force import stress_force
from fluxbore.fem.conditions import Conditions, Mixed, Prescribed
from fluxbore.fem.energy import energies
from fluxbore.fem.linkage import flux_linkages
from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.mesh import Floats
from fluxbore.fem.outline import Curve, Outline, Pair, Seed
from fluxbore.fem.problem import MagneticMaterial
from fluxbore.fem.reluctivity import STEP, ReluctivityCurve, reluctivity_curve
from fluxbore.fem.weight import layer_weight, smooth_weight

ENERGY = 3.8
"""Least rate of energies and linkages, four in theory."""
FORCE = 2.5
FIELD = 1.9
"""Least rate of B in the elements, two in theory."""

UNIT = (MagneticMaterial(1.0),)

NOTHING = Conditions([Prescribed(lambda points: np.zeros(points.shape[0]))])
"""Condition 0: no flux crosses."""


# A planar field, zero on the rim of the unit square, without a symmetry that might help.


def wave(points: Floats) -> Floats:
    x, y = points[..., 0], points[..., 1]
    return np.asarray(np.sin(np.pi * x) * np.sin(np.pi * y) * np.exp(x))


def wave_field(points: Floats) -> Floats:
    """(∂A/∂y, −∂A/∂x)."""
    x, y = points[..., 0], points[..., 1]
    s, c = np.sin(np.pi * x), np.cos(np.pi * x)
    along = np.pi * s * np.cos(np.pi * y)
    across = -(np.pi * c + s) * np.sin(np.pi * y)
    return np.stack((along, across), axis=-1) * np.exp(x)[..., None]


def wave_density(points: Floats) -> Floats:
    """−ΔA, with ν = 1."""
    x, y = points[..., 0], points[..., 1]
    s, c = np.sin(np.pi * x), np.cos(np.pi * x)
    return np.asarray(((2 * np.pi**2 - 1) * s - 2 * np.pi * c) * np.sin(np.pi * y) * np.exp(x))


def square() -> Outline:
    """The unit square, region 0, with a disc inside, region 1."""
    corners = [(0, 0), (1, 0), (1, 1), (0, 1), (0.25, 0.45), (0.65, 0.45)]
    curves = (*polygon(0, 4, 0), *circle(4, size=0.1))
    return Outline("planar", np.array(corners, dtype=float), curves, (Seed((0.1, 0.1), 0), Seed((0.45, 0.45), 1)))


INNER = (0.45, 0.45), 0.2


@cache
def planar() -> list[Solution]:
    return [manufactured(level, UNIT * 2, wave_density, 1) for level in levels(square(), NOTHING, 4)]


def test_energy_and_linkage_of_a_planar_mesh() -> None:
    """Catches a lost order of the element, of its numbering on general meshes, or of a coil with a round border."""
    stored = over_rectangle(lambda p: np.sum(wave_field(p) ** 2, axis=-1) / 2, (0, 1), (0, 1))
    linked = over_disc(wave, *INNER)
    errors = np.array([(energies(s)[0] / stored - 1, flux_linkages(s)[0] / linked - 1) for s in planar()])
    assert np.all(rates(errors[:, 0]) > ENERGY), errors
    assert np.all(rates(errors[:, 1]) > ENERGY), errors
    assert np.all(rates([field_error(s, wave_field) for s in planar()]) > FIELD)


def test_recovered_field_is_better_than_the_elements_own() -> None:
    """Catches a recovery of low order, on which every estimate rests: half an order more, and half of the error."""
    own, better = ([field_error(s, wave_field, recovers) for s in planar()] for recovers in (False, True))
    assert slope(better) > FIELD + 0.5, better
    assert better[-1] < own[-1] / 2


# The same on a disc, so that the rim is curved: A = (1 − r²) exp(x).


def hill(points: Floats) -> Floats:
    x, y = points[..., 0], points[..., 1]
    return np.asarray((1 - x**2 - y**2) * np.exp(x))


def hill_field(points: Floats) -> Floats:
    x, y = points[..., 0], points[..., 1]
    return np.stack((-2 * y, 2 * x - (1 - x**2 - y**2)), axis=-1) * np.exp(x)[..., None]


def hill_density(points: Floats) -> Floats:
    x, y = points[..., 0], points[..., 1]
    return np.asarray((4 + 4 * x - (1 - x**2 - y**2)) * np.exp(x))


def test_curved_boundary_keeps_the_order() -> None:
    """Catches straight edges on arcs, which would make these rates two and three halves."""
    points = np.array([(-1, 0), (1, 0), (0.1, 0.3), (0.5, 0.3)], dtype=float)
    outline = Outline("planar", points, (*circle(0, 0), *circle(2)), (Seed((0, -0.5), 0), Seed((0.3, 0.3), 1)))
    stored = over_disc(lambda p: np.sum(hill_field(p) ** 2, axis=-1) / 2, (0, 0), 1)
    linked = over_disc(hill, (0.3, 0.3), 0.2)
    solved = [manufactured(level, UNIT * 2, hill_density, 1) for level in levels(outline, NOTHING, 3)]
    errors = np.array([(energies(s)[0] / stored - 1, flux_linkages(s)[0] / linked - 1) for s in solved])
    assert np.all(rates(errors[:, 0]) > ENERGY), errors
    assert np.all(rates(errors[:, 1]) > ENERGY), errors
    assert np.all(rates([field_error(s, hill_field) for s in solved]) > FIELD)


# A ball about the axis: ψ = s (1 − r² − z²) exp(z), s = r²/2.


def ball_potential(points: Floats) -> Floats:
    r, z = points[..., 0], points[..., 1]
    return np.asarray(r**2 / 2 * (1 - r**2 - z**2) * np.exp(z))


def ball_field(points: Floats) -> Floats:
    """(−(∂ψ/∂z)/r, ∂ψ/∂s)."""
    r, z = points[..., 0], points[..., 1]
    rest = 1 - r**2 - z**2
    return np.stack((-r / 2 * (rest - 2 * z), rest - r**2), axis=-1) * np.exp(z)[..., None]


def ball_density(points: Floats) -> Floats:
    """J/r = −∂²ψ/∂s² − (∂²ψ/∂z²)/(2s)."""
    r, z = points[..., 0], points[..., 1]
    return np.asarray((4 - (1 - r**2 - z**2 - 4 * z - 2) / 2) * np.exp(z))


SPHERE = Curve(1, 2, np.pi)
DOUBLE_CONE = Curve(1, 4), Curve(4, 2, 1.2)
"""A sloped and a curved face that meet the axis."""


def ball(*body: Curve) -> Outline:
    """A half disc, region 0; a body on the axis, 1; a round coil beside it, 2."""
    points = [(0, -1), (0, -0.4), (0, 0.4), (0, 1), (0.4, 0.1), (0.55, -0.3), (0.75, -0.3)]
    lines = Curve(0, 1), Curve(1, 2), Curve(2, 3), *body, *circle(5), Curve(0, 3, np.pi, condition=0)
    seeds = Seed((0.7, 0.4), 0), Seed((0.1, 0.0), 1), Seed((0.65, -0.3), 2)
    return Outline("axisymmetric", np.array(points, dtype=float), lines, seeds)


@cache
def around_axis() -> list[Solution]:
    return [manufactured(level, UNIT * 3, ball_density, 2) for level in levels(ball(SPHERE), NOTHING, 4)]


def test_energy_and_linkage_around_the_axis() -> None:
    """Catches an order lost in 1/r, on curved edges that touch the axis, on the sphere around, or in a round coil."""
    stored = 2 * np.pi * over_disc(lambda p: np.sum(ball_field(p) ** 2, axis=-1) / 2 * p[..., 0], (0, 0), 1, half=True)
    errors = np.array([(energies(s)[0] / stored - 1, linkage_error(s)) for s in around_axis()])
    assert slope(errors[:, 0]) > ENERGY, errors
    assert slope(errors[:, 1]) > ENERGY - 0.3, errors
    assert slope([field_error(s, ball_field) for s in around_axis()]) > FIELD - 0.05


def linkage_error(solution: Solution) -> float:
    """Of the round coil, relative."""
    exact = 2 * np.pi * over_disc(ball_potential, (0.65, -0.3), 0.1)
    return float(flux_linkages(solution)[0]) / exact - 1


def errors_by_ring(solutions: list[Solution]) -> tuple[list[float], list[float], list[float]]:
    """Root mean squares of |B_h − B| in elements that touch the axis, in their neighbours, and in all others."""
    found: tuple[list[float], list[float], list[float]] = [], [], []
    for solution in solutions:
        miss, weight = misses(solution, ball_field)
        corners = solution.problem.mesh.elements[:, :3]
        touching = np.any(solution.problem.mesh.nodes[corners, 0] <= 0, axis=1)
        beside = np.any(np.isin(corners, corners[touching]), axis=1) & ~touching
        for part, errors in zip((touching, beside, ~touching & ~beside), found, strict=True):
            errors.append(float(np.sqrt(np.sum((weight * miss)[part]) / np.sum(weight[part]))))
    return found


def test_field_on_the_axis_is_as_good_as_elsewhere() -> None:
    """Catches elements of low order where people look first: those in (r, z) have a rate of one."""
    on_axis, _, away = errors_by_ring(around_axis())
    assert slope(on_axis) > FIELD - 0.1, on_axis
    assert slope(away) > FIELD - 0.1, away
    assert on_axis[-1] < 2 * away[-1]


def test_field_near_the_axis_keeps_its_order() -> None:
    """Catches elements on the axis, or their neighbours, losing an order: the last rates, where it shows."""
    for errors in errors_by_ring(around_axis()):
        assert rates(errors)[-1] > FIELD - 0.05, errors


def driven_by_magnets(outline: Outline, reluctivities: tuple[float, ...], count: int) -> list[Solution]:
    """The ball's field in materials that jump, kept up by magnets with H_c = ν B, so that H = 0 everywhere."""

    def magnet(reluctivity: float) -> MagneticMaterial:
        return MagneticMaterial(reluctivity, lambda points: reluctivity * ball_field(points))

    materials = [magnet(reluctivity) for reluctivity in reluctivities]
    return [manufactured(level, materials, None, 2) for level in levels(outline, NOTHING, count)]


def test_iron_with_sloped_and_curved_faces_on_the_axis() -> None:
    """Catches faces of iron, 1000 to one, that cost an order. In the one element at the tip of each it is the first."""
    solved = driven_by_magnets(ball(*DOUBLE_CONE), (1.0, 1e-3, 1.0), 3)
    assert slope([field_error(s, ball_field) for s in solved]) > FIELD - 0.05
    on_axis, _, _ = errors_by_ring(solved)
    assert slope(on_axis) > 1.4, on_axis


def test_linkage_of_a_coil_keeps_its_order() -> None:
    """Catches what little of the order is lost near the axis, with and without iron there."""
    magnetic = driven_by_magnets(ball(*DOUBLE_CONE), (1.0, 1e-3, 1.0), 4)
    for solved in (around_axis(), magnetic):
        assert slope([linkage_error(s) for s in solved]) > ENERGY


@dataclass(frozen=True)
class Ball:
    """A sphere of permeability mu in a field of 1 T along z, or a magnet of remanence 1 T by itself, mu = 0; ν0 = 1."""

    mu: float
    radius: float = 0.4

    @property
    def inside(self) -> float:
        return 3 * self.mu / (self.mu + 2) if self.mu else 2 / 3

    @property
    def outside(self) -> float:
        return 1.0 if self.mu else 0.0

    @property
    def dipole(self) -> float:
        return (self.mu - 1) / (self.mu + 2) if self.mu else 1 / 3

    def field(self, points: Floats) -> Floats:
        r, z = points[..., 0], points[..., 1]
        distance = np.maximum(np.hypot(r, z), self.radius)
        away = np.stack((3 * r * z, 3 * z**2 - distance**2), axis=-1) / distance[..., None] ** 2
        around = away * self.dipole * ((self.radius / distance) ** 3)[..., None] + (0.0, self.outside)
        within = np.broadcast_to((0.0, self.inside), around.shape)
        return np.where((np.hypot(r, z) < self.radius)[..., None], within, around)

    def potential(self, points: Floats) -> Floats:
        """A_φ outside."""
        return np.asarray(
            points[:, 0] / 2 * (self.outside + 2 * self.dipole * (self.radius / np.hypot(*points.T)) ** 3)
        )

    def energy(self, far: float) -> float:
        """Up to a radius: that of a magnet is counted from its remanence."""

        def shell(at: Floats) -> Floats:
            distance, angle = at[..., 0], at[..., 1]
            points = np.stack((distance * np.sin(angle), distance * np.cos(angle)), axis=-1)
            return np.asarray(np.pi * np.sum(self.field(points) ** 2, axis=-1) * points[..., 0] * distance)

        own = self.inside**2 / self.mu if self.mu else (1 - self.inside) ** 2
        return over_rectangle(shell, (self.radius, far), (0, np.pi)) + 2 / 3 * np.pi * self.radius**3 * own

    def solved(self, count: int) -> list[Solution]:
        points = np.array([(0, -1), (0, -self.radius), (0, self.radius), (0, 1)])
        curves = Curve(0, 1), Curve(1, 2), Curve(2, 3), Curve(1, 2, np.pi), Curve(0, 3, np.pi, condition=0)
        outline = Outline("axisymmetric", points, curves, (Seed((0.7, 0.0), 0), Seed((0.1, 0.0), 1)))
        core = MagneticMaterial(1 / self.mu) if self.mu else MagneticMaterial.magnet((0.0, 1.0), 1.0)
        far = Conditions([Prescribed(self.potential)])
        return [manufactured(level, (*UNIT, core)) for level in levels(outline, far, count)]


@pytest.mark.parametrize("mu", [0.0, 5.0, 1000.0])
def test_sphere(mu: float) -> None:
    """Catches a sphere's face that costs an order: iron in a field, and a magnet (0). Three halves without its arc."""
    body = Ball(mu)
    solved = body.solved(3)
    assert slope([energies(s)[0] / body.energy(1.0) - 1 for s in solved]) > ENERGY
    assert slope([field_error(s, body.field) for s in solved]) > FIELD - 0.1


def test_energy_of_a_sphere() -> None:
    """Catches what little of the order is lost near the axis."""
    body = Ball(5.0)
    assert slope([energies(s)[0] / body.energy(1.0) - 1 for s in body.solved(4)[1:]]) > ENERGY


def test_cylinder_in_a_uniform_field() -> None:
    """Catches a round face of planar iron, or prescribed A on a round rim, that costs an order; μ_r = 500."""

    def exact(points: Floats) -> Floats:
        flat = (points[..., 0] + 1j * points[..., 1]).ravel()
        field = np.array([transverse.iron_cylinder(500, 1.0, 0.4, 1.0, complex(z)) for z in flat])
        return np.stack((field.real, field.imag), axis=-1).reshape(points.shape)

    points = np.array([(-1, 0), (1, 0), (-0.4, 0), (0.4, 0)], dtype=float)
    outline = Outline("planar", points, (*circle(0, 0), *circle(2)), (Seed((0.7, 0.1), 0), Seed((0.1, 0.1), 1)))
    rim = Conditions([Prescribed(lambda at: at[:, 1])])
    solved = [manufactured(level, (*UNIT, MagneticMaterial(1 / 500))) for level in levels(outline, rim, 3)]
    assert slope([field_error(s, exact) for s in solved]) > FIELD


@cache
def steel() -> ReluctivityCurve:
    """A steel that saturates at 2 T, from a table as dense as its knots: the interpolant's kinks vanish."""
    law, b = layers.Steel(2.0, 50.0), np.arange(0.0, 2.2, STEP)
    with patch("fluxbore.fem.reluctivity._step", return_value=STEP):
        return reluctivity_curve(BHCurve("steel", tuple(b.tolist()), tuple(law.field(float(x)) for x in b), "a test"))


def test_saturated_steel_keeps_the_order() -> None:
    """Catches a tangent or an energy that is not the curve's: J = −div ν(|grad A|²) grad A, up to 1.9 T."""
    curve, size = steel(), 0.2

    def field(points: Floats) -> Floats:
        return size * wave_field(points)

    def density(points: Floats) -> Floats:
        x, y = points[..., 0], points[..., 1]
        s, c, sine, cosine = np.sin(np.pi * x), np.cos(np.pi * x), np.sin(np.pi * y), np.cos(np.pi * y)
        grown = size * np.exp(x)
        xx = ((1 - np.pi**2) * s + 2 * np.pi * c) * sine * grown
        xy = (np.pi * c + s) * np.pi * cosine * grown
        yy = -(np.pi**2) * s * sine * grown
        along, across = np.moveaxis(field(points), -1, 0)  # (∂A/∂y, −∂A/∂x)
        nu, steepness = curve.reluctivity(along**2 + across**2)
        bent = across**2 * xx - 2 * across * along * xy + along**2 * yy
        return np.asarray(-(nu * (xx + yy) + 2 * steepness * bent))

    stored = over_rectangle(lambda p: curve.energy_density(np.linalg.norm(field(p), axis=-1)), (0, 1), (0, 1))
    linked = size * over_disc(wave, *INNER)
    material = MagneticMaterial(curve=curve)
    solved = [manufactured(level, (material,) * 2, density, 1) for level in levels(square(), NOTHING, 4)]
    assert all(s.convergence.converged for s in solved)
    errors = np.array([(energies(s)[0] / stored - 1, flux_linkages(s)[0] / linked - 1) for s in solved])
    assert slope(errors[:, 0]) > ENERGY, errors
    assert rates(errors[:, 1])[-1] > ENERGY, errors  # it changes its sign on the coarser meshes
    assert np.all(rates([field_error(s, field) for s in solved]) > FIELD)


def striped(sign: int) -> tuple[Callable[[Floats], Floats], Callable[[Floats], Floats], Callable[[Floats], Floats]]:
    """A, B and J of a field that repeats after one metre along x, or turns round: A = sin(kx + 0.4) sin(πy) eʸ."""
    k = 2 * np.pi if sign > 0 else np.pi

    def parts(points: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        x, y = points[..., 0], points[..., 1]
        g, slope_ = np.sin(np.pi * y), np.pi * np.cos(np.pi * y)
        return np.sin(k * x + 0.4), k * np.cos(k * x + 0.4), g * np.exp(y), (g + slope_) * np.exp(y)

    def potential(points: Floats) -> Floats:
        f, _, g, _ = parts(points)
        return np.asarray(f * g)

    def field(points: Floats) -> Floats:
        f, df, g, dg = parts(points)
        return np.stack((f * dg, -df * g), axis=-1)

    def density(points: Floats) -> Floats:
        f, _, g, dg = parts(points)
        return np.asarray(f * (k**2 * g - (2 * dg - (1 + np.pi**2) * g)))

    return potential, field, density


@pytest.mark.parametrize("sign", [1, -1], ids=["periodic", "antiperiodic"])
@pytest.mark.parametrize("turned", [False, True])
def test_periodic_sides_keep_the_order(sign: int, turned: bool) -> None:
    """Catches mates that do not face each other, or a sign lost on the way; the right side drawn down or up."""
    potential, field, density = striped(sign)
    right = Curve(2, 1) if turned else Curve(1, 2)
    curves = Curve(0, 1, condition=0), right, Curve(2, 3, condition=0), Curve(3, 0), *circle(4, size=0.1)
    # The left side, number 3, is drawn downwards.
    pair = (Pair(3, 1, sign, not turned),)
    drawn = square()
    outline = Outline("planar", drawn.points, curves, drawn.seeds, pair)
    stored = over_rectangle(lambda p: np.sum(field(p) ** 2, axis=-1) / 2, (0, 1), (0, 1))
    linked = over_disc(potential, *INNER)
    solved = [manufactured(level, UNIT * 2, density, 1) for level in levels(outline, NOTHING, 3)]
    errors = np.array([(energies(s)[0] / stored - 1, flux_linkages(s)[0] / linked - 1) for s in solved])
    assert slope(errors[:, 0]) > ENERGY, errors
    assert slope(errors[:, 1]) > ENERGY, errors


def test_mixed_condition_on_a_circle() -> None:
    """Catches a wrong sign, c0 or arc length on a curved edge: ν ∂A/∂n + c0 A + c1 = 0 on the rim of a disc."""
    c0, c1 = 1.5, 0.7
    bend = (1 + c0) / (3 + c0)  # of x (1 − bend r²), whose ∂/∂r is −c0 times itself at r = 1

    def potential(points: Floats) -> Floats:
        """The constant meets c1, and a r² − 2a/c0 − a, which has no effect there, drives a current everywhere."""
        x, square_ = points[..., 0], np.sum(points**2, axis=-1)
        return np.asarray(x * (1 - bend * square_) - c1 / c0 + square_ - 2 / c0 - 1)

    def field(points: Floats) -> Floats:
        x, y = points[..., 0], points[..., 1]
        return np.stack((-2 * bend * x * y + 2 * y, -(1 - bend * (3 * x**2 + y**2)) - 2 * x), axis=-1)

    def density(points: Floats) -> Floats:
        return np.asarray(8 * bend * points[..., 0] - 4)

    points = np.array([(-1, 0), (1, 0), (0.1, 0.3), (0.5, 0.3)], dtype=float)
    outline = Outline("planar", points, (*circle(0, 0), *circle(2)), (Seed((0, -0.5), 0), Seed((0.3, 0.3), 1)))
    stored = over_disc(lambda p: np.sum(field(p) ** 2, axis=-1) / 2, (0, 0), 1)
    linked = over_disc(potential, (0.3, 0.3), 0.2)
    rim = Conditions([Mixed(c0, c1)])
    solved = [manufactured(level, UNIT * 2, density, 1) for level in levels(outline, rim, 3)]
    errors = np.array([(energies(s)[0] / stored - 1, flux_linkages(s)[0] / linked - 1) for s in solved])
    assert slope(errors[:, 0]) > ENERGY, errors
    assert slope(errors[:, 1]) > ENERGY, errors


def test_mixed_condition_around_the_axis() -> None:
    """Catches a factor of the radius on a cylinder: H_t = −H_z there, with ψ = s² − g s and B_z = 2s − g."""
    c0, g = 2.0, 0.5
    c1 = -(1 - g) - c0 * (1 / 4 - g / 2)  # at r = 1, walked upwards with the inside on the left

    def field(points: Floats) -> Floats:
        r = points[..., 0]
        return np.stack((np.zeros_like(r), r**2 - g), axis=-1)

    def density(points: Floats) -> Floats:
        return np.full(points.shape[:-1], -2.0)

    points = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=float)
    curves = Curve(0, 1), Curve(1, 2, condition=0), Curve(2, 3), Curve(3, 0)
    outline = Outline("axisymmetric", points, curves, (Seed((0.3, 0.3), 0),))
    solved = [manufactured(level, UNIT, density) for level in levels(outline, Conditions([Mixed(c0, c1)]), 3)]
    errors = [field_error(s, field) for s in solved]
    assert slope(errors) > FIELD or errors[-1] < 1e-9, errors


def figures(case: Case, count: int, read: Callable[[Solution], float]) -> list[float]:
    model = with_exterior(case.model) if case.open_boundary else case.model
    return [read(solution) for solution in solved_levels(model, count)]


def exact_of(case: Case, *path: str | int) -> float:
    return next(check.exact for check in case.checks if check.path == path)


def test_planar_exterior_keeps_the_order() -> None:
    """Catches a seam of two circles that is not conformal: two wires in all of the plane."""
    case = conductors.two_wires_in_two_discs()
    exact = exact_of(case, "circuits", "line", "flux_linkage")
    found = figures(case, 2, lambda s: float(flux_linkages(s)[0]))
    assert slope(np.array(found) / exact - 1) > ENERGY, found


def test_axisymmetric_exterior_converges() -> None:
    """Catches a wrong factor on ν in the exterior ball. Third order: at infinity ψ of a dipole is no polynomial."""
    case = air_coils.kelvin_exterior()
    exact = exact_of(case, "circuits", "coil", "flux_linkage")
    found = figures(case, 3, lambda s: float(flux_linkages(s)[0]))
    assert slope(np.array(found) / exact - 1) > 2.8, found


FORCES = {
    "wire in a tube": (conductors.confined_wire, 0, 3),
    "wires beside iron": (iron.wires_beside_iron, 0, 2),
    "two coils": (air_coils.two_coils, 1, 3),
    "ball and coil": (iron.ball_and_coil, 1, 3),
}
"""Case, axis, and number of meshes."""


@pytest.mark.parametrize("name", FORCES)
def test_force_converges(name: str) -> None:
    """Catches a force whose order is that of its worst element: by the stress tensor over all of the air between."""
    build, axis, count = FORCES[name]
    case = build()
    exact = exact_of(case, "groups", "1", "force", axis)
    found = figures(case, count, lambda s: stress_force(s, smooth_weight(s.problem, (0,))).force[axis])
    assert slope(np.array(found) / exact - 1) > FORCE, found


def test_torque_converges() -> None:
    """Catches an arm about another point than the origin, and a torque of low order."""
    case = magnets.torque_on_a_cylinder()
    exact = exact_of(case, "groups", "1", "torque")
    found = figures(case, 3, lambda s: stress_force(s, smooth_weight(s.problem, (0,))).torque)
    assert slope(np.array(found) / exact - 1) > FORCE, found


def test_layer_force_converges() -> None:
    """Catches a virtual displacement of the layer alone that loses the order of the smooth one: a wire in a tube."""
    case = conductors.confined_wire()
    exact = exact_of(case, "groups", "1", "force", 0)
    found = figures(case, 3, lambda s: stress_force(s, layer_weight(s.problem, (0,))).force[0])
    assert slope(np.array(found) / exact - 1) > FORCE, found
