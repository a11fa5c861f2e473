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

from fluxbore.fem.linear import Pattern

Chart = Literal["axisymmetric", "planar"]
Floats = NDArray[np.float64]
Ints = NDArray[np.int_]


@dataclass(frozen=True, eq=False)
class Topology:
    """Which nodes form which element, and which of them are unknown. Designs and positions share it.

    elements : (m, 6) node numbers: three corners, then the middles of edges 12, 23, 31.
    freedom : (n,) number of the unknown at each node, -1 where ψ is prescribed to be zero.
    """

    elements: Ints
    freedom: Ints

    @property
    def unknowns(self) -> int:
        return int(self.freedom.max()) + 1

    @cached_property
    def pattern(self) -> Pattern:
        """Where element matrices land in the global one."""
        return Pattern.of_elements(self.freedom[self.elements], self.unknowns)

    @cached_property
    def nodes_of_freedom(self) -> Ints:
        """(unknowns,) the node of each unknown."""
        return np.flatnonzero(self.freedom >= 0)


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
        if self.chart == "planar":
            return self.nodes
        return np.column_stack((np.sqrt(2.0 * np.maximum(self.nodes[:, 0], 0.0)), self.nodes[:, 1]))
