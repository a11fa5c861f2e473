"""Bad input, through the command line as a person meets it: one clear sentence, exit status 2, nothing written.

The catalogue holds one case a line: what is wrong, and words that the sentence must contain (key, limit, value).
"""

# ruff: noqa: E501  one case a line, as long as it is

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fluxbore.cli import main
from fluxbore.design.spec_file import template

TEXT = template("ipehla")
IRON = '\n[materials."my iron"]\ntype = "soft iron"\ndensity = "7.8 g/cm^3"\n'


@pytest.fixture
def run(tmp_path, monkeypatch, capsys):
    """Run one command in an empty folder; returns status, stdout and stderr, and checks what every refusal promises."""
    monkeypatch.chdir(tmp_path)

    def command(*arguments: str, text: str | bytes = TEXT) -> tuple[int, str, str]:
        Path("spec.toml").write_bytes(text if isinstance(text, bytes) else text.encode())
        before = sorted(tmp_path.rglob("*"))
        status = main(arguments)
        out, err = capsys.readouterr()
        assert "Traceback" not in err
        assert status in (0, 2, 3)
        if status == 2:
            assert out == ""
            assert err.startswith("fluxbore: ")
            assert err.endswith(".\n")
            assert err.count("\n") == 1
            assert err[:-1].isprintable()
            assert len(err) < 600
            assert sorted(tmp_path.rglob("*")) == before, "a refusal leaves nothing behind"
        return status, out, err

    return command


def swap(old: str, new: str) -> str:
    assert old in TEXT
    return TEXT.replace(old, new, 1)


SPECS = {
    "unknown key": (swap('thickness = "1 mm"', 'thicknes = "1 mm"'), ["actuator.back_yoke.thicknes is not a key", "did you mean actuator.back_yoke.thickness?"]),
    "unknown section": (TEXT + "\n[actuatr]\nx = 1\n", ["actuatr is not a section", "did you mean actuator"]),
    "section at the wrong place": (TEXT + "\n[back_yoke]\nx = 1\n", ["back_yoke is not a section", "did you mean actuator.back_yoke?"]),
    "key with a line feed": (TEXT + '\n["a\\nb"]\nx = 1\n', ["a\\nb is not a section"]),
    "missing unit": (swap('"1 mm"', '"1"'), ["actuator.back_yoke.thickness must be a length", 'got "1" without a unit']),
    "bare number": (swap('"1 mm"', "1"), ["actuator.back_yoke.thickness", "got the bare number 1."]),
    "wrong unit": (swap('"1 mm"', '"1 kg"'), ["actuator.back_yoke.thickness", "mm, um, cm, m, in", 'with the unit "kg"']),
    "two units": (swap('"27 mm"', '"27 m m"'), ["actuator.back_yoke.outer_diameter", 'got "27 m m" with the unit "m m"']),
    "comma": (swap('"1.5 mm"', '"1,5 mm"'), ["actuator.mover.ring_width", "the decimal sign is a point"]),
    "pressure without gauge": (swap('"0.6 MPa gauge"', '"0.6 MPa"'), ["operating_point.pressure", 'say "MPa gauge" or "MPa absolute"']),
    "negative pressure": (swap('"0.6 MPa gauge"', '"-0.2 MPa gauge"'), ["operating_point.pressure must be at least 0 MPa gauge; got -0.2 MPa gauge"]),
    "below absolute zero": (swap('"20 degC"', '"-300 degC"'), ["operating_point.winding_temperature must exceed -273.15 degC; got -300 degC"]),
    "zero": (swap('"1 mm"', '"0 mm"'), ["actuator.back_yoke.thickness must exceed 0 mm; got 0 mm."]),
    "negative": (swap('"1 mm"', '"-1 mm"'), ["actuator.back_yoke.thickness must exceed 0 mm; got -1 mm."]),
    "nan": (swap('"1 mm"', '"nan mm"'), ["actuator.back_yoke.thickness"]),
    "bare nan": (swap("584", "nan"), ["actuator.winding.turns must be a plain finite number", "got nan"]),
    "inf": (swap("584", "inf"), ["actuator.winding.turns", "got inf"]),
    "1e400": (swap('"1 mm"', '"1e400 mm"'), ["actuator.back_yoke.thickness must be a finite length", "1e400 mm"]),
    "1e9999999999": (swap('"1 mm"', '"1e9999999999 mm"'), ["actuator.back_yoke.thickness must be a finite length"]),
    "a very long value": (swap('"1 mm"', '"' + "x" * 5000 + '"'), ["actuator.back_yoke.thickness", "xxx..."]),
    "a long whole number": (swap("584", "9" * 400), ["whole numbers of at most 64 bits; got one of 400 digits"]),
    "a value of two lines": (swap('"1 mm"', '"1 mm\\n2"'), ["actuator.back_yoke.thickness", "1 mm\\n2"]),
    "html": (swap('"1 mm"', '"<script>alert(1)</script>"'), ["actuator.back_yoke.thickness"]),
    "a table for a value": (swap('"1 mm"', "{}"), ["actuator.back_yoke.thickness must be a value or", "got an empty table"]),
    "a reason alone": (swap('"1 mm"', '{ assumed = "x" }'), ["actuator.back_yoke.thickness must be a value or"]),
    "a reason that is no text": (swap('"1 mm"', '{ value = "1 mm", assumed = 1 }'), ["actuator.back_yoke.thickness must be a value or"]),
    "two reasons": (swap('"1 mm"', '{ value = "1 mm", assumed = "x", calibrated = "y" }'), ["must be a value or"]),
    "a list for a value": (swap('"1 mm"', '[["1 mm"]]'), ["actuator.back_yoke.thickness", 'got [["1 mm"]]']),
    "a date for a value": (swap('"1 mm"', "1979-05-27"), ["actuator.back_yoke.thickness", "got 1979-05-27"]),
    "a truth for a count": (swap("= 8  ", "= true"), ["actuator.winding.sets_per_phase must be a whole number", "got true"]),
    "a fraction for a count": (swap("= 8  ", "= 8.0"), ["actuator.winding.sets_per_phase must be a whole number", "got 8.0"]),
    "a number for a word": (swap('material = "copper"', "material = 1"), ["actuator.winding.material must be text in quotes; got 1."]),
    "a value for a section": ('[actuator]\nkind = "hybrid"\nwinding = 3\n', ["actuator.winding must be a section of keys, [actuator.winding]; got 3."]),
    "a list for a section": ('[[actuator]]\nkind = "hybrid"\n', ["actuator must be a section of keys"]),
    "a value for the study": ('study = 3\n[actuator]\nkind = "hybrid"\n', ["study must be a section of keys, [study]; got 3."]),
    "no kind": (swap('kind = "hybrid"', ""), ['must hold actuator.kind, one of "hybrid"', "; got none."]),
    "another kind": (swap('kind = "hybrid"', 'kind = "rotary"'), ['actuator.kind must be one of "hybrid"', '; got "rotary".']),
    "a name of two lines": (swap('"iPEHLA"', '"a\\nb"'), ["actuator.name must be one line of printable text"]),
    "a name with a null": (swap('"iPEHLA"', '"a\\u0000"'), ["null characters"]),
    "over-determined turns": (swap("turns = 584", 'turns = 584\nturns_density = "4 1/mm^2"'), ["over-determined", "exactly one of actuator.winding.turns, actuator.winding.turns_density"]),
    "over-determined yoke": (swap('"1 mm"', '"1 mm"\ninner_diameter = "25 mm"'), ["over-determined", "exactly two of", "D = D_i + 2 thickness"]),
    "under-determined yoke": (swap('thickness = "1 mm"', ""), ["under-determined", "got actuator.back_yoke.outer_diameter."]),
    "a missing key": (swap('outer_diameter = "8 mm"', ""), ["actuator.shaft.outer_diameter (shaft outer diameter) is missing."]),
    "yoke inside the winding": (swap('"1 mm"', '"2 mm"'), ["actuator.back_yoke.inner_diameter must not be below actuator.winding.outer_diameter 24.2 mm; got 23 mm."]),
    "magnets in the tube": (swap('"15.9 mm"', '"16.5 mm"'), ["actuator.cylinder.inner_diameter must exceed actuator.mover.outer_diameter 16.5 mm; got 16.1 mm."]),
    "shaft as wide as the magnets": (swap('"8 mm"', '"15.9 mm"'), ["actuator.mover.outer_diameter must exceed actuator.shaft.outer_diameter 15.9 mm"]),
    "no magnet left": (swap('"1.5 mm"', '"12 mm"'), ["actuator.mover.ring_width must be below actuator.mover.pole_pitch 12 mm; got 12 mm."]),
    "a short yoke": (swap('front_overhang = "3 mm"', 'length = "150 mm"'), ["actuator.back_yoke.length must cover the winding"]),
    "a thick magnet": (swap('ring_width = "1.5 mm"', 'magnet_thickness = "13 mm"'), ["actuator.mover.magnet_thickness must be at most"]),
    "a port through the piston": (swap('port_thread = { value = "M5"', 'port_diameter = { value = "100 mm"'), ["actuator.end_caps.port_diameter must"]),
    "a port as wide as the cap": (swap('port_thread = { value = "M5"', 'port_thread = { value = "G1/4"'), ["actuator.end_caps.flange_length must hold the port", "at least 14.157 mm; got 12 mm."]),
    "a port of no standard": (swap('port_thread = { value = "M5"', 'port_thread = { value = "M7"'), ["actuator.end_caps.port_thread must be one of M5, G1/8, G1/4"]),
    "two ports": (swap('port_thread = { value = "M5"', 'port_diameter = "5 mm"\nport_thread = { value = "M5"'), ["over-determined", "exactly one of actuator.end_caps.port_diameter, actuator.end_caps.port_thread"]),
    "crumbs of magnets": (swap('ring_width = "1.5 mm"', 'ring_width = "1.5 mm"\nlongest_magnet = "0.1 mm"'), ["actuator.mover.longest_magnet must leave at most 50 pieces of a magnet, at least 0.21 mm; got 0.1 mm."]),
    "an unknown material": (swap('"copper"', '"unobtainium"'), ["actuator.winding.material must name a conductor", 'got "unobtainium"']),
    "a magnet as cylinder": (swap('value = "aluminium 6061"', 'value = "N48"'), ["actuator.cylinder.material must name a material without magnetisation", "a permanent magnet"]),
    "a yoke of a nanometre": (swap('"1 mm"', '"1e-6 mm"').replace('"24.2 mm"', '"26 mm"'), ["actuator.back_yoke.outer_diameter must exceed actuator.back_yoke.inner_diameter 27 mm"]),
    "a magnet as wire": (swap('"copper"', '"N48"'), ["actuator.winding.material must name a conductor", "a permanent magnet"]),
    "B-H without points": (TEXT + IRON, ["materials.my iron must have exactly one of", "bh_file"]),
    "B-H falls in B": (TEXT + IRON + "bh = [[0.5, 100], [1, 200], [0.9, 300]]", ["materials.my iron.bh row 3 must exceed both B = 1 T, H = 200 A/m", "got B = 0.9 T, H = 300 A/m"]),
    "B-H falls in H": (TEXT + IRON + "bh = [[0.5, 100], [1, 200], [1.1, 150]]", ["materials.my iron.bh row 3", "got B = 1.1 T, H = 150 A/m"]),
    "B-H below vacuum": (TEXT + IRON + "bh = [[0.5, 100], [1, 200], [1.0001, 1e6]]", ["materials.my iron.bh row 3", "vacuum"]),
    "B-H with nan": (TEXT + IRON + "bh = [[0.5, 100], [nan, 200]]", ["materials.my iron.bh row 2 must be finite"]),
    "B-H with a unit": (TEXT + IRON + 'bh = [["1 T", 100], [2, 200]]', ["pairs of bare numbers", "row 1"]),
    "B-H file missing": (TEXT + IRON + 'bh_file = "none.csv"', ["materials.my iron.bh_file", "none.csv"]),
    "B-H file a folder": (TEXT + IRON + 'bh_file = "."', ["materials.my iron.bh_file"]),
    "material with a bare number": (TEXT + IRON.replace('"7.8 g/cm^3"', "7.8"), ["materials.my iron.density must be a density", "bare number 7.8"]),
    "material of no type": (TEXT + "\n[materials.x]\n", ["materials.x.type must be one of soft iron, magnet, conductor, structural"]),
    "empty": ("", ["must hold actuator.kind"]),
    "no TOML": ("hello world", ["spec.toml is not valid TOML", "line 1"]),
    "key twice": (swap('"1 mm"', '"1 mm"\nthickness = "1 mm"'), ["spec.toml is not valid TOML"]),
    "deep nesting": ("a = " + "[" * 4000 + "]" * 4000, ["nested at most"]),
    "deep keys": (swap("[study]", "[study." + "a." * 4000 + "b]\n[study]"), ["nested at most"]),
    "binary": (bytes(range(256)) * 9, ["spec.toml must be a UTF-8 text"]),
    "UTF-16": (TEXT.encode("utf-16"), ["spec.toml must be a UTF-8 text"]),
}  # fmt: skip


@pytest.mark.parametrize("case", SPECS)
def test_a_wrong_specification(case, run):
    text, words = SPECS[case]
    for command in (["check"], ["evaluate", "--json"], ["design", "-o", "out"]):
        status, _, err = run(command[0], "spec.toml", *command[1:], text=text)
        assert status == 2
        for word in words:
            assert word in err


ARGUMENTS = {
    "": ["COMMAND"],
    "fly": ["invalid choice: 'fly'"],
    "new": ["TEMPLATE"],
    "new nope": ["There is a template for ipehla, prehydra, rotlin", '; got "nope".'],
    "check": ["SPEC"],
    "check none.toml": ["none.toml cannot be read: No such file or directory."],
    "check .": [". cannot be read: Is a directory."],
    "check 'spec.toml' --set": ["--set"],
    "check spec.toml --set x": ['--set must be KEY=VALUE, such as actuator.mover.ring_width="2 mm"; got "x".'],
    "check spec.toml --set =3": ['got "=3".'],
    "check spec.toml --set actuator.turns=5": ["did you mean actuator.winding.turns?"],
    "check spec.toml --set actuator.kind.x=5": ["kind holds a value, not a section"],
    "check spec.toml --set study.variables.7.lower=1": ["study.variables.7.lower must number an item of a list of 2"],
    "check spec.toml --set study.variables.0.upper=": ["study.variables.0.upper is missing", "both a lower and an upper bound"],
    "check spec.toml --colour": ["unrecognized arguments: --colour"],
    "evaluate spec.toml --fidelity magic": ["'magic'", "network"],
    "evaluate spec.toml --gradient --set study.variables=": ["study.variables must hold a continuous quantity to take derivatives by; got none."],
    "sweep spec.toml --time-limit 0": ['must be a number of seconds above 0; got "0"'],
    "sweep spec.toml --time-limit soon": ['got "soon"'],
    "sweep spec.toml --workers 0": ['must be a whole number from 1 to 1024; got "0"'],
    "sweep spec.toml --workers two": ['got "two"'],
    "sweep spec.toml --set study.sweeps=": ["study.sweeps must be given"],
    "sweep spec.toml --set study.sweeps= -o out": ["study.sweeps must be given"],
    "optimize spec.toml --set study.objective=": ["study.objective must be given"],
    "optimize spec.toml --set study.variables=": ["study.variables must be given"],
    "design spec.toml": ["-o/--output"],
    "design spec.toml -o spec.toml": ["spec.toml must be a folder to write the results in; it is a file."],
    "design spec.toml -o spec.toml/out": ["spec.toml/out cannot be written: Not a directory."],
    "sweep spec.toml -o spec.toml": ["spec.toml must be a folder"],
    "optimize spec.toml -o .": [". must be empty or hold results of this specification; it holds other files, such as spec.toml"],
    "export spec.toml": ["-o/--output"],
    "export spec.toml -o spec.toml --format iges": ["'iges'"],
}  # fmt: skip


@pytest.mark.parametrize("line", ARGUMENTS)
def test_a_wrong_command(line, run):
    status, _, err = run(*line.replace("'", "").split())
    assert status == 2
    for word in ARGUMENTS[line]:
        assert word in err


def test_an_empty_name_is_not_the_working_folder(run):
    """Catches -o "$OUT" with OUT unset, which would fill the folder one stands in."""
    for arguments in (("design", "spec.toml", "-o", ""), ("check", ""), ("export", "spec.toml", "-o", "")):
        assert run(*arguments)[0] == 2


def test_a_folder_that_cannot_be_written(run, tmp_path):
    if os.geteuid() == 0:
        pytest.skip("root may write anywhere")
    tmp_path.joinpath("locked").mkdir(mode=0o500)
    assert "locked" in run("sweep", "spec.toml", "-o", "locked")[2]


def test_a_foreign_folder_is_left_alone(run):
    Path("out").mkdir()
    Path("out/thesis.docx").write_text("years of work")
    status, _, err = run("design", "spec.toml", "-o", "out")
    assert status == 2
    assert "such as thesis.docx" in err


@pytest.mark.parametrize(
    "arguments",
    [["check", "spec.toml", "--set", "actuator.shaft.length=3"], ["check", "none.toml"], ["fly"], []],
    ids=["value", "file", "command", "none"],
)
def test_the_real_program_answers_the_same(arguments, tmp_path):
    """Catches what only shows outside this process: output at exit, exit status, an import that fails."""
    (tmp_path / "spec.toml").write_text(TEXT)
    done = subprocess.run([sys.executable, "-m", "fluxbore", *arguments], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 2
    assert done.stdout == ""
    assert re.fullmatch(r"fluxbore: .*\.\n", done.stderr)


MORE = """
[study.pareto]
against = "minimise total_mass"
points = 5
method = "normal boundary intersection"

[study.production]
samples = 1000
checks = 10
seed = 2
yield = 0.95

[[study.production.tolerances]]
key = "actuator.mover.ring_width"
tolerance = "0.05 mm"
distribution = "uniform"

[[study.production.tolerances]]
key = "operating_point.magnet_temperature"
plus = "5 K"
minus = "2 K"
"""
"""What the example's study does not ask for."""


def mutated(draw) -> bytes:
    """The example, and what a study can ask for besides, with a few random faults in it."""
    lines = (TEXT + MORE).splitlines()
    atoms = [
        "nan", "-inf", "1e400", "0", "-1", "true", '""', '"x"', "[]", "[[]]", "{}", '"1 m m"', '"0 mm"', '"1e9 m"', "1979-05-27",
        '"start"', '["1 mm"]', '"é"', "'''\n\n'''", '"\\u0000"', str(2**63), '{ value = 1, assumed = "x" }', '"-5 mm"', '"N48"',
    ]  # fmt: skip
    for _ in range(draw(st.integers(1, 4))):
        i = draw(st.integers(0, len(lines) - 1))
        match draw(st.sampled_from(["delete", "double", "swap", "value", "value", "value", "number", "key"])):
            case "delete":
                del lines[i]
            case "double":
                lines.insert(i, lines[i])
            case "swap":
                j = draw(st.integers(0, len(lines) - 1))
                lines[i], lines[j] = lines[j], lines[i]
            case "value":
                lines[i] = f"{lines[i].split('=')[0]}= {draw(st.sampled_from(atoms))}"
            case "number":
                number = draw(st.sampled_from(["0", "-3", "1e6", "999", "0.001", "1e-300"]))
                lines[i] = re.sub(r'(?<=")[0-9.]+(?= )', number, lines[i])
            case "key":
                lines[i] = draw(st.text(max_size=8)) + lines[i]
    content = bytearray("\n".join(lines).encode(errors="replace"))
    if draw(st.integers(0, 9)) == 0:
        at = draw(st.integers(0, len(content) - 1))
        content[at : at + draw(st.integers(0, 3))] = draw(st.binary(max_size=4))
    return bytes(content)


@given(data=st.data())
@settings(max_examples=250, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_no_random_fault_ends_in_a_traceback(data, run):
    """Whatever is wrong with the file, the answer is a result, a sentence, or a reason in the JSON."""
    text = mutated(data.draw)
    status, out, _ = run("evaluate", "spec.toml", "--fidelity", "network", "--json", text=text)
    if status != 2:
        found = json.loads(out, parse_constant=lambda word: pytest.fail(f"{word} in the JSON"))
        assert (found["status"] == "ok") == (status == 0)
        assert bool(found["reasons"]) == (status == 3)
