"""The hybrid actuator's figures, by the analytic network and by finite elements.

Both routes fill the same `Performance`; what neither field model decides (resistance, forces of the air, masses) is
computed once, by the same functions, for both.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from fluxbore.design import magnetic_network
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import NOT_CONVERGED, OK, Evaluation, failure
from fluxbore.optimize.hybrid_common import common_figures, derived, warnings
from fluxbore.optimize.hybrid_field import field_figures, position_result, solve_field, solve_window
from fluxbore.optimize.partials import closed_gradient

__all__ = ["by_fem", "by_network", "solve_window"]


def complete(spec: Spec, field: Mapping[str, float | None]) -> Performance:
    """All figures of a design from those of its field, by name: what needs none of it, and what follows from it."""
    return derived(spec, replace(common_figures(spec, spec.actuator), **field))


def by_network(spec: Spec, gradient: Sequence[str] = ()) -> Evaluation:
    """The figures by the magnetic network, which stands for mid-stroke. Raises DesignError or MaterialError."""
    solved = _network(spec)
    performance = complete(spec, _network_figures(solved))
    details = {
        "remanent_mmf": solved.remanent_mmf,
        "magnet_reluctance": solved.magnet_reluctance,
        "gap_reluctance": solved.gap_reluctance,
        "leakage_reluctance": solved.leakage_reluctance,
        "effective_gap": solved.effective_gap,
    }
    found = Evaluation("network", OK, (), performance, details=details, warnings=warnings(spec, performance))
    if not gradient:
        return found
    return replace(
        found,
        gradient=closed_gradient(spec, gradient, lambda moved, *_: complete(moved, _network_figures(_network(moved)))),
        norms={},
    )


def _network(spec: Spec) -> magnetic_network.MagneticNetwork:
    actuator: HybridActuator = spec.actuator
    return magnetic_network.network(actuator, spec.materials, spec.number("operating_point.magnet_temperature"))


def _network_figures(solved: magnetic_network.MagneticNetwork) -> dict[str, float | None]:
    return {
        "force_constant": solved.force_constant,
        "gap_flux_density": solved.gap_flux_density,
        "ring_flux_density": solved.ring_flux_density,
        "yoke_flux_density": solved.yoke_flux_density,
    }


def by_fem(spec: Spec, gradient: Sequence[str] = ()) -> Evaluation:
    """The figures by finite elements over the window of positions. Raises DesignError or MaterialError."""
    actuator: HybridActuator = spec.actuator
    common_figures(spec, actuator)  # what cannot be built is refused before anything is solved
    field = solve_field(spec)
    if field.failure is not None:
        where, convergence = field.failure
        return failure("fem", NOT_CONVERGED, where + convergence.sentence())
    positions = tuple(position_result(item, actuator.mover.pole_pitch) for item in field.window)
    figures = field_figures(spec, field, positions)
    performance = complete(spec, figures)
    grid = field.middle.grid
    details = {
        "cells": float(grid.region.size),
        "unknowns": float(grid.topology.unknowns),
        "newton_iterations": float(sum(item.convergence.iterations for item in (*field.window, *field.peaks))),
        "largest_residual": max(item.convergence.residual for item in (*field.window, *field.peaks)),
    }
    found = Evaluation("fem", OK, (), performance, positions, details, warnings(spec, performance))
    if not gradient:
        return found
    from fluxbore.optimize import hybrid_gradient

    slopes, norms = hybrid_gradient.gradient(spec, field, positions, figures, gradient, complete)
    return replace(found, gradient=slopes, norms=norms)
