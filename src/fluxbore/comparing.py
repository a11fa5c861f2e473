"""Designs side by side: reads them, evaluates each, gathers what their page shows, and writes it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from fluxbore.actuators import actuator_of, assembly_of
from fluxbore.design.errors import OutputError, SpecError
from fluxbore.design.spec import Spec
from fluxbore.design_result import DesignResult, judged
from fluxbore.optimize.evaluate import evaluate as evaluate_design
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.reading import load
from fluxbore.run_folder import design_file, told_by_results

if TYPE_CHECKING:
    from fluxbore.reports.compare_content import Array, ComparedDesign

COMPARISON_FILE = "comparison.html"

LEAST = 2

OWN_FACTS = ("specification", "mesh")
"""What is each design's own of `report_content.provenance`; the rest is the run's."""


@dataclass(frozen=True, slots=True)
class ComparisonResult:
    """designs : each as `DesignResult`, in the order in which they were named. letters : what the page calls them.

    files : what was written.
    """

    letters: tuple[str, ...]
    sources: tuple[str, ...]
    designs: tuple[DesignResult, ...]
    files: tuple[Path, ...]

    @property
    def ok(self) -> bool:
        """Whether every design has figures; a limit that one of them breaks is a result like any other."""
        return all(design.evaluation.ok for design in self.designs)

    @property
    def reasons(self) -> tuple[str, ...]:
        """Why designs have no figures, and which limits they break, each with the design's letter."""
        return tuple(
            f"{letter} ({source}): {reason}"
            for letter, source, design in zip(self.letters, self.sources, self.designs, strict=True)
            for reason in design.reasons
        )


def compare(
    sources: Sequence[Spec | Path | str],
    path: Path | str,
    *,
    same: float | None = None,
    force: bool = False,
    command: Sequence[str] | None = None,
) -> ComparisonResult:
    """Write a page that sets two to six designs side by side, the first being what the others are measured against.

    sources : specifications, paths of specification files, or folders of finished runs, whose design.toml counts.
    same : relative difference up to which two figures count as the same; None for a thousandth.
    Raises SpecError for too few or too many designs, one that is named twice, and a folder without design.toml;
    OutputError where the file exists and is not to be replaced by ``force``.
    """
    from fluxbore import report_content as gather
    from fluxbore.reports.compare_content import LETTERS, MOST, SAME, Comparison
    from fluxbore.reports.compare_page import write_comparison

    if not LEAST <= len(sources) <= MOST:
        raise SpecError(f"A comparison takes {LEAST} to {MOST} designs; got {len(sources)}.")
    same = SAME if same is None else same
    if not 0 <= same < 1:
        raise SpecError(f"same must be a share from 0 to below 1; got {same:g}.")
    path = Path(path)
    if path.exists() and not force:
        raise OutputError(f"{path} must not exist yet; it does (see --force).")
    _each_once(sources)
    specs = [_read(source) for source in sources]
    if not path.parent.is_dir():
        _make(path.parent)
    results = [judged(spec, evaluate_design(spec)) for spec in specs]
    names = tuple(_shown(source) for source in sources)
    designs = tuple(
        _compared(letter, name, source, result, same)
        for letter, name, source, result in zip(LETTERS, names, sources, results, strict=False)
    )
    facts = gather.provenance(specs[0], None, command)
    provenance = {label: text for label, text in facts.items() if label not in OWN_FACTS}
    written = write_comparison(Comparison(designs=designs, same=same, provenance=provenance), path)
    return ComparisonResult(tuple(LETTERS[: len(designs)]), names, tuple(results), (written,))


def _each_once(sources: Sequence[Spec | Path | str]) -> None:
    """Raise SpecError where two sources are the same file, or where a folder has no design."""
    seen: dict[Path, Spec | Path | str] = {}
    for source in sources:
        if isinstance(source, Spec):
            continue
        file = design_file(Path(source)).resolve()
        if file in seen:
            raise SpecError(f"Each design must be named once; {_shown(seen[file])} and {_shown(source)} are one file.")
        seen[file] = source


def _read(source: Spec | Path | str) -> Spec:
    """The specification, refused where its parts do not fit one another."""
    spec = source if isinstance(source, Spec) else load(design_file(Path(source)))
    assembly_of(spec)
    return spec


def _shown(source: Spec | Path | str) -> str:
    return "given as data" if isinstance(source, Spec) else str(source)


def _make(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{folder} cannot be written: {error.strerror or error}.") from error


def _compared(letter: str, name: str, source: Spec | Path | str, result: DesignResult, same: float) -> ComparedDesign:
    from fluxbore import report_content as gather
    from fluxbore.geometry.parts_list import parts_list
    from fluxbore.reports.compare_content import ComparedDesign

    spec, found = result.spec, result.evaluation
    assembly = assembly_of(spec)
    folder = Path(source) if not isinstance(source, Spec) and Path(source).is_dir() else None
    facts = gather.provenance(spec, found)
    return ComparedDesign(
        letter=letter,
        source=name,
        spec=spec,
        evaluation=found,
        checks=result.checks,
        assembly=assembly,
        items=parts_list(assembly, spec.materials),
        curves=_curves(spec, found),
        provenance={label: facts[label] for label in OWN_FACTS if label in facts},
        run=told_by_results(folder, spec, found, same) if folder is not None else "",
        words=actuator_of(spec).words,
    )


def _curves(spec: Spec, found: Evaluation) -> Mapping[str, tuple[Array, Array]]:
    """What a design shows over a position: name of `compare_curves.CURVES` -> abscissa and ordinate (SI)."""
    if not found.ok:
        return {}
    if found.positions:
        return _over_positions(found)
    views = actuator_of(spec)
    if views.screw is not None:
        return _of_screw(spec)
    return _of_hydraulics(spec) if views.hydraulics is not None else {}


def _over_positions(found: Evaluation) -> Mapping[str, tuple[Array, Array]]:
    import numpy as np

    z = np.array([item.position for item in found.positions])
    return {
        name: (z, np.array([getattr(item, name) for item in found.positions]))
        for name in ("force_constant", "cogging_force")
    }


def _of_screw(spec: Spec) -> Mapping[str, tuple[Array, Array]]:
    import numpy as np

    from fluxbore.design.lead_screw_figures import engaged_fraction
    from fluxbore.fem.threads import one_thread
    from fluxbore.optimize.lead_screw_field import magnetised, solve_field

    screw = magnetised(spec)
    with one_thread():
        field = solve_field(spec, screw)
    if field.failure is not None:
        return {}
    away = np.linspace(-0.5, 1.0, 181) * screw.pitch
    reach = max(spec.actuator.stroke, screw.translator_length + screw.active_length) / 2
    places = np.linspace(-reach, reach, 121)
    peak = field.series.peak[1]
    return {
        "spring_force": (away, np.asarray(field.series.force(away))),
        "stall_force_left": (places, peak * np.asarray(engaged_fraction(screw, places))),
    }


def _of_hydraulics(spec: Spec) -> Mapping[str, tuple[Array, Array]]:
    import numpy as np

    from fluxbore.optimize.hydrostatic_common import weighed
    from fluxbore.reports.hydrostatic_curves import held

    actuator = weighed(spec)
    way = np.linspace(0.0, actuator.output_cylinder.stroke, 121)
    return {"return_force": (way, np.array([held(actuator, place) for place in way.tolist()]))}
