"""Moving a group of a FEMM model: its nodes, the ends of its segments and arcs, its labels and holes."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from math import cos, radians, sin

import numpy as np

from fluxbore.design.errors import SpecError
from fluxbore.fem.edges import Drawing
from fluxbore.fem.faces import faces
from fluxbore.fem.femm_model import Arc, BlockLabel, FemmModel, Node, Segment
from fluxbore.fem.femm_problem import drawing
from fluxbore.fem.outline_check import cleaned, pieces

MOST_TRIANGLES = 400_000
"""Of a mesh that the drawing must allow; faces are looked for on the sides of its triangles."""

_Place = Callable[[float, float], tuple[float, float]]


@dataclass(frozen=True, slots=True)
class Motion:
    """Turned by angle (degrees, counter-clockwise about the origin), then moved by x, y (the file's unit)."""

    x: float = 0.0
    y: float = 0.0
    angle: float = 0.0

    def place(self, x: float, y: float) -> tuple[float, float]:
        """Where a point comes to lie."""
        c, s = self._turn
        return c * x - s * y + self.x, s * x + c * y + self.y

    def direction(self, magnetisation: float | str) -> float | str:
        """A direction of magnetisation (degrees) turns along; a formula means the places where the part came from."""
        if not isinstance(magnetisation, str):
            return magnetisation + self.angle
        formula = magnetisation.partition("--")[0].strip()
        c, s = self._turn
        ahead, aside = f"(x-({self.x!r}))", f"(y-({self.y!r}))"
        x = f"(({c!r})*{ahead}+({s!r})*{aside})" if self.angle else ahead
        y = f"(({c!r})*{aside}-({s!r})*{ahead})" if self.angle else aside
        means = {
            "x": x,
            "r": x,
            "y": y,
            "z": y,
            "theta": f"deg(atan2({y},{x}))",
            "R": f"sqrt({x}^2+{y}^2)",
        }
        moved = re.sub(r"\b(?:x|y|r|z|theta|R)\b", lambda name: means[name[0]], formula)
        return f"{self.angle!r}+({moved})" if self.angle else moved

    @property
    def _turn(self) -> tuple[float, float]:
        """Cosine and sine; of quarter turns exactly, so that what was upright stays so."""
        quarter = {0.0: (1.0, 0.0), 90.0: (0.0, 1.0), 180.0: (-1.0, 0.0), 270.0: (0.0, -1.0)}.get(self.angle % 360)
        return quarter or (cos(radians(self.angle)), sin(radians(self.angle)))


def members(model: FemmModel, group: int) -> frozenset[int]:
    """Numbers of the nodes that move with a group.

    As in FEMM, what carries the group's number moves. Where only labels do, as in many files, the lines and arcs around
    the labels' faces move with them: those that bound these faces along all of their length, by their ends.

    Raises SpecError where the group has nothing to move, MeshError where its faces cannot be told.
    """
    numbers = {number for number, node in enumerate(model.nodes) if node.group == group}
    curves: list[Segment | Arc] = [*model.segments, *model.arcs]
    numbers |= {end for curve in curves if curve.group == group for end in (curve.start, curve.end)}
    if not numbers and any(label.group == group for label in model.labels):
        numbers = _around_labels(model, group)
    if not numbers and not any(hole.group == group for hole in model.holes):
        raise SpecError(f"Group {group} must have nodes, lines, arcs or closed faces to be moved; it has none.")
    return frozenset(numbers)


def moved(model: FemmModel, group: int, numbers: frozenset[int], motion: Motion) -> FemmModel:
    """The model with a group elsewhere. numbers : its nodes, by `members` of the model before any motion."""

    def node(number: int, item: Node) -> Node:
        if number not in numbers:
            return item
        x, y = motion.place(item.x, item.y)
        return replace(item, x=x, y=y)

    def label(item: BlockLabel) -> BlockLabel:
        if item.group != group:
            return item
        x, y = motion.place(item.x, item.y)
        return replace(item, x=x, y=y, magnetisation=motion.direction(item.magnetisation))

    holes = []
    for hole in model.holes:
        x, y = motion.place(hole.x, hole.y) if hole.group == group else (hole.x, hole.y)
        holes.append(replace(hole, x=x, y=y))
    return replace(
        model,
        nodes=tuple(node(number, item) for number, item in enumerate(model.nodes)),
        labels=tuple(map(label, model.labels)),
        holes=tuple(holes),
    )


def _around_labels(model: FemmModel, group: int) -> set[int]:
    """The nodes that end the lines and arcs around the faces of a group's labels.

    A line that goes on beyond the faces, as the axis may, stays: its ends belong to something else.
    """
    outline = cleaned(drawing(model).outline)
    parts = Drawing(outline, pieces(outline))
    seeds = np.array([seed.position for seed in outline.seeds]).reshape(-1, 2)
    sides = parts.untangled(parts.edges(), seeds, MOST_TRIANGLES)
    found = faces(parts, sides, np.zeros((0, 2)))
    mine = np.array([model.labels[outline.seeds[seed].region].group == group for seed in found.seed])
    touching = np.append(mine, False)[found.sides].any(axis=1)
    curve = parts.pieces.curve[sides.piece]
    whole = np.setdiff1d(curve[touching], curve[~touching])
    return {end for number in whole.tolist() for end in (outline.curves[number].start, outline.curves[number].end)}
