"""How a figure is declared: a field of a dataclass with its dimension, its heading and its meaning."""

from __future__ import annotations

from dataclasses import field

FORCE, SPRING, FIELD, WINDING, DRIVE, HEAT, PRESSURE, SEAL, HYDRAULIC, TRACKING, SIZE = GROUPS = (
    "Force",
    "Magnetic spring",
    "Magnetic field",
    "Winding",
    "Drive",
    "Losses and heat",
    "Cylinder and rod",
    "Seal",
    "Hydraulics",
    "Force tracking",
    "Size and mass",
)
"""Headings under which tables for people put the figures, in this order."""


def figure(dimension: str, group: str, doc: str, *, signed: bool = False) -> float | None:
    """A field of a figure that a route may leave None. dimension : of `fluxbore.design.units`, "count" or "fraction".

    doc : its meaning. signed : whether it can fall below zero.
    """
    return field(default=None, metadata={"dimension": dimension, "group": group, "doc": doc, "signed": signed})
