"""A case of the validation gallery: a model, what is asked of it, and what is right."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from fluxbore.fem.femm_model import FemmModel

LINKAGE, ENERGY, FLUX_DENSITY, FORCE = 0.003, 0.003, 0.003, 0.005
"""Relative tolerances at the solver's default accuracy."""

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Check:
    """One quantity.

    name : with {0} and {1} in the place of the coordinates' letters. exact : SI. scale : what an error is relative to,
    the size of a vector for its components. tolerance : relative. path : keys and indices into a result; within the
    entry of its point, where it has one. at : in the file's unit.
    """

    name: str
    exact: float
    unit: str
    tolerance: float
    scale: float
    path: tuple[str | int, ...]
    at: Point | None = None

    def read(self, result: Mapping[str, Any]) -> float:
        """The quantity in a result of the JSON contract."""
        found: Any = result
        if self.at is not None:
            found = next(item for item in result["points"] if np.allclose(item["at"], self.at, rtol=1e-9, atol=1e-12))
        for key in self.path:
            found = found[key]
        return float(found)

    def error(self, result: Mapping[str, Any]) -> float:
        """(found − exact)/scale."""
        return (self.read(result) - self.exact) / self.scale

    def holds(self, result: Mapping[str, Any]) -> bool:
        return abs(self.error(result)) <= self.tolerance


@dataclass(frozen=True, slots=True)
class Case:
    """A model and what is right about it.

    source : of the exact values. open_boundary : the outermost curve is to be continued by an open boundary; it carries
    A = 0 for those who do not. pairs : groups whose forces must cancel.
    """

    name: str
    title: str
    model: FemmModel
    checks: tuple[Check, ...]
    source: str
    notes: str = ""
    open_boundary: bool = False
    pairs: tuple[tuple[int, int], ...] = ()

    @property
    def points(self) -> tuple[Point, ...]:
        """Where the field is asked for, in the file's unit."""
        return tuple(dict.fromkeys(check.at for check in self.checks if check.at is not None))

    def label(self, check: Check) -> str:
        """The check's name in this case's coordinates."""
        return check.name.format(*("r", "z") if self.model.axisymmetric else ("x", "y"))

    @property
    def groups(self) -> tuple[int, ...]:
        """Whose force or torque is asked for."""
        return tuple(dict.fromkeys(int(check.path[1]) for check in self.checks if check.path[0] == "groups"))


def linkage(circuit: str, exact: float, scale: float | None = None) -> Check:
    """Of a circuit (Wb)."""
    path = ("circuits", circuit, "flux_linkage")
    return Check(f"flux linkage of {circuit}", exact, "Wb", LINKAGE, scale or abs(exact), path)


def energy(exact: float) -> Check:
    return Check("energy", exact, "J", ENERGY, abs(exact), ("energy",))


def coenergy(exact: float) -> Check:
    return Check("coenergy", exact, "J", ENERGY, abs(exact), ("coenergy",))


def force(group: int, axis: int, exact: float, scale: float | None = None, tolerance: float = FORCE) -> Check:
    """axis : 0 for x, 1 for y or z. exact : N."""
    name = f"force on group {group} along {{{axis}}}"
    return Check(name, exact, "N", tolerance, scale or abs(exact), ("groups", str(group), "force", axis))


def torque(group: int, exact: float) -> Check:
    """About the origin (N m)."""
    return Check(f"torque on group {group}", exact, "N m", FORCE, abs(exact), ("groups", str(group), "torque"))


def potential(at: Point, exact: float, scale: float | None = None) -> Check:
    """A, or r A_φ (Wb/m, Wb/rad)."""
    return Check(f"A at {_shown(at)}", exact, "Wb/m", FLUX_DENSITY, scale or abs(exact), ("A",), at)


def flux_density(at: Point, exact: ArrayLike, scale: float | None = None) -> tuple[Check, Check]:
    """Both components of B (T), relative to |B|."""
    vector = np.asarray(exact, dtype=float)
    size = scale or float(np.hypot(*vector))
    first, second = (
        Check(f"B_{{{axis}}} at {_shown(at)}", float(vector[axis]), "T", FLUX_DENSITY, size, ("B", axis), at)
        for axis in (0, 1)
    )
    return first, second


def _shown(at: Sequence[float]) -> str:
    return f"({at[0]:g}, {at[1]:g})"
