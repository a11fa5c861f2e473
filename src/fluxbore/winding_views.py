"""The winding charts of the kinds that have a winding of their own."""

from __future__ import annotations

from collections.abc import Callable

from fluxbore.design.coils import CoilSystem
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.material_kinds import Conductor
from fluxbore.design.materials import lookup
from fluxbore.design.spec import Spec
from fluxbore.design.winding_chart import WindingChart, coils_chart, hybrid_chart


def _hybrid(spec: Spec) -> WindingChart:
    actuator: HybridActuator = spec.actuator
    conductor = lookup(actuator.winding.material, "actuator.winding.material", spec.materials, Conductor)
    return hybrid_chart(actuator, conductor, spec.number("actuator.winding.insulated_diameter"))


def _coils(spec: Spec) -> WindingChart:
    system: CoilSystem = spec.actuator
    return coils_chart(system, lookup(system.conductor, "actuator.conductor", spec.materials, Conductor))


CHARTS: dict[str, Callable[[Spec], WindingChart]] = {"coils": _coils, "hybrid": _hybrid}
"""By the kind's name."""


def winding_chart(spec: Spec) -> WindingChart | None:
    """The chart of a design's winding; None where its kind has none. Raises MaterialError."""
    make = CHARTS.get(spec.kind.name)
    return make(spec) if make is not None else None
