"""A system of coils as a model that FEMM opens.

The outer boundary is A = 0 on a rectangle around the coils: a plain drawing, which `fluxbore solve --open-boundary`
puts into free space.
"""

from __future__ import annotations

from fluxbore.design.coils import CoilSystem
from fluxbore.design.spec import Spec
from fluxbore.fem.femm_model import BlockLabel, BlockProperty, BoundaryProperty, FemmModel, Node, Segment

MARGIN = 2.0
"""Distance of the boundary from the axis and the middle over that of the farthest winding."""

MILLIMETRE = 1e-3


def femm_model(spec: Spec) -> FemmModel:
    """The windings in air, in millimetres, each a group and a material with its current density."""
    system: CoilSystem = spec.actuator
    far = MARGIN * max(coil.outer_radius for coil in system.coils)
    low = min(coil.lower for coil in system.coils) - (MARGIN - 1) * far
    high = max(coil.upper for coil in system.coils) + (MARGIN - 1) * far
    nodes, segments = _rectangle(0.0, far, low, high, 0, boundary=0)
    labels = [BlockLabel(far * 0.99 / MILLIMETRE, (high - (MARGIN - 1) * far * 0.01) / MILLIMETRE, 0)]
    blocks = [BlockProperty("Air")]
    for group, coil in enumerate(system.coils, start=1):
        corners, sides = _rectangle(
            coil.inner_radius, coil.outer_radius, coil.lower, coil.upper, len(nodes), group=group
        )
        nodes += corners
        segments += sides
        middle = (coil.inner_radius + coil.outer_radius) / 2, (coil.lower + coil.upper) / 2
        labels.append(BlockLabel(middle[0] / MILLIMETRE, middle[1] / MILLIMETRE, len(blocks), group=group))
        blocks.append(BlockProperty(coil.name.replace("_", " "), current_density=coil.current_density))
    return FemmModel(
        True,
        "millimeters",
        comment=f"{system.name}, in free space",
        boundaries=(BoundaryProperty("A=0", "prescribed"),),
        materials=tuple(blocks),
        nodes=tuple(nodes),
        segments=tuple(segments),
        labels=tuple(labels),
    )


def _rectangle(
    inner: float, outer: float, low: float, high: float, first: int, *, boundary: int | None = None, group: int = 0
) -> tuple[list[Node], list[Segment]]:
    """Four corners (m), numbered from ``first``, and the lines between them; none of the boundary's is on the axis."""
    corners = [(inner, low), (outer, low), (outer, high), (inner, high)]
    nodes = [Node(r / MILLIMETRE, z / MILLIMETRE, group=group) for r, z in corners]
    segments = [
        Segment(first + i, first + (i + 1) % 4, boundary=None if inner == 0 and i == 3 else boundary, group=group)
        for i in range(4)
    ]
    return nodes, segments
