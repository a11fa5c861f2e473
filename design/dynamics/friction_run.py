"""The paper's identification run in simulated time: the disturbance at several pressures, without any compensation.

The load actuator pushes the mover to and fro at the benchmark's twelve frequencies, at eight target pressures of the
cap-end chamber (Nakata and Noda 2023, Sec. IV-C; the paper gives the number of pressures, and the axis of its Fig. 15
ends near 0.6 MPa). Recorded are position in the encoder's steps, load cell and pressure. The velocity is what these
positions give afterwards, by a difference over `SPAN` about each sample: without the lag of the controller's estimate.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.contact_force import FREQUENCIES
from fluxbore.design.dynamics.contact_force_plant import ContactForcePlant
from fluxbore.design.dynamics.contact_force_run import NO_COMPENSATION, drive, run
from fluxbore.design.friction_points import Run

Floats = NDArray[np.float64]

PRESSURES = tuple(1e6 * 0.6 * k / 7 for k in range(8))
"""Pa gauge."""

SPAN = 40e-3
"""s: four counts of the encoder at the slowest disturbance, and short of the turns within the paper's window."""


def friction_runs(
    plant: ContactForcePlant,
    seed: int,
    *,
    pressures: Sequence[float] = PRESSURES,
    frequencies: Sequence[float] = FREQUENCIES,
) -> list[Run]:
    """A run of ten round trips for each pressure (Pa gauge) and frequency (Hz), by frequency first.

    seed : of the encoder's phase and the load cell's noise, drawn for every run by itself.
    """
    found = []
    for i, frequency in enumerate(frequencies):
        driven = drive(plant, frequency)
        for j, pressure in enumerate(pressures):
            target = plant.chamber.area * pressure
            record = run(plant, driven, NO_COMPENSATION, target, np.random.default_rng([seed, i, j]))
            counts = np.floor(record.position / plant.estimate.resolution)
            position = plant.estimate.resolution * (counts + 0.5)
            found.append(Run(position, _velocity(record.time, position), record.force, record.pressure))
    return found


def _velocity(time: Floats, position: Floats) -> Floats:
    """By differences over the span about each sample, and the part of it that the record has at its ends."""
    half = SPAN / 2
    before, after = np.maximum(time - half, time[0]), np.minimum(time + half, time[-1])
    way = np.interp(after, time, position) - np.interp(before, time, position)
    return np.asarray(way / (after - before))
