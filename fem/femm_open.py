"""An open boundary for any drawing: its edge gives way to a circle, and a second circle stands for the rest of space.

The circles' rims are the same unknowns, and an inversion carries the exterior of the first into the second (`kelvin`):
nothing is truncated, so the circle's size is no matter of accuracy. Traversed with the domain on the left, FEMM joins
the start of one periodic arc to the end of the other, a mirror image; an empty exterior does not mind.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import shapely

from fluxbore.design.errors import SpecError, one_line, shown
from fluxbore.fem.edges import Drawing, Edges
from fluxbore.fem.femm_model import (
    Arc,
    BlockLabel,
    BlockProperty,
    BoundaryProperty,
    Exterior,
    FemmModel,
    Node,
    PointProperty,
    Segment,
)
from fluxbore.fem.femm_problem import drawing
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.outline_check import LEAST, cleaned, pieces

MARGIN = 1.2
"""Radius of the circle over that of the drawing."""

APART = 2.5
"""Distance of the circles' centres over their radius."""

MOST_TRIANGLES = 400_000


@dataclass(frozen=True, slots=True)
class Shell:
    """The edge of a drawing. curves : their numbers. domain : what they enclose. points : (n, 2) of its sides (m)."""

    curves: tuple[int, ...]
    domain: shapely.Polygon
    points: Floats


def with_open_boundary(model: FemmModel) -> FemmModel:
    """The model in free space instead of within its outermost lines.

    Raises SpecError for what cannot be opened: a condition there that is more than "far away", symmetry, an exterior;
    MeshError for a drawing without faces.
    """
    if model.exterior is not None or any(label.external for label in model.labels):
        raise SpecError(f"{_file(model)} has an exterior region: its boundary is open already.")
    shell = _shell(model)
    model = _stripped(model, shell)
    model, air = _with_air(model)
    return _ball(model, shell, air) if model.axisymmetric else _disc(model, shell, air)


def _shell(model: FemmModel) -> Shell:
    outline = cleaned(drawing(model).outline)
    parts = Drawing(outline, pieces(outline))
    seeds = np.array([seed.position for seed in outline.seeds]).reshape(-1, 2)
    sides = parts.untangled(parts.edges(), seeds, MOST_TRIANGLES)
    domain = shapely.union_all(shapely.get_parts(shapely.polygonize(sides.lines)))
    if domain.is_empty:
        raise SpecError(f"{_file(model)} must enclose an area to be opened; its outline is open.")
    if not isinstance(domain, shapely.Polygon):
        count = len(shapely.get_parts(domain))
        raise SpecError(f"{_file(model)} must be one connected drawing to be opened; it has {count} closed parts.")
    outer = _on(shapely.get_exterior_ring(domain), sides, parts.size)
    if model.axisymmetric:
        outer = outer[sides.middles[outer, 0] > LEAST * parts.size]
    curves = np.unique(parts.pieces.curve[sides.piece[outer]])
    used = np.unique(sides.ends)
    return Shell(tuple(curves.tolist()), domain, np.asarray(sides.nodes[used]))


def _on(ring: shapely.LinearRing, sides: Edges, size: float) -> Ints:
    near = shapely.dwithin(shapely.points(sides.middles), ring, LEAST * size)
    return np.flatnonzero(near)


def _stripped(model: FemmModel, shell: Shell) -> FemmModel:
    """Without the conditions of the outermost lines."""
    segments, arcs, nodes = list(model.segments), list(model.arcs), list(model.nodes)
    rim: list[Segment | Arc] = [*segments, *arcs]
    given = [number for number in shell.curves if rim[number].boundary is not None]
    bare = [number for number in shell.curves if rim[number].boundary is None]
    if given and bare:
        raise SpecError(
            f"{_file(model)} must have a condition on all of its outermost lines or on none to be opened; the one from "
            f"{_at(model, rim[bare[0]].start)} to {_at(model, rim[bare[0]].end)} has none, as a plane of symmetry has."
        )
    for number in given:
        boundary = rim[number].boundary
        assert boundary is not None
        _check_zero(model, model.boundaries[boundary])
        if number < len(segments):
            segments[number] = replace(segments[number], boundary=None)
        else:
            arcs[number - len(segments)] = replace(arcs[number - len(segments)], boundary=None)
    for number in {end for k in shell.curves for end in (rim[k].start, rim[k].end)}:
        prop = nodes[number].prop
        if prop is None or model.points[prop].current:
            continue
        if model.points[prop].potential:
            raise SpecError(
                f"{_file(model)} must have no potential but zero on its outermost lines to be opened; the point "
                f"{_at(model, number)} has {model.points[prop].potential:g} Wb/m."
            )
        nodes[number] = replace(nodes[number], prop=None)
    return replace(model, segments=tuple(segments), arcs=tuple(arcs), nodes=tuple(nodes))


def _check_zero(model: FemmModel, item: BoundaryProperty) -> None:
    """Only A = 0 and an asymptotic condition stand for what is far away."""
    if item.kind in ("periodic", "antiperiodic"):
        raise SpecError(
            f"{_file(model)} must not be periodic at its outermost lines to be opened; {shown(item.name)} is "
            f"{item.kind}."
        )
    if item.kind == "mixed" and item.c1:
        raise SpecError(
            f"{_file(model)} must have no field imposed on its outermost lines to be opened; {shown(item.name)} has "
            f"c1 = {item.c1:g} A/m."
        )
    if item.kind == "prescribed" and (item.a0 or item.a1 or item.a2):
        raise SpecError(
            f"{_file(model)} must have no potential but zero on its outermost lines to be opened; {shown(item.name)} "
            f"has A0 = {item.a0:g}, A1 = {item.a1:g}, A2 = {item.a2:g}."
        )


def _with_air(model: FemmModel) -> tuple[FemmModel, int]:
    """The number of a material that is nothing but air, added where there is none."""
    for number, item in enumerate(model.materials):
        if item.name.lower().startswith("air") and item == BlockProperty(item.name, conductivity=item.conductivity):
            return model, number
    name = _fresh("Air", (item.name for item in model.materials))
    return replace(model, materials=(*model.materials, BlockProperty(name))), len(model.materials)


def _ball(model: FemmModel, shell: Shell, air: int) -> FemmModel:
    """Axisymmetric: a half disc about the drawing's middle, and one above it."""
    unit, z = model.metres, shell.points[:, 1]
    centre = float(z.min() + z.max()) / 2
    radius = MARGIN * float(np.hypot(shell.points[:, 0], z - centre).max())
    far, n = centre + APART * radius, len(model.nodes)
    low, high = centre - radius, centre + radius
    ends = (low, high, far - radius, far + radius)
    seam = len(model.boundaries)
    half = shapely.Point(0.0, centre).buffer(radius, 64).intersection(shapely.box(0.0, low, radius, high))
    return replace(
        model,
        boundaries=(*model.boundaries, BoundaryProperty(_seam_name(model, "open boundary"), "periodic")),
        nodes=(*model.nodes, *(Node(0.0, end / unit) for end in ends)),
        segments=(*model.segments, *_axis(model, shell, (n, low), (n + 1, high)), Segment(n + 2, n + 3)),
        arcs=(*model.arcs, Arc(n, n + 1, 180.0, boundary=seam), Arc(n + 2, n + 3, 180.0, boundary=seam)),
        labels=(
            *model.labels,
            *_between(half, shell, air, unit),
            BlockLabel(radius / 2 / unit, far / unit, air, external=True),
        ),
        exterior=Exterior(far / unit, radius / unit, radius / unit),
    )


def _axis(model: FemmModel, shell: Shell, low: tuple[int, float], high: tuple[int, float]) -> list[Segment]:
    """Segments of the axis from a node (number, z in m) to another where the drawing has none."""
    unit = model.metres
    tolerance = LEAST * float(np.hypot(*np.ptp(shell.points, axis=0)))

    def on_axis(number: int) -> bool:
        return abs(model.nodes[number].x * unit) <= tolerance

    drawn = [
        sorted((model.nodes[s.start].y * unit, model.nodes[s.end].y * unit))
        for s in model.segments
        if on_axis(s.start) and on_axis(s.end)
    ]
    curves: list[Segment | Arc] = [*model.segments, *model.arcs]
    used = {end for curve in curves for end in (curve.start, curve.end)}
    stops = sorted([low, high, *((k, model.nodes[k].y * unit) for k in used if on_axis(k))], key=lambda stop: stop[1])
    missing = []
    for (start, a), (end, b) in pairwise(stops):
        middle = (a + b) / 2
        if b - a > tolerance and not any(lower <= middle <= upper for lower, upper in drawn):
            missing.append(Segment(start, end))
    return missing


def _disc(model: FemmModel, shell: Shell, air: int) -> FemmModel:
    """Planar: a circle about the drawing's middle and one beside it, with A = 0 in its centre, at infinity."""
    unit = model.metres
    lowest, highest = shell.points.min(axis=0), shell.points.max(axis=0)
    x, y = ((lowest + highest) / 2).tolist()
    radius = MARGIN * float(np.hypot(*(shell.points - (x, y)).T).max())
    far, n, seam = x + APART * radius, len(model.nodes), len(model.boundaries)
    ends = (x - radius, x + radius, far - radius, far + radius)
    infinity = PointProperty(_fresh("infinity", (item.name for item in model.points)), 0.0)
    seams = [BoundaryProperty(_seam_name(model, f"open boundary {half}"), "periodic") for half in ("below", "above")]
    circle = shapely.Point(x, y).buffer(radius, 64)
    return replace(
        model,
        points=(*model.points, infinity),
        boundaries=(*model.boundaries, *seams),
        nodes=(
            *model.nodes,
            *(Node(end / unit, y / unit) for end in ends),
            Node(far / unit, y / unit, len(model.points)),
        ),
        arcs=(
            *model.arcs,
            Arc(n, n + 1, 180.0, boundary=seam),
            Arc(n + 1, n, 180.0, boundary=seam + 1),
            Arc(n + 2, n + 3, 180.0, boundary=seam),
            Arc(n + 3, n + 2, 180.0, boundary=seam + 1),
        ),
        labels=(
            *model.labels,
            *_between(circle, shell, air, unit),
            BlockLabel(far / unit, (y + radius / 2) / unit, air),
        ),
    )


def _between(circle: shapely.Geometry, shell: Shell, air: int, unit: float) -> list[BlockLabel]:
    """One label in each face between the drawing and the circle."""
    rest = shapely.get_parts(circle.difference(shell.domain))
    rest = rest[shapely.area(rest) > 1e-9 * shapely.area(circle)]
    places = shapely.get_coordinates(shapely.point_on_surface(rest)) / unit
    return [BlockLabel(x, y, air) for x, y in places.tolist()]


def _seam_name(model: FemmModel, name: str) -> str:
    return _fresh(name, (item.name for item in model.boundaries))


def _fresh(name: str, taken: Iterable[str]) -> str:
    """The name, numbered where it is taken."""
    known = {item.lower() for item in taken}
    number, fresh = 1, name
    while fresh.lower() in known:
        number += 1
        fresh = f"{name} {number}"
    return fresh


def _at(model: FemmModel, number: int) -> str:
    node = model.nodes[number]
    return f"({node.x:g}, {node.y:g})"


def _file(model: FemmModel) -> str:
    return one_line(model.path) or "The file"
