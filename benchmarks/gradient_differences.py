"""All figures of a specification's designs by finite elements, smooth ones for maxima, and their derivatives by
Richardson-extrapolated central differences: what exact gradients are held against.

A ladder of central differences with steps h, h/2, h/4, ... is extrapolated twice, which leaves an error of h⁶. The
figures are not that smooth: the magnetisation curves are splines whose third derivative jumps at their knots, of which
a large step crosses many, and a limit of an integral may pass a node; small steps meet rounding. A rung's doubt is by
how much its twice extrapolated difference departs from its once extrapolated one, from that of the rung above, with
steps twice as long, and from that of the rung below: the largest of the three. The ladder goes down until the doubt

    is below `SURE` of the scale for every figure, or has grown `LOST` times from its least since, as rounding makes it,

or until the last rung; of each figure the rung with the least doubt counts. Nothing in this rule knows what the adjoint
has found.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from fluxbore.design.errors import DesignError
from fluxbore.design.hybrid_values import positions
from fluxbore.design.performance import to_mapping
from fluxbore.design.spec import Spec
from fluxbore.fem import functionals
from fluxbore.fem.magnetostatics import Settings
from fluxbore.fem.tubular import TubularSolution, mean_reverse_field, solve_currents
from fluxbore.geometry.cross_section import alike, numbers
from fluxbore.geometry.hybrid import cross_section
from fluxbore.optimize.hybrid_field import (
    LOAD_EXPONENT,
    Field,
    field_figures,
    intrinsic_coercivity,
    peak_currents,
    position_result,
    ranges,
    thrust_sign,
)
from fluxbore.optimize.hybrid_figures import complete
from fluxbore.optimize.partials import moved

TOLERANCE = 1e-12
"""Of Newton's residual, relative to the load."""

FINER = Settings(5e-14, max_iterations=8)
"""Of neighbours, as far as rounding allows; they count if they come to `TOLERANCE`."""

FROM_NOTHING = Settings(5e-14, max_iterations=60)

FIRST_STEP = 4e-4
"""Of a key's size (`size`)."""

RUNGS = 13
SURE = 1e-7
LOST = 20.0

Figures = Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Difference:
    """A derivative, and how much its last extrapolation has moved it."""

    value: float
    doubt: float


class Designs:
    """A design and its neighbours, on the same topology.

    anew : whether each field begins from nothing. Else it begins from the design's own, which takes a third of the
    time and leaves a trace of that field, of one part in 10¹⁰ where the figure is a small rest of large ones.
    """

    def __init__(self, spec: Spec, field: Field, anew: bool = False) -> None:
        self.spec, self._field, self._anew = spec, field, anew
        self._signs = [1.0, -1.0][: len(field.peaks)]
        if field.peaks:
            self._signs = [sign * thrust_sign(spec, field.middle) for sign in self._signs]
        self._own: dict[bytes, TubularSolution] = {}
        self._of_field: dict[tuple[object, ...], dict[str, float | None]] = {}
        results = tuple(position_result(item, spec.actuator.mover.pole_pitch) for item in field.window)
        true = field_figures(spec, field, results)
        # What follows from a maximum takes it to change as its norm does: by these factors, which stay.
        self._ratios = {name: (true[name] or 0.0) / norm if norm else 1.0 for name, norm in norms(spec, field).items()}
        self.own = self.figures(spec, keep=True)

    def figures(self, spec: Spec, keep: bool = False) -> Figures:
        """Of a neighbour. Raises FluxboreError where it cannot be built or has another topology.

        keep : the field, which neighbours share that differ in nothing that it depends on.
        """
        assert spec.kind.check is not None
        spec.kind.check(spec.values)
        places = positions(spec.values)
        idle = (0.0, 0.0, 0.0)
        window = [self._solved(spec, z, idle, near, keep) for z, near in zip(places, self._field.window, strict=True)]
        middle = places[len(places) // 2]
        peaks = [
            self._solved(spec, middle, peak_currents(spec, middle, sign), near, keep)
            for sign, near in zip(self._signs, self._field.peaks, strict=True)
        ]
        found = to_mapping(complete(spec, self._figures_of_field(spec, Field(window, peaks), keep)))
        return {name: value / self._ratios.get(name, 1.0) for name, value in found.items() if value is not None}

    def _figures_of_field(self, spec: Spec, field: Field, keep: bool) -> dict[str, float | None]:
        """With norms for maxima, times their factors."""
        mark = (
            *(id(item) for item in (*field.window, *field.peaks)),
            *(ranges(spec.actuator, item.position) for item in field.window),
            intrinsic_coercivity(spec),
            spec.number("actuator.mover.pole_pitch"),
        )
        if mark in self._of_field:
            return self._of_field[mark]
        results = tuple(position_result(item, spec.actuator.mover.pole_pitch) for item in field.window)
        smooth = {name: self._ratios[name] * norm for name, norm in norms(spec, field).items()}
        found = {**field_figures(spec, field, results), **smooth}
        if keep:
            self._of_field[mark] = found
        return found

    def _solved(
        self, spec: Spec, position: float, currents: tuple[float, float, float], near: TubularSolution, keep: bool
    ) -> TubularSolution:
        section = cross_section(
            spec.actuator, position, spec.materials, spec.number("operating_point.magnet_temperature")
        )
        if not alike(section, near.section):
            raise DesignError("The cross-section changes its topology.")
        key = np.array([*numbers(section), *currents, position]).tobytes()
        if key in self._own:
            return self._own[key]
        phases = [circuit.name for circuit in near.solution.problem.circuits]
        # A small step is solved by next to nothing: what is left of it must be small beside the step itself.
        amperes = dict(zip(phases, currents, strict=True))
        if self._anew:
            solved = solve_currents(section, position, amperes, FROM_NOTHING)
        else:
            solved = solve_currents(section, position, amperes, FINER, near=near)
        if solved.convergence.residual > TOLERANCE:
            raise DesignError(solved.convergence.sentence())
        if keep:
            self._own[key] = solved
        return solved

    def derivatives(self, key: str) -> dict[str, Difference]:
        """By one key. Raises FluxboreError where the first step leaves what can be built."""
        value, length = self.spec.number(key), size(self.spec, key)
        rows: list[list[dict[str, float]]] = []
        found: dict[str, Difference] = {}
        for rung in range(RUNGS):
            high, low = value + FIRST_STEP / 2**rung * length, value - FIRST_STEP / 2**rung * length
            after, before = self.figures(moved(self.spec, key, high)), self.figures(moved(self.spec, key, low))
            row = [{name: (after[name] - before[name]) / (high - low) for name in after if name in before}]
            for order, coarser in enumerate(rows[-1][:2] if rows else [], start=1):
                row.append({name: (4**order * fine - coarser[name]) / (4**order - 1) for name, fine in row[-1].items()})
            rows.append(row)
            if rung < 4:
                continue
            above, here, below = rows[-3:]
            going = False
            for name, best in here[2].items():
                doubt = max(abs(best - other[name]) for other in (here[1], above[2], below[2]))
                if name not in found or doubt < found[name].doubt:
                    found[name] = Difference(best, doubt)
                own = found[name]
                going |= own.doubt > SURE * scale(own.value, self.own[name], length) and doubt < LOST * own.doubt
            if not going:
                break
        return found


def scale(derivative: float, figure: float, length: float) -> float:
    """What an error of a derivative is relative to: itself, or the figure over the key's size where that is more."""
    return max(abs(derivative), abs(figure) / length)


def size(spec: Spec, key: str) -> float:
    """What a key's steps and scales are relative to (SI): its value, and of a position the pole pitch."""
    if key.endswith("_position"):
        return spec.number("actuator.mover.pole_pitch")
    return abs(spec.number(key))


def norms(spec: Spec, field: Field) -> dict[str, float]:
    """The p-norms in place of the field's maxima."""
    at = [(item, ranges(spec.actuator, item.position)) for item in field.window]

    def largest(values: list[float]) -> float:
        return functionals.norm(np.abs(values), functionals.EXPONENT)[0]

    states = [*field.window, *field.peaks]
    return {
        "stray_field": largest([functionals.line_norm(item, *place.stray).value for item, place in at]),
        "yoke_flux_density": largest(
            [functionals.tube_norm(item, place.yoke_r, place.yoke_z).value for item, place in at]
        ),
        "cogging_force": largest([item.cogging_force() for item in field.window]),
        "demagnetisation_load": largest([mean_reverse_field(item, LOAD_EXPONENT) for item in states])
        / intrinsic_coercivity(spec),
    }
