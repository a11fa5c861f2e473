"""matplotlib figures as small inline SVG that follows the page's theme.

Colours of lines and texts are written as CSS variables, so that one drawing serves light, dark and print; texts stay
texts in the reader's own font; identifiers carry the figure's name, since all figures share one document.
"""

from __future__ import annotations

import base64
import html
import io
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from fluxbore.reports.readout import readouts

if TYPE_CHECKING:
    from matplotlib.figure import Figure

INK, MUTED, GRID = "#15232f", "#5a6b7a", "#d9e0e6"
EDGE = "#26323c"
"""The outline of a part and its axis; its face has the part's own colour in every theme."""

CHOSEN, START, PUBLISHED, GOOD, BAD, OTHER = "#1763b5", "#8393a1", "#b3541e", "#2b7a4b", "#b42b33", "#6d4aa8"

VARIABLES = {
    INK: "ink",
    MUTED: "muted",
    GRID: "grid",
    CHOSEN: "chosen",
    START: "start",
    PUBLISHED: "published",
    GOOD: "good",
    BAD: "bad",
    OTHER: "other",
    EDGE: "edge",
}
"""Colour in the drawing -> CSS variable ``--fig-...`` of the page; the colour itself is the light theme's."""

_STYLE: dict[Any, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 12.0,
    "text.color": INK,
    "text.parse_math": False,
    "figure.facecolor": "none",
    "axes.facecolor": "none",
    "savefig.facecolor": "none",
    "axes.edgecolor": MUTED,
    "axes.labelcolor": INK,
    "axes.titlecolor": INK,
    "axes.titlesize": 12.0,
    "axes.linewidth": 0.8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.unicode_minus": True,
    "axes.formatter.useoffset": False,
    "grid.color": GRID,
    "grid.linewidth": 0.8,
    "xtick.color": MUTED,
    "ytick.color": MUTED,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.labelsize": 11.0,
    "ytick.labelsize": 11.0,
    "legend.frameon": False,
    "legend.fontsize": 11.0,
    "lines.linewidth": 1.8,
    "lines.solid_capstyle": "round",
    "path.simplify_threshold": 0.2,
    "svg.fonttype": "none",
    "svg.hashsalt": "fluxbore",
}


@dataclass(frozen=True, slots=True)
class Drawing:
    """A finished figure: ``markup`` is the SVG element, safe to inline; ``alt`` says what it shows.

    readouts : what the pointer reads off it, see `fluxbore.reports.readout`.
    """

    name: str
    markup: str
    alt: str
    caption: str
    wide: bool = False
    readouts: tuple[Mapping[str, Any], ...] = ()


@contextmanager
def style() -> Iterator[None]:
    """The page's look for everything drawn inside; matplotlib's settings are put back afterwards."""
    import matplotlib

    with matplotlib.rc_context(_STYLE):
        yield


def new_figure(width: float, height: float) -> Figure:
    """An empty figure of this size in SVG units, in which type of 12 units reads well at full width."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width / 72, height / 72), dpi=72, layout="constrained")


def drawing(figure: Figure, name: str, alt: str, caption: str, *, wide: bool = False, dpi: int = 150) -> Drawing:
    """The figure as inline SVG. ``name`` must be unique on the page; ``dpi`` is that of rasterised parts."""
    buffer = io.StringIO()
    nothing = dict.fromkeys(("Date", "Creator", "Format", "Type"))
    figure.savefig(buffer, format="svg", metadata=nothing, dpi=dpi)
    return Drawing(name, inline(buffer.getvalue(), name, alt), alt, caption, wide, readouts(figure, VARIABLES))


def inline(text: str, name: str, alt: str) -> str:
    """An SVG file's text as an element of an HTML page."""
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>|<!--.*?-->", "", text, flags=re.DOTALL)
    text = re.sub(r'<rect width="[\d.]+" height="[\d.]+" id="dummy"\s*/>', "", text)
    text = text.replace("xlink:href", "href")
    head, rest = text.split(">", 1)
    box = re.search(r'viewBox="([^"]+)"', head)
    width, height = box.group(1).split()[2:] if box else ("100", "100")
    label = html.escape(alt, quote=True)
    head = f'<svg viewBox="0 0 {width} {height}" width="{width}" height="{height}" role="img" aria-label="{label}"'
    rest = _identifiers(rest, name)
    rest = re.sub(r"(?<=data:image/png;base64,)[^\"]+", lambda match: _slim(match.group()), rest)
    rest = re.sub(r'(?<= d=")[^"]+', lambda match: _rounded(match.group()), rest)
    rest = re.sub(r'(?<= (?:x|y)=")-?[\d.]+', lambda match: _rounded(match.group()), rest)
    rest = re.sub(r"(?<=translate\()[^)]+", lambda match: _rounded(match.group()), rest)
    rest = re.sub(r" transform=\"rotate\(-?0 [^\"]*\"|font-family: [^;\"]+; ?|<defs><style.*?</style></defs>", "", rest)
    rest = re.sub(r"\s*\n\s*(?=[MLCQZz])", "", rest)
    for colour, variable in VARIABLES.items():
        rest = rest.replace(colour, f"var(--fig-{variable},{colour})")
    return re.sub(r">\s+<(?!/text|tspan)", "><", f"{head}>{rest}").strip()


def _slim(encoded: str) -> str:
    """A rasterised part in 256 colours: a colour map has no more, and the file is a third of the size."""
    from PIL import Image

    encoded = "".join(encoded.split())
    with Image.open(io.BytesIO(base64.b64decode(encoded))) as picture:
        whole = picture.convert("RGBA")
    few = whole.convert("RGB").quantize(255, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    few.paste(255, mask=whole.getchannel("A").point(lambda alpha: 255 if alpha < 128 else 0))
    buffer = io.BytesIO()
    few.save(buffer, "PNG", optimize=True, transparency=255)
    return min(base64.b64encode(buffer.getvalue()).decode(), encoded, key=len)


def _identifiers(text: str, name: str) -> str:
    """Drop the identifiers that nothing refers to, and put the figure's name before the others."""
    used = set(re.findall(r"url\(#([^)]+)\)", text)) | set(re.findall(r'href="#([^"]+)"', text))
    text = re.sub(
        r' id="([^"]+)"', lambda match: f' id="{name}-{match.group(1)}"' if match.group(1) in used else "", text
    )
    return re.sub(r'(url\(#|href="#)', rf"\g<1>{name}-", text)


def _rounded(numbers: str) -> str:
    """Coordinates to a hundredth of a unit, which no screen shows."""
    return re.sub(r"-?\d+\.\d{3,}", lambda match: f"{float(match.group()):.2f}".rstrip("0").rstrip("."), numbers)
