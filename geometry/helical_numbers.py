"""All that is continuous in a helical section as one vector: what its field's gradients are derivatives by."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fluxbore.geometry.helical_bands import Bands
from fluxbore.geometry.helical_section import HelicalSection


def numbers(section: HelicalSection) -> NDArray[np.float64]:
    """The radii from the inside out, period, lead and displacement (m), each layer's relative permeability, then of
    each layer of magnets each segment's start (of the period), first and last remanence (T)."""
    return np.array(
        [
            *section.radii,
            section.period,
            section.lead,
            section.displacement,
            *(layer.permeability for layer in section.layers),
            *(
                value
                for _, bands in magnets(section)
                for part in bands.segments
                for value in (part.start, part.first, part.last)
            ),
        ]
    )


def period_and_displacement(section: HelicalSection) -> tuple[int, int]:
    """Their places in `numbers`."""
    return len(section.layers) + 1, len(section.layers) + 3


def magnets(section: HelicalSection) -> list[tuple[int, Bands]]:
    """Number and bands of each layer of magnets, from the inside out."""
    return [(k, layer.magnets) for k, layer in enumerate(section.layers) if isinstance(layer.magnets, Bands)]


def alike(one: HelicalSection, other: HelicalSection) -> bool:
    """Whether two sections differ by their `numbers` only."""
    return (
        (one.inside, one.outside, one.gap) == (other.inside, other.outside, other.gap)
        and (one.inner_radius == 0) == (other.inner_radius == 0)
        and [(layer.name, layer.curve) for layer in one.layers] == [(layer.name, layer.curve) for layer in other.layers]
        and [_pattern(bands) for _, bands in magnets(one)] == [_pattern(bands) for _, bands in magnets(other)]
    )


def _pattern(bands: Bands) -> tuple[bool, tuple[bool, ...]]:
    return bands.antisymmetric, tuple(part.magnet for part in bands.segments)
