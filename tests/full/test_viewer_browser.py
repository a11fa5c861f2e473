"""The live view in a browser, opened from its file without a network: it draws, cuts, hides and picks."""

import io
from collections.abc import Iterable, Iterator
from pathlib import Path

import numpy as np
import pytest
from browser.chromium import Chromium
from browser.page import Page
from PIL import Image

from fluxbore import load, report_content
from fluxbore.actuators import actuator_of, assembly_of
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.outline import box
from fluxbore.geometry.part import Body
from fluxbore.reports.content import ReportContent
from fluxbore.reports.page import write_report

pytestmark = pytest.mark.full

EXAMPLES = Path(__file__).parents[2] / "examples"
CANVAS = "#viewer canvas"
READY = "Number(document.querySelector('#viewer canvas')?.dataset.frames) > 0"


def written(name: str, folder: Path) -> tuple[Path, Assembly]:
    """A report of parts alone, which takes no solve."""
    spec = load(EXAMPLES / f"{name}.toml")
    parts = assembly_of(spec)
    content = ReportContent(
        spec=spec,
        assembly=parts,
        parts=report_content.part_rows(spec, parts),
        picture=report_content.picture(parts),
        model=report_content.model(spec, parts),
        words=actuator_of(spec).words,
    )
    return write_report(content, folder / f"{name}.html"), parts


@pytest.fixture(scope="module")
def hybrid(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Assembly]:
    return written("ipehla", tmp_path_factory.mktemp("page"))


@pytest.fixture
def page(chromium: Chromium, hybrid: tuple[Path, Assembly]) -> Iterator[Page]:
    with chromium.open(hybrid[0]) as opened:
        opened.wait(READY)
        yield opened
        assert opened.complaints == []
        assert opened.requests == []


def pixels(page: Page) -> np.ndarray:
    """(h, w, 3) of the canvas as it is on the screen, after what is due has been drawn."""
    page.settle()
    left, top, width, height = page.box(CANVAS)
    down = page.evaluate("window.scrollY")
    picture = Image.open(io.BytesIO(page.screenshot(clip=(left, top + down, width, height))))
    return np.asarray(picture.convert("RGB"), dtype=int)


def different(first: np.ndarray, second: np.ndarray) -> int:
    """How many pixels are not alike."""
    return int(np.sum(np.abs(first - second).max(axis=2) > 24))


def outermost(parts: Iterable[Body], z: float) -> Body:
    """The part of the mover that is farthest from the axis at a height (m)."""
    there = [p for p in parts if p.group == "mover" and box(p.profile)[2] < z < box(p.profile)[3]]
    return max(there, key=lambda part: box(part.profile)[1])


def press(page: Page, name: str) -> None:
    page.evaluate(f"[...document.querySelectorAll('#viewer button')].find(b => b.textContent === {name!r}).click()")


def slide(page: Page, share: float) -> None:
    page.evaluate(
        "(() => { const s = document.querySelector('#viewer input[type=range]');"
        f" s.value = {share}; s.dispatchEvent(new Event('input')); }})()"
    )


def choose(page: Page, label: str, value: str) -> None:
    page.evaluate(
        "(() => { const s = [...document.querySelectorAll('#viewer label')]"
        f".find(l => l.textContent.startsWith({label!r})).querySelector('select');"
        f" s.value = {value!r}; s.dispatchEvent(new Event('change')); }})()"
    )


def test_it_draws_in_the_pictures_place(page: Page) -> None:
    """Far more than the empty ground is there, in more colours than one; the picture itself is not seen."""
    found = pixels(page)
    ground = np.median(found[:, :8], axis=1, keepdims=True)
    drawn = np.abs(found - ground).max(axis=2) > 24
    assert 0.02 * drawn.size < drawn.sum() < 0.7 * drawn.size
    assert len(np.unique(found[drawn] // 32, axis=0)) > 20
    assert page.evaluate("getComputedStyle(document.querySelector('figure.picture')).display") == "none"


def test_nothing_is_drawn_while_nothing_changes(page: Page) -> None:
    """Catches a loop that never rests, on machines that run from a battery."""
    page.settle()
    before = page.evaluate(f"document.querySelector({CANVAS!r}).dataset.frames")
    page.evaluate("new Promise(done => setTimeout(done, 400))")
    assert page.evaluate(f"document.querySelector({CANVAS!r}).dataset.frames") == before


def test_a_click_picks_the_part_that_is_there(page: Page, hybrid: tuple[Path, Assembly]) -> None:
    """Seen from the side, the middle of the picture is the middle of all parts along the axis: there a part of the
    mover stands, the stator being cut. Its row is marked in both lists, and its name is told."""
    parts = hybrid[1].parts
    heights = [z for part in parts for _, z in part.profile]
    middle = (min(heights) + max(heights)) / 2
    expected = {outermost(parts, middle + way) for way in (-1e-3, 0.0, 1e-3)}  # two pixels either way
    press(page, "Side")
    page.settle()
    page.click(CANVAS)
    page.settle()
    told = page.evaluate("document.querySelector('#viewer [role=status] b').textContent")
    assert told.split(" · ")[1] in {part.name for part in expected}
    number = page.evaluate("document.querySelector('#parts tr.picked').dataset.part")
    assert page.evaluate("document.querySelectorAll('tr.picked').length") == 2
    assert page.evaluate("document.querySelector('#viewer tr.picked').dataset.part") == number
    assert told.split(" · ")[0] == number
    assert told.split(" · ")[1].rstrip(" 0123456789") in page.evaluate(
        "document.querySelector('#parts tr.picked th').textContent"
    )
    # The row of the panel is in sight within it.
    inside = (
        "(() => { const r = document.querySelector('#viewer tr.picked').getBoundingClientRect(),"
        " b = document.querySelector('#viewer details .scroll').getBoundingClientRect();"
        " return r.top >= b.top - 1 && r.bottom <= b.bottom + 1; })()"
    )
    assert page.evaluate(inside)


def test_what_is_cut_off_is_not_picked(page: Page, hybrid: tuple[Path, Assembly]) -> None:
    """Without a section the same click meets the outermost part, with all parts cut the innermost."""
    press(page, "Side")
    told = []
    for value in ("none", "along"):
        choose(page, "Section", value)
        choose(page, "Cut", "")
        page.settle()
        page.click(CANVAS)
        told.append(page.evaluate("document.querySelector('#viewer [role=status]').textContent"))
    assert "back yoke" in told[0]
    assert "shaft" in told[1]


def test_a_row_lights_its_parts_up(page: Page) -> None:
    before = pixels(page)
    page.evaluate("document.querySelector('#parts tr[data-part] th').click()")
    assert different(before, pixels(page)) > 300
    assert page.evaluate("document.querySelector('#viewer tr.picked').dataset.part") == "1"


def test_the_slider_moves_the_section(page: Page) -> None:
    """Each place of the plane gives another picture; at zero it is that of no section at all."""
    found = []
    for share in (0.0, 0.5, 0.8):
        slide(page, share)
        found.append(pixels(page))
    assert different(found[0], found[1]) > 2000
    assert different(found[1], found[2]) > 500
    choose(page, "Section", "none")
    assert different(found[0], pixels(page)) < 20


def test_a_check_box_hides_its_parts(page: Page) -> None:
    before = pixels(page)
    first = "document.querySelector('#viewer input[type=checkbox]')"
    page.evaluate(f"document.querySelector('#viewer details').open = true; {first}.click()")
    without = pixels(page)
    assert different(before, without) > 300
    page.evaluate(f"{first}.click()")
    assert different(before, pixels(page)) == 0


def test_keys_turn_and_zoom_and_the_wheel_scrolls_the_page(page: Page) -> None:
    before = pixels(page)
    middle = page.middle(CANVAS)
    page.wheel(middle, 120)
    page.evaluate("new Promise(done => setTimeout(done, 300))")
    assert different(before, pixels(page)) == 0
    page.evaluate(f"document.querySelector({CANVAS!r}).focus()")
    before = pixels(page)  # with the ring around what has the focus
    page.key("ArrowLeft", times=3)
    turned = pixels(page)
    assert different(before, turned) > 1000
    page.key("ArrowRight", times=3)
    assert different(before, pixels(page)) < 50
    page.key("+", times=2)
    assert different(before, pixels(page)) > 1000


def test_a_drag_turns_and_is_no_click(page: Page) -> None:
    before = pixels(page)
    x, y = page.middle(CANVAS)
    page.drag((x, y), (x + 80, y + 20))
    assert different(before, pixels(page)) > 1000
    assert page.evaluate("document.querySelectorAll('tr.picked').length") == 0


def test_in_print_the_picture_takes_its_place(page: Page) -> None:
    page.prefer(medium="print")
    assert page.evaluate("getComputedStyle(document.querySelector('#viewer .stage')).display") == "none"
    picture = "document.querySelector('#viewer > figure')"
    assert page.evaluate(f"{picture}.getBoundingClientRect().height") > 100


def test_without_webgl_the_picture_stays(hybrid: tuple[Path, Assembly]) -> None:
    """One line says so, and nothing is an error of the page's."""
    with (
        Chromium(("--disable-webgl", "--disable-3d-apis", "--disable-webgl2")) as browser,
        browser.open(hybrid[0]) as page,
    ):
        page.wait("document.querySelector('#viewer').dataset.live === 'no'")
        assert "no WebGL" in page.evaluate("document.querySelector('#viewer').textContent")
        assert page.evaluate("document.querySelector('#viewer > figure').getBoundingClientRect().height") > 100
        assert page.evaluate("document.querySelectorAll('#viewer canvas').length") == 0


@pytest.mark.parametrize("name", ["rotlin", "prehydra", "team22"])
def test_other_kinds_draw_without_complaint(name: str, chromium: Chromium, tmp_path: Path) -> None:
    """On a phone, in the dark."""
    path, _ = written(name, tmp_path)
    with chromium.open(path, width=390, height=844, dark=True, touch=True) as page:
        page.wait(READY)
        found = pixels(page)
        assert len(np.unique(found.reshape(-1, 3) // 32, axis=0)) > 10
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        assert (page.complaints, page.requests) == ([], [])
