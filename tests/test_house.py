"""The house: which names stand at the top level, and how the rooms are reached."""

import subprocess
from pathlib import Path

TOP = Path(__file__).resolve().parents[1]
ROOMS = ["design", "fem", "geometry", "optimize", "reports"]
PAGES = ["README.md", "LICENSE", "CONTRIBUTING.md", "docs"]
ALLOWED = {*ROOMS, *PAGES, "pyproject.toml", "src", "tests", "examples", "benchmarks"}


def test_the_top_level_holds_only_the_agreed_names() -> None:
    """Catches a new folder or file beside the rooms: the layout is what a newcomer learns first."""
    listed = subprocess.run(["git", "ls-files"], cwd=TOP, capture_output=True, text=True, check=True).stdout
    names = {line.split("/")[0] for line in listed.splitlines()}
    assert {name for name in names if not name.startswith(".")} <= ALLOWED


def test_each_room_is_one_relative_link_in_the_package() -> None:
    """Catches an absolute link, which works on one machine only, and a copy, which goes stale."""
    for room in ROOMS:
        link = TOP / "src" / "fluxbore" / room
        assert link.is_symlink()
        assert str(link.readlink()) == f"../../{room}"
