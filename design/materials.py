"""Materials: what a part is made of, from the standard library in ``data`` or a specification's own section.

Every datum of the library names its source. One reader serves both: the library's files hold the same tables as a
specification's ``[materials.NAME]`` sections.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import TypeVar

from fluxbore.design.bh_curve import BHCurve
from fluxbore.design.errors import MaterialError
from fluxbore.design.material_kinds import (
    ROOM_TEMPERATURE,
    Conductor,
    Material,
    PermanentMagnet,
    SoftIron,
    Structural,
    describe,
)
from fluxbore.design.material_table import from_table, schema

__all__ = [
    "ROOM_TEMPERATURE",
    "BHCurve",
    "Conductor",
    "Library",
    "Material",
    "PermanentMagnet",
    "SoftIron",
    "Structural",
    "from_table",
    "lookup",
    "schema",
    "standard",
]

Library = Mapping[str, Material]
"""Name -> material."""

_M = TypeVar("_M", bound=Material)


@cache
def standard() -> Library:
    """The materials that come with fluxbore; read once, about 5 ms."""
    library: dict[str, Material] = {}
    for path in sorted((Path(__file__).parent / "data").glob("*.toml")):
        for name, raw in tomllib.loads(path.read_text(encoding="utf-8")).items():
            library[name] = from_table(name, raw, f"{path.name}.{name}")
    return MappingProxyType(library)


def lookup(name: str, key: str, library: Library, kind: type[_M]) -> _M:
    """The material of this name and kind; ``Material`` as kind takes any.

    key : the specification's key that names it, for the sentence.
    Raises MaterialError, which lists the names that would do, where the name is unknown or of another kind.
    """
    material = library.get(name)
    if isinstance(material, kind):
        return material
    known = ", ".join(sorted(other for other, candidate in library.items() if isinstance(candidate, kind)))
    if material is None:
        hint = " (or a section [materials.NAME] of your own)"
        raise MaterialError(f'{key} must name a {describe(kind)}, one of {known}{hint}; got "{name}".')
    raise MaterialError(
        f'{key} must name a {describe(kind)}, one of {known}; got "{name}", a {describe(type(material))}.'
    )
