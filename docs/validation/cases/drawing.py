"""Drawing a model as one does in FEMM: lines, circles and labels; lines are cut where points lie on them."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field, replace

import numpy as np

from fluxbore.fem.femm_model import (
    Arc,
    BlockLabel,
    BlockProperty,
    BoundaryKind,
    BoundaryProperty,
    CircuitProperty,
    Exterior,
    FemmModel,
    Lamination,
    LengthUnit,
    Node,
    PointProperty,
    Segment,
)

MU_0 = 4e-7 * np.pi


@dataclass
class Drawing:
    """Lengths in the file's unit; materials, boundaries and circuits are known by their number."""

    axisymmetric: bool
    unit: LengthUnit = "millimeters"
    depth: float = 1.0
    exterior: Exterior | None = None
    points: list[PointProperty] = field(default_factory=list)
    boundaries: list[BoundaryProperty] = field(default_factory=list)
    materials: list[BlockProperty] = field(default_factory=list)
    circuits: list[CircuitProperty] = field(default_factory=list)
    nodes: list[Node] = field(default_factory=list)
    segments: list[Segment] = field(default_factory=list)
    arcs: list[Arc] = field(default_factory=list)
    labels: list[BlockLabel] = field(default_factory=list)

    def node(self, x: float, y: float) -> int:
        """The number of the point here, a new one where there is none."""
        for number, known in enumerate(self.nodes):
            if np.hypot(known.x - x, known.y - y) < 1e-9 * (1 + np.hypot(x, y)):
                return number
        self.nodes.append(Node(float(x), float(y)))
        return len(self.nodes) - 1

    def point(self, x: float, y: float, prop: PointProperty) -> None:
        self.points.append(prop)
        number = self.node(x, y)
        self.nodes[number] = replace(self.nodes[number], prop=len(self.points) - 1)

    def line(self, *corners: tuple[float, float], boundary: int | None = None) -> None:
        numbers = [self.node(*corner) for corner in corners]
        self.segments += [Segment(a, b, boundary=boundary) for a, b in itertools.pairwise(numbers) if a != b]

    def rectangle(self, x: tuple[float, float], y: tuple[float, float], boundary: int | None = None) -> None:
        self.line((x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1]), (x[0], y[0]), boundary=boundary)

    def circle(self, x: float, y: float, radius: float, lower: int | None = None, upper: int | None = None) -> None:
        """Two arcs, each with its boundary."""
        left, right = self.node(x - radius, y), self.node(x + radius, y)
        self.arcs += [Arc(left, right, 180.0, boundary=lower), Arc(right, left, 180.0, boundary=upper)]

    def half_disc(self, radius: float, z: float = 0.0, boundary: int | None = None) -> None:
        """A ball about a point of the axis."""
        bottom, top = self.node(0.0, z - radius), self.node(0.0, z + radius)
        self.arcs.append(Arc(bottom, top, 180.0, boundary=boundary))
        self.segments.append(Segment(bottom, top))

    def boundary(
        self,
        name: str,
        kind: BoundaryKind = "prescribed",
        a0: float = 0.0,
        a1: float = 0.0,
        a2: float = 0.0,
        c0: float = 0.0,
        c1: float = 0.0,
    ) -> int:
        self.boundaries.append(BoundaryProperty(name, kind, a0, a1, a2, 0.0, c0, c1))
        return len(self.boundaries) - 1

    def material(
        self,
        name: str,
        mu: float | tuple[float, float] = 1.0,
        remanence: float = 0.0,
        density: float = 0.0,
        conductivity: float = 0.0,
        lamination: Lamination = "in plane",
        fill: float = 1.0,
        curve: tuple[tuple[float, float], ...] = (),
    ) -> int:
        """mu : relative, of all directions or of x and y. remanence : T. density : A/m². conductivity : S/m."""
        mu_x, mu_y = mu if isinstance(mu, tuple) else (mu, mu)
        coercivity = remanence / (MU_0 * mu_x)
        self.materials.append(
            BlockProperty(name, mu_x, mu_y, coercivity, density, conductivity, lamination, fill, curve)
        )
        return len(self.materials) - 1

    def circuit(self, name: str, current: float, series: bool = True) -> int:
        self.circuits.append(CircuitProperty(name, current, series))
        return len(self.circuits) - 1

    def label(
        self,
        x: float,
        y: float,
        material: int,
        circuit: int | None = None,
        turns: float = 1.0,
        group: int = 0,
        magnetisation: float | str = 0.0,
        external: bool = False,
        size: float | None = None,
    ) -> None:
        self.labels.append(BlockLabel(x, y, material, size, circuit, magnetisation, group, turns, external))

    def model(self) -> FemmModel:
        return FemmModel(
            self.axisymmetric,
            self.unit,
            self.depth,
            points=tuple(self.points),
            boundaries=tuple(self.boundaries),
            materials=tuple(self.materials),
            circuits=tuple(self.circuits),
            nodes=tuple(self.nodes),
            segments=self._cut(),
            arcs=tuple(self.arcs),
            labels=tuple(self.labels),
            exterior=self.exterior,
        )

    def _cut(self) -> tuple[Segment, ...]:
        """Every segment from node to node, once; of two in one place that with a boundary is kept."""
        places = np.array([(node.x, node.y) for node in self.nodes])
        found: dict[frozenset[int], Segment] = {}
        for segment in self.segments:
            a, b = places[segment.start], places[segment.end]
            chord = b - a
            t = (places - a) @ chord / (chord @ chord)
            off = np.hypot(*(places - a - t[:, None] * chord).T)
            on = np.flatnonzero((off < 1e-9 * np.hypot(*chord)) & (t > -1e-9) & (t < 1 + 1e-9))
            stops = on[np.argsort(t[on])]
            for start, end in zip(stops[:-1].tolist(), stops[1:].tolist(), strict=True):
                key = frozenset((start, end))
                if key not in found or segment.boundary is not None:
                    found[key] = replace(segment, start=start, end=end)
        return tuple(found.values())


def open_ball(drawing: Drawing, radius: float) -> None:
    """An axisymmetric drawing's outermost half circle, A = 0 until an open boundary takes its place."""
    drawing.half_disc(radius, boundary=drawing.boundary("A=0"))


def open_disc(drawing: Drawing, radius: float) -> None:
    """A planar drawing's outermost circle, likewise."""
    outside = drawing.boundary("A=0")
    drawing.circle(0.0, 0.0, radius, outside, outside)
