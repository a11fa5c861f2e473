"""`fluxbore identify cylinder-friction`: Table I from the example, and one sentence for what cannot be identified."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from fluxbore.cli import main
from fluxbore.design.spec import load, loads

TOP = Path(__file__).parent.parent
DATA, SPEC = str(TOP / "examples" / "prehydra-friction.csv"), str(TOP / "examples" / "prehydra.toml")
TABLE_I = {"preload": 8.1, "stribeck_force": 15.3, "stribeck_decay": 118.5, "viscous_coefficient": 59.5}
F_C = 4.2e-6


def answer(capsys: pytest.CaptureFixture[str], *arguments: str) -> dict[str, object]:
    assert main(["identify", "cylinder-friction", *arguments, "--json"]) == 0
    found: dict[str, object] = json.loads(capsys.readouterr().out)
    return found


def refusal(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    assert main(["identify", "cylinder-friction", *arguments]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    return err


def test_example_gives_table_i(capsys: pytest.CaptureFixture[str]) -> None:
    """Each within its 95 % interval; f_C is the specification's unless it is asked for."""
    found = answer(capsys, DATA, "--spec", SPEC)
    assert found["rows"] == 60
    assert found["taken"] == {"pressure_coefficient": F_C}
    parameters = found["parameters"]
    assert isinstance(parameters, dict)
    assert set(parameters) == set(TABLE_I)
    for name, value in TABLE_I.items():
        assert parameters[name]["low"] < value < parameters[name]["high"]
        assert parameters[name]["given"] == value
    assert parameters["stribeck_decay"]["unit"] == "s/m"
    assert found["residual_deviation"] == pytest.approx(2.0, rel=0.25)


def test_pressure_is_told_by_two_pressures(capsys: pytest.CaptureFixture[str]) -> None:
    """With a specification where it is asked for, without one always; its lines fit the specification again."""
    asked = answer(capsys, DATA, "--spec", SPEC, "--free", "pressure_coefficient")
    alone = answer(capsys, DATA)
    for found in (asked, alone):
        parameters = found["parameters"]
        assert isinstance(parameters, dict)
        assert found["taken"] == {}
        assert parameters["pressure_coefficient"]["low"] < F_C < parameters["pressure_coefficient"]["high"]
        assert parameters["pressure_coefficient"]["unit"] == "N/Pa"
    assert alone["toml"] == ""
    lines = str(asked["toml"]).splitlines()
    assert lines[0] == "[actuator.friction]"
    spec = load(SPEC)
    for line in lines[1:]:
        leaf, _, rest = line.partition(" = ")
        changed = loads(_with(leaf, rest))
        assert changed.number(f"actuator.friction.{leaf}") != spec.number(f"actuator.friction.{leaf}")


def _with(leaf: str, value: str) -> str:
    """The example with another value of a friction parameter."""
    lines = Path(SPEC).read_text(encoding="utf-8").splitlines()
    start = lines.index(next(line for line in lines if line.startswith("[actuator.friction]")))
    place = next(i for i in range(start, len(lines)) if lines[i].startswith(f"{leaf} ="))
    lines[place] = f"{leaf} = {value}"
    return "\n".join(lines)


def test_what_data_do_not_tell_is_one_sentence(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    head = "velocity [mm/s], pressure [bar gauge], force [N]\n"
    one = tmp_path / "one.csv"
    one.write_text(head + "".join(f"{v}, 8.0, {11 + v / 20}\n" for v in range(10, 400, 20)), encoding="utf-8")
    assert "pressure_coefficient and preload: it has 1 pressure of the 2 needed" in refusal(capsys, str(one))
    few = tmp_path / "few.csv"
    few.write_text(head + "100, 8, 15\n200, 8, 20\n300, 24, 30\n", encoding="utf-8")
    assert "it has 3 speeds of the 4 needed" in refusal(capsys, str(few), "--spec", SPEC)
    still = tmp_path / "still.csv"
    still.write_text(head + "0, 8, 15\n200, 8, 20\n", encoding="utf-8")
    assert "line 2: velocity must be" in refusal(capsys, str(still), "--spec", SPEC)
    other = str(TOP / "examples" / "ipehla.toml")
    assert 'actuator.kind must be "hydrostatic"' in refusal(capsys, DATA, "--spec", other)
    assert "free must be one of pressure_coefficient" in refusal(capsys, DATA, "--spec", SPEC, "--free", "preload")
