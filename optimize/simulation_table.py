"""The tables of a benchmark: results.csv with a row for each trial, traces.parquet with a row for each instant."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from fluxbore.design.dynamics.simulation import Simulation, Trace
from fluxbore.optimize.benchmark import DesignRun
from fluxbore.optimize.parquet import load_pyarrow
from fluxbore.optimize.simulation_files import HEAD, TRACES
from fluxbore.optimize.table import FILE_NAME

__all__ = ["FILE_NAME", "HEAD", "TRACES", "read_traces", "traces_table", "trials_table"]


def trials_table(runs: Sequence[DesignRun]) -> str:
    """The text of results.csv: design and seed, each trial's setting and figures in SI; floats read back exactly."""
    trials = [
        (run.label, simulation.seed, trial)
        for run in runs
        for simulation in run.simulations
        for trial in simulation.trials
    ]
    settings = list(dict.fromkeys(name for *_, trial in trials for name in trial.setting))
    figures = list(dict.fromkeys(name for *_, trial in trials for name in trial.figures))
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow([*HEAD, *settings, *figures])
    for label, seed, trial in trials:
        values = [*(trial.setting.get(name) for name in settings), *(trial.figures.get(name) for name in figures)]
        writer.writerow([label, seed, *(_shown(value) for value in values)])
    return buffer.getvalue()


def traces_table(simulation: Simulation, key: str) -> bytes:
    """The content of traces.parquet: trial number, its setting, time and signals (SI); ``key`` stands in its metadata.

    A signal that a trial does not have is not a number there. Raises MissingLibraryError without pyarrow.
    """
    arrow, parquet = load_pyarrow(TRACES)
    traced = [(i, item, item.trace) for i, item in enumerate(simulation.trials) if item.trace is not None]
    lengths = [trace.time.size for _, _, trace in traced]
    columns: dict[str, Any] = {"trial": np.repeat(np.array([i for i, *_ in traced], dtype=np.int64), lengths)}
    for name in dict.fromkeys(name for _, trial, _ in traced for name in trial.setting):
        columns[name] = np.repeat(np.array([trial.setting.get(name) for _, trial, _ in traced]), lengths)
    columns["time"] = _joined([trace.time for *_, trace in traced])
    for name in dict.fromkeys(name for *_, trace in traced for name in trace.signals):
        columns[name] = _joined([trace.signals.get(name, np.full(trace.time.size, np.nan)) for *_, trace in traced])
    table = arrow.table(columns).replace_schema_metadata({"simulation": key, "seed": str(simulation.seed)})
    buffer = io.BytesIO()
    parquet.write_table(table, buffer, compression="zstd")
    return buffer.getvalue()


def read_traces(path: Path, key: str, simulation: Simulation) -> Simulation | None:
    """The simulation with the traces that the file holds of it; None where it holds another's, or none."""
    if not path.exists():
        return None
    arrow, parquet = load_pyarrow(TRACES)
    try:
        table = parquet.read_table(path)
        if (table.schema.metadata or {}).get(b"simulation") != key.encode():
            return None
        names = table.column_names
        columns = {name: table.column(name).to_numpy() for name in ("trial", *names[names.index("time") :])}
    except (OSError, ValueError, KeyError, arrow.ArrowException):
        return None
    return _with_traces(simulation, columns)


def _with_traces(simulation: Simulation, columns: Mapping[str, Any]) -> Simulation | None:
    number = columns["trial"]
    if number.size == 0 or number.max() >= len(simulation.trials) or number.min() < 0:
        return None
    trials = []
    for i, trial in enumerate(simulation.trials):
        own = number == i
        all_of_it = {name: values[own] for name, values in columns.items() if name not in ("trial", "time")}
        signals = {name: values for name, values in all_of_it.items() if not np.isnan(values).all()}
        trials.append(replace(trial, trace=Trace(columns["time"][own], signals) if own.any() else None))
    return replace(simulation, trials=tuple(trials))


def _joined(pieces: Sequence[Any]) -> Any:
    return np.concatenate(pieces) if pieces else np.zeros(0)


def _shown(value: Any) -> str:
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return ""
    return value if isinstance(value, str) else repr(value)
