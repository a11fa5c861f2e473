"""Paths of straight pieces and arcs, and integrals along them.

The normal is to the left of travel, n = (−t_y, t_x), as in FEMM's line plots and line integrals: along +x it is +y, so
that the flux through a path is A(start) − A(end) in a plane, and 2π (ψ(end) − ψ(start)) with ψ = r·A_φ about an axis.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fluxbore.fem.mesh import Floats

_NUDGE = 1e-7
"""Ends of intervals are sampled this share of a half inside, where the direction at a corner is not in doubt."""

_LOBATTO = np.array([-1 + _NUDGE, -np.sqrt(0.2), np.sqrt(0.2), 1 - _NUDGE])
_WEIGHTS = np.array([1, 5, 5, 1]) / 6
"""Lobatto's rule of four points, exact to degree five. It samples ends, so that no jump hides between two rules."""

_FIRST_INTERVALS = 64
"""Of a whole path, at least one to a piece: short enough that no body on the path is stepped over unseen."""

_MOST_INTERVALS = 100_000
"""Bounds time and memory where an integrand is not integrable."""


@dataclass(frozen=True, slots=True, eq=False)
class Stations:
    """Places on a path.

    distance : (k,) from the start, along the path (m). points : (k, 2) m. tangents, normals : (k, 2) unit vectors.
    """

    distance: Floats
    points: Floats
    tangents: Floats
    normals: Floats


@dataclass(frozen=True, eq=False)
class Path:
    """corners : (n + 1, 2) ends of the pieces (m). turns : (n,) angle of each (rad), positive to the left, 0 straight.

    An arc of ±2π would have no end apart from its start: make it of two.
    """

    corners: Floats
    turns: Floats

    @classmethod
    def through(cls, corners: Sequence[tuple[float, float]] | Floats, turns: Sequence[float] | None = None) -> Path:
        """Pieces from corner to corner, straight if no turns are given. ValueError for a piece without length."""
        places = np.asarray(corners, dtype=float).reshape(-1, 2)
        angles = np.zeros(places.shape[0] - 1) if turns is None else np.asarray(turns, dtype=float)
        if places.shape[0] < 2 or angles.shape != (places.shape[0] - 1,):
            raise ValueError(f"a path of {places.shape[0]} corners has {angles.size} pieces")
        if not np.all(np.hypot(*np.diff(places, axis=0).T) > 0) or not np.all(np.abs(angles) < 2 * np.pi):
            raise ValueError("a piece of a path has no length, or turns by a whole circle")
        return cls(places, angles)

    @cached_property
    def ends(self) -> Floats:
        """(n + 1,) distance of each corner along the path (m)."""
        chord = np.hypot(*np.diff(self.corners, axis=0).T)
        # Arc over chord: (turn / 2) / sin(turn / 2); numpy's sinc has the π in it.
        return np.concatenate(([0.0], np.cumsum(chord / np.sinc(self.turns / (2 * np.pi)))))

    @property
    def length(self) -> float:
        """m."""
        return float(self.ends[-1])

    def at(self, distance: Floats) -> Stations:
        """Places at distances (k,) along the path (m); at a corner the piece that begins there."""
        distance = np.asarray(distance, dtype=float)
        piece = np.clip(np.searchsorted(self.ends, distance, side="right") - 1, 0, self.turns.size - 1)
        share = (distance - self.ends[piece]) / np.diff(self.ends)[piece]
        chord, turn = np.diff(self.corners, axis=0)[piece], self.turns[piece]
        # Of an arc that begins along its chord turned by −turn/2, the part up to a share t of it is a chord itself: its
        # length is chord · sin(t turn/2)/sin(turn/2), its direction half of the way to the tangent.
        reach = share * np.sinc(share * turn / (2 * np.pi)) / np.sinc(turn / (2 * np.pi))
        points = self.corners[piece] + reach[:, None] * _turned(chord, (share - 1) * turn / 2)
        tangents = _turned(chord / np.hypot(*chord.T)[:, None], (share - 0.5) * turn)
        return Stations(distance, points, tangents, np.column_stack((-tangents[:, 1], tangents[:, 0])))

    def sample(self, count: int) -> Stations:
        """Places at equal distances, from the start to the end."""
        return self.at(np.linspace(0.0, self.length, count))


def integrate(path: Path, function: Callable[[Stations], Floats], accuracy: float = 1e-6) -> tuple[Floats, Floats]:
    """∫ f dl along a path, and an estimate of its error: (...) each.

    function : values (k, ...) at k places; it may jump and kink at every element's edge, since intervals are halved
    where halving still tells. accuracy : as a share of ∫ |f| dl.
    """
    cuts = [
        np.linspace(a, b, 1 + int(np.ceil(_FIRST_INTERVALS * (b - a) / path.length)))
        for a, b in zip(path.ends[:-1], path.ends[1:], strict=True)
    ]
    start, end = np.concatenate([c[:-1] for c in cuts]), np.concatenate([c[1:] for c in cuts])
    coarse, size = _lobatto(path, function, start, end)
    scale = size.sum(axis=0)
    total, error = np.zeros(coarse.shape[1:]), np.zeros(coarse.shape[1:])
    spent = start.size
    while start.size:
        middle = (start + end) / 2
        left, right = _lobatto(path, function, start, middle)[0], _lobatto(path, function, middle, end)[0]
        change = np.abs(left + right - coarse)
        allowed = accuracy * scale / _FIRST_INTERVALS
        open_ones = np.any((change > allowed).reshape(start.size, -1), axis=1)
        spent += 2 * int(np.count_nonzero(open_ones))
        if spent > _MOST_INTERVALS:
            open_ones[:] = False
        total += (left + right)[~open_ones].sum(axis=0)
        error += change[~open_ones].sum(axis=0)
        coarse = np.concatenate((left[open_ones], right[open_ones]))
        start, end = (
            np.concatenate((start[open_ones], middle[open_ones])),
            np.concatenate((middle[open_ones], end[open_ones])),
        )
    return total, error


def _lobatto(path: Path, function: Callable[[Stations], Floats], start: Floats, end: Floats) -> tuple[Floats, Floats]:
    """(k, ...) ∫ f and ∫ |f| over each interval."""
    half, middle = (end - start) / 2, (start + end) / 2
    values = np.asarray(function(path.at((middle[:, None] + half[:, None] * _LOBATTO).ravel())))
    values = values.reshape(start.size, _LOBATTO.size, *values.shape[1:])
    weights = half[:, None] * _WEIGHTS
    return np.einsum("kq,kq...->k...", weights, values), np.einsum("kq,kq...->k...", weights, np.abs(values))


def _turned(vectors: Floats, angle: Floats) -> Floats:
    """(k, 2) vectors turned to the left by angles (k,) (rad)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.column_stack((c * vectors[:, 0] - s * vectors[:, 1], s * vectors[:, 0] + c * vectors[:, 1]))
