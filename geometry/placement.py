"""Where a piece stands against another of the same shape: turned end for end or not, turned about z, moved along z.

Files that know of copies hold a shape once and place it, so that 227 arcs are one arc.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.part import Body, Part

if TYPE_CHECKING:
    from fluxbore.geometry.surface import Floats

NEAR = 1e-9
"""m, and rad. Pieces that agree so far are alike; the parts list counts in the same steps."""

_Feature = tuple[float, float, float, float, str]
"""Of a drilling: its angle (rad), its heights (m; a radial one has one), its radius (m), what else must agree."""


@dataclass(frozen=True, slots=True)
class Placement:
    """First turned end for end about the x axis where ``flipped``, then by ``angle`` about z (rad), then along z by
    ``shift`` (m)."""

    flipped: bool = False
    angle: float = 0.0
    shift: float = 0.0

    @property
    def matrix(self) -> Floats:
        """(4, 4), for columns (x, y, z, 1) in m."""
        c, s, side = math.cos(self.angle), math.sin(self.angle), -1.0 if self.flipped else 1.0
        return np.array([[c, -s * side, 0, 0], [s, c * side, 0, 0], [0, 0, side, self.shift], [0, 0, 0, 1.0]])

    @property
    def quaternion(self) -> tuple[float, float, float, float]:
        """(x, y, z, w) of the turn."""
        c, s = math.cos(self.angle / 2), math.sin(self.angle / 2)
        return (c, s, 0.0, 0.0) if self.flipped else (0.0, 0.0, s, c)


def placement(first: Body, other: Body) -> Placement | None:
    """How the first piece comes to stand where the other is; None where it cannot, being another shape."""
    if isinstance(first, HelicalPart) and isinstance(other, HelicalPart):
        return _of_helices(first, other)
    if isinstance(first, HelicalPart) or isinstance(other, HelicalPart):
        return None
    return next((place for place in _candidates(first, other) if _agree(first, other, place)), None)


def _candidates(first: Part, other: Part) -> Iterator[Placement]:
    heights, target = [z for _, z in first.profile], min(z for _, z in other.profile)
    mine, theirs = _features(first), _features(other)
    for flipped in (False, True):
        shift = target + max(heights) if flipped else target - min(heights)
        if not mine:
            yield Placement(flipped, 0.0, shift)
            continue
        start = -mine[0][0] if flipped else mine[0][0]
        for feature in theirs:
            if feature[3:] == mine[0][3:]:
                yield Placement(flipped, math.remainder(feature[0] - start, math.tau), shift)


def _features(part: Part) -> list[_Feature]:
    radial = [(h.angle, h.z, h.z, h.bottom, f"across {h.diameter:.9f} {h.thread}") for h in part.holes]
    axial = [(h.angle, h.start, h.end, h.radius, f"along {h.diameter:.9f} {h.thread}") for h in part.axial_holes]
    return radial + axial


def _agree(first: Part, other: Part, place: Placement) -> bool:
    side = -1.0 if place.flipped else 1.0
    profile = [(r, side * z + place.shift) for r, z in first.profile]
    if not _same(profile, other.profile):
        return False
    theirs = _features(other)
    for angle, low, high, radius, what in _features(first):
        turned, heights = side * angle + place.angle, sorted((side * low + place.shift, side * high + place.shift))
        for i, (their_angle, their_low, their_high, their_radius, their_what) in enumerate(theirs):
            apart = (*np.subtract(heights, (their_low, their_high)), radius - their_radius)
            around = math.remainder(turned - their_angle, math.tau)
            if what == their_what and abs(around) < NEAR and max(map(abs, apart)) < NEAR:
                del theirs[i]
                break
        else:
            return False
    return not theirs


def _of_helices(first: HelicalPart, other: HelicalPart) -> Placement | None:
    radii = (first.inner_radius - other.inner_radius, first.outer_radius - other.outer_radius)
    if max(map(abs, radii)) > NEAR:
        return None
    middle, target = np.mean(first.outline, axis=0), np.mean(other.outline, axis=0)
    for side in (1.0, -1.0):
        angle, shift = target - side * middle
        if _same([(side * theta + angle, side * z + shift) for theta, z in first.outline], other.outline):
            return Placement(side < 0, float(angle), float(shift))
    return None


def _same(first: Sequence[tuple[float, float]], other: Sequence[tuple[float, float]]) -> bool:
    """Whether two polygons have the same corners, from whichever they begin and in either sense."""
    if len(first) != len(other):
        return False
    a, b = np.array(first), np.array(other)
    near = np.all(np.abs(a[:, None] - b[None]) < NEAR, axis=2)
    return bool(np.all(near.sum(axis=0) == 1) and np.all(near.sum(axis=1) == 1))
