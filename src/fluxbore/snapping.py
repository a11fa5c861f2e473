"""Puts the sizes that are bought to those of a catalogue, and says what that does to the figures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from fluxbore.actuators import assembly_of
from fluxbore.design.catalogue_rules import RULES, Rule
from fluxbore.design.errors import DesignError, FluxboreError
from fluxbore.design.keys import Value
from fluxbore.design.spec import Spec
from fluxbore.design_result import judged
from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.reading import as_spec

TRIED = 12
"""Sizes of a catalogue that are tried, the nearest first, before none is said to suit."""


@dataclass(frozen=True, slots=True)
class Bought:
    """One thing that is bought. before, after : every key that its size moves, with its values (SI).

    rank : 0 for the nearest size; more where nearer ones made no actuator. source : of the catalogue.
    """

    what: str
    designation: str
    source: str
    before: Mapping[str, Value]
    after: Mapping[str, Value]
    rank: int


@dataclass(frozen=True, slots=True)
class Snapped:
    """The design of catalogue sizes. reasons : which limits of the study it does not keep, in sentences.

    before, after : evaluated by the usual route.
    """

    spec: Spec
    bought: tuple[Bought, ...]
    before: Evaluation
    after: Evaluation
    reasons: tuple[str, ...]

    @property
    def ok(self) -> bool:
        """Whether it has figures and keeps the study's limits."""
        return self.after.ok and not self.reasons


def snap(spec: Spec | Path | str) -> Snapped:
    """The specification with the nearest catalogue sizes of what is bought, evaluated beside it.

    Clearances stay: what runs in a bore moves along with it. A size with which no actuator can be built gives way to
    the next; things are taken one after another, in the order of `fluxbore.design.catalogue_rules.RULES`. A limit that
    is relative to the start is the given design's. Raises DesignError where none of the nearest twelve sizes suits.
    """
    start = as_spec(spec)
    made, bought = start, []
    for rule in RULES[start.kind.name]:
        made, found = _nearest(made, rule)
        bought.append(found)
    before = evaluate(start)
    after = evaluate(made) if made.given != start.given else before
    return Snapped(made, tuple(bought), before, after, judged(made, after, before).reasons)


def _nearest(spec: Spec, rule: Rule) -> tuple[Spec, Bought]:
    """With the nearest size of one catalogue that makes an actuator."""
    last: FluxboreError | None = None
    for rank, size in enumerate(islice(rule.by_distance(spec.values), TRIED)):
        changes = rule.changes(size, spec.values)
        try:
            made = spec.with_values(changes) if changes else spec
            assembly_of(made)
        except FluxboreError as error:
            last = error
            continue
        before = {key: spec.values[key] for key in changes if key in spec.values}
        return made, Bought(rule.what, size.designation, rule.catalogue.source, before, changes, rank)
    raise DesignError(
        f"The {rule.what} must have a size of the catalogue ({rule.catalogue.name}) with which it can be built; none "
        f"of the nearest {TRIED} is: {last}"
    )
