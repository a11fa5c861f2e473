"""The lead screw's magnetic cross-section over one pitch, at a displacement between its members."""

from __future__ import annotations

from fluxbore.design.bh_curve import BHCurve
from fluxbore.design.lead_screw import HelicalMagnets, LeadScrew
from fluxbore.geometry.helical_arcs import averaged
from fluxbore.geometry.helical_bands import alternating
from fluxbore.geometry.helical_section import Boundary, HelicalSection, Layer

FAR = 1.0
"""Pitches of air computed where there is no ideal iron: the field has fallen by exp(−2π) there, and what that does to
the force by the square of it and more."""


def helical_section(
    screw: LeadScrew,
    displacement: float = 0.0,
    translator_curve: BHCurve | None = None,
    rotor_curve: BHCurve | None = None,
) -> HelicalSection:
    """Layers of a screw; displacement : x_d (m), of the rotor's field along the axis relative to the translator's.

    translator_curve, rotor_curve : of the iron behind the magnets. Without a curve iron is infinitely permeable,
    whatever its thickness, as in the analytic field. Bakelite, shaft and frame are air. Magnets of arcs are taken as
    their mean over all angles (`averaged`).
    """
    inner, outer, bore, rim = screw.radii
    layers: list[Layer] = []
    start, inside = inner, _beyond(screw.translator, translator_curve)
    if inside == "closed":
        iron = inner - screw.translator.iron_thickness if translator_curve else inner
        start = max(0.0, iron - FAR * screw.pitch)
        if start < iron:
            layers.append(Layer("bore", iron))
        if iron < inner:
            layers.append(Layer("translator iron", inner, curve=translator_curve))
    layers.append(_magnets(screw, "translator magnets", screw.translator, outer))
    layers.append(Layer("gap", bore))
    layers.append(_magnets(screw, "rotor magnets", screw.rotor, rim))
    gap, outside = len(layers) - 2, _beyond(screw.rotor, rotor_curve)
    if outside == "closed":
        end = screw.rotor_iron_radius if rotor_curve else rim
        if end > rim:
            layers.append(Layer("rotor iron", end, curve=rotor_curve))
        layers.append(Layer("outside", end + FAR * screw.pitch))
    lead = screw.starts * screw.pitch
    return HelicalSection(start, tuple(layers), gap, screw.pitch, lead, displacement, inside, outside)


def _beyond(member: HelicalMagnets, curve: BHCurve | None) -> Boundary:
    """What is computed behind a member's magnets: nothing beyond ideal iron."""
    return "iron" if member.iron_thickness > 0 and curve is None else "closed"


def _magnets(screw: LeadScrew, name: str, member: HelicalMagnets, radius: float) -> Layer:
    bands = alternating(member.remanence, min(1.0, 2 * member.magnet_width / screw.pitch))
    if member.arcs is not None:
        bands = averaged(bands, member.arcs, screw.starts)
    return Layer(name, radius, member.magnet_permeability, magnets=bands)
