"""What files say that they were written by."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version


def program() -> str:
    """The program's name with its version."""
    try:
        return f"fluxbore {version('fluxbore')}"
    except PackageNotFoundError:  # run from a bare checkout
        return "fluxbore"
