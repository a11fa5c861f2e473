"""The report as a document: whole, offline, escaped, small, and never broken by something that is missing."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from fluxbore.design.errors import FluxboreError
from fluxbore.design.study import Axis, Study, Sweep
from fluxbore.optimize.evaluation import NOT_CONVERGED, failure
from fluxbore.optimize.outcome import SweepResult, SweepRow
from fluxbore.reports.content import Picture, ReportContent
from fluxbore.reports.page import render, write_report

VOID = {"meta", "img", "br", "hr", "link", "input", "col", "wbr"}
EVIL = "<script>alert(1)</script> \"'&amp; {{ 7*7 }} $\\frac{1}{0}$"


class Outline(HTMLParser):
    """Collects what the tests ask of a page, and every tag that is closed out of turn."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.open: list[str] = []
        self.faults: list[str] = []
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.text = ""
        self.captions = 0
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        if not self.open or self.open.pop() != tag:
            self.faults.append(tag)

    def handle_data(self, data: str) -> None:
        if "style" not in self.open and "script" not in self.open:
            self.text += data

    def named(self, tag: str) -> list[dict[str, str | None]]:
        return [attributes for name, attributes in self.tags if name == tag]


@pytest.fixture(scope="session")
def page(content: ReportContent) -> str:
    return render(content)


@pytest.fixture(scope="session")
def outline(page: str) -> Outline:
    return Outline(page)


def test_every_tag_is_closed_in_turn(outline: Outline) -> None:
    """Catches a template branch that opens what another one closes."""
    assert outline.faults == []
    assert outline.open == []


def test_nothing_is_loaded_from_elsewhere(page: str, outline: Outline) -> None:
    """Catches a link, a font or a namespace that names another host, and a policy that would allow one."""
    encoded = r'data:image/png;base64,[A-Za-z0-9+/=]+|"samples":"[A-Za-z0-9+/=]+"'
    assert not re.search(r"//[a-z]", re.sub(encoded, "", page))
    assert not outline.named("link")
    policy = [meta for meta in outline.named("meta") if meta.get("http-equiv") == "Content-Security-Policy"]
    assert len(policy) == 1
    assert (policy[0]["content"] or "").startswith("default-src 'none'")
    for _, attributes in outline.tags:
        for name in ("href", "src"):
            value = attributes.get(name)
            assert value is None or value.startswith(("#", "data:image/png;base64,"))


def test_every_picture_has_words(outline: Outline) -> None:
    """Catches a figure that a screen reader would pass over in silence."""
    assert all(image.get("alt") for image in outline.named("img"))
    drawings = [item for item in outline.named("svg") if item.get("aria-hidden") != "true"]
    assert len(drawings) >= 10
    assert all(item.get("role") == "img" and len(item.get("aria-label") or "") > 15 for item in drawings)
    assert len(outline.named("figure")) == len(outline.named("figcaption"))


def test_tables_and_headings_are_structured(outline: Outline) -> None:
    """Catches a table without caption or header scopes, and a link of the navigation that leads nowhere."""
    assert len(outline.named("table")) == len(outline.named("caption"))
    assert all(head.get("scope") in ("col", "row", "rowgroup") for head in outline.named("th"))
    assert len(outline.named("h1")) == 1
    identifiers = [attributes["id"] for _, attributes in outline.tags if attributes.get("id")]
    assert len(identifiers) == len(set(identifiers))
    targets = {(link.get("href") or "")[1:] for link in outline.named("a")}
    assert targets <= set(identifiers)


def test_references_inside_drawings_resolve(page: str, outline: Outline) -> None:
    """Catches an identifier that was dropped or renamed without its references, which empties a figure."""
    identifiers = {attributes["id"] for _, attributes in outline.tags if attributes.get("id")}
    assert set(re.findall(r"url\(#([^)]+)\)", page)) <= identifiers
    assert {(use.get("href") or "")[1:] for use in outline.named("use")} <= identifiers


def test_the_page_stays_small(page: str) -> None:
    """Catches a colour mesh that went vector, or fonts drawn as paths."""
    assert len(page.encode()) < 1_500_000


def test_two_renderings_are_equal(content: ReportContent, page: str) -> None:
    """Catches a random identifier or a time stamp in a drawing."""
    assert render(content) == page


@pytest.mark.parametrize(
    "words",
    [
        "Maximise the force constant by moving the ring width (0.5 to 6\u00a0mm)",
        "the stray field no higher than the start’s",
        "published optimum 1.5",
        "Published: 8.670\u00a0N/A at 1.5\u00a0mm, computed 8.671\u00a0N/A (+0.01\u00a0%)",
        "[actuator.back_yoke]",
        "The specification of the chosen design",
        "“no interaction effects were considered”",
        "COBYLA ended because",
        "An upper bound",
        "Slotted and slotless",
        "calibrated",
        "The field did not converge in 60 steps.",
        "Temperature rise in continuous operation.",
        "Specification (SHA-256)",
    ],
)
def test_the_page_says(outline: Outline, words: str) -> None:
    """Catches a section that is silently left out although its data is there."""
    assert words in outline.text


def test_words_of_users_are_escaped(make_content: Callable[[str], ReportContent]) -> None:
    """Catches text that comes from a file and reaches the page as markup, as a template or as mathematics."""
    plain = make_content(EVIL)
    notes = tuple(dataclasses.replace(note, reason=EVIL) for note in plain.spec.notes)
    assert plain.assembly is not None
    content = dataclasses.replace(
        plain,
        spec=dataclasses.replace(plain.spec, notes=notes),
        parts=tuple(dataclasses.replace(row, material=EVIL) for row in plain.parts),
        provenance={EVIL: EVIL},
        not_checked=(EVIL,),
        sweeps=tuple(dataclasses.replace(s, sweep=dataclasses.replace(s.sweep, name=EVIL)) for s in plain.sweeps),
        assembly=dataclasses.replace(plain.assembly, name=EVIL),
        flux_map=None,
        start_flux_map=None,
        picture=Picture(None, EVIL),
    )
    text = render(content)
    outline = Outline(text)
    assert "<script>alert" not in text
    assert "{{ 7*7 }}" in outline.text
    assert outline.faults == []


def test_the_file_is_written_whole_or_not_at_all(content: ReportContent, tmp_path: Path) -> None:
    """Catches a half-written report, one that is left beside the old, and a traceback for a bad folder."""
    small = ReportContent(spec=content.spec)
    target = tmp_path / "report.html"
    assert write_report(small, target) == target
    assert [item.name for item in tmp_path.iterdir()] == ["report.html"]
    with pytest.raises(FluxboreError, match="cannot be written"):
        write_report(small, target / "below a file" / "report.html")
    assert write_report(small, tmp_path / "new" / "report.html").exists()


def _light(content: ReportContent) -> ReportContent:
    """Without the figures that take long to draw and that the case is not about."""
    return dataclasses.replace(content, flux_map=None, start_flux_map=None, slots=None, assembly=None, sweeps=())


def _bare(content: ReportContent) -> ReportContent:
    return ReportContent(spec=content.spec)


def _evaluation_only(content: ReportContent) -> ReportContent:
    spec = dataclasses.replace(content.spec, study=Study(), notes=())
    return ReportContent(spec=spec, start=content.start, flux_map=content.start_flux_map)


def _network_only(content: ReportContent) -> ReportContent:
    return ReportContent(spec=content.spec, start_network=content.start_network, words=content.words)


def _sweep_only(content: ReportContent) -> ReportContent:
    study = dataclasses.replace(content.spec.study, objective=None, variables=(), constraints=())
    spec = dataclasses.replace(content.spec, study=study)
    return ReportContent(spec=spec, start=content.start, sweeps=content.sweeps)


def _failed_start(content: ReportContent) -> ReportContent:
    return ReportContent(spec=content.spec, start=failure("fem", NOT_CONVERGED, "The field did not converge."))


def _failed_choice(content: ReportContent) -> ReportContent:
    lost = failure("fem", NOT_CONVERGED, "The field did not converge.")
    return dataclasses.replace(_light(content), chosen=lost, chosen_network=None, picture=None)


def _nothing_feasible(content: ReportContent) -> ReportContent:
    assert content.search is not None
    history = tuple(item for item in content.search.history if not item.feasible)
    search = dataclasses.replace(
        content.search, history=history, best_so_far=(None,) * len(history), best=None, rounded=None, network_start=None
    )
    return dataclasses.replace(_light(content), search=search, chosen_spec=None, chosen=None, one_at_a_time=None)


def _all_rows_failed(content: ReportContent) -> ReportContent:
    lost = failure("fem", NOT_CONVERGED, "The field did not converge.")
    rows = tuple(dataclasses.replace(row, evaluation=lost) for row in content.sweeps[0].rows)
    return dataclasses.replace(
        _light(content), search=None, sweeps=(dataclasses.replace(content.sweeps[0], rows=rows),)
    )


def _two_axes(content: ReportContent) -> ReportContent:
    (first,), (second,) = content.sweeps[0].sweep.axes, content.sweeps[1].sweep.axes
    sweep = Sweep("Both", (Axis(first.key, first.values[1:4]), Axis(second.key, second.values[1:4])))
    rows = tuple(
        SweepRow({first.key: a, second.key: b}, content.sweeps[0].rows[1].evaluation)
        for a in sweep.axes[0].values
        for b in sweep.axes[1].values
    )
    return dataclasses.replace(_light(content), search=None, sweeps=(SweepResult(sweep, rows),))


def _flat_density(content: ReportContent) -> ReportContent:
    field = content.flux_map
    assert field is not None
    flat = np.asarray(field.flux_density[field.triangles].mean(axis=1))
    region = (field.r[field.triangles].mean(axis=1) > 8e-3).astype(int)
    return ReportContent(
        spec=content.spec, flux_map=dataclasses.replace(field, flux_density=flat, outlines=(), region=region)
    )


@pytest.mark.parametrize(
    ("reduce", "words"),
    [
        (_bare, "No evaluation by finite elements"),
        (_evaluation_only, "Evaluate the design of the specification"),
        (_network_only, "An upper bound"),
        (_sweep_only, "published optimum 0.4"),
        (_failed_start, "The specified design has no figures (not converged)"),
        (_failed_choice, "The chosen design has no figures (not converged)"),
        (_nothing_feasible, "The search found no feasible design"),
        (_all_rows_failed, "No design of this sweep has a force constant."),
        (_two_axes, "ring width 0.5"),
        (_flat_density, "The whole machine in section"),
    ],
    ids=lambda item: item.__name__.strip("_") if callable(item) else "",
)
def test_what_is_missing_is_left_out(
    content: ReportContent, reduce: Callable[[ReportContent], ReportContent], words: str
) -> None:
    """Catches a page that breaks, or says None or nan, where a figure, a section or a whole route is absent."""
    outline = Outline(render(reduce(content)))
    assert words in outline.text
    assert outline.faults == []
    assert not re.search(r"\b(None|nan|inf)\b", outline.text)
