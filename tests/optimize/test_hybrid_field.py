"""What is read of a hybrid actuator's field, and in which state it is solved."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.spec import Spec, load
from fluxbore.fem.tubular import space_vector
from fluxbore.optimize.hybrid_field import (
    intrinsic_coercivity,
    linkage_constant,
    peak_currents,
    ranges,
    solve_field,
    thrust_sign,
)

EXAMPLE = Path(__file__).parents[2] / "examples" / "ipehla.toml"


@pytest.fixture(scope="module")
def spec() -> Spec:
    return load(EXAMPLE, {"operating_point.positions": "1", "operating_point.peak_current": "3 A"})


def phases(angle: float) -> tuple[float, float, float]:
    u, v, w = (float(np.cos(angle - k * 2 * np.pi / 3)) for k in range(3))
    return u, v, w


@given(st.floats(-0.1, 0.1), st.integers(1, 7), st.floats(0.0, 6.0))
def test_a_linkage_that_turns_with_the_mover(first: float, count: int, angle: float) -> None:
    """Catches a mean of amplitudes, or one that turns the wrong way: 3/2 (π/τ) times λ at any phase and position."""
    pitch, amplitude = 0.012, 0.03
    places = [first + 0.0011 * k for k in range(count)]
    linkages = [tuple(amplitude * x for x in phases(np.pi * z / pitch + angle)) for z in places]
    found = linkage_constant([(u, v, w) for u, v, w in linkages], places, pitch)
    assert found == pytest.approx(1.5 * np.pi / pitch * amplitude, rel=1e-9)


def test_what_the_three_phases_share_adds_nothing() -> None:
    """Catches a zero sequence that is taken for thrust."""
    assert linkage_constant([(0.2, 0.2, 0.2)], [0.003], 0.012) == pytest.approx(0.0, abs=1e-12)


def test_places_follow_the_mover(spec: Spec) -> None:
    """Catches a ring or gap that is read where the mover was; yoke and stray field stay with the stator."""
    here, there = ranges(spec.actuator, 0.0275), ranges(spec.actuator, 0.0295)
    for name in ("ring", "gap"):
        (r, z), (r_moved, z_moved) = getattr(here, name), getattr(there, name)
        assert r == r_moved
        assert np.subtract(z_moved, z) == pytest.approx(0.002)
    assert (here.stray, here.yoke_r, here.yoke_z) == (there.stray, there.yoke_r, there.yoke_z)
    (_, ring), (_, gap) = here.ring, here.gap
    assert ring[1] - ring[0] == pytest.approx(spec.number("actuator.mover.ring_width"))
    assert sum(ring) == pytest.approx(sum(gap))
    assert sum(ring) / 2 == pytest.approx(0.0275 + 4 * 0.012)
    assert here.stray[1] == pytest.approx((here.yoke_z[0] - 0.02, here.yoke_z[1] + 0.02))


def test_the_peak_current_is_on_the_q_axis(spec: Spec) -> None:
    """Catches a current that does not push: both signs of it, and thrust that grows by force constant times current."""
    field = solve_field(spec)
    assert field.failure is None
    assert len(field.window) == 1
    middle = field.middle
    sign = thrust_sign(spec, middle)
    currents = peak_currents(spec, middle.position, sign)
    assert sum(currents) == pytest.approx(0.0, abs=1e-12)
    assert abs(space_vector(np.array(currents))) == pytest.approx(3.0)
    constants = middle.thrust_constants()
    push = float(constants @ currents)
    best = 1.5 * abs(space_vector(constants)) * 3.0
    assert 0.98 * best < push <= best * (1 + 1e-9)
    forward, backward = (item.cogging_force() - middle.cogging_force() for item in field.peaks)
    assert forward == pytest.approx(push, rel=0.05)
    assert backward == pytest.approx(-push, rel=0.05)


def test_no_peak_current_no_state(spec: Spec) -> None:
    """Catches fields that nobody asked for: two more solutions for each design."""
    given = {key: value for key, value in spec.given.items() if key != "operating_point.peak_current"}
    assert not solve_field(type(spec)(spec.kind, given, spec.study, (), spec.materials, {})).peaks


def test_coercivity_falls_with_temperature(spec: Spec) -> None:
    """Catches the grade's value at 20 degC used for a hot magnet."""
    cold, hot = (
        intrinsic_coercivity(load(EXAMPLE, {"operating_point.magnet_temperature": t})) for t in ("20 degC", "80 degC")
    )
    grade = spec.materials[spec.word("actuator.mover.magnet")]
    assert cold == grade.coercivity_at(293.15)
    assert hot == grade.coercivity_at(353.15)
    assert hot < 0.9 * cold
