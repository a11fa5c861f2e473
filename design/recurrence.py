"""First-order linear recurrences with coefficients that change from step to step, over whole records at once."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray


def recurrence(factor: ArrayLike, added: ArrayLike, start: ArrayLike = 0.0) -> NDArray[np.float64]:
    """x_{k+1} = a_k x_k + b_k for every k, from x_0 = start.

    factor, added : a and b, (n,) or (n, runs), broadcast against one another over the runs.   start : () or (runs,).
    Returns x, (n + 1,) or (n + 1, runs); its first row is the start.

    The record is cut into about sqrt(n) blocks. Each runs from zero, all of them side by side, and carries along the
    product of its factors; the start of every block then follows from the end of the one before, so that 2 sqrt(n)
    steps of Python take the place of n. Products of factors that stay above one in size overflow sooner than the
    values themselves may, so |a| <= 1 is what it is meant for.
    """
    a, b = _same_rows(np.asarray(factor, dtype=np.float64), np.asarray(added, dtype=np.float64))
    first = np.broadcast_to(np.asarray(start, dtype=np.float64), np.broadcast_shapes(np.shape(start), b.shape[1:]))
    count, runs = len(b), first.shape
    length = max(1, math.isqrt(count))
    blocks = -(-count // length)
    product, value = (_blocked(record, blocks, length, runs, fill) for record, fill in ((a, 1.0), (b, 0.0)))
    for step in range(1, length):  # within the blocks, as if each began at zero
        value[step] += product[step] * value[step - 1]
        product[step] *= product[step - 1]
    carry = np.empty((blocks + 1, *runs))
    carry[0] = first
    for block in range(blocks):  # from the end of each block to the start of the next
        carry[block + 1] = product[-1, block] * carry[block] + value[-1, block]
    value += product * carry[:-1]
    ordered = np.moveaxis(value, 0, 1).reshape(blocks * length, *runs)[:count]
    return np.concatenate((first[np.newaxis], ordered))


def _same_rows(a: NDArray[np.float64], b: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Both with as many axes: a record (n,) holds for every run of the other's (n, runs)."""
    if len(a) != len(b):
        raise ValueError(f"a recurrence of {len(a)} factors has {len(b)} terms to add")
    deeper = max(a.ndim, b.ndim)
    a, b = (record.reshape(record.shape + (1,) * (deeper - record.ndim)) for record in (a, b))
    shape = np.broadcast_shapes(a.shape, b.shape)
    return np.broadcast_to(a, shape), np.broadcast_to(b, shape)


def _blocked(
    record: NDArray[np.float64], blocks: int, length: int, runs: tuple[int, ...], fill: float
) -> NDArray[np.float64]:
    """A record (n, *runs) as (length, blocks, *runs), the last block filled up with steps that change nothing."""
    padded = np.full((blocks * length, *runs), fill)
    padded[: len(record)] = record.reshape(record.shape + (1,) * (len(runs) + 1 - record.ndim))
    return np.ascontiguousarray(np.moveaxis(padded.reshape(blocks, length, *runs), 0, 1))
