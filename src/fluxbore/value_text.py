"""Keys' and figures' values in words."""

from __future__ import annotations

from fluxbore.design.keys import Value
from fluxbore.design.performance import FIGURES, show_figure
from fluxbore.design.spec import KINDS, Spec


def show_key(spec: Spec, name: str, value: Value) -> str:
    """A key's value in its preferred unit."""
    key = spec.kind.key(name)
    return key.show(value) if key is not None else str(value)


def show_subject(subject: str, value: float) -> str:
    """A figure or a key's value in its preferred unit; not rounded so far that a limit and its miss look alike."""
    if subject in FIGURES:
        return show_figure(subject, value, 6)
    key = next((key for kind in KINDS.values() if (key := kind.key(subject)) is not None), None)
    return key.show(value) if key is not None else f"{value:.6g}"
