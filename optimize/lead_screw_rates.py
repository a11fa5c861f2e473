"""How what a magnetic lead screw's fields give changes with the specification's keys: adjoints times the sections'.

Fields are compared at like shares of the pitch, so that each displacement moves with it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from fluxbore.design.errors import DesignError
from fluxbore.design.lead_screw_keys import MEMBERS
from fluxbore.design.spec import Spec
from fluxbore.optimize.lead_screw_field import (
    LOAD_EXPONENT,
    LeadScrewField,
    coercivity,
    interpolation,
    magnetised,
    periods,
    section,
)
from fluxbore.optimize.partials import slope

if TYPE_CHECKING:
    from fluxbore.fem.helical import HelicalSolution
    from fluxbore.fem.helical_gradient import HelicalAdjoint

Floats = Any


@dataclass(frozen=True, slots=True, eq=False)
class Rates:
    """Of the whole active length, by the keys in their order.

    amplitude : (H, keys) of the series' amplitudes (N). stall : (states, keys) of the force (N) in the field's states
    `stall` and `beside`. stiffness : (states,) N/m, of the same by the displacement alone. passed : member -> (keys,)
    of the largest flux per angle (Wb/rad) along its iron. load : (keys,) of the magnets' load, where it is computed.
    """

    keys: tuple[str, ...]
    amplitude: Floats
    stall: Floats
    stiffness: Floats
    passed: Mapping[str, Floats]
    load: Floats | None


class Jacobian:
    """The derivatives of the sections' `numbers` by those of the keys by which they keep their topology."""

    def __init__(self, spec: Spec, field: LeadScrewField, keys: Sequence[str]) -> None:
        import numpy as np

        from fluxbore.geometry.helical_numbers import alike, numbers, period_and_displacement

        like = field.rest.section
        self._spec = spec
        self._pitch = field.screw.pitch
        self._period, self._displacement = period_and_displacement(like)

        def at(moved: Spec, _: float) -> Floats:
            found = section(moved, magnetised(moved), 0.0)
            if not alike(found, like):
                raise DesignError("The cross-section changes its topology.")
            return numbers(found)

        here = at(spec, 0.0)
        columns = {key: slope(spec, key, at, here) for key in keys}
        self.keys = tuple(key for key, column in columns.items() if column is not None)
        self._columns = np.reshape([columns[key] for key in self.keys], (len(self.keys), here.size)).T

    def along(self, by_numbers: Floats, state: HelicalSolution) -> Floats:
        """(keys,) of a figure of a state from that by its numbers, the displacement moving with the pitch."""
        share = state.section.displacement / self._pitch
        return by_numbers @ self._columns + by_numbers[self._displacement] * share * self._columns[self._period]

    def by_displacement(self, by_numbers: Floats) -> float:
        """That by the displacement alone."""
        return float(by_numbers[self._displacement])

    def of(self, values: Any) -> Floats:
        """(values, keys) of a function of the specification alone; zero where a key has no slope of it."""
        import numpy as np

        def at(moved: Spec, _: float) -> Floats:
            return np.asarray(values(moved))

        here = at(self._spec, 0.0)
        found = [slope(self._spec, key, at, here) for key in self.keys]
        return np.column_stack([np.zeros_like(here) if column is None else column for column in found])


def rates(spec: Spec, field: LeadScrewField, jacobian: Jacobian) -> Rates:
    """By the Jacobian's keys. spec : as the Jacobian has it."""
    import numpy as np

    from fluxbore.fem.helical_gradient import HelicalAdjoint

    length = periods(field.screw)
    adjoints = [HelicalAdjoint(state) for state in field.samples]
    forces = [adjoint.force() for adjoint in adjoints]
    by_keys = [jacobian.along(by, state) for by, state in zip(forces, field.samples, strict=True)]
    top = [forces[0]] if field.top is None else [HelicalAdjoint(item).force() for item in (field.top, *field.beside)]
    return Rates(
        jacobian.keys,
        length * interpolation() @ np.array(by_keys),
        length
        * np.array([jacobian.along(by, state) for by, state in zip(top, (field.stall, *field.beside), strict=True)]),
        length * np.array([jacobian.by_displacement(by) for by in top]),
        _passed(adjoints[-1], jacobian),
        _load(spec, field, jacobian),
    )


def _passed(rest: HelicalAdjoint, jacobian: Jacobian) -> dict[str, Floats]:
    from fluxbore.fem.helical_figure_gradients import layer_flux_gradient
    from fluxbore.fem.helical_flux import flux_function

    names = [layer.name for layer in rest.solution.section.layers]
    iron = [member for member in MEMBERS if f"{member} iron" in names]
    if not iron:
        return {}
    psi = flux_function(rest.solution)
    return {
        member: jacobian.along(layer_flux_gradient(rest, psi, names.index(f"{member} iron")), rest.solution)
        for member in iron
    }


def _load(spec: Spec, field: LeadScrewField, jacobian: Jacobian) -> Floats | None:
    from fluxbore.fem.helical_figure_gradients import mean_load_gradient
    from fluxbore.fem.helical_gradient import HelicalAdjoint

    state, screw = field.slipping, field.screw
    if state is None or screw.translator.arcs is not None or screw.rotor.arcs is not None:
        return None
    names = [layer.name for layer in state.section.layers]
    limits = {names.index(f"{member} magnets"): coercivity(spec, member) for member in MEMBERS}
    by_numbers, by_limits = mean_load_gradient(HelicalAdjoint(state), limits, LOAD_EXPONENT)
    by_keys = jacobian.of(lambda moved: [coercivity(moved, member) for member in MEMBERS])
    return jacobian.along(by_numbers, state) + [by_limits[layer] for layer in limits] @ by_keys
