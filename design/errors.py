"""The errors a user can meet: each is one sentence that names the key, the limit and the value."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import islice
from typing import TypeVar

_T = TypeVar("_T")


class FluxboreError(Exception):
    """Root of every error that fluxbore raises on purpose; its text is the sentence shown to the user."""


class SpecError(FluxboreError):
    """The specification is wrong: an unknown key, a missing unit, a value out of range, too many or too few keys."""


class DesignError(FluxboreError):
    """The specification reads well, but no such actuator can be built: parts overlap or a thickness vanishes."""


class MaterialError(FluxboreError):
    """A material is unknown or its data break a physical law (a B-H curve that is not monotone, for one)."""


class MeshError(FluxboreError):
    """A drawing cannot be meshed: curves cross, a face has no label, or the mesh would be too large."""


class MeasurementError(FluxboreError):
    """A file of measurements cannot be read: a number is none, a column is missing, there are too few rows."""


class IdentificationError(FluxboreError):
    """Measurements do not tell a model's parameters; the text names which, and what would tell them."""


class OutputError(FluxboreError):
    """Something cannot be written, or a folder holds the results of another specification."""


class MissingLibraryError(FluxboreError):
    """An optional library, or a system library beneath it, is missing; the text says how to get it."""


LONGEST_SHOWN = 60
"""Characters of a wrong value that a sentence quotes."""


def shown(raw: object, depth: int = 2) -> str:
    """What a file holds, as it would stand in TOML: on one line, and cut where it is long or deeply nested."""
    if isinstance(raw, str):
        return f'"{one_line(_cut(raw))}"'
    if isinstance(raw, bool):
        return "true" if raw else "false"
    if raw is None:
        return "none"
    if isinstance(raw, Mapping):
        items = [f"{key} = {shown(value, depth - 1)}" for key, value in _few(raw.items())] if depth else ["..."]
        return _cut(one_line("{ " + ", ".join(items) + " }")) if raw else "an empty table"
    if isinstance(raw, (list, tuple)):
        items = [shown(value, depth - 1) for value in _few(raw)] if depth else ["..."]
        return _cut(one_line("[" + ", ".join(items) + "]"))
    return _cut(str(raw))


def one_line(text: str) -> str:
    """The text with whatever is no printable character written as an escape, so that it stays one harmless line."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def _cut(text: str) -> str:
    return text if len(text) <= LONGEST_SHOWN else text[: LONGEST_SHOWN - 3] + "..."


def _few(items: Iterable[_T]) -> Iterator[_T]:
    return islice(items, LONGEST_SHOWN)
