"""`fluxbore report A B`: what it takes, what it refuses in one sentence, and what it answers."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import fluxbore
from fluxbore import comparing
from fluxbore.cli import main
from fluxbore.design.errors import SpecError
from fluxbore.design.spec_file import template
from fluxbore.optimize.evaluate import evaluate
from fluxbore.reports import compare_sections


@pytest.fixture
def two(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[str, str]:
    """Two specifications, evaluated by the quick route."""
    monkeypatch.setattr(comparing, "evaluate_design", lambda spec: evaluate(spec, "network"))
    monkeypatch.setattr(compare_sections, "sections", lambda _: None)  # takes a second, and has a test of its own
    text = template("ipehla")
    first, second = tmp_path / "first.toml", tmp_path / "second.toml"
    first.write_text(text, encoding="utf-8")
    second.write_text(text.replace('ring_width = "1.5 mm"', 'ring_width = "2.5 mm"'), encoding="utf-8")
    assert first.read_bytes() != second.read_bytes()
    return str(first), str(second)


def refused(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    assert main(["report", *arguments]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.count("\n") == 1
    return captured.err


def test_two_designs_become_one_page(two: tuple[str, str], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Catches a page that is not written, and an answer without the designs' figures."""
    target = tmp_path / "new" / "page.html"
    assert main(["report", *two, "-o", str(target), "--json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert [item["letter"] for item in answer["designs"]] == ["A", "B"]
    assert answer["designs"][0]["performance"]["moving_mass"] < answer["designs"][1]["performance"]["moving_mass"]
    assert answer["files"] == [str(target)]
    assert "2 designs side by side" in target.read_text(encoding="utf-8")
    assert refused(capsys, *two, "-o", str(target)).startswith(f"fluxbore: {target} must not exist yet")


def test_a_folder_stands_for_its_design(
    two: tuple[str, str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Catches a run's folder that is not read, and results that are not held against the design."""
    run = tmp_path / "run"
    run.mkdir()
    (run / "design.toml").write_text(Path(two[1]).read_text(encoding="utf-8"), encoding="utf-8")
    figure = evaluate(fluxbore.load(two[1]), "network").performance.force_constant
    table = "actuator.mover.ring_width,force_constant,status,reason\n0.0015,1,ok,\n0.0025,{},ok,\n"
    for value, words in ((figure, "which found the same figures"), (1.0, "other figures for it, such as")):
        (run / "results.csv").write_text(table.format(value), encoding="utf-8")
        fluxbore.compare([two[0], run], tmp_path / "page.html", force=True)
        page = (tmp_path / "page.html").read_text(encoding="utf-8")
        assert "chosen by a run of 2 designs" in page
        assert words in page
    assert "one file" in refused(capsys, str(run), str(run / "design.toml"), "-o", str(tmp_path / "p.html"))


def test_what_cannot_be_compared_is_refused(
    two: tuple[str, str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Catches a traceback, and a file that is left behind."""
    page = str(tmp_path / "p.html")
    empty = tmp_path / "empty"
    empty.mkdir()
    first, second = two
    assert "are one file" in refused(capsys, first, f"{tmp_path}/./first.toml", "-o", page)
    assert "must hold design.toml" in refused(capsys, first, str(empty), "-o", page)
    assert "takes 2 to 6 designs; got 7" in refused(capsys, *[first, second] * 3, first, "-o", page)
    assert "--set must be left out" in refused(capsys, first, second, "--set", "a.b=1", "-o", page)
    assert "--same must be left out" in refused(capsys, first, "--same", "1", "-o", page)
    assert "must be per cent" in refused(capsys, first, second, "--same", "nan", "-o", page)
    assert "cannot be read" in refused(capsys, first, str(tmp_path / "none.toml"), "-o", page)
    assert not Path(page).exists()
    with pytest.raises(SpecError, match="takes 2 to 6 designs; got 1"):
        fluxbore.compare([first], page)
