"""Writes a comparison of designs: one HTML file that needs nothing but itself."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from fluxbore.optimize.folder import write_atomic
from fluxbore.reports import compare_curves, compare_figures, compare_sections, compare_tables, story
from fluxbore.reports.compare_content import ComparedDesign, Comparison
from fluxbore.reports.scripts import load
from fluxbore.reports.template import fill
from fluxbore.reports.wording import greek, listing, percent


def write_comparison(comparison: Comparison, path: Path) -> Path:
    """Write the page to ``path`` and return it; an older one stays until the new one is whole."""
    return write_atomic(path, render(comparison))


def render(comparison: Comparison) -> str:
    """The page as text."""
    return fill("compare.html", load("page.js", "curves.js"), **_context(comparison))


def _context(comparison: Comparison) -> Mapping[str, Any]:
    """Everything the template shows, section by section."""
    return {
        "title": f"{len(comparison.designs)} designs side by side",
        "designs": [_card(design) for design in comparison.designs],
        "first": comparison.first.letter,
        "same": percent(comparison.same),
        "glance": compare_figures.glance(comparison),
        "requirements": compare_tables.requirements(comparison),
        "sections": compare_sections.sections(comparison),
        "curves": compare_curves.overlays(comparison),
        "no_curves": _no_curves(comparison),
        "common": compare_figures.common(comparison),
        "partial": compare_figures.partial(comparison),
        "keys": compare_tables.keys(comparison),
        "untold_keys": compare_tables.untold_keys(comparison),
        "parts": compare_tables.parts(comparison),
        "assumed": compare_tables.assumed(comparison),
        "kinds": _kinds(comparison),
        "notes": _notes(comparison),
        "provenance": comparison.provenance,
    }


def _card(design: ComparedDesign) -> dict[str, Any]:
    """Who a design is: its names, what was asked of it and what came of it."""
    return {
        "letter": design.letter,
        "name": design.name,
        "source": design.source,
        "kind": design.spec.kind.name,
        "run": design.run,
        "asked": story.asked(design.spec),
        "reached": story.reached(design.content),
        "warnings": design.evaluation.warnings,
        "provenance": design.provenance,
    }


def _no_curves(comparison: Comparison) -> str:
    """Why no curve is drawn."""
    if any(design.curves for design in comparison.designs):
        return "No two of these designs have a curve of the same kind."
    return "Designs of this kind have no curves that could be laid over one another."


def _kinds(comparison: Comparison) -> str:
    """A sentence on what unlike kinds have in common; empty where all are of one kind."""
    if comparison.alike:
        return ""
    named = listing(f"{design.letter} is of kind “{design.spec.kind.name}”" for design in comparison.designs)
    return f"The designs are of unlike kinds: {named}. Only figures, keys and curves that they share are compared."


def _notes(comparison: Comparison) -> list[str]:
    """What is to be known of the routes."""
    routes = {design.words.route: design.letter for design in comparison.designs}
    if len(routes) == 1:
        return [greek(f"All figures are by {next(iter(routes))}.")]
    by = listing(f"{design.letter} by {design.words.route}" for design in comparison.designs)
    return [greek(f"Figures come by unlike routes: {by}.")]
