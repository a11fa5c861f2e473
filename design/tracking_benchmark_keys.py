"""The keys of the benchmark that tracks sinusoidal forces (paper on the PREHydrA, Secs. III-B and IV, Figs. 6 and 7).

Published are 300 N at 0.5 Hz, 50 N at 4 Hz and 20 N at 10 Hz, the offset of 45 N, the margin of 50 N and the ramp of
2 s; the pairs between lie along equation (4) as Fig. 6 has them, and are assumed, as is the plan that identifies the
friction: thirty even speeds from 3 mm/s on and a scatter of 2 N give standard errors such as Table I has.
"""

from __future__ import annotations

from fluxbore.design.keys import Key

PREFIX = "benchmark.tracking."

PAIRS = ((300.0, 0.1), (300.0, 0.5), (100.0, 2.0), (50.0, 4.0), (30.0, 6.0), (20.0, 10.0))
"""Amplitude (N) and frequency (Hz) of the defaults."""

PUBLISHED_PAIRS = (2, 4, 6)
"""Numbers of those that the paper tells."""

ALL, PUBLISHED = CHOICES = ("all", "published")
EVEN, GEOMETRIC = SPACINGS = ("even", "geometric")


def _key(name: str, doc: str, dimension: str, default: float | None, largest: float, *, zero: bool = False) -> Key:
    return Key(
        PREFIX + name,
        doc,
        dimension=dimension,
        minimum=0.0 if zero else None,
        above=None if zero else 0.0,
        maximum=largest,
        default=default,
        optional=default is None,
    )


def _pair(number: int, amplitude: float, frequency: float) -> tuple[Key, Key]:
    return (
        _key(f"amplitude_{number}", f"of the reference force of pair {number}", "force", amplitude, 1e7),
        _key(f"frequency_{number}", f"of the reference force of pair {number}", "frequency", frequency, 1e3),
    )


TRACKING_BENCHMARK_KEYS: tuple[Key, ...] = (
    *(key for number, pair in enumerate(PAIRS, 1) for key in _pair(number, *pair)),
    Key(
        PREFIX + "pairs",
        "which pairs are run: all, or only 2, 4 and 6, which are the published ones",
        kind="word",
        default=ALL,
        choices=CHOICES,
    ),
    _key("offset", "least force of the references: the springs' pretension", "force", 45.0, 1e7, zero=True),
    _key("margin", "that references keep from the force at the stroke's end", "force", 50.0, 1e7, zero=True),
    _key("ramp", "of the skewed sine step before the sinusoid starts", "time", 2.0, 1e3),
    _key("duration", "of the sinusoid; without it a period, and 2 s at least", "time", None, 1e4),
    _key(
        "step",
        "of the plant between two samples of the controller; without it 125 us, or what a light piston needs",
        "time",
        None,
        1e-2,
    ),
    _key(
        "highest_pressure",
        "at which friction at the limit and efficiency are told: the largest that the paper saw",
        "pressure",
        26e5,
        1e9,
    ),
    # The plan of experiment that identifies the friction.
    Key(
        PREFIX + "identification_speeds",
        "constant speeds at which the friction is measured",
        kind="integer",
        minimum=5,
        maximum=1000,
        default=30,
    ),
    _key("identification_noise", "standard deviation of a measured friction force", "force", 2.0, 1e6, zero=True),
    Key(
        PREFIX + "identification_spacing",
        "of these speeds; the paper's is not published",
        kind="word",
        default=EVEN,
        choices=SPACINGS,
    ),
    _key("slowest_speed", "of the identification", "speed", 3e-3, 10.0),
    _key("fastest_speed", "of the identification", "speed", 0.45, 10.0),
)
