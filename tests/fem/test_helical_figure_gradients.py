"""The exact gradients of a lead screw's flux along the iron and of its magnets' reverse field."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest
from helical_sections import EXACTLY, Array, difference, random_changes, sections
from lead_screws import PITCH

from fluxbore.fem.helical import HelicalSolution, solve
from fluxbore.fem.helical_figure_gradients import layer_flux_gradient, mean_load_gradient
from fluxbore.fem.helical_flux import flux_function
from fluxbore.fem.helical_gradient import HelicalAdjoint
from fluxbore.fem.helical_iron_flux import layer_flux
from fluxbore.fem.helical_magnets import mean_load, reverse_load
from fluxbore.geometry.helical_numbers import numbers
from fluxbore.geometry.helical_section import HelicalSection

COERCIVITY = (9e5, 7e5)
EXPONENT = 8.0


def layers(section: HelicalSection) -> tuple[list[int], dict[int, float]]:
    """The iron's, and the magnets' with their coercivities (A/m)."""
    names = [layer.name for layer in section.layers]
    iron, filled = (
        [names.index(f"{member} {kind}") for member in ("translator", "rotor")] for kind in ("iron", "magnets")
    )
    return iron, dict(zip(filled, COERCIVITY, strict=True))


def figures(solution: HelicalSolution) -> Array:
    iron, limits = layers(solution.section)
    psi = flux_function(solution)
    return np.array([*(layer_flux(solution, psi, layer) for layer in iron), load(solution, limits)])


def load(solution: HelicalSolution, limits: Mapping[int, float]) -> float:
    return mean_load(*reverse_load(solution, limits), EXPONENT)


@pytest.fixture(scope="module")
def adjoint() -> HelicalAdjoint:
    """Beside rest, where one place alone has the largest flux, and keeps it."""
    return HelicalAdjoint(solve(replace(sections()["saturated"], displacement=0.04 * PITCH), settings=EXACTLY))


@pytest.fixture(scope="module")
def gradients(adjoint: HelicalAdjoint) -> tuple[Array, ...]:
    found = adjoint.solution
    iron, limits = layers(found.section)
    psi = flux_function(found)
    return (
        *(layer_flux_gradient(adjoint, psi, layer) for layer in iron),
        mean_load_gradient(adjoint, limits, EXPONENT)[0],
    )


def test_against_differences(adjoint: HelicalAdjoint, gradients: tuple[Array, ...]) -> None:
    """Catches any term left out or of the wrong sign: a random direction in each of three kinds of numbers."""
    for change, step in random_changes(adjoint.solution.section, 3):
        rough, fine = (difference(figures, adjoint.solution, length * change) / length for length in (step, step / 2))
        exact = np.array([gradient @ change for gradient in gradients])
        assert (4 * fine - rough) / 3 == pytest.approx(exact, rel=2e-6)


def test_scaling(adjoint: HelicalAdjoint, gradients: tuple[Array, ...]) -> None:
    """By Euler: flux densities stay when all lengths grow, so that flux per angle goes as their square."""
    section = adjoint.solution.section
    lengths = slice(0, len(section.layers) + 4)
    found = np.array([gradient[lengths] @ numbers(section)[lengths] for gradient in gradients])
    assert found == pytest.approx(figures(adjoint.solution) * [2, 2, 0], rel=1e-7, abs=1e-9)


def test_by_coercivity(adjoint: HelicalAdjoint) -> None:
    """Catches a layer's share: the load goes as one over both coercivities together, and each by itself is smooth."""
    solution = adjoint.solution
    _, limits = layers(solution.section)
    found = mean_load_gradient(adjoint, limits, EXPONENT)[1]
    assert sum(found[k] * limits[k] for k in limits) == pytest.approx(-load(solution, limits), rel=1e-12)
    for layer, limit in limits.items():
        ahead, behind = (load(solution, limits | {layer: limit * (1 + step)}) for step in (1e-4, -1e-4))
        assert found[layer] == pytest.approx((ahead - behind) / (2e-4 * limit), rel=1e-5, abs=1e-12)
