"""The figures of coils in free space and their exact gradients.

The field is known in closed form but for one integral, so the route of the finite elements needs none here; there is no
magnetic network. A derivative is the imaginary part of the figure at a value that is moved by a tiny imaginary step
(Squire and Trapp 1998, SIAM Review 40, 110): no difference is taken, and it is as exact as the figure.

Three figures have a kink. The derivative of the largest flux density, and so of the quench load, is that at the spot
where it is largest, which is exact wherever that spot is the only one; the merit's, where the energy is its reference
to the last bit, is that of more energy.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from fluxbore.design.coils import Coil, CoilSystem
from fluxbore.design.coils_values import windings
from fluxbore.design.errors import DesignError
from fluxbore.design.materials import Conductor, lookup
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import NOT_CONVERGED, OK, Evaluation, Gradient, failure
from fluxbore.optimize.partials import differentiable

if TYPE_CHECKING:
    from fluxbore.design.coils_surface import Spot

STEP = 1e-30
"""Along the imaginary axis, SI; its square is nothing beside any figure."""

CONVERGED = 1e-6
"""Relative change of the energy under the finer rule beyond which it is not taken for exact."""


def by_network(spec: Spec, gradient: Sequence[str] = ()) -> Evaluation:
    """There is none. Raises DesignError."""
    raise DesignError(
        f"Coils in free space have no magnetic network, their field being exact (fidelity fem); got "
        f"{len(spec.actuator.coils)} of them."
    )


def by_fem(spec: Spec, gradient: Sequence[str] = ()) -> Evaluation:
    """The exact figures, with derivatives by the keys of ``gradient``. Raises DesignError or MaterialError."""
    from fluxbore.design.coils_energy import ORDER, stored_energy
    from fluxbore.design.coils_field import NODES
    from fluxbore.design.coils_surface import hottest

    system: CoilSystem = spec.actuator
    metal = lookup(system.conductor, "actuator.conductor", spec.materials, Conductor)
    spots = tuple(hottest(system.coils, i) for i in range(len(system.coils)))
    figures = _figures(spec.values, metal, spots)
    energy = figures["stored_energy"]
    change = abs(float(stored_energy(system.coils, ORDER + 8, NODES + 16)) - energy) / (abs(energy) or 1.0)
    if not change <= CONVERGED:
        return failure(
            "fem", NOT_CONVERGED, f"A finer quadrature changes the stored energy by {change:.1e} of it; it may by 1e-6."
        )
    return Evaluation(
        "fem",
        OK,
        (),
        Performance(**figures),
        details={"quadrature_change": change},
        gradient=_gradient(spec, gradient, metal, spots) if gradient else None,
    )


def _gradient(spec: Spec, keys: Sequence[str], metal: Conductor, spots: Sequence[Spot]) -> Gradient:
    """Figure -> key -> derivative, for the keys that hold a continuous quantity of the design, given or by default.

    A key that the design is not given by takes the place of an alternative, as `Spec.pinned` has it.
    """
    base = spec.pinned(keys)
    slopes: dict[str, dict[str, float]] = {}
    for name in differentiable(base, keys):
        moved: dict[str, Any] = {**base.given, name: base.number(name) + 1j * STEP}
        for figure, value in _figures(base.kind.resolve(moved), metal, spots).items():
            slopes.setdefault(figure, {})[name] = float(value.imag) / STEP if isinstance(value, complex) else 0.0
    return slopes


def _figures(values: Mapping[str, Any], metal: Conductor, spots: Sequence[Spot]) -> dict[str, Any]:
    """Every figure that the values decide, SI; complex where a value is.

    spots : where on each winding's skin |B| is largest.
    """
    from fluxbore.design.coils_energy import stored_energy
    from fluxbore.design.coils_field import flux_density
    from fluxbore.design.coils_surface import magnitude, place

    coils = windings(values)
    centre = sum(flux_density(coil, 0.0, 0.0)[1] for coil in coils)
    largest = [
        _plain(magnitude(coils, *place(coil, spot.side, spot.share))) for coil, spot in zip(coils, spots, strict=True)
    ]
    volume = sum(coil.volume for coil in coils) * values["actuator.fill"]
    figures = {
        "stored_energy": _plain(stored_energy(coils)),
        "central_flux_density": _absolute(_plain(centre)),
        "winding_flux_density": max(largest, key=_real),
        "total_mass": volume * metal.density,
        "outer_diameter": 2 * max((coil.outer_radius for coil in coils), key=_real),
        "length": max((coil.upper for coil in coils), key=_real) - min((coil.lower for coil in coils), key=_real),
        **_stray(values, coils),
        **_conductor(values, coils, metal, largest),
    }
    if "stray_flux_density" in figures and {f"operating_point.{key}" for key in _MERIT} <= values.keys():
        norm, reference = (values[f"operating_point.{key}"] for key in _MERIT)
        missed = _absolute(figures["stored_energy"] - reference)
        figures["merit"] = (figures["stray_flux_density"] / norm) ** 2 + missed / reference
    return figures


_MERIT = ("stray_norm", "reference_energy")


def _stray(values: Mapping[str, Any], coils: Sequence[Coil]) -> dict[str, Any]:
    """The root mean square of |B| over a line along the axis and one across it; nothing where none are given.

    Both lines end in the same corner, which so counts twice, as in the published values of TEAM problem 22.
    """
    import numpy as np

    from fluxbore.design.coils_surface import sum_of_squares

    if "operating_point.line_radius" not in values:
        return {}
    radius, height = values["operating_point.line_radius"], values["operating_point.line_height"]
    share = np.linspace(0.0, 1.0, int(values["operating_point.points_per_line"]))
    full = np.ones_like(share)
    squares = sum_of_squares(
        coils, np.concatenate((radius * full, radius * share)), np.concatenate((height * share, height * full))
    )
    return {"stray_flux_density": _plain(np.sqrt(np.mean(squares)))}


def _conductor(
    values: Mapping[str, Any], coils: Sequence[Coil], metal: Conductor, largest: Sequence[Any]
) -> dict[str, Any]:
    """What the conductor makes of the current: heat, or of a superconductor the share of its limit."""
    if "operating_point.critical_current_density" in values:
        limit = values["operating_point.critical_current_density"]
        limit_field = values["operating_point.critical_flux_density"]
        loads = [
            _absolute(coil.current_density) / limit + field / limit_field
            for coil, field in zip(coils, largest, strict=True)
        ]
        return {"quench_load": max(loads, key=_real)}
    # In the conductor the density is J / fill, over a volume of fill x V.
    heat = sum(coil.current_density**2 * coil.volume for coil in coils) / values["actuator.fill"]
    return {"joule_loss": heat * _resistivity(metal, values["operating_point.winding_temperature"])}


def _resistivity(metal: Conductor, temperature: Any) -> Any:
    """`Conductor.resistivity_at` (ohm m), a straight line in the temperature (K), for complex ones as well."""
    at = _real(temperature)
    base = metal.resistivity_at(at)
    return base + (metal.resistivity_at(at + 1.0) - base) * (temperature - at)


def _plain(value: Any) -> Any:
    """One number of numpy's as Python's own, so that figures are plain."""
    plain = value.item() if hasattr(value, "item") else value
    return plain if isinstance(plain, complex) else float(plain)


def _absolute(value: Any) -> Any:
    """|x| of the real part's sign, differentiable but at zero."""
    return value if _real(value) >= 0 else -value


def _real(value: Any) -> float:
    return float(value.real)
