"""Changes by key: what they change, what they leave alone, and the sentence for what they cannot do."""

import re
from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.errors import FluxboreError, SpecError
from fluxbore.fem.femm_edit import edit
from fluxbore.fem.femm_model import (
    Arc,
    BlockLabel,
    BlockProperty,
    BoundaryProperty,
    CircuitProperty,
    FemmModel,
    Hole,
    Node,
    PointProperty,
    Segment,
)
from fluxbore.fem.femm_move import Motion
from fluxbore.fem.femm_setting import setting, sweep_values
from fluxbore.fem.femm_solution import solve_model
from fluxbore.fem.formula import parse_formula

MATERIALS = (
    BlockProperty("Air"),
    BlockProperty("NdFeB 40 MGOe", mu_x=1.05, mu_y=1.05, coercivity=9e5),
    BlockProperty("Steel", curve=((0.0, 0.0), (1.0, 100.0), (1.5, 1000.0))),
    BlockProperty("Alloy 3.5"),
)
MODEL = FemmModel(
    False,
    "inches",
    2.0,
    points=(PointProperty("P", 0.5), PointProperty("wire", None, 3.0)),
    boundaries=(BoundaryProperty("A=0", "prescribed"), BoundaryProperty("ABC", "mixed", c0=1.0)),
    materials=MATERIALS,
    circuits=(CircuitProperty("coil", 1.0), CircuitProperty("coil.current", 2.0, False), CircuitProperty("a=b", 0.0)),
    nodes=(Node(-9, 0), Node(9, 0), *(Node(x, y) for x, y in ((1, 0), (3, 0), (3, 1), (1, 1), (2, 0)))),
    segments=tuple(Segment(2 + k, 2 + (k + 1) % 4) for k in range(4)),
    arcs=(Arc(0, 1, 180.0, boundary=0), Arc(1, 0, 180.0, boundary=0)),
    labels=(
        BlockLabel(2, 0.5, 1, magnetisation=90.0, group=1),
        BlockLabel(0, 3, 0, circuit=0, turns=10, group=2),
        BlockLabel(0, 4, 0, group=2),
    ),
)
"""A magnet whose lines are in no group, in a disc; node 6 merely lies on its lower side. Label 3 is one too many."""
MESHED = replace(MODEL, labels=MODEL.labels[:2])


def places(model: FemmModel) -> list[tuple[float, float]]:
    return [(node.x, node.y) for node in model.nodes]


@pytest.mark.parametrize(
    ("key", "text", "value"),
    [
        ("circuit.coil.current", "5", lambda m: m.circuits[0].current == 5.0),
        ("circuit.coil.current", " 5 mA", lambda m: m.circuits[0].current == 0.005),
        ('circuit."coil".current', "-1e3", lambda m: m.circuits[0].current == -1000.0),
        ("circuit.coil.current.current", "7", lambda m: [c.current for c in m.circuits] == [1.0, 7.0, 0.0]),
        ("material.NdFeB 40 MGOe.coercivity", "800 kA/m", lambda m: m.materials[1].coercivity == 8e5),
        ("material.Alloy 3.5.mu_x", "20", lambda m: (m.materials[3].mu_x, m.materials[3].mu_y) == (20.0, 1.0)),
        ("material.Alloy 3.5.mu_y", "20", lambda m: (m.materials[3].mu_x, m.materials[3].mu_y) == (1.0, 20.0)),
        ("material.Air.current_density", "2", lambda m: m.materials[0].current_density == 2e6),
        ("material.Air.current_density", "2 A/mm^2", lambda m: m.materials[0].current_density == 2e6),
        ("material.Air.current_density", "2 A/m^2", lambda m: m.materials[0].current_density == 2.0),
        ("material.Air.conductivity", "58", lambda m: m.materials[0].conductivity == 58e6),
        ("material.Steel.fill", "0.9", lambda m: m.materials[2].fill == 0.9),
        ("boundary.A=0.a0", "0.25", lambda m: m.boundaries[0] == BoundaryProperty("A=0", "prescribed", 0.25)),
        ("boundary.A=0.phase", "60", lambda m: m.boundaries[0] == BoundaryProperty("A=0", "prescribed", phase=60.0)),
        ("boundary.ABC.c1", "3", lambda m: m.boundaries[1] == BoundaryProperty("ABC", "mixed", c0=1.0, c1=3.0)),
        ("point.P.potential", "1", lambda m: m.points[0] == PointProperty("P", 1.0)),
        ("point.wire.current", "4 A", lambda m: m.points[1] == PointProperty("wire", None, 4.0)),
        ("group.1.magnetisation", "45", lambda m: [b.magnetisation for b in m.labels] == [45.0, 0.0, 0.0]),
        ("group.1.magnetisation", "90 deg", lambda m: m.labels[0].magnetisation == 90.0),
        ("group.1.magnetisation", "theta+180", lambda m: m.labels[0].magnetisation == "theta+180"),
        ("group.2.turns", "20", lambda m: [b.turns for b in m.labels] == [1.0, 20.0, 1.0]),
        ("depth", "3", lambda m: m.depth == 3.0),
        ("depth", "25.4 mm", lambda m: m.depth == pytest.approx(1.0, rel=1e-15)),
    ],
)
def test_a_value(key: str, text: str, value) -> None:  # type: ignore[no-untyped-def]
    """Catches a factor of a unit, a neighbour's number, a name that is cut at its dot."""
    assert value(edit(MODEL, {key: text}))


def test_everything_else_stays() -> None:
    """Catches a copy that loses a field."""
    assert replace(edit(MODEL, {"circuit.coil.current": "5"}), circuits=MODEL.circuits) == MODEL
    assert replace(edit(MODEL, {"material.Steel.fill": "0.5"}), materials=MODEL.materials) == MODEL
    assert edit(MODEL, {}) == MODEL


@pytest.mark.parametrize(
    ("key", "text", "sentence"),
    [
        ("circuit.spool.current", "1", 'must name a circuit of the file, one of "coil", "coil.current", "a=b"'),
        ("circuit.coil.amps", "1", "must end in one of current"),
        ("circuit.coil", "1", "must name a circuit"),
        ("circuit.coil.current", "nan", "must be a current"),
        ("circuit.coil.current", "1e400", "must be a current"),
        ("circuit.coil.current", "5 V", "must be a current"),
        ("material.Steel.mu_x", "100", "must be of a material without a B-H curve"),
        ("material.Air.mu_x", "0", "must be at least 1e-06"),
        ("material.Air.fill", "1.5", "at most 1"),
        ("material.Air.current_density", "2 A", "must be a number, bare or in MA/m"),
        ("boundary.A=0.c0", "1", 'must be of a mixed boundary; "A=0" is prescribed'),
        ("boundary.ABC.a0", "1", 'must be of a prescribed boundary; "ABC" is mixed'),
        ("point.P.current", "0", "must not be zero"),
        ("group.7.turns", "1", 'must name a group of the file, one of 0, 1, 2; got "7"'),
        ("group.one.turns", "1", "must name a group of the file"),
        ("group..turns", "1", "must name a group of the file"),
        ("group.1.turns", "1", "a block label with a circuit; group 1 has none"),
        ("group.1.magnetisation", "theta+", "The formula"),
        ("group.1.displacement.z", "1", "magnetisation, turns, displacement.x, displacement.y, rotation, in a planar"),
        ("group.0.displacement.x", "1", "group 0 is whatever belongs to none"),
        ("group.1.displacement.x", "1 s", "must be a length"),
        ("group.1.rotation", "north", "must be an angle"),
        ("depth", "-1", "must be at least 1e-12"),
        ("depth.x", "1", "depth"),
        ("speed", "1", "must begin with circuit, group, material, boundary, point or be depth"),
        ("spe\ned" + 90 * "x", "1", r"spe\\ned"),
    ],
)
def test_a_wrong_key(key: str, text: str, sentence: str) -> None:
    """Catches a traceback, a silent change of nothing, a sentence that does not help."""
    with pytest.raises(SpecError, match=sentence) as caught:
        edit(MODEL, {key: text})
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 300


@given(st.text(max_size=30), st.text(max_size=10))
def test_any_text(key: str, text: str) -> None:
    """Catches an exception that is none of ours."""
    for start in ("", "group.", "group.1.", "circuit.coil.", "material.Air.", "boundary.A=0.", "depth"):
        try:
            edit(MODEL, {start + key: text})
        except FluxboreError:
            continue


@given(st.text(":,=-+.0123456789e mx", max_size=20))
def test_any_sweep(text: str) -> None:
    """Catches an exception that is none of ours, and a sweep without an end."""
    with suppress(SpecError):
        assert 1 <= len(sweep_values(text)[1]) <= 10_000


def test_axisymmetric_files_have_other_keys() -> None:
    """Catches a radial displacement of what is all the way round."""
    model = replace(MODEL, axisymmetric=True)
    for key in ("group.1.displacement.x", "group.1.rotation", "group.1.displacement.y"):
        with pytest.raises(SpecError, match=r"displacement\.z, in an axisymmetric file"):
            edit(model, {key: "1"})
    with pytest.raises(SpecError, match="depth of a planar file"):
        edit(model, {"depth": "1"})


def test_lines_around_labels_move_with_them() -> None:
    """Catches a node that merely lies on a side and goes along, or a boundary that does."""
    moved = edit(MESHED, {"group.1.displacement.y": "25.4 mm"})
    expected = [(-9, 0), (9, 0), (1, 1), (3, 1), (3, 2), (1, 2), (2, 0)]
    assert np.array(places(moved)) == pytest.approx(np.array(expected), rel=1e-15)
    assert [b.y for b in moved.labels] == pytest.approx([1.5, 3])
    assert moved.segments == MESHED.segments
    assert moved.labels[0].magnetisation == 90.0


def test_a_line_that_goes_on_stays() -> None:
    """Catches an axis that is drawn in one piece and moves as a whole: only the plunger's corners on it do."""
    nodes = [(0, -9), (9, -9), (9, 9), (0, 9), (0, -1), (2, -1), (2, 1), (0, 1)]
    outer = tuple(Segment(k, (k + 1) % 4) for k in range(4))
    model = FemmModel(
        True,
        materials=MATERIALS,
        nodes=tuple(Node(x, y) for x, y in nodes),
        segments=(*outer, Segment(4, 5), Segment(5, 6), Segment(6, 7)),
        labels=(BlockLabel(1, 0, 2, group=5), BlockLabel(5, 5, 0)),
    )
    moved = edit(model, {"group.5.displacement.z": "2"})
    assert places(moved) == nodes[:4] + [(x, z + 2) for x, z in nodes[4:]]
    assert (moved.labels[0].x, moved.labels[0].y) == (1, 2)


def test_drawn_groups_move_as_drawn() -> None:
    """Catches a search for faces where the file says what belongs together, and holes and arcs' ends that stay."""
    segments = (replace(MODEL.segments[0], group=4), *MODEL.segments[1:])
    arcs = (replace(MODEL.arcs[0], group=4), MODEL.arcs[1])
    nodes = (*MODEL.nodes[:6], replace(MODEL.nodes[6], group=4))
    model = replace(MODEL, nodes=nodes, segments=segments, arcs=arcs, holes=(Hole(2, 5, 4), Hole(2, 5)))
    moved = edit(model, {"group.4.displacement.x": "1"})
    shifted = {0, 1, 2, 3, 6}
    assert places(moved) == [(x + (k in shifted), y) for k, (x, y) in enumerate(places(model))]
    assert [hole.x for hole in moved.holes] == [3, 2]
    assert moved.labels == model.labels


def test_rotation_turns_places_and_magnets() -> None:
    """Catches the wrong sense, and quarter turns that are off by a rounding."""
    moved = edit(MESHED, {"group.1.rotation": "90"})
    assert places(moved)[2:6] == [(0, 1), (0, 3), (-1, 3), (-1, 1)]
    assert moved.labels[0] == replace(MESHED.labels[0], x=-0.5, y=2.0, magnetisation=180.0)


@pytest.mark.parametrize(
    "formula", ["theta", "2*theta+90", "x*3-r", "y^2+z", "R", "x>0 and atan2(y,x) or max(R,-y)--x"]
)
@pytest.mark.parametrize("motion", [Motion(2.0, -0.5), Motion(angle=-50.0), Motion(-1.5, 1e-7), Motion(angle=90)])
def test_a_formula_moves_along(formula: str, motion: Motion) -> None:
    """Catches a magnet whose pattern stays behind, or changes with the name of a coordinate."""
    x, y = np.random.default_rng(3).uniform(-2, 2, (2, 50))
    there = motion.direction(formula)
    assert isinstance(there, str)
    before = parse_formula(formula).evaluate(x, y)
    assert parse_formula(there).evaluate(*motion.place(x, y)) == pytest.approx(before + motion.angle, abs=1e-9)  # type: ignore[arg-type]


def test_a_turned_magnet_has_the_same_energy() -> None:
    """Catches a direction that does not turn with the body: in a round domain nothing else changes."""
    model = replace(MESHED, labels=(replace(MESHED.labels[0], magnetisation="theta*2"), MESHED.labels[1]))
    first = solve_model(model, accuracy=1e-3)
    second = solve_model(edit(model, {"group.1.rotation": "37"}), accuracy=1e-3)
    assert second.energies[0] == pytest.approx(first.energies[0], rel=3e-3)


def test_changes_apply_in_order() -> None:
    """Catches a rotation about another place than the origin."""
    there = edit(MESHED, {"group.1.displacement.x": "1", "group.1.rotation": "180"})
    back = edit(MESHED, {"group.1.rotation": "180", "group.1.displacement.x": "1"})
    assert (there.labels[0].x, back.labels[0].x) == (-3.0, -1.0)


def test_what_has_nothing_to_move() -> None:
    """Catches a motion that silently moves a label only."""
    nodes = [(x, y) for x in range(4) for y in range(4)]
    lines = [(0, 3), (4, 7), (8, 11), (12, 15), (0, 12), (1, 13), (2, 14), (3, 15)]
    model = FemmModel(
        False,
        materials=MATERIALS,
        nodes=tuple(Node(x, y) for x, y in nodes),
        segments=tuple(Segment(a, b) for a, b in lines),
        labels=(BlockLabel(1.5, 1.5, 1, group=6), BlockLabel(0.5, 0.5, 0, default=True)),
    )
    with pytest.raises(SpecError, match="Group 6 must have nodes, lines, arcs or closed faces"):
        edit(model, {"group.6.displacement.x": "1"})


@pytest.mark.parametrize(
    ("text", "pair"),
    [
        ("depth=3", ("depth", "3")),
        (' circuit."a=b".current = 2 A ', ('circuit."a=b".current', "2 A")),
        ("group.1.magnetisation=theta==0 and 1 or 2", ("group.1.magnetisation", "theta==0 and 1 or 2")),
    ],
)
def test_a_setting(text: str, pair: tuple[str, str]) -> None:
    """Catches a name or a formula that is cut at its own equals sign."""
    assert setting(text) == pair


def test_a_quoted_name_with_an_equals_sign() -> None:
    key, value = setting('circuit."a=b".current=2')
    assert edit(MODEL, {key: value}).circuits[2].current == 2.0


@pytest.mark.parametrize("text", ["depth", "depth=", "=3", '"depth=3', ""])
def test_no_setting(text: str) -> None:
    with pytest.raises(SpecError, match="must be KEY=VALUE"):
        setting(text)


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("k=-2:2:0.5", ["-2", "-1.5", "-1", "-0.5", "0", "0.5", "1", "1.5", "2"]),
        ("k=0:0.3:0.1", ["0", "0.1", "0.2", "0.3"]),
        ("k=0:1:0.3 mm", ["0 mm", "0.3 mm", "0.6 mm", "0.9 mm"]),
        ("k=1:-1:-1", ["1", "0", "-1"]),
        ("k=5:5:1", ["5"]),
        ("k=1, 2 A,theta", ["1", "2 A", "theta"]),
    ],
)
def test_sweep_values(text: str, values: list[str]) -> None:
    """Catches a last value that rounding loses, or one too many."""
    assert sweep_values(text) == ("k", tuple(values))


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ("0:1", "FIRST:LAST:STEP"),
        ("0:1:x", "FIRST:LAST:STEP"),
        ("0:1:inf", "FIRST:LAST:STEP"),
        ("0:1:0", "a step that leads from first to last"),
        ("0:1:-0.1", "a step that leads from first to last"),
        ("0:1:1e-4", "at most 10000 values; got"),
        ("0:1:1e-300", "at most 10000 values; got"),
        ("1,,2", "a value between commas"),
        (",".join("1" * 10_001), "at most 10000 values; got 10001"),
    ],
)
def test_no_sweep(values: str, sentence: str) -> None:
    """Catches a sweep that never ends."""
    with pytest.raises(SpecError, match=re.escape(sentence)):
        sweep_values(f"k={values}")
