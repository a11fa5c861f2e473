"""The page's scripts: exactly those of the repository may run, and nothing of a specification can become one."""

from __future__ import annotations

import base64
import hashlib
import html
import json
import re

import pytest

from fluxbore.reports.content import ReportContent
from fluxbore.reports.page import render
from fluxbore.reports.scripts import Data, load, policy, script


@pytest.fixture(scope="module")
def page(content: ReportContent) -> str:
    return render(ReportContent(spec=content.spec, search=content.search))


def test_the_policy_names_exactly_the_scripts_of_the_page(page: str) -> None:
    """Catches a script that the browser would refuse, one that is allowed but absent, and an open policy."""
    found = re.search(r'http-equiv="Content-Security-Policy" content="([^"]+)"', page)
    assert found is not None
    rules = dict(rule.strip().split(" ", 1) for rule in html.unescape(found.group(1)).split(";"))
    assert rules["default-src"] == "'none'"
    texts = re.findall(r"<script>(.*?)</script>", page, re.DOTALL)
    assert texts
    digests = [base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() for text in texts]
    assert rules["script-src"].split() == [f"'sha256-{digest}'" for digest in digests]
    assert "unsafe" not in rules["script-src"]


def test_every_other_script_element_is_data(page: str) -> None:
    """Catches a script that the policy's hashes do not cover, and markup with a handler of events."""
    assert set(re.findall(r"<script[^>]*>", page)) <= {
        "<script>",
        *re.findall(r'<script type="application/json" id="[a-z-]+">', page),
    }
    outside = re.sub(r"<(script|style)[^>]*>.*?</\1>", "", page, flags=re.DOTALL)
    assert not re.search(r"<[^>]+\son[a-z]+\s*=", outside)
    assert "javascript:" not in outside


def test_data_cannot_end_its_element() -> None:
    """Catches a text of a specification that closes the element of the data and goes on as markup."""
    value = {"name": "</script><script>alert(1)</script><!--", "line": "a\u2028b", "number": 0.1}
    text = Data("rows", value).text
    assert "<" not in text
    assert "\u2028" not in text
    assert json.loads(text) == value


def test_a_number_that_is_none_is_refused_as_data() -> None:
    """Catches NaN in the data, which no browser can read."""
    with pytest.raises(ValueError, match="JSON"):
        _ = Data("rows", float("nan")).text


@pytest.mark.parametrize("text", ["a = '</SCRIPT>'", "b = '<!--'", "c = 1\r\n"])
def test_a_script_that_would_not_arrive_whole_is_refused(text: str) -> None:
    """Catches a source whose hash is not that of what the browser sees."""
    with pytest.raises(ValueError, match=r"odd\.js"):
        script("odd.js", text)


def test_the_policy_without_scripts_allows_none() -> None:
    """Catches an empty list of sources, which some browsers read as no rule."""
    assert "script-src" not in policy(())
    assert policy(load("page.js")).count("sha256-") == 1
