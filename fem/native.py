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


Kernels = dict[str, Callable[..., int]]
"""The library's functions by name. Each returns zero, or something else where it failed."""


@cache
def kernels(level: str | None = None) -> Kernels | None:
    """None where the library is not compiled or does not load.

    level : a kind of processor of kernels/build.py that this one must be; this processor's without.
    """
    try:
        loaded = ctypes.CDLL(str(library()))
    except OSError:
        return None
    level = level or ("v3" if loaded.has_v3() else "base")
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
        function = getattr(loaded, f"{name}_{level}")
        function.argtypes, function.restype = types, ctypes.c_int
        found[name] = function
    return found
