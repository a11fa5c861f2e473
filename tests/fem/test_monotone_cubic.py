"""The monotone cubic against scipy's PCHIP, which computes the same."""

import subprocess
import sys

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from fluxbore.fem.monotone_cubic import cubic_values, monotone_cubic


@pytest.mark.parametrize("seed", range(4))
def test_equals_pchip(seed: int) -> None:
    """Catches weights in each other's place, and ends that overshoot: rising, flat and turning tables."""
    rng = np.random.default_rng(seed)
    x = np.cumsum(rng.uniform(0.01, 2.0, 12))
    y = np.cumsum(rng.uniform(-1.0 if seed % 2 else 0.0, 1.0, 12)) ** 3
    y[5] = y[6]
    ours, theirs = monotone_cubic(x, y), PchipInterpolator(x, y)
    assert ours == pytest.approx(theirs.c, rel=1e-9, abs=1e-9)
    points = np.linspace(x[0], x[-1], 300)
    assert cubic_values(x, ours, points) == pytest.approx(theirs(points), rel=1e-10, abs=1e-10)


def test_ends_of_a_table_that_turns_at_once() -> None:
    """Catches an end slope that is not cut to three secants, or not to zero."""
    for y in ([0.0, 1.0, -20.0, 0.0], [0.0, 1.0, 20.0, 21.0], [3.0, 3.0, 4.0, 4.0]):
        x = np.array([0.0, 1.0, 1.5, 4.0])
        assert monotone_cubic(x, np.array(y)) == pytest.approx(PchipInterpolator(x, y).c, rel=1e-12, abs=1e-12)


def test_two_points() -> None:
    """Catches a table of two points that has no neighbours to ask."""
    assert monotone_cubic(np.array([1.0, 3.0]), np.array([2.0, 8.0]))[:, 0] == pytest.approx([0.0, 0.0, 3.0, 2.0])


def test_a_magnetisation_curve_loads_no_interpolation_package() -> None:
    """Catches an import that takes every worker of a sweep as long as several of its solutions."""
    code = (
        "import sys; from fluxbore.design.materials import standard; "
        "from fluxbore.fem.reluctivity import reluctivity_curve; import fluxbore.fem.tubular; "
        "reluctivity_curve(standard()['1010'].curve); "
        "print([name for name in ('scipy.interpolate', 'scipy.optimize', 'scipy.special') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
