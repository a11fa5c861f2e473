"""Draws docs/position.svg: where the mover's position z is measured. Run it from the repository's top."""

from pathlib import Path

from matplotlib.figure import Figure
from matplotlib.patches import Polygon

import fluxbore
from fluxbore.geometry.hybrid_parts import assembly

TOP = Path(__file__).parent.parent


def draw() -> Figure:
    """The half-section of the prototype at z = 24 mm with the two faces between which z is measured."""
    actuator = fluxbore.load(TOP / "examples" / "ipehla.toml").actuator
    position = 0.024
    parts = assembly(actuator, position)
    figure = Figure(figsize=(11, 3.3), layout="constrained")
    # Radii are drawn twice as large as lengths: the machine is long and thin.
    axes = figure.add_subplot(aspect=2)
    for part in parts.parts:
        outline = [(z * 1e3, r * 1e3) for r, z in part.profile]
        axes.add_patch(Polygon(outline, facecolor=part.colour, edgecolor="#333333", linewidth=0.4))
    for i in range(actuator.coils):
        middle = (actuator.winding_start + (i + 0.5) * actuator.coil_width) * 1e3
        axes.text(middle, 11.05, "UVW"[i % 3], ha="center", va="center", fontsize=7, color="white")
    top = actuator.back_yoke.outer_diameter / 2e-3
    for z, radius in ((0.0, 10.0), (position * 1e3, 8.0)):
        axes.plot([z, z], [radius, top + 7], color="#b00020", linewidth=1, linestyle=(0, (6, 2, 1, 2)))
    middle = top + 6
    axes.annotate("", (position * 1e3, middle), (0, middle), arrowprops={"arrowstyle": "->", "color": "#b00020"})
    axes.text(position * 5e2, middle + 1.2, "position z = 24 mm", color="#b00020", ha="center", fontsize=9)
    axes.text(-1, top + 6.5, "mid-plane of the\nfirst U coil: z = 0", color="#b00020", ha="right", va="top", fontsize=8)
    axes.text(
        position * 1e3 + 1,
        top + 6.5,
        "cap-side end face of the magnet array,\nthe outer face of its first half ring",
        color="#b00020",
        va="top",
        fontsize=8,
    )
    axes.annotate("", (225, -3.5), (150, -3.5), arrowprops={"arrowstyle": "->"})
    axes.text(187, -6.5, "+z, towards the rod end", ha="center", fontsize=8)
    axes.text(-30, -4.5, "cap end", fontsize=8)
    axes.axhline(0, color="black", linewidth=0.6, linestyle=(0, (8, 2, 1, 2)))
    axes.set_xlim(-50, 260)
    axes.set_ylim(-8, top + 10)
    axes.set_xlabel("axial coordinate (mm)")
    axes.set_ylabel("radius (mm)")
    axes.spines[["top", "right"]].set_visible(False)
    return figure


if __name__ == "__main__":
    draw().savefig(Path(__file__).with_name("position.svg"), metadata={"Date": None})
