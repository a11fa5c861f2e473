"""Gathers a report's content and writes the file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from fluxbore.actuators import actuator_of, assembly_of
from fluxbore.design.spec import Spec
from fluxbore.design_result import DesignResult
from fluxbore.optimize.evaluate import evaluate as evaluate_design
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.outcome import Candidate
from fluxbore.winding_views import winding_chart

REPORT_FILE = "report.html"

AS_DRAWN = "Tolerances of manufacture: every dimension is taken as drawn; the study has no production."


def write_report_file(
    spec: Spec,
    findings: DesignResult,
    path: Path,
    separate: Candidate | None,
    picture: bool,
    command: Sequence[str] | None,
    seconds: float | None,
) -> Path:
    from fluxbore import report_content as gather
    from fluxbore.reports.content import Picture, ReportContent
    from fluxbore.reports.page import write_report

    final, found = findings.spec, design_evaluation(spec, findings)
    studied = findings.search is not None and findings.search.chosen is not None
    views = actuator_of(final)
    parts = assembly_of(final)
    start = findings.search.start.evaluation if findings.search is not None else found
    content = ReportContent(
        spec=spec,
        chosen_spec=final if studied else None,
        start=start,
        chosen=found if studied else None,
        start_network=evaluate_design(spec, "network") if views.words.network else None,
        chosen_network=evaluate_design(final, "network") if studied and views.words.network else None,
        search=findings.search,
        sweeps=findings.sweeps,
        one_at_a_time=separate,
        checks=findings.checks,
        flux_map=views.flux_map(final) if views.flux_map is not None and findings.evaluation.ok else None,
        start_flux_map=views.flux_map(spec) if views.flux_map is not None and studied and start.ok else None,
        slots=views.slots(final) if views.slots is not None else None,
        parts=gather.part_rows(final, parts),
        assembly=parts,
        winding=winding_chart(final),
        model=gather.model(final, parts),
        picture=gather.picture(parts) if picture else Picture(None, "No picture was asked for."),
        checked=gather.checked(parts, views.words.squeeze),
        not_checked=(*views.words.not_checked, *_untold(findings), *findings.warnings),
        provenance=gather.provenance(spec, findings.evaluation, command),
        seconds=seconds,
        words=views.words,
        front=findings.front,
        tolerance=findings.tolerance,
        robust=findings.robust,
        simulation=findings.simulation,
        screw=views.screw(final, found) if views.screw is not None else None,
        hydraulics=views.hydraulics(final, found) if views.hydraulics is not None else None,
    )
    return write_report(content, path)


def design_evaluation(spec: Spec, findings: DesignResult) -> Evaluation:
    """The design's evaluation, with derivatives by the study's variables, which not every search asks for.

    They are those of `fluxbore.evaluate`: what the study holds stays as it is.
    """
    found, keys = findings.evaluation, tuple(item.key for item in spec.study.variables if not item.integer)
    if not found.ok or found.gradient or not keys:
        return found
    again = evaluate_design(findings.spec.for_study().pinned(keys), found.fidelity, keys)
    return replace(found, gradient=again.gradient, norms=again.norms)


def _untold(findings: DesignResult) -> tuple[str, ...]:
    """What a study with more in it would have looked at."""
    return () if findings.tolerance is not None else (AS_DRAWN,)
