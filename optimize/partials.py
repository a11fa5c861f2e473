"""Derivatives of what is known in closed form, by differences: from a specification's keys to dimensions and figures.

No field is solved for them. Dimensions are linear in the keys and figures smooth, so a central difference of a
hundred-thousandth is right to ten digits.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from fluxbore.design.errors import FluxboreError
from fluxbore.design.performance import FIGURES, Performance
from fluxbore.design.spec import Spec

STEP = 1e-5
"""Of a value; of 1 SI unit where it is zero."""

BEND = 3e-4
"""Second over first difference: a central one is then wrong by less than a ten millionth."""

ROUNDING = 1e-12
"""Of a figure: a smaller second difference is its last digits'."""

REFINEMENTS = 3


def moved(spec: Spec, key: str, value: float) -> Spec:
    """The specification with another value at a key that it is given by. The key's own limits do not apply: a
    derivative at a limit looks beyond it."""
    return replace(spec, given={**spec.given, key: value})


def differentiable(spec: Spec, keys: Sequence[str]) -> list[str]:
    """Those of the keys that hold a continuous quantity of the design, given or by default.

    Of alternatives, such as a ring's width and a magnet's thickness, the given ones.
    """
    kinds = {key.name: key for key in spec.kind.keys}
    following = {name for group in spec.kind.alternatives for name in group.keys}
    return [
        name
        for name in keys
        if name in kinds
        and kinds[name].kind in ("quantity", "number")
        and kinds[name].of_design
        and (name in spec.given or (name in spec.values and name not in following))
    ]


def held(spec: Spec, keys: Sequence[str]) -> Spec:
    """The same design, given by these keys too, so that each stays while another moves: by default an insulated wire
    follows the bare one."""
    return replace(spec, given={**{key: spec.values[key] for key in keys}, **spec.given})


def slope(spec: Spec, key: str, at: Callable[[Spec, float], Any], here: Any | None = None) -> Any | None:
    """d at / d key (SI) of a function of a specification and of how far its key was moved; arrays or numbers.

    here : the function of the specification itself, where that is known.

    One-sided where the design cannot be built on one side of its value; None where it cannot on either.
    """
    value = spec.number(key)
    length = abs(value) or 1.0

    def found(step: float) -> Any | None:
        # The step that was taken, not the one that was meant: the sum is rounded.
        there = value + step
        return _tried(at, moved(spec, key, there), there - value)

    step = STEP * length
    after, before = found(step), found(-step)
    here = found(0.0) if here is None else here
    if after is not None and before is not None:
        rise = (after - before) / (2 * step)
        return rise if here is None else _straightened(found, rise, (before, here, after), step)
    sign = 1 if after is not None else -1
    near, far = after if after is not None else before, found(2 * sign * step)
    if here is None or near is None or far is None:
        return None
    return sign * (4 * near - far - 3 * here) / (2 * step)


def _tried(at: Callable[[Spec, float], Any], spec: Spec, step: float) -> Any | None:
    """None where there is no such design."""
    try:
        return at(spec, step)
    except (FluxboreError, ArithmeticError):
        return None


def _straightened(found: Callable[[float], Any | None], rise: Any, three: tuple[Any, Any, Any], step: float) -> Any:
    """A central difference, of a shorter step where the function bends over the first: a speed that goes as one over a
    force of next to nothing."""
    import numpy as np

    before, here, after = three
    bent = np.abs(after + before - 2 * here) > BEND * np.abs(after - before) + ROUNDING * np.abs(here)
    for _ in range(REFINEMENTS):
        if not np.any(bent):
            break
        step /= 10
        after, before = found(step), found(-step)
        if after is None or before is None:
            break
        rise = np.where(bent, (after - before) / (2 * step), rise)
        bent &= np.abs(after + before - 2 * here) > BEND * np.abs(after - before) + ROUNDING * np.abs(here)
    return rise


def closed_gradient(
    spec: Spec,
    keys: Sequence[str],
    complete: Callable[[Spec, float, str], Performance],
    without: Sequence[str] = (),
) -> dict[str, dict[str, float]]:
    """Figure -> key -> derivative (SI) of the figures that a design has.

    complete : the figures of a moved specification, how far it was moved, and along which key. without : figures that
    have no derivative.
    """
    import numpy as np

    base = spec.pinned(keys)
    wanted = differentiable(base, keys)
    base = held(base, wanted)
    names = [name for name in FIGURES if name not in without]
    gradient: dict[str, dict[str, float]] = {name: {} for name in names}
    here = None
    for key in wanted:

        def figures(changed: Spec, step: float, key: str = key) -> Any:
            performance = complete(changed, step, key)
            values = [getattr(performance, name) for name in names]
            return np.array([np.nan if value is None else value for value in values])

        if here is None:
            here = _tried(figures, base, 0.0)
        found = slope(base, key, figures, here)
        if found is None:
            continue
        for name, value in zip(names, found, strict=True):
            if np.isfinite(value):
                gradient[name][key] = float(value)
    return {name: slopes for name, slopes in gradient.items() if len(slopes) == len(wanted) and slopes}
