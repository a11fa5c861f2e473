"""Wrong questions to `fluxbore solve`: one sentence, exit status 2, nothing on stdout, nothing written.

The catalogue holds one command line a case, and words that the sentence must contain (option or key, limit, value).
"""

# ruff: noqa: E501  one case a line, as long as it is

import os
import shlex
import subprocess
import sys
from pathlib import Path

import femm_models
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fluxbore.cli import main

CURRENT = f"circuit.{femm_models.SPULE}.current"
SWEEP = f"axi.fem --sweep '{CURRENT}=1:2:1'"


@pytest.fixture
def refusal(tmp_path, monkeypatch, capsys):
    """Run a command that must be refused in a folder of models; its sentence."""
    monkeypatch.chdir(tmp_path)
    femm_models.write(tmp_path)
    Path("text.fem").write_text("hello\n")
    Path("axi.csv").write_bytes(Path("axi.fem").read_bytes())
    Path("empty.fem").write_text("")
    Path("binary.fem").write_bytes(bytes(range(256)))
    Path("folder.fem").mkdir()
    Path("picture.png").mkdir()
    before = snapshot(tmp_path)

    def command(*arguments: str) -> str:
        status = main(["solve", *arguments])
        out, err = capsys.readouterr()
        assert "Traceback" not in err
        assert (status, out) == (2, "")
        assert err.startswith("fluxbore: ")
        assert err.endswith(".\n")
        assert err.count("\n") == 1
        assert err[:-1].isprintable()
        assert len(err) < 600
        assert snapshot(tmp_path) == before, "a refusal leaves nothing behind"
        return err

    return command


def snapshot(folder: Path) -> dict[str, bytes]:
    return {str(path): path.read_bytes() if path.is_file() else b"" for path in folder.rglob("*")}


ARGUMENTS = {
    "": ["MODEL"],
    "''": ["MODEL", "must name a file or folder"],
    "none.fem": ["none.fem", "No such file"],
    ".": ["a file is needed"],
    "folder.fem": ["folder.fem: a file is needed"],
    "axi.fem/x": ["x: it cannot be read: Not a directory."],
    "text.fem": ["text.fem", "[Format] of 4.0"],
    "empty.fem": ["empty.fem", "empty"],
    "binary.fem": ["binary.fem", "binary"],
    "axi.fem planar.fem": ["unrecognized arguments: planar.fem"],
    "axi.fem --jsn": ["--jsn"],
    "axi.fem --group": ["--group"],
    "axi.fem --group ''": ["--group", "the whole number of a group"],
    "axi.fem --group 1.5": ["--group", 'got "1.5"'],
    "axi.fem --group eins": ["--group", 'got "eins"'],
    "axi.fem --group ٣": ["--group", 'got "٣"'],
    "axi.fem --group 99999999999999999999": ["--group", "99999999999999999999"],
    "axi.fem --group 9": ["--group", "one of 0, 1, 2; got 9"],
    "axi.fem --group -3": ["--group", "one of 0, 1, 2; got -3"],
    "axi.fem --group 1 --group 7": ["--group", "got 7"],
    "axi.fem --point ''": ["--point", "X,Y"],
    "axi.fem --point 1": ["--point", 'X,Y; got "1"'],
    "axi.fem --point 1,2,3": ["--point", 'got "1,2,3"'],
    "axi.fem --point 1;2": ["--point", 'got "1;2"'],
    "axi.fem --point nan,0": ["--point", "two finite numbers"],
    "axi.fem --point 1e400,0": ["--point", "two finite numbers"],
    "axi.fem --point 100,0": ["--point must lie inside the model; (100, 0)"],
    "axi.fem --point -5,3": ["--point must lie inside the model; (-5, 3)"],
    "axi.fem --point 1e300,1e300": ["--point must lie inside the model"],
    "axi.fem --point 1,1 --point 0,50": ["--point must lie inside the model; (0, 50)"],
    "axi.fem --line ''": ["--line"],
    "axi.fem --line :": ["--line"],
    "axi.fem --line 1,2": ["--line", "one point is no line"],
    "axi.fem --line 1,2:1,2": ["--line", "no length"],
    "axi.fem --line 1,2:3,x": ["--line", '"x" is not a number'],
    "axi.fem --line 1,2:3,4:1": ["--line", "from 2 to 1000000"],
    "axi.fem --line 1,2@30:3,4": ["--line", "an arc is written at its end"],
    "axi.fem --line 1,2:3,4@360": ["--line", "whole circle"],
    "axi.fem --line 1,2:300,4": ["line must lie inside the model", "(300, 4)"],
    "axi.fem --line -1,2:3,4 --vtu a.vtu": ["line must lie inside the model", "(-1, 2)"],
    "axi.fem --accuracy": ["--accuracy"],
    "axi.fem --accuracy ''": ["--accuracy", "a percentage such as 0.2%"],
    "axi.fem --accuracy fine": ["--accuracy", 'got "fine"'],
    "axi.fem --accuracy 1%%": ["--accuracy", 'got "1%%"'],
    "axi.fem --accuracy 0": ["--accuracy must be from 0.0001% to 50%; got 0%"],
    "axi.fem --accuracy -1%": ["--accuracy must be from 0.0001% to 50%; got -1%"],
    "axi.fem --accuracy nan": ["--accuracy must be from", "got nan%"],
    "axi.fem --accuracy 1e400": ["--accuracy must be from", "got inf%"],
    "axi.fem --accuracy 1e-9%": ["--accuracy must be from", "got 1e-09%"],
    "axi.fem --accuracy 500%": ["--accuracy must be from", "got 500%"],
    "axi.fem --set": ["--set"],
    "axi.fem --set ''": ["KEY=VALUE", 'got ""'],
    "axi.fem --set =3": ["KEY=VALUE", 'got "=3"'],
    "axi.fem --set coil": ["KEY=VALUE", 'got "coil"'],
    f"axi.fem --set '{CURRENT}='": ["KEY=VALUE"],
    "axi.fem --set nonsense=1": ["nonsense must begin with circuit, group"],
    "axi.fem --set circuit.coil.current=3": ["circuit.coil.current", f'one of "{femm_models.SPULE}"'],
    f"axi.fem --set '{CURRENT}=3 kg'": [CURRENT, '"3 kg"'],
    f"axi.fem --set '{CURRENT}=nan'": [CURRENT, '"nan"'],
    f"axi.fem --set 'circuit.{femm_models.SPULE}.currant=3'": ["must end in one of current"],
    "axi.fem --set depth=1": ["depth"],
    "axi.fem --set group.1.displacement.x=1": ["group.1.displacement.x", "displacement.z"],
    "axi.fem --set group.7.displacement.z=1": ["group.7.displacement.z", "one of 0, 1, 2"],
    "axi.fem --set group.1.displacement.z=45": ["axi.fem: ", "cross or touch at (5, 39.6863) mm"],
    "planar.fem --set group.1.displacement.x=4": ["planar.fem: ", "no block label"],
    "planar.fem --set 'boundary.A=0.a0=1'": ["boundary.A", '"A=0"'],
    "planar.fem --set group.1.magnetisation=x+nonsense": ["group.1.magnetisation", '"nonsense" is not known'],
    "planar.fem --set material.Magnet.mu_x=0": ["material.Magnet.mu_x must be at least 1e-06"],
    "axi.fem --vtu": ["--vtu"],
    "axi.fem --vtu ''": ["--vtu", "must name a file"],
    "axi.fem --vtu a.txt": ["--vtu must name a .vtu file", '"a.txt"'],
    "axi.fem --png .png": ["--png must name a .png file"],
    "axi.fem --svg a.png": ["--svg must name a .svg file"],
    "axi.fem --ans axi.fem": ["--ans must name a .ans file"],
    "axi.fem --ans none/a.ans": ["--ans", "a folder that exists", "none/a.ans"],
    "axi.fem --png picture.png": ["--png must name a file", "is a folder"],
    "axi.fem --vtu a.vtu --svg none/a.svg": ["--svg", "a folder that exists"],
    "axi.fem --csv a.csv": ["--csv must come with one --line; got 0"],
    "axi.fem --csv a.csv --line 0,0:1,0 --line 0,0:2,0": ["--csv must come with one --line; got 2"],
    "axi.csv --csv ./axi.csv --line 0,0:1,0": ["--csv must name another file than the model"],
    "axi.fem --full": ["--full must come with --png or --svg"],
    "axi.fem -o out": ["-o must come with --sweep"],
    "axi.fem --force": ["--force must come with --sweep"],
    "axi.fem --workers 2": ["--workers must come with --sweep"],
    f"{SWEEP} --workers 0 -o out": ["--workers", "from 1 to 1024"],
    f"{SWEEP} --workers two -o out": ["--workers", 'got "two"'],
    SWEEP: ["--sweep must come with a folder for its rows, -o DIR"],
    f"{SWEEP} -o ''": ["-o/--output", "must name a file or folder"],
    f"{SWEEP} -o axi.fem": ["axi.fem must be a folder"],
    f"{SWEEP} -o axi.fem/out": ["axi.fem/out cannot be written: Not a directory"],
    f"{SWEEP} -o .": [". must be empty or hold rows of this very sweep", "other files, such as axi.csv", "--force"],
    f"{SWEEP} -o out --png a.png": ["--sweep must come without --png"],
    f"{SWEEP} -o out --line 0,0:1,0": ["--sweep must come without --line"],
    f"{SWEEP} -o out --integrals": ["--sweep must come without --integrals"],
    f"{SWEEP} -o out --accuracy 500": ["--accuracy must be from"],
    f"{SWEEP} -o out --group 9": ["--group", "got 9"],
    f"{SWEEP} -o out --sweep '{CURRENT}=1:2:1'": [CURRENT, "given twice"],
    f"{SWEEP} -o out --set '{CURRENT}=1'": [CURRENT, "by --sweep or by --set", "given twice"],
    "axi.fem -o out --sweep": ["--sweep"],
    "axi.fem -o out --sweep ''": ["KEY=VALUE"],
    "axi.fem -o out --sweep group.1.displacement.z": ["KEY=VALUE"],
    "axi.fem -o out --sweep nonsense=1:2:1": ["nonsense must begin with"],
    "axi.fem -o out --sweep group.1.displacement.z=1:2": ["FIRST:LAST:STEP", '"1:2"'],
    "axi.fem -o out --sweep group.1.displacement.z=1:2:0": ["a step that leads from first to last"],
    "axi.fem -o out --sweep group.1.displacement.z=1:2:-1": ["a step that leads from first to last"],
    "axi.fem -o out --sweep group.1.displacement.z=a:b:c": ["FIRST:LAST:STEP"],
    "axi.fem -o out --sweep group.1.displacement.z=1,,2": ["a value between commas"],
    "axi.fem -o out --sweep group.1.displacement.z=0:1e9:1": ["at most 10000 values"],
    f"axi.fem -o out --sweep group.1.displacement.z=0:1:0.001 --sweep '{CURRENT}=0:1:0.001'": ["--sweep must give at most 100000 rows; got 1002001"],
}  # fmt: skip


@pytest.mark.parametrize("line", ARGUMENTS)
def test_a_wrong_question(line, refusal):
    sentence = refusal(*shlex.split(line), *(["--json"] if line else []))
    for words in ARGUMENTS[line]:
        assert words in sentence


def test_a_folder_that_takes_no_files(refusal):
    """Catches minutes of work that end with a file that cannot be written."""
    if not Path("/proc/self").is_dir():
        pytest.skip("needs a folder in which nobody may write")
    assert "cannot be written: " in refusal("axi.fem", "--vtu", "/proc/self/a.vtu")
    assert "cannot be written: " in refusal(*shlex.split(SWEEP), "-o", "/proc/self/out")


TOKENS = st.one_of(
    st.sampled_from(
        ["--group", "--point", "--line", "--set", "--sweep", "--accuracy", "--open-boundary", "--integrals", "--vtu"]
        + [
            "--png",
            "--csv",
            "--full",
            "-o",
            "--workers",
            "--force",
            "--json",
            "--quiet",
            "-5,3",
            "1",
            "-1",
            "0,0:1,1",
            "a=b",
            "--",
            "-",
        ]
    ),
    st.text(st.characters(exclude_characters="\0", exclude_categories=("Cs",)), max_size=12),
)


@given(st.lists(TOKENS, max_size=6))
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=200)
def test_any_question_about_nothing_is_refused(capsys, tmp_path_factory, arguments):
    """Catches a traceback for whatever can be typed; the model does not exist, so that nothing is solved."""
    status = main(
        ["solve", *arguments, "--", str(tmp_path_factory.getbasetemp() / "none.fem")]
        if "--" not in arguments
        else ["solve", *arguments]
    )
    out, err = capsys.readouterr()
    if status == 0:
        assert out.startswith("usage: ")
        return
    assert (status, out) == (2, "")
    assert err.startswith("fluxbore: ")
    assert err.count("\n") == 1
    assert err[:-1].isprintable()


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
def test_a_full_disk_is_one_sentence(tmp_path):
    femm_models.write(tmp_path)
    program = [sys.executable, "-m", "fluxbore", "solve", str(tmp_path / "axi.fem"), "--json", "--accuracy", "20"]
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(program, stdout=full, stderr=subprocess.PIPE, text=True, env=os.environ)
    assert (done.returncode, done.stderr) == (2, "fluxbore: cannot be read or written: No space left on device.\n")
