"""Which CAD files of a folder are fluxbore's own: those it replaces and removes, others never."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
from pathlib import Path

from fluxbore.design.process import may_run

PARTS = "parts"
"""Name of the folder that holds a file for each part."""

NEW, OLD = "new", "old"
"""In a scratch folder: what is being written, and what it takes the place of."""

_HEADER = 8192
"""Bytes that hold the header, long names included."""

_OURS = re.compile(rb"FILE_NAME\s*\(.*'fluxbore(?: [^']*)?'\s*,\s*'[^']*'\s*\)\s*;", re.DOTALL)
"""FILE_NAME ends with the originating system and the authorisation (ISO 10303-21); a program that saves the file
again puts its own name there."""

_OURS_DXF = re.compile(rb"999\r?\nfluxbore(?: [^\n]*)?\n")
"""A comment before the first section; a program that saves the file again leaves it out."""

_SCRATCH = re.compile(r"\.step-(\d{1,9})-\w+")


def scratch_prefix() -> str:
    """How the name of this process's scratch folders begins."""
    return f".step-{os.getpid()}-"


def is_own(path: Path) -> bool:
    """Whether fluxbore wrote this file, by its header."""
    if path.suffix not in (".step", ".dxf") or not path.is_file():
        return False
    with path.open("rb") as file:
        head = file.read(_HEADER)
    return _OURS.search(head) is not None if path.suffix == ".step" else _OURS_DXF.match(head) is not None


def own_files(folder: Path, suffix: str = ".step") -> list[Path]:
    """Fluxbore's STEP files, or DXF files, in the folder itself; none where it does not exist."""
    return sorted(path for path in folder.glob(f"*{suffix}") if is_own(path))


def remove_own(folder: Path) -> None:
    """Remove the STEP and DXF files that fluxbore wrote into the folder, and the folder where that was all."""
    remove_stale(folder)
    for room in (folder / PARTS, folder):
        for path in (*own_files(room), *own_files(room, ".dxf")):
            path.unlink()
        with contextlib.suppress(OSError):  # somebody else's files are in it, or it does not exist
            room.rmdir()


def remove_stale(folder: Path) -> None:
    """Remove the scratch folders of processes that were killed; what is not fluxbore's own in them stays."""
    for scratch in folder.glob(".step-*"):
        name = _SCRATCH.fullmatch(scratch.name)
        if name is None or may_run(int(name[1])):
            continue
        shutil.rmtree(scratch / NEW, ignore_errors=True)
        with contextlib.suppress(OSError):
            for path in own_files(scratch / OLD):
                path.unlink()
            if (scratch / OLD).exists():
                (scratch / OLD).rmdir()
            scratch.rmdir()
