"""What every page must pass: it fits its window, a keyboard reaches all of it, printing cuts nothing, nothing moves."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from browser.page import Page

SLACK = 1.0
"""CSS pixels, by which rounding may put something beyond an edge."""

_SCRIPT = Path(__file__).with_name("checks.js")


def unfold(page: Page) -> None:
    """Open everything that is folded, and look at the page from top to bottom, so that whatever is lazy is drawn."""
    page.evaluate("document.querySelectorAll('details').forEach(e => { e.open = true; })")
    height = page.evaluate("document.documentElement.scrollHeight")
    for place in range(0, int(height), 700):
        page.evaluate(f"window.scrollTo({{top: {place}, behavior: 'instant'}})")
    page.evaluate("window.scrollTo({top: 0, behavior: 'instant'})")
    page.settle()


def beyond(page: Page) -> list[str]:
    """What reaches beyond the window's right or left edge and is not inside something that scrolls by itself."""
    return list(_ask(page, "beyond", SLACK))


def cut(page: Page) -> list[str]:
    """What scrolls sideways on the screen and would be cut on paper; ask it of a page that is shown as printed."""
    return list(_ask(page, "cut", SLACK))


def walk(page: Page) -> list[dict[str, Any]]:
    """Everything that the Tab key comes to, in its order: number and name, ``ring`` for whether the focus can be seen
    on it, ``shown`` for whether it has come into the window."""
    most = int(_ask(page, "number")) + 3
    order: list[dict[str, Any]] = []
    for _ in range(most):
        page.key("Tab")
        found = _ask(page, "focused")
        if found is None:
            break
        order.append(found)
    return order


def unreached(page: Page, order: list[dict[str, Any]]) -> list[str]:
    """The visible controls that are not in a walk."""
    return list(_ask(page, "unreached", [item["number"] for item in order]))


def moving(page: Page) -> list[str]:
    """Animations that run, and what moves by itself when it changes or is scrolled to."""
    return list(_ask(page, "moving"))


def palette(page: Page) -> dict[str, str]:
    """Every custom property of the page's root as it counts now."""
    return dict(_ask(page, "palette"))


def _ask(page: Page, question: str, *arguments: object) -> Any:
    if not page.evaluate("Boolean(window.pageChecks)"):
        page.evaluate(_SCRIPT.read_text(encoding="utf-8"))
    return page.evaluate(f"window.pageChecks.{question}({', '.join(map(json.dumps, arguments))})")
