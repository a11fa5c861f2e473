"""A FEMM file solved: refinement to the accuracy asked for, and the figures that FEMM's users ask of a solution."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from fluxbore.design.errors import SpecError
from fluxbore.fem.adapt import Adapted, Goal, solve_adaptively
from fluxbore.fem.body_force import BodyForce, lorentz_force, stress_force
from fluxbore.fem.conditions import conditioned_mesh
from fluxbore.fem.energy import energies
from fluxbore.fem.facing import facing
from fluxbore.fem.femm_model import FemmModel
from fluxbore.fem.femm_problem import Drawing, drawing, problem
from fluxbore.fem.goals import EnergyGoal, ForceGoal, LinkageGoal, PointGoal, locator
from fluxbore.fem.linkage import flux_linkages
from fluxbore.fem.locate import Locator
from fluxbore.fem.magnetostatics import Settings, Solution
from fluxbore.fem.mesh import Floats, Mesh
from fluxbore.fem.net_current import check_net_current
from fluxbore.fem.outline import Outline
from fluxbore.fem.probe import Probe, locate, probe
from fluxbore.fem.problem import Problem
from fluxbore.fem.quadratic import quadratic_nodes
from fluxbore.fem.recovery import RecoveredField
from fluxbore.fem.triangulation import Triangulation
from fluxbore.fem.unstructured import triangulate
from fluxbore.fem.weight import layer_weight, smooth_weight

DEFAULT_ACCURACY = 1e-3
"""Of the estimated error of energy, linkages and forces, where none is asked for."""

LOCAL_SLACK = 3.0
"""The elements' own field at a point may be this much worse than the accuracy: the recovered one is given."""

MAX_UNKNOWNS = 200_000
"""Where refinement for more than the default accuracy ends; it then says that the accuracy was not reached."""

MOST_LEVELS, MODEST_LEVELS = 25, 12
"""Meshes in all, for more than the default accuracy and for the rest."""

MODEST_UNKNOWNS, MODEST_GROWTH = 30_000, 1.5
"""Where refinement for the default accuracy ends: so many, or so many times those of the file's own mesh sizes."""


@dataclass(frozen=True, slots=True)
class GroupForce:
    """Force and torque on a group.

    by_stress : over the whole of the air around it. by_layer : by virtual work over the layer that touches it.
    lorentz : of its currents, where it is nothing but coils; lorentz_recovered : the same by the recovered field.
    touches : labels of magnetic regions that it touches. surrounded : whether there is any air around it.
    """

    by_stress: BodyForce
    by_layer: BodyForce
    lorentz: BodyForce | None
    lorentz_recovered: BodyForce | None
    touches: tuple[int, ...]
    surrounded: bool

    @property
    def defined(self) -> bool:
        """Between bodies in contact there is a force for coils only, that on their currents."""
        return self.lorentz is not None or (self.surrounded and not self.touches)

    @property
    def value(self) -> BodyForce:
        """By the stress around the group; that on its currents, where it is a coil that touches something magnetic."""
        if self.lorentz is not None and (self.touches or not self.surrounded):
            return self.lorentz
        return self.by_stress

    @property
    def error(self) -> float:
        """N, by how much the routes differ."""
        if self.value is self.lorentz:
            routes = [self.lorentz_recovered]
        else:
            routes = [self.by_layer, self.lorentz]
        a = np.array(self.value.force)
        return float(max(np.linalg.norm(a - np.array(route.force)) for route in routes if route is not None))


@dataclass(frozen=True, eq=False)
class FemmSolution:
    """model : as it was solved, with whatever was set. accuracy : asked for, relative.

    corners : points asked for, in the file's unit, at which magnetic blocks have a corner.
    """

    model: FemmModel
    drawing: Drawing
    adapted: Adapted
    accuracy: float
    corners: tuple[tuple[float, float], ...] = ()

    @property
    def solution(self) -> Solution:
        return self.adapted.solution

    @property
    def field(self) -> RecoveredField:
        return self.adapted.field

    @cached_property
    def locator(self) -> Locator:
        return Locator(self.solution.problem.mesh)

    @cached_property
    def energies(self) -> tuple[float, float]:
        """Energy and coenergy (J)."""
        return energies(self.solution)

    @cached_property
    def linkages(self) -> Floats:
        """(k,) of the circuits (Wb)."""
        return flux_linkages(self.solution)

    def regions(self, group: int) -> tuple[int, ...]:
        """Numbers of the labels of a group. Raises SpecError where there are none."""
        return regions_of(self.model, group)

    def force(self, group: int) -> GroupForce:
        """On a group of labels."""
        regions = self.regions(group)
        problem = self.solution.problem
        smooth = smooth_weight(problem, regions)
        return GroupForce(
            stress_force(self.solution, smooth),
            stress_force(self.solution, layer_weight(problem, regions)),
            lorentz_force(self.solution, regions),
            lorentz_force(self.solution, regions, self.field.at_quadrature()),
            smooth.touched,
            bool(smooth.shell.size),
        )

    def probe(self, points: Floats) -> Probe:
        """A, B and H at points (k, 2) in the file's unit. Raises SpecError for one outside the model."""
        return probe(self.solution, self.field, self.locator, points * self.model.metres)

    def inductances(self) -> Floats:
        """(k, k) incremental inductances dλ_i/dI_j (H) at the solution."""
        solution = self.solution
        gather = solution.triangles.topology.gather
        loads = np.column_stack([gather(c.density) for c in solution.problem.circuits])
        return np.asarray(solution.problem.extent * loads.T @ solution.tangent.solve(loads))


def regions_of(model: FemmModel, group: int) -> tuple[int, ...]:
    """Numbers of the labels of a group. Raises SpecError where there are none."""
    found = tuple(number for number, label in enumerate(model.labels) if label.group == group)
    if not found:
        known = sorted({label.group for label in model.labels})
        raise SpecError(
            f"--group must be the group of a block label, one of {', '.join(map(str, known))}; got {group}."
        )
    return found


def solve_model(
    model: FemmModel,
    groups: Sequence[int] = (),
    points: Sequence[tuple[float, float]] = (),
    accuracy: float | None = None,
    max_unknowns: int | None = None,
    open_plane: bool = False,
) -> FemmSolution:
    """Mesh, solve and refine until the estimated errors hold.

    groups : whose forces are to be accurate. points : file's unit, where B is to be. accuracy : relative, 1e-3 without.
    open_plane : the model stands for all of the plane, where currents must add up to zero.

    Raises SpecError, MeshError for files that mean nothing; a failure to converge is in the solution.
    """
    drawn = drawing(model)
    drawn = replace(drawn, outline=facing(drawn.outline))
    for group in groups:
        regions_of(model, group)
    places = np.array(points, dtype=float).reshape(-1, 2) * model.metres

    def discretise(triangulation: Triangulation) -> Problem:
        quadratic = quadratic_nodes(triangulation, drawn.outline)
        conditioned = conditioned_mesh(triangulation, quadratic, drawn.outline, drawn.conditions)
        found = problem(model, conditioned, quadratic.vertex)
        check_net_current(model, found, conditioned.loose, open_plane)
        return found

    def watched(solution: Solution, field: RecoveredField) -> Floats:
        return _local_error(solution, field, places[~corner]) / LOCAL_SLACK

    triangulation = triangulate(drawn.outline)
    first = discretise(triangulation)
    _check_points(model, first.mesh, places)
    corner = _at_corners(model, first, drawn.outline, places)
    goals = goals_of(model, groups)
    for number, (x, y) in enumerate(places.tolist()):
        if not corner[number]:
            at = f"B at point {number + 1}"
            goals += [PointGoal(at, (x, y)), PointGoal(f"{at}, across", (x, y), across=True)]
    modest = accuracy is None or accuracy >= DEFAULT_ACCURACY
    max_levels = MODEST_LEVELS if modest else MOST_LEVELS
    if max_unknowns is None:
        few = max(MODEST_UNKNOWNS, int(MODEST_GROWTH * first.mesh.topology.unknowns))
        max_unknowns = few if modest else MAX_UNKNOWNS
    accuracy = DEFAULT_ACCURACY if accuracy is None else accuracy
    adapted = solve_adaptively(
        discretise,
        triangulation,
        drawn.outline,
        goals,
        accuracy,
        Settings(tolerance=1e-8, method="auto"),
        watched if not corner.all() else None,
        max_unknowns,
        max_levels,
    )
    return FemmSolution(model, drawn, adapted, accuracy, tuple(p for p, c in zip(points, corner, strict=True) if c))


def _check_points(model: FemmModel, mesh: Mesh, places: Floats) -> None:
    """Refuse a point outside the model before the work."""
    if not places.size:
        return
    elements, _ = locate(mesh, Locator(mesh), places)
    outside = np.flatnonzero(elements < 0)
    if outside.size:
        x, y = places[outside[0]] / model.metres
        raise SpecError(f"--point must lie inside the model; ({x:.6g}, {y:.6g}) {model.unit} does not.")


def _at_corners(model: FemmModel, problem: Problem, outline: Outline, places: Floats) -> np.ndarray:
    """(k,) whether a place is a node of the drawing where a magnetic block meets another one.

    The flux density at an iron's corner is infinite: no mesh has it, and none is refined for it.
    """
    found = np.zeros(places.shape[0], dtype=bool)
    mesh = problem.mesh
    size = float(np.hypot(*np.ptp(outline.points, axis=0)))
    for number, place in enumerate(places):
        if np.hypot(*(outline.points - place).T).min() < 1e-6 * size:
            elements = [element for element, _ in locator(mesh).find_all(place)]
            regions = set(mesh.region[elements].tolist())
            found[number] = len(regions) > 1 and any(problem.materials[region].magnetic for region in regions)
    return found


def goals_of(model: FemmModel, groups: Sequence[int]) -> list[Goal]:
    """The energy, the linkages of circuits with coils, and the forces on groups.

    A point current has no finite energy: only the other figures can be accurate then.
    """
    endless = any(n.prop is not None and model.points[n.prop].current != 0 for n in model.nodes)
    goals: list[Goal] = [] if endless else [EnergyGoal()]
    for number, item in enumerate(model.circuits):
        if any(label.circuit == number for label in model.labels):
            goals.append(LinkageGoal(f"flux linkage of {item.name}", number))
    for group in groups:
        regions = regions_of(model, group)
        if model.axisymmetric:
            goals.append(ForceGoal(f"axial force on group {group}", regions, "z"))
        else:
            goals.append(ForceGoal(f"x force on group {group}", regions, "x"))
            goals.append(ForceGoal(f"y force on group {group}", regions, "y"))
            goals.append(ForceGoal(f"torque on group {group}", regions, "torque"))
    return goals


def _local_error(solution: Solution, field: RecoveredField, places: Floats) -> Floats:
    """(m,) |B − B_h| over |B| in the elements that hold the places, zero elsewhere."""
    mesh = solution.problem.mesh
    relative = np.zeros(mesh.region.size)
    elements = np.unique(Locator(mesh).find(places)[0])
    elements = elements[elements >= 0]
    if not elements.size:
        return relative
    recovered = field.at_quadrature(elements)
    error = np.sqrt(np.mean(np.sum((recovered - solution.flux_density(elements)) ** 2, axis=-1), axis=1))
    size = np.sqrt(np.mean(np.sum(recovered**2, axis=-1), axis=1))
    relative[elements] = np.divide(error, size, out=np.zeros_like(error), where=size > 0)
    return relative
