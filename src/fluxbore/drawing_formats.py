"""Export formats of drawings: DXF, SVG and PDF of the same sheets, and the winding chart."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from fluxbore.geometry.drawing_set import drawing_set, numbered_names
from fluxbore.geometry.file_names import PARTS

if TYPE_CHECKING:
    from fluxbore.exporting import Contents, Job
    from fluxbore.geometry.sheet import Sheet


def dxf_files(job: Job) -> Contents:
    """The assembly's sheets and, below parts, every part that is made."""
    from fluxbore.geometry.sheet_dxf import dxf_text

    return _each(job, dxf_text, "dxf")


def svg_files(job: Job) -> Contents:
    """The same."""
    from fluxbore.geometry.sheet_svg import svg_text

    return _each(job, svg_text, "svg")


def pdf_files(job: Job) -> Contents:
    """All sheets in one file."""
    from fluxbore.geometry.sheet_pdf import pdf_bytes

    whole, parts = drawing_set(job.assembly, job.items)
    return {f"{job.stem}.pdf": pdf_bytes((*whole, *parts))}


def _each(job: Job, text: Callable[[Sheet], str], ending: str) -> Contents:
    whole, parts = drawing_set(job.assembly, job.items)
    names = [*numbered_names(whole, job.stem), *(f"{PARTS}/{sheet.name}" for sheet in parts)]
    return {f"{name}.{ending}": text(sheet) for name, sheet in zip(names, (*whole, *parts), strict=True)}
