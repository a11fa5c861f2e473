"""What is to be meshed: points, lines and arcs that bound regions, and a seed inside each region.

The common form of every drawing that is not a mapped cross-section. Lengths are in metres, in space: (r, z) or (x, y).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fluxbore.fem.mesh import Chart, Floats

HOLE = -1
"""The region of a seed whose face is left empty."""


@dataclass(frozen=True, slots=True)
class Curve:
    """A straight line, or an arc of a circle, from one point to another.

    start, end : numbers of the outline's points. turn : angle of the arc (rad), counter-clockwise from start to end, in
    (0, π]; 0 for a line. size : greatest distance between neighbouring nodes (m), None for the regions' own.
    condition : number of the boundary condition it carries, None for none.
    """

    start: int
    end: int
    turn: float = 0.0
    size: float | None = None
    condition: int | None = None


@dataclass(frozen=True, slots=True)
class Seed:
    """A point inside a face of the outline, naming what fills it.

    position : m. region : number of the region, or `HOLE`. size : distance between nodes (m), None for automatic.
    default : fills every face that has no seed of its own.
    """

    position: tuple[float, float]
    region: int
    size: float | None = None
    default: bool = False


@dataclass(frozen=True, slots=True)
class Pair:
    """Two curves whose nodes are the same unknowns, up to a sign: periodic (+1) or antiperiodic (−1).

    reverse : whether the first curve's start meets the second one's end.
    """

    first: int
    second: int
    sign: int = 1
    reverse: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Outline:
    """points : (n, 2) m. unit : metres of one unit of the file's lengths, and name : its name, for error messages."""

    chart: Chart
    points: Floats
    curves: tuple[Curve, ...]
    seeds: tuple[Seed, ...]
    pairs: tuple[Pair, ...] = ()
    unit: float = 1.0
    unit_name: str = "m"

    def centre(self, curve: Curve) -> Floats:
        """(2,) the centre of an arc's circle (m)."""
        a, b = self.points[curve.start], self.points[curve.end]
        chord = b - a
        normal = np.array([-chord[1], chord[0]])
        return np.asarray((a + b) / 2 + normal / (2 * np.tan(curve.turn / 2)))

    def along(self, curve: Curve, t: Floats) -> Floats:
        """(..., 2) points at fractions t (...) of the curve's length (m)."""
        a, b = self.points[curve.start], self.points[curve.end]
        if curve.turn == 0:
            return np.asarray(a + (b - a) * t[..., None])
        centre = self.centre(curve)
        c, s = np.cos(curve.turn * t)[..., None], np.sin(curve.turn * t)[..., None]
        arm = a - centre
        return np.asarray(centre + c * arm + s * np.array([-arm[1], arm[0]]))

    def length(self, curve: Curve) -> float:
        """m."""
        chord = float(np.hypot(*(self.points[curve.end] - self.points[curve.start])))
        return chord if curve.turn == 0 else chord * curve.turn / 2 / float(np.sin(curve.turn / 2))
