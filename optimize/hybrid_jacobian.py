"""How a hybrid actuator's cross-sections and the places where figures are read follow from the specification's keys."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from fluxbore.design.errors import DesignError
from fluxbore.design.hybrid_values import positions as window_positions
from fluxbore.design.spec import Spec
from fluxbore.geometry.cross_section import CrossSection, alike, numbers
from fluxbore.geometry.hybrid import cross_section
from fluxbore.optimize.hybrid_field import Field, intrinsic_coercivity, peak_currents, ranges, thrust_sign
from fluxbore.optimize.partials import slope

if TYPE_CHECKING:
    from fluxbore.fem.tubular import TubularSolution

Floats = Any

LIMITS = ("stray", "ring", "gap")

POSITION_STEP = 1e-6
"""m; dimensions are linear in the position."""


class Jacobians:
    """Derivatives by keys that a specification is given by, of all that its fields' figures depend on.

    keys : those of the wanted ones by which the cross-section keeps its topology; the columns of all arrays.
    positions : (window, keys). pitch, coercivity : (keys,). currents : (3, keys) of each peak state's phases.

    The sections at two positions differ by what moves with the mover, so one section's derivatives serve all of its
    topology, but for keys that move the positions themselves.
    """

    def __init__(self, spec: Spec, field: Field, keys: Sequence[str]) -> None:
        self._spec = spec
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

        unlike = _unlike(field)
        sections = [self._at(state.section, state.position) for state in unlike]
        here, others_here = [section(spec, 0.0) for section in sections], others(spec, 0.0)
        by_position = [self._slope_by_position(state, own) for state, own in zip(unlike, here, strict=True)]
        columns = {}
        for key in keys:
            found = [slope(spec, key, section, own) for section, own in zip(sections, here, strict=True)]
            other = slope(spec, key, others, others_here)
            if other is None or any(column is None for column in found):
                continue
            # Where the mover's parts meet the stator's, the section has no derivative by the position.
            if not np.any(other[:count]) or all(slopes is not None for slopes in by_position):
                columns[key] = [*found, other]
        self.keys = list(columns)
        width = len(self.keys)
        stacked = [np.column_stack(parts) for parts in zip(*columns.values(), strict=True)]
        rest = stacked[-1] if stacked else np.zeros((count + 2 + 3 * peaks, 0))
        self.positions, self.pitch, self.coercivity = rest[:count], rest[count], rest[count + 1]
        self.currents = [rest[count + 2 + 3 * k : count + 5 + 3 * k] for k in range(peaks)]
        by_key = stacked[:-1] if stacked else [np.zeros((own.size, width)) for own in here]
        self._states = []
        for index, state in enumerate(field.window):
            kind = next(k for k, other in enumerate(unlike) if alike(state.section, other.section))
            slopes = by_position[kind]
            moving = 0.0 if slopes is None else np.outer(slopes, self.positions[index])
            self._states.append(by_key[kind] + moving)
        self._states += [self._states[count // 2]] * peaks

    def numbers(self, state: int) -> Floats:
        """(numbers, keys) of the state's cross-section."""
        return self._states[state][: -2 * len(LIMITS)]

    def limits(self, state: int, name: str) -> Floats:
        """(2, keys) of the two z between which a figure is read in the state."""
        start = -2 * (len(LIMITS) - LIMITS.index(name))
        return self._states[state][start : start + 2 or None]

    def _at(self, like: CrossSection, position: float) -> Any:
        """The section's numbers and the limits at a position, as a function of the specification."""

        def vector(moved: Spec, _: float) -> Floats:
            section = _section(moved, position)
            if not alike(section, like):
                raise DesignError("The cross-section changes its topology.")
            places = ranges(moved.actuator, position)
            return np.array([*numbers(section), *(z for name in LIMITS for z in getattr(places, name)[1])])

        return vector

    def _slope_by_position(self, state: TubularSolution, now: Floats) -> Floats | None:
        """(numbers,), which are ``now``; from one side where the other has another topology; None where both have."""

        def at(step: float) -> Floats | None:
            try:
                return self._at(state.section, state.position + step)(self._spec, 0.0)
            except DesignError:
                return None

        ahead, behind = at(POSITION_STEP), at(-POSITION_STEP)
        if ahead is not None and behind is not None:
            return (ahead - behind) / (2 * POSITION_STEP)
        if ahead is None and behind is None:
            return None
        return (ahead - now if ahead is not None else now - behind) / POSITION_STEP


def _unlike(field: Field) -> list[TubularSolution]:
    """One position of each topology that the cross-section has within the window; as a rule there is one."""
    found: list[TubularSolution] = []
    for state in field.window:
        if not any(alike(state.section, other.section) for other in found):
            found.append(state)
    return found


def _section(spec: Spec, position: float) -> CrossSection:
    return cross_section(spec.actuator, position, spec.materials, spec.number("operating_point.magnet_temperature"))
