"""Force and torque on a body by the stress tensor in its domain form, and on currents by Lorentz' law.

With a weight w that is one on the body and zero on everything else, space is displaced by δ w and the energy changes by
F·δ = −∫ (T ∇w)·δ dV − ∫ w (J×B)·δ dV  over the air and the coils between, T = (B⊗B − ½|B|² I)/μ0. With w along a
virtual displacement of the mesh it is the exact derivative of the discrete energy (Coulomb 1983).
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import Literal

import numpy as np

from fluxbore.fem.conductors import current_density
from fluxbore.fem.element import QUADRATURE_POINTS, from_frame, positions, shape, to_frame
from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.mesh import Floats, Ints, Mesh
from fluxbore.fem.reluctivity import VACUUM_RELUCTIVITY
from fluxbore.fem.weight import Weight

Component = Literal["x", "y", "z", "torque"]


@dataclass(frozen=True, slots=True)
class BodyForce:
    """force : N, (x, y) of a planar problem's depth or (radial, axial) of an axisymmetric one; the radial is zero.

    torque : N m about the origin, of a planar problem. Zero in an axisymmetric one.
    """

    force: tuple[float, float]
    torque: float

    def component(self, component: Component) -> float:
        """One of them; "z" and "y" are the second component of the force."""
        return {"x": self.force[0], "y": self.force[1], "z": self.force[1], "torque": self.torque}[component]


def stress_force(solution: Solution, weight: Weight) -> BodyForce:
    """By the stress tensor, over the weight's shell."""
    planar = solution.problem.mesh.chart == "planar"
    parts = _integrands(solution, weight)
    extent = solution.problem.extent
    if not planar:
        return BodyForce((0.0, float(parts.sum(axis=0)[1]) * extent), 0.0)
    first, second, torque = parts.sum(axis=0) * extent
    return BodyForce((float(first), float(second)), float(torque))


def stress_gradient(solution: Solution, weight: Weight, component: Component) -> Floats:
    """(n,) ∂F/∂ψ of one component, at the solution.

    With e the direction, constant or that of a rotation, δ[e·T·∇w] = (e (B·∇w) + ∇w (e·B) − B (e·∇w))·δB/μ0.
    """
    problem = solution.problem
    mesh, shell = problem.mesh, weight.shell
    curl, measure, points, field, slope = _in_shell(solution, weight, solution.psi[mesh.elements[shell]])
    direction = _direction(component, points)

    def dot(a: Floats, b: Floats) -> Floats:
        return np.asarray(np.sum(a * b, axis=-1, keepdims=True))

    change = direction * dot(field, slope) + slope * dot(direction, field) - field * dot(direction, slope)
    change *= -VACUUM_RELUCTIVITY * measure[..., None]
    change -= (_value(weight, mesh) * _current(solution, shell, points) * measure)[..., None] * _across(mesh, direction)
    share = np.einsum("mqkn,mqk->mn", curl, to_frame(mesh.chart, change), optimize=True)
    nodal = np.bincount(mesh.elements[shell].ravel(), share.ravel(), mesh.nodes.shape[0])
    return np.asarray(nodal * problem.extent)


def stress_scale(solution: Solution, weight: Weight, component: Component) -> tuple[float, float]:
    """What a component is small or large against: its shares in the shell's elements without their signs, and those of
    the whole vector, for a torque times half of the body's extent."""
    parts, extent = _integrands(solution, weight), solution.problem.extent
    column = {"x": 0, "y": 1, "z": 1, "torque": 2}[component]
    whole = float(np.hypot(parts[:, 0], parts[:, 1]).sum()) * extent
    if component == "torque":
        body = solution.problem.mesh.positions[weight.nodal == 1]
        whole *= float(np.hypot(*np.ptp(body, axis=0))) / 2 if body.size else 0.0
    return float(np.abs(parts[:, column]).sum()) * extent, whole


def lorentz_force(solution: Solution, body: Collection[int], field: Floats | None = None) -> BodyForce | None:
    """∫ J×B dV over the body's conductors; None where the body is more than conductors in vacuum.

    field : (m, q, 2) another flux density at the quadrature points of all elements, in the kernel's frame.
    """
    problem = solution.problem
    if any(problem.materials[region].magnetic for region in body):
        return None
    mesh = problem.mesh
    elements = np.flatnonzero(np.isin(mesh.region, list(body)))
    if field is None:
        parts = _lorentz(solution, elements, solution.psi[mesh.elements[elements]])
    else:
        parts = _by_current(solution, elements, from_frame(mesh.chart, field[elements]))
    total = parts.sum(axis=(0, 1)) * problem.extent
    if mesh.chart == "axisymmetric":
        return BodyForce((0.0, float(total[1])), 0.0)
    return BodyForce((float(total[0]), float(total[1])), float(total[2]))


def lorentz_gradient(solution: Solution, body: Collection[int], component: Component) -> Floats:
    """(n,) ∂F/∂ψ of one component of ∫ J×B dV."""
    mesh = solution.problem.mesh
    elements = np.flatnonzero(np.isin(mesh.region, list(body)))
    points = positions(mesh, elements)
    amount = _current(solution, elements, points) * solution.system.kernel.weight[elements]
    pull = amount[..., None] * _across(mesh, _direction(component, points))
    share = np.einsum("mqkn,mqk->mn", solution.system.kernel.curl[elements], to_frame(mesh.chart, pull), optimize=True)
    nodal = np.bincount(mesh.elements[elements].ravel(), share.ravel(), mesh.nodes.shape[0])
    return np.asarray(nodal * solution.problem.extent)


def lorentz_scale(solution: Solution, body: Collection[int], component: Component) -> float:
    """All that pulls on the body's currents, to whatever side; for a torque times half of the body's extent."""
    mesh = solution.problem.mesh
    elements = np.flatnonzero(np.isin(mesh.region, list(body)))
    parts = _lorentz(solution, elements, solution.psi[mesh.elements[elements]])
    whole = float(np.hypot(parts[..., 0], parts[..., 1]).sum()) * solution.problem.extent
    places = mesh.positions[mesh.elements[elements].ravel()]
    return whole * float(np.hypot(*np.ptp(places, axis=0))) / 2 if component == "torque" else whole


def _direction(component: Component, points: Floats) -> Floats:
    """(k, q, 2) the direction that a component counts: constant, or that of a rotation about the origin."""
    if component == "torque":
        return np.stack((-points[..., 1], points[..., 0]), axis=-1)
    return np.broadcast_to([1.0, 0.0] if component == "x" else [0.0, 1.0], points.shape)


def _across(mesh: Mesh, direction: Floats) -> Floats:
    """(k, q, 2) u with (J×B)·e = J u·B: e turned by a quarter, the other way about an axis than in a plane."""
    turned = np.stack((direction[..., 1], -direction[..., 0]), axis=-1)
    return -turned if mesh.chart == "axisymmetric" else turned


def _in_shell(solution: Solution, weight: Weight, psi: Floats) -> tuple[Floats, Floats, Floats, Floats, Floats]:
    """At the shell's quadrature points: curl, measure, positions, B and ∇w (m, q, 2) in space."""
    mesh, shell = solution.problem.mesh, weight.shell
    curl, measure = solution.system.kernel.curl[shell], solution.system.kernel.weight[shell]
    field = from_frame(mesh.chart, np.einsum("mqkn,mn->mqk", curl, psi, optimize=True))
    slope = np.einsum("mqkn,mn->mqk", curl, weight.nodal[mesh.elements[shell]], optimize=True)
    points = positions(mesh, shell)
    if mesh.chart == "axisymmetric":  # so far ∂w/∂s = ∂w/∂r /r and ∂w/∂z /r
        slope = slope * points[..., :1]
    return curl, measure, points, field, slope


def _value(weight: Weight, mesh: Mesh) -> Floats:
    """(k, q) the weight at the shell's quadrature points."""
    nodal = weight.nodal[mesh.elements[weight.shell]]
    return np.asarray(np.einsum("qn,mn->mq", shape(QUADRATURE_POINTS), nodal, optimize=True))


def _integrands(solution: Solution, weight: Weight) -> Floats:
    """(k, 3) each shell element's share of both force components and the torque, without the extent."""
    mesh, shell = solution.problem.mesh, weight.shell
    psi = solution.psi[mesh.elements[shell]]
    _, measure, points, field, slope = _in_shell(solution, weight, psi)
    pressure = np.sum(field**2, axis=-1, keepdims=True) / 2
    traction = VACUUM_RELUCTIVITY * (field * np.sum(field * slope, axis=-1, keepdims=True) - pressure * slope)
    # A rotation x × traction, and the weight's own part: T is symmetric, so that nothing else is left.
    turning = points[..., 0] * traction[..., 1] - points[..., 1] * traction[..., 0]
    total = -np.concatenate((traction, turning[..., None]), axis=-1) * measure[..., None]
    total -= _value(weight, mesh)[..., None] * _lorentz(solution, shell, psi)
    return np.asarray(total.sum(axis=1))


def _current(solution: Solution, elements: Ints, points: Floats) -> Floats:
    """(k, q) J (A/m²) at points (k, q, 2) of elements."""
    region = solution.problem.mesh.region[elements]
    uniform, by_radius = (part[region] for part in current_density(solution.problem))
    density = np.broadcast_to(uniform[:, None], points.shape[:2])
    if np.any(by_radius):
        density = density + by_radius[:, None] / np.maximum(points[..., 0], np.finfo(float).tiny)
    return density


def _lorentz(solution: Solution, elements: Ints, psi: Floats) -> Floats:
    """(k, q, 3) force and torque of the currents at the quadrature points, times the measure."""
    mesh = solution.problem.mesh
    curl = solution.system.kernel.curl[elements]
    field = from_frame(mesh.chart, np.einsum("mqkn,mn->mqk", curl, psi, optimize=True))
    return _by_current(solution, elements, field)


def _by_current(solution: Solution, elements: Ints, field: Floats) -> Floats:
    """(k, q, 3) J×B and its torque at the quadrature points, times the measure; field : (k, q, 2) B in space."""
    mesh = solution.problem.mesh
    points = positions(mesh, elements)
    amount = _current(solution, elements, points) * solution.system.kernel.weight[elements]
    if mesh.chart == "axisymmetric":  # φ × r = −z, φ × z = r
        force = np.stack((amount * field[..., 1], -amount * field[..., 0]), axis=-1)
    else:  # z × x = y, z × y = −x
        force = np.stack((-amount * field[..., 1], amount * field[..., 0]), axis=-1)
    turning = points[..., 0] * force[..., 1] - points[..., 1] * force[..., 0]
    return np.concatenate((force, turning[..., None]), axis=-1)
