"""What the tracking benchmark of an electro-hydrostatic actuator is run with: references, margins, friction's plan."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from fluxbore.design.dynamics.force_reference import READINGS, ForceReference, force_reference
from fluxbore.design.dynamics.hydrostatic_drive import STEP, longest_step
from fluxbore.design.errors import DesignError
from fluxbore.design.hydrostatic import HydrostaticActuator
from fluxbore.design.keys import Value
from fluxbore.design.tracking_benchmark_keys import EVEN, PAIRS, PREFIX, PUBLISHED, PUBLISHED_PAIRS
from fluxbore.design.units import format_quantity

LEAST_DURATION = 2.0
"""s of the sinusoid, where a period is shorter."""

MOST_STEPS = 2_000_000
"""Of one run: some minutes, and some hundred megabytes."""


@dataclass(frozen=True, slots=True)
class Pair:
    """One reference: amplitude (N), frequency (Hz) and how the amplitude is read."""

    amplitude: float
    frequency: float
    reading: str

    @property
    def name(self) -> str:
        """``50 N at 4 Hz``: the same for both readings."""
        return f"{self.amplitude:g} N at {self.frequency:g} Hz"


@dataclass(frozen=True, slots=True)
class TrackingStand:
    """SI units; `fluxbore.design.tracking_benchmark_keys` says what each is.

    pairs : both readings of each pair that is run. main : the pair whose traces and energies are shown, by
    amplitude and frequency. duration : of the sinusoid; None for a period, and `LEAST_DURATION` at least. step : of the
    plant; None for what the drive's solver takes by itself.
    """

    pairs: tuple[Pair, ...]
    main: tuple[float, float]
    offset: float
    margin: float
    ramp: float
    duration: float | None
    step: float | None
    highest_pressure: float
    speeds: int
    spacing: str
    noise: float
    slowest_speed: float
    fastest_speed: float

    def sinusoid(self, pair: Pair) -> float:
        """s of the sinusoid of a pair."""
        return self.duration if self.duration is not None else max(1 / pair.frequency, LEAST_DURATION)


def tracking_stand(values: Mapping[str, Value]) -> TrackingStand:
    """Of a specification's values."""

    def number(leaf: str) -> float:
        return float(values[PREFIX + leaf])

    def optional(leaf: str) -> float | None:
        value = values.get(PREFIX + leaf)
        return None if value is None else float(value)

    chosen = PUBLISHED_PAIRS if values[f"{PREFIX}pairs"] == PUBLISHED else tuple(range(1, len(PAIRS) + 1))
    given = [(number(f"amplitude_{i}"), number(f"frequency_{i}")) for i in chosen]
    return TrackingStand(
        tuple(Pair(*pair, reading) for pair in dict.fromkeys(given) for reading in READINGS),
        (float(values["operating_point.force_amplitude"]), float(values["operating_point.frequency"])),
        number("offset"),
        number("margin"),
        number("ramp"),
        optional("duration"),
        optional("step"),
        number("highest_pressure"),
        int(values[f"{PREFIX}identification_speeds"]),
        str(values.get(f"{PREFIX}identification_spacing", EVEN)),
        number("identification_noise"),
        number("slowest_speed"),
        number("fastest_speed"),
    )


def check_stand(actuator: HydrostaticActuator, stand: TrackingStand) -> None:
    """Raise DesignError for a step that does not divide the control period, runs that would not end, and a range of
    speeds that is none."""
    period = actuator.drive.force_period
    step = stand.step if stand.step is not None else min(STEP, longest_step(actuator) / 2, period)
    steps = round(period / step)
    if stand.step is not None and not (steps > 0 and math.isclose(steps * step, period, rel_tol=1e-9)):
        raise DesignError(
            f"{PREFIX}step must be a whole share of actuator.drive.force_period {format_quantity(period, 'time')}; "
            f"got {format_quantity(step, 'time')}."
        )
    longest = max(stand.sinusoid(pair) for pair in stand.pairs)
    count = (stand.ramp + longest) / step
    if count > MOST_STEPS:
        raise DesignError(
            f"{PREFIX}duration must be short enough for no more than {MOST_STEPS:.0e} steps of a run; "
            f"got {count:.2g} of {format_quantity(step, 'time')} for {stand.ramp + longest:.4g} s with the ramp."
        )
    if not stand.slowest_speed < stand.fastest_speed:
        raise DesignError(
            f"{PREFIX}slowest_speed must be below {PREFIX}fastest_speed "
            f"{format_quantity(stand.fastest_speed, 'speed')}; got {format_quantity(stand.slowest_speed, 'speed')}."
        )


def reference_of(actuator: HydrostaticActuator, stand: TrackingStand, pair: Pair) -> ForceReference:
    """The reference of a pair, from the force at rest. Raises DesignError where it leaves no margin to the stroke."""
    element, stroke = actuator.return_element, actuator.output_cylinder.stroke
    start = element.force(0.0)
    end = element.force(stroke) + (actuator.series_stiffness or 0.0) * stroke
    signal = force_reference(pair.amplitude, pair.frequency, pair.reading, start, stand.offset, stand.ramp)
    if signal.peak > (end - stand.margin) * (1 + 1e-9):
        slope = (end - start) / stroke
        way = f" ({(signal.peak - stand.offset) / slope * 1e3:.0f} mm of travel)" if slope > 0 else ""
        raise DesignError(
            f"The reference's peak must keep {PREFIX}margin {stand.margin:.4g} N from the force at the end of "
            f"actuator.output_cylinder.stroke {stroke * 1e3:.4g} mm, {end:.4g} N; got {signal.peak:.4g} N{way}."
        )
    return signal
