"""Damaged FEMM files through whole solves: figures or a sentence, whatever stands in them."""

from __future__ import annotations

import femm_fuzz

SEED = 20250611


def test_damaged_files_give_an_answer_or_one_sentence() -> None:
    """Catches any exception that is not ours, a warning of numpy's, a figure that is no number, and a deaf run."""
    kinds = []
    for number in range(150):
        item = femm_fuzz.mutant(SEED, number)
        try:
            kinds.append(femm_fuzz.outcome(item).kind)
        except Exception as error:
            raise AssertionError(f"file {number}, a damaged {item.name}") from error
    assert 15 < kinds.count("answer") < 120  # otherwise the damage is too great or too small to try anything
    assert kinds.count("MeshError") > 5


def test_a_number_gives_the_same_file_each_time() -> None:
    """Catches a run that cannot be repeated."""
    first, second = ([femm_fuzz.mutant(SEED, number) for number in range(40)] for _ in range(2))
    assert first == second
    assert len({item.text for item in first}) > 30
