"""A few random lead screws by both routes: figures, or one sentence; `tests/full` tries many."""

import pytest
from lead_screw_random import outcome


@pytest.mark.parametrize("seed", range(1, 4))
def test_a_random_screw_has_figures_or_a_reason(seed: int) -> None:
    """A traceback, a warning, or a figure that is no number, where any key is far from the example's."""
    outcome(seed)
