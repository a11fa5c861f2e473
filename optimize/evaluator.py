"""The one way to an evaluation: the journal first, then a worker, then into the journal."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from fluxbore.design.errors import FluxboreError
from fluxbore.design.keys import Value
from fluxbore.design.spec import Spec
from fluxbore.optimize.design_key import design_key
from fluxbore.optimize.evaluation import (
    FAILED,
    INVALID,
    Evaluation,
    Fidelity,
    failure,
)
from fluxbore.optimize.executor import Executor
from fluxbore.optimize.journal import Journal, settled


class Evaluate(Protocol):
    """A model: the figures of one design by one route. A worker finds it by its name, so it stands in a module."""

    def __call__(self, spec: Spec, fidelity: Fidelity = "fem", gradient: Sequence[str] = ()) -> Evaluation: ...


@dataclass(frozen=True, slots=True)
class Evaluated:
    """The design number ``index`` of those asked for; ``reused`` where nothing had to be computed."""

    index: int
    evaluation: Evaluation
    reused: bool


@dataclass(frozen=True, slots=True)
class Evaluator:
    """What designs of one study are evaluated with.

    base : the start design; designs differ from it by a few values.
    kind : what asks, for the journal's reader: "sweep" or "search".
    gradient : dotted keys by which every evaluation brings its derivatives.
    """

    base: Spec
    executor: Executor
    journal: Journal | None
    fidelity: Fidelity
    evaluate: Evaluate
    kind: str
    gradient: tuple[str, ...] = ()

    def design(self, values: Mapping[str, Value]) -> Spec:
        """The design with these values. Raises SpecError or DesignError where there is no such design."""
        spec = self.base.with_values(values)
        if spec.kind.check is not None:
            spec.kind.check(spec.values)
        spec.actuator  # noqa: B018  built here, so that what cannot be built never goes to a worker
        return spec

    def each(self, designs: Sequence[Mapping[str, Value]]) -> Iterator[Evaluated]:
        """Evaluate the designs, given by their values: first what needs no computing, then the rest as it comes.

        A design that cannot be built is `INVALID`, one whose process crashes is `FAILED`, each with its reason. Equal
        designs are computed once.
        """
        waiting: dict[str, list[int]] = {}
        for index, values in enumerate(designs):
            key, known = self._look_up(values)
            if known is not None:
                yield Evaluated(index, known, key is not None)
            elif key is not None:
                waiting.setdefault(key, []).append(index)
        keys = list(waiting)
        # The designs are built a second time, one by one as workers ask for them: a grid of a million fits in memory.
        tasks = ((self.design(designs[waiting[key][0]]), self.fidelity, self.evaluate, self.gradient) for key in keys)
        for outcome in self.executor.run(_evaluate, tasks):
            indices = waiting[keys[outcome.index]]
            evaluation = outcome.value or failure(self.fidelity, FAILED, outcome.failure or "The evaluation failed.")
            if self.journal is not None:
                values = designs[indices[0]]
                evaluation = self.journal.put(
                    keys[outcome.index], self.kind, values, evaluation, self._plain_key(values)
                )
            else:
                evaluation = settled(evaluation)
            for index in indices:
                yield Evaluated(index, evaluation, index != indices[0])

    def all(self, designs: Sequence[Mapping[str, Value]]) -> list[Evaluated]:
        """As `each`, in the order of the designs."""
        return sorted(self.each(designs), key=lambda item: item.index)

    def known(self, values: Mapping[str, Value]) -> Evaluation | None:
        """What can be said of the design without computing it: its record, or why it cannot be built."""
        return self._look_up(values)[1]

    def _look_up(self, values: Mapping[str, Value]) -> tuple[str | None, Evaluation | None]:
        """The design's key, None where it cannot be built, and what is `known` of it."""
        try:
            spec = self.design(values)
        except Exception as error:
            return None, _unbuilt(self.fidelity, error)
        key = design_key(spec, self.fidelity, self.evaluate, self.gradient)
        return key, self.journal.get(key) if self.journal is not None else None

    def _plain_key(self, values: Mapping[str, Value]) -> str | None:
        """The design's key without derivatives, so that its record also serves whoever asks for none."""
        return design_key(self.design(values), self.fidelity, self.evaluate) if self.gradient else None


def _evaluate(task: tuple[Spec, Fidelity, Any, tuple[str, ...]]) -> Evaluation:
    """Runs in the worker."""
    spec, fidelity, evaluate, gradient = task
    model: Callable[..., Evaluation] = evaluate
    try:
        return model(spec, fidelity, gradient) if gradient else model(spec, fidelity)
    except FluxboreError as error:
        return failure(fidelity, INVALID, str(error))


def _unbuilt(fidelity: Fidelity, error: Exception) -> Evaluation:
    if isinstance(error, FluxboreError):
        return failure(fidelity, INVALID, str(error))
    return failure(fidelity, FAILED, f"The design cannot be built: {type(error).__name__}: {error}.")
