"""B-H curves of soft-magnetic materials, guarded against tables that break a physical law."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from fluxbore.design.errors import MaterialError

MU_0 = 4e-7 * math.pi
"""H/m, the magnetic constant; its 2019 value differs by 5e-10, far below any B-H measurement."""

SLOPE_TOLERANCE = 1e-3
"""How far, relatively, a segment's slope may fall below mu_0.

Published tables are rounded to four digits or so: the last two points of 1010 steel give 0.99988 mu_0. A table in the
wrong unit or with two swapped rows misses by far more.
"""


@dataclass(frozen=True, slots=True)
class BHCurve:
    """A magnetisation curve as a table that starts at the origin.

    b : flux densities (T), strictly increasing.
    h : field strengths (A/m), strictly increasing, as many as ``b``.
    source : where the table is published.

    The origin (0, 0) is put in front where the table starts later. Beyond the last point the slope is mu_0: the
    material is saturated. Raises MaterialError, with the curve's name, the row and both values, for a table that is not
    finite, not strictly increasing, or rises more slowly than the vacuum (dB/dH < mu_0), which no material does.
    """

    name: str
    b: tuple[float, ...]
    h: tuple[float, ...]
    source: str

    def __post_init__(self) -> None:
        b, h = _guarded(self.b, self.h, f'B-H curve "{self.name}"')
        object.__setattr__(self, "b", b)
        object.__setattr__(self, "h", h)

    @property
    def maximum_permeability(self) -> float:
        """The largest B / (mu_0 H) among the table's points, relative."""
        return max(b / (MU_0 * h) for b, h in zip(self.b[1:], self.h[1:], strict=True))

    @property
    def saturation(self) -> float:
        """Polarisation J = B - mu_0 H of the last point (T): the flux density that the iron itself can add."""
        return self.b[-1] - MU_0 * self.h[-1]


def from_points(name: str, points: Iterable[object], source: str, key: str) -> BHCurve:
    """The curve of a specification's table of pairs ``[[B, H], ...]``, in T and A/m.

    Raises MaterialError, naming ``key`` and the row, where a row is not a pair of numbers, or as `BHCurve` does.
    """
    rows: list[tuple[float, float]] = []
    for number, row in enumerate(points, start=1):
        pair = row if isinstance(row, (list, tuple)) else ()
        if len(pair) != 2 or not all(_is_number(value) for value in pair):
            raise MaterialError(
                f"{key} must hold pairs of bare numbers [B in T, H in A/m]; row {number} is {_shown(row)}."
            )
        rows.append((float(pair[0]), float(pair[1])))
    return BHCurve(name, *_guarded([b for b, _ in rows], [h for _, h in rows], key), source)


def read_csv(name: str, path: Path, source: str, key: str) -> BHCurve:
    """The curve of a text file: a line a point, ``B,H`` in T and A/m; lines that start with # are remarks.

    The first line may be a heading. Raises MaterialError, naming ``key``, the file and
    the line, where it cannot be read, or as `BHCurve` does.
    """
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise MaterialError(f'{key} must name a file that can be read; got "{path}": {error.strerror}.') from error
    except UnicodeDecodeError as error:
        raise MaterialError(f'{key} must name a text file in UTF-8; got "{path}".') from error
    rows: list[tuple[float, float]] = []
    heading_allowed = True
    for number, line in enumerate(lines, start=1):
        text = line.strip().removeprefix("\ufeff")
        if not text or text.startswith("#"):
            continue
        pair = _numbers(text.replace(";", ",").split(","))
        if pair is not None:
            rows.append(pair)
        elif not heading_allowed:
            raise MaterialError(
                f'{key} must name a file of lines "B,H" in T and A/m; line {number} of "{path}" is "{text}".'
            )
        heading_allowed = False
    return BHCurve(name, *_guarded([b for b, _ in rows], [h for _, h in rows], f'{key} "{path}"'), source)


def _guarded(b: Sequence[float], h: Sequence[float], subject: str) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """The table with its origin, once it is known to break no law; ``subject`` begins the sentence otherwise."""
    b, h = tuple(map(float, b)), tuple(map(float, h))

    def broken(row: int, rule: str, at: int) -> MaterialError:
        return MaterialError(f"{subject} row {row} must {rule}; got B = {b[at]:.6g} T, H = {h[at]:.6g} A/m.")

    if len(b) != len(h):
        raise MaterialError(f"{subject} must have one H to each B; got {len(b)} B and {len(h)} H.")
    for i in range(len(b)):
        if not (math.isfinite(b[i]) and math.isfinite(h[i])):
            raise broken(i + 1, "be finite", i)
    first_row = 1
    if b and (b[0], h[0]) != (0.0, 0.0):
        if b[0] < 0.0 or h[0] < 0.0:
            raise broken(1, "start at the origin or above it", 0)
        b, h = (0.0, *b), (0.0, *h)
        first_row = 0  # the origin is ours; the user's rows count from one
    if len(b) < 3:
        raise MaterialError(f"{subject} must have at least three points with the origin; got {len(b)}.")
    for i in range(1, len(b)):
        before = f"B = {b[i - 1]:.6g} T, H = {h[i - 1]:.6g} A/m of the point before"
        if b[i] <= b[i - 1] or h[i] <= h[i - 1]:
            raise broken(first_row + i, f"exceed both {before}", i)
        slope = (b[i] - b[i - 1]) / (h[i] - h[i - 1])
        if slope < MU_0 * (1.0 - SLOPE_TOLERANCE):
            law = f"rise from {before} at least as steeply as the vacuum, by {MU_0:.5g} H/m and not {slope:.5g} H/m"
            raise broken(first_row + i, law, i)
    return b, h


def _numbers(cells: Sequence[str]) -> tuple[float, float] | None:
    try:
        b, h = (float(cell) for cell in cells)
    except ValueError:
        return None
    return b, h


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _shown(row: object) -> str:
    text = repr(row)
    return text if len(text) <= 60 else text[:57] + "..."
