"""Whether the force control is stable: its poles, the grid of the published loci, and its two observers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from fluxbore.design.dynamics.force_parameters import ForceParameters
from fluxbore.design.dynamics.force_poles import (
    LARGEST_K_E,
    LARGEST_K_L,
    grid_axes,
    nominal_loop,
    pole_set,
    unstable_by_routh,
)
from fluxbore.design.dynamics.linearised import FILTERED, OBSERVER_SPEEDS, UNFILTERED
from fluxbore.design.poles import Complex
from fluxbore.reports.force_benchmark_loci import LABELS, LOAD, onset, stiffness_text
from fluxbore.reports.tables import Cell, Table
from fluxbore.reports.wording import capital, listing, plain, significant


def pole_table(parameters: ForceParameters) -> Table:
    """The poles at no force on the benchmark's load, by either observer."""
    loop = nominal_loop(parameters)
    rows = tuple((Cell(capital(LABELS[speed])), Cell(listed(pole_set(loop, speed)))) for speed in OBSERVER_SPEEDS)
    return Table(
        "Poles of the linearised force control at no force", ("Loop", "Poles (1/s)"), rows, words=frozenset({1})
    )


def listed(found: Complex) -> str:
    """``−0.954, −27.3 ± 334.6j``: of a pair the upper one stands for both."""
    texts = []
    for pole in found:
        real = significant(float(pole.real), 3) if abs(pole.real) < 1 else plain(float(pole.real), 1)
        if abs(pole.imag) <= 1e-9 * abs(pole):
            texts.append(real)
        elif pole.imag > 0:
            imaginary = float(pole.imag)
            texts.append(f"{real} ± {significant(imaginary, 3) if imaginary < 1 else plain(imaginary, 1)}j")
    return ", ".join(texts)


def sentences(figures: Mapping[str, Any], parameters: ForceParameters) -> tuple[str, ...]:
    """What the grid says of the published loop, and of the one that can be built."""
    unstable, built = figures["grid_points_unstable"], figures["grid_points_unstable_filtered"]
    dampings = listing(f"{damping:g}" for damping in grid_axes(parameters)[2])
    grid = (
        f"On {_count(figures['grid_points'])} points with K_e up to {stiffness_text(LARGEST_K_E)}, K_l* up to "
        f"{stiffness_text(LARGEST_K_L)} and D_e of {dampings}\u00a0N\u00a0s/m"
    )
    largest = f"the largest real part is {_signed(figures['largest_pole_real_part'])}\u00a01/s"
    count = f"{_count(unstable)} have a pole" if unstable else "no pole"
    verb = "" if unstable else " lies"
    routh = routh_text(unstable_by_routh(parameters, UNFILTERED))
    first = f"{grid} {count} of the published loop{verb} in the right half plane; {largest}. {routh}"
    if not built:
        return (first, "Nor has the loop whose observer reads the filtered speed, which can be built, such a pole.")
    by_table = _count(unstable_by_routh(parameters, FILTERED))
    worst = _signed(figures["largest_pole_real_part_filtered"])
    return (
        first,
        "The published loop needs the rotor’s unfiltered speed, an ideal derivative of the encoder. With the filtered "
        f"speed, which can be built, {_count(built)} of the points are unstable ({by_table} by Routh’s table), the "
        f"worst by {worst}\u00a01/s.{_against_a_wall(figures, parameters)} That any stiffness is stable therefore "
        "rests on the ideal derivative.",
    )


def routh_text(points: int) -> str:
    """The Routh-Hurwitz criterion for the published loop on the grid, which fails at so many points."""
    if not points:
        return "The Routh–Hurwitz criterion holds at each of them: its first column never changes sign."
    return f"The Routh–Hurwitz criterion fails at {_count(points)} of them."


def _against_a_wall(figures: Mapping[str, Any], parameters: ForceParameters) -> str:
    """What the stiffest load of the locus does to the loop that can be built, and from where; empty if nothing."""
    worst = figures["stiffest_load_pole_real_part_filtered"]
    if worst <= 0:
        return ""
    begin, softest = onset(parameters, FILTERED), float(LOAD.values()[0])
    start = ""
    if begin is not None:
        start = (
            f" It begins at K_e = {stiffness_text(begin)}." if begin > softest else " No load is soft enough for it."
        )
    return (
        f" Against a load of {stiffness_text(LARGEST_K_E)} and the benchmark’s damping the mover rings up with "
        f"{_signed(worst)}\u00a01/s, where the published loop has "
        f"{_signed(figures['stiffest_load_pole_real_part'])}\u00a01/s.{start}"
    )


def _count(number: float) -> str:
    """``18 000``, with a narrow space."""
    return f"{number:,.0f}".replace(",", "\u202f")


def _signed(value: float) -> str:
    return f"{'+' if value > 0 else ''}{significant(value, 2)}"
