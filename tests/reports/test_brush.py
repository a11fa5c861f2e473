"""All designs of a study in one table and two pictures: each once, where its numbers say, with its limits."""

from __future__ import annotations

import dataclasses
import json
import re

import pytest

from fluxbore.design.study import Study
from fluxbore.optimize.outcome import SweepResult
from fluxbore.reports import brush_data, parallel
from fluxbore.reports.brush_data import Column, DesignTable, design_table, page_data
from fluxbore.reports.content import ReportContent
from fluxbore.reports.wording import Scale


@pytest.fixture(scope="module")
def table(content: ReportContent) -> DesignTable:
    found = design_table(content)
    assert found is not None
    return found


def test_every_design_stands_once(content: ReportContent, table: DesignTable) -> None:
    """Catches a design of the search and of a sweep as two, and one that is lost between them."""
    assert content.search is not None
    runs = [content.search.start, *content.search.history, content.search.rounded, content.one_at_a_time]
    places = {tuple(round(value, 9) for value in run.values.values()) for run in runs if run and run.evaluation.ok}
    spec = content.spec.for_study()
    for result in content.sweeps:
        for row in result.rows:
            if row.evaluation.ok:
                keys = [variable.key for variable in spec.study.variables]
                places.add(tuple(round(float(row.values.get(key, spec.values[key])), 9) for key in keys))
    assert len(table.designs) == len(places)
    assert table.lost == 2


def test_marks_are_those_of_the_study(content: ReportContent, table: DesignTable) -> None:
    """Catches a mark on a neighbour of the chosen design, and a published design put together from nothing."""
    marked = {item.mark: item.values for item in table.designs if item.mark}
    assert marked["start"][:2] == pytest.approx((1.5, 1.0))
    assert content.search is not None
    assert content.search.chosen is not None
    assert marked["chosen"][:2] == pytest.approx([1e3 * value for value in content.search.chosen.values.values()])
    assert marked["published optimum"][:2] == pytest.approx((1.5, 0.4))
    yoke = content.sweeps[1]
    rest = tuple(row for row in yoke.rows if abs(next(iter(row.values.values())) - 0.4e-3) > 1e-6)
    sweeps = (content.sweeps[0], SweepResult(yoke.sweep, rest))
    without = design_table(dataclasses.replace(content, one_at_a_time=None, sweeps=sweeps))
    assert without is not None
    assert "published optimum" not in {item.mark for item in without.designs}


def test_limits_stand_on_their_axis(table: DesignTable) -> None:
    """Catches a limit in another unit than the axis's, and a design that is called feasible beyond one."""
    stray = next(i for i, column in enumerate(table.columns) if column.subject == "stray_field")
    ((sense, limit),) = table.columns[stray].limits
    assert sense == "<="
    for item in table.designs:
        value = item.values[stray]
        assert value is not None
        if value > limit * 1.001:
            assert not item.feasible


def test_the_pictures_show_each_design_where_its_numbers_are(table: DesignTable) -> None:
    """Catches an axis upside down, and a row whose number is not its place in the data."""
    data = page_data(table)
    drawn = parallel.parallel(table).markup
    paths = dict(re.findall(r'data-row="(\d+)" d="([^"]+)"', drawn))
    assert len(paths) == len(table.designs)
    for number, column in enumerate(table.columns):
        values = data["values"][number]
        heights = {row: float(re.findall(r"[ML][\d.]+ ([\d.]+)", path)[number]) for row, path in paths.items()}
        top, low = max(heights, key=lambda row: -heights[row]), max(heights, key=lambda row: heights[row])
        assert column.ends[0] <= values[int(low)] <= values[int(top)] <= column.ends[1]
        assert values[int(top)] == max(values)
    assert json.dumps(data, allow_nan=False)


def test_too_many_designs_are_thinned_and_told(content: ReportContent, monkeypatch: pytest.MonkeyPatch) -> None:
    """Catches a page of ten thousand lines, and a chosen design that was thinned away."""
    monkeypatch.setattr(brush_data, "MOST", 10)
    found = design_table(content)
    assert found is not None
    assert found.left_out > 20
    assert len(found.designs) <= 13
    assert {"start", "chosen", "published optimum"} <= {item.mark for item in found.designs}


def test_a_study_of_one_variable_is_drawn_too(content: ReportContent) -> None:
    """Catches pictures that need two variables or an objective; what is too little is left out."""
    study = Study(sweeps=(content.sweeps[0].sweep,))
    spec = dataclasses.replace(content.spec, study=study)
    alone = ReportContent(spec=spec, start=content.start, sweeps=content.sweeps[:1])
    found = design_table(alone)
    assert found is not None
    assert [column.subject for column in found.columns] == ["actuator.mover.ring_width", "force_constant"]
    assert (found.across, found.up) == (0, 1)
    two = SweepResult(content.sweeps[0].sweep, content.sweeps[0].rows[:2])
    assert design_table(dataclasses.replace(alone, start=None, sweeps=(two,))) is None
    assert design_table(ReportContent(spec=content.spec)) is None


@pytest.mark.parametrize(
    ("ends", "texts"),
    [((0.0, 2.5), ["0.0", "0.5", "1.0", "1.5", "2.0", "2.5"]), ((-1.0, 1.0), ["−1.0", "−0.5", "0.0", "0.5", "1.0"])],
)
def test_ticks_are_round(ends: tuple[float, float], texts: list[str]) -> None:
    """Catches ticks with too few decimals to be told apart, and a minus zero."""
    found = parallel.ticks(Column("a", "A", Scale("mm", 1.0), ends))
    assert [text for text, _ in found] == texts
    assert [share for _, share in found] == sorted(share for _, share in found)
