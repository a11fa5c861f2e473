"""Designs side by side: what is the same, what is better, what differs, and one scale for all sections."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable

import numpy as np
import pytest

import fluxbore
from fluxbore.actuators import actuator_of, assembly_of
from fluxbore.design.spec import Spec, loads
from fluxbore.design.spec_file import template
from fluxbore.design.study import Study
from fluxbore.design_result import judged
from fluxbore.geometry.parts_list import parts_list
from fluxbore.optimize.evaluation import NOT_CONVERGED, failure
from fluxbore.reports import compare_curves, compare_figures, compare_sections, compare_tables
from fluxbore.reports.compare_content import ComparedDesign, Comparison
from fluxbore.reports.compare_figures import SideTable, best_of
from fluxbore.reports.compare_page import render

Change = Callable[[Spec], Spec]


def a_design(letter: str, spec: Spec) -> ComparedDesign:
    """By the quick route; the curves are made up."""
    found = judged(spec, fluxbore.evaluate(spec, "network"))
    assembly = assembly_of(spec)
    x = np.linspace(0.0, 10e-3, 8)
    return ComparedDesign(
        letter=letter,
        source=f"{letter}.toml",
        spec=spec,
        evaluation=found.evaluation,
        checks=found.checks,
        assembly=assembly,
        items=parts_list(assembly, spec.materials),
        curves={"force_constant": (x, 10 + x)} if spec.kind.name == "hybrid" else {},
        provenance={"specification": spec.fingerprint()},
        words=actuator_of(spec).words,
    )


@pytest.fixture(scope="module")
def base() -> Spec:
    return loads(template("ipehla"))


@pytest.fixture(scope="module")
def pair(base: Spec) -> Comparison:
    wider = base.with_values({"actuator.mover.ring_width": 4e-3})
    return Comparison(designs=(a_design("A", base), a_design("B", wider)))


@pytest.fixture(scope="module")
def unlike(pair: Comparison) -> Comparison:
    return Comparison(designs=(pair.first, a_design("B", loads(template("rotlin")))))


def light(comparison: Comparison) -> Comparison:
    """Without pictures, which take long to draw and are not what a case is about."""
    bare = (dataclasses.replace(design, assembly=None, curves={}) for design in comparison.designs)
    return dataclasses.replace(comparison, designs=tuple(bare))


def row(table: SideTable | None, label: str) -> tuple[compare_figures.SideCell, ...]:
    assert table is not None
    return next(cells for cells in table.rows if cells[0].text == label)


@pytest.mark.parametrize(
    ("values", "direction", "best"),
    [
        ((1.0, 2.0, 3.0), 1, {2}),
        ((1.0, 2.0, 3.0), -1, {0}),
        ((-3.0, -2.0), 1, {1}),
        ((1.0, 2.0), 0, set()),
        ((2.0, 2.001, 1.0), 1, {0, 1}),
        ((2.0, 2.001), 1, set()),
        ((1.0, None), 1, set()),
        ((0.0, 1.0), -1, {0}),
    ],
)
def test_best_of_a_row(values: tuple[float | None, ...], direction: int, best: set[int]) -> None:
    """Catches a star without a goal, for a design that stands alone, or for one of several equal ones."""
    assert best_of(values, direction, 1e-3) == best


def test_goals_and_limits_tell_the_best(pair: Comparison) -> None:
    """Catches a star on the worse design: the force constant is to be large, the stray field is limited from above."""
    table = compare_figures.common(pair)
    forces, strays = ([design.figure(name) for design in pair.designs] for name in ("force_constant", "stray_field"))
    for label, values, sign in (("Force constant", forces, 1), ("Stray field", strays, -1)):
        if None in values:
            continue
        cells = row(table, label)[2:]
        assert [cell.best for cell in cells] == [sign * value == max(sign * v for v in values) for value in values]
    assert not any(cell.best for cell in row(table, "Winding resistance"))


def test_opposite_wishes_have_no_best(pair: Comparison) -> None:
    """Catches a star where one study wants more of a figure and another less."""
    first, second = pair.designs
    objective = second.spec.study.objective
    assert objective is not None
    turned = dataclasses.replace(second.spec.study, objective=dataclasses.replace(objective, maximise=False))
    other = dataclasses.replace(second, spec=dataclasses.replace(second.spec, study=turned))
    table = compare_figures.common(dataclasses.replace(pair, designs=(first, other)))
    assert not any(cell.best for cell in row(table, "Force constant"))


def test_differences_are_to_the_first(pair: Comparison) -> None:
    """Catches a difference to the neighbour or with its sign turned, and an equal figure shown as a change."""
    table = compare_figures.common(pair)
    before, after = (design.figure("moving_mass") for design in pair.designs)
    assert before is not None
    assert after is not None
    shown = row(table, "Moving mass")[3].note.replace("−", "-").rstrip("\u00a0%")
    assert float(shown) == pytest.approx(100 * (after / before - 1), abs=0.05)
    assert row(table, "Moving mass")[2].note == ""
    assert row(table, "Overall diameter")[3].note == "="
    wide = compare_figures.common(dataclasses.replace(pair, same=0.5))
    assert row(wide, "Moving mass")[3].note == "="


def test_only_keys_that_differ(pair: Comparison, base: Spec) -> None:
    """Catches a key that is the same in both, one that is missed, and rounding told as a difference."""
    table = compare_tables.keys(pair)
    assert table is not None
    given = [cells[0].note for cells in table.bodies[0][1]]
    assert given == ["actuator.mover.ring_width"]
    following = {cells[0].note for title, body in table.bodies if title.startswith("Following") for cells in body}
    assert following
    assert all(pair.designs[0].spec.values[key] != pair.designs[1].spec.values[key] for key in following)
    rounded = base.with_values({"actuator.mover.ring_width": base.number("actuator.mover.ring_width") * (1 + 1e-14)})
    twin = dataclasses.replace(pair.designs[1], spec=rounded)
    assert compare_tables.keys(Comparison(designs=(pair.first, twin))) is None


def test_assumed_values_that_differ(pair: Comparison, base: Spec) -> None:
    """Catches a note that both designs share, and one that is told of the wrong design."""
    assert compare_tables.assumed(pair) is None
    key = "actuator.cylinder.length"
    assert any(note.key == key for note in base.notes)
    measured = dataclasses.replace(base, notes=tuple(note for note in base.notes if note.key != key))
    table = compare_tables.assumed(
        Comparison(designs=(pair.first, dataclasses.replace(pair.designs[1], spec=measured)))
    )
    assert table is not None
    assert [(cells[0].note, cells[1].text, cells[2].text) for cells in table.rows] == [(key, "assumed", "given")]


def test_masses_by_role_add_up(pair: Comparison, unlike: Comparison) -> None:
    """Catches a role that is left out or counted once for all of its pieces."""
    for comparison in (pair, unlike):
        table = compare_tables.parts(comparison)
        assert table is not None
        for i, design in enumerate(comparison.designs, 1):
            total = design.figure("total_mass")
            number, unit = table.foot[-1][i].text.split("\u00a0")
            assert float(number) * {"g": 1e-3, "kg": 1.0}[unit] == pytest.approx(total, rel=1e-3)


def test_unlike_kinds_share_few_figures(unlike: Comparison) -> None:
    """Catches a figure of one kind in the table of what all have, and one that is in neither table."""
    common, partial = compare_figures.common(unlike), compare_figures.partial(unlike)
    assert common is not None
    assert partial is not None
    shown = {cells[0].text for cells in common.rows}
    assert {"Total mass", "Overall diameter", "Overall length"} <= shown
    assert "Force constant" not in shown
    assert row(partial, "Force constant")[3].text == "–"
    assert not shown & {cells[0].text for cells in partial.rows}
    text = render(light(unlike))
    assert "unlike kinds" in text
    assert compare_curves.overlays(unlike) == ()


def test_requirements_stand_beside_each_other(pair: Comparison) -> None:
    """Catches a limit of one study held against a design that was never asked."""
    first, second = pair.designs
    bare = dataclasses.replace(second, checks=(), spec=dataclasses.replace(second.spec, study=Study()))
    table = compare_tables.requirements(dataclasses.replace(pair, designs=(first, bare)))
    cells = row(table, "Back yoke thickness")
    assert cells[1].text.startswith("✓")
    assert cells[2].text == "not asked"
    assert compare_tables.requirements(dataclasses.replace(pair, designs=(bare, bare))) is None


def test_sections_share_one_scale(monkeypatch: pytest.MonkeyPatch, unlike: Comparison) -> None:
    """Catches a section that is stretched to the page, or that has other scales along and across."""
    seen: list[tuple[float, float]] = []

    def look(figure: object, *_: object, **__: object) -> None:
        for plot in figure.axes:  # type: ignore[attr-defined]
            box = plot.get_window_extent()
            (left, right), (low, high) = plot.get_xlim(), plot.get_ylim()
            seen.append((box.width / (right - left), box.height / (high - low)))

    monkeypatch.setattr(compare_sections, "drawing", look)
    compare_sections.sections(unlike)
    assert len(seen) == 2
    assert np.ptp(seen) < 1e-9 * np.max(seen)


def test_the_page_is_whole_and_offline(pair: Comparison) -> None:
    """Catches a section that is missing, a place that nothing fills, and an address of another host."""
    text = render(pair)
    assert 'http-equiv="Content-Security-Policy" content="default-src &#39;none&#39;;' in text
    assert not re.search(r"//[a-z]", re.sub(r"data:image/png;base64,[A-Za-z0-9+/=]+", "", text).replace("\n//", ""))
    targets = set(re.findall(r'href="#([^"]+)"', text))
    assert targets <= set(re.findall(r' id="([^"]+)"', text))
    assert not re.search(r">\s*(None|nan|inf)\s*<", text)
    assert text.count("best</span>") >= 1
    assert len(text) < 1_000_000


def test_a_design_without_figures_is_shown_as_such(pair: Comparison) -> None:
    """Catches a page that breaks, or leaves a failed design out, and a difference to nothing."""
    lost = dataclasses.replace(
        pair.designs[1], evaluation=failure("fem", NOT_CONVERGED, "The field did not converge."), checks=(), curves={}
    )
    for designs in ((pair.first, lost), (lost, pair.first), (lost, lost)):
        text = render(light(dataclasses.replace(pair, designs=designs)))
        assert "The field did not converge." in text
        assert not re.search(r">\s*(None|nan|inf)\s*<", text)


def test_words_of_users_are_escaped(pair: Comparison) -> None:
    """Catches a file's name that reaches the page as markup."""
    evil = "<script>alert(1)</script>"
    named = dataclasses.replace(pair.designs[1], source=evil)
    text = render(light(dataclasses.replace(pair, designs=(pair.first, named))))
    assert evil not in text
    assert "&lt;script&gt;" in text
