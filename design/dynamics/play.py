"""Play: a follower that moves only when pushed, deaf to whatever stays within its width.

    p_k = min(max(p_{k-1}, x_k - r), x_k + r)

The play operator of the literature on hysteresis (Krasnosel'skii and Pokrovskii 1989; from handbook knowledge, not
opened here). Before a hysteresis state that is fed from encoders it keeps their counts out: two encoders that count at
different moments make a displacement tremble by a count, and Bouc-Wen memory x_s loses 2 psi x_s of each tremble.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


def follow(followed: float, value: float, width: float) -> float:
    """p after a value x; width : r, zero or above."""
    if value > followed + width:
        return value - width
    if value < followed - width:
        return value + width
    return followed


def follow_record(values: ArrayLike, width: float) -> Floats:
    """p at every value, (n,), from p = x at the first."""
    record = np.asarray(values, dtype=np.float64)
    if width == 0 or len(record) == 0:
        return record
    followed = float(record[0])
    path = []
    for value in record.tolist():
        followed = follow(followed, value, width)
        path.append(followed)
    return np.array(path)
