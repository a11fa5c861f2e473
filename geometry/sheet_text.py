"""Sizes of text on drawings: heights by ISO 3098, and how wide a line will be.

Widths are those of DejaVu Sans, in which pages are printed, rounded upwards; it is wider than most other fonts, so that
what fits with it fits with theirs.
"""

from __future__ import annotations

import re

SMALL, LARGE, HEADING = 2.5, 3.5, 5.0
"""mm, of dimensions and notes, of titles, and of the name of the whole."""

CAPTION = 1.8
"""mm, of the words that say what a field is."""

_CLASSES = (
    (0.40, "'ijlIJ"),
    (0.45, " ,."),
    (0.50, "-/:;\\f|"),
    (0.55, "!()[]t"),
    (0.60, "r"),
    (0.70, '"*_`°–'),
    (0.75, "?sz"),
    (0.80, "FLck"),
    (0.85, "PTYaeovxy"),
    (0.90, "$0123456789EKSbdghnpqu{}µ"),
    (0.95, "ABVXZ"),
    (1.00, "CR"),
    (1.05, "HNU"),
    (1.10, "&DGOQØ"),
    (1.15, "#+<=>^w~×±"),
    (1.20, "M"),
)
"""Width over the height of capitals; whatever is not named here counts as the widest."""

_WIDTHS = {letter: width for width, letters in _CLASSES for letter in letters}

_WIDEST = 1.4


def text_width(text: str, size: float) -> float:
    """mm, of one line with capitals of this height (mm)."""
    return size * sum(_WIDTHS.get(letter, _WIDEST) for letter in text)


def fitted(text: str, width: float, size: float, least: float = CAPTION) -> tuple[str, float]:
    """The text and the height at which it fits into a width (mm): smaller, and cut where it would become too small.

    A part's own number, behind the last hyphen, stays: without it all parts of a long number would be alike.
    """
    size = min(size, max(least, size * width / max(text_width(text, size), 1e-9)))
    if text_width(text, size) <= width * (1 + 1e-9):
        return text, size
    own = re.search(r"-[0-9]{3,4}$", text)
    end = "..." + (own.group() if own else "")
    text = text[: own.start()] if own else text
    while text and text_width(text + end, size) > width:
        text = text[:-1]
    return text.rstrip() + end, size


def wrapped(text: str, width: float, size: float) -> list[str]:
    """The text in lines no wider than this (mm), broken at spaces; a word that is wider stands alone."""
    lines: list[str] = []
    for word in text.split():
        if lines and text_width(f"{lines[-1]} {word}", size) <= width:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return lines
