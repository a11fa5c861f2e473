"""The magnetic cross-section of an axisymmetric machine: a stack of rectangles in plain numbers.

Sorted breakpoints in r and z cut the half plane into cells, each cell belongs to one region, and coils are windows
that need not follow the breakpoints. The finite elements and the drawings read this; neither knows the actuator.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.materials import Material


@dataclass(frozen=True, slots=True)
class Breakpoints:
    """Sorted breakpoints (m) along one axis, and a name for each interval between two of them.

    The interval's name says what lies there ("magnet", "ring"), so that a mesh can give every design the same number
    of elements in it. Intervals of zero length do not occur: what vanishes leaves no interval.
    """

    values: tuple[float, ...]
    intervals: tuple[str, ...]

    def __post_init__(self) -> None:
        assert len(self.values) == len(self.intervals) + 1
        assert all(a < b for a, b in zip(self.values, self.values[1:], strict=False))


@dataclass(frozen=True, slots=True)
class Region:
    """A part as the field sees it.

    remanence : axial remanent flux density (T), signed; recoil_permeability : relative, of a magnet (else 1).
    """

    name: str
    material: Material | None
    remanence: float = 0.0
    recoil_permeability: float = 1.0


@dataclass(frozen=True, slots=True)
class Rectangle:
    """Where a region lies: r and z from lower to upper (m)."""

    region: Region
    r: tuple[float, float]
    z: tuple[float, float]


@dataclass(frozen=True, slots=True)
class CoilWindow:
    """The cross-section of one coil with its turns evenly spread over it; positive turns carry current along +phi."""

    circuit: str
    turns: float
    r: tuple[float, float]
    z: tuple[float, float]

    @property
    def area(self) -> float:
        return (self.r[1] - self.r[0]) * (self.z[1] - self.z[0])


@dataclass(frozen=True, slots=True)
class CrossSection:
    """The whole half plane r >= 0 that is computed.

    cells : (intervals in z, intervals in r) index into ``regions``; ``regions[0]`` is air.
    rectangles : the parts as they were laid down, for drawing.
    force_annulus : the cylinder shell (r from, r to) without iron or magnets in which the mover's force is measured.
    """

    r: Breakpoints
    z: Breakpoints
    regions: tuple[Region, ...]
    cells: NDArray[np.int_]
    coils: tuple[CoilWindow, ...]
    rectangles: tuple[Rectangle, ...]
    force_annulus: tuple[float, float]

    @property
    def ends(self) -> tuple[float, float]:
        """z (m) between which all iron, magnets and coils lie; beyond is air."""
        z = [*(z for part in self.rectangles for z in part.z), *(z for coil in self.coils for z in coil.z)]
        return min(z), max(z)


AIR = Region("air", None)


def numbers(section: CrossSection) -> NDArray[np.float64]:
    """All that is continuous in a cross-section as one vector, SI: what shape gradients are derivatives by.

    The breakpoints in r and in z, then of each coil its r from and to, z from and to, then the coils' turns, the
    regions' remanences, their recoil permeabilities, and `CrossSection.ends`.
    """
    return np.concatenate(
        (
            section.r.values,
            section.z.values,
            np.array([(*coil.r, *coil.z) for coil in section.coils]).ravel(),
            [coil.turns for coil in section.coils],
            [region.remanence for region in section.regions],
            [region.recoil_permeability for region in section.regions],
            section.ends,
        )
    )


def alike(one: CrossSection, other: CrossSection) -> bool:
    """Whether two sections differ by their `numbers` only."""
    return (
        one.r.intervals == other.r.intervals
        and one.z.intervals == other.z.intervals
        and np.array_equal(one.cells, other.cells)
        and [coil.circuit for coil in one.coils] == [coil.circuit for coil in other.coils]
        and [(region.name, region.material) for region in one.regions]
        == [(region.name, region.material) for region in other.regions]
    )


def paint(
    r: Breakpoints, z: Breakpoints, rectangles: Sequence[Rectangle]
) -> tuple[tuple[Region, ...], NDArray[np.int_]]:
    """Regions and cells from rectangles whose edges are breakpoints; later rectangles cover earlier ones."""
    regions = [AIR]
    cells = np.zeros((len(z.intervals), len(r.intervals)), dtype=int)
    r_middle, z_middle = ([(a + b) / 2 for a, b in pairwise(points.values)] for points in (r, z))
    for rectangle in rectangles:
        if rectangle.region not in regions:
            regions.append(rectangle.region)
        columns, rows = (
            slice(bisect_left(middle, start), bisect_left(middle, end))
            for middle, (start, end) in ((r_middle, rectangle.r), (z_middle, rectangle.z))
        )
        cells[rows, columns] = regions.index(rectangle.region)
    return tuple(regions), cells


def breakpoints(values: Sequence[float], names: Sequence[str], smallest: float) -> Breakpoints:
    """Breakpoints from a sorted list in which neighbours closer than ``smallest`` (m) are one."""
    kept, intervals = [values[0]], []
    for value, name in zip(values[1:], names, strict=True):
        if value - kept[-1] > smallest:
            kept.append(value)
            intervals.append(name)
    return Breakpoints(tuple(kept), tuple(intervals))
