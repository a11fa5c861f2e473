"""Evaluates one design by the analytic network or by finite elements: the table of models."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from fluxbore.design.errors import DesignError, MaterialError, SpecError
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import FAILED, INVALID, Evaluation, Fidelity, failure


@dataclass(frozen=True, slots=True)
class Model:
    """How one kind of actuator is evaluated, route by route; both may raise DesignError or MaterialError.

    gradients : whether evaluations by FEM can bring derivatives along, by the dotted keys that are asked for.
    never : (specification, figure) -> why no design of its study has the figure, None where one may.
    """

    network: Callable[[Spec, Sequence[str]], Evaluation]
    fem: Callable[[Spec, Sequence[str]], Evaluation]
    gradients: bool = False
    never: Callable[[Spec, str], str | None] = lambda spec, figure: None


def _of(module: str, name: str) -> Callable[..., Any]:
    """A function of a module of this room, which is loaded when it is called: a process needs one kind's alone."""

    def call(*arguments: Any) -> Any:
        return getattr(import_module(f"fluxbore.optimize.{module}"), name)(*arguments)

    return call


def _model(room: str, *, gradients: bool = False) -> Model:
    """By the names that a kind's modules share."""
    figures = f"{room}_figures"
    return Model(_of(figures, "by_network"), _of(figures, "by_fem"), gradients, _of(f"{room}_gaps", "never"))


MODELS: dict[str, Model] = {
    "coils": Model(_of("coils_figures", "by_network"), _of("coils_figures", "by_fem"), gradients=True),
    "hybrid": _model("hybrid", gradients=True),
    "hydrostatic": _model("hydrostatic"),
    "lead-screw": _model("lead_screw", gradients=True),
}
"""The model of every kind of actuator, by the kind's name."""


def evaluate(spec: Spec, fidelity: Fidelity = "fem", gradient: Sequence[str] = ()) -> Evaluation:
    """The design's figures by one route.

    gradient : dotted keys by which derivatives are wanted; a model that has none leaves `Evaluation.gradient` None.

    A design that cannot be built, or whose field does not converge, comes back with its status and reason.
    """
    model = MODELS[spec.kind.name]
    try:
        if spec.kind.check is not None:
            spec.kind.check(spec.values)
        if fidelity == "network":
            return model.network(spec, gradient)
        from fluxbore.fem.threads import one_thread

        with one_thread():
            return model.fem(spec, gradient)
    except (SpecError, DesignError, MaterialError) as error:
        return failure(fidelity, INVALID, str(error))
    except (ArithmeticError, MemoryError) as error:
        # What no check foresaw: a result of this design, not of the program.
        return failure(
            fidelity, FAILED, f"The evaluation stopped with {type(error).__name__}: {error or 'no reason given'}."
        )
