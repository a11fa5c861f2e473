"""The output folder: whose it is, and files that are either whole or not there."""

from __future__ import annotations

import contextlib
import json
import os
from collections.abc import Iterable
from dataclasses import dataclass, replace
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from types import TracebackType
from typing import Self

from fluxbore.design.errors import FluxboreError, OutputError
from fluxbore.design.process import may_run
from fluxbore.design.spec import Spec
from fluxbore.geometry import own_files
from fluxbore.optimize.journal import Journal

MARKER = ".fluxbore.json"
JOURNAL = "journal.jsonl"
OUTPUTS = (
    "results.csv",
    "results.parquet",
    "front.csv",
    "tolerance.csv",
    "traces.parquet",
    "figures.json",
    "design.toml",
    "report.html",
)
"""Results at the folder's top that belong to one specification; those of another one do not stay beside them."""

CAD = "cad"
"""The folder of the CAD files, which belong to one specification as the `OUTPUTS` do."""

_PARTIAL = ".partial"


@dataclass(frozen=True, slots=True)
class Folder:
    """An output folder that is ours to write, until its journal is closed. Use it as a context manager.

    resumed : whether the same specification was at work in it before. made : the folders that were made for it, the
    innermost first.
    """

    path: Path
    resumed: bool
    journal: Journal
    made: tuple[Path, ...] = ()

    def write(self, name: str, content: str | bytes) -> Path:
        """`write_atomic` of a file in this folder, or in a folder below it that is made where it is missing."""
        target = self.path / name
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise OutputError(f"{target.parent} cannot be written: {error.strerror or error}.") from error
        return write_atomic(target, content)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if not self.made or not isinstance(error, FluxboreError):
            self.journal.close()
            return
        # Whatever was asked for could not even begin: without a record, nothing of it stays.
        self.journal.discard()
        if {entry.name for entry in self.path.iterdir()} == {MARKER}:
            with contextlib.suppress(OSError):
                (self.path / MARKER).unlink()
            _remove_empty(self.made)


def _remove_empty(folders: Iterable[Path]) -> None:
    for folder in folders:
        with contextlib.suppress(OSError):  # not made after all, or no longer empty
            folder.rmdir()


def open_folder(path: Path | str, spec: Spec, force: bool = False) -> Folder:
    """Take the folder for this specification's results; make it where there is none.

    Raises OutputError where the path is a file or cannot be written, where another run is at work in the folder and,
    without ``force``, where it holds files of somebody else's or another specification's results; then everything is
    as it was. With ``force`` only our own outputs are replaced; no other file is touched.
    """
    path = Path(path)
    try:
        if path.exists() and not path.is_dir():
            raise OutputError(f"{path} must be a folder to write the results in; it is a file.")
        made = [folder for folder in (path, *path.parents) if not folder.exists()]
        try:
            path.mkdir(parents=True, exist_ok=True)
            return replace(_take(path, spec.fingerprint(), force), made=tuple(made))
        except BaseException:
            _remove_empty(made)
            raise
    except OSError as error:
        raise OutputError(f"{path} cannot be written: {error.strerror or error}.") from error


def _take(path: Path, fingerprint: str, force: bool) -> Folder:
    """Lock first, then judge whose the folder is, then clear away what does not belong in it, then mark it."""
    journal = Journal(path / JOURNAL, read=False)
    try:
        names = {entry.name for entry in path.iterdir()}
        before = _fingerprint(path / MARKER)
        resumed = before == fingerprint
        if not resumed and not force:
            _refuse_others(path, names, before)
        journal.read()
        if before is not None and not resumed:
            for name in OUTPUTS:
                _remove(path / name)
            own_files.remove(path / CAD)
        for name in names:
            if _is_partial(name) and not _alive(name):
                _remove(path / name)
        content = {"fluxbore": _version(), "specification": fingerprint}
        # Written anew when resuming too: it shows at once whether the folder can be written.
        write_atomic(path / MARKER, json.dumps(content, indent=1) + "\n")
    except BaseException:
        journal.discard()
        raise
    return Folder(path, resumed, journal)


def _refuse_others(path: Path, names: set[str], before: str | None) -> None:
    """Raise OutputError where the folder is not free. An empty journal is what a kill leaves before the marker."""
    foreign = {name for name in names if not (name == MARKER or _is_partial(name))}
    if JOURNAL in foreign and (path / JOURNAL).stat().st_size == 0:
        foreign.remove(JOURNAL)
    if before is None and not foreign:
        return
    whose = "the results of another specification" if before is not None else f"other files, such as {min(foreign)}"
    raise OutputError(f"{path} must be empty or hold results of this specification; it holds {whose} (see --force).")


def write_atomic(path: Path | str, content: str | bytes) -> Path:
    """Write beside the target, force to the disk, rename: whoever looks finds the old file or the new one, whole.

    Raises OutputError; the target is then as it was.
    """
    path = Path(path)
    data = content.encode() if isinstance(content, str) else content
    beside = path.with_name(f".{path.name}.{os.getpid()}{_PARTIAL}")
    try:
        with beside.open("wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        beside.replace(path)
    except OSError as error:
        with contextlib.suppress(OSError):
            beside.unlink(missing_ok=True)
        raise OutputError(f"{path} cannot be written: {error.strerror or error}.") from error
    except BaseException:
        with contextlib.suppress(OSError):
            beside.unlink(missing_ok=True)
        raise
    return path


def _is_partial(name: str) -> bool:
    """Whether the name is one of `write_atomic`'s, left by a kill or still being written."""
    return name.startswith(".") and name.endswith(_PARTIAL) and _writer(name) is not None


def _writer(name: str) -> int | None:
    number = name.removesuffix(_PARTIAL).rpartition(".")[2]
    return int(number) if number.isascii() and number.isdigit() and len(number) < 10 else None


def _alive(name: str) -> bool:
    """Whether the process that wrote this partial file may still be at it."""
    process = _writer(name)
    return process is None or (may_run(process) and process != os.getpid())


def _fingerprint(marker: Path) -> str | None:
    """The hash in the marker; an empty text where the marker is damaged, None where there is none."""
    try:
        content = json.loads(marker.read_bytes())
        return str(content["specification"])
    except FileNotFoundError:
        return None
    except (OSError, ValueError, KeyError, TypeError):
        return ""


def _remove(path: Path) -> None:
    try:
        path.unlink(missing_ok=True)
    except OSError as error:
        raise OutputError(f"{path} cannot be replaced: {error.strerror or error}.") from error


def _version() -> str:
    try:
        return version("fluxbore")
    except PackageNotFoundError:
        return "unknown"
