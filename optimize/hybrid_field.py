"""What the finite elements give of a hybrid actuator: its field over the window of positions, and the figures of it."""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, pi
from typing import TYPE_CHECKING

from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.hybrid_values import positions as window_positions
from fluxbore.design.materials import PermanentMagnet, lookup
from fluxbore.design.spec import Spec
from fluxbore.geometry.hybrid import STRAY_DISTANCE
from fluxbore.optimize.evaluation import PositionResult

if TYPE_CHECKING:
    from fluxbore.fem.magnetostatics import Settings
    from fluxbore.fem.newton import Convergence
    from fluxbore.fem.tubular import TubularSolution

STRAY_OVERHANG = 0.02
"""m before and beyond the yoke over which the stray field is read."""

LOAD_EXPONENT = 8.0
"""p of the mean of (reverse field)^p over the magnets. Their edges against the rings see an infinite field, so that the
largest value is a number of the mesh; this one is of the volume."""


@dataclass(frozen=True, slots=True)
class Ranges:
    """Where figures are read at one position (m): the yoke's tube, and cylinders with their radius and their z."""

    yoke_r: tuple[float, float]
    yoke_z: tuple[float, float]
    stray: tuple[float, tuple[float, float]]
    ring: tuple[float, tuple[float, float]]
    gap: tuple[float, tuple[float, float]]


def ranges(actuator: HybridActuator, position: float) -> Ranges:
    """The ring is the inner one next to the array's middle, the least touched by the ends."""
    mover, yoke = actuator.mover, actuator.back_yoke
    ring = position + mover.pole_pairs * mover.pole_pitch
    half_shell = min(mover.ring_width / 2 + actuator.air_gap, mover.pole_pitch / 2)
    return Ranges(
        (yoke.inner_diameter / 2, yoke.outer_diameter / 2),
        (actuator.yoke_start, actuator.yoke_end),
        (
            yoke.outer_diameter / 2 + STRAY_DISTANCE,
            (actuator.yoke_start - STRAY_OVERHANG, actuator.yoke_end + STRAY_OVERHANG),
        ),
        (mover.outer_diameter / 2, (ring - mover.ring_width / 2, ring + mover.ring_width / 2)),
        (actuator.cylinder.outer_diameter / 2, (ring - half_shell, ring + half_shell)),
    )


@dataclass(frozen=True, slots=True, eq=False)
class Field:
    """The solutions of one design: at each position of the window at no current, and in its middle at the peak current
    on the q axis of either sign, where the specification names one."""

    window: list[TubularSolution]
    peaks: list[TubularSolution]

    @property
    def failure(self) -> tuple[str, Convergence] | None:
        """Where the first field that did not converge is, and how it ended."""
        for items, words in ((self.window, ""), (self.peaks, " with the peak current")):
            for item in items:
                if not item.convergence.converged:
                    return f"At z = {item.position * 1e3:.4g} mm{words}: ", item.convergence
        return None

    @property
    def middle(self) -> TubularSolution:
        return self.window[len(self.window) // 2]


def solve_window(spec: Spec, positions: Sequence[float] | None = None) -> list[TubularSolution]:
    """The design's field at no current at each position of the spec's window, or at other positions (m)."""
    from fluxbore.fem.tubular import solve_positions
    from fluxbore.geometry.hybrid import cross_section

    actuator: HybridActuator = spec.actuator
    temperature = spec.number("operating_point.magnet_temperature")
    return solve_positions(
        lambda position: cross_section(actuator, position, spec.materials, temperature),
        window_positions(spec.values) if positions is None else positions,
        _settings(spec),
        int(spec.number("solver.mesh_refinement")),
    )


def solve_field(spec: Spec) -> Field:
    """All of the design's fields; it ends at the first that does not converge."""
    from fluxbore.fem.tubular import solve_currents

    field = Field(solve_window(spec), [])
    if field.failure is None and "operating_point.peak_current" in spec.given:
        middle = field.middle
        for sign in (1.0, -1.0):
            currents = peak_currents(spec, middle.position, sign * thrust_sign(spec, middle))
            phases = [circuit.name for circuit in middle.solution.problem.circuits]
            field.peaks.append(
                solve_currents(
                    middle.section,
                    middle.position,
                    dict(zip(phases, currents, strict=True)),
                    _settings(spec),
                    int(spec.number("solver.mesh_refinement")),
                    near=middle,
                )
            )
    return field


def peak_currents(spec: Spec, position: float, sign: float) -> tuple[float, float, float]:
    """Of the three phases (A) at the peak current on the q axis, by position: the drive follows the electrical angle
    π z/τ, along which the thrust constants turn."""
    angle = pi * position / spec.number("actuator.mover.pole_pitch")
    peak = sign * spec.number("operating_point.peak_current")
    u, v, w = (peak * cos(angle - 2 * pi * k / 3) for k in range(3))
    return u, v, w


def thrust_sign(spec: Spec, solved: TubularSolution) -> float:
    """+1 or -1: the sign of current that pushes towards the rod end."""
    from fluxbore.fem.tubular import space_vector

    turned = space_vector(solved.thrust_constants()) * cmath.exp(
        -1j * pi * solved.position / spec.number("actuator.mover.pole_pitch")
    )
    return 1.0 if turned.real >= 0 else -1.0


def field_figures(spec: Spec, field: Field, positions: Sequence[PositionResult]) -> dict[str, float | None]:
    """The figures of the field, by name. Maxima are over the window; the gap's and the ring's figures are its means."""
    from fluxbore.fem import tubular

    actuator: HybridActuator = spec.actuator
    solved, coercivity = field.window, intrinsic_coercivity(spec)
    at = [ranges(actuator, item.position) for item in solved]
    both = list(zip(solved, at, strict=True))
    states = [*solved, *field.peaks]

    def mean_shell(places: Sequence[tuple[float, tuple[float, float]]]) -> float:
        values = [tubular.shell_flux_density(item, *place) for item, place in zip(solved, places, strict=True)]
        return sum(values) / len(values)

    return {
        "force_constant": sum(item.force_constant for item in positions) / len(positions),
        "force_constant_linkage": linkage_constant(
            [item.flux_linkages for item in positions],
            [item.position for item in positions],
            actuator.mover.pole_pitch,
        ),
        "cogging_force": max(abs(item.cogging_force) for item in positions),
        "stray_field": max(tubular.stray_field(item, *place.stray) for item, place in both),
        "yoke_flux_density": max(tubular.tube_flux_density(item, place.yoke_r, place.yoke_z) for item, place in both),
        "ring_flux_density": mean_shell([place.ring for place in at]) if actuator.mover.ring_width > 0 else None,
        "gap_flux_density": mean_shell([place.gap for place in at]),
        "demagnetised_fraction": max(tubular.demagnetised_fraction(item, coercivity) for item in solved),
        "phase_inductance": field.middle.synchronous_inductance(),
        "demagnetisation_load": max(tubular.mean_reverse_field(item, LOAD_EXPONENT) for item in states) / coercivity,
        "peak_force": field.peaks[0].cogging_force() - field.middle.cogging_force() if field.peaks else None,
        "peak_demagnetised_fraction": max(tubular.demagnetised_fraction(item, coercivity) for item in field.peaks)
        if field.peaks
        else None,
    }


def intrinsic_coercivity(spec: Spec) -> float:
    """A/m, of the magnets at their temperature."""
    actuator: HybridActuator = spec.actuator
    grade = lookup(actuator.mover.magnet, "actuator.mover.magnet", spec.materials, PermanentMagnet)
    return grade.coercivity_at(spec.number("operating_point.magnet_temperature"))


def linkage_constant(
    linkages: Sequence[tuple[float, float, float]], positions: Sequence[float], pole_pitch: float
) -> float:
    """3/2 (π/τ) times the fundamental of the phase linkages over the window (N/A).

    The space vector of a balanced winding turns with the electrical angle; undone, its mean is the fundamental, from
    which a window of 120 electrical degrees removes every harmonic that the three phases do not share.
    """
    turned = linkage_vector(linkages, positions, pole_pitch)
    return 1.5 * pi / pole_pitch * abs(turned)


def linkage_vector(
    linkages: Sequence[tuple[float, float, float]], positions: Sequence[float], pole_pitch: float
) -> complex:
    """The mean over the window of the linkages' space vectors, turned back by the electrical angle (Wb)."""
    import numpy as np

    from fluxbore.fem.tubular import space_vector

    turned = [
        space_vector(np.array(phases)) * cmath.exp(-1j * pi * z / pole_pitch)
        for phases, z in zip(linkages, positions, strict=True)
    ]
    return sum(turned) / len(turned)


def position_result(solved: TubularSolution, pole_pitch: float) -> PositionResult:
    """What one position of the window gives."""
    from fluxbore.fem.tubular import space_vector

    thrust, linkages = solved.thrust_constants(), solved.flux_linkages()
    u, v, w = (float(value) for value in thrust)
    lu, lv, lw = (float(value) for value in linkages)
    return PositionResult(
        solved.position,
        (u, v, w),
        (lu, lv, lw),
        1.5 * abs(space_vector(thrust)),
        1.5 * pi / pole_pitch * abs(space_vector(linkages)),
        solved.cogging_force(),
        solved.convergence.iterations,
        solved.convergence.residual,
    )


def _settings(spec: Spec) -> Settings:
    from fluxbore.fem.magnetostatics import Settings

    return Settings(
        spec.number("solver.tolerance"),
        int(spec.number("solver.max_iterations")),
        "superlu" if spec.word("solver.factorisation") == "superlu" else "banded",
    )
