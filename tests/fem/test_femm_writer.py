"""What is written reads back as the same model, and has what FEMM looks for."""

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.bh_curve import MU_0
from fluxbore.design.errors import OutputError
from fluxbore.fem.femm_model import (
    METRES,
    Arc,
    BlockLabel,
    BlockProperty,
    BoundaryProperty,
    CircuitProperty,
    Exterior,
    FemmModel,
    Hole,
    Node,
    PointProperty,
    Segment,
)
from fluxbore.fem.femm_reader import parse
from fluxbore.fem.femm_writer import write_text

values = st.floats(-1e9, 1e9, allow_subnormal=False)
lengths = st.floats(1e-9, 1e5)
positive = st.floats(1e-9, 1e9)
names = st.text(st.characters(blacklist_characters="\n\r\0", blacklist_categories=["Cs"]), max_size=12)
groups = st.integers(-5, 2**31 - 1)
formulas = st.sampled_from(["theta", "theta+180", "atan2(y,x)*180/PI", "x>0 and 90 or -90"])


def number(count: int) -> st.SearchStrategy[int | None]:
    return st.none() | st.integers(0, count - 1) if count else st.none()


def some(items: st.SearchStrategy, least: int = 0) -> st.SearchStrategy:  # type: ignore[type-arg]
    return st.lists(items, min_size=least, max_size=3).map(tuple)


@st.composite
def curves(draw: st.DrawFn) -> tuple[tuple[float, float], ...]:
    """From the origin, each step at least as steep as air."""
    rows = [(0.0, 0.0)]
    for step in draw(st.lists(st.floats(1, 1e5), min_size=2, max_size=6)):
        h = rows[-1][1] + step
        rows.append((rows[-1][0] + MU_0 * step * draw(st.floats(1, 100)), h))
    return tuple(rows) if rows[-1][0] < 100 else ()


@st.composite
def models(draw: st.DrawFn) -> FemmModel:
    axisymmetric = draw(st.booleans())
    points = draw(some(st.builds(PointProperty, names, values) | st.builds(PointProperty, names, st.none(), positive)))
    periodic = st.builds(BoundaryProperty, names, st.sampled_from(["periodic", "antiperiodic"]))
    prescribed = st.builds(BoundaryProperty, names, st.just("prescribed"), values, values, values, values)
    mixed = st.builds(BoundaryProperty, names, st.just("mixed"), c0=values, c1=values)
    boundaries = draw(some(periodic | prescribed | mixed))
    materials = draw(
        some(
            st.builds(
                BlockProperty,
                names,
                mu_x=st.floats(1e-3, 1e6),
                mu_y=st.floats(1e-3, 1e6),
                coercivity=st.floats(-2e6, 2e6),
                current_density=values,
                conductivity=st.floats(0, 1e9),
                lamination=st.sampled_from(["in plane", "parallel to x", "parallel to y", "wire"]),
                fill=st.floats(0.01, 1),
                curve=curves() | st.just(()),
            )
        )
    )
    circuits = draw(some(st.builds(CircuitProperty, names, values, st.booleans())))
    x = st.floats(0 if axisymmetric else -900, 900)
    y = st.floats(-900, 900)
    # Distinct in y, so that every line has a length.
    nodes = tuple(
        Node(draw(x), at, draw(number(len(points))), draw(groups))
        for at in draw(st.lists(y, min_size=2, max_size=5, unique=True))
    )
    ends = st.permutations(range(len(nodes))).map(lambda order: order[:2])
    sizes = st.none() | positive
    angles = st.floats(1e-6, 180)
    rest = st.tuples(number(len(boundaries)), st.booleans(), groups)
    segments = draw(some(st.builds(lambda e, size, last: Segment(*e, size, *last), ends, sizes, rest), 1))
    arcs = draw(some(st.builds(lambda e, turn, most, last: Arc(*e, turn, most, *last), ends, angles, angles, rest)))
    exterior = (
        draw(st.none() | st.builds(Exterior, lengths | lengths.map(lambda x: -x), lengths, lengths))
        if axisymmetric
        else None
    )
    outside = st.booleans() if exterior is not None or not axisymmetric else st.just(False)
    labels = st.builds(
        BlockLabel, x, y, number(len(materials)), sizes, number(len(circuits)), values | formulas, groups, values,
        outside, st.booleans(),
    )  # fmt: skip
    return FemmModel(
        axisymmetric,
        draw(st.sampled_from(list(METRES))),  # type: ignore[arg-type]
        draw(positive),
        draw(st.booleans()),
        draw(positive),
        draw(positive),
        draw(names),
        points,
        boundaries,
        materials,
        circuits,
        nodes,
        segments,
        arcs,
        draw(some(st.builds(Hole, x, y, groups))),
        draw(some(labels, 1)),
        exterior,
    )


@given(models())
def test_what_is_written_reads_back_as_the_same_model(model: FemmModel) -> None:
    """Catches a lost key, a number cut to a few digits, an index off by one and a unit taken twice."""
    assert parse(write_text(model)) == model


SMALL = FemmModel(
    axisymmetric=True,
    comment='say "A"',
    points=(PointProperty("wire", None, 2.0),),
    materials=(BlockProperty("steel", current_density=3.1e6, lamination="wire", curve=((0, 0), (1, 99), (2, 5000.0))),),
    nodes=(Node(0.0, 0.1), Node(1.0, 2.0)),
    segments=(Segment(0, 1),),
    labels=(BlockLabel(0.3, 0.2, 0, magnetisation="theta"),),
    exterior=Exterior(1.0, 2.0, 3.0),
)


def test_the_file_has_the_keys_of_femm_in_its_order() -> None:
    """Catches a key that FEMM needs and we pass over when reading."""
    keys = re.findall(r"^\s*[\[<](\w+)[\]>]", write_text(SMALL), re.MULTILINE)
    assert keys[:17] == [
        "Format", "Frequency", "Precision", "MinAngle", "DoSmartMesh", "Depth", "LengthUnits", "ProblemType", "extZo",
        "extRo", "extRi", "Coordinates", "ACSolver", "PrevType", "PrevSoln", "Comment", "PointProps",
    ]  # fmt: skip
    assert keys[17:24] == ["BeginPoint", "PointName", "I_re", "I_im", "A_re", "A_im", "EndPoint"]
    assert keys[24:44] == [
        "BdryProps", "BlockProps", "BeginBlock", "BlockName", "Mu_x", "Mu_y", "H_c", "H_cAngle", "J_re", "J_im",
        "Sigma", "d_lam", "Phi_h", "Phi_hx", "Phi_hy", "LamType", "LamFill", "NStrands", "WireD", "BHPoints",
    ]  # fmt: skip
    assert keys[44:] == [
        "EndBlock", "CircuitProps", "NumPoints", "NumSegments", "NumArcSegments", "NumHoles", "NumBlockLabels",
    ]  # fmt: skip


def test_rows_count_from_one_and_carry_the_formula_in_quotes() -> None:
    """Catches properties numbered from 0 in the file, where 0 is none."""
    lines = write_text(SMALL).splitlines()
    assert lines[-1] == '0.3\t0.2\t1\t-1\t0\t0\t0\t1\t0\t"theta"'
    assert "    <J_re> = 3.1" in lines
    assert lines[lines.index("    <BHPoints> = 3") + 3] == "      2\t5000.0"


def test_a_line_break_becomes_two_characters() -> None:
    """Catches a comment that breaks the file."""
    assert parse(write_text(replace(SMALL, comment="one\r\ntwo"))).comment == r"one\ntwo"


def test_a_point_property_that_says_nothing_cannot_be_written() -> None:
    """Catches a free point that comes back with its potential held at zero."""
    with pytest.raises(OutputError, match='"p" must have a potential or a current'):
        write_text(replace(SMALL, points=(PointProperty("p", None),)))


def test_numbers_of_numpy_are_numbers_in_the_file() -> None:
    """Catches np.float64(1.0) in a file, which is what its repr says."""
    node, hole = Node(np.float64(0.5), np.float32(2.0)), Hole(np.float64(1.0), 1.0, np.int64(4))  # type: ignore[arg-type]
    model = replace(SMALL, depth=np.float64(2.0), nodes=(node, *SMALL.nodes), holes=(hole,))
    assert "np." not in write_text(model)
    assert parse(write_text(model)) == model
