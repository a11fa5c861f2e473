"""`fluxbore simulate`: the contact-force benchmark of the prototype once, and a toy benchmark for all else."""

from __future__ import annotations

import csv
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from benchmark_toy import TOY
from coil_study import SPEC

import fluxbore
from fluxbore import actuators
from fluxbore.cli import main
from fluxbore.simulating import on_the_stand_of

TOP = Path(__file__).parent.parent
DENSITY = "actuator.coil_1.current_density"
CONDITIONS = ("P-N", "P-P", "P-E")


@pytest.fixture(scope="module")
def prototype(tmp_path_factory: pytest.TempPathFactory):
    """The first seed of the prototype, its folder and what the command printed."""
    place = tmp_path_factory.mktemp("mcfc")
    folder, text = place / "out", (TOP / "examples" / "ipehla.toml").read_text(encoding="utf-8")
    # Without its study, whose derivatives are no part of this.
    (place / "spec.toml").write_text(text.split("[study]")[0], encoding="utf-8")
    command = ["simulate", str(place / "spec.toml"), "--benchmark", "mcfc", "--seeds", "1"]
    with pytest.MonkeyPatch.context() as patch:
        printed: list[str] = []
        patch.setattr("builtins.print", lambda *texts, **_: printed.append(" ".join(map(str, texts))))
        status = main([*command, "-o", str(folder), "--workers", "1", "--json", "--quiet", "--no-picture"])
    assert status == 0, printed
    return folder, json.loads(printed[-1])


def test_the_prototype_is_as_published(prototype):
    """Catches figures under other names than the issue's scripts read, and a plant that drifts from its calibration."""
    _, answer = prototype
    assert (answer["status"], answer["reasons"], answer["benchmark"]) == ("ok", [], "mcfc")
    figures = answer["figures"]
    assert figures["fin_deformed_length"] == pytest.approx(0.412e-3, abs=1e-6)
    assert figures["fin_contact_area"] == pytest.approx(20.85e-6, abs=0.05e-6)
    medians = figures["median_rmse"]
    assert medians["P-N"] == pytest.approx(3.13, abs=0.15)
    assert medians["P-P"] == pytest.approx(2.94, abs=0.2)
    assert medians["P-E"] == pytest.approx(1.26, abs=0.2)
    assert figures["cells_lowest_P-E"] >= 34
    assert abs(figures["cells_P-P_below_P-N"] - 18) <= 2
    assert figures["friedman_chi2"] > 45
    for pair in figures["post_hoc"]:
        assert (pair["p_corrected"] < 1e-3) == ("P-E" in pair["pair"]), pair
    for target in ("20", "40", "60"):
        assert figures["trend"]["P-N"][target] < -0.9
        assert figures["trend"]["P-P"][target] > 0.9
    (seed,) = figures["seeds"]
    assert seed == {"seed": 1, **{name: value for name, value in figures.items() if name != "seeds"}}


def test_the_folder_holds_every_trial(prototype):
    """Catches a table without some trials, traces cut from the wrong ones, and files that the answer does not name."""
    import pyarrow.parquet

    folder, answer = prototype
    assert {Path(name).name for name in answer["files"]} == {
        "results.csv",
        "traces.parquet",
        "figures.json",
        "report.html",
    }
    assert all(Path(name).exists() for name in answer["files"])
    written = json.loads((folder / "figures.json").read_text(encoding="utf-8"))
    assert written == {name: value for name, value in answer.items() if name != "files"}
    with (folder / "results.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 3 * 4 * 12
    errors = sorted(float(row["rmse"]) for row in rows if row["condition"] == "P-E" and float(row["target"]) > 0)
    assert (errors[17] + errors[18]) / 2 == pytest.approx(answer["figures"]["median_rmse"]["P-E"], rel=1e-12)
    table = pyarrow.parquet.read_table(folder / "traces.parquet")
    traces = {name: table.column(name).to_numpy() for name in table.column_names}
    assert np.unique(traces["trial"]).size == len(rows)
    one = (traces["condition"] == "P-E") & (traces["target"] == 40.0) & (traces["frequency"] == 1.0)
    assert np.all(np.diff(traces["time"][one]) > 0)
    assert traces["position"][one].min() == pytest.approx(-1.05e-3, abs=0.03e-3)
    assert abs(traces["current"][one]).max() > 0.2
    assert abs(traces["current"][traces["condition"] == "P-N"]).max() == 0


def test_the_report_has_the_section(prototype):
    """Catches a report without the benchmark, or with a broken or empty picture of it."""
    folder, answer = prototype
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert 'id="contact-force"' in page
    for name in ("loops", "speed", "boxes", "trace"):
        assert f"contact-force-{name}-" in page
    assert f"{answer['figures']['median_rmse']['P-E']:.3f}" in page
    assert "--against" in page


@pytest.fixture
def toy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a study of coils, which have the toy benchmark here."""
    (tmp_path / "spec.toml").write_text(SPEC)
    (tmp_path / "weak.toml").write_text(SPEC.replace('"22.5 A/mm^2"', '"11 A/mm^2"'))
    (tmp_path / "bad.toml").write_text(SPEC.replace('"22.5 A/mm^2"', '"-22.5 A/mm^2"'))
    monkeypatch.chdir(tmp_path)
    coils = replace(actuators.ACTUATORS["coils"], benchmarks={"toy": TOY})
    monkeypatch.setitem(actuators.ACTUATORS, "coils", coils)
    return tmp_path


RUN = ("simulate", "spec.toml", "--benchmark", "toy", "--workers", "1", "--quiet")


def test_a_run_again_computes_nothing(toy, capsys):
    """Catches traces or figures kept under another key than they are looked for by."""
    command = [*RUN, "-o", "out", "--seeds", "2", "--no-picture", "--json"]
    assert main(command) == 0
    first, journal = capsys.readouterr().out, Path("out/journal.jsonl").read_bytes()
    traces = Path("out/traces.parquet").read_bytes()
    assert main(command) == 0
    assert capsys.readouterr().out == first
    assert Path("out/journal.jsonl").read_bytes() == journal
    assert Path("out/traces.parquet").read_bytes() == traces
    assert main([*RUN, "-o", "out", "--seeds", "3", "--no-picture", "--json"]) == 0
    more = json.loads(capsys.readouterr().out)["figures"]
    assert [item["seed"] for item in more["seeds"]] == [1, 2, 3]
    assert more["error"]["A"] == more["seeds"][1]["error"]["A"]
    assert Path("out/journal.jsonl").read_bytes().startswith(journal)


def test_designs_stand_beside_one_another(toy, capsys):
    """Catches a comparison with the wrong design, and one bad design that takes the others' figures away."""
    others = ("--against", "weak.toml", "--against", "bad.toml")
    assert main([*RUN, "--seeds", "1", *others, "--json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    weak, bad = answer["against"]
    assert answer["figures"]["error"]["A"] > 1.5 * weak["figures"]["error"]["A"]
    assert (weak["design"], weak["status"]) == ("weak", "ok")
    assert (bad["design"], bad["status"], bad["figures"]) == ("bad", "refused", {})
    assert bad["reasons"] == ["A current against the field cannot be simulated."]
    assert main([*RUN, "--seeds", "2", *others]) == 0
    text = capsys.readouterr().out
    assert "two coils" in text
    assert "weak" in text
    assert "bad: A current against the field cannot be simulated." in text
    assert "medians over seeds 1 to 2" in text
    assert "NOT within 0.5" in text or "within 0.5" in text


def test_sensitivities_are_a_table(toy, capsys):
    """Catches variations that are run and not told, in words or in JSON."""
    assert main([*RUN, "--seeds", "1", "--vary", "--json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert [item["change"] for item in answer["variations"]] == ["0.5", "-1", "1e+12"]
    assert [item["status"] for item in answer["variations"]] == ["ok", "refused", "refused"]
    assert main([*RUN, "--seeds", "1", "--vary"]) == 0
    lines = capsys.readouterr().out.splitlines()
    (before,) = [line for line in lines if line.startswith("as it is")]
    (half,) = [line for line in lines if line.startswith("0.5 ")]
    assert float(half.split()[-1]) == pytest.approx(float(before.split()[-1]) / 2, rel=1e-3)


def test_designs_are_called_by_their_folders(toy, capsys):
    """Catches two results of searches that are both called "design", and a long path where a name would do."""
    for folder in ("ring", "fin", "more/fin"):
        Path(folder).mkdir(parents=True)
        Path(folder, "design.toml").write_text(SPEC)
    names = ("ring/design.toml", "fin/design.toml", "more/fin/design.toml", "weak.toml")
    assert main([*RUN, "--seeds", "1", "--json", *(word for name in names for word in ("--against", name))]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert [item["design"] for item in answer["against"]] == ["ring", "fin", "more/fin/design", "weak"]


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("--benchmark", "mcfc"), 'benchmark must be one of toy for an actuator of kind coils; got "mcfc".'),
        (("--seeds", "0"), "seeds must be from 1 to 1000; got 0."),
        (("--seeds", "-1"), "seeds must be from 1 to 1000; got -1."),
        (("--seeds", "99999999999999"), "seeds must be from 1 to 1000; got 99999999999999."),
        (("--seeds", "9" * 5000), "argument --seeds: must be a whole number; got"),
        (("--seeds", "1-"), 'argument --seeds: must be a whole number; got "1-"'),
        (("--seeds", "1001"), "seeds must be from 1 to 1000; got 1001."),
        (("--seed", "-1"), "seed must be from 0 to 2147483647; got -1."),
        (("--seed", "2147483648"), "seed must be from 0 to 2147483647; got 2147483648."),
        (("--seeds", "two"), 'argument --seeds: must be a whole number; got "two"; see fluxbore simulate --help.'),
        (("--against", "nowhere.toml"), "nowhere.toml cannot be read: No such file or directory."),
        (
            ("--against", "ipehla.toml"),
            'against must name designs of kind coils, as the specification\'s is; "ipehla" is',
        ),
        (("--against", "weak.toml", "--against", "weak.toml"), "against must name every design once"),
    ],
)
def test_what_is_wrong_is_one_sentence(toy, capsys, arguments, sentence):
    """Catches a traceback, and a folder that is made before the refusal."""
    (toy / "ipehla.toml").write_text((TOP / "examples" / "ipehla.toml").read_text(encoding="utf-8"))
    assert main([*RUN, "--seeds", "1", "-o", "out", *arguments]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("fluxbore: ")
    assert sentence in printed.err
    assert printed.err.count("\n") == 1
    assert not Path("out").exists()


def test_a_refusal_by_the_simulation_is_the_specification_s(toy, capsys):
    """Catches a key that only the plant can judge and that ends as a result, or in a traceback of a worker."""
    assert main([*RUN, "--seeds", "1", "--set", f"{DENSITY}=-1 A/mm^2"]) == 2
    assert capsys.readouterr().err == "fluxbore: A current against the field cannot be simulated.\n"


def test_a_kind_without_benchmarks_says_so(tmp_path, monkeypatch, capsys):
    """Catches an empty list in the sentence."""
    monkeypatch.chdir(tmp_path)
    Path("spec.toml").write_text(SPEC)
    assert main(["simulate", "spec.toml", "--benchmark", "mcfc"]) == 2
    assert capsys.readouterr().err == (
        "fluxbore: benchmark must be one of the actuator's kind, and kind coils has none (hybrid has mcfc; "
        "hydrostatic has tracking; "
        "lead-screw has force); "
        'got "mcfc".\n'
    )


def test_a_study_s_results_are_not_replaced(toy, capsys):
    """Catches a search's table and report that a simulation in the same folder would overwrite."""
    assert main(["sweep", "spec.toml", "-o", "out", "--workers", "1", "--quiet"]) == 0
    before = Path("out/results.csv").read_bytes()
    capsys.readouterr()
    command = [*RUN, "--seeds", "1", "-o", "out", "--no-picture"]
    assert main(command) == 2
    assert "out must be empty or hold results of simulations; it holds results.csv of a study (see --force)." in (
        capsys.readouterr().err
    )
    assert Path("out/results.csv").read_bytes() == before
    assert main([*command, "--force"]) == 0
    assert Path("out/results.csv").read_text().startswith("design,seed,way,load")
    assert not Path("out/results.parquet").exists()


@pytest.mark.parametrize("study", ["sweep", "optimize", "design"])
def test_a_simulation_s_results_are_not_replaced(toy, capsys, study):
    """Catches trials and their report that a study in the same folder would overwrite, or leave beside its own."""
    assert main([*RUN, "--seeds", "1", "-o", "out", "--no-picture"]) == 0
    before = {path.name: path.read_bytes() for path in Path("out").iterdir()}
    capsys.readouterr()
    command = [study, "spec.toml", "-o", "out", "--workers", "1", "--quiet"]
    assert main(command) == 2
    assert capsys.readouterr().err == (
        "fluxbore: out must be empty or hold results of a study; it holds results.csv of simulations (see --force).\n"
    )
    assert {path.name: path.read_bytes() for path in Path("out").iterdir()} == before
    if study == "sweep":
        assert main([*command, "--force"]) == 0
        assert not Path("out/results.csv").read_text().startswith("design,seed")
        assert not {"traces.parquet", "figures.json", "report.html"} & {path.name for path in Path("out").iterdir()}


def test_a_table_that_cannot_be_read_is_a_sentence(toy, capsys):
    """Catches a traceback where results.csv is no file."""
    assert main([*RUN, "--seeds", "1", "-o", "out", "--no-picture"]) == 0
    Path("out/results.csv").unlink()
    Path("out/results.csv").mkdir()
    capsys.readouterr()
    assert main([*RUN, "--seeds", "1", "-o", "out", "--no-picture"]) == 2
    assert capsys.readouterr().err == "fluxbore: out/results.csv cannot be read: Is a directory.\n"


def test_an_interrupt_leaves_whole_files_and_what_was_computed(toy, capsys, monkeypatch):
    """Catches a table of half the seeds, and seeds that have to be computed again after Ctrl-C."""
    from fluxbore.optimize.journal import Journal

    note = Journal.note

    def interrupted(self, key, kind, content):
        found = note(self, key, kind, content)
        if content["seed"] == 2:
            raise KeyboardInterrupt
        return found

    with monkeypatch.context() as patch:
        patch.setattr(Journal, "note", interrupted)
        assert main([*RUN, "--seeds", "3", "-o", "out", "--no-picture"]) == 130
    assert "interrupted" in capsys.readouterr().err
    assert {path.name for path in Path("out").iterdir()} == {".fluxbore.json", "journal.jsonl"}
    before = Path("out/journal.jsonl").read_bytes()
    assert main([*RUN, "--seeds", "3", "-o", "out", "--no-picture"]) == 0
    after = Path("out/journal.jsonl").read_bytes()
    assert after.startswith(before)
    kinds = [json.loads(line) for line in after.splitlines()]
    # The first seed once more for its traces, which are in no journal, and the third.
    assert sorted(line["content"]["seed"] for line in kinds if "content" in line) == [1, 1, 2, 3]


def test_python_has_the_same_words(toy):
    """Catches an interface that needs files: specifications and designs may be given as such."""
    spec = fluxbore.load("spec.toml")
    weak = fluxbore.load("weak.toml", {"actuator.name": "weak coils"})
    result = fluxbore.simulate(spec, "toy", seeds=2, seed=7, against=[weak], workers=1)
    assert isinstance(result, fluxbore.BenchmarkResult)
    assert result.ok
    assert result.seeds == (7, 8)
    assert [run.label for run in result.runs] == ["two coils", "weak coils"]
    assert result.files == ()
    assert result.run.simulations[0].trials[0].trace is not None
    with pytest.raises(fluxbore.FluxboreError, match="seeds must be from 1"):
        fluxbore.simulate(spec, "toy", seeds=-1)


def test_a_tenth_is_a_tenth_of_what_the_specification_has():
    """Catches a variation of the default where a value is given, and a force constant that is not the design's."""
    from types import SimpleNamespace

    from fluxbore.design.spec import loads

    text = (TOP / "examples" / "ipehla.toml").read_text(encoding="utf-8")
    benchmark = actuators.ACTUATORS["hybrid"].benchmarks["mcfc"]
    around = SimpleNamespace(force_map=SimpleNamespace(mean_force_constant=8.0))
    own = loads(text, {"benchmark.mcfc.valve_lag": "0.2 s"})
    found = [values for _, values in benchmark.variations(own, around)]
    assert {"benchmark.mcfc.valve_lag": pytest.approx(0.22)} in found
    assert {"benchmark.mcfc.friction_share": pytest.approx(0.9)} in found
    assert {"benchmark.mcfc.force_constant": pytest.approx(8.8)} in found
    given = loads(text, {"benchmark.mcfc.force_constant": "10 N/A"})
    assert {"benchmark.mcfc.force_constant": pytest.approx(9.0)} in [v for _, v in benchmark.variations(given, around)]


def test_other_designs_stand_on_the_same_test_stand():
    """Catches a comparison that mixes the design's change with that of valve and encoder."""
    text = (TOP / "examples" / "ipehla.toml").read_text(encoding="utf-8")
    from fluxbore.design.spec import loads

    own = loads(text, {"benchmark.mcfc.valve_lag": "0.2 s", "actuator.mover.ring_width": "2 mm"})
    other = loads(text, {"benchmark.mcfc.valve_lag": "0.1 s", "benchmark.mcfc.moving_mass": "1 kg"})
    benchmark = actuators.ACTUATORS["hybrid"].benchmarks["mcfc"]
    moved = on_the_stand_of(own, benchmark, other)
    stand = {key: value for key, value in own.values.items() if key.startswith("benchmark.")}
    assert {key: value for key, value in moved.values.items() if key.startswith("benchmark.")} == stand
    design = {key: value for key, value in other.values.items() if not key.startswith("benchmark.")}
    assert {key: value for key, value in moved.values.items() if not key.startswith("benchmark.")} == design
    assert design["actuator.mover.ring_width"] == 1.5e-3


def test_tests_and_trends_are_told_in_words(toy):
    """Catches names of JSON in a table for people, and a row of numbers that does not say what they are of."""
    from fluxbore.simulation_messages import simulation_text

    result = fluxbore.simulate("spec.toml", "toy", seeds=1, workers=1)
    figures = {**result.run.figures, "friedman_p": 0.5, "trend": {"P-N": {"20": -1.0}}}
    lines = simulation_text(replace(result, run=replace(result.run, figures=figures))).splitlines()
    assert ["Friedman's", "p", "0.5"] in [line.split() for line in lines]
    start = lines.index("rank correlation of error and speed, by target (N)  20")
    assert lines[start + 1].split() == ["P-N", "-1"]
