"""`fluxbore solve`: the JSON contract, what the options do, and the same by `fluxbore.solve`."""

import json
import os
import subprocess
import sys
from dataclasses import replace
from functools import partial
from math import cos, pi, radians, sin
from pathlib import Path

import femm_models
import pytest

import fluxbore
from fluxbore.cli import main
from fluxbore.fem.factors import SingularMatrixError
from fluxbore.fem.femm_model import CircuitProperty
from fluxbore.fem.femm_writer import write_text
from fluxbore.fem.magnetostatics import Settings

CURRENT = f"circuit.{femm_models.SPULE}.current"
ROUGH = ("--accuracy", "20")


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """A folder with small models in it, and nothing else."""
    femm_models.write(tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def answer(capsys):
    """Solve a model roughly and print JSON, in which no NaN or Infinity may stand, and nothing on stderr."""

    def command(*arguments: str, status: int = 0) -> dict:
        assert main(["solve", *ROUGH, *arguments, "--json"]) == status
        out, err = capsys.readouterr()
        assert err == ""
        return json.loads(out, parse_constant=lambda word: pytest.fail(f"{word} in the JSON"))

    return command


def test_the_json_contract_axisymmetric(answer):
    """Catches a key that scripts rely on and that was renamed, or a number that became a text."""
    found = answer("axi.fem", "--group", "1", "--point", "1,2")
    contract = ["problem", "mesh", "convergence", "energy", "coenergy", "circuits", "groups", "points"]
    assert [key for key in found if key in contract] == contract
    assert set(found) - set(contract) == {"accuracy", "inductances", "warnings"}
    assert found["problem"] == {"type": "axisymmetric", "file": "axi.fem", "unit": "millimeters", "depth": None}
    assert set(found["mesh"]) == {"nodes", "elements", "unknowns"}
    assert all(isinstance(count, int) and count > 100 for count in found["mesh"].values())
    assert set(found["convergence"]) == {"status", "iterations", "residual"}
    assert found["convergence"]["status"] == "converged"
    assert isinstance(found["convergence"]["iterations"], int)
    assert 0 <= found["convergence"]["residual"] < 1e-8
    assert list(found["circuits"]) == [femm_models.SPULE]
    circuit = found["circuits"][femm_models.SPULE]
    assert set(circuit) == {"current", "flux_linkage"}
    assert circuit["current"] == 2.0
    assert list(found["groups"]) == ["1"]
    assert {"force", "torque", "force_error"} <= set(found["groups"]["1"])
    radial, axial = found["groups"]["1"]["force"]
    assert (radial, found["groups"]["1"]["torque"]) == (0.0, 0.0)
    assert axial > 0, "the plunger below the coil's middle is drawn up"
    (point,) = found["points"]
    assert set(point) == {"at", "A", "B", "H", "flux"}
    assert point["at"] == [1.0, 2.0]
    assert len(point["B"]) == len(point["H"]) == 2


def test_the_json_contract_planar(answer):
    found = answer("planar.fem", "--group", "1", "--group", "2", "--point", "7,0")
    assert found["problem"] == {"type": "planar", "file": "planar.fem", "unit": "millimeters", "depth": 0.05}
    assert set(found["circuits"]["coil"]) == {"current", "flux_linkage"}
    assert list(found["groups"]) == ["1", "2"]
    assert all(len(group["force"]) == 2 for group in found["groups"].values())
    assert set(found["points"][0]) == {"at", "A", "B", "H"}
    assert found["points"][0]["B"][1] < 0, "beside a magnet that points up the field points down"


def test_energy_is_half_of_linkage_times_current(answer):
    """Catches units: linear and without magnets, W = W' = λ I / 2."""
    found = answer("axi.fem")
    linkage = found["circuits"][femm_models.SPULE]["flux_linkage"]
    assert found["energy"] == pytest.approx(linkage * 2.0 / 2, rel=1e-6)
    assert found["coenergy"] == pytest.approx(found["energy"], rel=1e-6)
    inductance = found["inductances"][femm_models.SPULE][femm_models.SPULE]
    assert inductance == pytest.approx(linkage / 2.0, rel=1e-6)


def test_a_is_the_flux_over_a_full_turn(answer):
    """A is r·A_φ: 2π times it is what a line from the axis counts. An arc between the same ends counts the same."""
    straight, arc = "0,2:3,2", "0,2:3,2@40"
    found = answer("axi.fem", "--point", "3,2", "--line", straight, "--line", arc)
    point, lines = found["points"][0], found["lines"]
    assert point["flux"] == pytest.approx(2 * pi * point["A"])
    assert [line["line"] for line in lines] == [straight, arc]
    for line in lines:
        assert line["flux"] == pytest.approx(point["flux"], rel=0.02)
    assert lines[1]["length"] == pytest.approx(3e-3 / 2 / sin(radians(20)) * radians(40))


def test_planar_figures_are_for_the_depth(answer):
    """Catches forces and linkages per metre. The depth is a length: bare in the file's unit, or with its own."""
    base, deep, same = (
        answer("planar.fem", "--group", "2", *more) for more in ((), ("--set", "depth=150"), ("--set", "depth=5 cm"))
    )
    assert deep["energy"] == pytest.approx(3 * base["energy"], rel=1e-9)
    assert deep["circuits"]["coil"]["flux_linkage"] == pytest.approx(3 * base["circuits"]["coil"]["flux_linkage"])
    assert deep["points"] == []
    assert same["energy"] == pytest.approx(base["energy"], rel=1e-9)


@pytest.mark.parametrize("change", [f"{CURRENT}=4", f'circuit."{femm_models.SPULE}".current = 4', f"{CURRENT}=4000 mA"])
def test_a_changed_current(change, answer):
    """Catches a name that its own dot or space cuts short."""
    base = answer("axi.fem")["circuits"][femm_models.SPULE]
    found = answer("axi.fem", "--set", change)["circuits"][femm_models.SPULE]
    assert found["current"] == pytest.approx(4.0)
    assert found["flux_linkage"] == pytest.approx(2 * base["flux_linkage"], rel=1e-6)


def test_a_moved_group_is_pulled_the_other_way(answer):
    """The plunger 10 mm higher is its own mirror image."""
    below, above = (
        answer("axi.fem", "--group", "1", "--accuracy", "2", "--set", f"group.1.displacement.z={z}")["groups"]["1"]
        for z in (0, 10)
    )
    assert above["force"][1] == pytest.approx(-below["force"][1], rel=0.02)


def test_points_with_a_minus_and_points_twice(answer):
    """Catches `--point -5,3` taken for an option, and answers that no longer line up with their questions."""
    given = ("--point", "-6.5,3", "--point=-6.5,3", "--point", "6.5,-3", "--point", "-.5,0")
    found = answer("planar.fem", *given)["points"]
    assert [point["at"] for point in found] == [[-6.5, 3.0], [-6.5, 3.0], [6.5, -3.0], [-0.5, 0.0]]
    assert found[0] == found[1]
    assert found[0]["B"][1] == pytest.approx(found[2]["B"][1], rel=0.1)


def test_a_group_twice_is_one(answer):
    assert answer("axi.fem", "--group", "1", "--group", "1")["groups"].keys() == {"1"}


def test_circuits_of_one_name_are_told_apart(answer, folder):
    """Catches a coil that vanishes behind another of its name."""
    model = femm_models.planar()
    (label,) = (number for number, item in enumerate(model.labels) if item.turns < 0)
    labels = [replace(item, circuit=1) if number == label else item for number, item in enumerate(model.labels)]
    circuits = (CircuitProperty("coil", 2.0), CircuitProperty("coil", 5.0))
    (folder / "two.fem").write_text(write_text(replace(model, labels=tuple(labels), circuits=circuits)))
    found = answer("two.fem")
    assert {name: item["current"] for name, item in found["circuits"].items()} == {"coil": 2.0, "coil (2)": 5.0}
    mutual = found["inductances"]["coil"]["coil (2)"]
    assert mutual == pytest.approx(found["inductances"]["coil (2)"]["coil"])
    assert mutual < 0, "the two sides are wound against each other"


def test_a_name_does_not_steer_the_terminal(capsys, folder):
    model = replace(femm_models.planar(), circuits=(CircuitProperty("red \x1b[31m coil", 2.0),))
    (folder / "red.fem").write_text(write_text(model))
    assert main(["solve", "red.fem", *ROUGH]) == 0
    assert "circuit red \\x1b[31m coil: 2 A" in capsys.readouterr().out


def test_accuracy_is_asked_for_and_reported(answer):
    rough, fine = answer("axi.fem")["accuracy"], answer("axi.fem", "--accuracy", "0.05%")["accuracy"]
    assert (rough["asked"], fine["asked"]) == (0.2, pytest.approx(0.0005))
    assert fine["reached"]
    assert fine["estimate"] <= fine["asked"]
    assert fine["levels"][-1]["unknowns"] > rough["levels"][-1]["unknowns"]


def test_an_open_boundary_is_farther_than_a_wall(answer):
    """A wall of A = 0 presses the flux together: without it the inductance is larger."""
    walled, free = (answer("axi.fem", *more)["circuits"][femm_models.SPULE] for more in ((), ("--open-boundary",)))
    assert walled["flux_linkage"] < free["flux_linkage"] < 1.1 * walled["flux_linkage"]


def test_integrals_of_a_group_and_of_all(answer):
    found = answer("planar.fem", "--integrals", "--group", "1", "--group", "2")["integrals"]
    assert {name: found[name]["area"] for name in found} == pytest.approx({"1": 1e-4, "2": 8e-5})
    everything = answer("planar.fem", "--integrals")
    assert everything["integrals"]["all"]["area"] == pytest.approx(16e-4)
    assert everything["integrals"]["all"]["energy"] == pytest.approx(everything["energy"])


def test_files(answer, folder):
    """Catches a file that is not written, or that is and is not named, or anything left beside them."""
    before = {path.name for path in folder.iterdir()}
    names = {"field.vtu", "axi.ans", "Größe B.svg", "line.csv"}
    found = answer(
        "axi.fem", "--vtu", "field.vtu", "--ans", "axi.ans", "--svg", "Größe B.svg", "--line", "0,-20:0,20:11",
        "--csv", "line.csv",
    )  # fmt: skip
    assert set(found["files"]) == names
    assert {path.name for path in folder.iterdir()} - before == names
    rows = (folder / "line.csv").read_text().splitlines()
    assert len(rows) == 1 + 11
    assert rows[0].startswith("distance (mm),r (mm),z (mm)")
    assert "<svg" in (folder / "Größe B.svg").read_text()
    assert (folder / "field.vtu").read_bytes().startswith(b"<")
    assert "[Solution]" in (folder / "axi.ans").read_text(encoding="utf-8", errors="replace")


def test_text_for_people(capsys):
    arguments = ["--group", "1", "--point", "1,2", "--line", "0,0:4,0", "--integrals", "--csv", "a.csv"]
    assert main(["solve", "axi.fem", *ROUGH, *arguments]) == 0
    out = capsys.readouterr().out
    for words in (
        "axi.fem: axisymmetric",
        f"circuit {femm_models.SPULE}: 2 A, flux linkage",
        "group 1: axial",
        "(1, 2): B_r",
        "line of 0.004 m",
        "integrals of group 1",
        "wrote a.csv",
    ):
        assert words in out
    assert "None" not in out
    assert "nan" not in out


def test_no_convergence_is_a_status(answer, monkeypatch, capsys):
    """Catches figures of an unfinished iteration that are given as if they were a solution: zero, more or less zero."""
    good = answer("iron.fem", "--group", "1", "--point", "1,2")
    monkeypatch.setattr("fluxbore.fem.femm_solution.Settings", partial(Settings, max_iterations=1))
    found = answer("iron.fem", "--group", "1", "--point", "1,2", status=3)
    assert found["convergence"]["status"] != "converged"
    assert len(found["warnings"]) == 1
    assert found["inductances"] == {}
    assert (found["energy"], found["coenergy"]) == (None, None)
    assert found["circuits"][femm_models.SPULE] == {"current": 50.0, "flux_linkage": None}
    assert found["groups"]["1"] == dict.fromkeys(good["groups"]["1"])
    assert found["points"] == [{**dict.fromkeys(good["points"][0]), "at": [1.0, 2.0]}]
    assert main(["solve", "iron.fem", *ROUGH, "--group", "1", "--point", "1,2", "--line", "0,0:4,0"]) == 3
    out = capsys.readouterr().out.splitlines()
    assert out[1].startswith("Newton iteration limit in one step")
    assert out[2] == "no figures: the solution did not converge"
    assert out[3].startswith("warning: ")
    assert len(out) == 4


def unsolvable(*_):
    raise SingularMatrixError("on purpose")


@pytest.mark.parametrize(
    "place, missing, words",
    [
        ("fem.femm_solution.FemmSolution.inductances", "inductances", "There are no incremental inductances: "),
        ("fem.femm_solution.FemmSolution.force", "groups", "There is no force on group 1: "),
        ("fem.adapt._estimates", "accuracy", "The accuracy of 20 % could not be checked: "),
    ],
)
def test_figures_whose_equations_have_no_solution(place, missing, words, answer, monkeypatch, capsys):
    """Catches a traceback, and all figures given up for one."""
    monkeypatch.setattr(f"fluxbore.{place}", unsolvable)
    found = answer("axi.fem", "--group", "1")
    assert found["warnings"] == [f"{words}its linear equations could not be solved."]
    assert (found["inductances"] == {}) == (missing == "inductances")
    assert (found["groups"]["1"]["force"] is None) == (missing == "groups")
    assert (found["accuracy"]["estimate"] is None) == (missing == "accuracy")
    assert found["energy"] > 0
    assert main(["solve", "axi.fem", *ROUGH, "--group", "1"]) == 0
    assert ("group 1: no force\n" in capsys.readouterr().out) == (missing == "groups")


def test_equations_without_a_solution_are_one_sentence(monkeypatch, capsys):
    """Catches the traceback of a solver's own error."""
    monkeypatch.setattr("fluxbore.solving.solve_model", unsolvable)
    assert main(["solve", "axi.fem"]) == 2
    assert capsys.readouterr().err == "fluxbore: axi.fem: its equations could not be solved: on purpose.\n"


def test_figures_that_are_no_numbers_are_null(answer, monkeypatch):
    """Catches the fault of the program that a NaN is to the JSON writer."""
    from fluxbore.fem.femm_solution import FemmSolution

    monkeypatch.setattr(FemmSolution, "energies", (float("nan"), float("inf")))
    found = answer("axi.fem")
    assert (found["energy"], found["coenergy"]) == (None, None)


@pytest.mark.skipif(os.name != "posix", reason="needs a shell's redirections")
def test_stdout_is_json_alone_and_may_be_closed():
    """Catches a library that prints, in this process or the mesh's; and a traceback where nobody listens."""
    program = f"'{sys.executable}' -m fluxbore solve axi.fem --json --accuracy 20"
    done = subprocess.run(["/bin/sh", "-c", f"{program}; {program} >&-; echo $? >&2"], capture_output=True, text=True)
    assert json.loads(done.stdout)["convergence"]["status"] == "converged"
    assert done.stderr == "0\n"


def test_solving_loads_what_it_needs():
    """Catches seconds of start: netgen belongs to the child process, pictures and searches to others."""
    script = (
        "import sys\nfrom fluxbore.cli import main\nassert main(['solve', 'axi.fem', '--accuracy', '20']) == 0\n"
        "print(*{name.partition('.')[0] for name in sys.modules}, file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert set(done.stderr.split()) & {"netgen", "pyamg", "matplotlib", "nlopt", "cadquery", "pyvista"} == set()


def test_the_python_interface_is_the_command_line(answer):
    """Numbers will do for the values; a model that was read will do for its file; places may come twice."""
    from fluxbore.fem.femm_reader import read_model

    found = answer("axi.fem", "--set", f"{CURRENT}=3", "--group", "1", "--point", "1,2")
    for model in ("axi.fem", Path("axi.fem"), read_model("axi.fem")):
        solution = fluxbore.solve(model, groups=[1], points=[(1, 2), (1.0, 2.0)], accuracy=0.2, changes={CURRENT: 3})
        assert isinstance(solution, fluxbore.FemmSolution)
        assert solution.energies[0] == found["energy"]
        assert list(solution.force(1).value.force) == found["groups"]["1"]["force"]


@pytest.mark.parametrize("point", [(1.0,), (1.0, 2.0, 3.0), (float("nan"), 0.0)])
def test_a_point_that_is_none(point):
    with pytest.raises(fluxbore.FluxboreError, match=r"^A point must be two finite numbers; got \["):
        fluxbore.solve("axi.fem", points=[point])


def test_a_turned_magnet_turns_its_field(answer):
    """Catches degrees that are taken for radians, and formulas that are not read."""
    for angle, text in ((90, "90"), (30, "30"), (30, "0.5235987755982988 rad"), (180, "90 + 0*x + 90")):
        b = answer(
            "planar.fem", "--set", f"group.1.magnetisation={text}", "--set", "circuit.coil.current=0", "--point", "0,0"
        )
        along = b["points"][0]["B"]
        size = (along[0] ** 2 + along[1] ** 2) ** 0.5
        assert along == pytest.approx([size * cos(radians(angle)), size * sin(radians(angle))], abs=0.02 * size)
