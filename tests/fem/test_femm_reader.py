"""Reading FEMM's files: what they say, and one sentence for what they must not."""

from dataclasses import replace
from pathlib import Path

import femm_mutations
import numpy as np
import pytest

from fluxbore.design.errors import FluxboreError, SpecError
from fluxbore.fem.femm_model import (
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
from fluxbore.fem.femm_reader import LARGEST_FILE, parse, read_model
from fluxbore.fem.femm_writer import write_text

TEXT = """[Format]      =  4.0
[Frequency]   =  0
[Precision]   =  1e-008
[MinAngle]    =  30
[DoSmartMesh] =  0
[Depth]       =  50
[LengthUnits] =  millimeters
[ProblemType] =  planar
[Coordinates] =  cartesian
[ACSolver]    =  0
[PrevType]    =  0
[PrevSoln]    =  ""
[Comment]     =  "a "quoted" word\\nand more"
[PointProps]   = 2
  <BeginPoint>
    <PointName> = "fixed"
    <I_re> = 0
    <I_im> = 0
    <A_re> = 0.25
    <A_im> = 0
  <EndPoint>
  <BeginPoint>
    <PointName> = "wire"
    <I_re> = -2
    <A_re> = 7
  <EndPoint>
[BdryProps]   = 3
  <BeginBdry>
    <BdryName> = "A=0"
    <BdryType> = 0
    <A_0> = 1
    <A_1> = 2
    <A_2> = 3
    <Phi> = 60
    <c0> = 9
  <EndBdry>
  <BeginBdry>
    <BdryName> = "open"
    <BdryType> = 2
    <A_0> = 9
    <c0> = 5
    <c1> = 6
  <EndBdry>
  <BeginBdry>
    <BdryName> = "odd"
    <BdryType> = 5
  <EndBdry>
[BlockProps]  = 3
  <BeginBlock>
    <BlockName> = "Air"
    <LamFill> = 0
  <EndBlock>
  <BeginBlock>
    <BlockName> = "steel"
    <Mu_x> = 1000
    <Mu_y> = 500
    <J_re> = 1.1
    <Sigma> = 5.8
    <LamType> = 1
    <LamFill> = .95
    <BHPoints> = 3
      0\t0
      1.0\t100
      1.5\t5000
  <EndBlock>
  <BeginBlock>
    <BlockName> = "Air"
    <H_c> = 979000
    <LamType> = 4
  <EndBlock>
[CircuitProps]  = 1
  <BeginCircuit>
    <CircuitName> = "coil"
    <TotalAmps_re> = 2
    <TotalAmps_im> = 0
    <CircuitType> = 1
  <EndCircuit>
[NumPoints] = 4
0\t0\t0\t0
10\t0\t1\t0
10\t10\t2\t3
0\t+1e1\t0\t0
[NumSegments] = 3
0\t1\t-1\t1\t0\t0
1\t2\t0.5\t0\t1\t4
3\t0\t0\t3\t0\t0
[NumArcSegments] = 1
2\t3\t180\t2.5\t2\t0\t1\t2.5
[NumHoles] = 1
1\t1\t2
[NumBlockLabels] = 2
5\t5\t2\t0.25\t1\t90\t2\t-400\t2
6 6 3 -1 0 0 1 1 0\t"theta + 180"
"""

MODEL = FemmModel(
    axisymmetric=False,
    unit="millimeters",
    depth=50.0,
    precision=1e-8,
    min_angle=30.0,
    comment=r'a "quoted" word\nand more',
    points=(PointProperty("fixed", 0.25), PointProperty("wire", None, -2.0)),
    boundaries=(
        BoundaryProperty("A=0", "prescribed", 1.0, 2.0, 3.0, 60.0),
        BoundaryProperty("open", "mixed", c0=5.0, c1=6.0),
        BoundaryProperty("odd", "antiperiodic"),
    ),
    materials=(
        BlockProperty("Air"),
        BlockProperty(
            "steel", 1000.0, 500.0, 0.0, 1.1e6, 5.8e6, "parallel to x", 0.95, ((0.0, 0.0), (1.0, 100.0), (1.5, 5000.0))
        ),
        BlockProperty("Air", coercivity=979000.0, lamination="wire"),
    ),
    circuits=(CircuitProperty("coil", 2.0),),
    nodes=(Node(0.0, 0.0), Node(10.0, 0.0, 0), Node(10.0, 10.0, 1, 3), Node(0.0, 10.0)),
    segments=(Segment(0, 1, None, 0), Segment(1, 2, 0.5, None, True, 4), Segment(3, 0, None, 2)),
    arcs=(Arc(2, 3, 180.0, 2.5, 1, False, 1),),
    holes=(Hole(1.0, 1.0, 2),),
    labels=(
        BlockLabel(5.0, 5.0, 1, 0.25, 0, 90.0, 2, -400.0, default=True),
        BlockLabel(6.0, 6.0, 2, magnetisation="theta + 180", group=1),
    ),
)


def edited(old: str, new: str) -> str:
    """TEXT with its first ``old`` as ``new``."""
    assert old in TEXT
    return TEXT.replace(old, new, 1)


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


@pytest.mark.parametrize(
    "old, new, words, place",
    [
        ("[Frequency]   =  0", "[Frequency] = 50", r"\[Frequency\] must be 0, as time-harmonic .* got 50\.", ""),
        ('[PrevSoln]    =  ""', '[PrevSoln] = "a b.ans"', r'\[PrevSoln\] must be empty.* "a b.ans"', ""),
        ("[PrevType]    =  0", "[PrevType] = 1", r"\[PrevType\] must be 0", ""),
        ("[Format]      =  4.0", "[Format] = 5", r'\[Format\] must be 4.0; got "5"', ""),
        ("[Format]      =  4.0", "[Format] = 3.0", "must be 4.0", ""),
        ("millimeters", "furlongs", "must be inches or .*furlongs", ""),
        ("planar", "spherical", "must be planar or axisymmetric", ""),
        ("cartesian", "spherical", "must be cartesian or polar", ""),
        ("=  50", "= 0", r"\[Depth\] must be positive", ""),
        ("<BdryType> = 5", "<BdryType> = 3", "strategic dual image is not supported", "3\t0\t0\t3"),
        ("<BdryType> = 5", "<BdryType> = 1", "small skin depth is not supported", "3\t0\t0\t3"),
        ("<BdryType> = 2", "<BdryType> = 6", "periodic air gap is not supported", "2\t3\t180"),
        ("<BdryType> = 2", "<BdryType> = 7", "antiperiodic air gap is not supported", "2\t3\t180"),
        ("<BdryType> = 2", "<BdryType> = 8", "<BdryType> must be from 0 to 7; got 8", ""),
        ("<c1> = 6", "<c1i> = 6", "<c1i> must be 0, as imaginary", ""),
        ("<I_im> = 0", "<I_im> = 1", "<I_im> must be 0, as imaginary", ""),
        ("<TotalAmps_im> = 0", "<TotalAmps_im> = 1", "<TotalAmps_im> must be 0, as imaginary", ""),
        ("<CircuitType> = 1", "<CircuitType> = 2", "0 for parallel or 1 for series; got 2", ""),
        ("<CircuitType> = 1", "<VoltGradient_re> = 1", "voltage gradient", ""),
        ("<J_re> = 1.1", "<J_im> = 1.1", "<J_im> must be 0", ""),
        ("<Mu_x> = 1000", "<Mu_x> = 0", "<Mu_x> must be a relative permeability .* got 0", ""),
        ("<Mu_y> = 500", "<Mu_y> = -1", "<Mu_y> must be a relative permeability", ""),
        ("<LamFill> = .95", "<LamFill> = 1.2", "<LamFill> must be above 0 and at most 1; got 1.2", ""),
        ("<LamFill> = .95", "<LamFill> = 0", "<LamFill> must be above 0", ""),
        ("<LamType> = 4", "<LamType> = 9", "<LamType> must be from 0 to 8; got 9", ""),
        ("<H_c> = 979000", "<H_c> = 1e12", "<H_c> must be at most", ""),
        ("<Sigma> = 5.8", "<Sigma> = -1", "<Sigma> must not be negative; got -1", ""),
        ("1.0\t100", "1.0\t-100", "must rise in both columns after B = 0 T", ""),
        ("1.5\t5000", "1.0\t5000", "must rise in both columns after B = 1 T", ""),
        ("1.5\t5000", "1.001\t5000", "0.5 times as steeply as air", ""),
        ("1.5\t5000", "15000\t5000", "B must be at most 100 T", ""),
        ("      0\t0\n", "      -1\t-1\n", "must rise in both columns after B = 0 T, H = 0 A/m; got B = -1", ""),
        ("<BHPoints> = 3\n      0\t0\n      1.0\t100\n", "<BHPoints> = 1\n", "3 with the origin, or 0; got 1", ""),
        ("<BHPoints> = 3", "<BHPoints> = 4", "<BHPoints> must have 4 rows after it; got 3", ""),
        ("<BHPoints> = 3", "<BHPoints> = 2", '"1.5\\\\t5000" is a row that no key announces', "1.5\t5000"),
        ("1.0\t100", "1.0", "H must stand in column 2; the row has 1", ""),
        ("[NumPoints] = 4", "[NumPoints] = 5", r"\[NumPoints\] must have 5 rows after it; got 4", ""),
        ("[NumPoints] = 4", "[NumPoints] = 3", "a row that no key announces", "0\t+1e1"),
        ("[NumPoints] = 4", "[NumPoints] = -4", "number of rows; got -4", ""),
        ("[NumPoints] = 4", "[NumPoints] = four", 'must be a number of at most 1e\\+30; got "four"', ""),
        ("[NumHoles] = 1", "[NumHoles] = 1e30", "whole number", ""),
        ("[NumHoles] = 1", "[NumPoints] = 1", r"\[NumPoints\] must stand once", ""),
        ("[BdryProps]   = 3", "[BdryProps] = 2", r"\[BdryProps\] must be the number of its properties, 3; got", ""),
        ("0\t0\t0\t0", "0\tnan\t0\t0", 'y must be a number of at most 1e\\+30; got "nan"', ""),
        ("0\t0\t0\t0", "0\t1e999\t0\t0", "y must be a number", ""),
        ("0\t0\t0\t0", "0\t1_0\t0\t0", "y must be a number", ""),
        ("0\t0\t0\t0", "1e20\t0\t0\t0", "within 1e\\+06 m of the origin", ""),
        ("[Depth]       =  50", "[Depth] = 1e20", r"\[Depth\] must be from 1e-15 m to 1e\+09 m; got 1e\+17 m", ""),
        ("<TotalAmps_re> = 2", "<TotalAmps_re> = -1e13", r"<TotalAmps_re> must be at most 1e\+12; got -1e\+13", ""),
        ("90\t2\t-400", "90\t2\t4e9", r"number of turns must be at most 1e\+09; got 4e\+09", ""),
        ("10\t0\t1\t0", "10\t0\t3\t0", "point property must be one of the 2 that .*, or 0 for none; got 3", ""),
        ("10\t0\t1\t0", "10\t0\t-1\t0", "got -1", ""),
        ("10\t0\t1\t0", "10\t0\t0.5\t0", "whole number", ""),
        ("0\t1\t-1\t1\t0\t0", "0\t4\t-1\t1\t0\t0", "A segment must join points from 0 to 3; got 4", ""),
        ("0\t1\t-1\t1\t0\t0", "1\t1\t-1\t1\t0\t0", "A segment must have a length", ""),
        ("10\t0\t1\t0", "0\t0\t1\t0", "A segment must have a length", "0\t1\t-1"),
        ("0\t1\t-1\t1\t0\t0", "0\t1\t-1\t4\t0\t0", "boundary property must be one of the 3", ""),
        ("2\t3\t180", "2\t3\t0", "angle must be above 0 and at most 180 degrees; got 0", ""),
        ("2\t3\t180", "2\t3\t181", "got 181", ""),
        ("5\t5\t2\t0.25", "5\t5\t4\t0.25", "block property must be one of the 3", ""),
        ("0.25\t1\t90", "0.25\t2\t90", "circuit must be one of the 1", ""),
        ('"theta + 180"', '"theta + foo"', 'The formula "theta \\+ foo" must be .*"foo" is not known', ""),
        ("<EndBlock>", "", "stand within the property that line 49 begins", '<BeginBlock>\n    <BlockName> = "st'),
        ("<BeginBlock>", "", "<EndBlock> must end a property", "<EndBlock>"),
        ("  <EndCircuit>\n", "", "<Begincircuit> must be closed", "<BeginCircuit>"),
        ("[ACSolver]    =  0", "ACSolver = 0", "no key in", ""),
        ("[ACSolver]    =  0", "[dT] = 0", "belongs to FEMM's files of heat flow", ""),
        ("[ACSolver]    =  0", "[ConductorProps] = 0", "electrostatics, heat flow or current flow", ""),
        ("[NumHoles] = 1\n1\t1\t2", "[Solution]\n3\n1 2 3", "results in an .ans file", ""),
    ],
)  # fmt: skip
def test_what_cannot_be_solved_is_named_with_its_line(old: str, new: str, words: str, place: str) -> None:
    """Catches a wrong answer to a file that asks for something else, and a message that leaves the user searching.

    place : what stands in the line at fault, where that is not the edited one.
    """
    text = edited(old, new)
    number = 1 + text[: text.index(place) if place else TEXT.index(old)].count("\n")
    with pytest.raises(SpecError, match=words) as caught:
        parse(text, "somewhere/model.fem")
    message = str(caught.value)
    assert message.startswith(f"model.fem, line {number}: ")
    assert message.endswith(".")
    assert "\n" not in message


@pytest.mark.parametrize(
    "text, words",
    [
        ("", "this is empty"),
        ("\ufeff \r\n", "this is empty"),
        ("GIF89a\0\0", "this is binary"),
        ("once upon a time", r"must have a \[Format\] of 4.0"),
        ("Frequency   =  0\nLengthUnits =  1\n", r"must have a \[Format\] of 4.0"),
        (edited("[LengthUnits] =  millimeters\n", ""), r"must have \[LengthUnits\] = inches or"),
        (edited("[ProblemType] =  planar\n", ""), r"must have \[ProblemType\] = planar or axisymmetric"),
        (TEXT[: TEXT.index("[NumBlockLabels]")], r"must have \[NumBlockLabels\] with at least one row"),
        (TEXT[: TEXT.index("[NumPoints]")], r"must have \[NumPoints\]"),
        (TEXT[: TEXT.index("[NumSegments]")] + TEXT[TEXT.index("[NumHoles]") :], "must have segments or arcs"),
    ],
)
def test_what_is_no_such_file_at_all_is_said_so(text: str, words: str) -> None:
    """Catches a traceback, and a truncated file solved."""
    with pytest.raises(SpecError, match=f"^The file: .*{words}"):
        parse(text)


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


def test_files_that_cannot_be_read_are_refused_by_name(tmp_path: Path) -> None:
    """Catches a traceback of the operating system, and memory filled by a device or a disk image."""
    with pytest.raises(SpecError, match=r"^gone\.fem: it cannot be read: No such file"):
        read_model(tmp_path / "gone.fem")
    with pytest.raises(SpecError, match="none"):
        read_model(tmp_path)
    with pytest.raises(SpecError, match="none"):
        read_model("/dev/zero")
    with pytest.raises(SpecError):
        read_model("a\0b.fem")
    huge = tmp_path / "huge.fem"
    with huge.open("wb") as file:
        file.truncate(LARGEST_FILE + 1)
    with pytest.raises(SpecError, match=r"^huge\.fem: it must have at most 50 MB; got more\.$"):
        read_model(huge)


def test_two_thousand_damaged_files_give_a_model_or_one_sentence() -> None:
    """Catches every exception that is not ours, and a model that cannot be written again."""
    rng = np.random.default_rng(20240607)
    texts = [TEXT, TEXT.replace("planar", "axisymmetric"), write_text(MODEL)]
    read = 0
    for number in range(2000):
        text = femm_mutations.mutate(texts[number % len(texts)], rng)
        try:
            model = parse(text, "model.fem")
        except FluxboreError as error:
            sentence = str(error)
            assert sentence.startswith("model.fem")
            assert sentence.endswith(".")
            assert sentence.isprintable()
            assert len(sentence) < 500
        else:
            read += 1
            assert parse(write_text(model), "model.fem") == model
    # Otherwise the damage is so great that nothing behind the reader is ever tried.
    assert 500 < read < 1800


@pytest.mark.parametrize("mutator", femm_mutations.MUTATORS)
def test_each_mutator_changes_files_the_same_way_each_time(mutator: femm_mutations.Mutator) -> None:
    """Catches a fuzz run that cannot be repeated, and a mutator that does nothing."""
    runs = [[mutator(TEXT, np.random.default_rng(seed)) for seed in range(20)] for _ in range(2)]
    assert runs[0] == runs[1]
    assert any(text != TEXT for text in runs[0])
    assert isinstance(mutator("", np.random.default_rng(0)), str)
