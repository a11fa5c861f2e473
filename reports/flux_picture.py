"""Pictures of the field: the whole machine as a strip, and two pole pitches of it from near.

Field lines are level lines of psi = r A_phi. The colours of |B| are one raster image inside the SVG, because as vectors
they would weigh megabytes; lines, outlines and texts stay vectors.
"""

from __future__ import annotations

import math
import re
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from fluxbore.design.spec import Spec
from fluxbore.reports.content import Array, FluxMap, Triangles
from fluxbore.reports.flux_hover import field_readout
from fluxbore.reports.svg import Drawing, drawing, new_figure, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import Colormap
    from matplotlib.figure import Figure
    from matplotlib.tri import Triangulation

LINES = 24
"""Field lines between the smallest and the largest flux, about: the step between two is a round number."""

SMOOTHED = 8_000
"""Most triangles in a picture whose field lines are drawn through a smooth interpolant; finer meshes need none."""

DARK = "#1c1036"
"""Of field lines and outlines: the raster beneath is light in every theme."""


def colour_limit(*maps: FluxMap | None) -> float:
    """The top of the colour scale (T), the same for every map of a page; single hot corners may run over it."""
    tops = [float(np.percentile(item.flux_density, 99.7)) for item in maps if item is not None]
    return max(math.ceil(max(tops) * 10) / 10, 0.1)


def flux_step(*maps: FluxMap | None) -> float:
    """The step of psi (Wb/rad) between field lines, the same for every map of a page; a round number of webers."""
    present = [item for item in maps if item is not None]
    span = max(float(item.flux.max()) for item in present) - min(float(item.flux.min()) for item in present)
    if span <= 0:
        return 1.0
    rough = 2 * math.pi * span / LINES
    power = 10.0 ** math.floor(math.log10(rough))
    return (
        min((1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0), key=lambda n: abs(n - rough / power))
        * power
        / (2 * math.pi)
    )


def flux_between(step: float) -> str:
    """What flows between neighbouring lines, round the whole circumference."""
    return f"{2 * math.pi * step * 1e6:.3g}\u00a0µWb"


def machine_strip(field: FluxMap, limit: float, step: float) -> Drawing:
    """The whole machine in section, above and below the axis."""
    reach = _outside(field)
    low, high = _extent(field)
    start, end = max(low - 0.35 * reach, float(field.z.min())), min(high + 0.35 * reach, float(field.z.max()))
    top = min(1.35 * reach, float(field.r.max()))
    with style():
        canvas = new_figure(1000.0, 945 * 2 * top / (end - start) + 52)
        plot = canvas.subplots()
        paint(plot, field, limit, step, (start, end, top), mirrored=True, edge=0.35, width=0.5)
        plot.set_xlabel("z (mm)")
        plot.set_ylabel("r (mm)")
        place = f"{field.position * 1e3:.4g} mm"
        alt = f"Flux density and field lines in the whole machine with the mover at z = {place}."
        caption = f"The whole machine in section at no current, mover at z = {place}."
        made = drawing(canvas, "flux-machine", alt, caption, wide=True, dpi=130)
        return replace(made, readouts=field_readout(plot, field))


def close_up(field: FluxMap, spec: Spec, limit: float, step: float, name: str, title: str) -> Drawing:
    """Two pole pitches in the middle of the mover, from the axis to a little outside the yoke."""
    start, end = _two_pitches(field, spec)
    top = 1.3 * _outside(field)
    with style():
        canvas = new_figure(500.0, 430.0)
        plot = canvas.subplots()
        mesh = paint(plot, field, limit, step, (start, end, top), mirrored=False, edge=0.8, width=0.8)
        _labels(plot, field, start, end, top)
        colour_bar(canvas, plot, mesh)
        plot.set_xlabel("z (mm)")
        plot.set_ylabel("r (mm)")
        alt = f"{title}: flux density, field lines and parts over two pole pitches."
        caption = f"{title}: two pole pitches at the middle of the mover."
        made = drawing(canvas, name, alt, caption, dpi=150)
        return replace(made, readouts=field_readout(plot, field))


def paint(
    plot: Axes,
    field: FluxMap,
    limit: float,
    step: float,
    window: tuple[float, float, float],
    *,
    mirrored: bool,
    edge: float,
    width: float,
) -> Any:
    """Colours, field lines and outlines in the window (start, end, top radius), in millimetres; the colour mesh."""
    from matplotlib.tri import Triangulation

    start, end, top = window
    corners = field.triangles
    r, z = field.r[corners], field.z[corners]
    seen = (z.max(1) >= start) & (z.min(1) <= end) & (r.min(1) <= top)
    used, triangles = np.unique(corners[seen], return_inverse=True)
    triangles = triangles.reshape(-1, 3)
    region = field.region[seen] if field.region is not None else None
    at_nodes = len(field.flux_density) == len(field.r)
    density = field.flux_density[used] if at_nodes else field.flux_density[seen]
    # |B| has no business above the scale's top: the raster is clipped there, and the bar's arrow says so.
    # Half a step off zero: the axis itself is a level line of no interest.
    first, last = math.floor(float(field.flux.min()) / step), math.ceil(float(field.flux.max()) / step)
    levels: Array = np.array([(i + 0.5) * step for i in range(first, max(last, first + 1))])
    mesh: Any = None
    for sign in (1, -1) if mirrored else (1,):
        grid = Triangulation(field.z[used] * 1e3, sign * field.r[used] * 1e3, triangles)
        look: dict[str, Any] = {"cmap": _colours(), "vmin": 0, "vmax": limit, "rasterized": True}
        mesh = plot.tripcolor(grid, density, shading="gouraud" if at_nodes else "flat", **look)
        for line in _level_lines(plot, grid, field.flux[used], levels, region):
            plot.plot(line[:, 0], line[:, 1], color=DARK, lw=width, alpha=0.75, solid_capstyle="butt")
        for _, outline in field.outlines:
            closed = np.vstack([outline, outline[:1]]) * 1e3
            plot.plot(closed[:, 1], sign * closed[:, 0], color=DARK, lw=edge, alpha=0.9)
    plot.grid(visible=False)
    plot.set_aspect("equal")
    plot.set_xlim(start * 1e3, end * 1e3)
    plot.set_ylim(-top * 1e3 if mirrored else 0, top * 1e3)
    return mesh


def _level_lines(plot: Axes, grid: Triangulation, flux: Array, levels: Array, region: Triangles | None) -> list[Array]:
    """The level lines as chains of points; drawn as plain lines they are thinned out to what the eye can see."""
    found: list[Array] = []
    for piece, values in _smooth(grid, flux, region):
        contours = plot.tricontour(piece, values, levels=levels)
        contours.remove()
        found += [np.asarray(line) for lines in contours.allsegs for line in lines if len(line) > 1]
    return found


def _smooth(grid: Triangulation, flux: Array, region: Triangles | None) -> list[tuple[Triangulation, Array]]:
    """The flux on a grid four times as fine, through a smooth interpolant, one material at a time.

    From near, straight pieces across large elements would show as corners that the field does not have; across the
    face of a magnet or an iron the field does have them.
    """
    if region is None or len(grid.triangles) > SMOOTHED:
        return [(grid, flux)]
    from matplotlib.tri import CubicTriInterpolator, Triangulation, UniformTriRefiner

    pieces = []
    for number in np.unique(region):
        used, triangles = np.unique(grid.triangles[region == number], return_inverse=True)
        piece = Triangulation(grid.x[used], grid.y[used], triangles.reshape(-1, 3))
        interpolant = CubicTriInterpolator(piece, flux[used], kind="geom")
        pieces.append(UniformTriRefiner(piece).refine_field(flux[used], triinterpolator=interpolant, subdiv=2))
    return pieces


def _colours() -> Colormap:
    """White to violet, of steadily falling lightness, and never so dark that a field line is lost in it."""
    from matplotlib.colors import LinearSegmentedColormap

    stops = ["#fdfcfa", "#fbe6c3", "#fabd93", "#f08577", "#cf5684", "#a04391", "#78388c"]
    return LinearSegmentedColormap.from_list("flux density", stops)


def colour_bar(canvas: Figure, plot: Axes | list[Axes], mesh: Any) -> None:
    """The scale of |B| below one picture or several."""
    bar = canvas.colorbar(mesh, ax=plot, orientation="horizontal", extend="max", fraction=0.05, aspect=40)
    bar.set_label("flux density |B| (T)")
    if bar.solids is not None:
        bar.solids.set(rasterized=True, edgecolor="face")
    bar.outline.set_visible(False)


def _labels(plot: Axes, field: FluxMap, start: float, end: float, top: float) -> None:
    """The name of each kind of part, once, where it is seen best: “coil 01 U” is a coil."""
    seen: dict[str, tuple[float, float, float]] = {}
    middle = (start + end) / 2
    for name, outline in field.outlines:
        kind = re.sub(r"([\s_-]+(\d+|[UVW]\d*))+$|\d+$", "", name.split(",")[0])
        (r0, z0), (r1, z1) = outline.min(axis=0), outline.max(axis=0)
        z0, z1, r1 = max(z0, start), min(z1, end), min(r1, top)
        if z1 - z0 < 0.05 * (end - start) or r1 - r0 < 0.03 * top:
            continue
        z, area = (z0 + z1) / 2, (z1 - z0) * (r1 - r0)
        best = seen.get(kind)
        if best is None or area > best[2] * 1.01 or (area > best[2] * 0.99 and abs(z - middle) < abs(best[1] - middle)):
            seen[kind] = (r0 + r1) / 2, z, area
    box = {"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.72}
    for kind, (r, z, _) in seen.items():
        plot.text(z * 1e3, r * 1e3, kind, ha="center", va="center", fontsize=10.5, color=DARK, bbox=box)


def _two_pitches(field: FluxMap, spec: Spec) -> tuple[float, float]:
    """z of the close-up's ends (m): two pole pitches around the magnets' middle, else the middle fifth of the map."""
    magnets = [outline[:, 1] for name, outline in field.outlines if "magnet" in name.lower()]
    pitch = spec.values.get("actuator.mover.pole_pitch")
    if not magnets or not isinstance(pitch, float):
        low, high = _extent(field)
        return low + 0.4 * (high - low), low + 0.6 * (high - low)
    middle = (min(m.min() for m in magnets) + max(m.max() for m in magnets)) / 2
    return middle - pitch, middle + pitch


def _outside(field: FluxMap) -> float:
    """The largest radius of any part (m); of the mesh where no part is drawn."""
    return max((float(outline[:, 0].max()) for _, outline in field.outlines), default=float(field.r.max()))


def _extent(field: FluxMap) -> tuple[float, float]:
    """z of the ends of all parts (m)."""
    if not field.outlines:
        return float(field.z.min()), float(field.z.max())
    return (
        min(float(outline[:, 1].min()) for _, outline in field.outlines),
        max(float(outline[:, 1].max()) for _, outline in field.outlines),
    )
