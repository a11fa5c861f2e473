"""Concentric layers between which a helical magnetic field is known exactly, radius by radius.

A current-free field that depends on r and zeta = z - h theta alone has the scalar potential, H = -grad phi, whose
harmonic phi(r) cos(k zeta) solves

    (r mu phi')' - mu (k^2 r + p^2/r) phi = (r B_rem)',    p = k h

so that in a layer of constant mu without magnets phi = a I_p(k r) + b K_p(k r), the modified Bessel functions of
order p (Wang, Jewell and Howe 1999, IEEE Trans. Magn. 35, 1986, for p = 0; helical: p is the number of starts times
the odd number n of the harmonic). Each layer is then an element with two unknowns, the potentials at its two radii:

    sum K phi = sum S B_rem,   K_ij = int mu (r v_i' v_j' + (k^2 r + p^2/r) v_i v_j) dr,   S_i = int r v_i' dr

v_i being one at its own radius, zero at the other, and a solution between. K is closed in I_p and K_p, S takes one
integral by Gauss' rule; the potentials at the radii are exact, with radial magnets of a remanence that does not change
with r too. `scaled_bessel` keeps the functions in the range of doubles at any order and argument.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.bh_curve import MU_0
from fluxbore.design.scaled_bessel import scaled_bessel, scaled_slopes

Floats = NDArray[np.float64]

REACH = 40.0
"""Decay lengths from a radius, beyond which what is there no longer counts: exp(-40) is 4e-18."""

POINTS = 32
"""Of Gauss' rule over `REACH` decay lengths: exact to 1e-14."""


@dataclass(frozen=True, slots=True)
class RadialStack:
    """Layers between ascending radii (m), n + 1 of them, each of one relative permeability, n of them.

    inner_iron, outer_iron : iron of infinite permeability within the first radius and beyond the last; air otherwise.
    """

    radii: tuple[float, ...]
    permeability: tuple[float, ...]
    inner_iron: bool
    outer_iron: bool


@dataclass(frozen=True, slots=True, eq=False)
class Harmonics:
    """The fields of H harmonics in a stack; K assembled, the sources S taken where they are asked for."""

    stack: RadialStack
    wave: Floats  # k (1/m) > 0, (H,)
    order: Floats  # p >= 0, (H,)
    matrix: Floats  # K (henry), (H, n + 1, n + 1)

    def source(self, layer: int) -> Floats:
        """S (m) of a layer with unit radial remanence, (H, n + 1)."""
        found = np.zeros(self.matrix.shape[:2])
        inner, outer = self.stack.radii[layer], self.stack.radii[layer + 1]
        found[:, layer : layer + 2] = _source(self.wave, self.order, inner, outer)
        return found

    def potentials(self, layer: int) -> Floats:
        """(H, n + 1), potentials (A) at the radii per tesla of the radial remanence of one layer."""
        return self._driven_by(self.source(layer))

    def interaction(self, source: int, sink: int) -> Floats:
        """(H,), in m A/T: int r H_r dr over the layer `sink` per tesla of remanence in the layer `source`.

        The same the other way round. With one layer as both, the part of it that the surroundings decide: what the
        layer has between two radii held at zero is left out.
        """
        return np.asarray(-np.sum(self.source(sink) * self.potentials(source), axis=1))

    def flux(self, layer: int) -> Floats:
        """(H, 2): r B_r (T m) into the iron at the innermost and outermost radius per tesla of remanence in one layer;
        zero where there is no iron."""
        source = self.source(layer)
        residual = source - np.einsum("hij,hj->hi", self.matrix, self._driven_by(source))
        return np.stack([-residual[:, 0], residual[:, -1]], axis=1)

    def _driven_by(self, source: Floats) -> Floats:
        # Infinitely permeable iron holds the potential at zero.
        free = slice(int(self.stack.inner_iron), len(self.stack.radii) - int(self.stack.outer_iron))
        found = np.zeros_like(source)
        found[:, free] = np.linalg.solve(self.matrix[:, free, free], source[:, free, None])[..., 0]
        return found


def solve(stack: RadialStack, wave: Floats, order: Floats) -> Harmonics:
    """The fields of the harmonics of wave numbers k (1/m) > 0 and orders p >= 0, both (H,)."""
    count = len(stack.radii)
    matrix = np.zeros((len(wave), count, count))
    for layer, relative in enumerate(stack.permeability):
        block = slice(layer, layer + 2)
        matrix[:, block, block] += MU_0 * relative * _element(wave, order, stack.radii[layer], stack.radii[layer + 1])
    if not stack.inner_iron:
        matrix[:, 0, 0] += MU_0 * _axis(wave, order, stack.radii[0])
    if not stack.outer_iron:
        matrix[:, -1, -1] += MU_0 * _infinity(wave, order, stack.radii[-1])
    return Harmonics(stack, wave, order, matrix)


def shapes(
    wave: Floats, order: Floats, inner: float, outer: float, radii: Floats, derivative: bool = False
) -> tuple[Floats, Floats]:
    """The two solutions between two radii (m), one at the inner and one at the outer, at `radii` (H, q); (H, q).

    derivative : their slopes by r (1/m) instead.
    """
    k, p = wave[:, None], order[:, None]
    a, b = scaled_bessel(p, k * inner), scaled_bessel(p, k * outer)
    at = scaled_slopes(p, k * radii) if derivative else scaled_bessel(p, k * radii)
    i, m = (k * at.i, k * at.k) if derivative else (at.i, at.k)
    below, above, across = np.exp(a.s - at.s), np.exp(at.s - b.s), np.exp(a.s - b.s)
    denominator = b.i * a.k - a.i * b.k * across**2
    at_inner = (m * b.i * below - i * b.k * above * across) / denominator
    at_outer = (i * a.k * above - m * a.i * below * across) / denominator
    return at_inner, at_outer


def _element(wave: Floats, order: Floats, inner: float, outer: float) -> Floats:
    """K/mu of one layer (H, 2, 2): r v' at its radii, with the Wronskian I'K - IK' = 1/x off the diagonal."""
    x, y = wave * inner, wave * outer
    a, b = scaled_bessel(order, x), scaled_bessel(order, y)
    da, db = scaled_slopes(order, x), scaled_slopes(order, y)
    across = np.exp(a.s - b.s)
    denominator = b.i * a.k - a.i * b.k * across**2
    at_inner = x * (da.i * b.k * across**2 - da.k * b.i) / denominator
    at_outer = y * (db.i * a.k - db.k * a.i * across**2) / denominator
    coupling = -across / denominator
    return np.stack([at_inner, coupling, coupling, at_outer], axis=1).reshape(-1, 2, 2)


def _source(wave: Floats, order: Floats, inner: float, outer: float) -> Floats:
    """S of one layer (H, 2): int r v' dr = [r v] - int v dr, for either end over the reach of its own solution."""
    nodes, weights = np.polynomial.legendre.leggauss(POINTS)
    nodes, weights = (nodes + 1) / 2, weights / 2
    decay = np.hypot(wave, order / outer)
    reach = np.minimum(outer - inner, REACH / decay)[:, None]
    at_inner = shapes(wave, order, inner, outer, inner + reach * nodes)[0]
    at_outer = shapes(wave, order, inner, outer, outer - reach * nodes)[1]
    integral_a, integral_b = reach[:, 0] * (at_inner @ weights), reach[:, 0] * (at_outer @ weights)
    return np.stack([-inner - integral_a, outer - integral_b], axis=1)


def _axis(wave: Floats, order: Floats, radius: float) -> Floats:
    """r phi'/phi (H,) of the solution that is finite on the axis."""
    x = wave * radius
    return np.asarray(x * scaled_slopes(order, x).i / scaled_bessel(order, x).i)


def _infinity(wave: Floats, order: Floats, radius: float) -> Floats:
    """-r phi'/phi (H,) of the solution that vanishes far out."""
    x = wave * radius
    return np.asarray(-x * scaled_slopes(order, x).k / scaled_bessel(order, x).k)
