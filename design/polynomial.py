"""Polynomials in s whose coefficients may be anything that adds and multiplies.

A polynomial is a tuple of coefficients, the constant first. A coefficient is a float, an array over a grid of
parameters, a fraction, or a symbol: one derivation then gives numbers, a whole grid at once, and a proof.
"""

from __future__ import annotations

from typing import Any

Number = Any
"""What adds, subtracts and multiplies: float, array over a grid, fraction, symbol."""

Polynomial = tuple[Number, ...]

S: Polynomial = (0, 1)
"""The polynomial s."""


def add(left: Polynomial, right: Polynomial) -> Polynomial:
    longer, shorter = (left, right) if len(left) >= len(right) else (right, left)
    return tuple(a + b for a, b in zip(longer, shorter, strict=False)) + longer[len(shorter) :]


def multiply(left: Polynomial, right: Polynomial) -> Polynomial:
    """The product. A coefficient that is the integer zero stands for one that is not there, and is passed by."""
    result: list[Number] = [0] * (len(left) + len(right) - 1)
    for i, a in enumerate(left):
        for j, b in enumerate(right):
            if not (_absent(a) or _absent(b)):
                result[i + j] = result[i + j] + a * b
    return tuple(result)


def scaled(polynomial: Polynomial, factor: Number) -> Polynomial:
    return multiply((factor,), polynomial)


def _absent(coefficient: Number) -> bool:
    return isinstance(coefficient, int) and coefficient == 0


def trimmed(polynomial: Polynomial) -> Polynomial:
    """Without the highest powers that are not there."""
    count = len(polynomial)
    while count > 1 and _absent(polynomial[count - 1]):
        count -= 1
    return polynomial[:count]
