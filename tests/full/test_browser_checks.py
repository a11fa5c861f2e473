"""The checks of pages see what they are there to see: each finds its fault in a page that has it."""

from __future__ import annotations

from pathlib import Path

import pytest
from browser import axe, checks
from browser.chromium import Chromium

pytestmark = pytest.mark.full

PAGE = """<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>Faults</title>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; {script}">
<style>
.quiet {{ position: absolute; }} .wide {{ width: 900px; }} .scroll {{ overflow-x: auto; }}
.bare:focus {{ outline: none; }} .pale {{ color: #ccc; background: #fff; }}
@keyframes turn {{ to {{ translate: 1px; }} }} .turns {{ animation: turn 1s infinite; }}
@media (prefers-color-scheme: dark) {{ :root {{ --ink: #fff; }} }} :root {{ --ink: #000; }}
</style></head><body><main><h1>Faults</h1>
<div class="wide">wide</div><div class="scroll" tabindex="0"><table class="wide"><tr><td>cut</td></tr></table></div>
<a class="bare" href="#x">bare</a><button tabindex="-1">shut out</button><p class="pale">pale words</p>
<div class="turns">turns</div><img src="https://example.org/a.png"><a id="x" href="#x">last</a></main>
<script>console.error("told"); undefined.thing;</script></body></html>"""


@pytest.fixture(scope="module")
def faulty(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("page") / "faulty.html"
    path.write_text(PAGE.format(script="script-src 'unsafe-inline'; img-src *"), encoding="utf-8")
    return path


def test_faults_are_found(chromium: Chromium, faulty: Path) -> None:
    """Catches a check that passes whatever it looks at."""
    with chromium.open(faulty, width=390, height=800) as page:
        checks.unfold(page)
        assert page.requests == ["https://example.org/a.png"]
        assert any("told" in text for text in page.complaints)
        assert any("TypeError" in text for text in page.complaints)
        assert any("div.wide" in text for text in checks.beyond(page))
        assert not any("table" in text for text in checks.beyond(page)[1:])
        assert any("div.scroll" in text for text in checks.cut(page))
        order = checks.walk(page)
        assert [item["ring"] for item in order] == [True, False, True]
        assert checks.unreached(page, order[:-1]) == ["a#x “last”"]
        assert any("turns" in text for text in checks.moving(page))
        found = axe.violations(page)
        assert any(text.startswith("color-contrast") for text in found)
        assert any(text.startswith("image-alt") for text in found)


def test_violations_of_the_policy_are_complaints(chromium: Chromium, tmp_path: Path) -> None:
    """Catches a policy's violation that is taken for a word of the console."""
    path = tmp_path / "strict.html"
    path.write_text(PAGE.format(script=""), encoding="utf-8")
    with chromium.open(path) as page:
        page.settle()
        assert sum("Content Security Policy" in text for text in page.complaints) >= 2
