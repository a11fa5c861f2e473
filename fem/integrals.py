"""Integrals over blocks, those of FEMM that mean something in magnetostatics, by FEMM's numbers.

All are of the discrete solution itself: what is linear in it, such as the flux of a block, obeys Stokes' theorem
exactly. Volumes and energies are of the file's depth, or all the way round.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fluxbore.design.errors import SpecError, shown
from fluxbore.fem.body_force import BodyForce, stress_force
from fluxbore.fem.conductors import current_density, region_load
from fluxbore.fem.element import from_frame, positions
from fluxbore.fem.energy import energy_densities
from fluxbore.fem.femm_solution import FemmSolution
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.weight import smooth_weight


@dataclass(frozen=True, eq=False)
class Blocks:
    """Some regions of a solution, and what several of their integrals need."""

    solution: FemmSolution
    regions: tuple[int, ...]

    @classmethod
    def of(cls, solution: FemmSolution, group: int | None = None) -> Blocks:
        """The blocks of a group, or all. Raises SpecError for a group without blocks."""
        if group is None:
            return cls(solution, tuple(range(len(solution.model.labels))))
        return cls(solution, solution.regions(group))

    @property
    def planar(self) -> bool:
        return not self.solution.model.axisymmetric

    @property
    def extent(self) -> float:
        return self.solution.solution.problem.extent

    @cached_property
    def elements(self) -> Ints:
        return np.flatnonzero(np.isin(self.solution.solution.problem.mesh.region, self.regions))

    @cached_property
    def measure(self) -> Floats:
        """(m, q) volume at the quadrature points, of the depth or of a radian: r dr dz."""
        return self.solution.solution.system.kernel.weight[self.elements]

    @cached_property
    def positions(self) -> Floats:
        """(m, q, 2) m."""
        return positions(self.solution.solution.problem.mesh, self.elements)

    @cached_property
    def flux_density(self) -> Floats:
        """(m, q, 2) T along (x, y) or (r, z)."""
        solution = self.solution.solution
        return from_frame(solution.problem.mesh.chart, solution.flux_density(self.elements))

    @cached_property
    def current_density(self) -> Floats:
        """(m, q) A/m²."""
        problem = self.solution.solution.problem
        uniform, by_radius = (part[problem.mesh.region[self.elements]] for part in current_density(problem))
        density = np.repeat(uniform[:, None], self.measure.shape[1], axis=1)
        if np.any(by_radius):
            density += by_radius[:, None] / np.maximum(self.positions[..., 0], np.finfo(float).tiny)
        return density

    @cached_property
    def load(self) -> Floats:
        """(n,) ∫ φ_i over the blocks' section."""
        mesh = self.solution.solution.problem.mesh
        return np.asarray(np.sum([region_load(mesh, region) for region in self.regions], axis=0))

    @cached_property
    def source(self) -> Floats:
        """(n,) ∫ φ_i J over the blocks' section: the currents' load."""
        problem = self.solution.solution.problem
        total = np.zeros(problem.mesh.nodes.shape[0])
        for by_radius, density in zip((False, True), current_density(problem), strict=True):
            for region in self.regions:
                if density[region]:
                    total += density[region] * region_load(problem.mesh, region, by_radius)
        return total

    @cached_property
    def energies(self) -> tuple[float, float]:
        """J."""
        solution = self.solution.solution
        energy, coenergy = energy_densities(solution.triangles, solution.psi)
        return float(energy[self.elements].sum() * self.extent), float(coenergy[self.elements].sum() * self.extent)

    @cached_property
    def stress(self) -> BodyForce:
        """By the stress tensor over the air around the blocks."""
        solution = self.solution.solution
        return stress_force(solution, smooth_weight(solution.problem, self.regions))

    @cached_property
    def lorentz(self) -> tuple[float, float, float]:
        """∫ J×B dV along (x, y) and its torque, or along z alone: (0, F_z, 0)."""
        b, points = self.flux_density, self.positions
        amount = self.current_density * self.measure * self.extent
        if not self.planar:
            return 0.0, -float(np.sum(amount * b[..., 0])), 0.0  # φ × r = −z
        first, second = -amount * b[..., 1], amount * b[..., 0]
        torque = points[..., 0] * second - points[..., 1] * first
        return float(first.sum()), float(second.sum()), float(torque.sum())

    def integral(self, values: Floats) -> float:
        """∫ values dV of values (m, q)."""
        return float(np.sum(values * self.measure) * self.extent)

    def potential(self, load: Floats) -> float:
        """∫ A load dV for a load over the section: A r dr dz = ψ dr dz."""
        return float(load @ self.solution.solution.psi) * self.extent


def _area(blocks: Blocks) -> float:
    return float(blocks.load.sum())


def _volume(blocks: Blocks) -> float:
    return float(blocks.measure.sum()) * blocks.extent


def _flux(blocks: Blocks) -> tuple[float, float]:
    b = blocks.flux_density
    return blocks.integral(b[..., 0]), blocks.integral(b[..., 1])


def _mean(values: tuple[float, ...], size: float) -> tuple[float, ...]:
    return tuple(value / size if size > 0 else 0.0 for value in values)


def _centroid(blocks: Blocks) -> tuple[float, ...]:
    """Of the section. ∫ r dr dz is the volume of a radian."""
    moments = blocks.load @ blocks.solution.solution.problem.mesh.nodes
    first = float(moments[0]) if blocks.planar else float(blocks.measure.sum())
    return _mean((first, float(moments[1])), _area(blocks))


def _moment(blocks: Blocks) -> float:
    points = blocks.positions
    return blocks.integral(np.sum(points**2, axis=-1) if blocks.planar else points[..., 0] ** 2)


def _loss(blocks: Blocks) -> float:
    """∫ J²/σ dV, with the conductivity as it is in the file: wire counts as if it filled its block."""
    model, region = blocks.solution.model, blocks.solution.solution.problem.mesh.region[blocks.elements]
    resistivity = np.zeros(len(model.labels))
    for number in blocks.regions:
        material = model.labels[number].material
        if material is not None and model.materials[material].conductivity > 0:
            resistivity[number] = 1 / model.materials[material].conductivity
    return blocks.integral(blocks.current_density**2 * resistivity[region][:, None])


@dataclass(frozen=True, slots=True)
class Integral:
    """numbers : of FEMM's mo_blockintegral, one for each component, or one for both where FEMM's is complex; () for
    what FEMM does not have. value : one or two components, x and y or r and z. wanted : in a report on every block.
    """

    name: str
    numbers: tuple[int, ...]
    unit: str
    value: Callable[[Blocks], tuple[float, ...]]
    wanted: bool = True


INTEGRALS: tuple[Integral, ...] = (
    Integral("area", (5,), "m²", lambda blocks: (_area(blocks),)),
    Integral("volume", (10,), "m³", lambda blocks: (_volume(blocks),)),
    Integral("energy", (2,), "J", lambda blocks: blocks.energies[:1]),
    Integral("coenergy", (17,), "J", lambda blocks: blocks.energies[1:]),
    Integral("A.J", (0,), "J", lambda blocks: (blocks.potential(blocks.source),)),
    Integral("current", (7,), "A", lambda blocks: (float(blocks.source.sum()),)),
    Integral("resistive_loss", (4,), "W", lambda blocks: (_loss(blocks),)),
    Integral("mean_A", (), "Wb/m", lambda blocks: _mean((blocks.potential(blocks.load),), _volume(blocks))),
    Integral("mean_B", (), "T", lambda blocks: _mean(_flux(blocks), _volume(blocks))),
    Integral("lorentz_force", (11, 12), "N", lambda blocks: blocks.lorentz[:2]),
    Integral("lorentz_torque", (15,), "N m", lambda blocks: blocks.lorentz[2:]),
    Integral("integral_A", (1,), "Wb m²", lambda blocks: (blocks.potential(blocks.load),), False),
    Integral("integral_B", (8, 9), "T m³", _flux, False),
    Integral("total_loss", (6,), "W", lambda blocks: (_loss(blocks),), False),
    Integral("stress_force", (18, 19), "N", lambda blocks: blocks.stress.force, False),
    Integral("stress_torque", (22,), "N m", lambda blocks: (blocks.stress.torque,), False),
    Integral("moment_of_inertia", (24,), "m⁵", lambda blocks: (_moment(blocks),), False),
    Integral("centroid", (25,), "m", _centroid, False),
)
"""The moment of inertia is of unit density: about the origin in a plane, else about the axis.

FEMM's others are about alternating currents (3, 13, 14, 16, 20, 21, 23), which these files do not have.
"""


def block_integral(solution: FemmSolution, which: str | int, group: int | None = None) -> tuple[float, ...]:
    """One integral by its name, or one component by FEMM's number, over a group's blocks or all of them.

    Raises SpecError for an integral that is not known, or a group without blocks.
    """
    for item in INTEGRALS:
        if which == item.name or which in item.numbers:
            values = item.value(Blocks.of(solution, group))
            if which in item.numbers and len(item.numbers) == len(values):
                return (values[item.numbers.index(int(which))],)
            return values
    numbers = sorted(number for item in INTEGRALS for number in item.numbers)
    raise SpecError(
        f"A block integral must be one of {', '.join(item.name for item in INTEGRALS)}, or FEMM's number "
        f"{', '.join(map(str, numbers))}; got {shown(which)}."
    )


def block_integrals(solution: FemmSolution, group: int | None = None) -> dict[str, float | tuple[float, ...]]:
    """Those that are worth a report, by name, in SI; over a group's blocks or all of them.

    Raises SpecError for a group without blocks.
    """
    blocks = Blocks.of(solution, group)
    found = {item.name: item.value(blocks) for item in INTEGRALS if item.wanted}
    return {name: values[0] if len(values) == 1 else values for name, values in found.items()}
