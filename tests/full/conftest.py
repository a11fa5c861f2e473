"""The browser that the long tests of pages share."""

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))

from browser.chromium import WHY_NOT, Chromium, find


@pytest.fixture(scope="session")
def chromium() -> Iterator[Chromium]:
    """A headless chromium without a network; tests that ask for it are skipped where there is none."""
    if find() is None:
        pytest.skip(WHY_NOT)
    with Chromium() as browser:
        yield browser
