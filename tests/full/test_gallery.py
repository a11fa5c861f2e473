"""All of the validation gallery at the default accuracy: minutes, so only when asked for (-m full)."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases import CASES

_SPEC = importlib.util.spec_from_file_location(
    "quick_gallery", Path(__file__).parents[1] / "physics" / "test_gallery.py"
)
assert _SPEC is not None
assert _SPEC.loader is not None
quick = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(quick)

pytestmark = pytest.mark.full

each = pytest.mark.parametrize("name", [build.__name__ for build in CASES])


@each
def test_every_value_is_within_its_tolerance(name: str) -> None:
    """Catches any figure of a file more than 0.3 % (forces 0.5 %) from its exact value."""
    assert quick.solved(name).adapted.reached
    quick.check_values(name)


@each
def test_two_routes_to_a_force_and_its_reaction(name: str) -> None:
    """Catches routes more than 1 % apart, and a pair of bodies that would fly away: a rest of 1e-3."""
    quick.check_routes(name)


@each
def test_estimates_are_honest(name: str) -> None:
    """Catches an estimate that promises more than twice what holds."""
    quick.check_estimates(name)
