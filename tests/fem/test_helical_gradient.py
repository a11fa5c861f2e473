"""The exact gradient of a lead screw's force by everything in its section: differences, scaling, symmetry."""

import math
from dataclasses import replace

import numpy as np
import pytest
from helical_sections import EXACTLY, Array, difference, from_numbers, members, random_changes, sections
from lead_screws import ARCS, PITCH, table_i

from fluxbore.fem.helical import HelicalSolution, solve
from fluxbore.fem.helical_force import force
from fluxbore.fem.helical_gradient import HelicalAdjoint
from fluxbore.geometry.helical_numbers import alike, numbers
from fluxbore.geometry.lead_screw import helical_section


@pytest.fixture(scope="module", params=list(sections()))
def solved(request: pytest.FixtureRequest) -> tuple[HelicalSolution, Array]:
    """A field and the gradient of its force."""
    found = solve(sections()[request.param], settings=EXACTLY)
    assert found.convergence.converged
    return found, HelicalAdjoint(found).force()


def test_numbers_are_all_of_a_section() -> None:
    """Catches a number in the wrong place."""
    for section in sections().values():
        again = from_numbers(section, numbers(section))
        assert alike(section, again)
        assert numbers(again).tolist() == pytest.approx(numbers(section).tolist(), abs=1e-15)


def test_against_differences(solved: tuple[HelicalSolution, Array]) -> None:
    """Catches any term left out or of the wrong sign: a random direction in each of three kinds of numbers."""
    found, gradient = solved
    for change, step in random_changes(found.section, 7):
        rough, fine = (difference(force, found, length * change) / length for length in (step, step / 2))
        exact = float(gradient @ change)
        # They come nearer at their own order, two, until Newton's tolerance over the step is left.
        assert abs(fine - exact) < 0.26 * abs(rough - exact) + 2e-8 * abs(exact)
        assert (4 * fine - rough) / 3 == pytest.approx(exact, rel=2e-6)


def test_scaling(solved: tuple[HelicalSolution, Array]) -> None:
    """Catches a length left out, with no difference at all: by Euler, lengths times s make the force times s²."""
    found, gradient = solved
    count = len(found.section.layers)
    lengths = slice(0, count + 4)
    assert gradient[lengths] @ numbers(found.section)[lengths] == pytest.approx(2 * force(found), rel=1e-8)


def test_linear_screws_go_with_the_square_of_the_remanence() -> None:
    """Catches half of the magnets, or a factor of them."""
    for name in ("ideal", "no iron"):
        section = sections()[name]
        found = solve(section, settings=EXACTLY)
        gradient, values, at = HelicalAdjoint(found).force(), numbers(section), 2 * len(section.layers) + 4
        remanence = np.reshape([(0.0, 1.0, 1.0)] * ((values.size - at) // 3), -1)
        assert gradient[at:] @ (remanence * values[at:]) == pytest.approx(2 * force(found), rel=1e-8)


def test_turning_round_does_not_count(solved: tuple[HelicalSolution, Array]) -> None:
    """Catches edges that move against their mesh: all edges of both members moved alike change nothing."""
    found, gradient = solved
    at = 2 * len(found.section.layers) + 4
    starts = gradient[at:][0::3]
    assert abs(starts.sum()) < 1e-8 * np.abs(starts).sum()


def test_slope_at_rest() -> None:
    """Catches a wrong adjoint at rest: the force is odd in the displacement, so that only that moves it."""
    section = replace(sections()["ideal"], displacement=0.0)
    found = solve(section, settings=EXACTLY)
    gradient, place = HelicalAdjoint(found).force(), len(section.layers) + 3
    step = 1e-4 * PITCH * np.eye(gradient.size)[place]
    assert gradient[place] == pytest.approx(difference(force, found, step) / step[place], rel=1e-6)
    lengths = np.delete(gradient[: place + 1] * numbers(section)[: place + 1], place)
    assert np.all(np.abs(lengths) < 1e-9 * gradient[place] * PITCH)


def test_unlike_sections() -> None:
    """Catches a topology that changes unseen: magnets that part, iron that vanishes, edges that cross the period."""
    screw = table_i()
    touching = helical_section(screw)
    apart = helical_section(members(screw, magnet_width=0.49 * PITCH))
    assert alike(touching, helical_section(replace(screw, gap=0.7e-3)))
    assert not alike(touching, apart)
    assert not alike(touching, helical_section(table_i(rotor_iron=False)))
    half_turn = replace(ARCS, per_turn=2, angle=math.pi / 3)
    meeting, apart = (
        helical_section(members(screw, magnet_width=PITCH / 6 * share, arcs=half_turn)) for share in (1, 1 + 1e-5)
    )
    assert not alike(meeting, apart)
