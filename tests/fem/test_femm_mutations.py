"""Damaged FEMM files: a model or one sentence, and the damage is the same each time."""

import femm_mutations
import numpy as np
import pytest
from femm_example import MODEL, TEXT

from fluxbore.design.errors import FluxboreError
from fluxbore.fem.femm_reader import parse
from fluxbore.fem.femm_writer import write_text


def test_two_thousand_damaged_files_give_a_model_or_one_sentence() -> None:
    """Catches every exception that is not ours, and a model that cannot be written again."""
    rng = np.random.default_rng(20240607)
    texts = [TEXT, TEXT.replace("planar", "axisymmetric"), write_text(MODEL)]
    read = 0
    for number in range(2000):
        text = femm_mutations.mutate(texts[number % len(texts)], rng)
        try:
            model = parse(text, "model.fem")
        except FluxboreError as error:
            sentence = str(error)
            assert sentence.startswith("model.fem")
            assert sentence.endswith(".")
            assert sentence.isprintable()
            assert len(sentence) < 500
        else:
            read += 1
            assert parse(write_text(model), "model.fem") == model
    # Otherwise the damage is so great that nothing behind the reader is ever tried.
    assert 500 < read < 1800


@pytest.mark.parametrize("mutator", femm_mutations.MUTATORS)
def test_each_mutator_changes_files_the_same_way_each_time(mutator: femm_mutations.Mutator) -> None:
    """Catches a fuzz run that cannot be repeated, and a mutator that does nothing."""
    runs = [[mutator(TEXT, np.random.default_rng(seed)) for seed in range(20)] for _ in range(2)]
    assert runs[0] == runs[1]
    assert any(text != TEXT for text in runs[0])
    assert isinstance(mutator("", np.random.default_rng(0)), str)
