"""The figures that describe a design, the same for every route that computes them.

Network and finite elements fill the same type, so that they differ by one subtraction; a figure that a route cannot
give is ``None``, never a guess.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields

from fluxbore.design.units import DIMENSIONS, format_quantity


def _figure(dimension: str, doc: str) -> float | None:
    return field(default=None, metadata={"dimension": dimension, "doc": doc})


@dataclass(frozen=True, slots=True, kw_only=True)
class Performance:
    """Figures of one design, SI units; the unit and meaning of each stand in `FIGURES`."""

    force_constant: float | None = _figure(
        "force constant",
        "thrust per ampere of balanced three-phase current amplitude on the q axis, incremental at no current, "
        "mean over the window of positions; by the stress tensor in the FEM, by equation (2) in the network",
    )
    force_constant_linkage: float | None = _figure(
        "force constant", "the same from the fundamental of the phases' flux linkages: 3/2 (pi/tau) lambda_1"
    )
    motor_constant: float | None = _figure("motor constant", "force constant over the root of 3/2 the phase resistance")
    winding_resistance: float | None = _figure("resistance", "of one phase, at the winding's temperature")
    turns: float | None = _figure("count", "turns of one phase; fractional where a density of turns is held")
    pneumatic_force_advance: float | None = _figure("force", "gauge pressure times the catalogue bore's area")
    pneumatic_force_retract: float | None = _figure("force", "the same less the shaft's area")
    moving_mass: float | None = _figure("mass", "shaft, magnets, rings and pistons")
    total_mass: float | None = _figure("mass", "all parts")
    stray_field: float | None = _figure(
        "flux density",
        "largest flux density at no current on a cylinder 5 mm outside the yoke, from 20 mm before to 20 mm beyond it, "
        "over the window",
    )
    yoke_flux_density: float | None = _figure(
        "flux density",
        "axial flux density averaged over the yoke's cross-section, largest along it and over the window",
    )
    ring_flux_density: float | None = _figure(
        "flux density", "radial flux density at the outside of an inner soft-magnetic ring, mean over its width"
    )
    gap_flux_density: float | None = _figure(
        "flux density", "mean radial flux density at the cylinder's outside over tau_f + 2 g_ac around a pole"
    )
    cogging_force: float | None = _figure("force", "largest axial force at no current over the window")
    demagnetised_fraction: float | None = _figure(
        "fraction", "share of the magnets' volume whose reverse field exceeds the intrinsic coercivity at temperature"
    )
    electric_loading: float | None = _figure(
        "electric loading", "peak K_sp of the sinusoidal current sheet at the spec's current"
    )
    copper_loss: float | None = _figure("power", "3/2 I^2 R at the spec's current amplitude")
    outer_diameter: float | None = _figure("length", "of the whole actuator")
    length: float | None = _figure("length", "of the stator over its end caps")


@dataclass(frozen=True, slots=True)
class Figure:
    """What a figure is: its dimension's name, SI unit, preferred unit and meaning."""

    name: str
    dimension: str
    si: str
    doc: str


SMALL_FIELD = 0.01
"""T, below which a flux density is shown in millitesla."""

_PLAIN = {"count": "1", "fraction": "1", "power": "W"}

FIGURES: dict[str, Figure] = {
    item.name: Figure(
        item.name,
        item.metadata["dimension"],
        _PLAIN.get(item.metadata["dimension"]) or DIMENSIONS[item.metadata["dimension"]].si,
        item.metadata["doc"],
    )
    for item in fields(Performance)
}
"""Every figure by name, in the order of the results table."""


def to_mapping(performance: Performance) -> dict[str, float | None]:
    """Figure name -> value, in the order of `FIGURES`."""
    return {name: getattr(performance, name) for name in FIGURES}


def from_mapping(values: Mapping[str, float | None]) -> Performance:
    """The inverse of `to_mapping`; names that no longer exist are a TypeError, which a journal's hash rules out."""
    return Performance(**values)


def show_figure(name: str, value: float | None, digits: int = 5) -> str:
    """A figure in its preferred unit."""
    if value is None:
        return "-"
    figure = FIGURES[name]
    if figure.dimension == "fraction":
        return f"{100 * value:.{digits}g} %"
    if figure.dimension == "flux density" and 0 < abs(value) < SMALL_FIELD:
        return f"{1e3 * value:.{digits}g} mT"
    if figure.dimension in DIMENSIONS:
        return format_quantity(value, figure.dimension, digits)
    return f"{value:.{digits}g}" + ("" if figure.si == "1" else f" {figure.si}")
