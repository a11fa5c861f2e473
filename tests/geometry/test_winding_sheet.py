"""The winding chart as a page and as CSV."""

import csv
import io
from dataclasses import replace
from pathlib import Path

import pytest
from drawing_checks import check_texts

from fluxbore.cli import main
from fluxbore.design.spec import load
from fluxbore.design.title_block import TitleBlock
from fluxbore.design.winding_chart import WindingChart
from fluxbore.geometry.sheet import texts_of
from fluxbore.geometry.winding_sheet import chart_csv, winding_sheets
from fluxbore.reports.winding import winding_section
from fluxbore.winding_views import winding_chart

EXAMPLES = Path(__file__).parents[2] / "examples"


def chart_of(name: str) -> WindingChart:
    chart = winding_chart(load(EXAMPLES / f"{name}.toml"))
    assert chart is not None
    return chart


@pytest.mark.parametrize("name", ["ipehla", "team22"])
def test_the_sheet_is_legible_and_has_every_coil(name: str) -> None:
    chart = chart_of(name)
    (sheet,) = winding_sheets(chart, TitleBlock())
    check_texts(sheet)
    shown = [text.text for text in texts_of(sheet.items)]
    assert {coil.name for coil in chart.coils} <= set(shown)
    for text in chart.assumed:
        assert any(text[:20] in line for line in shown)


def test_long_charts_go_on_on_further_sheets() -> None:
    chart = chart_of("ipehla")
    coils = tuple(replace(chart.coils[i % 24], number=i + 1) for i in range(120))
    phases = tuple(replace(phase, coils=tuple(range(i + 1, 121, 3))) for i, phase in enumerate(chart.phases))
    sheets = winding_sheets(replace(chart, coils=coils, phases=phases), TitleBlock())
    assert len(sheets) > 2
    numbers: list[str] = []
    for sheet in sheets:
        check_texts(sheet)
        column = min(text.place[0] for text in texts_of(sheet.items) if text.text == "no.")
        numbers += [text.text for text in texts_of(sheet.items) if text.place[0] == column and text.text.isdigit()]
    assert sorted(map(int, numbers)) == list(range(1, 121))


def test_the_table_for_machines_has_the_same_figures() -> None:
    chart = chart_of("ipehla")
    rows = list(csv.DictReader(io.StringIO(chart_csv(chart), newline="")))
    assert len(rows) == len(chart.coils) + len(chart.phases)
    for row, coil in zip(rows, chart.coils, strict=False):
        assert float(row["resistance (ohm)"]) == pytest.approx(coil.resistance)
        assert float(row["wire (m)"]) == pytest.approx(coil.length)
        assert float(row["conductor (kg)"]) == pytest.approx(coil.mass)
    assert [row["start joined to"] for row in rows[:5]] == ["lead U", "lead V", "lead W", "end of 1", "end of 2"]
    assert [row["coil"] for row in rows[-3:]] == ["all of U", "all of V", "all of W"]


def test_the_report_has_phases_and_what_is_assumed() -> None:
    section = winding_section(chart_of("ipehla"))
    assert section is not None
    assert section.phases is not None
    assert len(section.phases.rows) == 3
    assert len(section.coils.rows) == 24
    assert section.assumed
    assert winding_section(None) is None
    other = winding_section(chart_of("team22"))
    assert other is not None
    assert other.phases is None


def test_the_command_writes_the_chart_or_says_who_has_one(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = str(tmp_path / "x")
    assert main(["export", str(EXAMPLES / "team22.toml"), "-o", folder, "--format", "winding"]) == 0
    names = {Path(line).name for line in capsys.readouterr().out.split("\n") if line.startswith(folder)}
    assert names == {"TEAM-22-winding.csv", "TEAM-22-winding.svg", "TEAM-22-winding.pdf"}
    assert main(["export", str(EXAMPLES / "rotlin.toml"), "-o", folder + "y", "--format", "winding"]) == 2
    assert (
        capsys.readouterr()
        .err.strip()
        .endswith('actuator.kind must be "coils" or "hybrid" for a winding chart; got "lead-screw".')
    )
    assert not Path(folder + "y").exists()
