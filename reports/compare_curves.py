"""Curves of several designs in one picture: force over position, and what else designs of a kind have in common."""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.reports.compare_content import Comparison
from fluxbore.reports.svg import BAD, CHOSEN, GOOD, OTHER, PUBLISHED, START, Drawing, drawing, new_figure, style
from fluxbore.reports.wording import capital, listing, scale

WIDTH, HEIGHT = 500.0, 330.0

LOOKS = (
    (CHOSEN, "-", "o"),
    (PUBLISHED, (0, (6, 2)), "s"),
    (GOOD, (0, (2, 1.5)), "^"),
    (OTHER, (0, (6, 2, 1.5, 2)), "D"),
    (BAD, (0, (4, 1.5)), "v"),
    (START, (0, (1.5, 3)), "P"),
)
"""Colour, dashes and mark of each design: whoever does not tell the colours tells the dashes."""

FEW = 40
"""Points of a curve that are marked one by one; of more the line is enough."""


@dataclass(frozen=True, slots=True)
class Curve:
    """abscissa, ordinate : what they are, and their dimension. flat : least height of the axis, of its top."""

    title: str
    abscissa: tuple[str, str]
    ordinate: tuple[str, str]
    flat: float = 0.0


CURVES = {
    "force_constant": Curve(
        "Force constant over position, by the stress tensor", ("position z", "length"), ("force constant",) * 2, 0.04
    ),
    "cogging_force": Curve("Cogging: axial force at no current", ("position z", "length"), ("cogging force", "force")),
    "spring_force": Curve(
        "Force of the magnetic spring over the relative displacement",
        ("relative displacement x_d", "length"),
        ("force F", "force"),
    ),
    "stall_force_left": Curve(
        "Stall force over the mover’s position",
        ("rotor’s middle from the translator’s", "length"),
        ("stall force", "force"),
    ),
    "return_force": Curve(
        "Force of return element and series spring over the way of the output piston",
        ("way of the output piston", "length"),
        ("force", "force"),
    ),
}
"""Curves that designs can have in common, by name, in the order of the page."""


def overlays(comparison: Comparison) -> tuple[Drawing, ...]:
    """A picture for each curve that two designs or more have."""
    drawings = (_overlay(comparison, name) for name in CURVES)
    return tuple(item for item in drawings if item is not None)


def _overlay(comparison: Comparison, name: str) -> Drawing | None:
    found = [(i, design, design.curves[name]) for i, design in enumerate(comparison.designs) if name in design.curves]
    if len(found) < 2:
        return None
    curve = CURVES[name]
    x_scale = scale(curve.abscissa[1], [float(abs(x).max()) for _, _, (x, _) in found])
    y_scale = scale(curve.ordinate[1], [float(abs(y).max()) for _, _, (_, y) in found])
    with style():
        canvas = new_figure(WIDTH, HEIGHT)
        plot = canvas.subplots()
        for i, design, (x, y) in found:
            colour, dashes, mark = LOOKS[i]
            plot.plot(
                x / x_scale.factor,
                y / y_scale.factor,
                color=colour,
                ls=dashes,
                marker=mark if len(x) <= FEW else None,
                ms=4.5,
                label=design.letter,
            )
        low, high = plot.get_ylim()
        spare = max(curve.flat * high - (high - low), 0.0) / 2
        plot.set_ylim(low - spare, high + spare)
        plot.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=len(found), borderaxespad=0.2, handlelength=2.6)
        plot.set_xlabel(f"{curve.abscissa[0]} ({x_scale.unit})")
        plot.set_ylabel(f"{curve.ordinate[0]} ({y_scale.unit})")
        peaks = [f"{design.letter} up to {y_scale.quantity(float(y.max()))}" for _, design, (_, y) in found]
        alt = f"{curve.title}: {listing(peaks)}."
        return drawing(canvas, f"compare-{name.replace('_', '-')}", alt, f"{capital(curve.title)}.")
