"""What a gradient search sees of an evaluated design: loss, misses and their derivatives by the scaled variables.

A figure that is a maximum enters as kappa times its smooth norm, kappa = maximum / norm at a reference design; during
one run of NLopt kappa is constant, so that value and derivative belong to one function. The limits that decide on
feasibility are held against the maximum itself, see `fluxbore.optimize.problem`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from fluxbore.design.errors import FluxboreError
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.gradient_search import View
from fluxbore.optimize.outcome import Candidate, Limit
from fluxbore.optimize.problem import Box, Merit

KEY_STEP = 1e-6
"""Step of the differences of a key that follows from the variables, of a variable's range; closed forms bear it."""


class NoSlopesError(Exception):
    """A sound design does not bring the derivatives of the figure that is named.

    keys : the variables by which they are missing.
    """

    def __init__(self, subject: str = "", keys: Sequence[str] = ()) -> None:
        super().__init__(subject)
        self.keys = tuple(keys)


@dataclass(frozen=True, slots=True)
class Slopes:
    """Makes views of a problem's designs.

    base : the start design, from which designs differ by their values. held : the limits of the misses, in order.
    """

    base: Spec
    box: Box
    merit: Merit
    held: Sequence[Limit]

    def kappas(self, reference: Candidate) -> dict[str, float]:
        """Figure -> maximum / norm at the reference design, for those of the problem that have a norm."""
        norms, performance = reference.evaluation.norms or {}, reference.evaluation.performance
        found = {}
        for figure in dict.fromkeys([self.merit.objective.figure, *(limit.subject for limit in self.held)]):
            value = getattr(performance, figure, None)
            if figure in norms and norms[figure].value and value:
                found[figure] = value / norms[figure].value
        return found

    def view(self, made: Candidate, kappas: Mapping[str, float], beside: Candidate | None = None) -> View | None:
        """The design's view; None where it lacks a figure. NoSlopesError where it lacks a derivative.

        beside : a sound design whose derivatives stand in for the design's own.
        """
        loss = self.merit.loss(made)
        misses = self.merit.misses(made, self.held)
        checks = {item.limit: item for item in made.checks}
        known = [limit in checks and checks[limit].margin is not None for limit in self.held]
        if not made.evaluation.ok or loss is None or not all(known):
            return None
        objective = self.merit.objective
        source = made if beside is None else beside
        factor = (-1.0 if objective.maximise else 1.0) / self.merit.scale
        smooth = _smooth(made.evaluation, objective.figure, kappas)
        slopes = []
        smoothed = []
        for limit, miss in zip(self.held, misses, strict=True):
            if checks[limit].value is None:  # without a load; with one the figure comes down from infinity
                smoothed.append(miss)
                slopes.append((0.0,) * len(self.box.keys))
                continue
            unit = (1.0 if limit.sense == "<=" else -1.0) / limit.size
            value = _smooth(made.evaluation, limit.subject, kappas)
            smoothed.append(miss if value is None else unit * (value - limit.limit))
            slopes.append(tuple(unit * slope for slope in self._row(source, limit.subject, kappas)))
        return View(
            loss if smooth is None else factor * smooth,
            tuple(smoothed),
            tuple(factor * slope for slope in self._row(source, objective.figure, kappas)),
            tuple(slopes),
        )

    def own_view(self, made: Candidate, beside: Candidate | None = None) -> View | None:
        """The view with the design's own kappas, so that values are the maxima's; None without all derivatives."""
        try:
            return self.view(made, self.kappas(made), beside)
        except NoSlopesError:
            return None

    def known(self, made: Candidate) -> bool:
        """Whether the design has all figures and derivatives."""
        return self.own_view(made) is not None

    def _row(self, made: Candidate, subject: str, kappas: Mapping[str, float]) -> tuple[float, ...]:
        """(n,) d subject / d x, x scaled to the box."""
        spans = [high - low for low, high in zip(self.box.lower, self.box.upper, strict=True)]
        if subject in made.values or subject in self.base.values:
            return self._key_row(made, subject, spans)
        row = (made.evaluation.gradient or {}).get(subject, {})
        slopes = [row.get(key, math.nan) for key in self.box.keys]
        missing = [key for key, slope in zip(self.box.keys, slopes, strict=True) if not math.isfinite(slope)]
        if missing:
            raise NoSlopesError(subject, missing)
        kappa = kappas.get(subject, 1.0) if subject in (made.evaluation.norms or {}) else 1.0
        return tuple(kappa * slope * span for slope, span in zip(slopes, spans, strict=True))

    def _key_row(self, made: Candidate, subject: str, spans: Iterable[float]) -> tuple[float, ...]:
        """Derivatives of a key that follows from the variables, by central differences of `Spec.values`."""
        return tuple(
            self._key_slope(made, subject, key, KEY_STEP * span) * span
            for key, span in zip(self.box.keys, spans, strict=True)
        )

    def _key_slope(self, made: Candidate, subject: str, key: str, step: float) -> float:
        if step == 0.0:
            return 0.0
        ends = []
        for shift in (-step, step, 0.0):  # one-sided where a design beside this one cannot be described
            try:
                moved = self.base.with_values({**made.values, key: made.values[key] + shift})
                ends.append((shift, moved.number(subject)))
            except FluxboreError:
                continue
        if len(ends) < 2:
            raise NoSlopesError(subject)
        (one, low), (other, high) = ends[:2]
        return (high - low) / (other - one)


def _smooth(evaluation: Evaluation, figure: str, kappas: Mapping[str, float]) -> float | None:
    """kappa x norm of a figure that has both, else None."""
    norm = (evaluation.norms or {}).get(figure)
    return None if norm is None or figure not in kappas else kappas[figure] * norm.value
