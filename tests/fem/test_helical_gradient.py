"""The exact gradient of a lead screw's force by everything in its section: differences, scaling, symmetry."""

import math
from dataclasses import replace

import numpy as np
import pytest
from lead_screws import ARCS, PITCH, table_i

from fluxbore.design.lead_screw import LeadScrew
from fluxbore.design.materials import standard
from fluxbore.fem.helical import SETTINGS, HelicalSolution, solve
from fluxbore.fem.helical_force import force
from fluxbore.fem.helical_gradient import HelicalAdjoint
from fluxbore.geometry.helical_bands import Bands, Segment
from fluxbore.geometry.helical_numbers import alike, magnets, numbers
from fluxbore.geometry.helical_section import HelicalSection
from fluxbore.geometry.lead_screw import helical_section

Array = np.ndarray

STEEL = standard()["1010"].curve
EXACTLY = replace(SETTINGS, tolerance=1e-10)


def members(screw: LeadScrew, **changes: object) -> LeadScrew:
    return replace(
        screw,
        translator=replace(screw.translator, **changes),  # type: ignore[arg-type]
        rotor=replace(screw.rotor, **changes),  # type: ignore[arg-type]
    )


def sections() -> dict[str, HelicalSection]:
    """Ideal iron, touching magnets; thin saturated iron, unlike magnets; no iron; arcs in steps on three starts."""
    screw = table_i()
    narrow = replace(screw.translator, magnet_width=0.4 * PITCH, iron_thickness=0.2e-3)
    thin = replace(screw, translator=narrow, rotor=replace(narrow, magnet_width=0.35 * PITCH, remanence=1.2))
    arcs = members(replace(screw, starts=3), arcs=replace(ARCS, angle=0.9))
    wide = replace(arcs, translator=replace(arcs.translator, magnet_width=0.4 * PITCH))
    return {
        "ideal": helical_section(screw, 0.21 * PITCH),
        "saturated": helical_section(thin, 0.17 * PITCH, STEEL, STEEL),
        "no iron": helical_section(table_i(False, False), 0.1 * PITCH),
        "arcs": helical_section(wide, 0.3 * PITCH, STEEL, STEEL),
    }


@pytest.fixture(scope="module", params=list(sections()))
def solved(request: pytest.FixtureRequest) -> tuple[HelicalSolution, Array]:
    """A field and the gradient of its force."""
    found = solve(sections()[request.param], settings=EXACTLY)
    assert found.convergence.converged
    return found, HelicalAdjoint(found).force()


def from_numbers(like: HelicalSection, values: Array) -> HelicalSection:
    """The inverse of `numbers`, of a section that is like another."""
    count = len(like.layers)
    radii, (period, lead, displacement), rest = np.split(values, [count + 1, count + 4])
    permeability, ends = rest[:count], iter(rest[count:].reshape(-1, 3).tolist())
    layers = []
    for k, layer in enumerate(like.layers):
        if isinstance(layer.magnets, Bands):
            parts = [next(ends) for _ in layer.magnets.segments]
            stops = [part[0] for part in parts[1:]] + [parts[0][0] + 1]
            segments = tuple(
                Segment(start, stop, first, last, old.magnet)
                for (start, first, last), stop, old in zip(parts, stops, layer.magnets.segments, strict=True)
            )
            layer = replace(layer, magnets=Bands(segments))
        layers.append(replace(layer, outer_radius=float(radii[k + 1]), permeability=float(permeability[k])))
    return replace(
        like,
        inner_radius=float(radii[0]),
        layers=tuple(layers),
        period=float(period),
        lead=float(lead),
        displacement=float(displacement),
    )


def directions(section: HelicalSection) -> list[Array]:
    """One by one, all numbers but the permeability of what is no magnet; south bands with the north bands."""
    count, values = len(section.layers), numbers(section)
    fixed = {count + 4 + k for k, layer in enumerate(section.layers) if layer.magnets is None}
    found = [unit for k, unit in enumerate(np.eye(values.size)[: 2 * count + 4]) if k not in fixed]
    at = 2 * count + 4
    for _, bands in magnets(section):
        half = len(bands.segments) // 2
        for segment in range(half):
            for k, sign in enumerate((1.0, -1.0, -1.0)):
                both = np.zeros(values.size)
                both[[at + 3 * segment + k, at + 3 * (segment + half) + k]] = 1.0, sign
                found.append(both)
        at += 6 * half
    return found


def difference(found: HelicalSolution, change: Array) -> float:
    """Half the force's difference between both ends of a change of the numbers, there and back."""
    ahead, behind = (
        force(solve(from_numbers(found.section, numbers(found.section) + end), settings=EXACTLY, start=found))
        for end in (change, -change)
    )
    return (ahead - behind) / 2


def test_numbers_are_all_of_a_section() -> None:
    """Catches a number in the wrong place."""
    for section in sections().values():
        again = from_numbers(section, numbers(section))
        assert alike(section, again)
        assert numbers(again).tolist() == pytest.approx(numbers(section).tolist(), abs=1e-15)


def test_against_differences(solved: tuple[HelicalSolution, Array]) -> None:
    """Catches any term left out or of the wrong sign: a random direction in each of three kinds of numbers."""
    found, gradient = solved
    section, count = found.section, len(found.section.layers)
    rng = np.random.default_rng(7)
    kinds = (slice(0, count + 1), slice(count + 1, count + 4), slice(count + 4, None))
    thinnest = float(np.min(np.diff(section.radii)))
    for kind in kinds:
        change = np.sum([rng.normal() * unit for unit in directions(section) if np.any(unit[kind])], axis=0)
        # Lengths by shares of the thinnest layer, all else by shares of one.
        step = 0.01 * (thinnest if kind.start < count + 4 else 0.3)
        rough, fine = (difference(found, length * change) / length for length in (step, step / 2))
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
    assert gradient[place] == pytest.approx(difference(found, step) / step[place], rel=1e-6)
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
