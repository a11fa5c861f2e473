"""Routh's table: how many poles lie in the right half plane, without computing one (Routh 1877, Hurwitz 1895).

For a_n s^n + ... + a_0 the first rows are a_n, a_{n-2}, ... and a_{n-1}, a_{n-3}, ...; each further row follows from
the two above it,

    c_j = (b_0 a_{j+1} - a_0 b_{j+1}) / b_0

and the polynomial has as many roots with a positive real part as the first column changes its sign. A zero in that
column leaves the count open: a pole stands on the imaginary axis, or the table needs more than this rule.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.polynomial import Number, Polynomial


def routh_table(polynomial: Polynomial) -> list[list[Number]]:
    """The n + 1 rows of the table; each entry is a float, an array over a grid, a fraction or a symbol.

    polynomial : the constant first. Entries that a zero in the first column leaves undefined are not a number with
    floats and arrays. Raises ValueError for fewer than two coefficients.
    """
    if len(polynomial) < 2:
        raise ValueError("a constant has no poles")
    falling = polynomial[::-1]
    above, row = list(falling[0::2]), list(falling[1::2])
    table = [above, row]
    for _ in range(len(polynomial) - 2):
        above, row = row, _next_row(above, row)
        table.append(row)
    return table


def first_column(polynomial: Polynomial) -> list[Number]:
    return [row[0] for row in routh_table(polynomial)]


def sign_changes(polynomial: Polynomial) -> NDArray[np.float64]:
    """The number of poles in the right half plane, over the grid of the coefficients; not a number where the first
    column holds a zero."""
    signs = np.sign(np.stack(np.broadcast_arrays(*(np.asarray(c, dtype=np.float64) for c in first_column(polynomial)))))
    changes = np.sum(signs[1:] != signs[:-1], axis=0).astype(np.float64)
    return np.where(np.all(np.abs(signs) == 1, axis=0), changes, np.nan)


def _next_row(above: list[Number], row: list[Number]) -> list[Number]:
    found: list[Number] = []
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        for j in range(len(above) - 1):
            beyond = row[j + 1] if j + 1 < len(row) else 0
            found.append(_quotient(row[0] * above[j + 1] - above[0] * beyond, row[0]))
    return found


def _quotient(dividend: Number, divisor: Number) -> Number:
    try:
        return dividend / divisor
    except ZeroDivisionError:  # an array holds no number there; a single number is treated alike
        return np.nan
