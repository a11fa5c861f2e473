"""Quadratic finite elements along the radius for one harmonic of a helical field: the closed form's independent check.

Solves (r mu phi')' - mu (k^2 r + p^2/r) phi = (r B_rem)' with neither Bessel functions nor their asymptotics; open
ends reach so far out, and so far in, that the field has died.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solveh_banded

from fluxbore.design.bh_curve import MU_0
from fluxbore.design.radial_stack import RadialStack

Floats = NDArray[np.float64]

_GAUSS = np.polynomial.legendre.leggauss(4)


class RadialElements:
    """`count` elements in each layer; an open end has four times as many, graded, out to 25 decay lengths or in to the
    axis. Orders are whole."""

    def __init__(self, stack: RadialStack, wave: float, order: float, count: int) -> None:
        self.inner_iron = stack.inner_iron
        edges, layers = [], []
        for layer in range(len(stack.permeability)):
            edges.append(np.linspace(stack.radii[layer], stack.radii[layer + 1], count + 1)[:-1])
            layers += [layer] * count
        edges.append(np.array([stack.radii[-1]]))
        grown = np.linspace(0.0, 1.0, 4 * count + 1)[1:] ** 2 * 25 / np.hypot(wave, order / stack.radii[-1])
        inside = min(25 / np.hypot(wave, order / stack.radii[0]), stack.radii[0] * (1 - 1e-3))
        shrunk = np.linspace(0.0, 1.0, 4 * count + 1)[1:] ** 2 * inside
        if not stack.inner_iron:
            edges.insert(0, stack.radii[0] - shrunk[::-1])
            layers = [-1] * (4 * count) + layers
        if not stack.outer_iron:
            edges.append(stack.radii[-1] + grown)
            layers += [-1] * (4 * count)
        ends = np.concatenate(edges)
        self.layer = np.array(layers)
        relative = np.array([*stack.permeability, 1.0])[self.layer]
        a, length = ends[:-1, None], np.diff(ends)[:, None]
        t, weight = (_GAUSS[0] + 1) / 2, _GAUSS[1] / 2
        radius = a + length * t
        shape = np.stack([(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)])
        slope = np.stack([4 * t - 3, 4 - 8 * t, 4 * t - 1])[:, None, :] / length
        mass = wave**2 * radius + order**2 / radius
        block = np.einsum("eq,ieq,jeq->eij", radius * length * weight, slope, slope)
        block += np.einsum("eq,iq,jq->eij", mass * length * weight, shape, shape)
        self.nodes = 2 * np.arange(len(self.layer))[:, None] + np.arange(3)
        size = 2 * len(self.layer) + 1
        self.matrix = np.zeros((3, size))  # lower diagonals, as LAPACK's banded solver takes them
        for i in range(3):
            for j in range(i + 1):
                np.add.at(self.matrix[i - j], self.nodes[:, j], MU_0 * relative * block[:, i, j])
        self.load = np.einsum("eq,ieq->ei", radius * length * weight, slope)

    def source(self, layer: int) -> Floats:
        found = np.zeros(self.matrix.shape[1])
        np.add.at(found, self.nodes[self.layer == layer], self.load[self.layer == layer])
        return found

    def potential(self, layer: int) -> Floats:
        # Iron holds the potential at zero, as does the place far out where a field has died; at the axis nothing does.
        first = int(self.inner_iron)
        inside = solveh_banded(self.matrix[:, first:-1], self.source(layer)[first:-1], lower=True)
        return np.pad(inside, (first, 1))

    def interaction(self, source: int, sink: int) -> float:
        """int r H_r dr over the layer `sink`, per tesla in the layer `source` (m A/T)."""
        return -float(self.source(sink) @ self.potential(source))

    def flux(self, layer: int) -> tuple[float, float]:
        """r B_r at the first and at the last radius (T m), per tesla in the layer."""
        potential, source = self.potential(layer), self.source(layer)
        first = source[0] - self.matrix[1:, 0] @ potential[1:3]
        last = source[-1] - self.matrix[[2, 1], [-3, -2]] @ potential[-3:-1]
        return -float(first), float(last)
