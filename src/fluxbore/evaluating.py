"""The Python interface to one design's figures; it loads nothing that only studies need."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from fluxbore.design.errors import SpecError
from fluxbore.design.gradient_keys import gradient_keys
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluate import evaluate as evaluate_design
from fluxbore.optimize.evaluation import Evaluation, Fidelity
from fluxbore.reading import as_spec


def evaluate(
    spec: Spec | Path | str, fidelity: Fidelity = "fem", *, gradient: bool | Sequence[str] = False
) -> Evaluation:
    """The figures of the specification's own design, by "fem" or by "network".

    gradient : whether their derivatives are wanted too, by the study's continuous variables; or by which dotted keys.
    They stand in ``.gradient``, figure -> key -> derivative in SI.

    Look at ``.ok`` first: a design that does not converge comes back without figures and with its reasons. Raises
    SpecError where there is nothing to take derivatives by, or no model that has them.
    """
    spec = as_spec(spec)
    if gradient is False:
        return evaluate_design(spec, fidelity)
    keys = gradient_keys(spec, None if gradient is True else gradient)
    # As the study sees it: what the keys move is given, and what follows from them moves along.
    found = evaluate_design(spec.for_study().pinned(keys), fidelity, keys)
    if found.ok and found.gradient is None:
        route = "finite elements" if fidelity == "fem" else "the network"
        raise SpecError(f"gradient must be left out: an actuator of kind {spec.kind.name} has none by {route}.")
    return found
