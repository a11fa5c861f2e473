"""A magnetostatic problem: mesh, materials, coils. What every source, a design or a file, is turned into."""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.fem.mesh import Floats, Mesh
from fluxbore.fem.reluctivity import VACUUM_RELUCTIVITY, ReluctivityCurve


@dataclass(frozen=True, slots=True, eq=False)
class MagneticMaterial:
    """How a region answers the field: H = ν (B − B_rem), with constant ν or with a soft iron's curve.

    reluctivity : m/H, where there is no curve. remanence : T along (r, z) or (x, y).
    """

    reluctivity: float = VACUUM_RELUCTIVITY
    remanence: tuple[float, float] = (0.0, 0.0)
    curve: ReluctivityCurve | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Circuit:
    """Coils in series.

    density : (n,) ∫ φ_i · (turns per area) dr dz, the load of one ampere and, times ψ, the linkage per radian: what
        one ampere does to the field and what the field does to the circuit are the same numbers.
    """

    name: str
    density: Floats
    current: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class Problem:
    """A mesh with the material of each of its regions, and the circuits that run through it.

    materials : by the mesh's region index.
    """

    mesh: Mesh
    materials: tuple[MagneticMaterial, ...]
    circuits: tuple[Circuit, ...] = ()
