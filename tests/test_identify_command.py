"""`fluxbore identify`: its answers, its page, and one sentence for whatever cannot be identified."""

from __future__ import annotations

import json
import re
import shlex
import shutil
from pathlib import Path

import pytest

import fluxbore
from fluxbore.cli import main
from fluxbore.design.errors import SpecError

TOP = Path(__file__).parent.parent
DATA = "examples/ipehla-friction.csv"
TABLE_IV = {
    "static_coefficient": 0.182,
    "coulomb_coefficient": 0.127,
    "contact_force": 20.5,
    "stribeck_speed": 0.00132,
}
HEADER = "velocity [mm/s],pressure [MPa gauge],force [N]"


@pytest.fixture(autouse=True)
def newcomer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the examples."""
    shutil.copytree(TOP / "examples", tmp_path / "examples")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def rows(text: str) -> list[list[float]]:
    """The example's numbers."""
    lines = [line for line in text.splitlines() if line and not line.startswith(("#", "velocity"))]
    return [[float(cell) for cell in line.split(",")] for line in lines]


def table(kept: list[list[float]]) -> str:
    return "\n".join([HEADER, *(",".join(map(repr, row)) for row in kept)]) + "\n"


def refusal(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    """The sentence, and what every refusal promises."""
    assert main(["identify", *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("fluxbore: ")
    assert err.endswith(".\n")
    assert err.count("\n") == 1
    assert "Traceback" not in err
    return err


def test_the_example_gives_table_iv_within_five_per_cent(capsys: pytest.CaptureFixture[str]) -> None:
    """And 95 % intervals that hold it; the example's seed is one of those."""
    assert main(["identify", "friction", DATA, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["rows"] == 96
    assert found["specification"] is False
    for name, value in TABLE_IV.items():
        estimate = found["parameters"][name]
        assert estimate["value"] == pytest.approx(value, rel=0.05)
        assert estimate["low"] < value < estimate["high"]
        assert estimate["given"] == pytest.approx(value)
        assert estimate["difference"] == pytest.approx(estimate["value"] - value)
        assert estimate["bound"] == ""
    assert found["parameters"]["contact_force"]["unit"] == "N"
    assert found["parameters"]["stribeck_speed"]["unit"] == "m/s"
    product = found["parameters"]["coulomb_coefficient"]["value"] * found["parameters"]["contact_force"]["value"]
    assert found["derived"]["coulomb_force"]["value"] == pytest.approx(product)
    assert {"contact_force", "coulomb_coefficient"} in [set(pair["parameters"]) for pair in found["correlated"]]
    assert 0.07 < found["residual_deviation"] < 0.13


def test_the_page_s_commands_give_what_it_quotes(capsys: pytest.CaptureFixture[str]) -> None:
    page = (TOP / "docs" / "identification.md").read_text(encoding="utf-8")
    found = dict(re.findall(r"^```(\w*)\n(.*?)^```$", page, re.MULTILINE | re.DOTALL))
    assert main(shlex.split(found[""])[1:]) == 0
    assert capsys.readouterr().out == found["text"]
    exec(compile(found["python"], "identification.md", "exec"), {})
    low, high = map(float, capsys.readouterr().out.split())
    assert low < 0.00132 < high
    Path("bench.csv").write_text(found["csv"], encoding="utf-8")
    assert "bench.csv does not identify stribeck_speed and static" in refusal(capsys, "friction", "bench.csv")
    slowest = rows(Path(DATA).read_text())[:16]
    Path("two-speeds.csv").write_text(table(slowest))
    assert refusal(capsys, "friction", "two-speeds.csv").strip() in " ".join(page.replace("\n> ", " ").split())


def test_the_lines_for_the_specification_can_be_pasted(capsys: pytest.CaptureFixture[str]) -> None:
    """In place of those that are there; friction moves along, and the reason is kept as a note."""
    assert main(["identify", "friction", DATA, "--json", "--free", "viscous_coefficient"]) == 0
    found = json.loads(capsys.readouterr().out)
    lines = found["toml"].splitlines()[1:]
    names = [line.partition(" = ")[0] for line in lines]
    assert names == [*TABLE_IV, "viscous_coefficient"]
    section, old = "", []
    for line in (TOP / "examples" / "ipehla.toml").read_text(encoding="utf-8").splitlines():
        section = line.partition("]")[0] + "]" if line.startswith("[") else section
        if not (section == "[actuator.seal]" and line.partition(" = ")[0] in names):
            old.append(line)
    text, pasted = re.subn(r"^\[actuator\.seal\].*$", lambda _: found["toml"], "\n".join(old), flags=re.MULTILINE)
    assert pasted == 1
    Path("mine.toml").write_text(text, encoding="utf-8")
    spec = fluxbore.load("mine.toml")
    for name in names:
        assert spec.number(f"actuator.seal.{name}") == pytest.approx(found["parameters"][name]["value"], rel=1e-3)
    notes = {note.key: note for note in spec.notes}
    assert notes["actuator.seal.contact_force"].status == "calibrated"
    assert "ipehla-friction.csv, 95 % interval" in notes["actuator.seal.contact_force"].reason


def test_another_fin_has_another_area_and_other_coefficients(capsys: pytest.CaptureFixture[str]) -> None:
    """The products that were measured stay: mu_C s, and mu_C F_0."""
    answers = []
    for length in ("1.8 mm", "3 mm"):
        change = f'actuator.piston.fin_length="{length}"'
        assert main(["identify", "friction", DATA, "--json", "--spec", "examples/ipehla.toml", "--set", change]) == 0
        answers.append(json.loads(capsys.readouterr().out))
    short, long = answers
    assert long["taken"]["contact area"] > 1.5 * short["taken"]["contact area"]
    products = [
        (each["parameters"]["coulomb_coefficient"]["value"] * each["taken"]["contact area"], each["derived"])
        for each in answers
    ]
    assert products[0][0] == pytest.approx(products[1][0], rel=1e-5)
    assert products[0][1]["coulomb_force"]["value"] == pytest.approx(products[1][1]["coulomb_force"]["value"], rel=1e-5)


def test_a_higher_level_is_a_wider_interval(capsys: pytest.CaptureFixture[str]) -> None:
    widths = []
    for level in ("0.8", "95%", "0.99"):
        assert main(["identify", "friction", DATA, "--json", "--level", level]) == 0
        estimate = json.loads(capsys.readouterr().out)["parameters"]["stribeck_speed"]
        widths.append(estimate["high"] - estimate["low"])
    assert widths[0] < widths[1] < widths[2]


def test_a_parameter_at_its_bound_is_said_to_be(capsys: pytest.CaptureFixture[str]) -> None:
    """Friction that falls with speed above the Stribeck speed would need a viscous part below zero."""
    kept = [[v, P, f - 0.05 * (v - 4)] for v, P, f in rows(Path(DATA).read_text())]
    Path("falling.csv").write_text(table(kept))
    assert main(["identify", "friction", "falling.csv", "--free", "viscous_coefficient"]) == 0
    line = next(line for line in capsys.readouterr().out.splitlines() if line.startswith("viscous_coefficient"))
    assert re.search(r" 0 N s/m +0 to [\d.]+ .*at its lower bound$", line)


def test_samples_in_runs_are_averaged_over_the_window(capsys: pytest.CaptureFixture[str]) -> None:
    """The paper's records, of a law that is known: 0.2 and 0.1 of 30 N + s P, v_s 2 mm/s."""
    from math import exp

    area = fluxbore.load("examples/ipehla.toml").actuator
    from fluxbore.design.seal import contact_area

    s, lines, run = contact_area(area), ["run,position [mm],velocity [mm/s],pressure [kPa gauge],force [N]"], 0
    for speed in (1.0, 2.0, 3.0, 5.0, 8.0):
        for kPa in (0.0, 250.0, 500.0):
            run += 1
            friction = (0.1 + 0.1 * exp(-((speed / 2) ** 2))) * (s * kPa * 1e3 + 30)
            for step in range(22):
                z, v = (-0.05 * step, -speed) if step < 11 else (-0.5 + 0.05 * (step - 11), speed)
                shown = friction * (1 if v > 0 else -1) + (9.0 if z > -0.2 else 0.0)
                lines.append(f"{run},{z!r},{v!r},{kPa!r},{0.2 * kPa - shown!r}")
    Path("records.csv").write_text("\n".join(lines))
    assert main(["identify", "friction", "records.csv", "--json", "--spec", "examples/ipehla.toml"]) == 0
    found = json.loads(capsys.readouterr().out)["parameters"]
    values = [found[name]["value"] for name in TABLE_IV]
    assert values == pytest.approx([0.2, 0.1, 30.0, 2e-3], rel=1e-6)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (f"{HEADER}\n1,0.1,nan\n", 'bad.csv, line 2: force must hold finite numbers; got "nan"'),
        (f"{HEADER}\n1,-0.1,3\n", "bad.csv, line 2: pressure must be 0 MPa gauge or above"),
        (f"{HEADER}\n0,0.1,3\n", "bad.csv, line 2: velocity must be 1e-09 m/s or more in size"),
        (f"{HEADER}\n", "bad.csv must have 1 row or more below its header; got 0"),
        ("velocity,force\n1,2\n", 'the column pressure must be there; got "velocity", "force"'),
        ("", "bad.csv must begin with a header"),
        (
            f"{HEADER}\n1,0,3\n2,0.1,3\n3,0.2,3\n",
            "bad.csv must have more rows than the 4 parameters of the model; got 3",
        ),
        (f"{HEADER}\n1,0,3\n2,0,3\n4,0,2\n5,0,3\n6,0,2\n", "does not identify contact_force, coulomb_coefficient"),
        (f"{HEADER}\n1,0,3\n1,0.1,3\n1,0.2,3\n1,0.3,4\n1,0.4,4\n", "does not identify stribeck_speed and static_co"),
        (f"{HEADER}\n1,0,-3\n2,0.1,-3\n3,0.2,-3\n4,0.2,-3\n", "force must be friction, which is positive at positive"),
    ],
)
def test_files_that_tell_nothing(capsys: pytest.CaptureFixture[str], text: str, words: str) -> None:
    Path("bad.csv").write_text(text)
    assert words in refusal(capsys, "friction", "bad.csv")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("friction", "none.csv"), "none.csv cannot be read: No such file or directory"),
        (("friction", "examples"), "examples cannot be read: Is a directory"),
        (("magnet", DATA), "model must be one of friction, magnetic-spring"),
        (("friction", DATA, "--free", "F_0"), 'free must be one of viscous_coefficient for friction; got "F_0"'),
        (("friction", DATA, "--level", "1"), "level must be from 0.5 to 0.9999; got 1"),
        (("friction", DATA, "--level", "high"), 'argument --level: must be a number such as 0.95; got "high"'),
        (("friction", DATA, "--level", "nan"), "level must be from 0.5 to 0.9999; got nan"),
        (("friction", DATA, "--set", "a.b=1"), '--set must come with --spec; got "a.b=1" alone'),
        (("friction", DATA, "--spec", "examples/fabry.toml"), 'actuator.kind must be "hybrid" to identify friction'),
        (("friction", DATA, "--spec", "none.toml"), "none.toml"),
    ],
)
def test_what_cannot_be_asked(capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], words: str) -> None:
    assert words in refusal(capsys, *arguments)


def test_the_python_interface_raises_the_same() -> None:
    with pytest.raises(SpecError, match="model must be one of friction"):
        fluxbore.identify("magnet", DATA)
    found = fluxbore.identify("friction", DATA)
    assert isinstance(found, fluxbore.Identification)
    assert found.found.degrees_of_freedom == 92
