"""The kill test: twenty kills at random moments of a sweep and of a search, and some of a sweep by finite elements."""

import json
import sys
from pathlib import Path

import pytest

OPTIMIZE = Path(__file__).parents[1] / "optimize"
sys.path.insert(0, str(OPTIMIZE))

from kills import contents, journal, killed, lines, undisturbed  # noqa: E402

pytestmark = pytest.mark.full

SPEC = """\
[study]
objective = "maximise force_constant"

[[study.sweeps]]
name = "ring width"
axes = [{ key = "actuator.mover.ring_width", from = "0.5 mm", to = "4 mm", step = "0.5 mm" }]
"""


@pytest.mark.parametrize("what", ["sweep 25", "search 500"])
def test_twenty_kills_and_the_same_table(tmp_path, what):
    """Catches whatever survives a few kills by luck: a moment at which a record, a table or the folder is half done."""
    expected = undisturbed(tmp_path / "whole", what)
    story = killed(tmp_path / "killed", what, kills=20, seed=20)
    assert story.kills == 20
    assert contents(tmp_path / "killed") == expected
    assert len(story.computed) - len(set(story.computed)) <= 2 * 20, "only what was in flight"


def test_kills_of_a_sweep_by_finite_elements(tmp_path):
    """Catches figures that depend on which run computed them, to the last bit."""
    example = (OPTIMIZE.parents[1] / "examples" / "ipehla-fig6a.toml").read_text()
    spec = tmp_path / "spec.toml"
    spec.write_text(example[: example.index("[study]")] + SPEC)
    expected = undisturbed(tmp_path / "whole", str(spec))
    killed(tmp_path / "killed", str(spec), kills=4, seed=4)
    assert contents(tmp_path / "killed") == expected
    keys = [json.loads(line)["key"] for line in lines(journal(tmp_path / "killed"))]
    assert len(keys) == len(set(keys)) == 8, "nothing was recorded twice"
