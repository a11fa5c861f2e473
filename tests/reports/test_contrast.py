"""Colours of the style sheet against the grounds on which they stand, by the formula of WCAG 2."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import fluxbore.reports

CSS = (Path(fluxbore.reports.__file__).parent / "assets" / "report.css").read_text(encoding="utf-8")

TEXTS = {
    "card": ("ink", "muted", "accent", "good", "bad", "warn", "fig-ink", "fig-muted"),
    "paper": ("ink", "muted", "accent", "good", "bad", "warn"),
    "quiet-back": ("ink", "muted", "accent"),
    "good-back": ("good",),
    "bad-back": ("bad",),
    "warn-back": ("warn", "ink"),
}
"""Ground -> the colours of words on it, which need 4.5."""

GRAPHICS = ("chosen", "start", "published", "good", "bad", "other", "edge")
"""Of drawings, on the card; they need 3."""


def palette(theme: str) -> dict[str, str]:
    """The colours of a theme: those of the root, and what the theme sets otherwise."""
    light = _variables(CSS.split("@media", 1)[0])
    if theme == "light":
        return light
    rule = "(prefers-color-scheme: dark)" if theme == "dark" else "print"
    return light | _variables(re.split(rf"@media {re.escape(rule)} {{", CSS)[1].split("\n}", 1)[0])


def _variables(text: str) -> dict[str, str]:
    return dict(re.findall(r"--([\w-]+): (#[0-9a-fA-F]+)", text))


def luminance(colour: str) -> float:
    digits = colour[1:] if len(colour) == 7 else "".join(2 * digit for digit in colour[1:])
    shares = [int(digits[i : i + 2], 16) / 255 for i in (0, 2, 4)]
    linear = [share / 12.92 if share <= 0.04045 else ((share + 0.055) / 1.055) ** 2.4 for share in shares]
    return sum(weight * share for weight, share in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def contrast(first: str, second: str) -> float:
    low, high = sorted((luminance(first), luminance(second)))
    return (high + 0.05) / (low + 0.05)


def test_contrast_is_that_of_the_standard() -> None:
    """Catches a slip in the formula: black on white is 21, and #767676 on white the palest grey of 4.5."""
    assert contrast("#000", "#ffffff") == pytest.approx(21)
    assert contrast("#767676", "#fff") == pytest.approx(4.54, abs=0.01)


@pytest.mark.parametrize("theme", ["light", "dark", "print"])
def test_words_are_legible(theme: str) -> None:
    """Catches a shade that is too near to its ground."""
    colours = palette(theme)
    found = {
        (ground, name): contrast(colours[ground], colours[name]) for ground, names in TEXTS.items() for name in names
    }
    assert {pair: value for pair, value in found.items() if value < 4.5} == {}


@pytest.mark.parametrize("theme", ["light", "dark", "print"])
def test_drawings_stand_out(theme: str) -> None:
    """Catches a line or an outline that is lost on the card."""
    colours = palette(theme)
    found = {name: contrast(colours["card"], colours[f"fig-{name}"]) for name in GRAPHICS}
    assert {name: value for name, value in found.items() if value < 3} == {}
