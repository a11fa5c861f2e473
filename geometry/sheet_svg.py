"""A sheet as an SVG file of its true size, in millimetres; texts stay texts."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

from fluxbore.geometry.hatch_lines import hatch_lines
from fluxbore.geometry.program import program
from fluxbore.geometry.sheet import LAYERS, Circle, Ellipse, Filled, Hatch, Place, Sheet, Stroke, Text, parts_of
from fluxbore.geometry.sheet_frame import SIZES
from fluxbore.geometry.sheet_text import text_width

DASHES = {"DASHED": "3 1.2", "CENTER": "8 1.2 1.2 1.2"}
"""mm on and off."""

FONT = "DejaVu Sans, Verdana, Arial, sans-serif"

CAPITALS = 0.729
"""Height of a capital over the size of the font, of DejaVu Sans and nearly all others."""


def svg_text(sheet: Sheet) -> str:
    """The whole file."""
    width, height = SIZES[sheet.size]
    layers: dict[str, list[str]] = {name: [] for name in LAYERS}
    for item in parts_of(sheet.items):
        layers[item.layer].append(_element(item, height))
    groups = [_group(name, elements) for name, elements in layers.items() if elements]
    return "\n".join(
        (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:g}mm" height="{height:g}mm" '
            f'viewBox="0 0 {width:g} {height:g}" font-family="{FONT}">',
            f"<title>{escape(sheet.title)}</title>",
            f"<desc>{escape(program())}</desc>",
            f'<rect width="{width:g}" height="{height:g}" fill="#fff"/>',
            *groups,
            "</svg>\n",
        )
    )


def _group(name: str, elements: Iterable[str]) -> str:
    _, linetype, width = LAYERS[name]
    dashes = f' stroke-dasharray="{DASHES[linetype]}"' if linetype in DASHES else ""
    ends = 'stroke-linejoin="round" stroke-linecap="round"' if not dashes else 'stroke-linejoin="round"'
    body = "\n".join(elements)
    return f'<g id="{name}" fill="none" stroke="#000" stroke-width="{width:g}" {ends}{dashes}>\n{body}\n</g>'


def _element(item: Stroke | Circle | Ellipse | Filled | Hatch | Text, height: float) -> str:
    match item:
        case Stroke():
            return f'<path d="{_path(item.points, height)}{"Z" if item.closed else ""}"/>'
        case Circle():
            x, y = item.centre
            return f'<circle cx="{x:.5g}" cy="{height - y:.5g}" r="{item.radius:.5g}"/>'
        case Ellipse():
            x, y = item.centre
            return f'<ellipse cx="{x:.5g}" cy="{height - y:.5g}" rx="{item.along:.5g}" ry="{item.across:.5g}"/>'
        case Filled():
            return f'<path d="{_path(item.points, height)}Z" fill="#000" stroke="none"/>'
        case Hatch():
            if not item.spacing:
                rings = "Z".join(_path(ring, height) for ring in item.rings)
                return f'<path d="{rings}Z" fill="#000" fill-rule="evenodd" stroke="none"/>'
            return f'<path d="{"".join(_path(line, height) for line in hatch_lines(item))}"/>'
    return _words(item, height)


def _words(item: Text, height: float) -> str:
    """With its width told, so that it is as wide with whatever font the reader has."""
    (x, y), size = item.place, item.size / CAPITALS
    anchor = "" if item.anchor == "left" else f' text-anchor="{"end" if item.anchor == "right" else "middle"}"'
    turn = f' transform="rotate(-90 {x:.3f} {height - y:.3f})"' if item.angle else ""
    long = f' textLength="{text_width(item.text, item.size):.2f}" lengthAdjust="spacingAndGlyphs"'
    return (
        f'<text x="{x:.3f}" y="{height - y:.3f}" font-size="{size:.3f}" fill="#000" stroke="none"{anchor}{turn}{long}>'
        f"{escape(item.text)}</text>"
    )


def _path(points: Iterable[Place], height: float) -> str:
    return "M" + "L".join(f"{x:.3f} {height - y:.3f}" for x, y in points)
