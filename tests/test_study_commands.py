"""The commands on whole studies, with coils whose field is exact and costs milliseconds."""

import csv
import json
import re
from pathlib import Path

import pytest
from coil_study import RADIUS, SPEC, THICKNESS

import fluxbore
from fluxbore.cli import main

RUN = ("--workers", "1", "--quiet")


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    (tmp_path / "spec.toml").write_text(SPEC)
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def answer(capsys):
    def command(*arguments: str) -> tuple[int, dict]:
        status = main([*arguments, *RUN, "--json"])
        return status, json.loads(capsys.readouterr().out)

    return command


def rows(path: str) -> list[dict[str, str]]:
    with Path(path).open(newline="") as file:
        return list(csv.DictReader(file))


def test_a_sweep_leaves_both_tables(answer):
    import pyarrow.parquet

    status, _ = answer("sweep", "spec.toml", "-o", "out", "--time-limit", "60")
    assert status == 0
    table = pyarrow.parquet.read_table("out/results.parquet").to_pylist()
    assert [row[RADIUS] for row in table] == [2.8, 3.0, 3.2]
    for text, typed in zip(rows("out/results.csv"), table, strict=True):
        assert float(text["central_flux_density"]) == typed["central_flux_density"]


def test_a_sweep_after_a_search_keeps_the_search_s_rows(answer):
    """The same command again is the resumption; it must not take rows from the tables."""
    few = ("--set", "study.search.max_evaluations=3")
    for command in ("sweep", "optimize"):
        assert answer(command, "spec.toml", "-o", "out", *few)[0] in (0, 3)
    before = (Path("out/results.csv").read_bytes(), Path("out/results.parquet").read_bytes())
    assert len(rows("out/results.csv")) > 3
    assert answer("sweep", "spec.toml", "-o", "out", *few)[0] == 0
    assert (Path("out/results.csv").read_bytes(), Path("out/results.parquet").read_bytes()) == before


def test_a_time_limit_costs_the_slow_designs_alone(answer):
    """A microsecond is too short for any design: every row has that reason, and nothing else ends."""
    status, found = answer("sweep", "spec.toml", "--time-limit", "1e-6")
    assert status == 3
    assert {row["status"] for row in found["sweeps"][0]["rows"]} == {"failed"}
    assert all("time limit of 1e-06 s" in row["reasons"][0] for row in found["sweeps"][0]["rows"])


def test_a_search_says_how_good_its_optimum_is_and_what_limits_cost(answer, capsys):
    status, found = answer("optimize", "spec.toml", "-o", "out")
    assert status == 0
    assert found["optimality"]["residual"] < 1e-3
    stray = next(item for item in found["optimality"]["multipliers"] if item["subject"] == "stray_flux_density")
    assert stray["per_unit"] > 0
    assert found["rounded"] is not None
    assert main(["optimize", "spec.toml", "-o", "out", *RUN]) == 0
    text = capsys.readouterr().out
    assert "Karush-Kuhn-Tucker residual" in text
    assert re.search(r"stray_flux_density at most 1\.5 mT: 0\.1 mT more would raise central_flux_density by", text)


def test_an_infeasible_search_names_the_conflict(answer, capsys):
    impossible = ("--set", "study.constraints.0.upper=1 uT", "--set", "study.search.max_evaluations=30")
    status, found = answer("optimize", "spec.toml", *impossible)
    assert status == 3
    assert found["status"] == "no feasible design"
    assert "stray_flux_density" in {item["subject"] for item in found["conflict"]["clashes"]}


def test_a_front_is_written_and_printed(answer):
    status, found = answer("pareto", "spec.toml", "-o", "out")
    assert status == 0
    table = rows("out/front.csv")
    assert [float(row["position"]) for row in table] == [point["position"] for point in found["points"]]
    assert len(table) == 3
    first, last = found["points"][0], found["points"][-1]
    assert first["first"] > last["first"]
    assert first["second"] > last["second"]
    # Run again in its folder it has the same tables, and all of its designs come out of the journal.
    names = ("front.csv", "results.csv", "results.parquet", "journal.jsonl")
    before = {name: Path("out", name).read_bytes() for name in names}
    again = fluxbore.pareto("spec.toml", "out", workers=1)
    assert again.reused == len(again.history) == len(rows("out/results.csv")) == found["evaluations"]
    assert {name: Path("out", name).read_bytes() for name in names} == before


def test_what_has_no_figures_scatters_by_nothing(answer, capsys):
    """It ran and its result is not valid: 3, as of any design without figures."""
    hasty = ("--time-limit", "1e-6")
    status, found = answer("tolerance", "spec.toml", "-o", "some/out", *hasty)
    assert status == 3
    assert found["status"] == "not analysed"
    assert "study.production cannot be analysed" in found["reasons"][0]
    assert Path("some/out/journal.jsonl").stat().st_size > 0, "the record of why"
    assert main(["tolerance", "spec.toml", *hasty, *RUN]) == 3
    assert capsys.readouterr().out.startswith("study.production cannot be analysed: ")


def test_tolerances_are_written_and_printed(answer, capsys):
    status, found = answer("tolerance", "spec.toml", "-o", "out")
    assert status == 0
    assert found["samples"] == 500
    assert found["yield"]["low"] <= found["yield"]["value"] <= found["yield"]["high"]
    assert {item["tolerance"]["key"] for item in found["effects"]} == {RADIUS, THICKNESS}
    assert any(row["part"] == "yield" for row in rows("out/tolerance.csv"))
    assert main(["tolerance", "spec.toml", *RUN]) == 0
    assert capsys.readouterr().out.startswith("Yield: ")


def test_a_robust_search_backs_off(answer):
    """The optimum on the limit fails it half of the time; 90 % is bought with some of the flux density."""
    status, found = answer("robust", "spec.toml", "--set", "study.production.yield=0.9", "-o", "out")
    assert status == 0
    assert found["rounds"][0]["yield"]["value"] < 0.9 <= found["tolerance"]["yield"]["value"]
    assert found["price"] > 0
    design = fluxbore.load("out/design.toml")
    (limit,) = design.study.constraints
    assert limit.upper == 1.5e-3  # the study's own, and not the one that was backed off


@pytest.mark.parametrize(
    "line, words",
    [
        ("pareto spec.toml --set study.pareto=", "study.pareto must be given for a front; got none."),
        ("tolerance spec.toml --set study.production=", "study.production must be given for a tolerance analysis"),
        ("robust spec.toml", "study.production.yield must be given for a search that reaches it; got none."),
        ("sweep spec.toml --workers 2 --scheduler tcp://127.0.0.1:1", "workers must not be given beside a scheduler"),
        ("sweep spec.toml --scheduler somewhere", 'must be an address such as tcp://host:8786; got "somewhere"'),
    ],
)
def test_what_cannot_be_run_leaves_nothing_behind(line, words, capsys, tmp_path):
    assert main([*line.split(), "-o", "out"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert words in err
    assert err.count("\n") == 1
    assert not (tmp_path / "out").exists()


def test_scripts_have_the_same_words():
    found = fluxbore.tolerance("spec.toml", workers=1, time_limit=60.0)
    assert isinstance(found, fluxbore.ToleranceResult)
    assert found.examined == 500
    assert isinstance(fluxbore.pareto("spec.toml", workers=1), fluxbore.ParetoResult)
