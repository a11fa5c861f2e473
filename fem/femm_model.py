"""What a FEMM 4 magnetics file says, in the file's own units and words.

Reading and writing are `femm_reader` and `femm_writer`; what it means for the solver is `femm_problem`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

LengthUnit = Literal["inches", "millimeters", "centimeters", "meters", "mils", "microns"]

METRES: dict[str, float] = {
    "inches": 0.0254,
    "millimeters": 1e-3,
    "centimeters": 1e-2,
    "meters": 1.0,
    "mils": 2.54e-5,
    "microns": 1e-6,
}
"""Length of each unit (m)."""

BoundaryKind = Literal["prescribed", "mixed", "periodic", "antiperiodic"]
Lamination = Literal["in plane", "parallel to x", "parallel to y", "wire"]


@dataclass(frozen=True, slots=True)
class PointProperty:
    """potential : prescribed A (Wb/m), None where there is a current. current : A, out of the page."""

    name: str
    potential: float | None = 0.0
    current: float = 0.0


@dataclass(frozen=True, slots=True)
class BoundaryProperty:
    """A condition on segments and arcs.

    prescribed : A = (a0 + a1 x + a2 y) cos φ in Wb/m with x, y in the file's unit, phase φ in degrees; in polar
    coordinates x is the distance from the origin and y the angle in degrees. mixed : H_t + c0 A + c1 = 0, c0 in m/H
    per m, c1 in A/m.
    """

    name: str
    kind: BoundaryKind
    a0: float = 0.0
    a1: float = 0.0
    a2: float = 0.0
    phase: float = 0.0
    c0: float = 0.0
    c1: float = 0.0


@dataclass(frozen=True, slots=True)
class BlockProperty:
    """A material.

    mu_x, mu_y : relative permeabilities along x or r and y or z, where there is no curve. coercivity : H_c (A/m).
    current_density : A/m² (the file has MA/m²). conductivity : S/m (the file has MS/m). lamination, fill : how the
    sheets lie and the share of steel. curve : (B in T, H in A/m) rows, empty for a linear material.
    """

    name: str
    mu_x: float = 1.0
    mu_y: float = 1.0
    coercivity: float = 0.0
    current_density: float = 0.0
    conductivity: float = 0.0
    lamination: Lamination = "in plane"
    fill: float = 1.0
    curve: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True, slots=True)
class CircuitProperty:
    """current : A. series : one current through every turn; otherwise the blocks share the current in parallel."""

    name: str
    current: float = 0.0
    series: bool = True


@dataclass(frozen=True, slots=True)
class Node:
    """x, y : file's unit. prop : number of the point property from 0, None for none."""

    x: float
    y: float
    prop: int | None = None
    group: int = 0


@dataclass(frozen=True, slots=True)
class Segment:
    """A straight line.

    start, end : node numbers from 0. size : greatest element side (file's unit), None for automatic. boundary : number
    of the boundary property from 0, None for none.
    """

    start: int
    end: int
    size: float | None = None
    boundary: int | None = None
    hidden: bool = False
    group: int = 0


@dataclass(frozen=True, slots=True)
class Arc:
    """An arc counter-clockwise from start to end. angle, max_segment : degrees."""

    start: int
    end: int
    angle: float
    max_segment: float = 5.0
    boundary: int | None = None
    hidden: bool = False
    group: int = 0


@dataclass(frozen=True, slots=True)
class Hole:
    x: float
    y: float
    group: int = 0


@dataclass(frozen=True, slots=True)
class BlockLabel:
    """What fills the face around a point.

    material, circuit : numbers of the block and circuit property from 0, None for none. A label without material is a
    hole. size : the mesh size (file's unit), None for automatic. magnetisation : degrees, or a formula of x, y, r, z,
    theta and R. external : in the exterior region of the Kelvin transformation. default : for faces without a label.
    """

    x: float
    y: float
    material: int | None
    size: float | None = None
    circuit: int | None = None
    magnetisation: float | str = 0.0
    group: int = 0
    turns: float = 1.0
    external: bool = False
    default: bool = False


@dataclass(frozen=True, slots=True)
class Exterior:
    """The Kelvin-transformed exterior of an axisymmetric file: extZo, extRo, extRi in the file's unit."""

    centre: float
    outer_radius: float
    inner_radius: float


@dataclass(frozen=True, slots=True)
class FemmModel:
    """A whole file. path : where it came from, for messages."""

    axisymmetric: bool
    unit: LengthUnit = "millimeters"
    depth: float = 1.0
    polar: bool = False
    precision: float = 1e-8
    min_angle: float = 30.0
    comment: str = ""
    points: tuple[PointProperty, ...] = ()
    boundaries: tuple[BoundaryProperty, ...] = ()
    materials: tuple[BlockProperty, ...] = ()
    circuits: tuple[CircuitProperty, ...] = ()
    nodes: tuple[Node, ...] = ()
    segments: tuple[Segment, ...] = ()
    arcs: tuple[Arc, ...] = ()
    holes: tuple[Hole, ...] = ()
    labels: tuple[BlockLabel, ...] = ()
    exterior: Exterior | None = None
    path: str = ""

    @property
    def metres(self) -> float:
        """Of one unit of the file's lengths."""
        return METRES[self.unit]
