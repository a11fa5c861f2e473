"""How many right sides the factors of mapped meshes are asked for."""

from __future__ import annotations

import numpy as np
import pytest

from fluxbore.fem.cell_band import CellFactor


def counted_solutions(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """How many right sides at each solution from now on."""
    columns: list[int] = []
    solve = CellFactor.solve

    def counted(self: CellFactor, right: np.ndarray) -> np.ndarray:
        columns.extend(right.shape[1:] or (1,))
        return solve(self, right)

    monkeypatch.setattr(CellFactor, "solve", counted)
    return columns
