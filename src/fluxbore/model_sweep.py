"""Sweeps of a FEMM file: every combination of some values, in parallel, resumable, a row for each."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from hashlib import sha256
from itertools import product
from pathlib import Path
from typing import Any

from fluxbore.design.errors import FluxboreError, OutputError
from fluxbore.fem.femm_edit import edit
from fluxbore.fem.femm_model import FemmModel
from fluxbore.fem.femm_setting import sweep_values
from fluxbore.fem.femm_writer import write_text
from fluxbore.optimize.executor import local_executor
from fluxbore.optimize.folder import write_atomic

JOURNAL, TABLE = "sweep.jsonl", "results.csv"


@dataclass(frozen=True, slots=True)
class ModelSweep:
    """A question put to a model at every combination of some values.

    axes : (key, values as typed). The last axis runs fastest.
    """

    model: FemmModel
    axes: tuple[tuple[str, tuple[str, ...]], ...]
    groups: tuple[int, ...] = ()
    points: tuple[tuple[float, float], ...] = ()
    accuracy: float | None = None
    open_boundary: bool = False

    @classmethod
    def of(cls, model: FemmModel, axes: Sequence[str], **question: Any) -> ModelSweep:
        """From KEY=FIRST:LAST:STEP texts. Raises SpecError, also where a first value means nothing to the model."""
        found = tuple(sweep_values(text) for text in axes)
        edit(model, {key: values[0] for key, values in found})
        return cls(model, found, **question)

    def fingerprint(self) -> str:
        """Changes with anything that changes a result."""
        text = json.dumps(
            [write_text(self.model), self.axes, self.groups, self.points, self.accuracy, self.open_boundary]
        )
        return sha256(text.encode()).hexdigest()

    def grid(self) -> list[tuple[str, ...]]:
        return list(product(*(values for _, values in self.axes)))


Row = dict[str, Any]
Done = Callable[[int, int], None]


def run_sweep(
    sweep: ModelSweep, folder: Path | str, workers: int | None = None, force: bool = False, done: Done | None = None
) -> tuple[Path, list[Row]]:
    """Compute every row that the folder does not hold yet; the table's path and all rows in grid order.

    done : told how many rows of how many there are after each. A value that cannot be solved is a row with its reason.
    A row is on the disk before it counts, so that a kill costs at most those in flight. Raises OutputError where the
    folder cannot be written or holds another sweep that ``force`` does not give up.
    """
    place = Path(folder)
    grid = sweep.grid()
    known = _opened(place, sweep.fingerprint(), force)
    missing = [values for values in grid if values not in known]
    keys = [key for key, _ in sweep.axes]
    if done is not None:
        done(len(grid) - len(missing), len(grid))
    with (place / JOURNAL).open("ab") as journal, local_executor(workers) as executor:
        for outcome in executor.run(_row, [(sweep, dict(zip(keys, values, strict=True))) for values in missing]):
            values = missing[outcome.index]
            row = outcome.value if outcome.value is not None else {"status": "failed", "reason": outcome.failure}
            known[values] = row
            journal.write(json.dumps([values, row], allow_nan=False).encode() + b"\n")
            journal.flush()
            os.fsync(journal.fileno())
            if done is not None:
                done(len(known), len(grid))
    rows = [dict(zip(keys, values, strict=True)) | known[values] for values in grid]
    return write_atomic(place / TABLE, table(rows)), rows


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


def _opened(place: Path, fingerprint: str, force: bool) -> dict[tuple[str, ...], Row]:
    """The rows that the folder holds of this sweep; a torn last line is cut away."""
    path = place / JOURNAL
    try:
        place.mkdir(parents=True, exist_ok=True)
        lines = path.read_bytes().split(b"\n") if path.exists() else []
        head = _json(lines[0]) if lines else None
        if not isinstance(head, dict) or head.get("sweep") != fingerprint:
            others = sorted(entry.name for entry in place.iterdir() if not entry.name.startswith("."))
            if others and not force:
                raise OutputError(
                    f"{place} must be empty or hold this very sweep; it holds others' results, such as {others[0]} "
                    "(see --force)."
                )
            write_atomic(path, json.dumps({"sweep": fingerprint}) + "\n")
            return {}
        rows = [row for row in (_json(line) for line in lines[1:-1]) if isinstance(row, list) and len(row) == 2]
        text = [json.dumps(head), *(json.dumps(row) for row in rows)]
        write_atomic(path, "\n".join(text) + "\n")
    except OSError as error:
        raise OutputError(f"{place} cannot be written: {error.strerror or error}.") from error
    return {tuple(values): row for values, row in rows}


def _json(line: bytes) -> Any:
    try:
        return json.loads(line)
    except ValueError:
        return None


def _row(task: tuple[ModelSweep, Mapping[str, str]]) -> Row:
    """One row's figures, or why there are none."""
    from fluxbore.solution_messages import solution_plain
    from fluxbore.solving import solve

    sweep, changes = task
    try:
        solved = solve(
            sweep.model,
            groups=sweep.groups,
            points=sweep.points,
            accuracy=sweep.accuracy,
            changes=changes,
            open_boundary=sweep.open_boundary,
        )
        plain = solution_plain(solved, sweep.groups, sweep.points)
    except FluxboreError as error:
        return {"status": "failed", "reason": str(error)}
    status = plain["convergence"]["status"]
    return dict(_figures(plain)) | {
        "status": "ok" if status == "converged" else "failed",
        "reason": " ".join(plain["warnings"]),
    }


def _figures(plain: Mapping[str, Any]) -> Iterator[tuple[str, float]]:
    yield "energy", plain["energy"]
    yield "coenergy", plain["coenergy"]
    for name, circuit in plain["circuits"].items():
        yield f"circuit.{name}.current", circuit["current"]
        yield f"circuit.{name}.flux_linkage", circuit["flux_linkage"]
    axisymmetric = plain["problem"]["type"] == "axisymmetric"
    for number, group in plain["groups"].items():
        if axisymmetric:
            yield f"group.{number}.force.z", group["force"][1]
        else:
            yield f"group.{number}.force.x", group["force"][0]
            yield f"group.{number}.force.y", group["force"][1]
            yield f"group.{number}.torque", group["torque"]
        yield f"group.{number}.force_error", group["force_error"]
    first, second = ("r", "z") if axisymmetric else ("x", "y")
    for number, point in enumerate(plain["points"], start=1):
        yield f"point.{number}.B.{first}", point["B"][0]
        yield f"point.{number}.B.{second}", point["B"][1]
    yield "unknowns", plain["mesh"]["unknowns"]
    if plain["accuracy"]["estimate"] is not None:
        yield "estimate", plain["accuracy"]["estimate"]
