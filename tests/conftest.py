"""Settings of all tests."""

import os
import random
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest
from hypothesis import settings

# No test is timed: a busy machine is not a fault. In continuous integration the same examples come every time.
settings.register_profile("fluxbore", deadline=None, derandomize=bool(os.environ.get("CI")))
settings.load_profile("fluxbore")

# Modules of tests that several rooms share, such as actuators.py, are found by their plain name.
sys.path.insert(0, str(Path(__file__).parent))


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Of the long tests' files a seeded share (FLUXBORE_LONG, 0 to 1; FLUXBORE_SEED), where one is asked for."""
    share = float(os.environ.get("FLUXBORE_LONG", "1"))
    if share >= 1:
        return
    long = [item for item in items if item.get_closest_marker("full")]
    kept = _sample(sorted({item.path.as_posix() for item in long}), share)
    dropped = [item for item in long if item.path.as_posix() not in kept]
    config.hook.pytest_deselected(items=dropped)
    items[:] = [item for item in items if item not in set(dropped)]


def _sample(files: Sequence[str], share: float) -> set[str]:
    """Of names: the same choice for the same files, wherever the checkout lies."""
    names = {Path(file).relative_to(Path(__file__).parent).as_posix(): file for file in files}
    seed = int(os.environ.get("FLUXBORE_SEED", "1"))
    chosen = random.Random(seed).sample(sorted(names), round(share * len(names)))
    return {names[name] for name in chosen}
