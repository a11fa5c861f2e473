"""The output folder: whose it is, and files that are either whole or not there."""

from __future__ import annotations

import contextlib
import json
import os
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from fluxbore.design.errors import OutputError
from fluxbore.design.spec import Spec

MARKER = ".fluxbore.json"
JOURNAL = "journal.jsonl"
OUTPUTS = ("results.csv", "design.toml", "report.html")
"""Results at the folder's top that belong to one specification; those of another one do not stay beside them."""

_PARTIAL = ".partial"


@dataclass(frozen=True, slots=True)
class Folder:
    """An output folder that is ours to write. ``resumed`` where the same specification was at work in it before."""

    path: Path
    resumed: bool

    @property
    def journal(self) -> Path:
        return self.path / JOURNAL

    def write(self, name: str, content: str | bytes) -> Path:
        """`write_atomic` of a file in this folder, or in a folder below it that is made where it is missing."""
        target = self.path / name
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise OutputError(f"{target.parent} cannot be written: {error.strerror or error}.") from error
        return write_atomic(target, content)


def open_folder(path: Path | str, spec: Spec, force: bool = False) -> Folder:
    """Take the folder for this specification's results; make it where there is none.

    Raises OutputError where the path is a file or cannot be written and, without ``force``, where the folder holds
    files of somebody else's or another specification's results. With ``force`` only our own outputs are replaced; no
    other file is touched.
    """
    path = Path(path)
    fingerprint = spec.fingerprint()
    if path.exists() and not path.is_dir():
        raise OutputError(f"{path} must be a folder to write the results in; it is a file.")
    try:
        path.mkdir(parents=True, exist_ok=True)
        names = {entry.name for entry in path.iterdir()}
    except OSError as error:
        raise OutputError(f"{path} cannot be written: {error.strerror or error}.") from error
    before = _fingerprint(path / MARKER)
    foreign = {name for name in names if not (name == MARKER or _is_partial(name))}
    resumed = before == fingerprint
    if not resumed and not force and (before is not None or foreign):
        whose = "the results of another specification" if before is not None else f"other files, such as {min(foreign)}"
        raise OutputError(
            f"{path} must be empty or hold results of this specification; it holds {whose} (see --force)."
        )
    if before is not None and not resumed:
        for name in OUTPUTS:
            _remove(path / name)
    for name in names:
        if _is_partial(name) and not _alive(name):
            _remove(path / name)
    content = {"fluxbore": _version(), "specification": fingerprint}
    # Written anew when resuming too: it shows at once whether the folder can be written.
    write_atomic(path / MARKER, json.dumps(content, indent=1) + "\n")
    return Folder(path, resumed)


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
    if process is None or os.name != "posix":  # elsewhere signal 0 would end the process
        return True
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True
    return process != os.getpid()


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
