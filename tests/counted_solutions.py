"""How many right sides the factors of mapped meshes are asked for."""

from __future__ import annotations

import numpy as np
import pytest

from fluxbore.fem.cell_band import CellFactor


def counted_solutions(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """A one for each right side from now on; several at once are solved one by one."""
    columns: list[int] = []
    solve = CellFactor.solve

    def counted(self: CellFactor, right: np.ndarray) -> np.ndarray:
        if right.ndim == 1:
            columns.append(1)
        return solve(self, right)

    monkeypatch.setattr(CellFactor, "solve", counted)
    return columns
