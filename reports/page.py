"""Writes the report: one HTML file that needs nothing but itself."""

from __future__ import annotations

import base64
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from fluxbore.design.errors import OutputError
from fluxbore.design.keys import Key
from fluxbore.design.spec_file import to_toml
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.folder import write_atomic
from fluxbore.reports import (
    benchmark_sections,
    curves,
    figure_tables,
    flux_picture,
    front,
    hydrostatic,
    lead_screw,
    load_tables,
    optimum,
    parallel,
    search_curves,
    section_drawing,
    seen,
    sensitivity,
    story,
    study_curves,
    study_tables,
    tables,
    tolerances,
    tried,
)
from fluxbore.reports.brush_data import DesignTable, design_table, page_data
from fluxbore.reports.content import ReportContent
from fluxbore.reports.key_labels import FRAGMENTS
from fluxbore.reports.scripts import Data, Script, load
from fluxbore.reports.svg import Drawing
from fluxbore.reports.template import fill
from fluxbore.reports.viewer import viewer
from fluxbore.reports.winding import winding_section
from fluxbore.reports.wording import capital, duration, greek, key_label, symbol


def write_report(content: ReportContent, path: Path) -> Path:
    """Write the report to ``path`` and return it; an older report stays until the new one is whole.

    Raises OutputError where the file cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{path.parent} cannot be written: {error.strerror or error}.") from error
    return write_atomic(path, render(content))


def render(content: ReportContent) -> str:
    """The page as text."""
    table = design_table(content)
    return fill("report.html", *_scripts(content, table), **_context(content, _designs(table)))


def _scripts(content: ReportContent, table: DesignTable | None) -> tuple[tuple[Script, ...], tuple[Data, ...]]:
    """The scripts of this page, in the order in which they run, and what they read."""
    names, data = ["page.js", "curves.js", "flux.js"], []
    if table is not None:
        names.append("brush.js")
        data.append(Data("designs-data", page_data(table)))
    scripts, model = viewer(content)
    return load(*names) + scripts, (*data, *model)


def _designs(table: DesignTable | None) -> dict[str, Any] | None:
    if table is None:
        return None
    return {
        "table": table,
        "scatter": parallel.scatter(table),
        "parallel": parallel.parallel(table),
        "marks": [item.mark for item in table.designs if item.mark],
    }


def _context(content: ReportContent, designs: Mapping[str, Any] | None) -> Mapping[str, Any]:
    """Everything the template shows, section by section."""
    spec, design = content.spec, content.design
    sound = design if design is not None and design.ok else None
    head, variables = study_tables.variables(content)
    picture, drawn = _picture(content)
    objective = spec.study.objective
    search = content.search
    warnings = design.warnings if design is not None else ()
    return {
        "title": story.title(content),
        "is_study": content.is_study,
        "asked": story.asked(spec),
        "reached": story.reached(content),
        "warnings": warnings,
        "tiles": study_tables.tiles(content),
        "requirements": study_tables.requirements(content),
        "verdicts": study_tables.verdicts(content),
        "picture": picture,
        "picture_reason": content.picture.reason if content.picture is not None and picture is None else "",
        "section": drawn,
        "variable_head": head,
        "variables": variables,
        "candidates": study_tables.candidates(content),
        "gain": story.gain(content),
        "active": story.active(content),
        "sweeps": _sweeps(content),
        "search": search,
        "search_figures": _present(
            search_curves.convergence_curve(spec, search, objective) if search and objective else None,
            search_curves.search_path(spec, search, content.one_at_a_time) if search else None,
        ),
        "history": study_tables.history(content, search, objective) if search and objective else None,
        "effort": tried.effort(search, content.words) if search else "",
        "optimum": _optimum(content),
        "sensitivities": sensitivity.sensitivities(content),
        "front": _front(content),
        "tolerance": _tolerance(content),
        "robust": _robust(content),
        "benchmark": benchmark_sections.benchmark_section(content.simulation),
        "designs": designs,
        "mark_shapes": parallel.MARKS,
        "failures": tried.failures(search) if search else "",
        "screw": _screw(content),
        "hydraulics": _hydraulics(content),
        "field": _field(content),
        "force_figures": _present(*_force(content)) if sound else (),
        "force_text": [text for text in (seen.routes(sound), seen.ripple(sound)) if text] if sound else [],
        "positions": tables.positions(sound) if sound else None,
        "comparison": figure_tables.comparison(content),
        "meanings": figure_tables.meanings(content),
        "upper_bound": greek(content.words.network_note) if content.design_network is not None else "",
        "words": content.words,
        "slots": curves.slot_curve(content.slots) if content.slots is not None else None,
        "slots_note": content.slots.note if content.slots is not None else "",
        "parts": tables.parts(content.parts),
        "winding": winding_section(content.winding),
        "seen": seen.seen(content),
        "checked": [text for text in content.checked if text not in warnings],
        "not_checked": content.not_checked,
        "notes": [
            {"key": note.key, "label": capital(key_label(spec, note.key)), "status": note.status, "reason": note.reason}
            for note in sorted(content.design_spec.notes, key=lambda note: note.status)
        ],
        "provenance": content.provenance,
        "spec_texts": _spec_texts(content),
        "details": tables.details(_routes(content)),
        "seconds": duration(content.seconds) if content.seconds is not None else "",
        "symbols": _symbols(content),
    }


def _picture(content: ReportContent) -> tuple[str | None, Drawing | None]:
    """The picture as a data address, and the section drawing."""
    png = content.picture.png if content.picture is not None else None
    drawn = None
    if content.assembly is not None and content.assembly.parts:
        drawn = section_drawing.section(content.assembly, width=1000.0 if png else 640.0)
    return (f"data:image/png;base64,{base64.b64encode(png).decode()}" if png else None), drawn


def _spec_texts(content: ReportContent) -> list[tuple[str, str]]:
    """The whole specification, and that of the chosen design: what is needed to compute all this again."""
    if content.chosen_spec is None:
        return [("The specification", to_toml(content.spec))]
    return [
        ("The specification of the start, with its study", to_toml(content.spec)),
        ("The specification of the chosen design", to_toml(content.chosen_spec)),
    ]


def _sweeps(content: ReportContent) -> list[dict[str, Any]]:
    objective = content.spec.study.objective
    figure, maximise = (objective.figure, objective.maximise) if objective else ("force_constant", True)
    return [
        {
            "name": result.sweep.name,
            "figure": curves.sweep_curve(content.spec, result, f"sweep-{i}", figure, maximise, content.words.route),
            "finding": tried.sweep_finding(content.spec, result, figure, maximise),
            "failed": tables.failed_rows(content, result),
        }
        for i, result in enumerate(content.sweeps)
    ]


def _optimum(content: ReportContent) -> dict[str, Any] | None:
    """Why the search stopped where it did: the first-order conditions and their prices, or the limits in conflict."""
    search, objective = content.search, content.spec.study.objective
    if search is None:
        return None
    conflict = optimum.conflict(content.spec, search.conflict) if search.conflict is not None else None
    return {
        "residual": optimum.residual(search, objective),
        "prices": optimum.prices(content.spec, search, objective),
        "conflict_text": conflict[0] if conflict else "",
        "conflict": conflict[1] if conflict else None,
    }


def _front(content: ReportContent) -> dict[str, Any] | None:
    if content.front is None:
        return None
    chosen = content.search.chosen if content.search is not None else None
    return {
        "sentences": front.sentences(content.front, content.words),
        "figure": study_curves.front_curve(content.front, chosen),
        "table": front.table(content.spec, content.front) if content.front.points else None,
    }


def _tolerance(content: ReportContent) -> dict[str, Any] | None:
    found, spec = content.tolerance, content.design_spec
    if found is None:
        return None
    sound = found.nominal.ok
    return {
        "sentences": tolerances.sentences(spec, found),
        "figure": study_curves.tolerance_bars(spec, found) if sound else None,
        "requirements": tolerances.requirements(spec, found) if sound else None,
        "tolerances": tolerances.tolerances(spec, found) if sound else None,
        "spreads": tolerances.spreads(spec, found) if sound else None,
        "confidence": tolerances.confidence(),
    }


def _robust(content: ReportContent) -> dict[str, Any] | None:
    if content.robust is None:
        return None
    return {
        "sentences": tolerances.robust_sentences(content.spec, content.robust),
        "rounds": tolerances.rounds(content.spec, content.robust),
    }


def _screw(content: ReportContent) -> dict[str, Any] | None:
    if content.screw is None or content.design is None:
        return None
    return lead_screw.section(content.screw, content.design_spec, content.design)


def _hydraulics(content: ReportContent) -> dict[str, Any] | None:
    if content.hydraulics is None:
        return None
    return hydrostatic.section(content.hydraulics, content.design_spec)


def _routes(content: ReportContent) -> tuple[tuple[str, Evaluation | None], ...]:
    """The head of each route's details."""
    words = content.words
    return (capital(words.route_short), content.design), (capital(words.network_short), content.design_network)


def _field(content: ReportContent) -> dict[str, Any] | None:
    """The machine as a strip and two pole pitches from near, the start's beside the chosen design's."""
    chosen, start = content.flux_map, content.start_flux_map
    main = chosen or start
    if main is None:
        return None
    limit, step = flux_picture.colour_limit(chosen, start), flux_picture.flux_step(chosen, start)
    near = []
    if start is not None and (chosen is None or content.is_study):
        near.append(flux_picture.close_up(start, content.spec, limit, step, "flux-start", "Start"))
    if chosen is not None:
        title = "Chosen" if content.is_study else "Design"
        near.append(flux_picture.close_up(chosen, content.design_spec, limit, step, "flux-chosen", title))
    between = flux_picture.flux_between(step)
    strip = flux_picture.machine_strip(main, limit, step)
    loads = load_tables.section(main.loads, f"at no current, mover at {main.position * 1e3:.4g}\u00a0mm")
    return {"strip": strip, "near": near, "between": between, "loads": loads}


def _force(content: ReportContent) -> tuple[Drawing | None, ...]:
    design = content.design
    assert design is not None
    start = content.start if content.is_study and content.start is not None and content.start.ok else None
    return curves.force_curve(design, start), curves.phase_curve(design), curves.cogging_curve(design, start)


def _symbols(content: ReportContent) -> list[tuple[str, str]]:
    """Every symbol of the specification that this report's texts or tables can show, and those of the field."""
    spec = content.spec
    own = {symbol(spec, key.name): _meaning(key) for key in spec.kind.keys if key.name in spec.values}
    plain = [(sign, doc) for sign, doc in own.items() if sign not in ("", "z") and not re.search(r"[(/]", sign)]
    return [*content.words.symbols, *plain]


def _meaning(key: Key) -> str:
    """What a key is, with its name where the description goes on from it."""
    goes_on = key.doc.split(" ")[0] in FRAGMENTS
    return f"{key.leaf.replace('_', ' ')} {key.doc}" if goes_on else key.doc


def _present(*drawings: Drawing | None) -> tuple[Drawing, ...]:
    return tuple(item for item in drawings if item is not None)
