"""What every study works with: its specification, its folder and journal, and whatever computes."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from fluxbore.design.spec import Spec
from fluxbore.design.spec_file import to_toml
from fluxbore.optimize import pareto_table, parquet, tolerance_table
from fluxbore.optimize.executor import TIME_LIMIT, Executor, local_executor
from fluxbore.optimize.folder import Folder, open_folder
from fluxbore.optimize.folder_tables import Tables, keep_apart
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.outcome import Candidate, SweepResult
from fluxbore.optimize.pareto_result import ParetoResult
from fluxbore.optimize.table import FILE_NAME, results_table
from fluxbore.optimize.tolerance_result import ToleranceResult

DESIGN_FILE = "design.toml"


def design_text(spec: Spec) -> str:
    """The text of design.toml."""
    return to_toml(spec, f"{spec.word('actuator.name')}: the design that fluxbore chose, every value exact.")


@dataclass(frozen=True, slots=True)
class Workshop:
    """A run's folder, None where nothing is kept, and its workers."""

    folder: Folder | None
    executor: Executor

    @property
    def journal(self) -> Journal | None:
        return self.folder.journal if self.folder is not None else None

    def write_results(
        self, spec: Spec, sweeps: Sequence[SweepResult], candidates: Sequence[Candidate] = ()
    ) -> list[Path]:
        """Both tables of results; a sweep's do not replace those that begin with them, where a search's rows follow."""
        if self.folder is None:
            return []
        table = results_table(spec, sweeps, candidates)
        target, other = self.folder.path / FILE_NAME, self.folder.path / parquet.FILE_NAME
        before = target.read_text(encoding="utf-8") if self.folder.resumed and target.exists() else ""
        if not candidates and other.exists() and _begins_with(before, table):
            return [target, other]
        self.folder.write(FILE_NAME, table)
        self.folder.write(parquet.FILE_NAME, parquet.results_parquet(spec, sweeps, candidates))
        return [target, other]

    def write_front(self, result: ParetoResult) -> list[Path]:
        """front.csv."""
        if self.folder is None:
            return []
        return [self.folder.write(pareto_table.FILE_NAME, pareto_table.front_table(result))]

    def write_tolerance(self, result: ToleranceResult) -> list[Path]:
        """tolerance.csv."""
        if self.folder is None:
            return []
        return [self.folder.write(tolerance_table.FILE_NAME, tolerance_table.tolerance_table(result))]

    def write_design(self, design: Spec) -> list[Path]:
        """design.toml."""
        return [self.folder.write(DESIGN_FILE, design_text(design))] if self.folder is not None else []


def _begins_with(before: str, table: str) -> bool:
    """Whether the table that stands there has this one's rows first, perhaps with the columns of a search besides."""
    there, rows = csv.DictReader(io.StringIO(before)), list(csv.DictReader(io.StringIO(table)))
    first = list(islice(there, len(rows)))
    return len(first) == len(rows) and all(row.items() <= other.items() for row, other in zip(rows, first, strict=True))


@contextmanager
def workshop(
    spec: Spec,
    folder: Path | str | None,
    workers: int | None,
    scheduler: str | None,
    time_limit: float | None,
    force: bool,
    *,
    tables: Tables | None = "study",
) -> Iterator[Workshop]:
    """The workshop of one run, closed at its end.

    workers : processes on this machine; scheduler : of a Dask cluster in their place. time_limit : s for one design,
    None for the usual one. tables : the kind of results.csv that the run writes, None where it writes none.
    """
    with ExitStack() as stack:
        executor = stack.enter_context(_executor(workers, scheduler, TIME_LIMIT if time_limit is None else time_limit))
        place = stack.enter_context(open_folder(folder, spec, force)) if folder is not None else None
        if place is not None and tables is not None:
            keep_apart(place, tables, force)
            parquet.load_ahead()
        yield Workshop(place, executor)


def _executor(workers: int | None, scheduler: str | None, time_limit: float) -> Executor:
    if scheduler is None:
        return local_executor(workers, time_limit=time_limit)
    from fluxbore.optimize.cluster import executor_for

    return executor_for(workers, scheduler, time_limit)
