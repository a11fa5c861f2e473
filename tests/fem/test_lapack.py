"""The banded routines, alone and with scipy.linalg around them."""

import sys

import numpy as np
import pytest

from fluxbore.fem import lapack


@pytest.mark.parametrize("precision", [np.float32, np.float64])
def test_alone_or_with_scipy_the_same(precision: type, monkeypatch: pytest.MonkeyPatch) -> None:
    """Catches a module of another library, and a fallback that is none: factor and solution bit by bit."""
    band = np.full((3, 40), -1.0, dtype=precision)
    band[0] = 4.0
    right = np.arange(40, dtype=precision)

    def solved() -> np.ndarray:
        factor, status = lapack.routine("pbtrf", band.dtype)(band, lower=1)
        assert status == 0
        solution, status = lapack.routine("pbtrs", band.dtype)(factor, right, lower=1)
        assert status == 0
        return np.asarray(solution)

    lapack._module.cache_clear()
    first = solved()
    assert first.dtype == precision

    def missing() -> None:
        raise ImportError("on purpose")

    lapack._module.cache_clear()
    monkeypatch.setattr(lapack, "alone", missing)
    assert np.array_equal(solved(), first)
    lapack._module.cache_clear()


def test_scipy_linalg_stays_away() -> None:
    """Catches an import that costs every worker a quarter of a second: in a process of its own."""
    import subprocess

    code = (
        "import sys; from fluxbore.fem import tubular; from fluxbore.fem.lapack import routine; import numpy as np; "
        "routine('pbtrf', np.dtype('float32')); sys.exit('scipy.linalg' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
