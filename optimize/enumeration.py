"""The counts among a study's variables (pole pairs, sets of coils): every combination, the nearest neighbours in turn.

A count has no derivative and no half-way design, so each combination is a continuous search of its own. None is left
out because it seems poor: that would take a proven bound on what it could reach, and no figure of a field comes with
such a bound. What cannot be built whatever the other variables are is: its first designs all fail with the same words.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import product

from fluxbore.design.errors import SpecError
from fluxbore.design.spec import Spec
from fluxbore.optimize.outcome import Candidate, Limit

MOST_COMBINATIONS = 64
"""Continuous searches in one; more is a slip in a bound, or a sweep."""

Counts = Mapping[str, int]
"""Dotted key -> count, in the order of the study's variables."""


def combinations(base: Spec, limits: Sequence[Limit]) -> tuple[Counts, ...]:
    """Every combination of the study's counts within their bounds and limits; one without counts where there are none.

    Raises SpecError where there are more than `MOST_COMBINATIONS`, or none.
    """
    variables = [variable for variable in base.study.variables if variable.integer]
    choices = []
    for variable in variables:
        own = [limit for limit in limits if limit.subject == variable.key]
        low = math.ceil(max([variable.lower, *(limit.limit for limit in own if limit.sense == ">=")]))
        high = math.floor(min([variable.upper, *(limit.limit for limit in own if limit.sense == "<=")]))
        if low > high:
            raise SpecError(f"study.constraints cannot be met: they leave no whole number for {variable.key}.")
        choices.append(range(low, high + 1))
    many = math.prod(len(choice) for choice in choices)
    if many > MOST_COMBINATIONS:
        raise SpecError(
            f"study.variables must have at most {MOST_COMBINATIONS} combinations of counts, each of which is a search "
            f"of its own; got {many}."
        )
    keys = [variable.key for variable in variables]
    return tuple(dict(zip(keys, counts, strict=True)) for counts in product(*choices))


def in_turn(found: Sequence[Counts], start: Counts) -> list[Counts]:
    """The combinations by their distance from the start's: each then has a neighbour that was searched before it."""
    return sorted(found, key=lambda counts: (distance(counts, start), tuple(counts.values())))


def distance(one: Counts, other: Counts) -> int:
    """Steps of one count by one from the one combination to the other."""
    return sum(abs(one[key] - other[key]) for key in one)


def show(counts: Counts) -> str:
    """The combination in words."""
    return " and ".join(f"{key} = {count}" for key, count in counts.items())


def hopeless(first: Sequence[Candidate]) -> str:
    """Why a combination's first designs show that none of its designs works, or nothing.

    Two different designs at least that fail with the same words to the last digit: what depended on the other variables
    would have their numbers in it.
    """
    reasons = {" ".join(made.evaluation.reasons) for made in first}
    different = {tuple(made.values.items()) for made in first}
    if len(different) < 2 or len(reasons) > 1 or any(made.evaluation.ok for made in first):
        return ""
    return reasons.pop()


def told_left_out(found: Sequence[tuple[Counts, str]]) -> str:
    """The combinations that were left out, with their reasons; those with one reason in one sentence."""
    alike: dict[str, list[str]] = {}
    for counts, why in found:
        alike.setdefault(why, []).append(show(counts))
    return "".join(
        f"Left out: {', '.join(names)}, where the first designs all fail alike: {why} " for why, names in alike.items()
    )


def told_rest(*, outside: bool, several: bool, rounded: bool) -> str:
    """What a budget is for besides one combination's search."""
    uses = {"the start, which is out of bounds": outside, "the other combinations": several, "the rounding": rounded}
    return " and ".join(words for words, there in uses.items() if there)
