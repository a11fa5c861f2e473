"""The table of files that leave this program for a workshop, a printer, a viewer or another solver.

Every format gives its files as contents by name, so that all of them are there before the first is written. A name may
begin with ``parts/``: one file for each item of the parts list.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from fluxbore.actuators import ACTUATORS, STROKE_PLACES, actuator_of, assembly_of
from fluxbore.design.errors import SpecError
from fluxbore.design.spec import Spec
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.step_files import own_files
from fluxbore.optimize.folder import Folder, open_folder

if TYPE_CHECKING:
    from fluxbore.geometry.parts_list import Item

STEP_SCHEMAS = ("AP242", "AP214")

Contents = Mapping[str, str | bytes]
"""Name below the folder -> what the file holds."""


@dataclass(frozen=True)
class Job:
    """What is exported, each part of it made once and when a format first asks for it. schema : of STEP files."""

    spec: Spec
    schema: str = "AP242"

    @cached_property
    def assembly(self) -> Assembly:
        """In the middle of the stroke."""
        return assembly_of(self.spec)

    @cached_property
    def places(self) -> Mapping[str, Assembly]:
        """At both ends of the stroke too, by the place's name; the middle comes first."""
        return {name: assembly_of(self.spec, share) for name, share in STROKE_PLACES.items()}

    @cached_property
    def items(self) -> tuple[Item, ...]:
        from fluxbore.geometry.parts_list import parts_list

        return parts_list(self.assembly, self.spec.materials)

    @property
    def stem(self) -> str:
        """The name of files that hold the whole."""
        from fluxbore.geometry.step import file_name

        return file_name(self.assembly.name)


@dataclass(frozen=True, slots=True)
class Format:
    """One word after ``--format``. contents : its files, for a job; raises FluxboreError where a kind has none.

    summary : what it is, for --help. able : whether a kind has such files at all; "all" leaves out those that do not.
    """

    summary: str
    contents: Callable[[Job], Contents]
    able: Callable[[Spec], bool] = lambda spec: True


def _dxf(job: Job) -> Contents:
    from fluxbore.geometry.drawing import dxf_text

    return {f"{job.stem}.dxf": dxf_text(job.assembly, job.spec.materials)}


def _bom(job: Job) -> Contents:
    from fluxbore.geometry.bill_of_materials import bill_of_materials

    return {f"{job.stem}-parts.csv": bill_of_materials(job.assembly, job.items)}


def _fem(job: Job) -> Contents:
    from fluxbore.fem.femm_writer import write_text

    make = actuator_of(job.spec).femm_model
    if make is None:
        able = " or ".join(f'"{kind}"' for kind, verbs in ACTUATORS.items() if verbs.femm_model is not None)
        raise SpecError(f'actuator.kind must be {able} for a FEMM model; got "{job.spec.kind.name}".')
    return {f"{job.stem}.fem": write_text(make(job.spec))}


FORMATS: dict[str, Format] = {
    "bom": Format("bill of materials as CSV", _bom),
    "dxf": Format("section as DXF", _dxf),
    "fem": Format("FEMM model of the field", _fem, lambda spec: actuator_of(spec).femm_model is not None),
}
"""Every format by its word but STEP, whose files take one another's place as a whole (`fluxbore.geometry.step`)."""

STEP = "step"
WORDS = (STEP, *FORMATS, "all")


def wanted(spec: Spec, words: Sequence[str]) -> tuple[str, ...]:
    """The formats that these words ask for, each once; "all" is what the kind has. SpecError for another word."""
    for word in words:
        if word not in WORDS:
            raise SpecError(f'A format must be one of {", ".join(WORDS)}; got "{word}".')
    every = (STEP, *(word for word, form in FORMATS.items() if form.able(spec)))
    return tuple(dict.fromkeys(found for word in words for found in (every if word == "all" else (word,))))


def export_files(
    spec: Spec, folder: Path | str, formats: Sequence[str], *, schema: str = STEP_SCHEMAS[0], force: bool = False
) -> list[Path]:
    """Write the files of these formats into the folder, which is opened when all contents are there.

    Raises what `wanted`, a format or `open_folder` raises; then nothing is written.
    """
    from fluxbore.geometry.solid import load_cadquery

    words, job = wanted(spec, formats), Job(spec, schema)
    if STEP in words:
        load_cadquery()  # before the folder is touched: without it there is nothing to write
    made = {name: text for word in words if word != STEP for name, text in FORMATS[word].contents(job).items()}
    with open_folder(folder, spec, force) as place:
        files = _write_step(job, place.path) if STEP in words else []
        return files + [place.write(name, content) for name, content in made.items()]


def write_cad(spec: Spec, folder: Folder, below: str) -> list[Path]:
    """What a whole run leaves: STEP files, and the drawing where the parts say how they are dimensioned."""
    job = Job(spec)
    files = _write_step(job, folder.path / below)
    if not job.assembly.measures:
        return files
    made = _dxf(job)
    for path in own_files(folder.path / below, ".dxf"):
        if path.name not in made:
            path.unlink()
    return files + [folder.write(f"{below}/{name}", content) for name, content in made.items()]


def _write_step(job: Job, folder: Path) -> list[Path]:
    from fluxbore.geometry.step import write_step

    return write_step(job.assembly, folder)
