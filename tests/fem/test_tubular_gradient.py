"""Exact gradients of one position's figures by everything in its cross-section: differences, scaling, motion."""

from dataclasses import dataclass

import numpy as np
import pytest
from counted_solutions import counted_solutions
from hypothesis import given
from hypothesis import strategies as st
from small_motor import (
    all_numbers,
    cubic_iron,
    difference,
    from_numbers,
    lengths,
    number_names,
    small_section,
    solved,
)

from fluxbore.fem import functionals
from fluxbore.fem.factors import Band
from fluxbore.fem.functionals import Functional
from fluxbore.fem.tubular import TubularSolution, space_vector
from fluxbore.fem.tubular_gradient import TubularAdjoint
from fluxbore.geometry.cross_section import CrossSection

LOADED = {"U": 40.0, "V": -15.0, "W": -25.0}
FACTOR = 0.7 - 0.4j
Array = np.ndarray


@dataclass(frozen=True)
class Places:
    """Limits in z (m) of a line, a ring's shell and a gap's shell; (3, 2). yoke : z whose rows are within."""

    limits: Array
    yoke: tuple[float, float]

    @classmethod
    def of(cls, section: CrossSection) -> "Places":
        low, high = section.ends
        ring = section.z.values[section.z.intervals.index("ring")]
        shells = [[ring - 0.0031, ring + 0.0044], [ring - 0.001, ring + 0.009]]
        return cls(np.array([[low - 0.007, high + 0.0063], *shells]), (low - 1e-4, high + 1e-4))


def made(adjoint: TubularAdjoint, places: Places) -> dict[str, tuple[Functional, int | None]]:
    """Every functional, with which of the places' limits it has."""
    tubular = adjoint.tubular
    return {
        "force constant": (adjoint.force_constant(), None),
        "force": (adjoint.force(), None),
        "linkage": (adjoint.linkage(FACTOR), None),
        "inductance": (adjoint.inductance(), None),
        **read(tubular, places),
    }


def read(tubular: TubularSolution, places: Places) -> dict[str, tuple[Functional, int | None]]:
    """The figures that are read off the field."""
    r = tubular.section.r
    yoke = r.intervals.index("back yoke")
    line, ring, gap = ((float(low), float(high)) for low, high in places.limits)
    return {
        "yoke": (functionals.tube_norm(tubular, (r.values[yoke], r.values[yoke + 1]), places.yoke), None),
        "stray": (functionals.line_norm(tubular, r.values[yoke + 2], line), 0),
        "ring": (functionals.shell_mean(tubular, r.values[2], ring), 1),
        "gap": (functionals.shell_mean(tubular, r.values[4], gap), 2),
        "reverse": (functionals.reverse_norm(tubular, 8.0), None),
    }


def figures(tubular: TubularSolution, places: Places) -> Array:
    """The same figures' values, as an evaluation computes them."""
    return np.array(
        [
            1.5 * abs(space_vector(tubular.thrust_constants())),
            tubular.cogging_force(),
            np.real(FACTOR * space_vector(tubular.flux_linkages())),
            tubular.synchronous_inductance(),
            *(item.value for item, _ in read(tubular, places).values()),
        ]
    )


def gradients(tubular: TubularSolution, places: Places) -> tuple[dict[str, tuple[Functional, int | None]], Array, ...]:
    adjoint = TubularAdjoint(tubular)
    found = made(adjoint, places)
    return found, *adjoint.gradients([item for item, _ in found.values()])


@pytest.fixture(scope="module")
def section() -> CrossSection:
    return small_section()


def test_every_figure_by_every_number(section: CrossSection) -> None:
    """Catches any term that is missing or wrong: each breakpoint, coil, material and pole against differences."""
    places = Places.of(section)
    here = all_numbers(section)
    loaded = solved(section, LOADED)
    found, by_numbers, _, _ = gradients(loaded, places)
    values = figures(loaded, places)
    assert [item.value for item, _ in found.values()] == pytest.approx(values, rel=1e-12)
    for name, direction in moves(section).items():
        expected = difference(
            lambda step, d=direction: figures(solved(from_numbers(section, here + step * d), LOADED), places), 2e-3
        )
        error = np.abs(direction @ by_numbers - expected) / np.maximum(np.abs(expected), np.abs(values))
        worst = int(np.argmax(error))
        assert error[worst] < 1e-7, (name, list(found)[worst], direction @ by_numbers[:, worst], expected[worst])


def moves(section: CrossSection) -> dict[str, Array]:
    """Each number's own direction, a millimetre or the number itself long; the winding's radii are mesh lines, with
    which they move. The axis stays, and only magnets have a remanence and a recoil."""
    here, names = all_numbers(section), number_names(section)
    found = {}
    for place, name in enumerate(names):
        kind, *rest = name.split()
        magnets = kind not in ("remanence", "permeability") or section.regions[int(rest[0])].remanence
        if name == "r 0" or " r " in name or not magnets:
            continue
        direction = np.zeros(here.size)
        direction[place] = 1e-3 if lengths(section)[place] else abs(here[place])
        if kind == "r":
            direction[[k for k, other in enumerate(names) if " r " in other and here[k] == here[place]]] = 1e-3
        found[name] = direction
    return found


def test_figures_by_their_own_limits(section: CrossSection) -> None:
    """Catches a limit that does not move with what is read between: the other limits' figures must not feel it."""
    tubular = solved(section)
    places = Places.of(section)
    found, _, by_limits, _ = gradients(tubular, places)
    for which in range(3):
        for side in range(2):

            def at(step: float, which: int = which, side: int = side) -> Array:
                limits = places.limits.copy()
                limits[which, side] += step
                return figures(tubular, Places(limits, places.yoke))

            expected = difference(at, 1e-6)
            own = np.array([by_limits[side, k] if at_ == which else 0.0 for k, (_, at_) in enumerate(found.values())])
            assert own == pytest.approx(expected, rel=1e-6, abs=1e-9 * np.abs(by_limits).max())
            assert np.count_nonzero(own) == 1


def test_figures_by_the_currents(section: CrossSection) -> None:
    """Catches a load that is left out, or taken at the wrong sign: differences by each phase's current."""
    places = Places.of(section)
    _, _, _, by_currents = gradients(solved(section, LOADED), places)
    for k, phase in enumerate("UVW"):

        def at(step: float, phase: str = phase) -> Array:
            return figures(solved(section, {**LOADED, phase: LOADED[phase] + step}), places)

        expected = difference(at, 0.05)
        assert by_currents[k] == pytest.approx(expected, rel=1e-6, abs=1e-9 * np.abs(by_currents).max())


DEGREES = {
    "force constant": 1,
    "force": 2,
    "linkage": 2,
    "inductance": 1,
    "yoke": 0,
    "stray": 0,
    "ring": 0,
    "gap": 0,
    "reverse": 0,
}
"""By which power of the length figures grow, at the same flux density and so with currents in proportion."""


@pytest.mark.parametrize("currents", [{}, LOADED], ids=["idle", "loaded"])
@pytest.mark.parametrize("shaft", ["stainless steel 304", "1010"])
def test_a_motor_twice_as_large(currents: dict[str, float], shaft: str) -> None:
    """Catches a length that is left out, without any difference: Euler's Σ L dQ/dL + I dQ/dI = degree · Q."""
    section = small_section(shaft=shaft)
    places = Places.of(section)
    found, by_numbers, by_limits, by_currents = gradients(solved(section, currents), places)
    total = (all_numbers(section) * lengths(section)) @ by_numbers
    total += np.array([currents.get(phase, 0.0) for phase in "UVW"]) @ by_currents
    for k, (name, (item, place)) in enumerate(found.items()):
        own = 0.0 if place is None else float(places.limits[place] @ by_limits[:, k])
        assert total[k] + own == pytest.approx(DEGREES[name] * item.value, abs=1e-8 * max(abs(item.value), own)), name


def test_a_motor_moved_along_its_axis(section: CrossSection) -> None:
    """Catches a z that is left out: what is moved as a whole does not change."""
    places = Places.of(section)
    found, by_numbers, by_limits, _ = gradients(solved(section, LOADED), places)
    along = np.array([float(name.startswith("z") or " z " in name or "end" in name) for name in number_names(section)])
    for k, (name, (item, place)) in enumerate(found.items()):
        own = 0.0 if place is None else float(by_limits[:, k].sum())
        largest = float(np.abs(along * by_numbers[:, k]).max())
        assert along @ by_numbers[:, k] + own == pytest.approx(0.0, abs=1e-9 * largest), (name, item.value)


def test_fields_in_proportion_to_their_sources(section: CrossSection) -> None:
    """Catches a remanence or a current of the wrong weight: with linear iron, Σ B_r dQ/dB_r + I dQ/dI = degree · Q."""
    places = Places.of(section)
    found, by_numbers, _, by_currents = gradients(solved(section, LOADED, cubic_iron(cubic=0.0)), places)
    degrees = dict.fromkeys(found, 1) | {"force": 2, "inductance": 0}
    sources = np.array([float(name.startswith("remanence")) for name in number_names(section)])
    total = (all_numbers(section) * sources) @ by_numbers + np.array([LOADED[phase] for phase in "UVW"]) @ by_currents
    for k, (name, (item, _)) in enumerate(found.items()):
        assert total[k] == pytest.approx(degrees[name] * item.value, rel=1e-8, abs=1e-8 * abs(item.value)), name


def test_the_published_motors_steels(mid_stroke: TubularSolution) -> None:
    """Catches what a cubic law hides: Euler's rule and a shift on the whole mesh, with splines through tables."""
    section = mid_stroke.section
    places = Places.of(section)
    found, by_numbers, by_limits, _ = gradients(mid_stroke, places)
    along = np.array([float(name.startswith("z") or " z " in name or "end" in name) for name in number_names(section)])
    size, shift = (all_numbers(section) * lengths(section)) @ by_numbers, along @ by_numbers
    for k, (name, (item, place)) in enumerate(found.items()):
        terms = all_numbers(section) * lengths(section) * by_numbers[:, k]
        own = np.zeros(2) if place is None else by_limits[:, k]
        limits = np.zeros(2) if place is None else places.limits[place]
        largest = float(np.abs(terms).max())
        # To Newton's tolerance of 1e-8, not to rounding.
        assert size[k] + own @ limits == pytest.approx(DEGREES[name] * item.value, abs=1e-6 * largest), name
        assert (shift[k] + own.sum()) * section.ends[1] == pytest.approx(0.0, abs=1e-6 * largest), name


# Rounded: a factor near the smallest float makes figures whose last bits no sum keeps.
PARTS = st.floats(-2, 2).map(lambda part: round(part, 9))
FACTORS = st.builds(complex, PARTS, PARTS)


@given(FACTORS, FACTORS)
def test_a_sums_gradient_is_the_sum_of_gradients(idle: TubularAdjoint, first: complex, second: complex) -> None:
    """Catches adjoints that are mixed up between figures that are solved for together."""
    both = first + 2 * second
    by_numbers, _, by_currents = idle.gradients([idle.linkage(factor) for factor in (first, second, both)])
    for found in (by_numbers, by_currents):
        scale = np.abs(found).max() or 1.0
        assert found[:, 2] == pytest.approx(found[:, 0] + 2 * found[:, 1], abs=1e-9 * scale)


@pytest.fixture(scope="module")
def idle(section: CrossSection) -> TubularAdjoint:
    return TubularAdjoint(solved(section))


def test_no_matrix_is_factorised(section: CrossSection, monkeypatch: pytest.MonkeyPatch) -> None:
    """Catches a gradient that costs a factorisation, or more than four sweeps for each figure that needs an adjoint.

    Each sweep with the last tangent's factor is refined to the accuracy of adjoints.
    """
    tubular = solved(section, LOADED)
    tubular.thrust_constants()  # the forward evaluation's own
    columns = counted_solutions(monkeypatch)

    def refuse(*_: object) -> None:
        raise AssertionError("A matrix was factorised.")

    monkeypatch.setattr(Band, "__init__", refuse)
    found, *_ = gradients(tubular, Places.of(section))
    # The force's adjoint is known, the linkage's and both of the inductance's are those of Clarke's two axes.
    fields = len(found) - 2 + 2
    assert len(columns) <= 4 * fields
    assert len(columns) > 0
