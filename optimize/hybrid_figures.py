"""The hybrid actuator's figures, by the analytic network and by finite elements.

Both routes fill the same `Performance`; what neither field model decides (resistance, forces of the air, masses) is
computed once, by the same functions, for both.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from fluxbore.design import magnetic_network, winding
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.hybrid_values import positions as window
from fluxbore.design.materials import PermanentMagnet, lookup
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import NOT_CONVERGED, OK, Evaluation, PositionResult, failure
from fluxbore.optimize.hybrid_common import common_figures, warnings

if TYPE_CHECKING:
    from fluxbore.fem.tubular import TubularSolution

STRAY_OVERHANG = 0.02
"""m before and beyond the yoke over which the stray field is read."""


def by_network(spec: Spec, gradient: Sequence[str] = ()) -> Evaluation:
    """The figures by the magnetic network, which stands for mid-stroke. Raises DesignError or MaterialError."""
    actuator: HybridActuator = spec.actuator
    common = common_figures(spec, actuator)
    solved = magnetic_network.network(actuator, spec.materials, spec.number("operating_point.magnet_temperature"))
    assert common.winding_resistance is not None
    performance = replace(
        common,
        force_constant=solved.force_constant,
        motor_constant=winding.motor_constant(solved.force_constant, common.winding_resistance),
        gap_flux_density=solved.gap_flux_density,
        ring_flux_density=solved.ring_flux_density,
        yoke_flux_density=solved.yoke_flux_density,
    )
    details = {
        "remanent_mmf": solved.remanent_mmf,
        "magnet_reluctance": solved.magnet_reluctance,
        "gap_reluctance": solved.gap_reluctance,
        "leakage_reluctance": solved.leakage_reluctance,
        "effective_gap": solved.effective_gap,
    }
    return Evaluation("network", OK, (), performance, details=details, warnings=warnings(spec, performance))


def solve_window(spec: Spec, positions: tuple[float, ...] | None = None) -> list[TubularSolution]:
    """The design's field at no current at each position of the spec's window, or at other positions (m)."""
    from fluxbore.fem.magnetostatics import Settings
    from fluxbore.fem.tubular import solve_positions
    from fluxbore.geometry.hybrid import cross_section

    actuator: HybridActuator = spec.actuator
    temperature = spec.number("operating_point.magnet_temperature")
    settings = Settings(
        spec.number("solver.tolerance"),
        int(spec.number("solver.max_iterations")),
        "superlu" if spec.word("solver.factorisation") == "superlu" else "banded",
    )
    return solve_positions(
        lambda position: cross_section(actuator, position, spec.materials, temperature),
        window(spec.values) if positions is None else positions,
        settings,
        int(spec.number("solver.mesh_refinement")),
    )


def by_fem(spec: Spec, gradient: Sequence[str] = ()) -> Evaluation:
    """The figures by finite elements over the window of positions. Raises DesignError or MaterialError."""
    actuator: HybridActuator = spec.actuator
    common = common_figures(spec, actuator)
    solved = solve_window(spec)
    last = solved[-1]
    if not last.convergence.converged:
        where = f"At z = {last.position * 1e3:.4g} mm: "
        return failure("fem", NOT_CONVERGED, where + last.convergence.sentence())
    positions = tuple(_position(item, actuator.mover.pole_pitch) for item in solved)
    force_constant = sum(item.force_constant for item in positions) / len(positions)
    assert common.winding_resistance is not None
    performance = replace(
        _field_figures(spec, actuator, common, solved),
        force_constant=force_constant,
        force_constant_linkage=_linkage_constant(positions, actuator.mover.pole_pitch),
        motor_constant=winding.motor_constant(force_constant, common.winding_resistance),
        cogging_force=max(abs(item.cogging_force) for item in positions),
    )
    topology = last.grid.mesh.topology
    details = {
        "elements": float(topology.elements.shape[0]),
        "unknowns": float(topology.unknowns),
        "newton_iterations": float(sum(item.iterations for item in positions)),
        "largest_residual": max(item.residual for item in positions),
    }
    return Evaluation("fem", OK, (), performance, positions, details, warnings(spec, performance))


def _position(solved: TubularSolution, pole_pitch: float) -> PositionResult:
    from math import pi

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


def _linkage_constant(positions: tuple[PositionResult, ...], pole_pitch: float) -> float:
    """3/2 (π/τ) times the fundamental of the phase linkages over the window (N/A).

    The space vector of a balanced winding turns with the electrical angle; undone, its mean is the fundamental, from
    which a window of 120 electrical degrees removes every harmonic that the three phases do not share.
    """
    import cmath
    from math import pi

    import numpy as np

    from fluxbore.fem.tubular import space_vector

    turned = [
        space_vector(np.array(item.flux_linkages)) * cmath.exp(-1j * pi * item.position / pole_pitch)
        for item in positions
    ]
    return 1.5 * pi / pole_pitch * abs(sum(turned) / len(turned))


def _field_figures(
    spec: Spec, actuator: HybridActuator, common: Performance, solved: list[TubularSolution]
) -> Performance:
    """The flux densities, each the largest over the window but for the gap's and the ring's, which are means."""
    from fluxbore.fem.tubular import demagnetised_fraction, shell_flux_density, stray_field, tube_flux_density
    from fluxbore.geometry.hybrid import STRAY_DISTANCE

    yoke = (actuator.back_yoke.inner_diameter / 2, actuator.back_yoke.outer_diameter / 2)
    ends = (actuator.yoke_start - STRAY_OVERHANG, actuator.yoke_end + STRAY_OVERHANG)
    mover = actuator.mover
    grade = lookup(mover.magnet, "actuator.mover.magnet", spec.materials, PermanentMagnet)
    coercivity = grade.coercivity_at(spec.number("operating_point.magnet_temperature"))
    # The inner ring next to the array's middle is the least touched by the ends.
    inner_ring = mover.pole_pairs * mover.pole_pitch
    half_shell = min(mover.ring_width / 2 + actuator.air_gap, mover.pole_pitch / 2)

    def at_ring(radius: float, half_width: float) -> float:
        return sum(
            shell_flux_density(
                item, radius, (item.position + inner_ring - half_width, item.position + inner_ring + half_width)
            )
            for item in solved
        ) / len(solved)

    return replace(
        common,
        stray_field=max(stray_field(item, yoke[1] + STRAY_DISTANCE, ends) for item in solved),
        yoke_flux_density=max(
            tube_flux_density(item, yoke, (actuator.yoke_start, actuator.yoke_end)) for item in solved
        ),
        ring_flux_density=at_ring(mover.outer_diameter / 2, mover.ring_width / 2) if mover.ring_width > 0 else None,
        gap_flux_density=at_ring(actuator.cylinder.outer_diameter / 2, half_shell),
        demagnetised_fraction=max(demagnetised_fraction(item, coercivity) for item in solved),
    )
