"""An open boundary by hand: the outermost circle joined to a second one that stands for the rest of space."""

from __future__ import annotations

from dataclasses import replace

from fluxbore.fem.femm_model import (
    Arc,
    BlockLabel,
    BoundaryProperty,
    Exterior,
    FemmModel,
    Node,
    PointProperty,
    Segment,
)


def with_exterior(model: FemmModel) -> FemmModel:
    """The model of a case with an open boundary, its outermost arcs, which are those with a condition, made a seam.

    The circle must be about the origin and the material of its rim be the one named Air.
    """
    rim = [number for number, arc in enumerate(model.arcs) if arc.boundary is not None]
    radius = max(abs(model.nodes[model.arcs[rim[0]].start].x), abs(model.nodes[model.arcs[rim[0]].start].y))
    air = next(number for number, material in enumerate(model.materials) if material.name == "Air")
    far, first, seams = 2.5 * radius, len(model.nodes), len(model.boundaries)
    arcs = list(model.arcs)
    for place, number in enumerate(rim):
        arcs[number] = replace(arcs[number], boundary=seams + place)
    boundaries = tuple(BoundaryProperty(f"seam {place + 1}", "periodic") for place in range(len(rim)))
    model = replace(model, boundaries=(*model.boundaries, *boundaries))
    if model.axisymmetric:
        return replace(
            model,
            nodes=(*model.nodes, Node(0.0, far - radius), Node(0.0, far + radius)),
            segments=(*model.segments, Segment(first, first + 1)),
            arcs=(*arcs, Arc(first, first + 1, 180.0, boundary=seams)),
            labels=(*model.labels, BlockLabel(radius / 2, far, air, external=True)),
            exterior=Exterior(far, radius, radius),
        )
    infinity = Node(far, 0.0, len(model.points))
    return replace(
        model,
        points=(*model.points, PointProperty("infinity", 0.0)),
        nodes=(*model.nodes, Node(far - radius, 0.0), Node(far + radius, 0.0), infinity),
        arcs=(
            *arcs,
            Arc(first, first + 1, 180.0, boundary=seams),
            Arc(first + 1, first, 180.0, boundary=seams + 1),
        ),
        labels=(*model.labels, BlockLabel(far, radius / 2, air)),
    )
