"""A whole report's content, for the tests of its page."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from made_up_report import a_content

from fluxbore.reports.content import ReportContent


@pytest.fixture(scope="session")
def content() -> ReportContent:
    return a_content()


@pytest.fixture(scope="session")
def make_content() -> Callable[[str], ReportContent]:
    return a_content
