"""The keys of the benchmark that estimates and controls a lead screw's force without a sensor (RotLin paper, Sec. IV).

Table II's values are its defaults where they are the test stand's or the controller's own; those of the screw follow
from the design where they are not given. What the paper does not publish is a key with an assumed default, and an
example names the reason.
"""

from __future__ import annotations

from fluxbore.design.keys import Key

PREFIX = "benchmark.force."


def _key(
    name: str,
    symbol: str,
    doc: str,
    dimension: str,
    default: float | None,
    largest: float,
    *,
    zero: bool = True,
) -> Key:
    """A quantity from zero (or above it) to a largest value; without a default it follows from the design."""
    return Key(
        PREFIX + name,
        doc,
        dimension=dimension,
        symbol=symbol,
        minimum=0.0 if zero else None,
        above=None if zero else 0.0,
        maximum=largest,
        default=default,
        optional=default is None,
    )


def _number(name: str, symbol: str, doc: str, default: float, least: float, largest: float) -> Key:
    return Key(PREFIX + name, doc, kind="number", symbol=symbol, minimum=least, maximum=largest, default=default)


FORCE_BENCHMARK_KEYS: tuple[Key, ...] = (
    # The screw as the stand has it and the controller knows it.
    _key("stall_force", "F_stall", "of (14); without it the design's own", "force", None, 1e7, zero=False),
    _key(
        "spring_constant",
        "K_s",
        "of the linear estimate (1); without it the design's own",
        "stiffness",
        None,
        1e12,
        zero=False,
    ),
    _key("mass", "M_n", "of the mover; without it the design's own", "mass", None, 1e4, zero=False),
    _key("inertia", "J_n", "of the rotor; without it the design's own", "rotational inertia", None, 1e4, zero=False),
    _number("elastic_share", "w", "share of the spring's force that has no memory, (15)", 0.96, 0.0, 1.0),
    _number("phi", "phi", "of the hysteresis (18): slope of the memory at its start", 1.0, 1e-6, 1e6),
    _key("psi", "psi", "of the hysteresis (18)", "wave number", 3000.0, 1e9, zero=False),
    _key("xi", "xi", "of the hysteresis (18)", "wave number", 1000.0, 1e9),
    _number("eta", "eta", "of the hysteresis (18): sharpness of its knee", 1.0, 1.0, 100.0),
    # The controller.
    _key("position_gain", "K_p", "of the rotor's position control", "rate", 100.0, 1e6, zero=False),
    _key("speed_gain", "K_v", "of the rotor's speed control", "speed gain", 0.5, 1e6, zero=False),
    _key("observer_cutoff", "g_D", "of the disturbance observer", "angular frequency", 1000.0, 1e7, zero=False),
    _key("speed_cutoff", "g_v", "of the speed's calculation", "angular frequency", 1000.0, 1e7, zero=False),
    _key("load_cutoff", "g_L", "of the load's observer (27)", "angular frequency", 200.0, 1e7, zero=False),
    _key("control_period", "T", "between two samples of the controller", "time", 1e-4, 1.0, zero=False),
    _key("smooth_friction", "gamma_1", "friction that (29) takes for the mover's", "force", 0.8, 1e6),
    _key("friction_sharpness", "gamma_2", "of (29): how fast it rises with the speed", "inverse speed", 200.0, 1e9),
    _key("friction_jump", "gamma_3", "of (29): its sudden part", "force", 0.05, 1e6),
    _key("position_count", "", "one count of the linear encoder", "length", 1e-6, 1.0),
    _key("angle_count", "", "one count of the rotary encoder; without it one position count", "angle", None, 7.0),
    # The load.
    _key("load_stiffness", "K_e", "of what the mover presses on", "stiffness", 2250.0, 1e12, zero=False),
    _key("load_damping", "D_e", "of what the mover presses on", "viscous friction", 0.1, 1e9),
    # The plant as the controller does not know it.
    _key("friction", "F_C", "of the guides, sliding", "force", 0.85, 1e6),
    _key("bristle_stiffness", "sigma_0", "of the guides before they slide", "stiffness", 1e5, 1e12, zero=False),
    _key("bristle_damping", "sigma_1", "of the guides before they slide", "viscous friction", 30.0, 1e9),
    _key("distortion", "", "amplitude of the zero-force line's wave of one turn", "length", 27.11e-6, 1.0),
    _number("second_order", "", "the wave of half a turn over that of one", 0.35, 0.0, 10.0),
    _number("sixth_order", "", "the wave of a sixth of a turn over that of one", 0.2, 0.0, 10.0),
    _number("translator_order", "", "the translator's own wave over that of one turn", 0.35, 0.0, 10.0),
    _key("translator_wave", "", "length of the translator's own wave", "length", 60e-3, 10.0, zero=False),
    # The experiments.
    _key("frequency", "", "of the movement in experiments 1 to 3", "frequency", 0.1, 1e3, zero=False),
    _key("duration", "", "of each experiment, and of each step of the force", "time", 10.0, 1e4, zero=False),
    _key(
        "detection_speed",
        "",
        "of the two unloaded runs that find the zero-force line",
        "speed",
        10e-3,
        10.0,
        zero=False,
    ),
    _key("first_peak", "", "largest force of experiment 1", "force", 45.0, 1e7, zero=False),
    _key("second_peak", "", "largest force of experiment 2", "force", 85.0, 1e7, zero=False),
    _key("third_peak", "", "largest force of experiment 3", "force", 165.0, 1e7, zero=False),
    _key(
        "lower_peak",
        "",
        "largest force of experiment 3 at which the linear estimate errs as published",
        "force",
        147.5,
        1e7,
        zero=False,
    ),
    _key("first_loop", "", "force by (14) at the tips of the smaller static loop", "force", 75.0, 1e7, zero=False),
    _key(
        "second_loop",
        "",
        "force by (14) at the tips of the larger static loop, which the polynomial is fitted to",
        "force",
        165.0,
        1e7,
        zero=False,
    ),
    _key("first_step", "", "reference of the first step of the force", "force", 50.0, 1e7, zero=False),
    _key("second_step", "", "reference of the second step of the force", "force", 100.0, 1e7, zero=False),
)
