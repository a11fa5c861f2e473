"""Sweeps of a FEMM file: every combination of some values, in parallel, resumable, a row for each."""

from __future__ import annotations

import contextlib
import json
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from hashlib import sha256
from itertools import product
from math import prod
from pathlib import Path
from time import monotonic
from typing import Any, BinaryIO

from fluxbore.design.errors import FluxboreError, OutputError, SpecError
from fluxbore.fem.femm_edit import edit
from fluxbore.fem.femm_model import FemmModel
from fluxbore.fem.femm_setting import sweep_values
from fluxbore.fem.femm_solution import regions_of
from fluxbore.fem.femm_value import spelt
from fluxbore.fem.femm_writer import write_text
from fluxbore.optimize.executor import local_executor
from fluxbore.optimize.folder import write_atomic
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.progress import Progress, Report
from fluxbore.solving import check_accuracy

JOURNAL, TABLE = "sweep.jsonl", "results.csv"

MOST_ROWS = 100_000

Values = tuple[str, ...]
Row = dict[str, Any]


@dataclass(frozen=True, slots=True)
class ModelSweep:
    """A question put to a model at every combination of some values.

    axes : (key, values as typed). The last axis runs fastest. changes : (key, value) pairs made in every row, before
    those of the axes.
    """

    model: FemmModel
    axes: tuple[tuple[str, Values], ...]
    changes: tuple[tuple[str, str], ...] = ()
    groups: tuple[int, ...] = ()
    points: tuple[tuple[float, float], ...] = ()
    accuracy: float | None = None
    open_boundary: bool = False

    @classmethod
    def of(
        cls, model: FemmModel, axes: Sequence[str], changes: Sequence[tuple[str, str]] = (), **question: Any
    ) -> ModelSweep:
        """From KEY=FIRST:LAST:STEP texts.

        Raises SpecError for whatever would make every row fail: keys that the model does not know, a key twice, a
        group of nothing.
        """
        found = cls(model, tuple(sweep_values(text) for text in axes), tuple(changes), **question)
        keys = [key for key, _ in found.axes]
        for key in keys:
            if keys.count(key) > 1 or key in dict(changes):
                raise SpecError(f"{spelt(key)} must be given once, by --sweep or by --set; it is given twice.")
        rows = prod(len(values) for _, values in found.axes)
        if rows > MOST_ROWS:
            raise SpecError(f"--sweep must give at most {MOST_ROWS} rows; got {rows}.")
        check_accuracy(found.accuracy)
        first = edit(model, found.changes_of(tuple(values[0] for _, values in found.axes)))
        for group in found.groups:
            regions_of(first, group)
        return found

    def changes_of(self, values: Values) -> dict[str, str]:
        """Everything that is other than in the file in the row of these values."""
        return dict(self.changes) | dict(zip((key for key, _ in self.axes), values, strict=True))

    def fingerprint(self) -> str:
        """Changes with anything that changes a result."""
        question = [self.axes, self.changes, self.groups, self.points, self.accuracy, self.open_boundary]
        return sha256(json.dumps([write_text(self.model), *question]).encode()).hexdigest()

    def grid(self) -> list[Values]:
        return list(product(*(values for _, values in self.axes)))


def run_sweep(
    sweep: ModelSweep,
    folder: Path | str,
    workers: int | None = None,
    force: bool = False,
    progress: Report | None = None,
) -> tuple[Path, list[Row]]:
    """Compute every row that the folder does not hold yet; the table's path and all rows in grid order.

    A value that cannot be solved is a row with its reason. A row is on the disk before it counts, so that a kill costs
    at most those in flight; one whose process crashed is tried again by the next run. Raises OutputError where the
    folder cannot be written, where another run is at work in it, or where it holds something else that ``force`` does
    not give up; then everything is as it was.
    """
    place, grid = Path(folder), sweep.grid()
    lock, journal, known = _open(place, sweep.fingerprint(), force)
    known = {values: row for values in grid if (row := known.get(values)) is not None}
    missing = [values for values in grid if values not in known]
    reused, begin = len(known), monotonic()
    with lock, journal, local_executor(workers) as executor:
        _tell(progress, known, len(grid), reused, begin)
        for outcome in executor.run(_row, [(sweep, values) for values in missing]):
            values = missing[outcome.index]
            if outcome.value is None:
                known[values] = {"status": "failed", "reason": outcome.failure}
            else:
                known[values] = outcome.value
                journal.write(json.dumps([values, outcome.value], allow_nan=False).encode() + b"\n")
                journal.flush()
                os.fsync(journal.fileno())
            _tell(progress, known, len(grid), reused, begin)
        keys = [key for key, _ in sweep.axes]
        rows = [dict(zip(keys, values, strict=True)) | known[values] for values in grid]
        return write_atomic(place / TABLE, table(rows)), rows


def _tell(progress: Report | None, known: Mapping[Values, Row], total: int, reused: int, begin: float) -> None:
    if progress is None:
        return
    failed = sum(row["status"] != "ok" for row in known.values())
    rate = (len(known) - reused) / max(monotonic() - begin, 1e-9) if len(known) > reused + 1 else None
    left = None if rate is None else (total - len(known)) / rate
    progress(Progress("sweep", len(known), total, reused, failed, None, None, None, rate, left))


def table(rows: Sequence[Row]) -> str:
    """CSV with a column for whatever any row has, status and reason last."""
    import csv
    import io

    columns = list(dict.fromkeys(key for row in rows for key in row if key not in ("status", "reason")))
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([*columns, "status", "reason"])
    for row in rows:
        writer.writerow([row.get(key, "") for key in (*columns, "status", "reason")])
    return text.getvalue()


def _open(place: Path, fingerprint: str, force: bool) -> tuple[Journal, BinaryIO, dict[Values, Row]]:
    """The lock, the file to append rows to, and the rows that it holds of this sweep."""
    made: list[Path] = []
    try:
        if place.exists() and not place.is_dir():
            raise OutputError(f"{place} must be a folder to write the rows in; it is a file.")
        made = [folder for folder in (place, *place.parents) if not folder.exists()]
        place.mkdir(parents=True, exist_ok=True)
        lock = Journal(place / JOURNAL, read=False)
        try:
            return lock, *_rows(place, json.dumps({"sweep": fingerprint}).encode() + b"\n", force)
        except BaseException:
            lock.discard()
            raise
    except BaseException as error:
        for folder in made:
            with contextlib.suppress(OSError):  # not made after all, or no longer empty
                folder.rmdir()
        if isinstance(error, OSError):
            raise OutputError(f"{place} cannot be written: {error.strerror or error}.") from error
        raise


def _rows(place: Path, head: bytes, force: bool) -> tuple[BinaryIO, dict[Values, Row]]:
    """The journal, begun anew or with its torn last line cut away, and its rows.

    It is changed in place, since the lock is the file's, not its name's.
    """
    path = place / JOURNAL
    data = path.read_bytes()
    if not data.startswith(head):
        if not force:
            _refuse_others(place, torn=head.startswith(data))
        (place / TABLE).unlink(missing_ok=True)  # of the other sweep
        data = head
        with path.open("r+b") as file:
            file.truncate(0)
            file.write(head)
            os.fsync(file.fileno())
    whole = data[: data.rfind(b"\n") + 1]
    os.truncate(path, len(whole))
    return path.open("ab"), dict(row for line in whole.splitlines()[1:] if (row := _recorded(line)) is not None)


def _refuse_others(place: Path, torn: bool) -> None:
    """Raise OutputError where the folder is not free. torn : the journal is no more than the start of our own."""
    others = sorted(entry.name for entry in place.iterdir() if not entry.name.startswith("."))
    if torn:
        others.remove(JOURNAL)
    if others:
        whose = "the rows of another sweep" if JOURNAL in others else f"other files, such as {others[0]}"
        raise OutputError(f"{place} must be empty or hold rows of this very sweep; it holds {whose} (see --force).")


def _recorded(line: bytes) -> tuple[Values, Row] | None:
    """Values and row of a line; None for one that is damaged."""
    try:
        values, row = json.loads(line)
        return (tuple(map(str, values)), row) if row["status"] in ("ok", "failed") else None
    except (ValueError, TypeError, KeyError, RecursionError):
        return None


def _row(task: tuple[ModelSweep, Values]) -> Row:
    """One row's figures, or why there are none."""
    from fluxbore.plain_values import finite
    from fluxbore.solution_messages import solution_plain
    from fluxbore.solving import solve

    sweep, values = task
    try:
        solved = solve(
            sweep.model,
            groups=sweep.groups,
            points=sweep.points,
            accuracy=sweep.accuracy,
            changes=sweep.changes_of(values),
            open_boundary=sweep.open_boundary,
        )
        plain = finite(solution_plain(solved, sweep.groups, sweep.points))
    except FluxboreError as error:
        return {"status": "failed", "reason": str(error)}
    status = plain["convergence"]["status"]
    return dict(_figures(plain)) | {
        "status": "ok" if status == "converged" else "failed",
        "reason": " ".join(plain["warnings"]),
    }


def _figures(plain: Mapping[str, Any]) -> Iterator[tuple[str, float | None]]:
    """None for what there is not, so that a failed row has the columns of the others, and empty cells in the table."""
    nothing = None, None
    yield "energy", plain["energy"]
    yield "coenergy", plain["coenergy"]
    for name, circuit in plain["circuits"].items():
        yield f"circuit.{name}.current", circuit["current"]
        yield f"circuit.{name}.flux_linkage", circuit["flux_linkage"]
    axisymmetric = plain["problem"]["type"] == "axisymmetric"
    for number, group in plain["groups"].items():
        along = group["force"] or nothing
        if axisymmetric:
            yield f"group.{number}.force.z", along[1]
        else:
            yield f"group.{number}.force.x", along[0]
            yield f"group.{number}.force.y", along[1]
            yield f"group.{number}.torque", group["torque"]
        yield f"group.{number}.force_error", group["force_error"]
    first, second = ("r", "z") if axisymmetric else ("x", "y")
    for number, point in enumerate(plain["points"], start=1):
        b = point["B"] or nothing
        yield f"point.{number}.B.{first}", b[0]
        yield f"point.{number}.B.{second}", b[1]
        yield f"point.{number}.A", point["A"]
    yield "unknowns", plain["mesh"]["unknowns"]
    if plain["accuracy"]["estimate"] is not None:
        yield "estimate", plain["accuracy"]["estimate"]
