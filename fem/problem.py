"""A magnetostatic problem: mesh, materials, coils. What every source, a design or a file, is turned into."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import pi
from typing import Protocol

from fluxbore.fem.mesh import Floats, Ints, Mesh
from fluxbore.fem.reluctivity import VACUUM_RELUCTIVITY, ReluctivityCurve

Field = Callable[[Floats], Floats]
"""A vector at each point: (..., 2) positions in m -> (..., 2)."""


NEXT_TO_AIR = 1e-3
"""Of the reluctivity: a material this near to vacuum changes a force by less than other errors do."""


class Grade(Protocol):
    """A factor on a linear material's reluctivity that varies in space."""

    def factor(self, positions: Floats) -> Floats:
        """(...) at positions (..., 2) in m."""
        ...


@dataclass(frozen=True, slots=True)
class Stack:
    """Sheets of a soft iron seen from the side: the field runs along them or across them.

    fill : share of iron. along : component that runs along the sheets, 0 for x or r, 1 for y or z.

    Along, the iron takes all the flux; across, iron and gaps carry the same flux one after the other:
    w(B) = fill · w_iron(B̃) + (1 − fill) B_across²/(2 μ0), where B̃ has the components B_along/fill and B_across.
    """

    fill: float
    along: int


@dataclass(frozen=True, slots=True, eq=False)
class MagneticMaterial:
    """How a region answers the field: H = ν(B) B − H_c.

    reluctivity : m/H along (r, z) or (x, y), one number for both; where there is no curve.
    coercivity : H_c (A/m) along (r, z) or (x, y); a magnet's may vary in space.
    curve : a soft iron's, or a nonlinear magnet's shifted by its coercivity. stack : its sheets, seen from the side.
    grade : factor on the reluctivity, such as that of a Kelvin-transformed exterior.
    """

    reluctivity: float | tuple[float, float] = VACUUM_RELUCTIVITY
    coercivity: tuple[float, float] | Field = (0.0, 0.0)
    curve: ReluctivityCurve | None = None
    stack: Stack | None = None
    grade: Grade | None = None

    @classmethod
    def magnet(cls, remanence: tuple[float, float], reluctivity: float = VACUUM_RELUCTIVITY) -> MagneticMaterial:
        """A linear magnet of this remanence (T) along (r, z) or (x, y)."""
        return cls(reluctivity, (reluctivity * remanence[0], reluctivity * remanence[1]))

    @property
    def remanence(self) -> tuple[float, float]:
        """T, of a linear magnet magnetised one way; zero elsewhere."""
        if callable(self.coercivity) or self.curve is not None:
            return 0.0, 0.0
        first, second = self.components
        return self.coercivity[0] / first, self.coercivity[1] / second

    @property
    def components(self) -> tuple[float, float]:
        """Linear part of the reluctivity (m/H) along (r, z) or (x, y); of iron only what lies between its sheets."""
        if self.curve is not None:
            if self.stack is None:
                return 0.0, 0.0
            gaps = (1 - self.stack.fill) * VACUUM_RELUCTIVITY
            return (0.0, gaps) if self.stack.along == 0 else (gaps, 0.0)
        if isinstance(self.reluctivity, tuple):
            return self.reluctivity
        return self.reluctivity, self.reluctivity

    @property
    def magnetic(self) -> bool:
        """Whether it is anything but air to the field. Copper, at 10 millionths from air, is air."""
        if self.curve is not None or self.grade is not None:
            return True
        air = all(abs(part / VACUUM_RELUCTIVITY - 1) < NEXT_TO_AIR for part in self.components)
        return not air or callable(self.coercivity) or self.coercivity != (0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Conductor:
    """A region that a circuit's current flows through.

    density : A/m² for one ampere of the circuit, everywhere the same; turns per area times their sign. by_radius : the
    density is A/m instead and divided by the radius, as in a solid ring under one voltage per turn.
    """

    region: int
    density: float
    by_radius: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Circuit:
    """Coils in series.

    density : (n,) ∫ φ_i · (turns per area) dr dz, the load of one ampere and, times ψ, the linkage per radian: what
        one ampere does to the field and what the field does to the circuit are the same numbers.
    conductors : the regions it came from, where coils are regions of the mesh.
    """

    name: str
    density: Floats
    current: float = 0.0
    conductors: tuple[Conductor, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class EdgeTerms:
    """Element matrices of a condition on edges, H_t + c0 A + c1 = 0, added to those of the elements that own them.

    elements : (k,). matrices : (k, 6, 6). load : (n,) of c1.
    """

    elements: Ints
    matrices: Floats
    load: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Problem:
    """A mesh with the material of each of its regions, and the circuits that run through it.

    materials : by the mesh's region index. sources : circuits that nobody measures, such as a given current density.
    prescribed : (n,) ψ at the nodes that are not unknown; zero without it. edges : conditions of the third kind.
    depth : m into the page, of a planar problem; an axisymmetric one goes all the way round.
    """

    mesh: Mesh
    materials: tuple[MagneticMaterial, ...]
    circuits: tuple[Circuit, ...] = ()
    sources: tuple[Circuit, ...] = ()
    prescribed: Floats | None = None
    edges: EdgeTerms | None = None
    depth: float = 1.0

    @property
    def extent(self) -> float:
        """What integrals over the section are multiplied by: 2π of revolution, or the depth (m)."""
        return 2 * pi if self.mesh.chart == "axisymmetric" else self.depth
