"""The specification as frozen data: values at dotted keys, the study, and notes on what was assumed."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

from fluxbore.design import (
    coils_keys,
    coils_values,
    hybrid_keys,
    hybrid_values,
    hydrostatic_keys,
    hydrostatic_values,
    lead_screw_keys,
    lead_screw_values,
)
from fluxbore.design.errors import SpecError
from fluxbore.design.keys import Alternatives, Key, Value, Values
from fluxbore.design.materials import Material
from fluxbore.design.study import Study
from fluxbore.design.title_block import DRAWING_KEYS


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of actuator as specifications see it.

    keys, alternatives : what may be given, and which of it excludes one another. resolve, from_values : how given
    values become all values, and those the parameters, a frozen dataclass of the kind's own. materials : key -> the
    kind of material it must name.
    non_magnetic : keys that must not name a soft iron.
    check : of the resolved values, beyond what the parameters themselves refuse; raises SpecError.
    """

    name: str
    keys: tuple[Key, ...]
    alternatives: tuple[Alternatives, ...]
    resolve: Callable[[Values], dict[str, Value]]
    from_values: Callable[[Values], Any]
    materials: Mapping[str, type[Material]] = field(default_factory=dict)
    non_magnetic: frozenset[str] = frozenset()
    check: Callable[[Values], None] | None = None

    def key(self, name: str) -> Key | None:
        return next((key for key in self.keys if key.name == name), None)

    def known(self, name: str) -> Key:
        """The key of this name; SpecError with a hint at the nearest one where there is none."""
        key = self.key(name)
        if key is None:
            hint = suggestion(name, [other.name for other in self.keys])
            raise SpecError(f"{name} is not a key of this specification{hint}.")
        return key


KINDS: dict[str, Kind] = {
    "hybrid": Kind(
        "hybrid",
        (*hybrid_keys.HYBRID_KEYS, *DRAWING_KEYS),
        hybrid_keys.HYBRID_ALTERNATIVES,
        hybrid_values.resolve,
        hybrid_values.from_values,
        hybrid_keys.HYBRID_MATERIALS,
        hybrid_keys.HYBRID_NON_MAGNETIC,
        hybrid_values.check_window,
    ),
    "coils": Kind(
        "coils",
        (*coils_keys.COILS_KEYS, *DRAWING_KEYS),
        coils_keys.COILS_ALTERNATIVES,
        coils_values.resolve,
        coils_values.from_values,
        coils_keys.COILS_MATERIALS,
        check=coils_values.check,
    ),
    "lead-screw": Kind(
        "lead-screw",
        (*lead_screw_keys.LEAD_SCREW_KEYS, *DRAWING_KEYS),
        lead_screw_keys.LEAD_SCREW_ALTERNATIVES,
        lead_screw_values.resolve,
        lead_screw_values.from_values,
        lead_screw_keys.LEAD_SCREW_MATERIALS,
        lead_screw_keys.LEAD_SCREW_NON_MAGNETIC,
        lead_screw_values.check,
    ),
    "hydrostatic": Kind(
        "hydrostatic",
        (*hydrostatic_keys.HYDROSTATIC_KEYS, *DRAWING_KEYS),
        hydrostatic_keys.HYDROSTATIC_ALTERNATIVES,
        hydrostatic_values.resolve,
        hydrostatic_values.from_values,
        hydrostatic_keys.HYDROSTATIC_MATERIALS,
        check=hydrostatic_values.check,
    ),
}
"""Every kind of actuator a specification can describe."""


@dataclass(frozen=True, slots=True)
class Note:
    """Where a value comes from when no source publishes it: ``status`` is "assumed" or "calibrated"."""

    key: str
    status: str
    reason: str


@dataclass(frozen=True)
class Spec:
    """A specification that has been read and checked.

    given : dotted key -> SI value, as the file gives them, defaults included; alternatives not given are absent.
    materials : the standard library with the file's own materials.
    own_materials : the file's material tables as they stand in it, so that a design can be written out whole.
    """

    kind: Kind
    given: Values
    study: Study
    notes: tuple[Note, ...]
    materials: Mapping[str, Material]
    own_materials: Mapping[str, Any]

    @cached_property
    def values(self) -> Mapping[str, Value]:
        """Every key with its value: the given ones and those that follow from them."""
        return self.kind.resolve(self.given)

    @cached_property
    def actuator(self) -> Any:
        """The parameters as the frozen data of the kind. Raises DesignError where they cannot be built."""
        return self.kind.from_values(self.values)

    def number(self, key: str) -> float:
        """The SI value of a numeric key."""
        return float(self.values[key])

    def word(self, key: str) -> str:
        return str(self.values[key])

    def with_values(self, changes: Values) -> Spec:
        """The same specification with other values at some keys, each checked against its key's limits.

        A changed key takes the place of an alternative that was given; see `pinned`. Raises SpecError.
        """
        base = self.pinned(changes)
        for name, value in changes.items():
            self.kind.known(name).check(value)
        # A value that a study chose is no longer the assumed one.
        notes = tuple(note for note in base.notes if note.key not in changes)
        return replace(base, given={**base.given, **changes}, notes=notes)

    def pinned(self, keys: Iterable[str]) -> Spec:
        """The same design, given by these keys where they are alternatives of others.

        Pinning ``turns_density`` replaces a given ``turns`` by the density that it amounts to, so that the density
        stays when the winding's height changes.
        """
        wanted = set(keys)
        given = dict(self.given)
        for group in self.kind.alternatives:
            chosen = [key for key in group.keys if key in wanted]
            if not chosen or all(key in given for key in chosen):
                continue
            absent = [key for key in chosen if key not in self.values]
            if absent:
                raise SpecError(f"{absent[0]} must have a value in the specification to be held or moved; it has none.")
            if len(chosen) > group.count:
                raise SpecError(
                    f"The study is over-determined: at most {group.count} of {', '.join(group.keys)} can be held or "
                    f"varied ({group.rule}); got {', '.join(chosen)}."
                )
            kept = [key for key in group.keys if key in given and key not in wanted]
            stay = chosen + kept[: group.count - len(chosen)]
            for key in group.keys:
                given.pop(key, None)
            given.update({key: self.values[key] for key in stay})
        return replace(self, given=given)

    def for_study(self) -> Spec:
        """The start design as the study sees it: its held keys and variables are the ones that are given."""
        return self.pinned((*self.study.hold, *(variable.key for variable in self.study.variables)))

    def fingerprint(self) -> str:
        """SHA-256 over everything that decides the result: values, materials and the study."""
        content = {
            "kind": self.kind.name,
            "given": dict(sorted(self.given.items())),
            # As read, not as written: a B-H table in a file of its own counts by its contents.
            "materials": {name: repr(self.materials[name]) for name in sorted(self.own_materials)},
            "study": repr(self.study),
        }
        return hashlib.sha256(json.dumps(content, sort_keys=True, default=str).encode()).hexdigest()


def suggestion(name: str, known: Iterable[str]) -> str:
    """A hint at the nearest key; difflib is imported only on this path, for the sake of start-up."""
    import difflib

    if len(name) > 100:  # difflib takes its time
        return ""
    known = list(dict.fromkeys(known))
    leaf = name.rpartition(".")[2]
    near = [key for key in known if key.endswith("." + leaf)] or difflib.get_close_matches(name, known, n=1, cutoff=0.7)
    return f" (did you mean {near[0]}?)" if near else ""
