"""The crash-proof store of evaluated designs and simulations: an append-only file of JSON lines.

A record is written with one call and forced to the disk before the design counts as done, so that a kill at any moment
costs at most the record in flight. What the kill tore off is found and cut away when the journal is next opened.
"""

from __future__ import annotations

import contextlib
import json
import math
import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from fluxbore.design.errors import OutputError
from fluxbore.optimize.evaluation import FAILED, OK, Evaluation, from_plain, to_plain


class Journal:
    """The open journal of one folder; its single writer. Use it as a context manager.

    made : whether the file did not exist before.

    Only the place of each record is kept in memory, not the record, so that a long study stays small.
    """

    def __init__(self, path: Path | str, *, read: bool = True) -> None:
        """Open or create the file. OutputError where it cannot be written or another run holds it.

        read : without it the file is locked and not touched, until `read` or `discard` is called.
        """
        self.path = Path(path)
        self._places: dict[str, tuple[int, int]] = {}
        self._plain: dict[str, tuple[int, int]] = {}  # records with derivatives, by their keys without
        self._notes: dict[str, tuple[int, int]] = {}  # of anything else than a design's evaluation
        try:
            self._file, self.made = _open_locked(self.path)
        except OSError as error:
            raise OutputError(f"{self.path} cannot be written: {error.strerror or error}.") from error
        if read:
            self.read()

    def read(self) -> None:
        """Index the records and mend a torn end. Closes the file and raises OutputError where it cannot be read."""
        try:
            self._index()
            _sync_folder(self.path.parent)
        except BaseException as error:
            self.close()
            if isinstance(error, OSError):
                raise OutputError(f"{self.path} cannot be read: {error.strerror or error}.") from error
            raise

    def __len__(self) -> int:
        """How many designs can be taken from the journal."""
        return len(self._places)

    def __contains__(self, key: str) -> bool:
        return key in self._places or key in self._plain

    def get(self, key: str) -> Evaluation | None:
        """The evaluation recorded under ``key``. A design that failed by a crash is not given, so it is tried again.

        A sound design that is recorded with derivatives only is given under its key without them as if there were none.
        """
        place = self._places.get(key)
        if place is not None:
            record = _record(self._bytes(*place))
            return None if record is None else record[1]
        place = self._plain.get(key)
        record = None if place is None else _record(self._bytes(*place))
        return None if record is None else replace(record[1], gradient=None, norms=None)

    def put(
        self, key: str, kind: str, values: Mapping[str, Any], evaluation: Evaluation, plain: str | None = None
    ) -> Evaluation:
        """Record one design on the disk; returns the evaluation exactly as `get` will give it.

        kind : what asked for it ("sweep", "search"); values : the moved keys' values, for whoever reads the file.
        plain : the design's key without the derivatives that ``key`` asks for.
        Raises OutputError where the disk is full or gone.
        """
        record = {"key": key, "kind": kind, "values": strict(values), "evaluation": strict(to_plain(evaluation))}
        if plain is not None:
            record["plain"] = plain
        self._remember(key, plain, evaluation.status, self._append(record))
        return _evaluation(record)

    def noted(self, key: str) -> Any:
        """What `note` recorded under ``key``; None where nothing was."""
        place = self._notes.get(key)
        found = None if place is None else _note(self._bytes(*place))
        return None if found is None else found[1]

    def note(self, key: str, kind: str, content: Mapping[str, Any]) -> Any:
        """Record another result than a design's evaluation, as JSON has it; returns it exactly as `noted` will.

        kind : what it is of ("simulation"), for whoever reads the file. Raises OutputError as `put` does.
        """
        record = {"key": key, "kind": kind, "content": strict(content)}
        self._notes[key] = self._append(record)
        return record["content"]

    def _append(self, record: Mapping[str, Any]) -> tuple[int, int]:
        """Force one line to the disk; where it stands."""
        line = json.dumps(record, allow_nan=False, separators=(",", ":")).encode() + b"\n"
        begin = os.fstat(self._file).st_size
        try:
            rest = memoryview(line)
            while rest:
                rest = rest[os.write(self._file, rest) :]
            os.fsync(self._file)
        except OSError as error:
            # Half a line would spoil the next record as well.
            os.ftruncate(self._file, begin)
            raise OutputError(f"{self.path} cannot be written: {error.strerror or error}.") from error
        return begin, len(line)

    def _remember(self, key: str, plain: object, status: str, place: tuple[int, int]) -> None:
        if status != FAILED:
            self._places[key] = place
        # What failed with derivatives may succeed without.
        if status == OK and isinstance(plain, str):
            self._plain[plain] = place

    def close(self) -> None:
        """Release the file and its lock; closing twice does nothing."""
        if self._file >= 0:
            os.close(self._file)
            self._file = -1

    def discard(self) -> None:
        """Close; the file goes again where this opening made it and nothing stands in it."""
        if self._file >= 0 and self.made and os.fstat(self._file).st_size == 0:
            with contextlib.suppress(OSError):  # some systems keep a file that is open
                self.path.unlink()
        self.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.discard()

    def _index(self) -> None:
        """Index the records; cut off a torn last line. A line that is damaged otherwise is passed over."""
        begin = 0
        with open(self._file, "rb", closefd=False) as file:
            for line in file:
                record = _record(line)
                note = None if record is not None else _note(line)
                whole = line.endswith(b"\n")
                if record is not None:
                    self._remember(record[0], record[2], record[1].status, (begin, len(line)))
                if note is not None:
                    self._notes[note[0]] = (begin, len(line))
                if not whole and (record is not None or note is not None):
                    os.write(self._file, b"\n")  # only the line's end was torn off
                elif not whole:
                    os.ftruncate(self._file, begin)
                begin += len(line)

    def _bytes(self, begin: int, length: int) -> bytes:
        with open(self._file, "rb", closefd=False) as file:
            file.seek(begin)
            return file.read(length)


def _record(line: bytes) -> tuple[str, Evaluation, object] | None:
    """Key, evaluation and key without derivatives of a line, or None: no proper prefix of a JSON object is one."""
    try:
        record = json.loads(line)
        key, evaluation, plain = record["key"], _evaluation(record), record.get("plain")
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        return None
    return (key, evaluation, plain) if isinstance(key, str) and isinstance(evaluation.status, str) else None


def _note(line: bytes) -> tuple[str, Any] | None:
    """Key and content of a line that `Journal.note` wrote, or None."""
    try:
        record = json.loads(line)
        key, content = record["key"], record["content"]
    except (ValueError, TypeError, KeyError, RecursionError):
        return None
    return (key, content) if isinstance(key, str) else None


def _evaluation(record: Mapping[str, Any]) -> Evaluation:
    plain = record["evaluation"]
    positions = [{name: math.nan if v is None else v for name, v in item.items()} for item in plain["positions"]]
    return from_plain({**plain, "positions": positions})


def settled(evaluation: Evaluation) -> Evaluation:
    """The evaluation as a journal would give it back, so that a run with one and a run without see the same."""
    return _evaluation({"evaluation": strict(to_plain(evaluation))})


def strict(value: Any) -> Any:
    """The value with null for what is not finite: JSON has no NaN. Finite floats keep every bit (repr)."""
    if isinstance(value, float):
        return float(value) if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {name: strict(item) for name, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [strict(item) for item in value]
    return strict(value.item()) if hasattr(value, "item") else value  # numpy's numbers are Python's here


def _open_locked(path: Path) -> tuple[int, bool]:
    """The open file with its lock, and whether it was made just now."""
    while True:
        made = not path.exists()
        file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND | getattr(os, "O_BINARY", 0), 0o666)
        try:
            _lock(file, path)
            if os.name != "posix" or _stands_at(file, path):
                return file, made
        except BaseException:
            os.close(file)
            raise
        os.close(file)


def _stands_at(file: int, path: Path) -> bool:
    """Whether the open file is still the one of this name: another run may have discarded it before the lock."""
    try:
        return os.path.samestat(os.fstat(file), path.stat())
    except FileNotFoundError:
        return False


def _lock(file: int, path: Path) -> None:
    """Be the only writer until the file is closed or the process dies, however it dies."""
    try:
        import fcntl
    except ImportError:  # no such lock on this platform
        return
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        raise OutputError(
            f"{path} must be written by one run at a time; another run is at work in this folder."
        ) from error


def _sync_folder(folder: Path) -> None:
    """Make the file's name as durable as its content; where folders cannot be synced there is nothing to do."""
    try:
        file = os.open(folder, os.O_RDONLY)
    except OSError:
        return
    try:
        os.fsync(file)
    except OSError:
        pass
    finally:
        os.close(file)
