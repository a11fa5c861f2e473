"""What the report's scripts do to a reader's gestures: brushing, values on curves, the field under a probe."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from browser.chromium import WHY_NOT, Chromium, find
from browser.page import Page
from made_up_report import a_content

from fluxbore.reports.brush_data import design_table
from fluxbore.reports.page import write_report

pytestmark = [pytest.mark.full, pytest.mark.skipif(find() is None, reason=WHY_NOT)]

AXIS = "svg.parallel .axis[data-column='0']"
COUNT = "document.querySelector('.count').textContent"
LIT = (
    "[...document.querySelectorAll('svg.{} [data-row]:not(.off)')].map(e => Number(e.dataset.row))"
    ".sort((a, b) => a - b)"
)
ROWS = "[...document.querySelectorAll('#designs-selected tbody th')].map(e => parseInt(e.textContent) - 1)"


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_report(a_content(), tmp_path_factory.mktemp("report") / "report.html")


@pytest.fixture(scope="module")
def chromium() -> Iterator[Chromium]:
    with Chromium() as started:
        yield started


@pytest.fixture
def page(chromium: Chromium, report: Path) -> Iterator[Page]:
    with chromium.open(report) as opened:
        yield opened
        assert opened.complaints == []
        assert opened.requests == []


def test_a_range_on_an_axis_picks_the_same_designs_everywhere(page: Page) -> None:
    """Catches a brush that lights other designs in the scatter or in the table than between its ends."""
    found = design_table(a_content())
    assert found is not None
    x, y, width, height = page.box(f"{AXIS} .strip")
    page.drag((x + width / 2, y + 0.3 * height), (x + width / 2, y + 0.6 * height))
    low, high = (
        float(page.evaluate(f"document.querySelectorAll(\"{AXIS} .grip\")[{end}].getAttribute('aria-valuenow')"))
        for end in (0, 1)
    )
    first, last = found.columns[0].ends
    assert first < low < high < last
    expected = [i for i, item in enumerate(found.designs) if low <= (item.values[0] or 0.0) <= high]
    assert 0 < len(expected) < len(found.designs)
    assert page.evaluate(LIT.format("parallel")) == expected
    assert page.evaluate(LIT.format("scatter")) == expected
    assert page.evaluate(ROWS) == expected
    assert page.evaluate(COUNT) == f"{len(expected)} of {len(found.designs)} designs selected."
    page.click(".choices button")
    assert page.evaluate(COUNT) == f"All {len(found.designs)} designs."
    assert len(page.evaluate(LIT.format("parallel"))) == len(found.designs)


def test_a_rectangle_in_the_scatter_is_two_ranges(page: Page) -> None:
    """Catches a rectangle that is upside down, or that the axes do not show."""
    x, y, width, height = page.box("svg.scatter .plane")
    page.drag((x + 0.4 * width, y + 0.05 * height), (x + 0.7 * width, y + 0.6 * height))
    chosen = page.evaluate(LIT.format("scatter"))
    assert 0 < len(chosen) < 61
    assert page.evaluate(LIT.format("parallel")) == chosen
    inside = page.evaluate(
        "[...document.querySelectorAll('svg.scatter [data-row]:not(.off)')].every(e => {"
        " const a = e.getBoundingClientRect(), x = (a.left + a.right) / 2, y = (a.top + a.bottom) / 2;"
        " const b = document.querySelector('svg.scatter rect.span').getBoundingClientRect();"
        " return x > b.left - 1 && x < b.right + 1 && y > b.top - 1 && y < b.bottom + 1; })"
    )
    assert inside is True
    assert page.evaluate("document.querySelectorAll('svg.parallel .grip[aria-valuetext=\"no limit\"]').length") == 4


def test_an_axis_is_brushed_by_keys(page: Page) -> None:
    """Catches a grip without a focus, and one whose keys go the wrong way."""
    page.evaluate(f'document.querySelectorAll("{AXIS} .grip")[0].focus()')
    page.key("PageUp", times=2)
    before = len(page.evaluate(LIT.format("parallel")))
    assert before < 61
    page.key("ArrowUp", times=3)
    assert len(page.evaluate(LIT.format("parallel"))) <= before
    assert "mm" in page.evaluate(f"document.querySelectorAll(\"{AXIS} .grip\")[0].getAttribute('aria-valuetext')")
    page.key("Escape")
    assert len(page.evaluate(LIT.format("parallel"))) == 61


def test_the_scatter_shows_other_columns(page: Page) -> None:
    """Catches marks that stay where they were, and the title of another axis."""
    place = "document.querySelector('svg.scatter [data-row=\"0\"]').getAttribute('transform')"
    before = page.evaluate(place)
    page.evaluate(
        "(() => { const s = document.querySelector('.choices select'); s.value = '1';"
        " s.dispatchEvent(new Event('change')); })()"
    )
    assert page.evaluate(place) != before
    assert "Back yoke thickness (mm)" in page.evaluate("document.querySelector('svg.scatter .ticks').textContent")


def test_values_are_read_off_a_curve(page: Page) -> None:
    """Catches a value that is not the one under the pointer, and keys that read another."""
    page.evaluate("document.getElementById('sweep-0-readout').closest('figure').scrollIntoView({block: 'center'})")
    figure = "document.getElementById('sweep-0-readout').closest('figure')"
    area = f"{figure}.querySelector('svg').getBoundingClientRect()"
    box = page.evaluate(f"['x', 'y', 'width', 'height'].map(key => {area}[key])")
    page.move(box[0] + 0.5 * box[2], box[1] + 0.5 * box[3])
    text = page.evaluate(f"{figure}.querySelector('.tip').innerText")
    found = re.search(r"ring width ([\d.]+) mm\s+force constant: ([\d.]+) N/A", text)
    assert found is not None
    rows = {f"{1e3 * row.values['actuator.mover.ring_width']:g}": row for row in a_content().sweeps[0].rows}
    assert float(found.group(2)) == pytest.approx(rows[found.group(1)].evaluation.performance.force_constant, rel=1e-3)
    page.evaluate(f"{figure}.querySelector('svg').focus()")
    page.key("Home")
    assert page.evaluate(f"{figure}.querySelector('svg').getAttribute('aria-valuetext')").startswith("ring width 0 mm")
    page.key("Escape")
    assert page.evaluate(f"{figure}.querySelector('.tip').hidden") is True


def test_the_field_is_read_under_a_probe(page: Page) -> None:
    """Catches a part, a place or a flux density of somewhere else."""
    figure = "document.getElementById('flux-chosen-readout').closest('figure')"
    page.evaluate(f"{figure}.scrollIntoView({{block: 'center'}})")
    page.evaluate(f"{figure}.querySelector('svg').focus()")
    page.key("ArrowRight", times=3)
    page.wait(f"!{figure}.querySelector('.tip').hidden && {figure}.querySelector('[role=status]').textContent !== ''")
    text = page.evaluate(f"{figure}.querySelector('[role=status]').textContent")
    assert re.search(r"\|B\| = [\d.]+ T; B_r = −?[\d.]+ T, B_z = −?[\d.]+ T; z = [\d.]+ mm, r = [\d.]+ mm", text)
    radius, size = (float(re.search(pattern, text).group(1)) for pattern in (r"r = ([\d.]+) mm", r"\|B\| = ([\d.]+)"))  # type: ignore[union-attr]
    field = a_content().flux_map
    assert field is not None
    z = float(re.search(r"z = ([\d.]+) mm", text).group(1))  # type: ignore[union-attr]
    near = ((field.r - radius * 1e-3) ** 2 + (field.z - z * 1e-3) ** 2).argmin()
    assert size == pytest.approx(field.flux_density[near], abs=0.15)


def test_without_scripts_the_page_is_whole(chromium: Chromium, report: Path) -> None:
    """Catches a picture or a table that only a script draws."""
    with chromium.open(report, scripts=False) as page:
        height = "document.querySelector('svg.parallel').getBoundingClientRect().height"
        assert page.evaluate(height) > 200
        assert page.evaluate("document.querySelectorAll('svg.scatter [data-row]').length") == 61
        assert page.complaints == []


def test_a_finger_brushes_and_reads(chromium: Chromium, report: Path) -> None:
    """Catches a gesture that the browser takes for scrolling, and a page wider than the telephone."""
    with chromium.open(report, width=390, height=844, touch=True) as page:
        x, y, width, height = page.box(f"{AXIS} .strip")
        page.touch([(x + width / 2, y + share * height) for share in (0.3, 0.4, 0.5, 0.6)])
        assert 0 < len(page.evaluate(LIT.format("parallel"))) < 61
        page.evaluate("document.getElementById('sweep-0-readout').closest('figure').scrollIntoView({block: 'center'})")
        figure = "document.getElementById('sweep-0-readout').closest('figure')"
        area = f"{figure}.querySelector('svg').getBoundingClientRect()"
        left, top, wide, high = page.evaluate(f"['x', 'y', 'width', 'height'].map(key => {area}[key])")
        page.touch([(left + 0.5 * wide, top + 0.6 * high)])
        assert "force constant" in page.evaluate(f"{figure}.querySelector('.tip').innerText")
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        assert page.complaints == []
