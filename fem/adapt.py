"""Refinement driven by error estimates of the figures that are asked for.

A figure J's error is  ∫ (B − B_h)·D·(Z − Z_h) dV  with D the differential reluctivity and Z the field of the adjoint,
K_T z = ∂J/∂ψ (Becker and Rannacher 2001). Both errors are estimated by recovered fields. The energy's is the same with
B in Z's place, and a half. One back-substitution each, with the factor that Newton's last step left.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from fluxbore.fem.bisection import prepare, refine
from fluxbore.fem.element import flux_density_squared, shape
from fluxbore.fem.factors import Factor, SingularMatrixError
from fluxbore.fem.magnetostatics import Settings, Solution, in_sheets, solve
from fluxbore.fem.mesh import Floats, Ints, Mesh
from fluxbore.fem.outline import Outline
from fluxbore.fem.problem import Problem
from fluxbore.fem.recovery import Patches, RecoveredField
from fluxbore.fem.triangulation import Triangulation

MARKED_SHARE = 0.6
"""Of the estimated error, carried by the elements that are refined (Dörfler 1996)."""

PATIENCE = 6
"""Meshes without a better estimate after which none is expected."""

ROUGH = 1e-5
"""Newton's tolerance on the meshes before the last: far below what their elements are off by."""

CAUTION = 0.25
"""Of the sum of the elements' errors taken without regard to sign: errors that cancel by chance are not relied on."""


class Goal(Protocol):
    """A figure whose accuracy is asked for.

    name : for reports.
    """

    @property
    def name(self) -> str: ...

    def measure(self, solution: Solution) -> Measure:
        """Its value, scale and derivative at a solution."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class Measure:
    """value : SI. scale : what its error is held against, |value| where that is not by chance next to zero.

    gradient : (n,) by nodal ψ; None for the energy, which is its own adjoint.
    """

    value: float
    scale: float
    gradient: Floats | None


@dataclass(frozen=True, slots=True)
class Estimate:
    """value : of the figure. error : estimated, in the figure's unit. relative : error over the figure's scale."""

    name: str
    value: float
    error: float
    relative: float


@dataclass(frozen=True, slots=True)
class Level:
    """One mesh of the sequence."""

    elements: int
    unknowns: int
    iterations: int
    estimates: tuple[Estimate, ...]

    @property
    def worst(self) -> float:
        """The largest relative estimate."""
        return max((estimate.relative for estimate in self.estimates), default=0.0)


@dataclass(frozen=True, slots=True, eq=False)
class Adapted:
    """solution, field : on the last mesh. levels : from the first to the last. reached : whether the estimate holds."""

    solution: Solution
    field: RecoveredField
    triangulation: Triangulation
    levels: tuple[Level, ...]
    reached: bool


def solve_adaptively(
    discretise: Callable[[Triangulation], Problem],
    triangulation: Triangulation,
    outline: Outline,
    goals: Sequence[Goal],
    accuracy: float,
    settings: Settings,
    watched: Callable[[Solution, RecoveredField], Floats] | None = None,
    max_unknowns: int = 200_000,
    max_levels: int = 25,
) -> Adapted:
    """Refine until every goal's estimated relative error is below ``accuracy``, or the unknowns run out.

    It also ends, without estimates of the last mesh, where a goal's linear equations cannot be solved.

    watched : (m,) each element's own relative error where a point is asked for, zero elsewhere.
    """
    triangulation = prepare(triangulation)
    levels: list[Level] = []
    problem, start = discretise(triangulation), None
    rough = replace(settings, tolerance=max(settings.tolerance, ROUGH))
    while True:
        solution = solve(problem, rough, start)
        mesh = solution.problem.mesh
        patches = Patches(mesh)
        field = patches.recover(solution.flux_density())
        if not solution.convergence.converged:
            levels.append(_level(solution, ()))
            return Adapted(solution, field, triangulation, tuple(levels), False)
        try:
            indicators, estimates = _estimates(solution, patches, field, goals, accuracy)
            known = True
        except SingularMatrixError:  # the field stands, but nothing says how good its figures are, or where it is not
            indicators, estimates, known = np.zeros(mesh.region.size), (), False
        if watched is not None and known:
            local = watched(solution, field)
            estimates = (*estimates, Estimate("points", 0.0, float(local.max()), float(local.max())))
            indicators = indicators + np.where(local > accuracy, local / accuracy, 0.0) ** 2
        levels.append(_level(solution, estimates))
        marked = _marked(indicators)
        reached = known and levels[-1].worst <= accuracy
        # Each marked triangle becomes four, and closure adds about as many again.
        full = len(levels) >= max_levels or mesh.topology.unknowns + 8 * int(marked.sum()) > max_unknowns
        full |= not known or _hopeless([level.worst for level in levels])
        if reached or full:
            final = solve(problem, settings, solution.psi)
            iterations = solution.convergence.iterations + final.convergence.iterations
            final = replace(final, convergence=replace(final.convergence, iterations=iterations))
            field = patches.recover(final.flux_density())
            return Adapted(final, field, triangulation, tuple(levels), reached and final.convergence.converged)
        finer = refine(triangulation, outline, marked)
        problem = discretise(finer.triangulation)
        start = _carried(solution, triangulation, finer.triangulation, finer.origin, problem.mesh)
        triangulation = finer.triangulation


def _hopeless(worst: Sequence[float]) -> bool:
    """Whether the last meshes have not bettered the best estimate before them."""
    return len(worst) > PATIENCE and min(worst[-PATIENCE:]) >= min(worst[:-PATIENCE])


def _level(solution: Solution, estimates: tuple[Estimate, ...]) -> Level:
    mesh = solution.problem.mesh
    return Level(mesh.region.size, mesh.topology.unknowns, solution.convergence.iterations, estimates)


def tangent_product(solution: Solution, first: Floats, second: Floats) -> Floats:
    """(m,) ∫ a·D·b over each element, D the differential reluctivity; a, b : (m, q, 2) in the kernel's frame."""
    system = solution.triangles
    factor = system.linear_factor
    rows = factor[..., None] if factor.ndim == 2 else factor
    product = np.sum(rows * first * second, axis=(1, 2))
    for index, part in system.iron:
        material = solution.problem.materials[index]
        elements = system.iron_elements[part]
        assert material.curve is not None
        stretch = np.ones(2) if material.stack is None else in_sheets(material.stack)
        field, squared = flux_density_squared(system.iron_curl[part], solution.psi[system.iron_nodes[part]])
        nu, slope = material.curve.reluctivity(squared)
        a, b = first[elements] * stretch, second[elements] * stretch
        along = 2 * slope * np.sum(field * a, axis=-1) * np.sum(field * b, axis=-1)
        product[elements] += np.sum(system.iron_weight[part] * (nu * np.sum(a * b, axis=-1) + along), axis=1)
    return np.asarray(product)


def _estimates(
    solution: Solution, patches: Patches, field: RecoveredField, goals: Sequence[Goal], accuracy: float
) -> tuple[Floats, tuple[Estimate, ...]]:
    """(m,) what each element adds to the errors that are too large, and the estimates of all goals."""
    mesh = solution.problem.mesh
    error = field.at_quadrature() - solution.flux_density()
    indicators = np.zeros(mesh.region.size)
    estimates = []
    factor: Factor | None = None
    for goal in goals:
        measure = goal.measure(solution)
        if measure.gradient is None:
            share = tangent_product(solution, error, error) * (solution.problem.extent / 2)
            total = float(share.sum())
        else:
            factor = solution.tangent if factor is None else factor
            gather, spread = mesh.topology.gather, mesh.topology.spread
            adjoint = spread(factor.solve(gather(measure.gradient)))
            dual, _ = flux_density_squared(solution.system.kernel.curl, adjoint[mesh.elements])
            share = tangent_product(solution, error, patches.recover(dual).at_quadrature() - dual)
            total = max(abs(float(share.sum())), CAUTION * float(np.abs(share).sum()))
        relative = total / measure.scale if measure.scale > 0 else 0.0
        estimates.append(Estimate(goal.name, measure.value, total, relative))
        if relative > accuracy:
            indicators += np.abs(share) / (accuracy * measure.scale)
    return indicators, tuple(estimates)


def _marked(indicators: Floats) -> np.ndarray:
    """(m,) the fewest elements that carry the share of the indicators."""
    order = np.argsort(indicators)[::-1]
    running = np.cumsum(indicators[order])
    count = int(np.searchsorted(running, MARKED_SHARE * running[-1])) + 1
    marked = np.zeros(indicators.size, dtype=bool)
    marked[order[:count]] = True
    return marked & (indicators > 0)


def _carried(solution: Solution, old: Triangulation, new: Triangulation, origin: Ints, mesh: Mesh) -> Floats:
    """(n,) nodal ψ of a solution on the finer mesh of the finer triangulation."""
    points = new.points[new.triangles]
    six = np.concatenate((points, (points + np.roll(points, -1, axis=1)) / 2), axis=1)
    psi = np.zeros(mesh.nodes.shape[0])
    psi[mesh.elements] = _evaluate(solution.problem.mesh, solution.psi, old, origin, six)
    return psi


def _evaluate(mesh: Mesh, psi: Floats, old: Triangulation, origin: Ints, points: Floats) -> Floats:
    """(m, 6) ψ of the old mesh at points (m, 6, 2) of the old straight triangles ``origin``."""
    a, b, c = (old.points[old.triangles[origin, k]][:, None] for k in range(3))

    def cross(p: Floats, q: Floats) -> Floats:
        return np.asarray(p[..., 0] * q[..., 1] - p[..., 1] * q[..., 0])

    area = cross(b - a, c - a)
    second, third = cross(points - a, c - a) / area, cross(b - a, points - a) / area
    places = np.stack((1 - second - third, second, third), axis=-1)
    return np.asarray(np.einsum("mkn,mn->mk", shape(places), psi[mesh.elements[origin]], optimize=True))
