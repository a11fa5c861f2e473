"""Pictures of a helical field: two pitches in the plane of r and ζ, at rest and at the stall.

The colours, the step between field lines and the scale are one for both pictures. Level lines are those of the helical
flux function, of which `fluxbore.fem.helical_flux` shows that field lines keep it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fluxbore.design.lead_screw import HelicalMagnets
from fluxbore.reports.content import FluxMap
from fluxbore.reports.flux_hover import field_readout
from fluxbore.reports.flux_picture import DARK, colour_bar, colour_limit, flux_between, flux_step, paint
from fluxbore.reports.lead_screw_content import ScrewContent
from fluxbore.reports.svg import Drawing, drawing, new_figure, style
from fluxbore.reports.wording import significant

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDE, ROOM, TALLEST = 1000.0, 445.0, 560.0
"""Width of the figure and of one picture in it, and the most height of a picture."""

AROUND = 0.25
"""Pitches of what lies behind the members that are drawn."""

DEEPEST = 0.6
"""Pitches of iron that are drawn: deeper in there is next to no field."""

NAMED = 0.035
"""Of the picture's height; the names of thinner layers would run into one another."""

SPARSER = 2
"""Of the pictures' common step between field lines: here they stand in every magnet of the window."""


def field_picture(content: ScrewContent) -> Drawing:
    """|B|, field lines and magnets at rest and at the stall."""
    maps = (("at rest", content.rest), ("at the stall", content.stall))
    limit, step = colour_limit(content.rest, content.stall), SPARSER * flux_step(content.rest, content.stall)
    low, high = _radii(content)
    start, end = -content.screw.pitch / 4, 7 * content.screw.pitch / 4
    with style():
        height = min(ROOM * (high - low) / (end - start), TALLEST)
        canvas = new_figure(WIDE, height + 110.0)
        plots = canvas.subplots(1, 2, sharey=True)
        for plot, (title, field) in zip(plots, maps, strict=True):
            mesh = paint(plot, field, limit, step, (start, end, high), mirrored=False, edge=0.8, width=0.8)
            plot.set_ylim(low * 1e3, high * 1e3)
            plot.set_title(f"{title}, x_d = {significant(field.position * 1e3, 3)} mm", loc="left")
            plot.set_xlabel("ζ = z − h θ (mm)")
            _poles(plot, field)
        _names(plots[1], content, (low, high))
        plots[0].set_ylabel("r (mm)")
        colour_bar(canvas, list(plots), mesh)
        between = flux_between(step)
        top = max(float(field.flux_density.max()) for _, field in maps)
        alt = f"Flux density and field lines over two pitches, at rest and at the stall; colours up to {limit:.1f} T."
        caption = (
            "Two pitches by finite elements, the translator below the gap, the rotor above it; arrows are the magnets’ "
            f"magnetisation. {between} flow between neighbouring lines in one turn. The colours end at {limit:.1f} T; "
            f"at edges of magnets the field is {top:.1f} T here, and has no bound in theory."
        )
        made = drawing(canvas, "screw-field", alt, caption, wide=True)
        both = (field_readout(plot, field) for plot, (_, field) in zip(plots, maps, strict=True))
        return replace(made, readouts=tuple(entry for found in both for entry in found))


def _radii(content: ScrewContent) -> tuple[float, float]:
    """Of the picture (m): magnets, iron, and a little behind them."""
    inner, _, _, outer = content.screw.radii
    pitch = content.screw.pitch
    low = max(inner - _depth(content.screw.translator, pitch), float(content.rest.r.min()))
    return low, min(outer + _depth(content.screw.rotor, pitch), float(content.rest.r.max()))


def _depth(member: HelicalMagnets, pitch: float) -> float:
    """Of what is drawn behind a member's magnets (m)."""
    return min(member.iron_thickness + AROUND * pitch, DEEPEST * pitch)


def _names(plot: Axes, content: ScrewContent, seen: tuple[float, float]) -> None:
    """What stands at which radius, beside the second picture."""
    inner, outer, bore, rim = content.screw.radii
    names = [("translator magnets", inner, outer), ("gap", outer, bore), ("rotor magnets", bore, rim)]
    if content.screw.translator.iron_thickness > 0:
        names.append(("iron", max(seen[0], inner - content.screw.translator.iron_thickness), inner))
    if content.screw.rotor.iron_thickness > 0:
        names.append(("iron", rim, min(seen[1], rim + content.screw.rotor.iron_thickness)))
    for name, low, high in names:
        if high - low < NAMED * (seen[1] - seen[0]):
            continue
        place = 1.02, (low + high) / 2 * 1e3
        plot.annotate(name, place, xycoords=plot.get_yaxis_transform(), va="center", annotation_clip=False)


def _poles(plot: Axes, field: FluxMap) -> None:
    """Which way each magnet is magnetised; of slivers at the edge nothing."""
    magnets = [(name, outline) for name, outline in field.outlines if name.endswith(("north", "south"))]
    widest = max((float(outline[:, 1].max() - outline[:, 1].min()) for _, outline in magnets), default=0.0)
    for name, outline in magnets:
        (r0, z0), (r1, z1) = outline.min(axis=0) * 1e3, outline.max(axis=0) * 1e3
        if z1 - z0 < 0.4 * widest * 1e3:
            continue
        middle, rise = (z0 + z1) / 2, 0.28 * (r1 - r0) * (1 if name.endswith("north") else -1)
        plot.annotate(
            "",
            (middle, (r0 + r1) / 2 + rise),
            (middle, (r0 + r1) / 2 - rise),
            arrowprops={
                "arrowstyle": "-|>",
                "color": DARK,
                "lw": 1.6,
                "mutation_scale": 14,
                "shrinkA": 0,
                "shrinkB": 0,
            },
        )
