"""results.parquet: the rows of results.csv with types and units, for pandas, polars, DuckDB and their like."""

from __future__ import annotations

import contextlib
import io
import threading
from collections.abc import Sequence
from typing import Any

from fluxbore.design.errors import MissingLibraryError
from fluxbore.design.keys import Key
from fluxbore.design.performance import FIGURES
from fluxbore.design.spec import Spec
from fluxbore.design.units import DIMENSIONS
from fluxbore.optimize.outcome import Candidate, SweepResult
from fluxbore.optimize.table import Cell, cells, columns, moved_keys

FILE_NAME = "results.parquet"

_TEXT = {
    "status": "ok, or in a few words why the design has no figures",
    "reason": "the same in sentences; empty for a sound design",
}


def load_ahead() -> None:
    """Load pyarrow in the background, while others compute: it takes as long as a design."""

    def load() -> None:
        with contextlib.suppress(Exception):  # whoever writes a table will say so
            load_pyarrow(FILE_NAME)

    threading.Thread(target=load, daemon=True).start()


def results_parquet(spec: Spec, sweeps: Sequence[SweepResult], candidates: Sequence[Candidate] = ()) -> bytes:
    """The content of results.parquet: columns and rows of `table.results_table`, in the same order.

    Keys and figures are float64 (SI), null where a figure is not known; keys that hold words, ``status`` and ``reason``
    are strings. Each column says its ``unit`` and what it is (``description``) in its metadata, the file the
    ``specification`` that it belongs to, as a hash. The same rows give the same bytes.
    Raises MissingLibraryError without pyarrow.
    """
    arrow, parquet = load_pyarrow(FILE_NAME)
    keys = moved_keys(sweeps, candidates)
    rows = list(cells(spec, keys, sweeps, candidates))
    known = {key.name: key for key in spec.kind.keys}
    fields, arrays = [], []
    for index, name in enumerate(columns(keys)):
        column = [row[index] for row in rows]
        words = name in _TEXT or (name in known and known[name].kind == "word")
        kind = arrow.string() if words else arrow.float64()
        fields.append(arrow.field(name, kind, nullable=name not in _TEXT, metadata=_metadata(name, known.get(name))))
        arrays.append(arrow.array(column if words else [_float(value) for value in column], kind))
    schema = arrow.schema(fields, metadata={"specification": spec.fingerprint()})
    buffer = io.BytesIO()
    # One thread's work in one group of rows: nothing of the machine is in the bytes.
    parquet.write_table(
        arrow.table(arrays, schema=schema), buffer, compression="zstd", row_group_size=max(len(rows), 1)
    )
    return buffer.getvalue()


def _metadata(name: str, key: Key | None) -> dict[str, str]:
    """Unit (SI, "1" where there is none) and description of a column."""
    if name in FIGURES:
        return {"unit": FIGURES[name].si, "description": FIGURES[name].doc}
    if key is None:
        return {"description": _TEXT.get(name, "")}
    unit = DIMENSIONS[key.dimension].si if key.kind == "quantity" else "1"
    return {"unit": unit, "description": key.doc} if key.kind != "word" else {"description": key.doc}


def _float(value: Cell) -> float | None:
    return None if value is None else float(value)


def load_pyarrow(file: str) -> tuple[Any, Any]:
    """pyarrow and its Parquet part; MissingLibraryError where the file cannot be written without."""
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError as error:
        raise MissingLibraryError(f"{file} needs pyarrow ({error}); get it by: pip install pyarrow") from error
    return pyarrow, pyarrow.parquet
