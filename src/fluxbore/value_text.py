"""Keys' and figures' values in words."""

from __future__ import annotations

from collections.abc import Iterable

from fluxbore.design.keys import Key, Value
from fluxbore.design.performance import FIGURES, show_figure
from fluxbore.design.rates import measure_of_key
from fluxbore.design.spec import KINDS, Spec
from fluxbore.design.study import Tolerance
from fluxbore.optimize.noise import clear_value
from fluxbore.reports.kind_words import WORDS


def route(spec: Spec, fidelity: str) -> str:
    """What computed the figures, in words."""
    words = WORDS[spec.kind.name]
    return (words.network or "the magnetic network") if fidelity == "network" else words.route


def show_key(spec: Spec, name: str, value: Value) -> str:
    """A key's value in its preferred unit."""
    key = spec.kind.key(name)
    return key.show(value) if key is not None else str(value)


def show_subject(subject: str, value: float, digits: int = 6) -> str:
    """A figure or a key's value in its preferred unit; not rounded so far that a limit and its miss look alike."""
    if subject in FIGURES:
        return show_figure(subject, value, digits)
    key = next((key for kind in KINDS.values() if (key := kind.key(subject)) is not None), None)
    return key.show(value, digits) if key is not None else f"{value:.{digits}g}"


def show_variable(spec: Spec, name: str, value: float) -> str:
    """A variable's value in its preferred unit; rounding's noise about zero is zero."""
    return show_key(spec, name, clear_value(spec, name, value))


def short_names(keys: Iterable[str]) -> dict[str, str]:
    """Key -> as many of its last words as tell it from the other keys: ``back_yoke.outer_diameter``."""
    words = {key: key.split(".") for key in keys}
    found = {}
    for key, own in words.items():
        endings = (own[-count:] for count in range(1, len(own)))
        alone = (end for end in endings if sum(other[-len(end) :] == end for other in words.values()) == 1)
        found[key] = ".".join(next(alone, own))
    return found


def tolerance_size(tolerance: Tolerance, key: Key) -> str:
    """What a tolerance allows: ``± 0.05 mm``, or ``+0.05 mm / -0.02 mm``."""
    step = measure_of_key(key)
    if tolerance.plus == -tolerance.minus:
        return f"\N{PLUS-MINUS SIGN} {step.show(tolerance.plus)}"
    return f"+{step.show(tolerance.plus)} / -{step.show(abs(tolerance.minus))}"
