"""The main job from specification to report, small enough for every run of the tests."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from fluxbore.cli import main
from fluxbore.design.graphics import has_gl

TOP = Path(__file__).parent.parent
SPEC = str(TOP / "examples" / "ipehla.toml")
SMALL = [
    "--set=operating_point.positions=2",
    "--set=study.search.max_evaluations=8",
    "--set=study.sweeps.0.axes.0.step=5.75 mm",
    "--set=study.sweeps.1.axes.0.step=1.2 mm",
]


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, object]]:
    """The folder of one run and what it printed."""
    folder = tmp_path_factory.mktemp("run") / "out"
    import contextlib
    import io

    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        status = main(["design", SPEC, "-o", str(folder), "--json", "--quiet", *SMALL])
    assert status == 0
    return folder, json.loads(printed.getvalue())


def test_leaves_its_files(run: tuple[Path, dict[str, object]]) -> None:
    """A result that is missing, or one that was left half-written beside the whole ones."""
    folder, printed = run
    for name in ("report.html", "results.csv", "design.toml", "journal.jsonl"):
        assert (folder / name).stat().st_size > 100
    if has_gl():
        assert (folder / "cad" / "iPEHLA.step").exists()
        assert len(list((folder / "cad").glob("iPEHLA-*ed.step"))) == 2
        assert len(list((folder / "cad" / "parts").glob("*.step"))) >= 10
    assert not [path for path in folder.rglob("*") if path.name.endswith(".partial")]
    assert printed["status"] == "ok"


def test_design_file_gives_the_reports_figures(
    run: tuple[Path, dict[str, object]], capsys: pytest.CaptureFixture[str]
) -> None:
    """A design.toml that lost digits, or a study whose held keys did not reach it."""
    folder, printed = run
    assert main(["evaluate", str(folder / "design.toml"), "--json"]) == 0
    again = json.loads(capsys.readouterr().out)["performance"]
    reported = printed["performance"]
    assert isinstance(reported, dict)
    for name, value in reported.items():
        assert again[name] == (None if value is None else pytest.approx(value, rel=1e-9, abs=1e-12)), name


def test_results_table_holds_every_design(run: tuple[Path, dict[str, object]]) -> None:
    """Rows out of grid order, rows that were lost, figures that are not numbers."""
    folder, _ = run
    with (folder / "results.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    widths = [float(row["actuator.mover.ring_width"]) for row in rows[:3]]
    assert widths == pytest.approx([0.0, 5.75e-3, 11.5e-3])
    thicknesses = [float(row["actuator.back_yoke.thickness"]) for row in rows[3:6]]
    assert thicknesses == pytest.approx([0.1e-3, 1.3e-3, 2.5e-3])
    assert {row["status"] for row in rows} == {"ok"}
    assert all(float(row["force_constant"]) > 0 for row in rows)
    assert list(rows[0])[-2:] == ["status", "reason"]


def test_runs_again_without_computing(
    run: tuple[Path, dict[str, object]], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A second run that does not find the first one's designs in the journal, or ends elsewhere."""
    folder, first = run
    before = (folder / "journal.jsonl").read_bytes()
    assert main(["optimize", SPEC, "-o", str(folder), "--json", "--quiet", *SMALL]) == 0
    second = json.loads(capsys.readouterr().out)
    assert (folder / "journal.jsonl").read_bytes() == before
    search = first["search"]
    assert isinstance(search, dict)
    assert second["chosen"] == search["chosen"]


def test_another_specification_is_refused_its_folder(
    run: tuple[Path, dict[str, object]], capsys: pytest.CaptureFixture[str]
) -> None:
    """Results of two specifications mixed in one folder."""
    folder, _ = run
    before = sorted((path, path.stat().st_mtime_ns) for path in folder.rglob("*"))
    status = main(["design", SPEC, "-o", str(folder), "--quiet", "--set=actuator.mover.ring_width=2 mm", *SMALL])
    output = capsys.readouterr()
    assert (status, output.out) == (2, "")
    assert "another specification" in output.err
    assert sorted((path, path.stat().st_mtime_ns) for path in folder.rglob("*")) == before
