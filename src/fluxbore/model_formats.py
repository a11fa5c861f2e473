"""Export formats of triangles: GLB for viewers, STL and 3MF for printers."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fluxbore.geometry.file_names import PARTS, item_stems
from fluxbore.geometry.model import PRINTED, VIEWED, shapes
from fluxbore.geometry.part_surface import surface

if TYPE_CHECKING:
    from fluxbore.exporting import Contents, Job


def glb_files(job: Job) -> Contents:
    """The whole in the middle of its stroke."""
    from fluxbore.geometry.gltf import glb

    return {f"{job.stem}.glb": glb(job.assembly, shapes(job.items, VIEWED), job.spec.materials)}


def stl_files(job: Job) -> Contents:
    """A file for each item of the parts list."""
    from fluxbore.geometry.printing import stl

    pieces = zip(item_stems(job.items), job.items, strict=True)
    return {f"{PARTS}/{stem}.stl": stl(surface(item.part, PRINTED), item.name) for stem, item in pieces}


def three_mf_files(job: Job) -> Contents:
    """The whole in the middle of its stroke, as an archive."""
    from fluxbore.geometry.printing import three_mf

    return {f"{job.stem}.3mf": three_mf(job.assembly, shapes(job.items, PRINTED))}
