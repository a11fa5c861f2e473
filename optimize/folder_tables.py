"""Whose results.csv a folder holds: a study's rows are designs, a simulation's rows are trials."""

from __future__ import annotations

import contextlib
from typing import Literal

from fluxbore.design.errors import OutputError
from fluxbore.optimize import parquet
from fluxbore.optimize.folder import Folder
from fluxbore.optimize.simulation_files import HEAD, TRACES
from fluxbore.optimize.table import FILE_NAME

Tables = Literal["study", "simulation"]

NAMES: dict[Tables, str] = {"study": "a study", "simulation": "simulations"}

BESIDE: dict[Tables, tuple[str, ...]] = {
    "study": (parquet.FILE_NAME, "report.html"),
    "simulation": (TRACES, "figures.json", "report.html"),
}
"""What belongs to a results.csv of that kind and would be taken for the other's."""


def keep_apart(folder: Folder, wanted: Tables, force: bool) -> None:
    """Let a run that writes the wanted kind of results.csv into a folder where there is none of the other kind.

    With ``force`` the other kind's table goes, and what belongs to it. Raises OutputError without, and where the table
    cannot be read or removed; the folder is then as it was.
    """
    found = _tables_of(folder)
    if found is None or found == wanted:
        return
    if not force:
        raise OutputError(
            f"{folder.path} must be empty or hold results of {NAMES[wanted]}; "
            f"it holds {FILE_NAME} of {NAMES[found]} (see --force)."
        )
    for name in (*BESIDE[found], FILE_NAME):
        path = folder.path / name
        try:
            path.unlink(missing_ok=True)
        except OSError as error:
            raise OutputError(f"{path} cannot be replaced: {error.strerror or error}.") from error


def _tables_of(folder: Folder) -> Tables | None:
    """The kind of the results.csv that stands there, by its header; None where there is none."""
    path = folder.path / FILE_NAME
    try:
        with contextlib.suppress(FileNotFoundError), path.open(encoding="utf-8", errors="replace") as file:
            head = file.readline(1000)
            return "simulation" if head.startswith(",".join(HEAD) + ",") else "study"
    except OSError as error:
        raise OutputError(f"{path} cannot be read: {error.strerror or error}.") from error
    return None
