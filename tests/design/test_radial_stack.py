"""Layers with an exact field: against finite elements, against what is known, and far out of ordinary ranges."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from radial_elements import RadialElements
from scipy.integrate import quad
from scipy.special import i0, i1, k0, k1

from fluxbore.design.bh_curve import MU_0
from fluxbore.design.radial_stack import RadialStack, shapes, solve

RADII = (14.95e-3, 17.45e-3, 18.25e-3, 20.75e-3)
WAVE = 2 * np.pi / (36e-3 / 7)

stacks = st.builds(
    lambda start, steps, mu, inner, outer: RadialStack(
        tuple(float(r) for r in start + np.cumsum([0.0, *steps])), tuple(mu), inner, outer
    ),
    st.floats(3e-3, 0.05),
    st.lists(st.floats(0.3e-3, 6e-3), min_size=3, max_size=3),
    st.tuples(st.floats(1, 1.2), st.just(1.0), st.floats(1, 50)),
    st.booleans(),
    st.booleans(),
)


def one(stack: RadialStack, wave: float, order: float, source: int, sink: int) -> float:
    return float(solve(stack, np.array([wave]), np.array([order])).interaction(source, sink)[0])


@settings(max_examples=25)
@given(stack=stacks, wave=st.floats(150, 1500), order=st.integers(0, 6))
def test_agrees_with_finite_elements(stack: RadialStack, wave: float, order: float) -> None:
    """Of any permeabilities, ends and order; what passes from layer to layer, and into the iron."""
    elements = RadialElements(stack, wave, order, 40)
    exact = solve(stack, np.array([wave]), np.array([order]))
    for source, sink in ((0, 2), (2, 0)):
        assert float(exact.interaction(source, sink)[0]) == pytest.approx(elements.interaction(source, sink), rel=1e-3)
    for source in (0, 2):
        flux = exact.flux(source)[0]
        found = np.array(elements.flux(source))
        if stack.inner_iron:
            assert flux[0] == pytest.approx(found[0], rel=2e-3, abs=1e-5 * RADII[0])
        if stack.outer_iron:
            assert flux[1] == pytest.approx(found[1], rel=2e-3, abs=1e-5 * RADII[0])


@pytest.mark.parametrize("inner", [True, False])
@pytest.mark.parametrize("outer", [True, False])
@pytest.mark.parametrize("harmonic", [1, 3])
def test_finite_elements_converge_to_it(inner: bool, outer: bool, harmonic: int) -> None:
    """At the fourth order of their energy: it is the limit, not merely near it."""
    stack = RadialStack(RADII, (1.05, 1.0, 1.05), inner, outer)
    exact = one(stack, harmonic * WAVE, harmonic, 0, 2)
    errors = [
        abs(RadialElements(stack, harmonic * WAVE, harmonic, count).interaction(0, 2) / exact - 1)
        for count in (16, 32, 64, 128)
    ]
    slopes = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(slopes > 3.7), (errors, slopes)
    assert errors[-1] < 1e-7


@pytest.mark.parametrize("wave", [200.0, WAVE, 3 * WAVE])
def test_axisymmetric_limit_is_the_expression_with_i0_and_i1(wave: float) -> None:
    """h -> 0, mu_r = 1, iron on both sides: Green's function of I_0 and K_0, its slopes with I_1 and K_1."""
    a, b, c, d = RADII
    stack = RadialStack(RADII, (1.0, 1.0, 1.0), True, True)
    inner = k0(wave * a) * quad(lambda r: r * i1(wave * r), a, b, epsabs=0)[0]
    inner += i0(wave * a) * quad(lambda r: r * k1(wave * r), a, b, epsabs=0)[0]
    outer = k0(wave * d) * quad(lambda r: r * i1(wave * r), c, d, epsabs=0)[0]
    outer += i0(wave * d) * quad(lambda r: r * k1(wave * r), c, d, epsabs=0)[0]
    wronskian = i0(wave * d) * k0(wave * a) - i0(wave * a) * k0(wave * d)
    expected = -(wave**2) * inner * outer / (MU_0 * wronskian)
    assert one(stack, wave, 0.0, 0, 2) == pytest.approx(-expected, rel=1e-9)
    assert one(stack, wave, 1e-6, 0, 2) == pytest.approx(-expected, rel=1e-9)


@pytest.mark.parametrize("radius", [1.0, 100.0])
def test_planar_limit(radius: float) -> None:
    """Far from the axis: sinh^2(k t)/sinh(k (2 t + g)) per metre of circumference."""
    t, g = 2.5e-3, 0.8e-3
    stack = RadialStack((radius, radius + t, radius + t + g, radius + 2 * t + g), (1.0, 1.0, 1.0), True, True)
    for wave in (WAVE, 3 * WAVE, 5 * WAVE):
        expected = radius * np.sinh(wave * t) ** 2 / (MU_0 * wave * np.sinh(wave * (2 * t + g)))
        # The mean radius lies t + g/2 further out, and the curvature counts to the second order.
        assert one(stack, wave, 0.0, 0, 2) == pytest.approx(expected, rel=4e-3 / radius)


@settings(max_examples=30)
@given(stack=stacks, wave=st.floats(50, 1e4), order=st.floats(0, 60))
def test_what_one_does_to_the_other_comes_back(stack: RadialStack, wave: float, order: float) -> None:
    """Reciprocity, which the two sources' own integrals must keep."""
    forward, back = one(stack, wave, order, 0, 2), one(stack, wave, order, 2, 0)
    assert forward == pytest.approx(back, rel=1e-9)
    assert forward > 0


@settings(max_examples=30)
@given(stack=stacks, wave=st.floats(50, 3000), order=st.floats(0, 30), part=st.floats(0.1, 0.9))
def test_a_layer_cut_in_two_is_the_same_layer(stack: RadialStack, wave: float, order: float, part: float) -> None:
    a, b, c, d = stack.radii
    first, gap, last = stack.permeability
    cut = RadialStack((a, b, c, c + part * (d - c), d), (first, gap, last, last), stack.inner_iron, stack.outer_iron)
    assert one(cut, wave, order, 0, 2) + one(cut, wave, order, 0, 3) == pytest.approx(
        one(stack, wave, order, 0, 2), rel=1e-9
    )


@settings(max_examples=30)
@given(wave=st.floats(300, 3000), order=st.floats(0, 10))
def test_permeable_layers_become_iron(wave: float, order: float) -> None:
    """Both ways to say iron: a condition at the radius, and a thick layer of very large permeability."""
    iron = RadialStack(RADII, (1.05, 1.0, 1.05), True, True)
    thick = RadialStack((9.95e-3, *RADII, 26e-3), (1e9, 1.05, 1.0, 1.05, 1e9), False, False)
    assert one(thick, wave, order, 1, 3) == pytest.approx(one(iron, wave, order, 0, 2), rel=1e-6)


@settings(max_examples=30)
@given(wave=st.floats(50, 3000), order=st.floats(0, 30))
def test_air_around_is_a_layer_of_air(wave: float, order: float) -> None:
    """The conditions of the open ends, at the axis and far out, hold at any radius."""
    near = RadialStack(RADII, (1.05, 1.0, 1.05), False, False)
    far = RadialStack((5e-3, *RADII, 30e-3), (1.0, 1.05, 1.0, 1.05, 1.0), False, False)
    assert one(far, wave, order, 1, 3) == pytest.approx(one(near, wave, order, 0, 2), rel=1e-9)


@settings(max_examples=30)
@given(wave=st.floats(50, 1e4), order=st.floats(0, 60), radius=st.floats(17.45e-3, 18.25e-3))
def test_slopes_are_those_of_the_shapes(wave: float, order: float, radius: float) -> None:
    step = 1e-4 / np.hypot(wave, order / radius)
    k, p = np.array([wave]), np.array([order])
    up, down = (shapes(k, p, 17.45e-3, 18.25e-3, np.array([[radius + s]])) for s in (step, -step))
    slopes = shapes(k, p, 17.45e-3, 18.25e-3, np.array([[radius]]), derivative=True)
    for high, low, slope in zip(up, down, slopes, strict=True):
        assert float(slope[0, 0]) == pytest.approx(
            float((high - low)[0, 0]) / (2 * step), rel=1e-5, abs=1e-6 * np.hypot(wave, order / radius)
        )


def test_nothing_overflows_at_large_arguments() -> None:
    """k r = 2e5, where I itself is e^200000: still the planar field."""
    stack = RadialStack((1000.0, 1002.5, 1003.3, 1005.8), (1.0, 1.0, 1.0), True, True)
    expected = 1000.0 / (MU_0 * 200.0) * np.exp(-160.0) / 2
    assert one(stack, 200.0, 0.0, 0, 2) == pytest.approx(expected, rel=5e-3)
    assert one(stack, 200.0, 3.0, 0, 2) == pytest.approx(expected, rel=5e-3)


@pytest.mark.parametrize("inner", [True, False])
def test_nothing_underflows_at_large_orders(inner: bool) -> None:
    """A coupling of 500 pole pairs, whose I_p(k r) is below 1e-600: by finite elements."""
    stack = RadialStack((90e-3, 90.5e-3, 90.6e-3, 91e-3), (1.05, 1.0, 1.05), inner, not inner)
    exact = one(stack, 400.0, 500.0, 0, 2)
    assert exact == pytest.approx(RadialElements(stack, 400.0, 500, 60).interaction(0, 2), rel=1e-6)
