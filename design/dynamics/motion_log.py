"""Logs of a lead screw's encoders: rotor angle and mover position at even steps of time, from CSV files."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.errors import MeasurementError
from fluxbore.design.measurements import Column, Measurements, read_measurements
from fluxbore.design.units import format_quantity

Floats = NDArray[np.float64]

COLUMNS = (
    Column("time", "time", -1e9, 1e9),
    Column("angle", "angle", -1e6, 1e6),
    Column("position", "length", -1e3, 1e3),
)
"""Of the rotor (turns counted on, not wrapped), and of the mover."""

FORCE = Column("force", "force", -1e6, 1e6)
"""Of a load cell beside them, where there is one."""

UNEVEN = 0.1
"""Of the usual step, by which a step may differ: filters of a fixed period know no other."""


@dataclass(frozen=True, slots=True, eq=False)
class MotionLog:
    """Samples, (n,) each, `period` seconds apart: rotor angle (rad), mover position (m), and force (N) or None."""

    period: float
    angle: Floats
    position: Floats
    force: Floats | None = None
    source: str = "the log"


def read_motion_log(path: Path | str) -> MotionLog:
    """A log from a CSV file with the columns time, angle and position, and force where it stands there.

    Raises MeasurementError, one sentence, for a cell that is no number, time that does not rise, or steps of time that
    are missing.
    """
    return motion_log(read_measurements(path, COLUMNS, optional=(FORCE,), least_rows=3))


def motion_log(measured: Measurements) -> MotionLog:
    """The same of a table that has been read."""
    period = even_period(measured)
    force = measured.columns.get(FORCE.name)
    return MotionLog(period, measured["angle"], measured["position"], force, measured.source)


def even_period(measured: Measurements) -> float:
    """The step (s) of the column `time`, which must rise evenly."""
    check_rising(measured)
    time = measured["time"]
    steps = np.diff(time)
    usual = float(np.median(steps))
    uneven = np.flatnonzero(np.abs(steps - usual) > UNEVEN * usual)
    if len(uneven) > 0:
        row = int(uneven[0])
        raise MeasurementError(
            f"{measured.source}, line {measured.lines[row + 1]}: time must rise by {_show(usual)} as elsewhere, "
            f"within {UNEVEN * 100:g} %, without gaps; got a step of {_show(float(steps[row]))}."
        )
    return float(time[-1] - time[0]) / (len(time) - 1)


def check_rising(measured: Measurements) -> None:
    """Raises MeasurementError where the column `time` falls or stands still, with the line."""
    time = measured["time"]
    back = np.flatnonzero(~(np.diff(time) > 0))
    if len(back) > 0:
        row = int(back[0])
        raise MeasurementError(
            f"{measured.source}, line {measured.lines[row + 1]}: time must rise from row to row; "
            f"got {_show(float(time[row + 1]))} after {_show(float(time[row]))}."
        )


def _show(seconds: float) -> str:
    return format_quantity(seconds, "time", max(6, 3 + math.ceil(math.log10(max(abs(seconds), 1.0)))))
