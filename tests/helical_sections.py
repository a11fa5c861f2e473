"""Lead screws' sections for tests of gradients, and their numbers one by one."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from lead_screws import ARCS, PITCH, table_i

from fluxbore.design.lead_screw import LeadScrew
from fluxbore.design.materials import standard
from fluxbore.fem.helical import SETTINGS, HelicalSolution, solve
from fluxbore.geometry.helical_bands import Bands, Segment
from fluxbore.geometry.helical_numbers import magnets, numbers
from fluxbore.geometry.helical_section import HelicalSection
from fluxbore.geometry.lead_screw import helical_section

Array = np.ndarray

STEEL = standard()["1010"].curve
EXACTLY = replace(SETTINGS, tolerance=1e-10)


def members(screw: LeadScrew, **changes: object) -> LeadScrew:
    return replace(
        screw,
        translator=replace(screw.translator, **changes),  # type: ignore[arg-type]
        rotor=replace(screw.rotor, **changes),  # type: ignore[arg-type]
    )


def sections() -> dict[str, HelicalSection]:
    """Ideal iron, touching magnets; thin saturated iron, unlike magnets; no iron; arcs in steps on three starts."""
    screw = table_i()
    narrow = replace(screw.translator, magnet_width=0.4 * PITCH, iron_thickness=0.2e-3)
    thin = replace(screw, translator=narrow, rotor=replace(narrow, magnet_width=0.35 * PITCH, remanence=1.2))
    arcs = members(replace(screw, starts=3), arcs=replace(ARCS, angle=0.9))
    wide = replace(arcs, translator=replace(arcs.translator, magnet_width=0.4 * PITCH))
    return {
        "ideal": helical_section(screw, 0.21 * PITCH),
        "saturated": helical_section(thin, 0.17 * PITCH, STEEL, STEEL),
        "no iron": helical_section(table_i(False, False), 0.1 * PITCH),
        "arcs": helical_section(wide, 0.3 * PITCH, STEEL, STEEL),
    }


def from_numbers(like: HelicalSection, values: Array) -> HelicalSection:
    """The inverse of `numbers`, of a section that is like another."""
    count = len(like.layers)
    radii, (period, lead, displacement), rest = np.split(values, [count + 1, count + 4])
    permeability, ends = rest[:count], iter(rest[count:].reshape(-1, 3).tolist())
    layers = []
    for k, layer in enumerate(like.layers):
        if isinstance(layer.magnets, Bands):
            parts = [next(ends) for _ in layer.magnets.segments]
            stops = [part[0] for part in parts[1:]] + [parts[0][0] + 1]
            segments = tuple(
                Segment(start, stop, first, last, old.magnet)
                for (start, first, last), stop, old in zip(parts, stops, layer.magnets.segments, strict=True)
            )
            layer = replace(layer, magnets=Bands(segments))
        layers.append(replace(layer, outer_radius=float(radii[k + 1]), permeability=float(permeability[k])))
    return replace(
        like,
        inner_radius=float(radii[0]),
        layers=tuple(layers),
        period=float(period),
        lead=float(lead),
        displacement=float(displacement),
    )


def difference(figure: Callable[[HelicalSolution], Any], found: HelicalSolution, change: Array) -> Any:
    """Half the difference of a figure between both ends of a change of the numbers, there and back."""
    ahead, behind = (
        figure(solve(from_numbers(found.section, numbers(found.section) + end), settings=EXACTLY, start=found))
        for end in (change, -change)
    )
    return (ahead - behind) / 2


def random_changes(section: HelicalSection, seed: int) -> list[tuple[Array, float]]:
    """Directions in the radii, in the lengths along the axis, and in the magnets; each with how far to go along it.

    South bands change with the north bands, and each from end to end, the air between them staying so.
    """
    rng, count, size = np.random.default_rng(seed), len(section.radii), numbers(section).size
    across, along, within = np.zeros((3, size))
    across[:count] = rng.normal(size=count)
    along[count : count + 3] = rng.normal(size=3)
    at = 2 * count + 2
    for layer, bands in magnets(section):
        within[count + 3 + layer] = rng.normal()
        half = len(bands.segments) // 2
        starts = rng.normal(size=half)
        ends = np.array([rng.normal() if part.magnet else 0.0 for part in bands.segments[:half]])
        ends = np.column_stack((ends, ends))
        here = within[at : at + 6 * half].reshape(2 * half, 3)
        here[:half], here[half:] = np.column_stack((starts, ends)), np.column_stack((starts, -ends))
        at += 6 * half
    thinnest = 0.01 * float(np.min(np.diff(section.radii)))
    return [(across, thinnest), (along, thinnest), (within, 0.003)]
