"""Exact gradients of what is read off a lead screw's field beside its force: iron's flux, the magnets' reverse field.

Each by the section's `numbers`, the field following by an adjoint field (`fem.helical_gradient`).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from fluxbore.fem.helical_density import Density
from fluxbore.fem.helical_flux import flux_equations
from fluxbore.fem.helical_gradient import HelicalAdjoint
from fluxbore.fem.helical_magnets import mean_load, reverse_load
from fluxbore.fem.mesh import Floats


def layer_flux_gradient(adjoint: HelicalAdjoint, psi: Floats, layer: int) -> Floats:
    """(numbers,) of `helical_iron_flux.layer_flux`; where its largest value changes its place, from one side.

    psi : the flux function at the nodes. ψ solves least squares, ∫ ∇v·(σ − ∇ψ) = 0 for all v, with
    σ = (−μ r a² ∂φ/∂ζ, μ r ∂φ/∂r − r B_rem), a² = 1 + h²/r², the slopes that the field gives it. With the v of the
    nodes between which the flux is read the flux changes as that integral does.
    """
    solution, frame = adjoint.solution, adjoint.frame
    nodes = solution.system.mesh.nodes[:, 0]
    inner, outer = (np.flatnonzero(nodes == radius) for radius in solution.section.radii[layer : layer + 2])
    passed = psi[outer] - psi[inner]
    row = int(np.argmax(np.abs(passed)))
    ends = np.zeros(nodes.size)
    ends[outer[row]], ends[inner[row]] = np.sign(passed[row]) * np.array([1.0, -1.0])
    topology, factor = flux_equations(solution)
    v = frame.slopes(topology.spread(factor.solve(topology.gather(ends))))

    r, p, slope = frame.r, adjoint.slopes, frame.slopes(psi)
    mu, mu_slope, stretch = adjoint.permeability, adjoint.permeability_slope, adjoint.stretch
    remanence, transfer = solution.system.remanence, solution.section.transfer_ratio
    across = v[..., 1] * p[..., 0] - stretch * v[..., 0] * p[..., 1]
    sources = np.stack((-mu * r * stretch * p[..., 1], mu * r * p[..., 0] - r * remanence), axis=-1)
    metric = np.stack((np.ones_like(r), stretch), axis=-1)
    by_p = (
        r[..., None]
        * metric
        * (mu[..., None] * np.stack((v[..., 1], -v[..., 0]), axis=-1) + (2 * mu_slope * across)[..., None] * p)
    )
    by_stretch = r * p[..., 1] * (mu_slope * across * p[..., 1] - mu * v[..., 0])
    density = Density(
        np.sum(v * (sources - slope), axis=-1),
        ((p, by_p), (v, sources - slope), (slope, -v)),
        mu * across - remanence * v[..., 1] - 2 * transfer**2 / r**3 * by_stretch,
        2 * transfer / r**2 * by_stretch,
        r * across,
        -r * v[..., 1],
    )
    return adjoint.total(density)


def mean_load_gradient(
    adjoint: HelicalAdjoint, coercivity: Mapping[int, float], exponent: float
) -> tuple[Floats, dict[int, float]]:
    """Of `helical_magnets.mean_load`: (numbers,), and layer number -> by the layer's H_cJ (m/A).

    With f = max(σ ∂φ/∂r / H_cJ, 0)^p, σ being the remanence's sign, the mean is m = (∫ f r / ∫ r)^(1/p).
    """
    frame, system = adjoint.frame, adjoint.solution.system
    value = mean_load(*reverse_load(adjoint.solution, coercivity), exponent)
    sign, limit = np.sign(system.remanence), np.ones(system.grid.layer.size)
    magnet = np.zeros(sign.shape)
    for layer, own in coercivity.items():
        here = system.grid.layer == layer
        limit[here], magnet[here] = own, sign[here] != 0
    none = np.zeros_like(magnet)
    if value == 0.0:
        return frame.by_numbers(Density(none, (), none, none, none, none)), dict.fromkeys(coercivity, 0.0)
    # Beside m, so that no power leaves the range of numbers.
    share = magnet * np.maximum(sign * adjoint.slopes[..., 0] / limit[:, None], 0.0) / value
    volume = float(np.sum(frame.weight * frame.r * magnet))
    # m/p (d of the integral over f's, less d of the volume over the volume): the integral is m^p times the volume.
    scale = value / (exponent * volume)
    by_p = np.zeros_like(adjoint.slopes)
    by_p[..., 0] = scale * exponent * frame.r * share ** (exponent - 1) * sign / (limit[:, None] * value)
    mean = scale * (share**exponent - magnet)
    gradient = adjoint.total(Density(frame.r * mean, ((adjoint.slopes, by_p),), mean, none, none, none))
    powers = np.sum(frame.weight * frame.r * share**exponent, axis=1)
    by_limit = {
        layer: -value / (volume * own) * float(powers[system.grid.layer == layer].sum())
        for layer, own in coercivity.items()
    }
    return gradient, by_limit
