"""How near iron is to saturation and magnets to losing their magnetisation, part by part, over their volume."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from fluxbore.design.bh_curve import BHCurve
from fluxbore.fem.helical import HelicalSolution
from fluxbore.fem.helical_magnets import reverse_load
from fluxbore.fem.mesh import Floats
from fluxbore.fem.reluctivity import reluctivity_curve
from fluxbore.fem.tubular import TubularSolution, reverse_fields

KNEE_RISE, KNEE_PRICE = 1.1, 1.5
"""At the knee 10 % more flux density takes 50 % more field strength, as IEC 61869-2 has it for cores."""

CORNERS = 0.01
"""Of the volume, left out of ``high``: at a sharp corner the field of a finer mesh is larger without end."""

GRAIN = 1e-3
"""T, to which a knee is found: no table of a soft iron is better."""


@dataclass(frozen=True, slots=True)
class Load:
    """The field in the parts of one name, against what their material bears.

    kind : "iron", whose |B| (T) is held against the curve's knee, or "magnet", whose field strength against the
    magnetisation (A/m, none where the field helps) is held against the intrinsic coercivity.
    count : parts of this name. mean, high, largest : over the volume; 99 % of it is below ``high``.
    beyond : share of it above ``limit``.
    """

    name: str
    count: int
    kind: Literal["iron", "magnet"]
    material: str
    limit: float
    mean: float
    high: float
    largest: float
    beyond: float


def knee(curve: BHCurve) -> float:
    """B (T) beyond the steepest part of a curve at which `KNEE_RISE` more of it takes `KNEE_PRICE` more H."""
    smooth = reluctivity_curve(curve)
    b = np.arange(GRAIN, max(curve.b[-1], GRAIN) * 2, GRAIN)
    h, above = (smooth.reluctivity(x**2)[0] * x for x in (b, KNEE_RISE * b))
    begins = int(np.argmin(h / b))
    found = np.flatnonzero(above[begins:] >= KNEE_PRICE * h[begins:])
    return float(b[begins + (found[0] if found.size else 0)])


def tubular_loads(tubular: TubularSolution, coercivity: float) -> tuple[Load, ...]:
    """Of every iron and magnet of a tubular machine. coercivity : of the magnets (A/m), at their temperature."""
    cells, psi, regions = tubular.cells, tubular.solution.psi, tubular.section.regions
    weight, number = cells.weight, cells.region
    parts: dict[str, list[tuple[Floats, Floats]]] = {}
    materials: dict[str, BHCurve | str] = {}
    for index, region in enumerate(regions):
        if region.material is not None and region.material.curve is not None:
            own = np.flatnonzero(number == index)
            size = np.hypot(*cells.fields(psi, own))
            parts.setdefault(_stem(region.name), []).append((weight[own], size))
            materials[_stem(region.name)] = region.material.curve
    for index, own, against in reverse_fields(tubular):
        material, name = regions[index].material, _stem(regions[index].name)
        parts.setdefault(name, []).append((weight[own], np.maximum(against, 0.0)))
        materials[name] = material.name if material is not None else ""
    names, found = [_stem(item.region.name) for item in tubular.section.rectangles], []
    for name, pieces in parts.items():
        what, count = materials[name], names.count(name)
        if isinstance(what, str):
            found.append(_load(name, count, "magnet", what, coercivity, pieces))
        else:
            found.append(_load(name, count, "iron", what.name, knee(what), pieces))
    return tuple(found)


def screw_loads(solution: HelicalSolution, coercivity: Mapping[int, tuple[str, float]]) -> tuple[Load, ...]:
    """Of every iron and every layer of magnets of a lead screw. coercivity : layer -> grade and H_cJ (A/m)."""
    system, layers, found = solution.system, solution.section.layers, []
    for index, layer in enumerate(layers):
        if index in coercivity:
            grade, limit = coercivity[index]
            weight, load = reverse_load(solution, {index: limit})
            found.append(_load(layer.name, 1, "magnet", grade, limit, [(weight, np.maximum(load, 0.0) * limit)]))
        elif layer.curve is not None:
            elements = np.flatnonzero(system.grid.layer == index)
            size = np.linalg.norm(solution.flux_density(elements), axis=-1)
            pieces = [(system.kernel.weight[elements], size)]
            found.append(_load(layer.name, 1, "iron", layer.curve.name, knee(layer.curve), pieces))
    return tuple(found)


def _load(
    name: str,
    count: int,
    kind: Literal["iron", "magnet"],
    material: str,
    limit: float,
    pieces: Iterable[tuple[Floats, Floats]],
) -> Load:
    """Weights and values of each part of this name, put together."""
    pairs = list(pieces)
    weight, value = (np.concatenate([pair[i].ravel() for pair in pairs]) for i in (0, 1))
    order = np.argsort(value)
    reached = np.cumsum(weight[order]) / weight.sum()
    high = float(value[order][min(int(np.searchsorted(reached, 1 - CORNERS)), value.size - 1)])
    mean, beyond = float(weight @ value / weight.sum()), float(weight[value > limit].sum() / weight.sum())
    return Load(name, count, kind, material, limit, mean, high, float(value.max()), beyond)


def _stem(name: str) -> str:
    """``ring 3`` is one of the rings."""
    return re.sub(r"[\s_-]*\d+$", "", name)
