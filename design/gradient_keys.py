"""By which keys derivatives are taken."""

from __future__ import annotations

from collections.abc import Sequence

from fluxbore.design.errors import SpecError, shown
from fluxbore.design.specification import Spec


def gradient_keys(spec: Spec, asked: Sequence[str] | None = None) -> tuple[str, ...]:
    """The dotted keys that are asked for, each once; without them the study's continuous variables.

    Raises SpecError where there is none, or where one is no continuous quantity of the specification.
    """
    if asked is None:
        counts = [variable.key for variable in spec.study.variables if variable.integer]
        asked = [variable.key for variable in spec.study.variables if not variable.integer]
        if not asked:
            got = f"counts alone, {', '.join(counts)}" if counts else "none"
            raise SpecError(f"study.variables must hold a continuous quantity to take derivatives by; got {got}.")
    if isinstance(asked, str) or not asked:
        raise SpecError(f'gradient must list dotted keys, ["actuator.mover.ring_width"]; got {shown(asked)}.')
    for name in asked:
        key = spec.kind.known(name)
        if key.kind not in ("quantity", "number") or not key.of_design or name not in spec.values:
            raise SpecError(f"gradient must name continuous quantities that have a value; got {name}.")
    return tuple(dict.fromkeys(asked))
