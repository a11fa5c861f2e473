"""Measured data from CSV files: columns by name, in SI units, for every model that is identified from them.

A file holds a header and rows of numbers::

    # load cell over three round trips each
    velocity [mm/s], pressure [MPa gauge], force [N]
    0.63, 0.1, 3.91

The unit stands in brackets, one of `units.DIMENSIONS`; without it the column is in SI. Commas or semicolons separate,
the decimal sign is a point, lines that begin with ``#`` are comments, and columns that nobody asked for are left alone.
"""

from __future__ import annotations

import csv
import io
import math
import re
from array import array
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.errors import MeasurementError, one_line, shown
from fluxbore.design.units import DIMENSIONS, Unit, format_quantity

Floats = NDArray[np.float64]

LARGEST_FILE = 64 * 2**20
"""Bytes. Some two million rows, far beyond what averaging over a window leaves."""

LONGEST_LINE = 100_000
"""Characters; what is longer is no table of numbers."""

_HEADING = re.compile(r"^([^\[\]]*?)\s*(?:\[([^\[\]]*)\])?$")
_NUMBER = re.compile(r"[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?")


@dataclass(frozen=True, slots=True)
class Column:
    """A column that a model wants: its name, its dimension (a name of `units.DIMENSIONS`; None for a plain number).

    minimum, maximum : in SI, of every value in it.
    """

    name: str
    dimension: str | None
    minimum: float = -math.inf
    maximum: float = math.inf

    def show(self, value: float) -> str:
        """A value of it in its preferred unit."""
        return f"{value:g}" if self.dimension is None else format_quantity(value, self.dimension, 6)


@dataclass(frozen=True, slots=True, eq=False)
class Measurements:
    """What a file holds of the columns asked for: (rows,) each, in SI; the line of the file that each row stands on.

    source : the file's name, as sentences quote it.
    """

    source: str
    columns: Mapping[str, Floats]
    lines: NDArray[np.int64]

    def __getitem__(self, name: str) -> Floats:
        return self.columns[name]

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    def __len__(self) -> int:
        return len(self.lines)


def read_measurements(
    path: Path | str, columns: Sequence[Column], *, optional: Sequence[Column] = (), least_rows: int = 1
) -> Measurements:
    """Read a CSV file.

    columns : that the file must hold. optional : that are read where they stand in it.

    Raises MeasurementError with one sentence that names file, line, column, limit and value.
    """
    source = one_line(Path(path).name)
    try:
        with Path(path).open("rb") as file:
            raw = file.read(LARGEST_FILE + 1)
    except (OSError, ValueError) as error:  # ValueError: a name that no file can have
        reason = getattr(error, "strerror", None) or error
        raise MeasurementError(f"{one_line(str(path))} cannot be read: {reason}.") from error
    if len(raw) > LARGEST_FILE:
        raise MeasurementError(f"{source} must be at most {LARGEST_FILE // 2**20} MB; it is larger.")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw[: error.start].count(b"\n") + 1
        raise MeasurementError(f"{source}, line {line}: a table must be UTF-8 text; this byte is none.") from error
    return parse_measurements(text, source, columns, optional=optional, least_rows=least_rows)


def parse_measurements(
    text: str, source: str, columns: Sequence[Column], *, optional: Sequence[Column] = (), least_rows: int = 1
) -> Measurements:
    """What `read_measurements` makes of a file's text."""
    lines = _lines(text, source)
    header = next(lines, None)
    if header is None:
        names = ", ".join(column.name for column in columns)
        raise MeasurementError(f"{source} must begin with a header of its columns, {names}; got an empty table.")
    separator = ";" if ";" in header[1] else ","
    readers, width = _header(source, header, separator, columns, optional)
    values = [array("d") for _ in readers]
    numbers = array("q")
    for number, line in lines:
        cells = _cells(source, number, line, separator)
        if len(cells) != width:
            raise MeasurementError(
                f"{source}, line {number}: a row must have the header's {width} columns; got {len(cells)}."
            )
        numbers.append(number)
        for reader, kept in zip(readers, values, strict=True):
            kept.append(reader.value(source, number, cells[reader.place]))
    if len(numbers) < least_rows:
        rows = f"{least_rows} row{'s' if least_rows > 1 else ''}"
        raise MeasurementError(f"{source} must have {rows} or more below its header; got {len(numbers)}.")
    found = {reader.column.name: np.array(kept, dtype=np.float64) for reader, kept in zip(readers, values, strict=True)}
    return Measurements(source, found, np.array(numbers, dtype=np.int64))


@dataclass(frozen=True, slots=True)
class _Reader:
    """Reads one column's cells."""

    column: Column
    place: int
    unit: Unit

    def value(self, source: str, line: int, cell: str) -> float:
        text = cell.strip()
        number = float(text) if _NUMBER.fullmatch(text) else math.nan
        si = number * self.unit.factor + self.unit.offset
        if not math.isfinite(si):
            hint = " (the decimal sign is a point)" if re.fullmatch(r"[+-]?[0-9]+,[0-9]+", text) else ""
            got = shown(text) if text else "an empty cell"
            raise self._error(source, line, f"must hold finite numbers; got {got}{hint}")
        column = self.column
        if not column.minimum <= si <= column.maximum:
            limit, side = (column.minimum, "above") if si < column.minimum else (column.maximum, "below")
            raise self._error(source, line, f"must be {column.show(limit)} or {side}; got {column.show(si)}")
        return si

    def _error(self, source: str, line: int, words: str) -> MeasurementError:
        return MeasurementError(f"{source}, line {line}: {self.column.name} {words}.")


def _header(
    source: str, header: tuple[int, str], separator: str, columns: Sequence[Column], optional: Sequence[Column]
) -> tuple[list[_Reader], int]:
    """Readers of the wanted columns that the header names, and how many columns it has."""
    line, text = header
    cells = _cells(source, line, text, separator)
    places: dict[str, tuple[int, str | None]] = {}
    for place, cell in enumerate(cells):
        match = _HEADING.match(cell.strip())
        if match is None:
            raise MeasurementError(
                f'{source}, line {line}: a column must be named like "force [N]"; got {shown(cell.strip())}.'
            )
        name = match[1].strip().casefold()
        if name in places and name in {column.name for column in (*columns, *optional)}:
            raise MeasurementError(f"{source}, line {line}: {name} must be one column; got two.")
        places[name] = (place, match[2])
    for column in columns:
        if column.name not in places:
            got = ", ".join(shown(cell.strip()) for cell in cells[:8])
            hint = " (units stand in square brackets)" if any("(" in cell for cell in cells) else ""
            raise MeasurementError(f"{source}, line {line}: the column {column.name} must be there; got {got}{hint}.")
    wanted = [column for column in (*columns, *optional) if column.name in places]
    return [
        _Reader(column, places[column.name][0], _unit(source, line, column, places[column.name][1]))
        for column in wanted
    ], len(cells)


def _unit(source: str, line: int, column: Column, text: str | None) -> Unit:
    """That of a heading; SI without one."""
    if text is None:
        return Unit(1.0)
    name = " ".join(text.split())
    if column.dimension is None:
        if name in ("", "1"):
            return Unit(1.0)
        raise MeasurementError(f"{source}, line {line}: {column.name} must be without a unit; got {shown(name)}.")
    units = DIMENSIONS[column.dimension].units
    if name not in units:
        hint = f' (say "{name} gauge" or "{name} absolute")' if f"{name} gauge" in units else ""
        raise MeasurementError(
            f"{source}, line {line}: {column.name} must be in a unit of {', '.join(units)}; got {shown(name)}{hint}."
        )
    return units[name]


def _lines(text: str, source: str) -> Iterator[tuple[int, str]]:
    """The lines with something on them that is no comment, counted from one."""
    for number, line in enumerate(io.StringIO(text, newline=None), start=1):
        bare = line.strip()
        if len(bare) > LONGEST_LINE:
            raise MeasurementError(
                f"{source}, line {number}: a line must have at most {LONGEST_LINE} characters; got {len(bare)}."
            )
        if bare and not bare.startswith("#"):
            yield number, bare


def _cells(source: str, line: int, text: str, separator: str) -> list[str]:
    """Each line is a row by itself: a number has no line feeds in it."""
    try:
        return next(csv.reader([text], delimiter=separator, strict=True, skipinitialspace=True))
    except csv.Error as error:
        raise MeasurementError(
            f"{source}, line {line}: a row must be cells as CSV writes them; got {error}."
        ) from error
