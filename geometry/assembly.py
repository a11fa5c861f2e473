"""An actuator as a list of parts where they stand at one position of the mover, and how they lie to one another."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from fluxbore.design.title_block import TitleBlock
from fluxbore.geometry.helical_clearance import overlap as helical_overlap
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.measure import Detail, Measure
from fluxbore.geometry.outline import box, distance, overlap
from fluxbore.geometry.part import Body


@dataclass(frozen=True, slots=True)
class Assembly:
    """Parts where they stand at one position of the mover (m).

    squeezes : pairs of part names that are drawn overlapping on purpose, because one of them yields.
    outside : the group that pictures cut open. carried_mass : kg, of what moves with the mover and is not drawn.
    measures : what a drawing is dimensioned by; none stands for the sizes of every kind of part. details : what it
    shows again, larger. title : numbers and names for drawings and CAD files.
    """

    name: str
    parts: tuple[Body, ...]
    position: float
    squeezes: tuple[tuple[str, str], ...] = ()
    outside: str = "stator"
    carried_mass: float = 0.0
    measures: tuple[Measure, ...] = ()
    details: tuple[Detail, ...] = ()
    title: TitleBlock = field(default_factory=TitleBlock)

    def part(self, name: str) -> Body:
        return next(part for part in self.parts if part.name == name)


@dataclass(frozen=True, slots=True)
class Interference:
    """Two parts that share a volume (m^3); ``designed`` where the assembly says that one of them yields."""

    first: str
    second: str
    volume: float
    designed: bool


def interferences(assembly: Assembly) -> tuple[Interference, ...]:
    """Every pair of parts that share a volume. Cross-holes are left out of account, so that the answer errs safely.

    Beside a turned part one that follows a helix counts with its envelope; two of them are held against each other.
    """
    allowed = {frozenset(pair) for pair in assembly.squeezes}
    return tuple(
        Interference(a.name, b.name, shared, frozenset((a.name, b.name)) in allowed)
        for a, b in _near(assembly.parts)
        if (shared := _shared(a, b)) > 0
    )


def _near(parts: tuple[Body, ...]) -> Iterator[tuple[Body, Body]]:
    """The pairs whose envelopes meet, all at once for each part: of hundreds of magnets few are neighbours."""
    if not parts:
        return
    inner, outer, low, high = np.array([box(part.profile) for part in parts]).T
    for i, part in enumerate(parts):
        later = slice(i + 1, None)
        meet = (inner[later] < outer[i]) & (outer[later] > inner[i]) & (low[later] < high[i]) & (high[later] > low[i])
        for j in np.flatnonzero(meet):
            yield part, parts[i + 1 + int(j)]


def _shared(first: Body, second: Body) -> float:
    if isinstance(first, HelicalPart) and isinstance(second, HelicalPart):
        return helical_overlap(first, second)
    return overlap(first.profile, second.profile)


def clearance(first: Body, second: Body) -> float:
    """Shortest distance between two parts (m); 0 where they touch or overlap. Cross-holes are left out of account.

    What follows a helix counts with its envelope; `fluxbore.geometry.helical_clearance` has the gaps between two.
    """
    return distance(first.profile, second.profile)
