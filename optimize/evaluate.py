"""Evaluates one design by the analytic network or by finite elements: the table of models."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from fluxbore.design.errors import DesignError, MaterialError, SpecError
from fluxbore.design.spec import Spec
from fluxbore.optimize import (
    coils_figures,
    hybrid_figures,
    hybrid_gaps,
    hydrostatic_figures,
    hydrostatic_gaps,
    lead_screw_figures,
    lead_screw_gaps,
)
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


MODELS: dict[str, Model] = {
    "coils": Model(coils_figures.by_network, coils_figures.by_fem, gradients=True),
    "hybrid": Model(hybrid_figures.by_network, hybrid_figures.by_fem, gradients=True, never=hybrid_gaps.never),
    "hydrostatic": Model(hydrostatic_figures.by_network, hydrostatic_figures.by_fem, never=hydrostatic_gaps.never),
    "lead-screw": Model(
        lead_screw_figures.by_network, lead_screw_figures.by_fem, gradients=True, never=lead_screw_gaps.never
    ),
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
