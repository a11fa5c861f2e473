"""The fin's study without a field, which it does not ask for: a design costs a millisecond."""

from collections.abc import Sequence

from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import Evaluation, Fidelity
from fluxbore.optimize.hybrid_seal import figures
from fluxbore.optimize.partials import closed_gradient


def seal_figures(spec: Spec) -> Performance:
    return Performance(**figures(spec, spec.actuator))


def closed(spec: Spec, fidelity: Fidelity = "fem", gradient: Sequence[str] = ()) -> Evaluation:
    """The seal's figures, with their derivatives."""

    def moved(changed: Spec, step: float, key: str) -> Performance:
        return seal_figures(changed)

    slopes = closed_gradient(spec, gradient, moved) if gradient else None
    return Evaluation(fidelity, "ok", (), seal_figures(spec), gradient=slopes)
