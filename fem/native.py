"""The library of fem/kernels, where it is compiled: C's inner loops over the cells of a mapped mesh.

What a mesh of a few hundred cells needs is too little for numpy, whose calls then take longer than their work.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from functools import cache
from typing import Any

from fluxbore.fem.kernels.build import library

COUNT, POINTER = ctypes.c_int64, ctypes.c_void_p


class Mesh(ctypes.Structure):
    """`Mesh` of kernels.h."""

    _fields_ = [
        ("rows", COUNT),
        ("columns", COUNT),
        ("width", POINTER),
        ("height", POINTER),
        ("inverse_radius", POINTER),
        ("nu_r", POINTER),
        ("nu_z", POINTER),
        ("curve", POINTER),
        ("iron", POINTER),
        ("others", POINTER),
        ("irons", COUNT),
        ("place", POINTER),
        ("steps", POINTER),
        ("intervals", POINTER),
        ("coefficients", POINTER),
        ("most", COUNT),
        ("value", POINTER),
        ("slope", POINTER),
        ("gauss", POINTER),
        ("nodes", POINTER),
        ("is_free", POINTER),
        ("load", POINTER),
        ("rim_edges", COUNT),
        ("rim_nodes", POINTER),
        ("rim_matrices", POINTER),
        ("across", POINTER),
        ("along", POINTER),
        ("unknowns", COUNT),
        ("tiles", COUNT),
        ("number", POINTER),
        ("target", POINTER),
    ]


class Parts(ctypes.Structure):
    """`Parts` of kernels.h."""

    _fields_ = [("edge", POINTER), ("inverse", POINTER), ("coupling", POINTER)]


Functions = dict[str, Callable[..., int]]
"""The library's by name. Each returns zero, or something else where it failed."""


@cache
def _loaded() -> Any:
    """None where the library is not compiled, does not load, or is not what is described here."""
    try:
        found = ctypes.CDLL(str(library()))
        sizes = found.size_of_mesh(), found.size_of_parts()
    except (OSError, AttributeError):
        return None
    return found if sizes == (ctypes.sizeof(Mesh), ctypes.sizeof(Parts)) else None


@cache
def level() -> str | None:
    """The kind of processor, of kernels/build.py, that the library takes this one for; None without a library."""
    found = _loaded()
    if found is None:
        return None
    return "v3" if found.has_v3() else "base"


@cache
def functions(kind: str | None = None) -> Functions | None:
    """None without a library.

    kind : a kind of processor that this one must be; by `level` without.
    """
    loaded, kind = _loaded(), kind or level()
    if loaded is None:
        return None
    mesh, parts = ctypes.POINTER(Mesh), ctypes.POINTER(Parts)
    arguments: dict[str, list[Any]] = {
        "residual": [mesh, POINTER, POINTER, POINTER],
        "product": [mesh, POINTER, POINTER, POINTER],
        "condense_linear": [mesh, parts],
        "condense_iron": [mesh, POINTER, parts],
        "factorise": [mesh, POINTER, POINTER, POINTER],
        "solve": [mesh, POINTER, parts, parts, COUNT, POINTER, POINTER],
    }
    found = {}
    for name, types in arguments.items():
        function = getattr(loaded, f"{name}_{kind}")
        function.argtypes, function.restype = types, ctypes.c_int
        found[name] = function
    return found
