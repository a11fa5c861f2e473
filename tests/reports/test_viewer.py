"""The live view's script is the one that its sources make, and the page carries the model in its picture's place."""

import base64
import dataclasses
import gzip
import hashlib
import json
import re
from pathlib import Path

import pytest

from fluxbore.reports import scripts, viewer
from fluxbore.reports.content import PartRow, ReportContent
from fluxbore.reports.page import render

ASSETS = Path(viewer.__file__).parent / "assets" / "viewer"
MODEL = b"glTF" + bytes(100)


@pytest.fixture(scope="module")
def shown(content: ReportContent) -> ReportContent:
    rows = (
        PartRow("rod <8>", "mover", "POM", "", 1e-6, 1e-3, number=1, part_number="A-001"),
        PartRow("carried along, not drawn", "mover", "", "", 0.0, 1e-3),
    )
    return dataclasses.replace(ReportContent(spec=content.spec), model=MODEL, parts=rows)


def test_the_script_is_built_from_the_sources_that_stand_beside_it() -> None:
    """Catches a source that was changed without building, and a package that was raised without."""
    sources = sorted((ASSETS / "source").glob("*.js"), key=lambda path: path.name)
    text = b"".join(path.read_bytes() for path in (*sources, ASSETS / "package.json", ASSETS / "package-lock.json"))
    first = (ASSETS / "viewer.js").read_text(encoding="utf-8").split("\n", 1)[0]
    assert first.endswith(f"sources {hashlib.sha256(text).hexdigest()}")


def test_the_script_is_light_and_comes_with_its_licence() -> None:
    assert (ASSETS / "viewer.js").stat().st_size < 600_000
    assert (ASSETS / "LICENSE.three.txt").read_text(encoding="utf-8").startswith("The MIT License")
    (script,) = scripts.load(viewer.SCRIPT)  # raises where it would not reach the browser whole
    assert "sourceMappingURL" not in script.text


def test_the_page_carries_the_model_and_allows_the_script(shown: ReportContent) -> None:
    page = render(shown)
    found = re.search(r'<script type="application/json" id="viewer-data">(.*?)</script>', page)
    assert found is not None
    data = json.loads(found[1])
    assert gzip.decompress(base64.b64decode(data["model"])) == MODEL
    (script,) = scripts.load(viewer.SCRIPT)
    assert script.digest in page.split("</head>")[0]
    assert '<tr id="part-1" data-part="1">' in page
    assert page.count("data-part=") == 1 + script.text.count("data-part=")


def test_without_a_model_there_is_neither_script_nor_data(content: ReportContent) -> None:
    page = render(ReportContent(spec=content.spec))
    assert "viewer-data" not in page
    assert len(page) < 300_000
