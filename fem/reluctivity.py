"""From a table of B and H to a smooth reluctivity.

The gradient of an incremental figure needs d²H/dB², so H(B) is made a C2 function; Newton's tangent needs it strictly
monotone. A cubic spline through the table is not monotone, and a monotone cubic is only C1. Schoenberg's
variation-diminishing spline is both: a uniform cubic B-spline whose coefficients are samples of a monotone
interpolant keeps its monotony, reproduces straight lines, and departs from it by step²/6 times its curvature: at a
tabulated H by less than a sixth of a step in B (Schoenberg 1967, "On spline functions"; Marsden 1970, J. Approx.
Theory 3). Where a table ends unsaturated, H turns towards the slope of vacuum less than two steps before its end.

The step is 10 mT, or a quarter of the table's shortest interval where that is below 20 mT: mu-metals are tabulated from
1 mT on, and a spline coarser than its table averages H over several of its points.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from fluxbore.design.bh_curve import MU_0, BHCurve
from fluxbore.fem.mesh import Floats
from fluxbore.fem.monotone_cubic import cubic_values, monotone_cubic

VACUUM_PERMEABILITY = MU_0
"""H/m. The pre-2019 exact value: it differs from CODATA 2018 by 5e-10, and FEMM uses it too."""

VACUUM_RELUCTIVITY = 1 / VACUUM_PERMEABILITY
"""m/H."""

STEP = 0.01
"""T between the knots of a table whose points are at least twice as far apart: 4.2 A/m at most from the interpolant
below 1.5 T of steel 1010, where H is 1300 A/m."""

INTERVALS = 20_000
"""The most between zero and a table's last point: two points that all but coincide must not cost gigabytes."""

FINEST_STEP = 1e-9
"""T, below any measurement: the cube of a step must not vanish."""


@dataclass(frozen=True, slots=True, eq=False)
class ReluctivityCurve:
    """H(B) of a soft iron as a C2, strictly monotone cubic spline with uniform knots.

    step : length of an interval (T).
    coefficients : (4, k) of H on each interval in powers of (B − knot), lowest first; the last interval is the straight
        line of slope 1/μ0 that goes on for ever.
    energy : (k,) ∫H dB (J/m³) up to each knot.
    """

    step: float
    coefficients: Floats
    energy: Floats

    def reluctivity(self, b_squared: Floats) -> tuple[Floats, Floats]:
        """ν = H/B (m/H) and dν/d(B²) (m/(H T²)) at |B|² (T²), any shape."""
        b = np.sqrt(b_squared)
        k, x = self._locate(b)
        c0, c1, c2, c3 = (self.coefficients[i][k] for i in range(4))
        h = c0 + x * (c1 + x * (c2 + x * c3))
        slope = c1 + x * (2 * c2 + 3 * c3 * x)
        # H is odd in B and C2, so on the first interval it is exactly c1 B + c3 B³: no division by a vanishing B.
        first = k == 0
        b = np.where(first, 1.0, b)
        nu = np.where(first, c1 + c3 * x * x, h / b)
        return nu, np.where(first, c3, (slope - nu) / (2 * b * b))

    def curvature(self, b_squared: Floats) -> Floats:
        """d²ν/d(B²)² (m/(H T⁴)) at |B|² (T²): continuous, for the curve is C2."""
        b = np.sqrt(b_squared)
        k, x = self._locate(b)
        _, slope = self.reluctivity(b_squared)
        c2, c3 = self.coefficients[2][k], self.coefficients[3][k]
        first = k == 0
        b = np.where(first, 1.0, b)
        # H = ν B: with ' = d/d(B²), dH/dB = ν + 2 B² ν' and d²H/dB² = 6 B ν' + 4 B³ ν''.
        return np.where(first, 0.0, (2 * c2 + 6 * c3 * x - 6 * b * slope) / (4 * b**3))

    def field_strength(self, b: Floats) -> Floats:
        """H (A/m) at B >= 0 (T)."""
        k, x = self._locate(b)
        c0, c1, c2, c3 = (self.coefficients[i][k] for i in range(4))
        return np.asarray(c0 + x * (c1 + x * (c2 + x * c3)))

    def energy_density(self, b: Floats) -> Floats:
        """∫H dB from zero (J/m³) at B >= 0 (T)."""
        k, x = self._locate(b)
        c0, c1, c2, c3 = (self.coefficients[i][k] for i in range(4))
        return np.asarray(self.energy[k] + x * (c0 + x * (c1 / 2 + x * (c2 / 3 + x * c3 / 4))))

    def coenergy_at(self, h: Floats) -> Floats:
        """∫B dH from zero (J/m³) at H >= 0 (A/m)."""
        knots = self.step * np.arange(self.coefficients.shape[1])
        at_knots = self.coefficients[0]
        b = np.interp(h, at_knots, knots)
        beyond = h > at_knots[-1]
        b = np.where(beyond, knots[-1] + (h - at_knots[-1]) / VACUUM_RELUCTIVITY, b)
        for _ in range(4):  # Newton's steps from the chord, on a piece that is all but straight
            k, x = self._locate(b)
            _, c1, c2, c3 = (self.coefficients[i][k] for i in range(4))
            b = b - (self.field_strength(b) - h) / (c1 + x * (2 * c2 + 3 * c3 * x))
        return np.asarray(b * h - self.energy_density(b))

    def _locate(self, b: Floats) -> tuple[np.ndarray, Floats]:
        # fmin sends NaN to the last interval, where it stays NaN: a field that does not exist is Newton's to report.
        k = np.fmin(b / self.step, self.coefficients.shape[1] - 1).astype(int)
        return k, b - k * self.step


@lru_cache(maxsize=64)
def reluctivity_curve(curve: BHCurve) -> ReluctivityCurve:
    """The spline of a table: through its monotone interpolant, and with slope μ0 beyond its last point."""
    b, h = np.array(curve.b), np.array(curve.h)
    table = monotone_cubic(b, h)
    step = _step(b)
    knots = step * np.arange(int(np.ceil(b[-1] / step)) + 6)
    # Between two points of a steep table the interpolant can be steeper than 1/μ0, which no material is: a straight
    # line there is not. Cutting the slope instead would lose what is cut for all B above.
    interval = np.clip(np.searchsorted(b, knots, side="right") - 1, 0, b.size - 2)
    steep = _steepest(table, np.diff(b)) > VACUUM_RELUCTIVITY
    inside = np.where(steep[interval], np.interp(knots, b, h), cubic_values(b, table, np.minimum(knots, b[-1])))
    samples = np.where(knots <= b[-1], inside, h[-1] + (knots - b[-1]) * VACUUM_RELUCTIVITY)
    # A table's own rounding (`SLOPE_TOLERANCE` of the guard) may still exceed 1/μ0 by a thousandth.
    samples = np.concatenate(([0.0], np.cumsum(np.minimum(np.diff(samples), step * VACUUM_RELUCTIVITY))))
    control = np.concatenate((-samples[1:3][::-1], samples))
    before, here, after, beyond = control[1:-3], control[2:-2], control[3:-1], control[4:]
    coefficients = np.array(
        [
            (before + 4 * here + after) / 6,
            (after - before) / (2 * step),
            (before - 2 * here + after) / (2 * step**2),
            (beyond - 3 * after + 3 * here - before) / (6 * step**3),
        ]
    )
    coefficients[[0, 2], 0] = 0.0  # odd about zero: not even the rounding of the sums above
    coefficients[2:, -1] = 0.0
    x = step
    pieces = x * (coefficients[0] + x * (coefficients[1] / 2 + x * (coefficients[2] / 3 + x * coefficients[3] / 4)))
    energy = np.concatenate(([0.0], np.cumsum(pieces)[:-1]))
    return ReluctivityCurve(step, coefficients, energy)


def _step(b: Floats) -> float:
    """T between the knots for a table's flux densities (k,)."""
    shortest = round(float(np.diff(b).min()), 12)  # 0.06 − 0.04 is less than 0.02
    wanted = STEP if shortest >= 2 * STEP else shortest / 4
    return max(wanted, float(b[-1]) / INTERVALS, FINEST_STEP)


def _steepest(coefficients: Floats, length: Floats) -> Floats:
    """(k,) the largest slope of each of k cubics (4, k), highest power first, over its length (k,)."""
    cubic, square, line = coefficients[:3]
    vertex = np.divide(-square, 3 * cubic, out=np.zeros_like(cubic), where=cubic < 0)
    x = np.stack((np.zeros_like(length), np.clip(vertex, 0.0, length), length))
    return np.asarray((line + x * (2 * square + 3 * cubic * x)).max(axis=0))
