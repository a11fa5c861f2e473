"""The keys of the benchmark that maintains a contact force constant (MCFC; Nakata and Noda 2023, Sec. IV)."""

from __future__ import annotations

from fluxbore.design.keys import Key

CONTACT_FORCE_KEYS: tuple[Key, ...] = (
    Key(
        "benchmark.mcfc.stroke",
        "peak to peak of the load actuator's triangular disturbance",
        above=0.0,
        maximum=1.0,
        default=1.05e-3,
    ),
    Key(
        "benchmark.mcfc.time_step",
        "of the simulation",
        dimension="time",
        above=0.0,
        maximum=1e-3,
        default=1e-4,
    ),
)
