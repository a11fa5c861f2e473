"""The house: which names stand at the top level, and how the rooms are reached."""

import shutil
import subprocess
from pathlib import Path

import pytest

TOP = Path(__file__).resolve().parents[1]
ROOMS = ["design", "fem", "geometry", "optimize", "reports"]
PAGES = ["README.md", "LICENSE", "CONTRIBUTING.md", "docs"]
ALLOWED = {*ROOMS, *PAGES, "pyproject.toml", "src", "tests", "examples", "benchmarks"}


def _tracked() -> list[str]:
    """The tracked files: what a user's own runs left in the checkout is theirs."""
    if not shutil.which("git") or not (TOP / ".git").exists():
        pytest.skip("needs git and a clone")
    command = ["git", "-c", f"safe.directory={TOP}", "ls-files", "-z"]
    return subprocess.run(command, cwd=TOP, capture_output=True, text=True, check=True).stdout.split("\0")[:-1]


def test_the_top_level_holds_only_the_agreed_names() -> None:
    """Catches a new folder or file beside the rooms: the layout is what a newcomer learns first."""
    names = {name.split("/")[0] for name in _tracked()}
    assert {name for name in names if not name.startswith(".")} <= ALLOWED


def test_each_room_is_one_relative_link_in_the_package() -> None:
    """Catches an absolute link, which works on one machine only, and a copy, which goes stale."""
    for room in ROOMS:
        link = TOP / "src" / "fluxbore" / room
        assert link.is_symlink()
        assert str(link.readlink()) == f"../../{room}"


def test_each_folder_of_modules_is_a_package() -> None:
    """Catches a forgotten __init__.py: the folder still imports, but import-linter and mypy pass it by unseen."""
    folders = {(TOP / name).parent for name in _tracked() if name.endswith(".py") and name.split("/")[0] in ROOMS}
    assert [str(folder) for folder in sorted(folders) if not (folder / "__init__.py").exists()] == []


def test_the_lock_files_name_no_index_and_hash_everything() -> None:
    """Catches a lock that only its maker's network can use, or that a tampered package would pass."""
    for file in sorted((TOP / ".ci").glob("requirements*.lock")):
        text = file.read_text()
        assert "://" not in text
        assert "--index-url" not in text
        pins = text.replace("\\\n", "").splitlines()
        assert [
            line for line in pins if line and not line.lstrip().startswith("#") and "--hash=sha256:" not in line
        ] == []
