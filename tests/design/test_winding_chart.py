"""The winding chart against the winding's own figures, and layers of wire counted by hand."""

from dataclasses import replace
from pathlib import Path

import pytest
from actuators import table_ii

from fluxbore.design import winding
from fluxbore.design.coils import CoilSystem
from fluxbore.design.material_kinds import Conductor
from fluxbore.design.materials import lookup
from fluxbore.design.spec import load
from fluxbore.design.winding_chart import coils_chart, hybrid_chart, wire_in_window

MM = 1e-3
EXAMPLES = Path(__file__).parents[2] / "examples"


def copper() -> Conductor:
    return lookup("copper", "actuator.winding.material", load(EXAMPLES / "ipehla.toml").materials, Conductor)


def test_coils_add_up_to_the_phases_and_these_to_the_winding() -> None:
    actuator = table_ii()
    chart = hybrid_chart(actuator, copper(), 0.44 * MM)
    assert len(chart.coils) == actuator.coils
    for phase in chart.phases:
        coils = [coil for coil in chart.coils if coil.phase == phase.phase]
        assert phase.coils == tuple(coil.number for coil in coils)
        assert sum(coil.turns or 0 for coil in coils) == pytest.approx(actuator.winding.turns)
        assert sum(coil.length or 0 for coil in coils) == pytest.approx(winding.wire_length(actuator))
        assert sum(coil.resistance or 0 for coil in coils) == pytest.approx(winding.resistance(actuator, copper()))
    assert chart.mass == pytest.approx(winding.copper_mass(actuator, copper()))
    assert sum(coil.mass for coil in chart.coils) == pytest.approx(chart.mass)
    assert sum(phase.mass for phase in chart.phases) == pytest.approx(chart.mass)


def test_coils_follow_one_another_along_the_axis_and_in_their_phase() -> None:
    actuator = table_ii()
    coils = hybrid_chart(actuator, copper(), 0.44 * MM).coils
    assert coils[0].start == 0.0
    assert coils[-1].end == pytest.approx(actuator.winding_end - actuator.winding_start)
    assert [coil.phase for coil in coils[:6]] == ["U", "V", "W", "U", "V", "W"]
    assert [coil.follows for coil in coils[:5]] == [None, None, None, 1, 2]
    assert {coil.direction for coil in coils} == {"clockwise"}


@pytest.mark.parametrize(
    ("turns", "wire", "layers", "nested"),
    [
        (72, 0.44, 4, False),  # 18 a layer, 4 layers 1.76 mm high in 2.1 mm
        (73, 0.44, 5, True),  # one turn more: 2.2 mm do not fit, 0.44 (1 + 4 sin 60°) = 1.96 mm do
        (8, 1.0, 1, False),
        (16, 1.0, 3, True),  # 8 + 7 + 1 in furrows, 2.73 mm: still too high
    ],
)
def test_layers_are_whole(turns: int, wire: float, layers: int, nested: bool) -> None:
    actuator = table_ii()
    assert actuator.coil_width == pytest.approx(8 * MM)
    sets = actuator.winding.sets_per_phase
    actuator = replace(
        actuator,
        winding=replace(
            actuator.winding,
            turns=turns * sets,
            outer_diameter=actuator.cylinder.outer_diameter + (4.2 if wire < 1 else 3.9) * MM,
        ),
    )
    found = wire_in_window(actuator, wire * MM)
    assert (found.layers, found.nested) == (layers, nested)
    assert found.height == pytest.approx(wire * MM * (1 + (layers - 1) * (3**0.5 / 2 if nested else 1)))


def test_what_does_not_fit_or_is_no_whole_turn_is_said() -> None:
    actuator = table_ii()
    many = replace(actuator, winding=replace(actuator.winding, turns=actuator.winding.turns * 2 + 1))
    told = " ".join(hybrid_chart(many, copper(), 0.44 * MM).told)
    assert "The layers do not fit" in told
    assert "turns a coil; wind" in told
    assumed = hybrid_chart(actuator, copper(), 0.44 * MM).assumed
    assert any("Star" in text for text in assumed)


def test_windings_without_wire_have_ampere_turns_and_a_direction() -> None:
    spec = load(EXAMPLES / "team22.toml")
    system: CoilSystem = spec.actuator
    chart = coils_chart(system, lookup(system.conductor, "actuator.conductor", spec.materials, Conductor))
    for entry, coil in zip(chart.coils, system.coils, strict=True):
        section = (coil.outer_radius - coil.inner_radius) * (coil.upper - coil.lower)
        assert entry.current == pytest.approx(abs(coil.current_density) * section)
        assert entry.turns is None
        assert entry.resistance is None
    assert [entry.direction for entry in chart.coils] == ["clockwise", "counter-clockwise"]
    assert min(entry.start for entry in chart.coils) == 0.0
