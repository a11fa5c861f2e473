"""Carter's coefficient: the conformal map integrated numerically, its limits, and values in use."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from fluxbore.design.carter import carter_coefficient


@pytest.mark.parametrize(("gap", "expected"), [(0.3e-3, 1.41), (2.05e-3, 1.08)])
def test_values_for_two_millimetre_slots_every_four(gap: float, expected: float) -> None:
    """Catches the gap and the opening swapped, or half an opening where a whole one belongs."""
    assert carter_coefficient(gap, 2e-3, 4e-3) == pytest.approx(expected, abs=0.01)


@given(ratio=st.floats(0.05, 50.0))
def test_it_is_the_flux_that_the_conformal_map_finds_missing(ratio: float) -> None:
    """Catches any slip in the closed form: Schwarz and Christoffel's integral of one slot, by quadrature.

    With w from 0 (slot's middle) to 1 (far away) on the smooth side, and r = b/g, a^2 = 1 + 4/r^2, position and flux
    are dx/g = r/pi sqrt(a^2 - w^2)/(1 - w^2) dw and 2/pi dw/(1 - w^2); far away they differ by half of gamma.
    """
    a_squared = 1 + 4 / ratio**2

    def missing(w: float) -> float:
        # (r sqrt(a^2 - w^2) - 2) / (1 - w^2), multiplied out so that nothing cancels at w = 1
        return ratio**2 / (ratio * math.sqrt(a_squared - w * w) + 2)

    gamma = 2 * quad(missing, 0, 1)[0] / math.pi
    pitch = 2 * ratio
    assert carter_coefficient(1.0, ratio, pitch) == pytest.approx(pitch / (pitch - gamma), rel=1e-9)


@given(ratio=st.floats(0.5, 15.0))
def test_it_agrees_with_the_usual_approximation(ratio: float) -> None:
    """Catches a map of another slot: gamma = (b/g)^2 / (5 + b/g) is good to 2 % of k_c where slots are common."""
    gamma = ratio**2 / (5 + ratio)
    pitch = 2 * ratio
    assert carter_coefficient(1.0, ratio, pitch) == pytest.approx(pitch / (pitch - gamma), rel=0.02)


@given(gap=st.floats(1e-4, 1e-2), opening=st.floats(1e-4, 1e-2), tooth=st.floats(1e-4, 1e-2))
def test_it_lies_between_no_slot_and_no_flux_in_the_slot(gap: float, opening: float, tooth: float) -> None:
    """Catches a coefficient below 1 or above t/(t - b), which would be less than the teeth alone carry."""
    pitch = opening + tooth
    k_c = carter_coefficient(gap, opening, pitch)
    assert 1.0 < k_c < pitch / tooth
    assert carter_coefficient(gap, 1e-9 * opening, pitch) == pytest.approx(1.0, abs=1e-12)
    assert carter_coefficient(1e-9 * gap, opening, pitch) == pytest.approx(pitch / tooth, rel=1e-4)
