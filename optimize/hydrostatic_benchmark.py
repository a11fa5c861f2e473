"""The benchmark that tracks sinusoidal forces, as an electro-hydrostatic design is put through it: figures, limits."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from fluxbore.design.keys import Value
from fluxbore.design.spec import Spec
from fluxbore.design.tracking_benchmark_keys import ALL, PREFIX, PUBLISHED
from fluxbore.optimize.benchmark import Benchmark
from fluxbore.optimize.benchmark import Published as Row
from fluxbore.optimize.evaluation import Evaluation

if TYPE_CHECKING:
    from fluxbore.design.dynamics.simulation import Simulation

# The table of actuators holds this benchmark, and is read before every command: what simulates is imported when used.

TABLE_I = {
    "preload": ("F_preload", "force", 8.1, 0.91),
    "stribeck_force": ("F_S0", "force", 15.3, 5.96),
    "stribeck_decay": ("c", "inverse speed", 118.5, 61.1),
    "viscous_coefficient": ("f_v", "viscous friction", 59.5, 3.56),
}
"""Symbol, dimension, value and standard error (SI)."""

ALIKE = 1.5
"""Times and over which a standard error may differ from Table I's: its plan of experiment is not published."""

MODEL_ERROR, MEASURED_ERROR, MEASURED_MEAN = 2.44, 6.44, 3.03
"""N at 50 N and 4 Hz: what the paper's model predicts ("about 4 N less"), and what it measured."""

FIG_7 = "50 N at 4 Hz"


WORDS = {
    "preload": "Coulomb friction",
    "stribeck_force": "Stribeck force",
    "stribeck_decay": "Stribeck decay",
    "viscous_coefficient": "viscous friction",
}


def _friction() -> tuple[Row, ...]:
    values = (
        Row(
            ("identified_friction", name, "value"),
            f"{WORDS[name]}, {symbol}",
            dimension,
            value,
            2 * error,
            "Table I; within two of its errors",
        )
        for name, (symbol, dimension, value, error) in TABLE_I.items()
    )
    errors = (
        Row(
            ("expected_standard_error", name),
            f"standard error of {symbol}",
            dimension,
            error,
            None,
            "Table I; by the plan, before measuring",
            least=error / ALIKE,
            most=error * ALIKE,
        )
        for name, (symbol, dimension, _, error) in TABLE_I.items()
    )
    return (*values, *errors)


PUBLISHED_FIGURES = (
    Row(("force_frequency_limit",), "F f by (4)", "force rate", 213.0, 0.5, "(4)"),
    Row(("maximum_velocity",), "largest speed", "speed", 0.47, 5e-3, "Sec. IV"),
    Row(("stroke_force",), "force over the stroke", "force", 433.0, 0.5, "Sec. IV"),
    Row(("minimum_friction",), "least friction", "force", 7.0, 0.5, "Sec. III-A, text; Table I has no 7 N"),
    Row(("friction_at_limit",), "friction at top speed and pressure", "force", 45.0, 1.0, "Sec. V, about 45 N"),
    Row(
        ("force_at_rated_pressure",),
        "force at rated pressure, ideal",
        "force",
        1000.0,
        None,
        "Sec. V, about 1000 N; with friction 1075 N or so",
    ),
    Row(("efficiency",), "force efficiency, one cylinder", "fraction", 0.87, 5e-3, "Sec. V: F/(F + F_f)"),
    Row(
        ("efficiency_both_cylinders",),
        "force efficiency, both cylinders",
        "fraction",
        None,
        None,
        "not published: F/(F + 2 F_f)",
    ),
    Row(
        ("peak_pressure",),
        "largest pressure at 300 N",
        "pressure",
        26e5,
        None,
        "Sec. III-A; its peak force is 345 N or 383 N",
        least=23.5e5,
        most=26e5,
    ),
    Row(
        ("max_error", FIG_7, "half"),
        "50 N at 4 Hz, largest error",
        "force",
        MODEL_ERROR,
        1.0,
        "Fig. 7: model, about 4 N less than the 6.44 N measured",
    ),
    Row(
        ("mean_absolute_error", FIG_7, "half"),
        "50 N at 4 Hz, mean absolute error",
        "force",
        None,
        None,
        "Sec. IV: 3.03 N measured; the model's is not told",
        most=2.0,
    ),
    Row(("max_error", FIG_7, "peak-to-peak"), "50 N at 4 Hz peak to peak, largest error", "force"),
    Row(("mean_absolute_error", FIG_7, "peak-to-peak"), "50 N at 4 Hz peak to peak, mean absolute error", "force"),
    Row(("mean_absolute_error", "20 N at 10 Hz", "half"), "20 N at 10 Hz, mean absolute error", "force"),
    Row(
        ("mean_absolute_error", "300 N at 0.5 Hz", "peak-to-peak"),
        "300 N at 0.5 Hz peak to peak, mean absolute error",
        "force",
    ),
    Row(
        ("largest_mean_absolute_error",),
        "largest mean absolute error of all",
        "force",
        3.61,
        None,
        "Sec. IV: measured; below 3.7 N",
        most=3.7,
    ),
    Row(("frequency_of_least_error",), "frequency of the least error", "frequency", 0.1, 1e-9, "Sec. IV: 0.44 N there"),
    Row(
        ("phase_of_largest_error",),
        "largest error after an extremum, 50 N at 4 Hz",
        "angle",
        0.0,
        math.radians(15.0),
        "Sec. IV: at the extrema",
    ),
    *_friction(),
    Row(("energy_imbalance",), "energy not accounted for", "fraction", None, None, "of what enters", most=1e-6),
)

CAUSES = (
    Row(("force_frequency_limit",), "F f by (4)", "force rate"),
    Row(("minimum_friction",), "least friction", "force"),
    Row(("friction_at_limit",), "friction at top speed and pressure", "force"),
)

LIMITS = (
    "Nothing is tuned to the paper's tracking errors: what it does not publish of motor, drive, hose and fluid is "
    "assumed, each with its reason in the specification. Air, a delay, a slower velocity loop and a softer column move "
    "the largest error by a factor of two and more; agreement does not tell which of them the prototype had.",
    "The model's error is compared, not the measurement's: the 6.44 N measured have stick-slip, a spring that is not "
    "straight and friction that differs along the stroke, which neither model has.",
    "The paper's least friction, 7 N, does not follow from its Table I, whose law has its least at 10.3 N; the 44 N "
    "and 45 N do.",
    "The paper's amplitudes cannot all be read in one way. (4) and 0.47 m/s count half the distance between the peaks; "
    "300 N so read need more stroke than the cylinder has and must be the whole distance. Both are simulated.",
    "87 % is F/(F + F_f) with one cylinder's friction, where 1 - F_f/F would be 85 %. The force also has to overcome "
    "the input cylinder's friction: with both, it is 77 %.",
    "The paper places the largest error at the reference's extrema, where static friction acts. Here it comes at 50 N "
    "and 4 Hz where viscous friction is largest; only slow references err most at their extrema.",
    "Spacing and scatter of the paper's identification are not published. The standard errors agree for about thirty "
    "even speeds and 2 N; the standard error of F_S0, printed in N/Pa, is read in N.",
    "Fluid inertia and leakage are left out, as in the paper, and so are end stops: a stroke that is exceeded ends a "
    "run with its reason.",
)


def _designs(spec: Spec) -> Sequence[Mapping[str, Value]]:
    return []


def _field(spec: Spec, evaluations: Sequence[Evaluation]) -> None:
    """There is none; refuses a stand that cannot be."""
    from fluxbore.design.dynamics.tracking_stand import check_stand, tracking_stand
    from fluxbore.optimize.hydrostatic_common import weighed

    check_stand(weighed(spec), tracking_stand(spec.values))


_INERTIAS = tuple(f"actuator.{name}.inertia" for name in ("motor", "coupling", "ball_screw"))

_BORES = tuple(f"actuator.{name}.diameter" for name in ("port", "fitting", "pressure_block"))

TENTHS = (
    ("velocity loop's bandwidth", ("actuator.drive.bandwidth",)),
    ("its integral time", ("actuator.drive.integral_time",)),
    ("force gain k_p", ("actuator.drive.force_gain",)),
    ("inertia J", _INERTIAS),
    ("moving mass", ("actuator.output_cylinder.moving_mass",)),
    ("screw's efficiency", ("actuator.ball_screw.efficiency",)),
    ("bulk modulus", ("actuator.fluid.bulk_modulus",)),
    ("bore of the ports", _BORES),
    ("air", ("actuator.fluid.air_fraction",)),
    ("Stribeck force", ("actuator.friction.stribeck_force",)),
    ("Coulomb friction", ("actuator.friction.preload",)),
    ("viscous friction", ("actuator.friction.viscous_coefficient",)),
)  # fmt: skip
"""Keys of which a tenth more and less is tried, together where there are several: J is that of motor, coupling and
screw, the ports' bore that of fittings and block too, and the integral time the velocity loop's."""

MILLISECOND = {"actuator.drive.delay": 1e-3}

ALTERNATIVES: tuple[tuple[str, Mapping[str, Value]], ...] = (
    ("delay of 1 ms", MILLISECOND),
    ("velocity loop of 40 Hz", {"actuator.drive.bandwidth": 40.0}),
    ("force loop at 4 kHz", {"actuator.drive.force_period": 0.25e-3}),
    ("no air", {"actuator.fluid.air_fraction": 0.0}),
    ("2.5 % air", {"actuator.fluid.air_fraction": 0.025}),
    ("2.5 % air and a delay of 1 ms", {"actuator.fluid.air_fraction": 0.025, **MILLISECOND}),
    ("bulk modulus of 0.3 GPa, no air", {"actuator.fluid.bulk_modulus": 0.3e9, "actuator.fluid.air_fraction": 0.0}),
    ("hose whose wall gives, 0.5 GPa", {"actuator.hose.wall_modulus": 0.5e9}),
)
"""What the paper leaves open, in other ways than the specification's."""


def _variations(spec: Spec, field: None) -> Sequence[tuple[str, Mapping[str, Value]]]:
    """A tenth more and less of what drives the errors, and other explanations of them; of the published pairs."""
    fewer: Mapping[str, Value] = {f"{PREFIX}pairs": PUBLISHED}
    tenths: list[tuple[str, Mapping[str, Value]]] = [
        (f"{label}, {sign}10 %", {**fewer, **{key: factor * float(spec.values[key]) for key in keys}})
        for label, keys in TENTHS
        if all(key in spec.values for key in keys)
        for sign, factor in (("+", 1.1), ("\N{MINUS SIGN}", 0.9))
    ]
    return [*tenths, *((label, {**fewer, **values}) for label, values in ALTERNATIVES)]


def simulate_tracking(spec: Spec, field: None, seed: int, traces: bool) -> Simulation:
    """Every pair, and the friction that the seed's data tell. Raises DesignError where none can be made."""
    from fluxbore.design.dynamics.tracking_benchmark import simulate
    from fluxbore.design.dynamics.tracking_stand import tracking_stand
    from fluxbore.optimize.hydrostatic_common import weighed

    whole: Any = spec.values[f"{PREFIX}pairs"] == ALL
    return simulate(weighed(spec), tracking_stand(spec.values), seed, whole=bool(whole), traces=traces)


TRACKING = Benchmark(
    "tracking",
    "tracking sinusoidal forces",
    "PREHydrA paper, Secs. III to V",
    _designs,
    _field,
    simulate_tracking,
    PUBLISHED_FIGURES,
    CAUSES,
    LIMITS,
    _variations,
    usual_seeds=1,
)
