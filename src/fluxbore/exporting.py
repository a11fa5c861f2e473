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
from fluxbore.design.errors import DesignError, SpecError
from fluxbore.design.spec import Spec
from fluxbore.design.spec_file import to_toml
from fluxbore.geometry import own_files
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.file_names import file_name
from fluxbore.geometry.standing import Standing, standings
from fluxbore.optimize.folder import Folder, open_folder
from fluxbore.winding_views import CHARTS

if TYPE_CHECKING:
    from fluxbore.fem.femm_model import FemmModel
    from fluxbore.geometry.parts_list import Item

STEP_SCHEMAS = ("AP242", "AP214")

FIELD_ACCURACY = 0.01
"""Of the field that is written, relative, by the estimated error of its energy."""

Contents = own_files.Contents
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
        return file_name(self.assembly.name)


@dataclass(frozen=True, slots=True)
class Format:
    """One word after ``--format``. contents : its files, for a job; raises FluxboreError where a kind has none.

    summary : what it is, for --help. able : whether a kind has such files at all; "all" leaves out those that do not.
    parts : whether they show parts, so that these had better not overlap.
    """

    summary: str
    contents: Callable[[Job], Contents]
    able: Callable[[Spec], bool] = lambda spec: True
    parts: bool = True


def _step(job: Job) -> Contents:
    from fluxbore.geometry.step import step_texts

    return step_texts(job.places, job.items, job.spec.materials, job.schema)


def _dxf(job: Job) -> Contents:
    from fluxbore.drawing_formats import dxf_files

    return dxf_files(job)


def _svg(job: Job) -> Contents:
    from fluxbore.drawing_formats import svg_files

    return svg_files(job)


def _pdf(job: Job) -> Contents:
    from fluxbore.drawing_formats import pdf_files

    return pdf_files(job)


def _winding(job: Job) -> Contents:
    from fluxbore.drawing_formats import winding_files

    return winding_files(job)


def _bom(job: Job) -> Contents:
    from fluxbore.geometry.bill_of_materials import bill_of_materials

    return {f"{job.stem}-parts.csv": bill_of_materials(job.assembly, job.items)}


def _field_model(job: Job) -> FemmModel:
    make = actuator_of(job.spec).femm_model
    if make is None:
        able = " or ".join(f'"{kind}"' for kind, verbs in ACTUATORS.items() if verbs.femm_model is not None)
        raise SpecError(f'actuator.kind must be {able} for a FEMM model; got "{job.spec.kind.name}".')
    return make(job.spec)


def _has_field(spec: Spec) -> bool:
    return actuator_of(spec).femm_model is not None


def _fem(job: Job) -> Contents:
    from fluxbore.fem.femm_writer import write_text

    return {f"{job.stem}.fem": write_text(_field_model(job))}


def _vtu(job: Job) -> Contents:
    """The field of the same model as the FEMM file's, which lets the two be held against each other."""
    from fluxbore.fem.femm_solution import solve_model
    from fluxbore.fem.field_file import vtu
    from fluxbore.fem.threads import one_thread

    with one_thread():
        solved = solve_model(_field_model(job), accuracy=FIELD_ACCURACY)
    convergence = solved.solution.convergence
    if not convergence.converged:
        raise DesignError(f"The field of {job.assembly.name} must converge to be written; it is {convergence.status}.")
    return {f"{job.stem}.vtu": vtu(solved)}


def _glb(job: Job) -> Contents:
    from fluxbore.model_formats import glb_files

    return glb_files(job)


def _stl(job: Job) -> Contents:
    from fluxbore.model_formats import stl_files

    return stl_files(job)


def _three_mf(job: Job) -> Contents:
    from fluxbore.model_formats import three_mf_files

    return three_mf_files(job)


FORMATS: dict[str, Format] = {
    "step": Format("STEP files of the whole at three places of its stroke, and of every part", _step),
    "bom": Format("bill of materials as CSV", _bom, parts=False),
    "dxf": Format("drawings of the whole and of every part that is made, as DXF", _dxf),
    "svg": Format("the same drawings as SVG", _svg),
    "winding": Format(
        "winding chart as CSV, SVG and PDF", _winding, lambda spec: spec.kind.name in CHARTS, parts=False
    ),
    "pdf": Format("the same drawings as one PDF", _pdf),
    "fem": Format("FEMM model of the field", _fem, _has_field, parts=False),
    "vtu": Format("the field without current as VTU, for ParaView", _vtu, _has_field, parts=False),
    "glb": Format("the whole as GLB, in metres, for viewers", _glb),
    "stl": Format("every part as binary STL, in millimetres, for printers", _stl),
    "3mf": Format("the whole as 3MF, in millimetres, for printers", _three_mf),
}
"""Every format by its word."""

WORDS = (*FORMATS, "all")

OF_A_RUN = ("step", "dxf", "pdf", "glb", "bom", "winding")
"""What `fluxbore design` leaves, as far as the table has it: what a workshop needs, and a picture to turn."""


def wanted(spec: Spec, words: Sequence[str]) -> tuple[str, ...]:
    """The formats that these words ask for, each once; "all" is what the kind has. SpecError for another word."""
    for word in words:
        if word not in WORDS:
            raise SpecError(f'A format must be one of {", ".join(WORDS)}; got "{word}".')
    every = tuple(word for word, form in FORMATS.items() if form.able(spec))
    return tuple(dict.fromkeys(found for word in words for found in (every if word == "all" else (word,))))


@dataclass(frozen=True, slots=True)
class Export:
    """Files that were written, and of formats that show parts how these stand to one another."""

    files: tuple[Path, ...]
    standings: tuple[Standing, ...] = ()

    @property
    def sound(self) -> bool:
        """Whether no parts overlap but those that are meant to."""
        return all(standing.sound for standing in self.standings)


def export_files(
    spec: Spec, folder: Path | str, formats: Sequence[str], *, schema: str = STEP_SCHEMAS[0], force: bool = False
) -> list[Path]:
    """The files of `export_checked`."""
    return list(export_checked(spec, folder, formats, schema=schema, force=force).files)


def export_checked(
    spec: Spec,
    folder: Path | str,
    formats: Sequence[str],
    *,
    schema: str = STEP_SCHEMAS[0],
    force: bool = False,
    own_text: bool = False,
) -> Export:
    """Write the files of these formats into the folder, which is opened when all contents are there.

    own_text : whether the specification itself is written too, as it is when it is not the one that was read.
    Raises what `wanted`, a format, `open_folder` or `own_files.put` raises; then nothing is written.
    """
    if schema not in STEP_SCHEMAS:
        raise SpecError(f'The schema of STEP files must be {" or ".join(STEP_SCHEMAS)}; got "{schema}".')
    words, job = wanted(spec, formats), Job(spec, schema)
    made = _made(job, words)
    if own_text:
        comment = f"{job.assembly.name} in catalogue sizes, every value exact."
        made["specification"] = {f"{job.stem}-catalogue.toml": to_toml(spec, comment)}
    shown = any(FORMATS[word].parts for word in words)
    found = standings(job.places) if shown else ()
    with open_folder(folder, spec, force) as place:
        return Export(tuple(own_files.put(place.path, made, spec.fingerprint(), force)), found)


SLOW = ("step", "vtu", "pdf", "winding", "dxf")
"""Formats that take seconds, the slowest first: two of them at once are made by processes of their own."""


def _made(job: Job, words: Sequence[str]) -> dict[str, Contents]:
    """Every format's files. What a process cannot make is made here, so that its error is raised as it is."""
    if sum(word in SLOW for word in words) < 2:
        return {word: FORMATS[word].contents(job) for word in words}
    from fluxbore.optimize.executor import local_executor

    order = sorted(words, key=lambda word: SLOW.index(word) if word in SLOW else len(SLOW))
    with local_executor() as executor:
        outcomes = executor.run(_one, [(job.spec, job.schema, word) for word in order])
        made = {order[item.index]: item.value for item in outcomes if item.failure is None}
    return {word: found if (found := made.get(word)) is not None else FORMATS[word].contents(job) for word in words}


def _one(task: tuple[Spec, str, str]) -> Contents:
    """In a process of its own."""
    spec, schema, word = task
    return dict(FORMATS[word].contents(Job(spec, schema)))


def write_cad(spec: Spec, folder: Folder, below: str) -> list[Path]:
    """What a whole run leaves below its folder: the formats `OF_A_RUN`."""
    job = Job(spec)
    made = _made(job, [word for word in OF_A_RUN if word in FORMATS and FORMATS[word].able(spec)])
    return own_files.put(folder.path / below, made, spec.fingerprint())
