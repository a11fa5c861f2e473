"""What the properties of a FEMM file say: points, boundaries, materials and circuits."""

from __future__ import annotations

from fluxbore.design.bh_curve import MU_0
from fluxbore.fem.femm_model import (
    BlockProperty,
    BoundaryKind,
    BoundaryProperty,
    CircuitProperty,
    Lamination,
    PointProperty,
)
from fluxbore.fem.femm_text import Property, Row

BOUNDARY_KINDS: dict[int, BoundaryKind] = {0: "prescribed", 2: "mixed", 4: "periodic", 5: "antiperiodic"}
"""By BdryType."""

UNSUPPORTED_BOUNDARIES = {
    1: "small skin depth",
    3: "strategic dual image",
    6: "periodic air gap",
    7: "antiperiodic air gap",
}
"""By BdryType; they are refused where a line uses them."""

_WIRES: dict[int, Lamination] = dict.fromkeys(range(3, 9), "wire")
LAMINATIONS: dict[int, Lamination] = {0: "in plane", 1: "parallel to x", 2: "parallel to y", **_WIRES}
"""By LamType. The wires are magnet wire, plain and Litz strands, square wire and two of copper-clad aluminium: FEMM
gives them the permeability of air."""

PERMEABILITIES = (1e-6, 1e12)
COERCIVITY = 1e9
"""A/m, a thousand times the strongest magnet's: beyond it stands a wrong unit."""

MOST_AMPERES = 1e12
"""Of currents, and in MA/m² of their densities: beyond them, and beyond the next three, stands a wrong number."""

MOST_POTENTIAL = 1e12
"""Wb/m, also per unit of length or degree."""

MOST_C0, MOST_C1 = 1e15, 1e12
"""1/H, where a condition of a layer of air has 1e9 at a millimetre; A/m."""

MOST_CONDUCTIVITY = 1e12
"""MS/m; copper has 58."""

STRONGEST = 100.0
"""T, the greatest B of a table: beyond it B is in gauss, or the columns are swapped."""

SLOPE = 0.5
"""The least slope of a table, in μ0. No material is below 1, but FEMM's own library has steels at 0.95."""


def point_property(found: Property) -> PointProperty:
    """A current where there is one, and a prescribed potential otherwise, as FEMM takes it."""
    _real(found, "i_im")
    name, current = found.string("pointname", "New Point Property"), found.number("i_re", most=MOST_AMPERES)
    if current:
        return PointProperty(name, None, current)
    _real(found, "a_im")
    return PointProperty(name, found.number("a_re", most=MOST_POTENTIAL))


def boundary_property(found: Property) -> BoundaryProperty:
    """One of a kind that is not supported becomes an empty mixed condition: the numbering of the others stays."""
    name, number = found.string("bdryname", "New Boundary"), found.integer("bdrytype")
    kind = BOUNDARY_KINDS.get(number)
    if kind is None and number not in UNSUPPORTED_BOUNDARIES:
        raise found.error("bdrytype", f"must be from 0 to 7; got {number}.")
    if kind == "prescribed":
        a0, a1, a2 = (found.number(key, most=MOST_POTENTIAL) for key in ("a_0", "a_1", "a_2"))
        return BoundaryProperty(name, kind, a0, a1, a2, found.number("phi"))
    if kind == "mixed":
        _real(found, "c0i")
        _real(found, "c1i")
        return BoundaryProperty(name, kind, c0=found.number("c0", most=MOST_C0), c1=found.number("c1", most=MOST_C1))
    return BoundaryProperty(name, kind or "mixed")


def unsupported(found: Property) -> str | None:
    """The name of a boundary's kind, where a line that uses it must be refused."""
    return UNSUPPORTED_BOUNDARIES.get(found.integer("bdrytype"))


def block_property(found: Property) -> BlockProperty:
    mu_x, mu_y = (_permeability(found, key) for key in ("mu_x", "mu_y"))
    coercivity, conductivity = found.number("h_c"), found.number("sigma", power=6, most=MOST_CONDUCTIVITY)
    if abs(coercivity) > COERCIVITY:
        raise found.error("h_c", f"must be at most {COERCIVITY:g} A/m; got {coercivity:g}.")
    if conductivity < 0:
        raise found.error("sigma", f"must not be negative; got {conductivity / 1e6:g} MS/m.")
    _real(found, "j_im")
    number = found.integer("lamtype")
    if number not in LAMINATIONS:
        raise found.error("lamtype", f"must be from 0 to {max(LAMINATIONS)}; got {number}.")
    curve = _curve(found)
    return BlockProperty(
        name=found.string("blockname", "New Material"),
        mu_x=mu_x,
        mu_y=mu_y,
        coercivity=coercivity,
        current_density=found.number("j_re", power=6, most=MOST_AMPERES),
        conductivity=conductivity,
        lamination=LAMINATIONS[number],
        fill=_fill(found, matters=bool(curve) or (mu_x, mu_y) != (1.0, 1.0)),
        curve=curve,
    )


def circuit_property(found: Property) -> CircuitProperty:
    _real(found, "totalamps_im")
    # Files of FEMM 4.0 may still drive a circuit by a voltage gradient, which needs eddy currents.
    for key in ("voltgradient_re", "voltgradient_im"):
        if found.number(key):
            raise found.error(key, "must be 0: circuits driven by a voltage gradient are not supported.")
    number = found.integer("circuittype")
    if number not in (0, 1):
        raise found.error("circuittype", f"must be 0 for parallel or 1 for series; got {number}.")
    return CircuitProperty(
        found.string("circuitname", "New Circuit"), found.number("totalamps_re", most=MOST_AMPERES), number == 1
    )


def _real(found: Property, key: str) -> None:
    if value := found.number(key):
        raise found.error(key, f"must be 0, as imaginary parts belong to time-harmonic problems; got {value:g}.")


def _permeability(found: Property, key: str) -> float:
    value, (least, most) = found.number(key, 1.0), PERMEABILITIES
    if not least <= value <= most:
        raise found.error(key, f"must be a relative permeability from {least:g} to {most:g}; got {value:g}.")
    return value


def _fill(found: Property, matters: bool) -> float:
    """Scripts leave 0 in materials like air, which fill nothing."""
    fill = found.number("lamfill", 1.0)
    if fill == 0 and not matters:
        return 1.0
    if not 0 < fill <= 1:
        raise found.error("lamfill", f"must be above 0 and at most 1; got {fill:g}.")
    return fill


def _curve(found: Property) -> tuple[tuple[float, float], ...]:
    """Rows (B in T, H in A/m), strictly increasing from the origin or above it.

    Weaker than `BHCurve`: FEMM takes every table, and some of its own fall a little short of the vacuum's slope.
    """
    curve: list[tuple[float, float]] = []
    for row in found.curve:
        b, h = row.number(0, "B"), row.number(1, "H")
        if b > STRONGEST:
            raise row.error(f"B must be at most {STRONGEST:g} T; got {b:g}.")
        if curve or (b, h) != (0.0, 0.0):
            _check_rise(row, curve[-1] if curve else (0.0, 0.0), (b, h))
        curve.append((b, h))
    if curve and len(curve) + (curve[0] != (0.0, 0.0)) < 3:
        raise found.error("bhpoints", f"must be at least 3 with the origin, or 0; got {len(curve)}.")
    return tuple(curve)


def _check_rise(row: Row, before: tuple[float, float], here: tuple[float, float]) -> None:
    db, dh = here[0] - before[0], here[1] - before[1]
    at, after = (f"B = {b:g} T, H = {h:g} A/m" for b, h in (here, before))
    if db <= 0 or dh <= 0:
        raise row.error(f"The B-H table must rise in both columns after {after}; got {at}.")
    if db < SLOPE * MU_0 * dh:
        raise row.error(f"The B-H table must rise at least {SLOPE:g} times as steeply as air after {after}; got {at}.")
