"""Every kind of report in a headless chromium without a network: what a reader's browser, keyboard, printer and screen
reader make of it."""

from __future__ import annotations

import io
import unicodedata
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from browser import axe, checks
from browser.chromium import Chromium
from browser.page import Page
from pypdf import PdfReader

import fluxbore
from fluxbore.design.spec import loads

pytestmark = pytest.mark.full

EXAMPLES = Path(__file__).parents[2] / "examples"

A4 = (595, 842)
"""Points, to the next whole one."""

SHEET = (695, 1016)
"""CSS pixels of what A4 leaves within the margins of the style sheet."""

LARGEST = 3_000_000
"""Bytes of a page."""

PAGES = ("study", "rotlin", "prehydra", "coils", "comparison", "kinds")


def _study(folder: Path) -> Path:
    """A hybrid's whole study, its sweeps thinned out."""
    text = (EXAMPLES / "ipehla.toml").read_text(encoding="utf-8")
    for fine, coarse in (('step = "0.5 mm"', 'step = "2.3 mm"'), ('step = "0.3 mm"', 'step = "0.6 mm"')):
        assert fine in text
        text = text.replace(fine, coarse)
    fluxbore.design(loads(text), folder / "study", workers=1)
    return folder / "study" / "report.html"


def _report(name: str) -> Callable[[Path], Path]:
    return lambda folder: fluxbore.report(EXAMPLES / f"{name}.toml", folder / f"{name}.html").files[0]


def _comparison(folder: Path) -> Path:
    spec = fluxbore.load(EXAMPLES / "ipehla.toml")
    widths = [spec.with_values({"actuator.mover.ring_width": width}) for width in (2.2e-3, 3e-3)]
    return fluxbore.compare([EXAMPLES / "ipehla.toml", *widths], folder / "comparison.html").files[0]


def _kinds(folder: Path) -> Path:
    names = ("ipehla", "rotlin", "prehydra", "team22-published")
    return fluxbore.compare([EXAMPLES / f"{name}.toml" for name in names], folder / "kinds.html").files[0]


MAKERS = {
    "study": _study,
    "rotlin": _report("rotlin"),
    "prehydra": _report("prehydra"),
    "coils": _report("team22-published"),
    "comparison": _comparison,
    "kinds": _kinds,
}


@pytest.fixture(scope="module", params=PAGES)
def path(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return MAKERS[request.param](tmp_path_factory.mktemp(request.param))


@pytest.fixture(scope="module")
def desk(chromium: Chromium, path: Path) -> Iterator[Page]:
    """The page on a desk, unfolded."""
    with chromium.open(path) as page:
        checks.unfold(page)
        yield page


def test_the_page_is_quiet_and_alone(desk: Page, path: Path) -> None:
    """Catches a script's error, a violation of the policy, a request beyond the file, and a page too large to send."""
    assert desk.complaints == []
    assert desk.requests == []
    assert path.stat().st_size < LARGEST


def test_a_keyboard_reaches_everything(desk: Page) -> None:
    """Catches a control that Tab passes over, focus that cannot be seen, and focus on what is not in the window."""
    order = checks.walk(desk)
    assert len(order) > 5
    assert checks.unreached(desk, order) == []
    assert [item["name"] for item in order if not item["ring"]] == []
    assert [item["name"] for item in order if not item["shown"]] == []


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_nobody_is_shut_out(desk: Page, dark: bool) -> None:
    """Catches what axe-core calls serious or critical: missing names, wrong roles, pale words."""
    desk.prefer(dark=dark)
    try:
        assert axe.violations(desk) == []
    finally:
        desk.prefer()


@pytest.mark.parametrize("width", [390, 320])
def test_a_telephone_scrolls_one_way(chromium: Chromium, path: Path, width: int) -> None:
    """Catches what is wider than the window outside of a box that scrolls by itself."""
    with chromium.open(path, width=width, height=844, touch=True) as page:
        checks.unfold(page)
        assert checks.beyond(page) == []
        assert page.complaints == []


def test_calm_readers_see_nothing_move(chromium: Chromium, path: Path) -> None:
    """Catches an animation or smooth scrolling where little motion is asked for."""
    with chromium.open(path, calm=True) as page:
        checks.unfold(page)
        assert checks.moving(page) == []


def test_without_scripts_the_page_is_whole(chromium: Chromium, path: Path) -> None:
    """Catches a section that only a script fills."""
    with chromium.open(path, scripts=False) as page:
        # The protocol's own evaluation still runs; the page's scripts do not.
        assert page.evaluate("document.querySelectorAll('section').length") >= 6
        empty = "[...document.querySelectorAll('section, figure')].filter(e => e.getBoundingClientRect().height < 30)"
        assert page.evaluate(f"{empty}.map(e => e.id || e.textContent.slice(0, 40))") == []
        assert page.complaints == []


def test_print_is_a4_light_and_whole(chromium: Chromium, path: Path) -> None:
    """Catches dark ink on paper, a table that is cut at the margin, other paper, and a page count out of all reason."""
    with chromium.open(path) as page:
        page.resize(*SHEET)
        page.prefer(medium="print")
        light = checks.palette(page)
        assert checks.cut(page) == []
        assert checks.beyond(page) == []
        page.prefer(medium="print", dark=True)
        assert checks.palette(page) == light
        assert light["--paper"] == "#fff"
        page.prefer(dark=True)
        assert checks.palette(page) != light
        found = PdfReader(io.BytesIO(page.pdf()))
    assert {(round(float(p.mediabox.width)), round(float(p.mediabox.height))) for p in found.pages} == {A4}
    assert 3 <= len(found.pages) <= 40
    blank = [i for i, sheet in enumerate(found.pages, 1) if len(sheet.extract_text().strip()) < 20]
    assert blank == []


def test_print_opens_what_is_folded(chromium: Chromium, path: Path) -> None:
    """Catches details that paper keeps shut; what paper leaves out as a whole, as the live view, does not count."""
    with chromium.open(path) as page:
        page.prefer(medium="print")
        hidden = page.evaluate(
            """[...document.querySelectorAll('details > :not(summary)')]
              .filter(e => e.parentElement.checkVisibility()).map(e =>
              (e.querySelector('caption') || e).textContent.trim().split(/\\s+/).slice(0, 3).join(' '))"""
        )
        page.prefer()
        text = _plain("".join(sheet.extract_text() for sheet in PdfReader(io.BytesIO(page.pdf())).pages))
    assert [words for words in hidden if _plain(words) not in text] == []


def _plain(text: str) -> str:
    """Without spaces and ligatures, which depend on how a line was set."""
    return "".join(unicodedata.normalize("NFKC", text).split())
