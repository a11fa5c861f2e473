"""Linear block diagrams, and the transfer function from one signal to another.

Each signal y is given by what flows into it, with polynomials in s for its own denominator and for each inflow:

    d(s) y = sum of n_i(s) u_i

All signals together are P(s) y = q(s) r with a matrix of polynomials P. By Cramer's rule

    y_k / r = det(P with its k-th column replaced by q) / det P

in which nothing is divided: det P is the characteristic polynomial with every state of the diagram once, and filters
that several loops share do not show up as common factors, as they would if the loops were closed one after another.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from fluxbore.design.polynomial import Polynomial, add, multiply, scaled, trimmed

_ONE: Polynomial = (1,)
_NOTHING: Polynomial = (0,)


@dataclass(frozen=True, slots=True)
class Signal:
    """denominator * signal = sum of numerator * inflow, over the inflows by name."""

    inflows: Mapping[str, Polynomial]
    denominator: Polynomial = _ONE


Diagram = Mapping[str, Signal]
"""Every signal by its name. A name that flows in but is no signal of the diagram comes from outside."""


@dataclass(frozen=True, slots=True)
class Ratio:
    """numerator(s) / denominator(s), the constant coefficients first."""

    numerator: Polynomial
    denominator: Polynomial


def transfer(diagram: Diagram, source: str, sink: str) -> Ratio:
    """sink / source, the other sources from outside being zero.

    Raises KeyError for a sink that is no signal of the diagram, ValueError for a source that is one.
    """
    if source in diagram:
        raise ValueError(f"{source} is a signal of the diagram itself")
    names = list(diagram)
    rows = _matrix(diagram)
    column = names.index(sink) if sink in diagram else -1
    if column < 0:
        raise KeyError(sink)
    replaced: list[dict[int, Polynomial]] = []
    for row, name in zip(rows, names, strict=True):
        kept = {place: entry for place, entry in row.items() if place != column}
        if source in diagram[name].inflows:
            kept[column] = diagram[name].inflows[source]
        replaced.append(kept)
    return Ratio(trimmed(_determinant(replaced)), trimmed(_determinant(rows)))


def characteristic(diagram: Diagram) -> Polynomial:
    """det P: its roots are the poles of everything in the diagram. The diagram's own sources play no part in it."""
    return trimmed(_determinant(_matrix(diagram)))


def _matrix(diagram: Diagram) -> list[dict[int, Polynomial]]:
    """P by rows, each with the columns that are not zero."""
    place = {name: index for index, name in enumerate(diagram)}
    rows: list[dict[int, Polynomial]] = []
    for name, signal in diagram.items():
        row = {place[name]: signal.denominator}
        for inflow, numerator in signal.inflows.items():
            if inflow in place:
                column = place[inflow]
                row[column] = add(row.get(column, _NOTHING), scaled(numerator, -1))
        rows.append(row)
    return rows


def _determinant(rows: list[dict[int, Polynomial]]) -> Polynomial:
    """By expansion along the rows, each minor once: for diagrams, whose rows hold few entries, that is quick."""
    known: dict[int, Polynomial] = {}

    def minor(row: int, taken: int) -> Polynomial:
        """Of the rows from this one on, with the columns that are not in the bit set `taken`."""
        if row == len(rows):
            return _ONE
        if taken not in known:
            total = _NOTHING
            for column, entry in rows[row].items():
                if not taken >> column & 1:
                    rest = minor(row + 1, taken | 1 << column)
                    passed = bin(~taken & ((1 << column) - 1)).count("1")
                    total = add(total, scaled(multiply(entry, rest), -1 if passed % 2 else 1))
            known[taken] = total
        return known[taken]

    return minor(0, 0)
