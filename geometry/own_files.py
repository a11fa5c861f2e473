"""A folder's files that are fluxbore's own: put in place together, replaced and removed later; others never.

A hidden list keeps each file's SHA-256. A file that somebody changed since is no longer fluxbore's; so is one that is
not in the list. In a folder of an earlier version, without a list, STEP and DXF files are told by their headers.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import re
import shutil
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from fluxbore.design.errors import OutputError
from fluxbore.design.process import may_run
from fluxbore.geometry.file_names import PARTS

LIST = ".fluxbore-files.json"

Contents = Mapping[str, str | bytes]
"""Name below the folder -> what the file holds."""

_SCRATCH = re.compile(r"\.(?:fluxbore|step)-(\d{1,9})-\w+")

_HEADER = 8192
"""Bytes that hold the header, long names included."""

_OURS = re.compile(rb"FILE_NAME\s*\(.*'fluxbore(?: [^']*)?'\s*,\s*'[^']*'\s*\)\s*;", re.DOTALL)
"""FILE_NAME ends with the originating system and the authorisation (ISO 10303-21); a program that saves the file
again puts its own name there."""

_OURS_DXF = re.compile(rb"999\r?\nfluxbore(?: [^\n]*)?\n")
"""A comment before the first section; a program that saves the file again leaves it out."""


@dataclass(slots=True)
class _Listed:
    """What the list says. design : whose files they are. files, coming : name -> format and hash; ``coming`` is what a
    run was about to put in place, which counts as well where that run was killed."""

    design: str = ""
    files: dict[str, tuple[str, str]] = field(default_factory=dict)
    coming: dict[str, tuple[str, str]] = field(default_factory=dict)

    def text(self) -> str:
        return json.dumps({"design": self.design, "files": self.files, "coming": self.coming}, indent=1) + "\n"


def put(folder: Path, made: Mapping[str, Contents], design: str, force: bool = False) -> list[Path]:
    """Write the files of some formats, all of them or none, and remove fluxbore's own that they take the place of.

    made : contents by format. design : whose they are; of another design all files go, of the same one those of these
    formats. Raises OutputError where the folder cannot be written and, without ``force``, where a file that somebody
    made or changed has the name of one of these.
    """
    contents = {name: content for files in made.values() for name, content in files.items()}
    try:
        folder.mkdir(parents=True, exist_ok=True)
        remove_stale(folder)
        before = _listed(folder)
        for name in contents:
            if not force and (folder / name).exists() and not _is_own(folder, name, before):
                raise OutputError(
                    f'"{folder / name}" must be as fluxbore wrote it to be replaced; somebody made or changed it '
                    "(see --force)."
                )
        coming = {
            name: (form, _hash(_bytes(content))) for form, files in made.items() for name, content in files.items()
        }
        old = {**before.files, **before.coming}
        kept = {name: told for name, told in old.items() if before.design == design and told[0] not in made}
        stale = [name for name in _own_names(folder, before) if name not in contents and name not in kept]
        with tempfile.TemporaryDirectory(prefix=f".fluxbore-{os.getpid()}-", dir=folder) as scratch:
            new = Path(scratch) / "new"
            for name, content in contents.items():
                (new / name).parent.mkdir(parents=True, exist_ok=True)
                (new / name).write_bytes(_bytes(content))
            _write_list(folder, _Listed(before.design, before.files, {**before.coming, **coming}))
            _exchange(folder, new, Path(scratch) / "old", list(contents))
        for name in stale:
            (folder / name).unlink(missing_ok=True)
        _write_list(folder, _Listed(design, {**kept, **coming}))
        _remove_empty(folder / PARTS)
    except OSError as error:
        raise OutputError(
            f'"{folder}" must be a folder that can be written; got: {error.strerror or error}.'
        ) from error
    return [folder / name for name in contents]


def remove(folder: Path) -> None:
    """Remove the files that fluxbore put into the folder, and the folder where that was all."""
    if not folder.is_dir():
        return
    remove_stale(folder)
    for name in _own_names(folder, _listed(folder)):
        (folder / name).unlink()
    (folder / LIST).unlink(missing_ok=True)
    _remove_empty(folder / PARTS)
    _remove_empty(folder)


def remove_stale(folder: Path) -> None:
    """Remove the scratch folders of processes that were killed."""
    for scratch in folder.glob(".*-*"):
        name = _SCRATCH.fullmatch(scratch.name)
        if name is not None and not may_run(int(name[1])):
            shutil.rmtree(scratch, ignore_errors=True)


def _exchange(folder: Path, new: Path, old: Path, names: list[str]) -> None:
    """Put finished files in place one by one; what cannot be finished is undone."""
    done: list[tuple[Path, Path]] = []
    try:
        for name in names:
            target, aside = folder / name, old / name
            target.parent.mkdir(parents=True, exist_ok=True)
            if target.exists():
                aside.parent.mkdir(parents=True, exist_ok=True)
                target.replace(aside)
            done.append((target, aside))
            (new / name).replace(target)
    except OSError:
        for target, aside in reversed(done):
            with contextlib.suppress(OSError):
                if aside.exists():
                    aside.replace(target)
                else:
                    target.unlink(missing_ok=True)
        _remove_empty(folder / PARTS)
        raise


def _own_names(folder: Path, listed: _Listed) -> list[str]:
    """Of files that are there and fluxbore's own."""
    names = {**listed.files, **listed.coming} if (folder / LIST).exists() else _by_header(folder)
    return [name for name in names if _is_own(folder, name, listed)]


def _by_header(folder: Path) -> list[str]:
    """Names of STEP and DXF files in the folder and its parts."""
    found = (path for room in (folder, folder / PARTS) for path in room.glob("*"))
    return sorted(path.relative_to(folder).as_posix() for path in found if path.suffix in (".step", ".dxf"))


def _is_own(folder: Path, name: str, listed: _Listed) -> bool:
    path = folder / name
    if not path.is_file() or path.is_symlink():
        return False
    known = [told[name][1] for told in (listed.files, listed.coming) if name in told]
    if known or (folder / LIST).exists():
        return bool(known) and _hash(path.read_bytes()) in known
    with path.open("rb") as file:
        head = file.read(_HEADER)
    return _OURS.search(head) is not None if path.suffix == ".step" else _OURS_DXF.match(head) is not None


def _listed(folder: Path) -> _Listed:
    """The folder's list; an empty one where there is none, or where it is damaged: then no file is touched."""
    try:
        content = json.loads((folder / LIST).read_bytes())
        files, coming = (
            {str(name): (str(told[0]), str(told[1])) for name, told in content[key].items() if _is_below(name)}
            for key in ("files", "coming")
        )
        return _Listed(str(content["design"]), files, coming)
    except FileNotFoundError:
        return _Listed()
    except (ValueError, KeyError, TypeError, AttributeError, IndexError):
        return _Listed()


def _is_below(name: str) -> bool:
    """Whether a name of the list stays in the folder, whoever wrote the list."""
    path = Path(name)
    return not path.is_absolute() and ".." not in path.parts


def _write_list(folder: Path, listed: _Listed) -> None:
    beside = folder / f"{LIST}.{os.getpid()}.partial"
    beside.write_text(listed.text(), encoding="utf-8")
    beside.replace(folder / LIST)


def _remove_empty(folder: Path) -> None:
    with contextlib.suppress(OSError):  # somebody else's files are in it, or it does not exist
        folder.rmdir()


def _bytes(content: str | bytes) -> bytes:
    return content.encode() if isinstance(content, str) else content


def _hash(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
