"""Problems of a known field on general meshes, each mesh cut from the one before: what rates are measured on."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from fluxbore.fem.bisection import refine_all
from fluxbore.fem.conditions import ConditionedMesh, Conditions, Prescribed, conditioned_mesh
from fluxbore.fem.conductors import circuit
from fluxbore.fem.element import QUADRATURE_POINTS, from_frame, kernel, positions, shape
from fluxbore.fem.facing import facing
from fluxbore.fem.femm_model import FemmModel
from fluxbore.fem.femm_problem import drawing, problem
from fluxbore.fem.magnetostatics import Settings, Solution, solve
from fluxbore.fem.mesh import Floats, Mesh
from fluxbore.fem.outline import Curve, Outline
from fluxbore.fem.problem import Circuit, Conductor, MagneticMaterial, Problem
from fluxbore.fem.quadratic import QuadraticNodes, quadratic_nodes
from fluxbore.fem.recovery import Patches, RecoveredField
from fluxbore.fem.triangulation import Triangulation
from fluxbore.fem.unstructured import triangulate

TIGHT = Settings(tolerance=1e-10, method="auto")
"""Newton's steps end far below the discretisation's error, or its rate would be hidden."""

Scalar = Callable[[Floats], Floats]
"""(..., 2) positions in m -> (...)."""

ENERGY_RATE = 3.8
"""Least rate of energies and linkages, four in theory."""

FIELD_RATE = 1.9
"""Least rate of B in the elements, two in theory."""

VACUUM = (MagneticMaterial(1.0),)
"""Of one region, ν = 1."""

NOTHING = Conditions([Prescribed(lambda points: np.zeros(points.shape[0]))])
"""Condition 0: no flux crosses."""


@dataclass(frozen=True, slots=True, eq=False)
class Level:
    """One mesh of a sequence."""

    triangulation: Triangulation
    quadratic: QuadraticNodes
    conditioned: ConditionedMesh

    @property
    def mesh(self) -> Mesh:
        return self.conditioned.mesh


def levels(outline: Outline, conditions: Conditions, count: int) -> list[Level]:
    """A netgen mesh and what uniform refinement makes of it, each element cut into four."""
    found: list[Level] = []
    triangulation = triangulate(outline)
    while True:
        quadratic = quadratic_nodes(triangulation, outline)
        found.append(Level(triangulation, quadratic, conditioned_mesh(triangulation, quadratic, outline, conditions)))
        if len(found) == count:
            return found
        triangulation = refine_all(triangulation, outline).triangulation


def solved_levels(model: FemmModel, count: int) -> list[Solution]:
    """A file solved on a sequence of meshes, without any choice of where to refine."""
    drawn = drawing(model)
    outline = facing(drawn.outline)
    return [
        solve(problem(model, level.conditioned, level.quadratic.vertex), TIGHT)
        for level in levels(outline, drawn.conditions, count)
    ]


def source(mesh: Mesh, density: Scalar) -> Circuit:
    """The load of a current density that varies: J (A/m²) of a planar problem, J/r (A/m³) of an axisymmetric one."""
    values = shape(QUADRATURE_POINTS)
    amount = kernel(mesh).weight * density(positions(mesh))
    shares = np.einsum("mq,qn->mn", amount, values)
    return Circuit("source", np.bincount(mesh.elements.ravel(), shares.ravel(), mesh.nodes.shape[0]), 1.0)


def manufactured(
    level: Level, materials: Sequence[MagneticMaterial], density: Scalar | None = None, watched: int | None = None
) -> Solution:
    """The field of a current density. watched : region of the one circuit, without current."""
    mesh = level.mesh
    circuits = () if watched is None else (mean_over(mesh, watched),)
    sources = () if density is None else (source(mesh, density),)
    prescribed, edges = level.conditioned.prescribed, level.conditioned.edges
    return solve(Problem(mesh, tuple(materials), circuits, sources, prescribed, edges), TIGHT)


def mean_over(mesh: Mesh, region: int) -> Circuit:
    """A circuit whose linkage per radian or metre is ∫ ψ over a region."""
    return circuit(mesh, "mean", [Conductor(region, 1.0)], 0.0)


def recovered(solution: Solution) -> RecoveredField:
    return Patches(solution.problem.mesh).recover(solution.flux_density())


def misses(solution: Solution, exact: Callable[[Floats], Floats], better: bool = False) -> tuple[Floats, Floats]:
    """(m, q) |B_h − B|² and what it is to be weighted with. better : of the recovered field."""
    mesh = solution.problem.mesh
    field = recovered(solution).at_quadrature() if better else solution.flux_density()
    miss = from_frame(mesh.chart, field) - exact(positions(mesh))
    return np.sum(miss**2, axis=-1), solution.system.kernel.weight


def field_error(solution: Solution, exact: Callable[[Floats], Floats], better: bool = False) -> float:
    """‖B_h − B‖/‖B‖ over the volume, with B (..., 2) along (x, y) or (r, z). better : of the recovered field."""
    miss, weight = misses(solution, exact, better)
    true = np.sum(exact(positions(solution.problem.mesh)) ** 2, axis=-1)
    return float(np.sqrt(np.sum(weight * miss) / np.sum(weight * true)))


def rates(errors: Sequence[float] | Floats) -> Floats:
    """Of errors on meshes of halved size."""
    values = np.abs(np.asarray(errors, dtype=float))
    return np.asarray(np.log2(values[:-1] / values[1:]))


def slope(errors: Sequence[float] | Floats) -> float:
    """The rate fitted over all meshes, for errors that may change their sign on the way."""
    values = np.log2(np.abs(np.asarray(errors, dtype=float)))
    return float(-np.polyfit(np.arange(values.size), values, 1)[0])


def polygon(first: int, count: int, condition: int | None = None) -> list[Curve]:
    """A closed chain of lines through points first to first + count − 1."""
    return [Curve(first + k, first + (k + 1) % count, condition=condition) for k in range(count)]


def circle(first: int, condition: int | None = None, size: float | None = None) -> list[Curve]:
    """Two half circles between points first and first + 1."""
    return [Curve(first, first + 1, np.pi, size, condition), Curve(first + 1, first, np.pi, size, condition)]


def over_rectangle(function: Scalar, x: tuple[float, float], y: tuple[float, float]) -> float:
    """∫ f dx dy by a Gauss rule of 40 by 40 points."""
    t, w = np.polynomial.legendre.leggauss(40)
    a, b = (low + (high - low) * (t + 1) / 2 for low, high in (x, y))
    points = np.stack(np.meshgrid(a, b, indexing="ij"), axis=-1)
    return float(w @ function(points) @ w) * (x[1] - x[0]) * (y[1] - y[0]) / 4


def over_disc(function: Scalar, centre: tuple[float, float], radius: float, half: bool = False) -> float:
    """∫ f dx dy over a disc, or over its half of positive x, by a Gauss rule in polar coordinates."""
    turn = np.pi / 2 if half else np.pi

    def polar(at: Floats) -> Floats:
        r, angle = at[..., 0], at[..., 1]
        points = np.stack((centre[0] + r * np.cos(angle), centre[1] + r * np.sin(angle)), axis=-1)
        return np.asarray(function(points) * r)

    return over_rectangle(polar, (0.0, radius), (-turn, turn))
