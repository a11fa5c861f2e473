"""Kills a run again and again at seeded random moments and lets it go on, until it ends."""

import json
import os
import random
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import toy

SCRIPT = Path(__file__).with_name("sweep_script.py")
RESULTS = ("results.csv", "results.parquet")


@dataclass
class Story:
    """What became of a run: how often it was killed, and which designs' figures were computed, in order."""

    kills: int = 0
    computed: list[str] = field(default_factory=list)


def run(folder: Path, what: str, trace: Path) -> subprocess.Popen:
    path = os.pathsep.join(part for part in sys.path if part)
    return subprocess.Popen(
        [sys.executable, str(SCRIPT), str(folder), what],
        env=os.environ | {"TOY_LOG": str(trace), "PYTHONPATH": path},
        stderr=subprocess.PIPE,
    )


def undisturbed(folder: Path, what: str) -> dict[str, bytes]:
    """The results of a run that nothing disturbs."""
    _, errors = (process := run(folder, what, folder.with_name(f"{folder.name}.trace"))).communicate()
    assert process.returncode == 0, errors.decode()
    return contents(folder)


def contents(folder: Path) -> dict[str, bytes]:
    return {name: (folder / name).read_bytes() for name in RESULTS}


def killed(folder: Path, what: str, kills: int, seed: int) -> Story:
    """Kill the run until it was killed so often, half of the times at a random moment, half soon after a new record.

    Asserts after each run that no design was computed which stood in the journal before it. Ends with an undisturbed
    run, and fails where the run ends by itself before the last kill.
    """
    chance, trace, story = random.Random(seed), folder.with_name(f"{folder.name}.trace"), Story()
    while True:
        before, recorded = len(lines(trace)), records(folder)
        process = run(folder, what, trace)
        if story.kills < kills:
            if story.kills % 2:
                time.sleep(chance.uniform(0.0, 0.8))
            else:
                goal = len(lines(journal(folder))) + 1
                while process.poll() is None and len(lines(journal(folder))) < goal:
                    time.sleep(0.001)
                time.sleep(chance.uniform(0.0, 0.03))
            process.send_signal(signal.SIGKILL)
        _, errors = process.communicate()
        computed = lines(trace)[before:]
        assert [line for line in computed if line in recorded] == [], "what stood in the journal was computed again"
        story.computed += computed
        if process.returncode == 0:
            assert story.kills == kills, f"the run ended after {story.kills} kills"
            return story
        assert process.returncode == -signal.SIGKILL, errors.decode()
        story.kills += 1


def journal(folder: Path) -> Path:
    return folder / "journal.jsonl"


def lines(path: Path) -> list[str]:
    """The whole lines of a file that may be growing or torn."""
    return path.read_text().split("\n")[:-1] if path.exists() else []


def records(folder: Path) -> set[str]:
    """The designs of the journal as the toy traces them: any line of it that is whole counts."""
    found = set()
    for line in lines(journal(folder)):
        values = {toy.X: 1.0, toy.Y: 1.0, toy.N: 1, **json.loads(line)["values"]}
        found.add(f"{values[toy.X]!r} {values[toy.Y]!r} {int(values[toy.N])}")
    return found
