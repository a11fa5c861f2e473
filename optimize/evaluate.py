"""Evaluates one design by the analytic network or by finite elements: the table of models."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from fluxbore.design.errors import DesignError, MaterialError, SpecError
from fluxbore.design.spec import Spec
from fluxbore.optimize import hybrid_figures
from fluxbore.optimize.evaluation import FAILED, INVALID, Evaluation, Fidelity, failure


@dataclass(frozen=True, slots=True)
class Model:
    """How one kind of actuator is evaluated, route by route; both may raise DesignError or MaterialError."""

    network: Callable[[Spec], Evaluation]
    fem: Callable[[Spec], Evaluation]


MODELS: dict[str, Model] = {
    "hybrid": Model(hybrid_figures.by_network, hybrid_figures.by_fem),
}
"""The model of every kind of actuator, by the kind's name."""


def evaluate(spec: Spec, fidelity: Fidelity = "fem") -> Evaluation:
    """The design's figures by one route.

    A design that cannot be built, or whose field does not converge, comes back with its status and reason.
    """
    model = MODELS[spec.kind.name]
    try:
        if spec.kind.check is not None:
            spec.kind.check(spec.values)
        if fidelity == "network":
            return model.network(spec)
        from fluxbore.fem.threads import one_thread

        with one_thread():
            return model.fem(spec)
    except (SpecError, DesignError, MaterialError) as error:
        return failure(fidelity, INVALID, str(error))
    except (ArithmeticError, MemoryError) as error:
        # What no check foresaw: a result of this design, not of the program.
        return failure(
            fidelity, FAILED, f"The evaluation stopped with {type(error).__name__}: {error or 'no reason given'}."
        )
