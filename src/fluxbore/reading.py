"""Specifications as the Python interface takes them: read, or the path of a file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from fluxbore.design import spec as spec_module
from fluxbore.design.errors import SpecError
from fluxbore.design.spec import Spec


def load(path: Path | str, overrides: Mapping[str, str] | None = None) -> Spec:
    """Read a specification file; ``overrides`` are dotted keys with texts, as ``--set`` takes them."""
    return spec_module.load(path, overrides)


def as_spec(spec: Spec | Path | str) -> Spec:
    """The specification itself, or that of the file."""
    return spec if isinstance(spec, Spec) else load(spec)


def need(present: object, key: str, what: str) -> None:
    """Raise SpecError where a study lacks what is asked of it."""
    if not present:
        raise SpecError(f"{key} must be given for {what}; got none.")
