"""The machine in section, drawn from the parts' own profiles: needs neither CAD nor graphics libraries.

The plane of the section holds the axis and the x axis; what follows a helix is cut where it passes that plane.
"""

from __future__ import annotations

import math

from fluxbore.geometry import unrolled
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.outline import Profile
from fluxbore.geometry.part import Body
from fluxbore.reports.svg import EDGE, Drawing, drawing, new_figure, style

FEW = 6
"""Parts that the legend names one by one; of more it names their roles."""

TALLEST = 0.6
"""Height of the drawing, of its width."""


def section(assembly: Assembly, name: str = "section", width: float = 1000.0) -> Drawing:
    """Both halves of the longitudinal section, the axis dash-dotted. Narrower drawings have larger type."""
    low = min(z for part in assembly.parts for _, z in part.profile)
    high = max(z for part in assembly.parts for _, z in part.profile)
    reach = max(r for part in assembly.parts for r, _ in part.profile)
    with style():
        from matplotlib.patches import Patch, Polygon

        wide = width > 800
        height = (width - 50) * (2.24 * reach) / (1.06 * (high - low))
        # What is broader than long would be taller than the page.
        canvas = new_figure(width, min(height, TALLEST * width) + (75 if wide else 100))
        plot = canvas.subplots()
        roles: dict[str, tuple[float, float, float]] = {}
        for part in assembly.parts:
            roles.setdefault(part.name if len(assembly.parts) <= FEW else part.role, part.colour)
            for sign, angle in ((1, 0.0), (-1, math.pi)):
                for face in faces(part, angle):
                    points = [(z * 1e3, sign * r * 1e3) for r, z in face]
                    plot.add_patch(Polygon(points, facecolor=part.colour, edgecolor=EDGE, linewidth=0.5))
        margin = 0.03 * (high - low)
        plot.plot([(low - margin) * 1e3, (high + margin) * 1e3], [0, 0], color=EDGE, lw=0.7, ls=(0, (12, 3, 2, 3)))
        plot.set_aspect("equal")
        plot.set_xlim((low - margin) * 1e3, (high + margin) * 1e3)
        plot.set_ylim(-1.12 * reach * 1e3, 1.12 * reach * 1e3)
        plot.grid(visible=False)
        plot.set_xlabel("z (mm)")
        plot.set_ylabel("r (mm)")
        keys = [Patch(facecolor=colour, edgecolor=EDGE, linewidth=0.5, label=role) for role, colour in roles.items()]
        canvas.legend(handles=keys, loc="outside upper left", ncols=min(len(keys), 9 if wide else 4), handlelength=1.2)
        alt = f"Longitudinal section of {assembly.name}: {', '.join(roles)}."
        mover = any(part.group == "mover" for part in assembly.parts)
        place = f", mover at z = {assembly.position * 1e3:.4g} mm" if mover else ""
        caption = f"Longitudinal section{place}."
        return drawing(canvas, name, alt, caption, wide=wide)


def faces(part: Body, angle: float) -> list[Profile]:
    """What the half plane at an angle (rad) cuts out of a part."""
    if not isinstance(part, HelicalPart):
        return [part.profile]
    inner, outer = part.inner_radius, part.outer_radius
    spans = unrolled.spans(part.outline, angle)
    return [((inner, low), (outer, low), (outer, high), (inner, high)) for low, high in spans]
