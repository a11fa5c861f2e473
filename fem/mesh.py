"""Meshes of quadratic triangles in a chart of the half plane.

Axisymmetric problems are meshed in (s, z) with s = r²/2. In this chart B_z = ∂ψ/∂s and a uniform field is a linear
function, so that the field is as accurate on the axis as beside it, where triangles in (r, z) lose an order. Planar
problems use (x, y).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from fluxbore.fem.pattern import Pattern

Chart = Literal["axisymmetric", "planar"]
Floats = NDArray[np.float64]
Ints = NDArray[np.int_]


@dataclass(frozen=True, eq=False)
class Topology:
    """Which nodes form which element, and which of them are unknown. Designs and positions share it.

    elements : (m, 6) node numbers: three corners, then the middles of edges 12, 23, 31.
    freedom : (n,) number of the unknown at each node, −1 where ψ is prescribed. Nodes that a periodic boundary ties
        together share an unknown.
    sign : (n,) ±1, −1 where an antiperiodic boundary turns the unknown round; None for +1 everywhere.
    mate : (n,) the node that stands for each node and those tied to it; None where each stands for itself.
    """

    elements: Ints
    freedom: Ints
    sign: Ints | None = None
    mate: Ints | None = None

    @property
    def mates(self) -> Ints:
        """(n,) the node that stands for each node: the same one for nodes that are tied together."""
        return np.arange(self.freedom.size) if self.mate is None else self.mate

    @cached_property
    def unknowns(self) -> int:
        return int(self.freedom.max(initial=-1)) + 1

    @cached_property
    def pattern(self) -> Pattern:
        """Where element matrices land in the global one."""
        sign = None if self.sign is None else self.sign[self.elements]
        return Pattern.of_elements(self.freedom[self.elements], self.unknowns, sign)

    @cached_property
    def nodes_of_freedom(self) -> Ints:
        """(unknowns,) a node of each unknown, of positive sign where it has one."""
        free = np.flatnonzero(self.freedom >= 0)
        nodes = np.empty(self.unknowns, dtype=free.dtype)
        nodes[self.freedom[free]] = free
        if self.sign is not None:
            positive = free[self.sign[free] > 0]
            nodes[self.freedom[positive]] = positive
        return nodes

    @cached_property
    def _tied(self) -> bool:
        return self.unknowns != int(np.count_nonzero(self.freedom >= 0))

    def spread(self, unknowns: Floats, prescribed: Floats | None = None) -> Floats:
        """(n,) nodal values from the unknowns; the prescribed ones, or zero, at the other nodes."""
        values = np.zeros(self.freedom.size) if prescribed is None else np.where(self.freedom < 0, prescribed, 0.0)
        free = np.flatnonzero(self.freedom >= 0)
        values[free] = (
            unknowns[self.freedom[free]] if self.sign is None else (self.sign[free] * unknowns[self.freedom[free]])
        )
        return values

    def gather(self, nodal: Floats) -> Floats:
        """(unknowns,) sums over the nodes of each unknown: what a nodal load does to the unknowns."""
        if self.sign is None and not self._tied:
            return np.asarray(nodal[self.nodes_of_freedom])
        free = np.flatnonzero(self.freedom >= 0)
        share = nodal[free] if self.sign is None else self.sign[free] * nodal[free]
        return np.asarray(np.bincount(self.freedom[free], share, self.unknowns))


@dataclass(frozen=True, slots=True, eq=False)
class Mesh:
    """Nodes in a chart, elements, and the region of each element.

    nodes : (n, 2) chart coordinates, (s, z) in (m², m) or (x, y) in m.
    region : (m,) index of each element's region.
    """

    chart: Chart
    nodes: Floats
    region: Ints
    topology: Topology

    @property
    def elements(self) -> Ints:
        return self.topology.elements

    @property
    def positions(self) -> Floats:
        """(n, 2) the nodes in space, (r, z) or (x, y) in metres."""
        return in_space(self.chart, self.nodes)


def in_space(chart: Chart, points: Floats) -> Floats:
    """(..., 2) points of a chart in space: (r, z) or (x, y) in metres."""
    if chart == "planar":
        return points
    return np.stack((np.sqrt(2.0 * np.maximum(points[..., 0], 0.0)), points[..., 1]), axis=-1)


def in_chart(chart: Chart, points: Floats) -> Floats:
    """(..., 2) points of space, (r, z) or (x, y) in metres, in the chart."""
    if chart == "planar":
        return points
    return np.stack((points[..., 0] ** 2 / 2, points[..., 1]), axis=-1)
