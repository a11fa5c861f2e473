"""STEP files of an assembly where a test wants them, and read back with the CAD kernel."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

from fluxbore.design.materials import standard
from fluxbore.geometry import own_files, step
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.parts_list import parts_list
from fluxbore.geometry.solid import is_closed, kernel_volume

MM = 1e-3


class Piece(NamedTuple):
    """One leaf of a file's tree: group, name and colour, and its body where it stands (mm)."""

    group: str
    name: str
    colour: tuple[float, ...]
    body: Any


def write_step(assembly: Assembly, folder: Path, schema: str = "AP242") -> list[Path]:
    """The whole at its one place, then a file for each item of the parts list."""
    materials = standard()
    texts = step.step_texts({"mid-stroke": assembly}, parts_list(assembly, materials), materials, schema)
    return own_files.put(folder, {"step": texts}, assembly.name)


def read_tree(path: Path) -> tuple[str, list[Piece]]:
    """Name of the whole, and its pieces in the file's order."""
    import cadquery

    root = cadquery.Assembly.importStep(str(path))
    pieces = [
        Piece(group.name, child.name, child.color.toTuple()[:3], child.obj.moved(child.loc))
        for group in root.children
        for child in group.children
    ]
    return root.name, pieces


def assert_sound(body: Any, volume: float, within: float) -> None:
    """One valid closed solid of this volume (m^3)."""
    assert len(body.Solids()) == 1
    assert body.isValid()
    assert is_closed(body)
    assert abs(kernel_volume(body) / volume - 1) <= within
