"""What a picture of a solution shows: a window, the field in it on small straight triangles, and its field lines."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fluxbore.fem.element import shape
from fluxbore.fem.femm_solution import FemmSolution
from fluxbore.fem.mesh import Floats, Ints, in_space
from fluxbore.fem.probe import field_in

MARGIN = 0.3
"""Of what is not air, on each side of it, as a share of its larger side."""

AXIS = 2.0
"""Windows nearer to the axis than so many times their own size reach down to it."""

SHARE = 0.995
"""Of each block's area in the window, below the top of the colour scale: |B| at corners has no top."""

FINE = 40_000
"""Triangles in a picture, about, at which field lines are smooth to the eye; coarser elements are divided more."""

Window = tuple[float, float, float, float]
"""Left, right, bottom, top, m."""


def whole(solution: FemmSolution) -> Window:
    """All that is meshed."""
    points = solution.solution.problem.mesh.positions
    (left, bottom), (right, top) = points.min(axis=0), points.max(axis=0)
    return float(left), float(right), float(bottom), float(top)


def interesting(solution: FemmSolution) -> Window:
    """What is magnetic or carries current, with a margin; the whole model where there is nothing of the kind."""
    problem = solution.solution.problem
    model = solution.model
    conducting = {c.region for item in (*problem.circuits, *problem.sources) for c in item.conductors}
    chosen = [
        number
        for number, label in enumerate(model.labels)
        if not label.external and (problem.materials[number].magnetic or number in conducting)
    ]
    mesh = problem.mesh
    seen = np.isin(mesh.region, chosen)
    if not seen.any():
        return whole(solution)
    points = mesh.positions[mesh.elements[seen]].reshape(-1, 2)
    low, high = points.min(axis=0), points.max(axis=0)
    # Thin parts need some air to be seen in: a wire beside another, a sheet.
    margin = MARGIN * float((high - low).max())
    inner = mesh.positions[mesh.elements[~np.isin(mesh.region, external(solution))]].reshape(-1, 2)
    low, high = np.maximum(low - margin, inner.min(axis=0)), np.minimum(high + margin, inner.max(axis=0))
    if model.axisymmetric and low[0] < AXIS * float((high - low).max()):
        low[0] = max(0.0, float(inner[:, 0].min()))
    return float(low[0]), float(high[0]), float(low[1]), float(high[1])


def external(solution: FemmSolution) -> list[int]:
    """Labels of a Kelvin exterior, which is not where it is drawn."""
    return [number for number, label in enumerate(solution.model.labels) if label.external]


@dataclass(frozen=True, slots=True, eq=False)
class Sampled:
    """The field in the window on small straight triangles.

    points : (n, 2) m, each of one region. triangles : (m, 3). region : (m,). flux_density : (n,) |B|. potential : (n,).
    """

    points: Floats
    triangles: Ints
    region: Ints
    flux_density: Floats
    potential: Floats


def sampled(solution: FemmSolution, window: Window) -> Sampled:
    """Each element that is seen, cut into n² triangles."""
    solved = solution.solution
    mesh = solved.problem.mesh
    left, right, bottom, top = window
    x, y = np.moveaxis(mesh.positions[mesh.elements], -1, 0)
    seen = (x.max(1) >= left) & (x.min(1) <= right) & (y.max(1) >= bottom) & (y.min(1) <= top)
    elements = np.flatnonzero(seen)
    parts = int(np.clip(np.ceil(np.sqrt(FINE / max(elements.size, 1))), 2, 8))
    places, small = _cut(parts)
    count = places.shape[0]
    holder, place = np.repeat(elements, count), np.tile(places, (elements.size, 1))
    points = in_space(mesh.chart, np.einsum("qn,mnc->mqc", shape(places), mesh.nodes[mesh.elements[elements]]))
    field = field_in(solved, solution.field, holder, place)
    triangles = (count * np.arange(elements.size)[:, None, None] + small).reshape(-1, 3)
    # One point for neighbours of one region, so that lines run on from one triangle to the next.
    points = points.reshape(-1, 2)
    grain = 1e-7 * float(np.ptp(points, axis=0).max())
    keys = np.column_stack((mesh.region[holder], np.rint(points / grain)))
    _, first, back = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    return Sampled(
        points[first],
        back.ravel()[triangles],
        np.repeat(mesh.region[elements], parts**2),
        np.hypot(*field.flux_density[first].T),
        field.potential[first],
    )


def _cut(parts: int) -> tuple[Floats, Ints]:
    """A triangle cut into parts² equal ones: barycentric places of their corners, and the triangles."""
    index: dict[tuple[int, int], int] = {}
    for i in range(parts + 1):
        for j in range(parts + 1 - i):
            index[i, j] = len(index)
    places = np.array([(parts - i - j, i, j) for i, j in index]) / parts
    up = [(index[i, j], index[i + 1, j], index[i, j + 1]) for i, j in index if i + j < parts]
    down = [(index[i + 1, j], index[i + 1, j + 1], index[i, j + 1]) for i, j in index if i + j < parts - 1]
    return places, np.array(up + down)


def colour_limit(field: Sampled) -> float:
    """The top of the colours (T): what all but a sliver of each block's area stays below."""
    corners = field.points[field.triangles]
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
    density = field.flux_density[field.triangles].mean(axis=1)
    top = 0.0
    for region in np.unique(field.region):
        mine = np.flatnonzero(field.region == region)
        order = mine[np.argsort(density[mine])]
        below = np.cumsum(area[order])
        top = max(top, float(density[order[np.searchsorted(below, SHARE * below[-1])]]))
    return top if top > 0 else 1.0


def field_lines(field: Sampled, count: int, apart: Sequence[int] = ()) -> list[Floats]:
    """Level lines (k, 2) m of A or r A in the window; half a step off the ends, so that the axis is none.

    apart : regions that do not count for the levels' range.
    """
    from matplotlib.figure import Figure
    from matplotlib.tri import Triangulation

    inner = field.triangles[~np.isin(field.region, apart)]
    values = field.potential[inner if inner.size else field.triangles]
    low, high = float(values.min()), float(values.max())
    if count < 1 or not high - low > 1e-9 * max(abs(low), abs(high)):
        return []
    levels = low + (high - low) * (np.arange(count) + 0.5) / count
    plot = Figure().subplots()
    found: list[Floats] = []
    for region in np.unique(field.region):
        grid = Triangulation(field.points[:, 0], field.points[:, 1], field.triangles[field.region == region])
        contours = plot.tricontour(grid, field.potential, levels=levels)
        found += [np.asarray(line) for lines in contours.allsegs for line in lines if len(line) > 1]
    return found
