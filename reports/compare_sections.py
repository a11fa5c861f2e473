"""Sections of several designs under one another, all to one scale."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from fluxbore.reports.compare_content import ComparedDesign, Comparison
from fluxbore.reports.section_drawing import faces
from fluxbore.reports.svg import EDGE, Drawing, drawing, new_figure, style
from fluxbore.reports.wording import capital, listing, significant

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDTH = 1000.0
"""Of the picture; its height follows from the scale."""

TALLEST = 700.0
"""All sections together: what is far broader than long must not make the picture taller than a page."""

LEFT, RIGHT = 70.0, 20.0
"""Beside each section: the scale of radii, and air."""

ABOVE, BELOW = 34.0, 30.0
"""A section's title, and its numbers along the axis."""

LOW = 40.0
"""A section's height that leaves no room for numbers along it."""

LEGEND_ROW, COLUMNS = 20.0, 5

MARGIN = 0.03
"""Of the longest design, at each end of it."""

Extent = tuple[float, float, float]
"""Low end and high end along the axis, and largest radius (m)."""


def sections(comparison: Comparison) -> Drawing | None:
    """One section a design, beginning at its own lower end; None where no design has parts."""
    drawn = [(design, _extent(design)) for design in comparison.designs if design.assembly and design.assembly.parts]
    if not drawn:
        return None
    longest = max(high - low for _, (low, high, _) in drawn)
    span = (1 + 2 * MARGIN) * longest
    reaches = sum(2.2 * reach for _, (_, _, reach) in drawn)
    across = min((WIDTH - LEFT - RIGHT) / span, TALLEST / reaches)  # drawing units to a metre, along and across
    roles = _roles([design for design, _ in drawn])
    legend = 10.0 + LEGEND_ROW * math.ceil(len(roles) / COLUMNS)
    heights = [2.2 * reach * across for _, (_, _, reach) in drawn]
    total = legend + sum(height + ABOVE + BELOW for height in heights) + 20.0
    with style():
        from matplotlib.patches import Patch

        canvas = new_figure(WIDTH, total)
        canvas.set_layout_engine("none")  # the layout's own margins would be other scales
        top = total - legend
        for (design, extent), height in zip(drawn, heights, strict=True):
            top -= ABOVE + height
            box = (LEFT / WIDTH, top / total, span * across / WIDTH, height / total)
            _section(canvas.add_axes(box), design, extent, longest)
            if height < LOW:
                canvas.axes[-1].set_yticks([0.0])
            top -= BELOW
        canvas.axes[-1].set_xlabel("z from the lower end (mm)")
        keys = [Patch(facecolor=colour, edgecolor=EDGE, linewidth=0.5, label=role) for role, colour in roles.items()]
        canvas.legend(handles=keys, loc="upper left", ncols=COLUMNS, handlelength=1.2, borderaxespad=0.1)
        sizes = [
            f"{design.letter} {significant(1e3 * (high - low))} mm long and {significant(2e3 * reach)} mm across"
            for design, (low, high, reach) in drawn
        ]
        caption = "Longitudinal sections, all to one scale, each from its lower end on."
        return drawing(canvas, "sections", f"Sections to one scale: {listing(sizes)}.", caption, wide=True)


def _extent(design: ComparedDesign) -> Extent:
    assert design.assembly is not None
    points = [point for part in design.assembly.parts for point in part.profile]
    heights = [z for _, z in points]
    return min(heights), max(heights), max(r for r, _ in points)


def _roles(designs: list[ComparedDesign]) -> dict[str, tuple[float, float, float]]:
    """Role -> colour of its first part."""
    found: dict[str, tuple[float, float, float]] = {}
    for design in designs:
        assert design.assembly is not None
        for part in design.assembly.parts:
            found.setdefault(capital(part.role), part.colour)
    return found


def _section(plot: Axes, design: ComparedDesign, extent: Extent, longest: float) -> None:
    from matplotlib.patches import Polygon

    assert design.assembly is not None
    low, high, reach = extent
    for part in design.assembly.parts:
        for sign, angle in ((1, 0.0), (-1, math.pi)):
            for face in faces(part, angle):
                points = [((z - low) * 1e3, sign * r * 1e3) for r, z in face]
                plot.add_patch(Polygon(points, facecolor=part.colour, edgecolor=EDGE, linewidth=0.5))
    plot.set_xlim(-MARGIN * longest * 1e3, (1 + MARGIN) * longest * 1e3)
    plot.set_ylim(-1.1 * reach * 1e3, 1.1 * reach * 1e3)
    spare = MARGIN * longest
    plot.plot([-spare * 1e3, (high - low + spare) * 1e3], [0, 0], color=EDGE, lw=0.7, ls=(0, (12, 3, 2, 3)))
    plot.grid(visible=False)
    plot.set_ylabel("r (mm)")
    plot.locator_params(axis="y", nbins=5)
    plot.set_title(f"{design.letter}  {design.name}", loc="left", fontweight="bold")
