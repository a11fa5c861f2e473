"""The table of the electro-hydrostatic actuator's published figures, computed again (-m full)."""

import runpy
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[2] / "docs" / "validation" / "prehydra.py"

pytestmark = pytest.mark.full


def test_the_table_is_the_programs_and_every_limit_holds(monkeypatch: pytest.MonkeyPatch) -> None:
    """A figure that moved while the page did not, or one that is beyond its limit now."""
    monkeypatch.setattr(sys, "argv", [str(SCRIPT), "--check"])
    with pytest.raises(SystemExit) as end:
        runpy.run_path(str(SCRIPT), run_name="__main__")
    assert end.value.code == 0
