"""The published lead screw's cross-section: RotLin, Table I, over one period; both its members with or without iron."""

from __future__ import annotations

from dataclasses import replace

from fluxbore.design.bh_curve import BHCurve
from fluxbore.geometry.helical_bands import Profile
from fluxbore.geometry.helical_section import HelicalSection, Layer

PERIOD = 5.1429e-3
"""m; the table's pitch length, which is a full period (docs/helical.md)."""

POLES = 4
"""Axial poles of the rotor, two in a period."""


def ideal(inner: Profile, outer: Profile, displacement: float = 0.0, lead: float = PERIOD) -> HelicalSection:
    """Infinitely permeable iron behind the magnets of translator and rotor."""
    layers = (
        Layer("translator magnets", 17.45e-3, 1.05, magnets=inner),
        Layer("gap", 18.25e-3),
        Layer("rotor magnets", 20.75e-3, 1.05, magnets=outer),
    )
    return HelicalSection(14.95e-3, layers, 1, PERIOD, lead, displacement, "iron", "iron")


def backed(
    profile: Profile,
    permeability: float = 1.0,
    curve: BHCurve | None = None,
    thickness: float = 5.5e-3,
    displacement: float = PERIOD / 4,
    lead: float = PERIOD,
) -> HelicalSection:
    """Iron of a thickness (m) behind both magnets, then a period of air; of linear permeability, or with a curve."""
    iron = Layer("iron", 0.0, permeability, curve)
    layers = (
        Layer("bore", 14.95e-3 - thickness),
        replace(iron, outer_radius=14.95e-3),
        Layer("translator magnets", 17.45e-3, 1.05, magnets=profile),
        Layer("gap", 18.25e-3),
        Layer("rotor magnets", 20.75e-3, 1.05, magnets=profile),
        replace(iron, outer_radius=20.75e-3 + thickness),
        Layer("air", 20.75e-3 + thickness + PERIOD),
    )
    return HelicalSection(14.95e-3 - thickness - PERIOD, layers, 3, PERIOD, lead, displacement)
