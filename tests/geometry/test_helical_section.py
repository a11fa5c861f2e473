"""A lead screw's section as plain numbers, and the sentences for those that cannot be."""

from __future__ import annotations

from dataclasses import replace
from math import inf, nan, pi

import pytest
from rotlin_section import PERIOD, ideal

from fluxbore.design.errors import DesignError
from fluxbore.geometry.helical_bands import alternating
from fluxbore.geometry.helical_section import Layer

SECTION = ideal(alternating(1.2), alternating(1.2))


def test_published_transfer_ratio() -> None:
    """Catches h from another length than the lead: Table II of the paper has 8.19e-4 m/rad."""
    assert SECTION.transfer_ratio == pytest.approx(PERIOD / (2 * pi), rel=1e-15)
    assert SECTION.transfer_ratio == pytest.approx(8.19e-4, rel=1e-3)
    assert SECTION.gap_radii == (17.45e-3, 18.25e-3)


def test_air_is_what_has_no_curve_no_magnets_and_no_permeability() -> None:
    """Catches a gap of iron or of magnets that passes for air."""
    assert [layer.air for layer in SECTION.layers] == [False, True, False]
    assert not Layer("steel", 1.0, 200.0).air


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"inner_radius": -1e-3}, r"inner radius must be .* got -1 mm"),
        ({"inner_radius": 17.45e-3}, r'"translator magnets" must end beyond 17.45 mm.* got 17.45 mm'),
        ({"gap": 0}, r"number must be from 1 to 1; got 0"),
        ({"gap": 2}, r"number must be from 1 to 1; got 2"),
        ({"period": 0.0}, r"period must be above zero; got 0 mm"),
        ({"period": nan}, r"period must be above zero; got nan mm"),
        ({"inner_radius": inf}, r"inner radius must be .* got inf mm"),
        ({"inner_radius": 0.0}, r"inner radius of zero there is no iron"),
    ],
)
def test_sections_that_cannot_be(change: dict[str, float], sentence: str) -> None:
    """Catches a section that would only fail in the mesh, with a message about triangles."""
    with pytest.raises(DesignError, match=sentence):
        replace(SECTION, **change)


def test_a_gap_must_be_air() -> None:
    """Catches a force measured in iron, where Maxwell's stress is another."""
    layers = (SECTION.layers[0], replace(SECTION.layers[1], permeability=2.0), SECTION.layers[2])
    with pytest.raises(DesignError, match='gap must be air; the layer "gap" is not'):
        replace(SECTION, layers=layers)


def test_a_permeability_must_be_one() -> None:
    """Catches a matrix that is not positive definite."""
    layers = (replace(SECTION.layers[0], permeability=0.0), *SECTION.layers[1:])
    with pytest.raises(DesignError, match='permeability of "translator magnets" must be above zero; got 0'):
        replace(SECTION, layers=layers)
