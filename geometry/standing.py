"""How an assembly's parts stand to one another at the places of its stroke: overlaps, and the narrowest moving gap."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from fluxbore.geometry.assembly import Assembly, Interference, clearance, interferences
from fluxbore.geometry.outline import box
from fluxbore.geometry.part import Body


@dataclass(frozen=True, slots=True)
class Gap:
    """The shortest distance (m) between a part of the mover and one of the stator that do not touch."""

    first: str
    second: str
    distance: float


@dataclass(frozen=True, slots=True)
class Standing:
    """One place of the mover: its name and position (m). gap : None where nothing moves, or all touches."""

    place: str
    position: float
    interferences: tuple[Interference, ...]
    gap: Gap | None

    @property
    def sound(self) -> bool:
        """Whether no parts overlap but those that are meant to."""
        return all(item.designed for item in self.interferences)


def standings(places: Mapping[str, Assembly]) -> tuple[Standing, ...]:
    """Every place, the same parts at another place left out. Cross-holes are left out of account."""
    found: list[Standing] = []
    first = next(iter(places.values()))
    for place, whole in places.items():
        if whole is first or whole.parts != first.parts:
            found.append(Standing(place, whole.position, interferences(whole), narrowest(whole)))
    return tuple(found)


def narrowest(assembly: Assembly) -> Gap | None:
    """The narrowest gap between mover and stator, of pairs that neither touch nor overlap."""
    best: Gap | None = None
    for least, mine, theirs in sorted(_pairs(assembly), key=lambda pair: pair[0]):
        if best is not None and least >= best.distance:
            break
        distance = clearance(mine, theirs)
        if distance > 0 and (best is None or distance < best.distance):
            best = Gap(mine.name, theirs.name, distance)
    return best


def _pairs(assembly: Assembly) -> Iterator[tuple[float, Body, Body]]:
    """Mover and stator, of parts with one profile the first, with the distance of their boxes (m)."""
    groups: dict[str, dict[object, Body]] = {"mover": {}, "stator": {}}
    for part in assembly.parts:
        groups.setdefault(part.group, {}).setdefault(part.profile, part)
    for mine in groups["mover"].values():
        inner, outer, low, high = box(mine.profile)
        for theirs in groups["stator"].values():
            a, b, c, d = box(theirs.profile)
            yield math.hypot(max(inner - b, a - outer, 0.0), max(low - d, c - high, 0.0)), mine, theirs
