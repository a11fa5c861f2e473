"""The picture of a solved FEMM file: |B| in colour, field lines, the drawing's own lines.

Unlike the report's pictures it has any shape and any unit, so the window and the colours' range are found from the
field. |B| is one raster image; lines and texts stay vectors in an SVG.
"""

from __future__ import annotations

import io
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from fluxbore.design.errors import OutputError, SpecError, one_line, shown
from fluxbore.fem.femm_solution import FemmSolution
from fluxbore.optimize.folder import write_atomic
from fluxbore.reports.flux_sample import (
    Sampled,
    Window,
    colour_limit,
    external,
    field_lines,
    interesting,
    sampled,
    whole,
)
from fluxbore.reports.svg import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.transforms import Bbox

LINES = 20
WIDTH = 900
WIDTHS = 300, 10_000
MOST_LINES = 1000
INK = "#14202b"
CURVE_POINTS = 64
DPI = 144

UPRIGHT = 0.9
"""Windows of more height over width have their colour bar beside them."""

BESIDE = 1.9
"""Inches for the texts and the bar beside an upright window."""

TALLEST = 1.5
"""Height of a window over the picture's width; a picture of a taller one is narrower than asked."""


def flux_plot(
    solution: FemmSolution,
    path: Path | str,
    *,
    lines: int = LINES,
    width: int = WIDTH,
    full: bool = False,
    names: bool = False,
) -> Path:
    """Draw a solution into a `.svg` or `.png` file.

    lines : so many levels of A or r A, none for 0. width : pixels, at 144 to the inch; less for a tall picture. full :
    the whole model rather than what is not air and its surroundings. names : of the materials at their labels, and of
    circuits with their turns, where there is room.

    Raises OutputError for a name that ends otherwise, or a file that cannot be written; SpecError for what cannot be
    drawn in these pixels.
    """
    path = Path(path)
    kind = path.suffix.lower().removeprefix(".")
    if kind not in ("svg", "png"):
        raise OutputError(f"A picture's name must end in .svg or .png; got {shown(path.name)}.")
    return write_atomic(path, picture(solution, kind, lines=lines, width=width, full=full, names=names))


def picture(
    solution: FemmSolution,
    kind: str,
    *,
    lines: int = LINES,
    width: int = WIDTH,
    full: bool = False,
    names: bool = False,
) -> bytes:
    """The file's bytes: the same solution gives the same picture.

    Raises SpecError for too few or too many pixels or lines.
    """
    for name, value, (least, most) in (("width", width, WIDTHS), ("lines", lines, (0, MOST_LINES))):
        if not least <= value <= most:
            raise SpecError(f"{name} of a picture must be from {least} to {most}; got {value}.")
    window = whole(solution) if full else interesting(solution)
    field = sampled(solution, window)
    with style(), warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph .* missing")  # a name in a script that the font has not: boxes
        figure, plot = _canvas(window, width)
        _colours(figure, plot, field, solution, _aspect(window))
        for line in field_lines(field, lines, external(solution)):
            x, y = (line / solution.model.metres).T
            plot.plot(x, y, color=INK, lw=0.55, alpha=0.8, solid_capstyle="butt")
        _drawing(plot, solution)
        _axes(plot, solution, window)
        if names:
            _names(figure, plot, solution, window)
        buffer = io.BytesIO()
        nothing = {"Software": None} if kind == "png" else dict.fromkeys(("Date", "Creator", "Format", "Type"))
        figure.savefig(buffer, format=kind, metadata=nothing, dpi=DPI, facecolor="white")
    return buffer.getvalue()


def _canvas(window: Window, width: int) -> tuple[Figure, Axes]:
    """A figure of the window's shape, so far as that leaves room for the texts."""
    from matplotlib.figure import Figure

    aspect = _aspect(window)
    inches = width / DPI
    if aspect <= UPRIGHT:  # the bar lies below
        height = max((inches - 0.9) * aspect, 0.25) + 1.3
    else:
        height = min((inches - BESIDE) * aspect, TALLEST * inches)
        inches, height = max(height / aspect, 0.6) + BESIDE, height + 0.6
    figure = Figure(figsize=(inches, height), dpi=DPI, layout="constrained")
    return figure, figure.subplots()


def _aspect(window: Window) -> float:
    left, right, bottom, top = window
    return (top - bottom) / (right - left)


def _colours(figure: Figure, plot: Axes, field: Sampled, solution: FemmSolution, aspect: float) -> None:
    from matplotlib.colors import LinearSegmentedColormap
    from matplotlib.tri import Triangulation

    metres = solution.model.metres
    stops = ["#f7fbff", "#c5e6ef", "#8fd3c0", "#c9dc6f", "#fcc24d", "#f58542", "#dd4a4c", "#a8326d"]
    colours = LinearSegmentedColormap.from_list("flux density", stops)
    x, y = (field.points / metres).T
    grid = Triangulation(x, y, field.triangles)
    limit = colour_limit(field)
    mesh = plot.tripcolor(
        grid, field.flux_density, shading="gouraud", cmap=colours, vmin=0, vmax=limit, rasterized=True
    )
    place: dict[str, Any] = {"location": "right", "aspect": 25 * max(aspect, 1.0)}
    if aspect <= UPRIGHT:
        place = {"location": "bottom", "aspect": 50}
    over = float(field.flux_density.max()) > limit * 1.001
    bar = figure.colorbar(mesh, ax=plot, extend="max" if over else "neither", extendfrac=0.03, pad=0.02, **place)
    bar.set_label("|B| (T)")
    bar.outline.set_visible(False)
    if bar.solids is not None:
        bar.solids.set(rasterized=True, edgecolor="face")


def _drawing(plot: Axes, solution: FemmSolution) -> None:
    """The file's segments and arcs."""
    outline = solution.drawing.outline
    for curve in outline.curves:
        t = np.linspace(0, 1, 2 if curve.turn == 0 else CURVE_POINTS)
        plot.plot(*(outline.along(curve, t) / outline.unit).T, color=INK, lw=1.0, solid_capstyle="round")


def _names(figure: Figure, plot: Axes, solution: FemmSolution, window: Window) -> None:
    """Of materials at the labels in the window, and the circuits with their turns; none over another or cut off."""
    model = solution.model
    left, right, bottom, top = window
    box = {"boxstyle": "round,pad=0.2", "facecolor": "white", "edgecolor": "none", "alpha": 0.8}
    texts = []
    for label in model.labels:
        x, y = label.x * model.metres, label.y * model.metres
        if label.material is None or not (left <= x <= right and bottom <= y <= top):
            continue
        text = one_line(model.materials[label.material].name)
        if label.circuit is not None:
            text += f"\n{one_line(model.circuits[label.circuit].name)}: {label.turns:g}"
        texts.append(plot.text(label.x, label.y, text, ha="center", va="center", fontsize=8, color=INK, bbox=box))
    figure.draw_without_rendering()  # lays out, so that places are known
    room = plot.get_window_extent()
    taken: list[Bbox] = []
    for item in texts:
        extent = item.get_window_extent()
        inside = room.x0 <= extent.x0 and extent.x1 <= room.x1 and room.y0 <= extent.y0 and extent.y1 <= room.y1
        if inside and not any(extent.overlaps(other) for other in taken):
            taken.append(extent)
        else:
            item.remove()


def _axes(plot: Axes, solution: FemmSolution, window: Window) -> None:
    left, right, bottom, top = (value / solution.model.metres for value in window)
    unit = solution.drawing.outline.unit_name
    first, second = ("r", "z") if solution.model.axisymmetric else ("x", "y")
    plot.grid(visible=False)
    plot.set_aspect("equal")
    rim = 0.004 * max(right - left, top - bottom)  # else half of a line on the rim is cut off
    plot.set_xlim(left - (0.0 if solution.model.axisymmetric and left <= 0 else rim), right + rim)
    plot.set_ylim(bottom - rim, top + rim)
    plot.set_xlabel(f"{first} ({unit})")
    plot.set_ylabel(f"{second} ({unit})")
    if not solution.solution.convergence.converged:
        plot.set_title("not converged")
