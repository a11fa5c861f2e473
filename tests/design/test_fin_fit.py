"""Interference at the worst of tolerances and temperatures, against every corner written out."""

from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.fin_fit import Fit, interferences

FIN, BORE = Fit(16.3e-3, 0.043e-3, 2.0e-4), Fit(16.1e-3, 0.027e-3, 2.36e-5)


@given(
    fin=st.floats(0, 3e-4),
    bore=st.floats(0, 3e-4),
    wide=st.tuples(st.floats(0, 1e-4), st.floats(0, 1e-4)),
    cold=st.floats(230, 293),
    rise=st.floats(0, 150),
)
def test_they_are_the_extremes_of_all_corners(
    fin: float, bore: float, wide: tuple[float, float], cold: float, rise: float
) -> None:
    """Whichever of the two parts expands more. Catches a tolerance counted on the radius, a kelvin taken for a degree
    Celsius, a hot fit that is the loose one for a bore that grows faster."""
    corners = [
        (
            (16.3e-3 + a * wide[0] / 2)
            + 16.3e-3 * fin * (temperature - 293.15)
            - (16.1e-3 + b * wide[1] / 2)
            - 16.1e-3 * bore * (temperature - 293.15)
        )
        / 2
        for a, b, temperature in product((-1, 1), (-1, 1), (cold, cold + rise))
    ]
    least, largest = interferences(Fit(16.3e-3, wide[0], fin), Fit(16.1e-3, wide[1], bore), cold, cold + rise)
    assert least == pytest.approx(min(corners), abs=1e-15)
    assert largest == pytest.approx(max(corners), abs=1e-15)


def test_a_fin_of_plastic_loosens_in_the_cold() -> None:
    least, largest = interferences(FIN, BORE, 273.15, 293.15)
    room, same = interferences(FIN, BORE, 293.15, 293.15)
    assert least == pytest.approx(room - 20 * (16.3e-3 * 2.0e-4 - 16.1e-3 * 2.36e-5) / 2)
    assert largest == same
