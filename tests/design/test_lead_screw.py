"""The parameters of a lead screw: what follows from them, and what cannot be built."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lead_screws import ARCS, PITCH, table_i

from fluxbore.design.errors import DesignError
from fluxbore.design.lead_screw import Arcs, LeadScrew

SCREW = table_i()


def test_table_i() -> None:
    """h as Table II rounds it, two periods of magnets, and the radii that Table I leaves to be added up."""
    assert pytest.approx(8.19e-4, abs=5e-7) == SCREW.h
    assert pytest.approx(2 * PITCH) == SCREW.active_length
    assert pytest.approx((14.95e-3, 17.45e-3, 18.25e-3, 20.75e-3)) == SCREW.radii
    assert pytest.approx(25.75e-3) == SCREW.rotor_iron_radius


def test_more_starts_move_further() -> None:
    """The reading of p_t = 8 that the paper's own h excludes: four starts would make h four times as large."""
    assert pytest.approx(4 * SCREW.h) == replace(SCREW, starts=4).h


def with_member(name: str, **changes: Any) -> LeadScrew:
    return replace(SCREW, **{name: replace(getattr(SCREW, name), **changes)})


SENTENCES = [
    (
        lambda: replace(SCREW, pitch=5e-3),
        "actuator.pitch must be at least two magnet widths, 5.14285714285714 mm by "
        "actuator.translator.magnet_width; got 5 mm.",
    ),
    (
        lambda: with_member("rotor", magnet_width=3e-3),
        "actuator.pitch must be at least two magnet widths, 6 mm by actuator.rotor.magnet_width; "
        "got 5.14285714285714 mm.",
    ),
    (
        lambda: with_member("translator", arcs=Arcs(math.radians(61), 6, stepped=True)),
        "actuator.translator.arc_angle must be at most 60 deg, or the 6 arcs of a turn overlap; got 61 deg.",
    ),
    (
        lambda: with_member("rotor", arcs=Arcs(0.0, 6, stepped=True)),
        "actuator.rotor.arc_angle must be finite and above 0 deg; got 0 deg.",
    ),
    (
        lambda: with_member("rotor", arcs=Arcs(1.0, 0, stepped=True)),
        "actuator.rotor.arcs_per_turn must be at least 1; got 0.",
    ),
    (
        lambda: replace(SCREW, gap_tolerance=0.8e-3),
        "actuator.gap must exceed actuator.gap_tolerance 0.8 mm, or the members touch; got 0.8 mm.",
    ),
    (
        lambda: replace(SCREW, gap_tolerance=-0.1e-3),
        "actuator.gap_tolerance must be finite and 0 mm or more; got -0.1 mm.",
    ),
    (
        lambda: with_member("translator", iron_thickness=15e-3),
        "actuator.translator.outer_radius must hold its magnets and the iron within, at least 17.5 mm; got 17.45 mm.",
    ),
    (
        lambda: replace(SCREW, poles=40),
        "actuator.translator.length must be at least the length of the rotor's poles, 102.857142857143 mm; got 85 mm.",
    ),
    (
        lambda: replace(SCREW, frame_radius=20e-3),
        "actuator.rotor.outer_radius must hold the rotor's magnets and iron, at least 25.75 mm; got 20 mm.",
    ),
    (lambda: replace(SCREW, pitch=math.nan), "actuator.pitch must be finite and above 0 mm; got nan mm."),
    (lambda: replace(SCREW, gap=0.0), "actuator.gap must be finite and above 0 mm; got 0 mm."),
    (lambda: replace(SCREW, poles=0), "actuator.poles must be at least 1; got 0."),
    (lambda: replace(SCREW, starts=0), "actuator.starts must be at least 1; got 0."),
    (
        lambda: replace(SCREW, carried_mass=-1.0),
        "actuator.carried_mass must be finite and 0 kg or more; got -1 kg.",
    ),
    (
        lambda: with_member("rotor", magnet_thickness=0.0),
        "actuator.rotor.magnet_thickness must be finite and above 0 mm; got 0 mm.",
    ),
    (
        lambda: with_member("rotor", magnet_permeability=0.9),
        "actuator.rotor.magnet_permeability must be finite and at least 1; got 0.9.",
    ),
    (
        lambda: with_member("translator", remanence=math.inf),
        "actuator.translator.remanence must be finite and at least 0 T; got inf T.",
    ),
]


@pytest.mark.parametrize(("build", "sentence"), SENTENCES)
def test_what_cannot_be_built_is_one_sentence(build: Any, sentence: str) -> None:
    with pytest.raises(DesignError) as error:
        build()
    assert str(error.value) == sentence


@given(pitch=st.floats(1e-4, 1.0), count=st.integers(1, 400))
def test_what_just_touches_can_be_built(pitch: float, count: int) -> None:
    """Widths of half a pitch and arcs that fill the turn, however they round."""
    member = replace(SCREW.rotor, magnet_width=pitch / 2, arcs=Arcs(2 * math.pi / count, count, stepped=False))
    length = 4 * pitch / 2
    built = replace(SCREW, pitch=pitch, rotor=member, translator=member, translator_length=length, frame_length=length)
    assert built.active_length == pytest.approx(2 * pitch)
    assert ARCS.fill == pytest.approx(1.0)
