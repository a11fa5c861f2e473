"""The benchmark that maintains a contact force constant, as a hybrid actuator is put through it: figures and limits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from fluxbore.design.keys import Value
from fluxbore.design.spec import Spec
from fluxbore.optimize.benchmark import Benchmark, Published
from fluxbore.optimize.evaluation import Evaluation

if TYPE_CHECKING:
    from fluxbore.design.dynamics.force_map import ForceMap
    from fluxbore.design.dynamics.simulation import Simulation

# The table of actuators holds this benchmark, and is read before every command: what simulates is imported when used.

_MEDIANS = "Nakata and Noda 2023, Sec. IV-E"

PUBLISHED = (
    Published(("median_rmse", "P-N"), "median RMSE, P-N", "force", 3.13, 0.15, _MEDIANS),
    Published(("median_rmse", "P-P"), "median RMSE, P-P", "force", 2.94, 0.2, _MEDIANS),
    Published(("median_rmse", "P-E"), "median RMSE, P-E", "force", 1.26, 0.2, _MEDIANS),
    Published(("friedman_chi2",), "Friedman's χ²(2)", "count", 54.0, None, _MEDIANS),
    Published(
        ("cells_lowest_P-E",), "cells of 36 with P-E lowest", "count", 36.0, 2.0, "Sec. V: lowest in every condition"
    ),
    Published(
        ("cells_P-P_below_P-N",),
        "cells of 36 with P-P below P-N",
        "count",
        18.0,
        2.0,
        "inferred: with P-E lowest in all 36 cells, χ²(2) = 54.0 leaves no other count",
    ),
    Published(("fin_deformed_length",), "deformed length of the fin, Δl", "length", 0.407e-3, None, "Table III"),
    Published(("fin_contact_area",), "contact area of the fin, s", "area", 20.6e-6, None, "Table III"),
)

CAUSES = (
    Published(("force_constant",), "force constant, mean over the disturbance", "force constant"),
    Published(("cogging_force",), "largest cogging force over the disturbance", "force"),
    Published(("contact_force",), "contact force without pressure, F_0", "force"),
    Published(("fin_contact_area",), "contact area of the fin, s", "area"),
    Published(("moving_mass",), "moving mass", "mass"),
)

LIMITS = (
    "Of the test stand the paper publishes the frequencies, the target forces, ten round trips and the encoder. "
    "What the other parameters are calibrated to cannot be predicted by them: P-P, P-E and the counts of cells show "
    "that one plant can reproduce the measurements, not that it is theirs.",
    "P-N follows from equation (6) and Table IV at the inferred stroke, and nothing is fitted to it. Table IV was "
    "identified with this disturbance on this stand, so P-N checks that (6) is read as meant, and predicts no other "
    "stand.",
    "The paper gives its loops and its errors of single trials as pictures only; they are compared by shape and sign.",
    "Under P-P at 0 N the paper has no measurement, as its air could not pull; the simulated trials are not counted.",
    "Table III's rounded inputs give a deformed length of 0.412 mm where the paper prints 0.407 mm. Its contact "
    "area of 20.6 mm² follows from the printed length; 20.9 mm² follows from the inputs, and is what is simulated.",
    "The friction is that of (6) on either way, the same on every pass: drift, temperature and wear are left out.",
)


@dataclass(frozen=True, slots=True, eq=False)
class Surroundings:
    """What the simulation takes of the design's field and parts: SI units, contact_force being F_0 of equation (6)."""

    force_map: ForceMap
    moving_mass: float | None
    contact_force: float | None


def _designs(spec: Spec) -> Sequence[Mapping[str, Value]]:
    from fluxbore.optimize.hybrid_force_map import map_values

    return [map_values(spec)]


def _surroundings(spec: Spec, evaluations: Sequence[Evaluation]) -> Surroundings:
    from fluxbore.optimize.hybrid_force_map import force_map_of
    from fluxbore.optimize.hybrid_seal import contact_force

    (around,) = evaluations
    return Surroundings(force_map_of(around), around.performance.moving_mass, contact_force(spec))


def _variations(spec: Spec, around: Surroundings) -> Sequence[tuple[str, Mapping[str, Value]]]:
    """A tenth more and less of what a controller may take wrongly, and of the two times that decide on its lateness."""
    given = spec.values.get("benchmark.mcfc.force_constant")
    constant = around.force_map.mean_force_constant if given is None else float(given)
    bases = (
        ("friction, unknown to the controller", "friction_share", spec.number("benchmark.mcfc.friction_share")),
        ("force constant that the controller takes", "force_constant", constant),
        ("valve lag", "valve_lag", spec.number("benchmark.mcfc.valve_lag")),
        ("velocity filter", "velocity_filter", spec.number("benchmark.mcfc.velocity_filter")),
    )
    return [
        (f"{label}, {sign}10 %", {f"benchmark.mcfc.{key}": factor * base})
        for label, key, base in bases
        for sign, factor in (("+", 1.1), ("\N{MINUS SIGN}", 0.9))
    ]


def simulate_contact_force(spec: Spec, around: Surroundings, seed: int, traces: bool) -> Simulation:
    """One seed of all 144 trials, and beside their figures what of the design they come from. Raises SpecError."""
    from fluxbore.design.dynamics.contact_force import simulate

    found = simulate(
        spec.actuator,
        spec.values,
        around.force_map,
        seed,
        moving_mass=around.moving_mass,
        contact_force=around.contact_force,
        traces=traces,
    )
    causes = {
        "force_constant": around.force_map.mean_force_constant,
        "cogging_force": float(abs(around.force_map.cogging).max()),
        "contact_force": around.contact_force,
        "moving_mass": around.moving_mass,
    }
    return replace(found, figures={**found.figures, **causes})


MCFC = Benchmark(
    "mcfc",
    "maintaining a contact force constant",
    "Nakata and Noda 2023, Sec. IV",
    _designs,
    _surroundings,
    simulate_contact_force,
    PUBLISHED,
    CAUSES,
    LIMITS,
    _variations,
)
