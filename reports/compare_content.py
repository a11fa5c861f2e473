"""What a comparison of designs says: everything its page needs, gathered before the first line of it is written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.spec import Spec
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.parts_list import Item
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.outcome import Check
from fluxbore.reports.content import ReportContent
from fluxbore.reports.kind_words import PLAIN, KindWords

Array = NDArray[np.float64]

LETTERS = "ABCDEF"
"""What the designs are called, in the order in which they were named."""

MOST = len(LETTERS)

SAME = 1e-3
"""Relative difference up to which two figures count as the same: finite elements on like meshes are no closer."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ComparedDesign:
    """One design of a comparison.

    letter : what the page calls it. source : the file or folder as it was named. checks : its own study's limits.
    items : its parts list. curves : name of `compare_curves.CURVES` -> abscissa and ordinate (SI), where its kind has
    them. provenance : label -> text. run : what the finished run that it comes from says of itself; empty for a file.
    """

    letter: str
    source: str
    spec: Spec
    evaluation: Evaluation
    checks: tuple[Check, ...] = ()
    assembly: Assembly | None = None
    items: tuple[Item, ...] = ()
    curves: Mapping[str, tuple[Array, Array]] = field(default_factory=dict)
    provenance: Mapping[str, str] = field(default_factory=dict)
    run: str = ""
    words: KindWords = PLAIN

    @property
    def name(self) -> str:
        return self.spec.word("actuator.name")

    @property
    def content(self) -> ReportContent:
        """What the sentences of an ordinary report are made from."""
        return ReportContent(spec=self.spec, start=self.evaluation, checks=self.checks, words=self.words)

    def figure(self, name: str) -> float | None:
        """A figure of `Performance` (SI), None where this design has none."""
        value = getattr(self.evaluation.performance, name)
        return None if value is None else float(value)


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """Two designs or more; the first is the one that the others are measured against.

    same : relative difference up to which figures count as the same.
    """

    designs: tuple[ComparedDesign, ...]
    same: float = SAME
    provenance: Mapping[str, str] = field(default_factory=dict)

    @property
    def first(self) -> ComparedDesign:
        return self.designs[0]

    @property
    def alike(self) -> bool:
        """Whether all are of one kind."""
        return len({design.spec.kind.name for design in self.designs}) == 1
