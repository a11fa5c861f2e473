"""The mapped network: the network's figures bent so that values and slopes agree with the finite elements'."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fluxbore.optimize.space_mapping_network import Coarse
from fluxbore.optimize.space_mapping_response import Array, Response

MEMORY = 3
"""Samples that tell of curvature, for each variable."""

PRIOR = 0.1
"""Weight of the ratio of the two routes' figures against what their slopes say of the network's worth."""

ALIGNED = 0.1
"""Cosine between a step and what the curvature misses along it, below which the rank-one update grows wild."""


@dataclass(frozen=True, slots=True)
class Sample:
    """A design that the finite elements have computed: x (n,), scaled; the coarse response with slopes, or None."""

    x: Array
    fine: Response
    coarse: Response | None


@dataclass(frozen=True, slots=True)
class Surrogate:
    """s(x) = f_k + a (c(x) - c_k) + E d + d'B d/2 with d = x - x_k, for each of the 1 + m responses.

    a : (1 + m,), what the network counts for; 0 where it does not give the figure.
    slopes : (1 + m, n) = J_f - a J_c (E): with it, s has the fine model's value and slope at x_k whatever a is.
    curvature : (1 + m, n, n) (B), symmetric, of what is left after the network.
    """

    coarse: Coarse
    centre: Sample
    a: Array
    slopes: Array
    curvature: Array

    def at(self, x: Array) -> Array | None:
        """(1 + m,) the responses expected at x; None where the network has nothing to say that is asked for."""
        d = np.asarray(x) - self.centre.x
        values = self.centre.fine.values + self.slopes @ d + (self.curvature @ d) @ d / 2
        if not self.a.any() or self.centre.coarse is None:
            return values
        coarse = self.coarse.at(x)
        return None if coarse is None else values + self.a * np.nan_to_num(coarse.values - self.centre.coarse.values)

    def slopes_at(self, x: Array) -> Array:
        """(1 + m, n) the slopes at x; without the network's bending where it gives no slopes."""
        d = np.asarray(x) - self.centre.x
        coarse = self.coarse.with_slopes(x) if self.a.any() else None
        known = coarse if coarse is not None else self.centre.coarse
        network = np.zeros_like(self.slopes) if known is None else self.a[:, None] * np.nan_to_num(known.slopes)
        return network + self.slopes + self.curvature @ d


def surrogate(coarse: Coarse, samples: Sequence[Sample], centre: Sample, jacobian: Array) -> Surrogate:
    """The mapped network around ``centre``.

    jacobian : (1 + m, n) of the fine model at the centre, its own or an estimate.
    samples : all designs known; those that bring slopes say how much the network's curvature is worth, and what of
    the curvature it misses.

    Output space mapping that is exact to first order (Echeverria and Hemker 2005; Koziel, Bandler and Madsen 2006):
    the multiplier a is one for each response, so that a figure the network has right is never mixed with others, and
    what remains has symmetric rank-one curvature (Conn, Gould and Toint 1991).
    """
    size = centre.x.size
    near = sorted(
        (item for item in samples if np.any(item.x != centre.x)),
        key=lambda item: float(np.linalg.norm(item.x - centre.x)),
    )[: MEMORY * size]
    a = np.array([_worth(row, near, centre) for row in range(len(jacobian))])
    network = np.zeros_like(jacobian) if centre.coarse is None else a[:, None] * np.nan_to_num(centre.coarse.slopes)
    curvature = np.array([_curvature(row, near, centre, a[row]) for row in range(len(jacobian))])
    return Surrogate(coarse, centre, a, jacobian - network, curvature)


def ratio(centre: Sample, row: int) -> float:
    """The fine figure over the coarse one; 0 where the network does not give it or has another sign."""
    if centre.coarse is None or not np.isfinite(centre.coarse.slopes[row]).all():
        return 0.0
    fine, coarse = centre.fine.figures[row], centre.coarse.figures[row]
    if not np.isfinite(coarse) or coarse == 0:
        return 0.0
    return float(min(max(fine / coarse, 0.0), 3.0))


def _worth(row: int, near: Sequence[Sample], centre: Sample) -> float:
    """a: the share of the change in the network's slopes that the finite elements confirm.

    Values and slopes at the centre agree for any a; only the network's bending remains to be judged. Without slopes
    elsewhere it is the ratio of the figures. A network that bends the other way is not listened to (a = 0).
    """
    prior = ratio(centre, row)
    if prior == 0.0 or not np.isfinite(centre.fine.slopes[row]).all():
        return prior
    assert centre.coarse is not None
    dot = square = 0.0
    for item in near:
        if item.coarse is not None and np.isfinite(item.fine.slopes[row]).all():
            length = float(np.linalg.norm(item.x - centre.x))
            coarse = (item.coarse.slopes[row] - centre.coarse.slopes[row]) / length
            dot += float(coarse @ (item.fine.slopes[row] - centre.fine.slopes[row])) / length
            square += float(coarse @ coarse)
    if square == 0.0:
        return prior
    return min(max((dot / square + PRIOR * prior) / (1 + PRIOR), 0.0), 2 * prior)


def _curvature(row: int, near: Sequence[Sample], centre: Sample, a: float) -> Array:
    """(n, n) from what the network does not explain elsewhere, the nearest sample last and so exact.

    Of a sample with slopes it is the change of slope; of one without, the value along the way to it.
    """
    b = np.zeros((centre.x.size, centre.x.size))
    own = _rest_slopes(centre, row, a)
    if own is None:
        return b
    for item in reversed(near):
        step = item.x - centre.x
        length = float(step @ step)
        slopes, rest = _rest_slopes(item, row, a), _rest(item, row, a) - _rest(centre, row, a)
        if slopes is None:
            if np.isfinite(rest):
                missing = 2 * (rest - own @ step) - step @ b @ step
                b += missing / length**2 * np.outer(step, step)
            continue
        change = slopes - own - b @ step
        along = float(change @ step)
        if abs(along) >= ALIGNED * np.linalg.norm(change) * np.sqrt(length):
            if along != 0.0:
                b += np.outer(change, change) / along
        else:  # Powell's symmetric update (1970): the least change that fits
            b += (np.outer(change, step) + np.outer(step, change)) / length - along / length**2 * np.outer(step, step)
    return b


def _rest(item: Sample, row: int, a: float) -> float:
    """The fine value less the network's share; NaN where the network gives none."""
    if a == 0.0:
        return float(item.fine.values[row])
    return math.nan if item.coarse is None else float(item.fine.values[row] - a * item.coarse.values[row])


def _rest_slopes(item: Sample, row: int, a: float) -> Array | None:
    """(n,) the same of the slopes; None where the design brings none."""
    fine = item.fine.slopes[row]
    if not np.isfinite(fine).all():
        return None
    if a == 0.0:
        return fine
    return None if item.coarse is None else fine - a * item.coarse.slopes[row]
