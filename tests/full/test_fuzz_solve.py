"""A sample of the damaged files that `benchmarks/fuzz.py` solves by the thousand."""

from __future__ import annotations

import os

import femm_fuzz
import pytest

pytestmark = pytest.mark.full

SEED = 7
HUNDREDS = max(1, round(10 * float(os.environ.get("FLUXBORE_SAMPLE", "1"))))
"""Continuous integration takes one of them."""


@pytest.mark.parametrize("hundred", range(HUNDREDS))
def test_damaged_files_give_an_answer_or_one_sentence(hundred: int) -> None:
    """Catches any exception that is not ours, a warning of numpy's, and a figure that is no number."""
    for number in range(100 * hundred, 100 * hundred + 100):
        item = femm_fuzz.mutant(SEED, number)
        try:
            assert femm_fuzz.outcome(item).sentence
        except Exception as error:
            raise AssertionError(f"file {number}, a damaged {item.name}") from error
