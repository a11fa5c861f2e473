"""The key under which a design stands in the journal: a hash of everything that decides its figures."""

from __future__ import annotations

import dataclasses
import hashlib
import importlib.metadata
import json
import sys
from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial
from pathlib import Path
from typing import Any

from fluxbore.design.spec import Spec
from fluxbore.fem.native import level

ROOMS = ("design", "fem", "geometry", "optimize")
"""The parts of the package that figures depend on; the report and the command line do not compute."""

_CALCULATORS = ("numpy", "scipy")


def design_key(spec: Spec, fidelity: str, evaluate: Callable[..., Any], gradient: Sequence[str] = ()) -> str:
    """SHA-256 of the design's values (solver settings among them), its materials, the route and the program.

    evaluate : the function that gives the figures; its name is part of the key. gradient : the keys by which
    derivatives are wanted, and with them what is held: derivatives depend on which of the alternatives are given.
    """
    content = {
        "kind": spec.kind.name,
        "values": dict(spec.values),
        "fidelity": fidelity,
        "evaluate": _name(evaluate),
        "materials": _materials(spec),
        "program": program(),
        "kernels": level(),  # numpy's arrays, which stand in for them, agree to some nine digits
        **({"gradient": list(gradient), "given": sorted(spec.given)} if gradient else {}),
    }
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


@cache
def program() -> str:
    """SHA-256 of fluxbore's sources and data, the versions of numpy and scipy and of Python; read once a process."""
    digest = hashlib.sha256(f"python {sys.version_info.major}.{sys.version_info.minor}".encode())
    for name in _CALCULATORS:
        try:
            version = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            version = "none"
        digest.update(f"{name} {version}\n".encode())
    digest.update(source_hash().encode())
    return digest.hexdigest()


def source_hash() -> str:
    """SHA-256 over the files of the installed package's `ROOMS`, names and contents, wherever their links lead."""
    import fluxbore

    digest = hashlib.sha256()
    for folder in fluxbore.__path__:
        for room in ROOMS:
            top = (Path(folder) / room).resolve()
            files = [path for path in top.rglob("*") if path.is_file() and "__pycache__" not in path.parts]
            for path in sorted(files, key=lambda path: path.relative_to(top).as_posix()):
                if path.name.startswith(".") or path.suffix in (".pyc", ".so"):  # made of the files that count
                    continue
                content = path.read_bytes()
                digest.update(f"{room}/{path.relative_to(top).as_posix()} {len(content)}\n".encode())
                digest.update(content)
    return digest.hexdigest()


_latest: tuple[object, object, str] | None = None


def _materials(spec: Spec) -> str:
    """SHA-256 of the specification's own materials as they were read: a B-H table may stand in a file of its own.

    Every design of a study shares one mapping, so the latest answer is kept; holding the mapping keeps its identity.
    """
    global _latest
    if _latest is None or _latest[0] is not spec.materials or _latest[1] is not spec.own_materials:
        own = {name: canonical(spec.materials.get(name)) for name in sorted(spec.own_materials)}
        content = json.dumps([own, canonical(spec.own_materials)], sort_keys=True)
        _latest = (spec.materials, spec.own_materials, hashlib.sha256(content.encode()).hexdigest())
    return _latest[2]


def canonical(value: object) -> Any:
    """The value as JSON-ready data in which equal things look equal and unequal ones do not."""
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        parts = {field.name: canonical(getattr(value, field.name)) for field in dataclasses.fields(value)}
        return {"type": type(value).__qualname__, **parts}
    if isinstance(value, Mapping):
        return {str(name): canonical(item) for name, item in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, (bytes, bytearray)):
        return [canonical(item) for item in value]
    if hasattr(value, "tolist"):  # an array: its repr would leave out the middle
        return canonical(value.tolist())
    return repr(value)


def _name(function: Callable[..., Any]) -> Any:
    if isinstance(function, partial):
        return [_name(function.func), canonical(function.args), canonical(function.keywords)]
    kind = type(function)
    owner = function if hasattr(function, "__qualname__") else kind
    return f"{owner.__module__}.{owner.__qualname__}"
