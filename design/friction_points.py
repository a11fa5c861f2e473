"""Points of sliding friction from measurements: a table of them, or samples of a load cell averaged as the paper does.

Nakata and Noda (2023), Sec. IV-C: a triangular disturbance moves the mover to and fro; of the samples between -0.8 and
-0.2 mm, half the difference of the mean forces in both directions is the friction.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.errors import IdentificationError
from fluxbore.design.measurements import Column, Measurements
from fluxbore.design.units import STANDARD_ATMOSPHERE, format_quantity

Floats = NDArray[np.float64]

COLUMNS = (
    Column("velocity", "speed", -100.0, 100.0),
    Column("pressure", "pressure", -STANDARD_ATMOSPHERE, 1e9),
    Column("force", "force", -1e6, 1e6),
)
"""Friction over velocity: positive against a positive velocity."""

RECORD_COLUMNS = (Column("position", "length", -1e3, 1e3), Column("run", None))
"""With these, the rows are samples of the load cell in runs of a speed and a pressure each."""

WINDOW = (-0.8e-3, -0.2e-3)
"""m: the relative positions that the paper takes, away from the turns of its triangular motion (Sec. IV-C)."""

SLOWEST = 1e-9
"""m/s: what is slower does not slide."""

SENSOR_ZERO = 1e3
"""Pa: a run's mean pressure this little below the atmosphere's is the atmosphere's."""

LEAST_SAMPLES = 5
"""Of a run within the window, in each direction: an average of fewer says nothing of the rest."""


@dataclass(frozen=True, slots=True, eq=False)
class FrictionPoints:
    """Friction (N) with its sign, at velocities (m/s) and gauge pressures (Pa): (points,) each."""

    velocity: Floats
    pressure: Floats
    friction: Floats
    source: str


@dataclass(frozen=True, slots=True, eq=False)
class Run:
    """Samples of one run: relative position (m), velocity (m/s), load cell (N), gauge pressure (Pa); (n,) each."""

    position: Floats
    velocity: Floats
    force: Floats
    pressure: Floats


def friction_points(
    measured: Measurements, *, piston_area: float = 0.0, window: tuple[float, float] = WINDOW
) -> FrictionPoints:
    """What a table of `COLUMNS` holds: friction as it stands, or samples in runs where `RECORD_COLUMNS` are there.

    piston_area, window : for samples, as `window_friction` takes them. Raises IdentificationError for what is no
    friction of sliding under pressure.
    """
    if "position" in measured and "run" in measured:
        return window_friction(_runs(measured), measured.source, piston_area=piston_area, window=window)
    v, P = measured["velocity"], measured["pressure"]
    for row in np.flatnonzero((np.abs(v) < SLOWEST) | (P < 0)):
        where = f"{measured.source}, line {measured.lines[row]}"
        if P[row] < 0:
            raise IdentificationError(suction(f"{where}: pressure", P[row]))
        raise IdentificationError(
            f"{where}: velocity must be {SLOWEST:g} m/s or more in size, for friction that slides; got {v[row]:g} m/s."
        )
    return FrictionPoints(v, P, measured["force"], measured.source)


def _runs(measured: Measurements) -> list[Run]:
    """The rows of each label, in their order, by rising label."""
    label = measured["run"]
    order = np.argsort(label, kind="stable")
    edges = np.flatnonzero(np.diff(label[order])) + 1
    signals = [np.split(measured[name][order], edges) for name in ("position", "velocity", "force", "pressure")]
    return [Run(*parts) for parts in zip(*signals, strict=True)]


def window_friction(
    runs: Sequence[Run], source: str, *, piston_area: float = 0.0, window: tuple[float, float] = WINDOW
) -> FrictionPoints:
    """A point for each run, as the paper takes it: half the difference of the mean forces at positive and at negative
    velocity within the window, at the mean speed and pressure there.

    piston_area : S (m^2), whose thrust S P is taken off the force first: a chamber that breathes through a slow valve
    is at a lower pressure while the mover advances, which would pass for friction. The paper does not say that it did
    so; zero leaves it out. What both directions share drops out. Whether the load cell counts push or pull as positive
    does not matter: friction is taken to hinder the motion on the whole.
    """
    halves = [_directions(run, f"{source}, run {number}", window) for number, run in enumerate(runs, start=1)]
    hinders = sum(float(np.mean(run.force[back]) - np.mean(run.force[out])) for run, out, back in halves) >= 0
    found = []
    for number, (run, out, back) in enumerate(halves, start=1):
        force = (run.force if hinders else -run.force) - piston_area * run.pressure
        pressure = float(np.mean(run.pressure[out]) + np.mean(run.pressure[back])) / 2
        if pressure < -SENSOR_ZERO:
            raise IdentificationError(suction(f"{source}, run {number}: the mean pressure", pressure))
        found.append(
            (
                (np.mean(run.velocity[out]) - np.mean(run.velocity[back])) / 2,
                max(pressure, 0.0),
                (np.mean(force[back]) - np.mean(force[out])) / 2,
            )
        )
    speed, pressures, friction = np.array(found, dtype=np.float64).T
    return FrictionPoints(speed, pressures, friction, source)


def _directions(run: Run, where: str, window: tuple[float, float]) -> tuple[Run, NDArray[np.bool_], NDArray[np.bool_]]:
    """A run with its samples within the window that advance, and those that go back."""
    inside = (run.position >= window[0]) & (run.position <= window[1])
    out, back = (inside & (sign * run.velocity >= SLOWEST) for sign in (1, -1))
    least = min(np.count_nonzero(out), np.count_nonzero(back))
    if least < LEAST_SAMPLES:
        raise IdentificationError(
            f"{where}: between {window[0] * 1e3:g} mm and {window[1] * 1e3:g} mm there must be {LEAST_SAMPLES} samples "
            f"or more in each direction; got {least}."
        )
    return run, out, back


def suction(what: str, pressure: float) -> str:
    """Suction does not press the fin: see `friction.check_pressure`."""
    return (
        f"{what} must be 0 MPa gauge or above for the friction of a seal that pressure presses; "
        f"got {format_quantity(pressure, 'pressure', 4)}."
    )
