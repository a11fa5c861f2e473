"""The errors a user can meet: each is one sentence that names the key, the limit and the value."""

from __future__ import annotations


class FluxboreError(Exception):
    """Root of every error that fluxbore raises on purpose; its text is the sentence shown to the user."""


class SpecError(FluxboreError):
    """The specification is wrong: an unknown key, a missing unit, a value out of range, too many or too few keys."""


class DesignError(FluxboreError):
    """The specification reads well, but no such actuator can be built: parts overlap or a thickness vanishes."""


class MaterialError(FluxboreError):
    """A material is unknown or its data break a physical law (a B-H curve that is not monotone, for one)."""


class OutputError(FluxboreError):
    """Something cannot be written, or a folder holds the results of another specification."""


class MissingLibraryError(FluxboreError):
    """An optional library, or a system library beneath it, is missing; the text says how to get it."""
