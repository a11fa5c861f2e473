"""How a hybrid actuator's cross-sections and the places where figures are read follow from the specification's keys."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from fluxbore.design.errors import DesignError
from fluxbore.design.hybrid_values import positions as window_positions
from fluxbore.design.spec import Spec
from fluxbore.geometry.cross_section import CrossSection, alike, numbers
from fluxbore.geometry.hybrid import cross_section
from fluxbore.optimize.hybrid_field import Field, intrinsic_coercivity, peak_currents, ranges, thrust_sign
from fluxbore.optimize.partials import slope

Floats = Any

LIMITS = ("stray", "ring", "gap")

POSITION_STEP = 1e-6
"""m; dimensions are linear in the position."""


class Jacobians:
    """Derivatives by keys that a specification is given by, of all that its fields' figures depend on.

    keys : those of the wanted ones by which the cross-section keeps its topology; the columns of all arrays.
    positions : (window, keys). pitch, coercivity : (keys,). currents : (3, keys) of each peak state's phases.

    The sections at two positions differ by what moves with the mover, so one section's derivatives serve all, but for
    keys that move the positions themselves.
    """

    def __init__(self, spec: Spec, field: Field, keys: Sequence[str]) -> None:
        self._spec, self._field = spec, field
        self._first = field.window[0]
        count, peaks = len(field.window), len(field.peaks)
        sign = thrust_sign(spec, field.middle) if peaks else 1.0
        signs = [sign, -sign][:peaks]

        def others(moved: Spec, _: float) -> Floats:
            """What does not depend on the section: positions, pitch, coercivity, peak currents."""
            window = window_positions(moved.values)
            currents = [value for s in signs for value in peak_currents(moved, window[count // 2], s)]
            return np.array(
                [*window, moved.number("actuator.mover.pole_pitch"), intrinsic_coercivity(moved), *currents]
            )

        columns = {}
        for key in keys:
            section, other = (
                slope(spec, key, self._at(self._first.section, self._first.position)),
                slope(spec, key, others),
            )
            if section is not None and other is not None:
                columns[key] = (section, other)
        self.keys = list(columns)
        self._by_key = _columns([section for section, _ in columns.values()])
        rest = _columns([other for _, other in columns.values()])
        self.positions, self.pitch, self.coercivity = rest[:count], rest[count], rest[count + 1]
        self.currents = [rest[count + 2 + 3 * k : count + 5 + 3 * k] for k in range(peaks)]
        self._by_position = self._slope_by_position()

    def numbers(self, state: int) -> Floats:
        """(numbers, keys) of the state's cross-section."""
        return self._all(state)[: -2 * len(LIMITS)]

    def limits(self, state: int, name: str) -> Floats:
        """(2, keys) of the two z between which a figure is read in the state."""
        start = -2 * (len(LIMITS) - LIMITS.index(name))
        return self._all(state)[start : start + 2 or None]

    @lru_cache(maxsize=64)  # noqa: B019  as many as a design has states; it goes with the design
    def _all(self, state: int) -> Floats:
        window = self._field.window
        index = state if state < len(window) else len(window) // 2
        here = window[index]
        by_key = self._by_key
        if not alike(here.section, self._first.section):
            found = [slope(self._spec, key, self._at(here.section, here.position)) for key in self.keys]
            by_key = _columns([np.zeros(by_key.shape[0]) if column is None else column for column in found])
        return by_key + np.outer(self._by_position, self.positions[index])

    def _at(self, like: CrossSection, position: float) -> Any:
        """The section's numbers and the limits at a position, as a function of the specification."""

        def vector(moved: Spec, _: float) -> Floats:
            section = _section(moved, position)
            if not alike(section, like):
                raise DesignError("The cross-section changes its topology.")
            places = ranges(moved.actuator, position)
            return np.array([*numbers(section), *(z for name in LIMITS for z in getattr(places, name)[1])])

        return vector

    def _slope_by_position(self) -> Floats:
        here = self._first
        ends = [
            self._at(here.section, here.position + step)(self._spec, 0.0) for step in (POSITION_STEP, -POSITION_STEP)
        ]
        return (ends[0] - ends[1]) / (2 * POSITION_STEP)


def _columns(found: Sequence[Floats]) -> Floats:
    return np.column_stack(found) if found else np.zeros((0, 0))


def _section(spec: Spec, position: float) -> CrossSection:
    return cross_section(spec.actuator, position, spec.materials, spec.number("operating_point.magnet_temperature"))
