"""A few kills of a sweep and of a search (all of them in tests/full/test_kills.py): nothing is lost or done twice."""

import pytest
from kills import contents, killed, undisturbed


def test_a_killed_sweep_ends_with_the_same_table(tmp_path):
    """Catches a lost or doubled row, a half-written table, and a recorded design computed again."""
    expected = undisturbed(tmp_path / "whole", "sweep 9")
    story = killed(tmp_path / "killed", "sweep 9", kills=3, seed=1)
    assert contents(tmp_path / "killed") == expected
    assert len(set(story.computed)) == 9 * 9 - 1 + 4  # one corner cannot be built
    assert len(story.computed) - len(set(story.computed)) <= 2 * story.kills, "only what was in flight"


@pytest.mark.full
def test_a_killed_search_replays_to_the_same_table(tmp_path):
    """Catches a search that takes another way after a kill, and designs of the way so far computed again."""
    expected = undisturbed(tmp_path / "whole", "search 80")
    story = killed(tmp_path / "killed", "search 80", kills=2, seed=2)
    assert contents(tmp_path / "killed") == expected
    assert len(story.computed) - len(set(story.computed)) <= 2 * story.kills
