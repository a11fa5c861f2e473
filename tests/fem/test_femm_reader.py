"""Reading FEMM's files: what they say."""

from dataclasses import replace
from pathlib import Path

import pytest
from femm_example import MODEL, TEXT, edited

from fluxbore.design.errors import SpecError
from fluxbore.fem.femm_model import Arc, BlockLabel, BoundaryProperty, Exterior, Segment
from fluxbore.fem.femm_reader import parse, read_model


def test_a_file_is_read_in_its_own_units() -> None:
    """Catches columns and keys mixed up, MA/m² left as they are, and indices that still count from one."""
    assert parse(TEXT) == MODEL


@pytest.mark.parametrize(
    "other",
    [
        TEXT.replace("\n", "\r\n"),
        TEXT.replace("\n", "\r"),
        "\ufeff" + TEXT,
        TEXT.replace("\t", "   "),
        TEXT.replace("\n", "\n\n"),
        TEXT.replace("] =", "]=").replace("> =", ">="),
        TEXT.replace("[Num", "  [num").replace("BlockName", "BLOCKNAME").replace("Format", "FORMAT"),
        TEXT.replace("<BeginBlock>", "<BeginBlock>\n<NewKey> = 7") + "[NewSection] = many things\n<New>\n",
        edited("[Frequency]   =  0\n", ""),
        edited("[Depth]       =  50", "[Depth]=5\n[Depth] = 50"),
        edited(' "odd"', " odd"),
        edited("      0\t0\n", "      0\t0\n\n"),
    ],
)
def test_the_same_file_in_other_hands_is_the_same_model(other: str) -> None:
    """Catches line ends, a byte order mark, blanks, case and unknown keys taken for something."""
    assert replace(parse(other), comment=MODEL.comment) == MODEL


def test_sections_come_in_any_order() -> None:
    """Catches an index that is checked before its section was read."""
    head, *sections = TEXT.split("[Num")
    assert parse("[Num" + "[Num".join(sections) + head) == MODEL


@pytest.mark.parametrize(
    "unit, word", [("inches", "inches"), ("microns", "Microns"), ("microns", "micrometers"), ("mils", '"mils"')]
)
def test_units(unit: str, word: str) -> None:
    """Catches FEMM's other word for a unit."""
    assert parse(edited("millimeters", word)).unit == unit


def test_a_file_without_depth_is_a_metre_deep() -> None:
    """Catches one unit, or the axisymmetric file's depth, which means nothing, refused."""
    assert parse(edited("[Depth]       =  50\n", "")).depth == 1000.0
    assert parse(edited("=  50", "= -1")).depth == 1000.0
    assert parse(edited("=  50", "= 0").replace("planar", "axisymmetric")).depth == 1.0


def test_the_exterior_region_is_read_in_axisymmetric_files() -> None:
    """Catches its three keys swapped, and a half-given region taken for one."""
    whole = TEXT.replace("planar", "axisymmetric\n[extZo] = 1\n[extRo] = 2\n[extRi] = 3").replace("-400\t2", "-400\t3")
    assert parse(whole).exterior == Exterior(1.0, 2.0, 3.0)
    assert parse(whole).labels[0].external
    assert parse(whole).labels[0].default
    with pytest.raises(SpecError, match=r"line \d+: A label of the exterior region must have \[extRo\]"):
        parse(whole.replace("[extRi] = 3\n", ""))


def test_older_rows_are_shorter() -> None:
    """Catches columns demanded that older versions did not write."""
    text = TEXT.replace("5\t5\t2\t0.25\t1\t90\t2\t-400\t2", "5\t5\t2").replace("0\t1\t-1\t1\t0\t0", "0\t1")
    model = parse(text.replace("180\t2.5\t2\t0\t1\t2.5", "90"))
    assert model.labels[0] == BlockLabel(5.0, 5.0, 1)
    assert model.segments[0] == Segment(0, 1)
    assert model.arcs[0] == Arc(2, 3, 90.0)


def test_a_point_on_the_axis_but_for_rounding_is_put_on_it() -> None:
    """Catches a file refused for the last bit of a rotation."""
    text = TEXT.replace("planar", "axisymmetric")
    assert parse(text.replace("0\t0\t0\t0\n10", "-1e-13\t0\t0\t0\n10")).nodes[0].x == 0.0
    assert parse(text.replace("0\t0\t0\t0\n10", "-9e-7\t0\t0\t0\n10")).nodes[0].x == 0.0
    with pytest.raises(SpecError, match=r"must not be negative in an axisymmetric file; got -0\.1"):
        parse(text.replace("0\t0\t0\t0\n10", "-0.1\t0\t0\t0\n10"))


def test_a_boundary_that_no_line_uses_may_be_of_any_kind() -> None:
    """Catches a good file refused for what it does not use, and the numbers of the others shifted."""
    unused = edited("2\t3\t180\t2.5\t2", "2\t3\t180\t2.5\t0").replace("<BdryType> = 2", "<BdryType> = 6")
    model = parse(unused)
    assert model.boundaries[1] == BoundaryProperty("open", "mixed")
    assert model.segments[2].boundary == 2


def test_steels_of_femm_just_below_the_slope_of_air_are_read() -> None:
    """Catches FEMM's own US Steel type 2-S refused, whose last points rise at 0.947 μ0."""
    assert parse(edited("1.5\t5000", "1.00119\t1100")).materials[1].curve[-1] == (1.00119, 1100.0)


def test_names_hold_any_letters_in_either_alphabet(tmp_path: Path) -> None:
    """Catches a file of a Windows program refused for its µ."""
    file = tmp_path / "größe.fem"
    for encoding in ("utf-8", "utf-8-sig", "cp1252", "latin-1"):
        file.write_bytes(edited('"steel"', '"Stahl µ = ½ <x> [y] = "z""').encode(encoding))
        assert read_model(file).materials[1].name == 'Stahl µ = ½ <x> [y] = "z"'
    assert read_model(file).path == str(file)
    file.write_bytes(b'[Format] = 4.0\n[Comment] = "\x81\xff"\n')
    with pytest.raises(SpecError, match=r"^größe\.fem: it must have"):
        read_model(str(file))
