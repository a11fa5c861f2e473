"""A finished run's folder as the source of a design: its design.toml, and what its results say of that design."""

from __future__ import annotations

import csv
import math
from pathlib import Path

from fluxbore.design.errors import SpecError
from fluxbore.design.performance import FIGURES
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import OK, Evaluation
from fluxbore.optimize.table import FILE_NAME
from fluxbore.workshop import DESIGN_FILE

EQUAL = 1e-9
"""Relative difference of a key's values in design.toml and in the table that comes from writing them."""


def design_file(source: Path) -> Path:
    """The specification that a source stands for: itself, or the design.toml of a finished run's folder.

    Raises SpecError for a folder without one.
    """
    if not source.is_dir():
        return source
    found = source / DESIGN_FILE
    if not found.is_file():
        raise SpecError(
            f"{source} must hold {DESIGN_FILE}, which `fluxbore design` and `fluxbore optimize` write for a design "
            "that can be made; it has none."
        )
    return found


def told_by_results(folder: Path, spec: Spec, evaluation: Evaluation, same: float) -> str:
    """How many designs the run computed, and whether it has the same figures for this one; empty without a table.

    same : relative difference up to which two figures count as the same.
    """
    try:
        with (folder / FILE_NAME).open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
    except (OSError, UnicodeDecodeError, csv.Error):
        return ""
    told = f"chosen by a run of {len(rows)} designs" if len(rows) > 1 else "from a finished run"
    own = next((row for row in reversed(rows) if row.get("status") == OK and _is(row, spec)), None)
    if own is None or not evaluation.ok:
        return told
    other = [name for name in FIGURES if not _agree(own.get(name, ""), getattr(evaluation.performance, name), same)]
    if not other:
        return f"{told}, which found the same figures"
    return f"{told}, whose table has other figures for it, such as the {other[0].replace('_', ' ')}"


def _is(row: dict[str, str], spec: Spec) -> bool:
    """Whether a line of the table is this design: by the keys that the run moved."""
    moved = [name for name in row if name not in FIGURES and name not in ("status", "reason") and row[name]]
    return bool(moved) and all(_near(row[name], spec.values.get(name), EQUAL) for name in moved)


def _near(text: str, value: object, tolerance: float) -> bool:
    try:
        return isinstance(value, (int, float)) and math.isclose(float(text), value, rel_tol=tolerance)
    except ValueError:
        return text == str(value)


def _agree(text: str, value: float | None, same: float) -> bool:
    """A figure as the table has it, and as computed anew; what either lacks is no disagreement."""
    return not text or value is None or _near(text, value, same) or abs(value) < EQUAL
