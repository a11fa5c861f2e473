"""Figures: each has a unit and a meaning, and survives its plain form."""

import pytest

from fluxbore.design.performance import FIGURES, GROUPS, Performance, from_mapping, grouped, show_figure, to_mapping
from fluxbore.design.units import DIMENSIONS

PROMISED = (
    "force_constant", "pneumatic_force_advance", "pneumatic_force_retract", "winding_resistance", "motor_constant",
    "moving_mass", "stray_field",
)  # fmt: skip


def test_the_promised_figures_are_there_with_their_units():
    """Catches a renamed figure: scripts read these names from --json."""
    assert set(PROMISED) <= set(FIGURES)
    assert FIGURES["force_constant"].si == "N/A"
    assert FIGURES["pneumatic_force_advance"].si == FIGURES["pneumatic_force_retract"].si == "N"
    assert FIGURES["winding_resistance"].si == "ohm"
    assert FIGURES["motor_constant"].si == "N/sqrt(W)"
    assert FIGURES["moving_mass"].si == "kg"
    assert FIGURES["stray_field"].si == "T"


@pytest.mark.parametrize("name", FIGURES)
def test_each_figure_says_what_it_is(name):
    figure = FIGURES[name]
    assert figure.name == name
    assert figure.doc
    assert figure.si
    assert figure.dimension in DIMENSIONS or figure.dimension in ("count", "fraction", "power")


def test_a_figure_that_is_not_given_stays_none_and_not_zero():
    assert set(to_mapping(Performance()).values()) == {None}


def test_the_plain_form_loses_nothing():
    values = {name: 0.1 * i for i, name in enumerate(FIGURES)} | {"stray_field": None}
    performance = from_mapping(values)
    assert to_mapping(performance) == values
    assert list(to_mapping(performance)) == list(FIGURES)
    with pytest.raises(TypeError):
        from_mapping({"no_such_figure": 1.0})


def test_every_figure_stands_under_one_heading():
    """Catches a figure that a grouped table would swallow, and an empty heading."""
    every = [name for _, names in grouped(FIGURES) for name in names]
    assert sorted(every) == sorted(FIGURES)
    assert [group for group, _ in grouped(FIGURES)] == list(GROUPS)
    assert grouped(["length", "turns"]) == (("Winding", ("turns",)), ("Size and mass", ("length",)))


@pytest.mark.parametrize(
    ("mass", "shown"),
    [(0.20488, "204.88 g"), (9.99, "9990 g"), (10.0, "10 kg"), (81194.1, "81194 kg"), (103_698.0, "103698 kg")],
)
def test_masses_of_tonnes_are_not_in_grams(mass, shown):
    assert show_figure("total_mass", mass) == shown
