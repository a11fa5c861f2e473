"""Exact gradients of the hybrid actuator's figures: adjoints for the field, closed forms for the rest.

The adjoints give each position's figures by all that is continuous in its cross-section (`fem.tubular_gradient`); the
sections' dimensions by the specification's keys are closed forms (`partials`). A maximum over a line, the magnets or
the window is represented by a p-norm, whose exponent and value come along.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import pi
from typing import Any

import numpy as np

from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.fem import functionals
from fluxbore.fem.functionals import EXPONENT, Functional
from fluxbore.fem.tubular import space_vector
from fluxbore.fem.tubular_gradient import TubularAdjoint
from fluxbore.optimize.evaluation import Norm, PositionResult
from fluxbore.optimize.hybrid_field import (
    LOAD_EXPONENT,
    Field,
    intrinsic_coercivity,
    linkage_vector,
    ranges,
)
from fluxbore.optimize.hybrid_jacobian import Jacobians
from fluxbore.optimize.partials import closed_gradient, differentiable

STEPWISE = ("demagnetised_fraction", "peak_demagnetised_fraction")
"""Figures that count points: their derivative is zero or does not exist. `demagnetisation_load` stands in for them."""

Complete = Callable[[Spec, Mapping[str, float | None]], Performance]
"""All figures of a specification from those of its field."""

Floats = Any
"""Arrays of floats."""


def gradient(
    spec: Spec,
    field: Field,
    positions: Sequence[PositionResult],
    true: Mapping[str, float | None],
    keys: Sequence[str],
    complete: Complete,
) -> tuple[dict[str, dict[str, float]], dict[str, Norm]]:
    """Figure -> key -> derivative (SI), and the norms of those figures that are maxima.

    positions : of the window, as the evaluation has them. true : the field's figures. Keys that are not continuous are
    passed over. Of a maximum it is the norm's derivative; a figure that follows from one, such as a loss, takes the
    maximum to change as its norm does, in proportion.
    """
    base = spec.pinned(keys)
    jacobians = Jacobians(base, field, differentiable(base, keys))
    if not jacobians.keys:
        return {}, {}
    slopes, norms = _field_slopes(base, field, positions, jacobians)

    def ratio(name: str) -> float:
        value, norm = true[name], norms.get(name)
        return 1.0 if value is None or not norm else value / norm

    rates = {name: ratio(name) * by_key for name, by_key in slopes.items()}

    def completed(moved: Spec, step: float, key: str) -> Performance:
        place = jacobians.keys.index(key)
        return complete(
            moved,
            {
                name: value if value is None or name not in rates else value + step * float(rates[name][place])
                for name, value in true.items()
            },
        )

    found = closed_gradient(base, jacobians.keys, completed, without=STEPWISE)
    for name in norms:
        if name in found:
            found[name] = dict(zip(jacobians.keys, (float(value) for value in slopes[name]), strict=True))
    return found, {name: Norm(EXPONENT, value) for name, value in norms.items() if name in found}


def field_gradient(
    spec: Spec,
    field: Field,
    positions: Sequence[PositionResult],
    keys: Sequence[str],
    figures: Collection[str] | None = None,
) -> tuple[dict[str, dict[str, float]], dict[str, float]]:
    """Of the field's figures alone, all or those wanted: figure -> key -> derivative (SI), and the maxima's norms."""
    base = spec.pinned(keys)
    jacobians = Jacobians(base, field, differentiable(base, keys))
    slopes, norms = _field_slopes(base, field, positions, jacobians, figures)
    return {name: dict(zip(jacobians.keys, map(float, found), strict=True)) for name, found in slopes.items()}, norms


@dataclass(frozen=True, slots=True, eq=False)
class _Share:
    """A functional of one state, and its share in a figure: d figure / d functional. limits : whose z it has."""

    figure: str
    functional: Functional
    weight: float
    limits: str | None = None


class _Shares:
    """What each state gives to each figure that is wanted; all are where ``wanted`` is None."""

    def __init__(self, states: int, wanted: Collection[str] | None) -> None:
        self.of_state: list[list[_Share]] = [[] for _ in range(states)]
        self.norms: dict[str, float] = {}
        self._wanted = wanted

    def wants(self, figure: str) -> bool:
        return self._wanted is None or figure in self._wanted

    def add(self, figure: str, made: Iterable[Functional], weights: Sequence[float], limits: str | None = None) -> None:
        """A figure that is the sum of weight times functional over the first states; made only if it is wanted."""
        if not self.wants(figure):
            return
        for own, functional, weight in zip(self.of_state, made, weights, strict=False):
            own.append(_Share(figure, functional, weight, limits))

    def add_norm(self, figure: str, made: Iterable[Functional], limits: str | None = None) -> None:
        """A figure that is the largest of the states', by its norm."""
        if not self.wants(figure):
            return
        made = list(made)
        value, weights = functionals.norm(np.array([abs(item.value) for item in made]), EXPONENT)
        signs = [1.0 if item.value >= 0 else -1.0 for item in made]
        self.norms[figure] = value
        self.add(figure, made, [sign * weight for sign, weight in zip(signs, weights, strict=True)], limits)


def _field_slopes(
    spec: Spec,
    field: Field,
    positions: Sequence[PositionResult],
    jacobians: Jacobians,
    figures: Collection[str] | None = None,
) -> tuple[dict[str, Floats], dict[str, float]]:
    """Figure of the field -> derivatives by the Jacobians' keys, and the p-norms of its maxima."""
    adjoints = [TubularAdjoint(state) for state in (*field.window, *field.peaks)]
    shares = _shares(spec, field, positions, adjoints, figures)
    count = len(field.window)
    total: dict[str, Floats] = {}
    for index, (adjoint, own) in enumerate(zip(adjoints, shares.of_state, strict=True)):
        if not own:
            continue
        by_numbers, by_limits, by_currents = adjoint.gradients([share.functional for share in own])
        change = jacobians.numbers(index).T @ by_numbers
        if index >= count:
            change += jacobians.currents[index - count].T @ by_currents
        for k, share in enumerate(own):
            slopes = change[:, k]
            if share.limits is not None:
                slopes = slopes + jacobians.limits(index, share.limits).T @ by_limits[:, k]
            total[share.figure] = total.get(share.figure, 0.0) + share.weight * slopes
    if shares.wants("force_constant_linkage"):
        total["force_constant_linkage"] += _turning(spec, positions, jacobians)
    if shares.wants("demagnetisation_load"):
        coercivity = intrinsic_coercivity(spec)
        load = shares.norms["demagnetisation_load"] / coercivity
        shares.norms["demagnetisation_load"] = load
        total["demagnetisation_load"] = (total["demagnetisation_load"] - load * jacobians.coercivity) / coercivity
    return total, shares.norms


def _shares(
    spec: Spec,
    field: Field,
    positions: Sequence[PositionResult],
    adjoints: Sequence[TubularAdjoint],
    wanted: Collection[str] | None,
) -> _Shares:
    """Generators make the functionals, so that those of figures that nobody wants are not made."""
    actuator: HybridActuator = spec.actuator
    count = len(field.window)
    window, mean = adjoints[:count], [1 / count] * count
    at = [(item, ranges(actuator, item.position)) for item in field.window]
    factors = _linkage_factors(positions, actuator.mover.pole_pitch)
    made = _Shares(len(adjoints), wanted)
    made.add("force_constant", (item.force_constant() for item in window), mean)
    linkages = (item.linkage(factor) for item, factor in zip(window, factors, strict=True))
    made.add("force_constant_linkage", linkages, [1.0] * count)
    made.add_norm("stray_field", (functionals.line_norm(item, *place.stray) for item, place in at), "stray")
    made.add_norm("yoke_flux_density", (functionals.tube_norm(item, place.yoke_r, place.yoke_z) for item, place in at))
    made.add_norm("cogging_force", (item.force() for item in window))
    made.add_norm("demagnetisation_load", (functionals.reverse_norm(item.tubular, LOAD_EXPONENT) for item in adjoints))
    if actuator.mover.ring_width > 0:
        made.add("ring_flux_density", (functionals.shell_mean(item, *place.ring) for item, place in at), mean, "ring")
    made.add("gap_flux_density", (functionals.shell_mean(item, *place.gap) for item, place in at), mean, "gap")
    middle = count // 2
    if made.wants("phase_inductance"):
        made.of_state[middle].append(_Share("phase_inductance", window[middle].inductance(), 1.0))
    if field.peaks and made.wants("peak_force"):
        made.of_state[count].append(_Share("peak_force", adjoints[count].force(), 1.0))
        made.of_state[middle].append(_Share("peak_force", window[middle].force(), -1.0))
    return made


def _linkage_factors(positions: Sequence[PositionResult], pole_pitch: float) -> list[complex]:
    """By which each position's linkage vector must change to change 3/2 (π/τ) |Λ| by its real part (1/m)."""
    vector = linkage_vector([p.flux_linkages for p in positions], [p.position for p in positions], pole_pitch)
    along = 1.5 * pi / pole_pitch * np.conj(vector) / (abs(vector) or 1.0) / len(positions)
    return [complex(along * np.exp(-1j * pi * position.position / pole_pitch)) for position in positions]


def _turning(spec: Spec, positions: Sequence[PositionResult], jacobians: Jacobians) -> Floats:
    """What pole pitch and positions do to 3/2 (π/τ) |Λ| by themselves: its factor, and the angle it is turned by."""
    pitch = spec.number("actuator.mover.pole_pitch")
    vector = linkage_vector([p.flux_linkages for p in positions], [p.position for p in positions], pitch)
    scale = 1.5 * pi / pitch
    found = -scale * abs(vector) / pitch * jacobians.pitch
    direction = np.conj(vector) / (abs(vector) or 1.0)
    for position, moved in zip(positions, jacobians.positions, strict=True):
        z = position.position
        turned = space_vector(np.array(position.flux_linkages)) * np.exp(-1j * pi * z / pitch)
        angle = pi / pitch * (moved - z / pitch * jacobians.pitch)
        found = found + scale / len(positions) * float(np.real(-1j * direction * turned)) * angle
    return found
