"""The linear model of a production: what figures and keys do as the toleranced keys leave their nominal values."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.errors import DesignError, SpecError
from fluxbore.design.performance import FIGURES, to_mapping
from fluxbore.design.spec import Spec
from fluxbore.design.study import Tolerance
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.evaluator import Evaluator
from fluxbore.optimize.tolerance_scatter import LinearSum, centre, sigma

Array = NDArray[np.float64]

SMALL_SHARE = 1e-24
"""Of a figure's square: a variance below it is rounding errors, not scatter."""


def production_design(spec: Spec, tolerances: Sequence[Tolerance]) -> Spec:
    """The design with the toleranced keys given, in place of alternatives where they are such.

    What else stays is what the specification itself gives, not what the study holds: turns that were wound do not
    change with a yoke that is turned too thick, though a search may hold the density of turns. Raises SpecError where
    the tolerances over-determine the actuator or a key of theirs has no value.
    """
    for i, item in enumerate(tolerances):
        key = spec.kind.known(item.key)
        where = f"study.production.tolerances.{i}"
        if key.kind not in ("quantity", "number"):
            raise SpecError(f"{where}.key must name a continuous quantity; got {key.name}.")
        if item.key not in spec.values:
            raise SpecError(f"{where}.key must have a value in the specification; {item.key} has none.")
        if any(other.key == item.key for other in tolerances[:i]):
            raise SpecError(f"study.production.tolerances must name each key once; got {item.key} twice.")
    return spec.pinned(item.key for item in tolerances)


def held_keys(design: Spec, tolerances: Sequence[Tolerance]) -> tuple[str, ...]:
    """Of the keys that exclude one another, those that stay as given while the toleranced ones scatter."""
    scattered = {item.key for item in tolerances}
    return tuple(
        key for group in design.kind.alternatives for key in group.keys if key in design.given and key not in scattered
    )


@dataclass(frozen=True, slots=True)
class Subject:
    """A figure or key with its slopes: about the nominal design it is  nominal + sum of slope_i x deviation_i.

    exact : False where the slopes are central differences.
    """

    name: str
    nominal: float
    total: LinearSum
    exact: bool

    @property
    def slopes(self) -> tuple[float, ...]:
        return self.total.slopes

    @property
    def mean(self) -> float:
        return self.nominal + self.total.mean

    @property
    def scatters(self) -> bool:
        return self.total.variance > SMALL_SHARE * self.nominal**2

    def values(self, deviations: Array) -> Array:
        """(samples,) for deviations (samples, keys)."""
        made: Array = self.nominal + deviations @ np.array(self.slopes)
        return made


@dataclass(frozen=True, slots=True)
class LinearModel:
    """Every subject by name about the nominal design.

    first : the names that were asked for. reused : evaluations that the journal held.
    """

    nominal: Evaluation
    first: tuple[str, ...]
    subjects: Mapping[str, Subject]
    evaluations: int
    reused: int


def linear_model(evaluator: Evaluator, tolerances: Sequence[Tolerance], needed: Sequence[str]) -> LinearModel:
    """The linear model from one evaluation with derivatives; by central differences what the model derives not.

    evaluator : of the production's design, without derivatives of its own. needed : names of figures and keys that
    must have slopes; every other figure whose derivatives the evaluation brings comes along.
    A figure that is a maximum has the derivative of its norm times maximum over norm: both rise by the same share.
    Where either is not positive there is no such share, and the figure counts as one that is not derived.

    Raises DesignError where the nominal design, or a figure that is needed, cannot be evaluated.
    """
    keys, needed = tuple(item.key for item in tolerances), tuple(dict.fromkeys(needed))
    [done] = replace(evaluator, gradient=keys).all([{}])
    nominal = done.evaluation
    if not nominal.ok:
        raise DesignError(f"study.production cannot be analysed: {_sentence(nominal)}")
    slopes = dict(_slopes(nominal, keys))
    exact = set(slopes)
    evaluations, reused = 1, int(done.reused)
    figures = to_mapping(nominal.performance)
    wanted = [name for name in (FIGURES if nominal.gradient is None else needed) if name in FIGURES]
    missing = [name for name in wanted if name not in slopes and (figures[name] is not None or name in needed)]
    for name in missing:
        if figures[name] is None or not math.isfinite(figures[name] or 0.0):
            raise DesignError(f"study.production cannot be analysed: {name} of the design is not known.")
    if missing:
        pairs = evaluator.all([values for pair in _pairs(evaluator.base, tolerances) for values in pair])
        evaluations, reused = evaluations + len(pairs), reused + sum(item.reused for item in pairs)
        slopes |= _differences(tolerances, missing, [item.evaluation for item in pairs], set(needed))
    subjects = {
        name: Subject(name, float(figures[name] or 0.0), LinearSum(tuple(tolerances), row), name in exact)
        for name, row in slopes.items()
    }
    for name in needed:
        if name not in FIGURES:
            if name not in evaluator.base.values:
                raise DesignError(f"study.production cannot be analysed: {name} of the design is not known.")
            row, known = _key_slopes(evaluator, tolerances, name)
            subjects[name] = Subject(name, evaluator.base.number(name), LinearSum(tuple(tolerances), row), known)
    return LinearModel(nominal, needed, subjects, evaluations, reused)


def _slopes(nominal: Evaluation, keys: Sequence[str]) -> Iterator[tuple[str, tuple[float, ...]]]:
    """Figure -> slopes, of those that the evaluation derives by all of the keys."""
    figures, norms = to_mapping(nominal.performance), nominal.norms or {}
    for name, row in (nominal.gradient or {}).items():
        value, norm = figures.get(name), norms.get(name)
        if value is None or not all(math.isfinite(row.get(key, math.nan)) for key in keys):
            continue
        if norm is not None and not (norm.value > 0 and value > 0):
            continue  # no share by which both rise: differences of the maximum itself tell its slope
        scale = value / norm.value if norm is not None else 1.0
        yield name, tuple(scale * row[key] for key in keys)


def _pairs(design: Spec, tolerances: Sequence[Tolerance]) -> Iterator[tuple[dict[str, float], dict[str, float]]]:
    """For each key the two designs one standard deviation to both sides of its mean, which are within its limits."""
    for item in tolerances:
        middle, step = design.number(item.key) + centre(item), sigma(item)
        yield {item.key: middle - step}, {item.key: middle + step}


def _differences(
    tolerances: Sequence[Tolerance], names: Sequence[str], found: Sequence[Evaluation], needed: set[str]
) -> dict[str, tuple[float, ...]]:
    """The slopes of the figures ``names`` between the pairs of `_pairs`; a figure not ``needed`` may be missing."""
    for evaluation in found:
        if not evaluation.ok:
            raise DesignError(
                "study.production cannot be analysed: within one standard deviation of a tolerance "
                f"there is a design without figures. {_sentence(evaluation)}"
            )
    made: dict[str, tuple[float, ...]] = {}
    for name in names:
        ends = [getattr(evaluation.performance, name) for evaluation in found]
        if any(value is None or not math.isfinite(value) for value in ends):
            if name in needed:
                raise DesignError(
                    f"study.production cannot be analysed: {name} is not known within one standard deviation of the "
                    "tolerances."
                )
            continue
        steps = [2 * sigma(item) for item in tolerances]
        pairs = zip(ends[::2], ends[1::2], steps, strict=True)
        made[name] = tuple((high - low) / step if step else 0.0 for low, high, step in pairs)
    return made


def _key_slopes(evaluator: Evaluator, tolerances: Sequence[Tolerance], name: str) -> tuple[tuple[float, ...], bool]:
    """How a key follows from the toleranced ones; exact where it is one of them or does not follow from any."""
    if name in evaluator.base.given:
        return tuple(float(item.key == name) for item in tolerances), True
    row = []
    for item, (low, high) in zip(tolerances, _pairs(evaluator.base, tolerances), strict=True):
        step = 2 * sigma(item)
        ends = [evaluator.base.with_values(values).number(name) for values in (low, high)]
        row.append((ends[1] - ends[0]) / step if step else 0.0)
    return tuple(row), False


def _sentence(evaluation: Evaluation) -> str:
    text = " ".join(evaluation.reasons) or "The design has no figures."
    return text if text.endswith(".") else text + "."
