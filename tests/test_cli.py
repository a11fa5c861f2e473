"""The command line: what it prints, how it ends, what it loads, and results that are not valid."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from fluxbore.cli import main
from fluxbore.design.performance import FIGURES
from fluxbore.design.spec_file import template

HEAVY = (
    "numpy",
    "scipy",
    "shapely",
    "netgen",
    "pyamg",
    "cadquery",
    "OCP",
    "matplotlib",
    "pyvista",
    "vtk",
    "nlopt",
    "jinja2",
)
QUICK = ("--set", "operating_point.positions=1")
DIVERGE = (*QUICK, "--set", "solver.max_iterations=1")


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """An empty folder with the paper's specification in it; one BLAS thread, as the program itself would set it."""
    (tmp_path / "spec.toml").write_text(template("ipehla"))
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def answer(capsys):
    """Run a command that prints JSON: its status and the parsed object, in which no NaN or Infinity may stand."""

    def command(*arguments: str) -> tuple[int, dict]:
        status = main([*arguments, "--json"])
        out, _ = capsys.readouterr()
        return status, json.loads(out, parse_constant=lambda word: pytest.fail(f"{word} in the JSON"))

    return command


def loaded(code: str) -> set[str]:
    """Which heavy packages a fresh interpreter has loaded after this code."""
    script = f"import sys\n{code}\nprint(*{{name.partition('.')[0] for name in sys.modules}}, file=sys.stderr)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    return set(done.stderr.split()) & set(HEAVY)


def run(line: str) -> str:
    return f"import contextlib\nfrom fluxbore.cli import main\nassert main({line.split()}) == 0"


def test_importing_fluxbore_loads_nothing_heavy():
    """Catches an import at the top of a module that every start pays for; --help is promised within 0.3 s."""
    assert loaded("import fluxbore") == set()
    assert loaded("import fluxbore\nfluxbore.Spec, fluxbore.FluxboreError, fluxbore.Performance") == set()


@pytest.mark.parametrize(
    "line", ["--help", "evaluate --help", "solve --help", "design --help", "--version", "new ipehla", "schema"]
)
def test_help_loads_nothing_heavy(line):
    assert loaded(run(line)) == set()


def test_the_network_loads_numpy_at_most():
    """Catches scipy or cadquery on the way to an answer that is promised within 0.8 s."""
    assert loaded(run("evaluate spec.toml --fidelity network --json")) <= {"numpy"}
    assert loaded(run("check spec.toml")) <= {"numpy"}


def test_new_prints_a_specification_that_checks(capsys):
    assert main(["new", "ipehla"]) == 0
    out = capsys.readouterr().out
    assert out == template("ipehla")
    Path("my.toml").write_text(out)
    assert main(["check", "my.toml"]) == 0
    assert "The specification is sound." in capsys.readouterr().out


def test_schema_prints_json(capsys):
    assert main(["schema"]) == 0
    assert json.loads(capsys.readouterr().out)["title"] == "fluxbore specification"


@pytest.mark.parametrize("line", ["--help", "--version", "check --help", "optimize --help"])
def test_asking_for_help_is_no_error(line, capsys):
    assert main(line.split()) == 0
    out, err = capsys.readouterr()
    assert out
    assert err == ""


def test_check_lists_given_derived_and_assumed(answer, capsys):
    status, found = answer("check", "spec.toml")
    assert status == 0
    assert found["status"] == "ok"
    assert found["values"]["actuator.back_yoke.length"] == pytest.approx(0.205)
    assert "actuator.mover.magnet_permeability" in found["assumed"]
    assert found["study"]["variables"] == ["actuator.mover.ring_width", "actuator.back_yoke.thickness"]
    assert list(found["study"]["sweeps"].values()) == [24, 9]
    assert main(["check", "spec.toml"]) == 0
    out = capsys.readouterr().out
    assert "actuator.back_yoke.length" in out
    assert "205 mm  (follows)" in out
    assert "16 mm  (assumed)" in out


def test_the_network_prints_every_name_and_null_where_it_knows_nothing(answer):
    """Equation (2): an upper bound, from 5 to 40 % above the 8.67 N/A of the finite elements."""
    status, found = answer("evaluate", "spec.toml", "--fidelity", "network")
    assert status == 0
    performance = found["performance"]
    assert list(performance) == list(FIGURES)
    assert performance["stray_field"] is None
    assert 1.05 * 8.67 < performance["force_constant"] < 1.40 * 8.67
    assert performance["winding_resistance"] == pytest.approx(5.55, abs=0.005)
    assert performance["pneumatic_force_advance"] == pytest.approx(121, abs=0.5)
    assert performance["pneumatic_force_retract"] == pytest.approx(90, abs=0.5)


def test_finite_elements_are_the_default(answer):
    """One position at the window's middle instead of eight: within 1 % of the mean over the window."""
    status, found = answer("evaluate", "spec.toml", *QUICK)
    assert status == 0
    assert found["fidelity"] == "fem"
    assert found["performance"]["force_constant"] == pytest.approx(8.67, rel=0.01)
    assert found["performance"]["force_constant_linkage"] == pytest.approx(
        found["performance"]["force_constant"], rel=0.005
    )
    assert found["performance"]["stray_field"] > 0
    assert [position["position"] for position in found["positions"]] == pytest.approx([0.0275])


def test_tables_for_people(capsys):
    assert main(["evaluate", "spec.toml", "--fidelity", "network"]) == 0
    out = capsys.readouterr().out
    assert re.search(r"^ *winding_resistance +5\.5498 ohm$", out, re.MULTILINE)
    assert "upper bound" in out
    assert "None" not in out


def test_no_convergence_is_said_and_printed(answer, capsys):
    status, found = answer("evaluate", "spec.toml", *DIVERGE)
    assert status == 3
    assert found["status"] == "not converged"
    assert "z = 27.5 mm" in found["reasons"][0]
    assert set(found["performance"].values()) == {None}
    assert main(["evaluate", "spec.toml", *DIVERGE]) == 3
    assert capsys.readouterr().out.startswith("not converged: At z = 27.5 mm: ")


def test_a_sweep_without_one_valid_design(answer):
    axes = '[{key = "actuator.back_yoke.thickness", values = ["1 mm", "0.5 mm"]}]'
    status, found = answer(
        "sweep", "spec.toml", *DIVERGE, "--set", "study.sweeps.1=", "--set", f"study.sweeps.0.axes={axes}", "-o", "out"
    )
    assert status == 3
    assert found["status"] != "ok"
    assert found["reasons"]
    assert [row["status"] for row in found["sweeps"][0]["rows"]] == ["not converged"] * 2
    assert found["sweeps"][0]["best"] is None
    assert Path("out/results.csv").read_text().count("not converged") == 2


def test_a_sweep_goes_on_past_a_design_that_cannot_be_built(answer):
    axes = '[{key = "actuator.mover.ring_width", values = ["1 mm", "12 mm", "2 mm"]}]'
    status, found = answer(
        "sweep",
        "spec.toml",
        "--fidelity",
        "network",
        "--set",
        "study.sweeps.1=",
        "--set",
        f"study.sweeps.0.axes={axes}",
    )
    assert status == 0
    rows = found["sweeps"][0]["rows"]
    assert [row["status"] for row in rows] == ["ok", "invalid", "ok"]
    assert "actuator.mover.ring_width must be below actuator.mover.pole_pitch 12 mm; got 12 mm." in rows[1]["reasons"]


def test_no_feasible_design(answer):
    """A stray field of 1 uT is out of reach; whatever was computed is kept, and no design.toml is left."""
    impossible = ("--set", "study.constraints.0.upper=1 uT", "--set", "study.search.max_evaluations=2")
    status, found = answer("optimize", "spec.toml", *QUICK, *impossible, "-o", "out", "--workers", "1")
    assert status == 3
    assert found["status"] == "no feasible design"
    assert any("stray_field" in reason for reason in found["reasons"])
    assert found["chosen"] is None
    assert found["start"]["feasible"] is False
    assert Path("out/results.csv").exists()
    assert not Path("out/design.toml").exists()


def test_a_search_leaves_a_design_that_evaluates_to_the_same_figures(answer):
    few = ("--set", "study.search.max_evaluations=2", "--workers", "1")
    status, found = answer("optimize", "spec.toml", *QUICK, *few, "-o", "out")
    assert status == 0
    again, figures = answer("evaluate", "out/design.toml")
    assert again == 0
    for name, value in found["chosen"]["performance"].items():
        again_value = figures["performance"][name]
        assert again_value == (None if value is None else pytest.approx(value, rel=1e-9)), name


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
def test_a_full_disk_is_one_sentence():
    """Catches the traceback of an OSError that only shows when Python empties its buffers."""
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "fluxbore", "schema"], stdout=full, stderr=subprocess.PIPE, text=True
        )
    assert done.returncode == 2
    assert done.stderr == "fluxbore: cannot be read or written: No space left on device.\n"


@pytest.mark.skipif(os.name != "posix", reason="needs a shell's pipes")
def test_a_reader_that_leaves_early_is_no_error():
    line = f"'{sys.executable}' -m fluxbore schema | head -c 1; '{sys.executable}' -m fluxbore new ipehla >&-"
    done = subprocess.run(["/bin/sh", "-c", line], capture_output=True, text=True)
    assert done.stdout == "{"
    assert done.stderr == ""


def test_letters_that_the_terminal_lacks_are_escaped():
    """Catches a UnicodeEncodeError on a terminal that knows ASCII alone."""
    environment = os.environ | {"PYTHONIOENCODING": "ascii"}
    command = [sys.executable, "-m", "fluxbore", "check", "spec.toml", "--set", "actuator.name=Ö 日本"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert done.returncode == 0
    assert "\\xd6 \\u65e5\\u672c" in done.stdout
