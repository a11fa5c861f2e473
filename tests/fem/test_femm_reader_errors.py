"""FEMM's files that cannot be solved: one sentence for each, with its line."""

from pathlib import Path

import pytest
from femm_example import TEXT, edited

from fluxbore.design.errors import SpecError
from fluxbore.fem.femm_reader import LARGEST_FILE, parse, read_model


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
