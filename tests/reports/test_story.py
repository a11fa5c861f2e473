"""What the page says of a study: the trade, the limits, what a route does not know, and what has no result."""

from __future__ import annotations

import dataclasses
import re

import numpy as np
import pytest

from fluxbore.design.performance import FIGURES
from fluxbore.optimize.evaluation import NOT_CONVERGED, failure
from fluxbore.optimize.outcome import Candidate, Check, Limit, SearchResult
from fluxbore.reports import flux_picture, search_curves, story, study_tables, tried
from fluxbore.reports.content import FluxMap, ReportContent
from fluxbore.reports.page import render
from fluxbore.reports.wording import meaning


def _search(content: ReportContent) -> SearchResult:
    assert content.search is not None
    return content.search


def _chosen(content: ReportContent) -> Candidate:
    chosen = _search(content).chosen
    assert chosen is not None
    return chosen


def test_a_gain_names_its_price(content: ReportContent) -> None:
    """Catches a headline that keeps silent about what got worse for it, or counts the objective among the price."""
    start, chosen = _search(content).start, _chosen(content)
    dear = dataclasses.replace(
        chosen.evaluation.performance, motor_constant=1.0, moving_mass=start.evaluation.performance.moving_mass
    )
    paid = story.price(start.evaluation.performance, dear, "force_constant")
    assert re.search(r"motor constant −\d", paid)
    assert "winding resistance +" in paid
    assert "force constant" not in paid
    assert "moving mass" not in paid
    assert "; the price: " in story.gain(content)[0]


def test_the_start_itself_is_no_gain(content: ReportContent) -> None:
    """Catches "±0 % against the start" where the search found nothing."""
    search = dataclasses.replace(_search(content), best=_search(content).start, rounded=None)
    found = story.gain(dataclasses.replace(content, search=search, one_at_a_time=None))
    assert found[0] == "Nothing better than the start was found."
    assert not any("%" in text for text in found)


@pytest.mark.parametrize("listed", [True, False], ids=["check without a value", "limit left out"])
def test_what_the_network_does_not_know_is_not_met(content: ReportContent, listed: bool) -> None:
    """Catches a green tick for a figure that nobody computed, and a change from one route to the other."""
    network = content.chosen_network
    chosen = _chosen(content)
    assert network is not None
    unknown = tuple(
        dataclasses.replace(item, value=None, margin=None, satisfied=True, active=False) for item in chosen.checks
    )
    guess = Candidate(chosen.values, network, network.performance.force_constant, unknown if listed else ())
    table = study_tables.candidates(
        dataclasses.replace(content, search=dataclasses.replace(_search(content), network_start=guess))
    )
    assert table is not None
    row = next(row for row in table.rows if row[0].text.startswith("Network"))
    assert row[2].text == "–"
    assert row[3].text == "stray field not known to the network"
    assert row[3].tone != "good"


def test_a_design_is_chosen_once(content: ReportContent) -> None:
    """Catches a start that is the best, and a best that is rounded already, told of as so many chosen designs."""
    search = _search(content)
    again = dataclasses.replace(search.start)
    table = study_tables.candidates(
        dataclasses.replace(content, search=dataclasses.replace(search, best=again, rounded=again))
    )
    assert table is not None
    names = [row[0].text for row in table.rows]
    assert sum("chosen" in name for name in names) == 1
    assert names[0] == (
        "Start, also the joint optimum, also the joint optimum, rounded to the workshop’s steps – chosen"
    )
    assert table.rows[0][1].tone == "strong"


def test_noise_about_zero_is_zero(content: ReportContent) -> None:
    """Catches "-2.776e-11 mm" at a bound of zero."""
    search = _search(content)
    key = next(iter(search.start.values))
    noisy = dataclasses.replace(search.start, values={**search.start.values, key: -2.776e-14})
    objective = content.spec.study.objective
    assert objective is not None
    table = study_tables.history(content, dataclasses.replace(search, history=(noisy,)), objective)
    assert float(table.rows[0][1].text) == 0
    assert "−" not in table.rows[0][1].text


@pytest.mark.parametrize("count, words", [(1, "1 of 2 requirements is not met: "), (2, "2 of 2 requirements are not")])
def test_one_requirement_is_and_two_are(content: ReportContent, count: int, words: str) -> None:
    checks = [dataclasses.replace(check, satisfied=k >= count) for k, check in enumerate(content.design_checks)]
    given = dataclasses.replace(content, search=None, checks=tuple(checks))
    assert story.reached(given).text.startswith(words)


def test_warnings_stand_under_the_verdict(content: ReportContent) -> None:
    """Catches a design with magnets too hot that the page calls plainly good."""
    told = "At this temperature 12 % of the magnets’ volume is beyond its intrinsic coercivity."
    hot = dataclasses.replace(_chosen(content).evaluation, warnings=(told,))
    warned = dataclasses.replace(
        content, chosen=hot, checked=(told,), flux_map=None, start_flux_map=None, sweeps=(), slots=None, assembly=None
    )
    assert story.reached(content).tone == "good"
    assert story.reached(warned).text == "Both requirements are met, but with a warning."
    assert story.reached(warned).tone == "warn"
    page = render(warned)
    assert page.count(told) == 1
    assert page.index('class="verdict') < page.index(told) < page.index('class="first"')


def test_rounding_says_what_it_left(content: ReportContent) -> None:
    """Catches "no requirement is at its limit" where the optimum stood at one before it was rounded."""
    search, chosen = _search(content), _chosen(content)
    at_limit = tuple(dataclasses.replace(item, active=item.limit.subject == "stray_field") for item in chosen.checks)
    stray = next(item for item in chosen.checks if item.limit.subject == "stray_field")
    roomy = tuple(
        dataclasses.replace(stray, margin=0.00173, satisfied=True, active=False) if item is stray else item
        for item in chosen.checks
    )
    best = dataclasses.replace(chosen, checks=at_limit, values={key: v * 1.001 for key, v in chosen.values.items()})
    rounded = dataclasses.replace(chosen, checks=roomy)
    found = dataclasses.replace(content, search=dataclasses.replace(search, best=best, rounded=rounded))
    assert story.active(found) == (
        "Rounding to the workshop’s steps left 0.17\u00a0% of the limit on the stray field unused."
    )


def test_a_safety_without_a_load_is_met_and_not_left_unused(content: ReportContent) -> None:
    """Catches "100 % of the limit unused" and "could not be checked" for a rod that is pulled and cannot buckle."""
    search, chosen = _search(content), _chosen(content)
    limit = Limit("buckling_safety", ">=", 3.0)
    idle, bound = Check(limit, None, 1.0, True, False), Check(limit, 3.0, 0.0, True, True)
    assert study_tables.verdict(content.spec, idle).text == "✓ met, without load"
    best = dataclasses.replace(chosen, checks=(bound,), values={key: v * 1.001 for key, v in chosen.values.items()})
    rounded = dataclasses.replace(chosen, checks=(idle,))
    found = dataclasses.replace(content, search=dataclasses.replace(search, best=best, rounded=rounded))
    assert story.active(found) == "Rounding left the buckling safety without a load."
    assert story.reached(found).text == "The requirement is met."
    room = Limit("winding_room", ">=", 0.0, scale=4e-4)
    at_zero = dataclasses.replace(best, checks=(Check(room, 0.0, 0.0, True, True),))
    roomy = dataclasses.replace(rounded, checks=(Check(room, 1e-5, 0.025, True, False),))
    zero = dataclasses.replace(content, search=dataclasses.replace(search, best=at_zero, rounded=roomy))
    assert story.active(zero) == (
        "Rounding to the workshop’s steps left 0.01\u00a0mm to the limit on the winding room unused."
    )


def test_the_nearest_step_is_named_where_it_breaks_a_limit(content: ReportContent) -> None:
    """Catches a rounded design some steps from the optimum without a word why."""
    search, chosen = _search(content), _chosen(content)
    ring, yoke = chosen.values
    broken = tuple(dataclasses.replace(item, satisfied=item.limit.subject != "stray_field") for item in chosen.checks)
    near = dataclasses.replace(chosen, values={ring: 2.5e-3, yoke: 0.8e-3}, checks=broken)
    best = dataclasses.replace(chosen, values={ring: 2.49e-3, yoke: 0.81e-3})
    found = dataclasses.replace(search, best=best, rounded=chosen, history=(*search.history, near))
    text = story.active(dataclasses.replace(content, search=found))
    assert "ring width 2.5\u00a0mm and back yoke thickness 0.8\u00a0mm, breaks the limit on the stray field" in text
    unseen = dataclasses.replace(found, history=search.history)
    assert "nearest" not in story.active(dataclasses.replace(content, search=unseen))


def test_effort_and_failures(content: ReportContent) -> None:
    """Catches the seconds of a run that read most designs from a file, and failed designs that nobody mentions."""
    search = _search(content)
    assert tried.effort(search) == "30 designs by finite elements in 41 s."
    again = dataclasses.replace(search, reused=20)
    assert tried.effort(again) == "30 designs by finite elements, 20 of them from an earlier run."
    lost = [failure("fem", NOT_CONVERGED, f"At z = {z} mm: no convergence.") for z in (24, 25.5)]
    history = (*search.history, *(dataclasses.replace(search.start, evaluation=item) for item in lost))
    text = tried.failures(dataclasses.replace(search, history=history))
    assert text.startswith("3 of 32 designs have no result: At z = 24 mm: no convergence (2 of them); The field did")
    assert tried.failures(dataclasses.replace(search, history=(search.start,))) == ""


def test_an_outlier_does_not_flatten_the_search(content: ReportContent) -> None:
    """Catches axes stretched by one design that breaks a limit, and one that is clipped without a mark."""
    search, objective = _search(content), content.spec.study.objective
    assert objective is not None
    wild = dataclasses.replace(search.history[0], objective=900.0, values=dict.fromkeys(search.history[0].values, 9.0))
    wild = dataclasses.replace(wild, checks=tuple(dataclasses.replace(c, satisfied=False) for c in wild.checks))
    found = dataclasses.replace(
        search, history=(*search.history, wild), best_so_far=(*search.best_so_far, search.best_so_far[-1])
    )
    history = search_curves.convergence_curve(content.spec, found, objective)
    plane = search_curves.search_path(content.spec, found, content.one_at_a_time)
    assert history is not None
    assert plane is not None
    assert re.search(r"beyond the axis \(\d+\)", history.markup)
    assert not re.search(r">\s*[2-9]00\s*<", history.markup)
    assert "beyond" in plane.caption
    assert not re.search(r">\s*[2-9]000\s*<", plane.markup)


def test_maps_share_their_flux_step(content: ReportContent) -> None:
    """Catches two maps side by side whose line densities cannot be compared."""

    def scaled(factor: float) -> FluxMap:
        assert content.flux_map is not None
        return dataclasses.replace(content.flux_map, flux=np.asarray(content.flux_map.flux * factor))

    step = flux_picture.flux_step(scaled(1.0), scaled(0.5), None)
    assert step == flux_picture.flux_step(scaled(1.0))
    assert step == pytest.approx(np.ptp(scaled(1.0).flux) / flux_picture.LINES, rel=0.3)
    assert flux_picture.flux_step(scaled(0.0)) > 0
    assert re.fullmatch(r"[\d.]+\u00a0µWb", flux_picture.flux_between(step))


def test_every_figure_has_a_meaning() -> None:
    """Catches a definition with the source's spelling of symbols."""
    for name in FIGURES:
        assert meaning(name)[0].isupper() or not meaning(name)[0].isalpha()
        assert not re.search(r"\b(tau|pi|lambda)\b|\^", meaning(name))
    assert "not the peak" in meaning("ring_flux_density")
