"""axe-core in a page: what would shut people out who do not see it, or do not use a mouse.

The package axe-core-python carries the script; AXE names another version of it.
"""

from __future__ import annotations

import os
from importlib.resources import files
from pathlib import Path

from browser.page import Page

GRAVE = ("serious", "critical")


def violations(page: Page, impacts: tuple[str, ...] = GRAVE) -> list[str]:
    """The rules that are broken with such an impact, each with how many places, the first of them and what is wrong."""
    page.evaluate(_script())
    found = page.evaluate(
        "axe.run(document, {resultTypes: ['violations']}).then(r => r.violations.map(v => ({id: v.id, impact: v.impact,"
        " count: v.nodes.length, where: v.nodes[0].html.slice(0, 160), why: v.nodes[0].failureSummary})))",
        limit=300.0,
    )
    return [
        f"{item['id']} ({item['impact']}) {item['count']} ×: {item['where']} – {item['why']}"
        for item in found
        if item["impact"] in impacts
    ]


def _script() -> str:
    named = os.environ.get("AXE")
    if named:
        return Path(named).read_text(encoding="utf-8")
    return files("axe_core_python").joinpath("axe.min.js").read_text(encoding="utf-8")
