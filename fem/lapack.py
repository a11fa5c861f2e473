"""LAPACK's routines for bands, as scipy brings them.

scipy.linalg takes a quarter of a second to load, of which the routines themselves are a hundredth; a process that
computes a design in that time loads their module alone. Where it cannot be found or loaded so, scipy.linalg is.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from importlib import import_module
from importlib.machinery import EXTENSION_SUFFIXES, ExtensionFileLoader
from importlib.util import find_spec, module_from_spec, spec_from_loader
from pathlib import Path
from types import ModuleType
from typing import Any

NAME = "_flapack"


def routine(name: str, precision: Any) -> Callable[..., Any]:
    """Such as "pbtrf", for numpy's single or double precision."""
    letter = {"float32": "s", "float64": "d"}[str(precision)]
    found: Callable[..., Any] = getattr(_module(), letter + name)
    return found


@cache
def _module() -> ModuleType:
    try:
        return alone()
    except (ImportError, OSError):
        return import_module("scipy.linalg.lapack")


def alone() -> ModuleType:
    """scipy's module of LAPACK without scipy.linalg around it; raises ImportError where that does not work."""
    package = find_spec("scipy")  # looked for, not run
    for place in (package.submodule_search_locations or ()) if package is not None else ():
        for suffix in EXTENSION_SUFFIXES:
            path = Path(place) / "linalg" / f"{NAME}{suffix}"
            if path.exists():
                loader = ExtensionFileLoader(NAME, str(path))
                spec = spec_from_loader(NAME, loader)
                if spec is None:
                    break
                module = module_from_spec(spec)
                loader.exec_module(module)
                return module
    raise ImportError(f"scipy has no linalg/{NAME}")
