"""Export formats of drawings: DXF, SVG and PDF of the same sheets, and the winding chart."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from fluxbore.design.errors import SpecError
from fluxbore.geometry.drawing_set import drawing_set, numbered_names
from fluxbore.geometry.file_names import PARTS
from fluxbore.winding_views import CHARTS, winding_chart

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


def winding_files(job: Job) -> Contents:
    """The winding chart as CSV and as sheets. Raises SpecError where the kind has no winding."""
    from fluxbore.geometry.sheet_pdf import pdf_bytes
    from fluxbore.geometry.sheet_svg import svg_text
    from fluxbore.geometry.winding_sheet import chart_csv, winding_sheets

    chart = winding_chart(job.spec)
    if chart is None:
        able = " or ".join(f'"{kind}"' for kind in CHARTS)
        raise SpecError(f'actuator.kind must be {able} for a winding chart; got "{job.spec.kind.name}".')
    sheets, name = winding_sheets(chart, job.assembly.title), f"{job.stem}-winding"
    found: dict[str, str | bytes] = {f"{name}.csv": chart_csv(chart), f"{name}.pdf": pdf_bytes(sheets)}
    for number, sheet in enumerate(sheets, 1):
        found[f"{name}.svg" if len(sheets) == 1 else f"{name}-{number}.svg"] = svg_text(sheet)
    return found
