"""Optima, sensitivities, fronts and tolerances on the page: signs, units, and the words that carry them."""

from __future__ import annotations

import dataclasses
import math
import re

import pytest

from fluxbore.design.performance import FIGURES, Performance, grouped
from fluxbore.design.spec import loads
from fluxbore.design.spec_file import template
from fluxbore.design.study import Objective, Production, Tolerance
from fluxbore.optimize.evaluation import OK, Evaluation, Norm
from fluxbore.optimize.outcome import Check, Clash, Conflict, Limit, Multiplier, Optimality
from fluxbore.optimize.pareto_result import FrontPoint, ParetoResult
from fluxbore.optimize.tolerance_result import (
    FigureSpread,
    Interval,
    Reject,
    Requirement,
    RobustResult,
    RobustRound,
    ToleranceEffect,
    ToleranceResult,
)
from fluxbore.reports import figure_tables, front, optimum, sensitivity, study_curves, study_tables, tolerances
from fluxbore.reports.content import ReportContent
from fluxbore.reports.figure_sources import SOURCES, assumptions, source_text
from fluxbore.reports.kind_words import COILS, HYBRID, PLAIN
from fluxbore.reports.page import render
from fluxbore.reports.tables import Table

RING, YOKE = "actuator.mover.ring_width", "actuator.back_yoke.thickness"
FORCE, MASS = Objective("force_constant", True), Objective("total_mass", False)


def cells(table: Table, label: str) -> list[str]:
    """The texts of the row under this label."""
    (row,) = [row for row in table.rows if row[0].text.replace("\u00a0", " ").startswith(label)]
    return [cell.text.replace("\u00a0", " ") for cell in row]


@pytest.fixture(scope="module")
def optimality() -> Optimality:
    return Optimality(
        2.5e-5,
        (
            Multiplier("stray_field", "<=", 4.2e-4, 4.2e-4, 50.0, 0.002),
            Multiplier(YOKE, ">=", 5e-4, 5e-4, -400.0, 0.02),
            Multiplier(RING, "<=", 6e-3, 6e-3, 30.0, 0.02, bound=True),
            Multiplier("total_mass", "<=", 0.85, 0.85, 0.0, 0.0),
        ),
    )


@pytest.fixture(scope="module")
def pareto(content: ReportContent) -> ParetoResult:
    assert content.search is not None
    start, made = content.search.start, content.search.chosen
    assert made is not None
    points = (
        FrontPoint(0.0, None, made, 14.0, 0.90, "front", "Converged.", 1e-5, 5.0, 12),
        FrontPoint(0.5, 0.7, made, 12.0, 0.70, "front", "Converged.", 1e-5, 20.0, 9),
        FrontPoint(0.8, 0.5, None, None, None, "failed", "No design meets every limit.", None, None, 4),
        FrontPoint(1.0, None, made, 7.0, 0.45, "front", "Converged.", None, None, 7),
    )
    return ParetoResult(
        FORCE, MASS, "epsilon constraint", start, points, (start,) * 32, (7.0, 0.9), 0.61, "The front is done.", 21.0
    )


@pytest.fixture(scope="module")
def production(content: ReportContent) -> ToleranceResult:
    nominal = content.chosen
    assert nominal is not None
    ring, yoke = Tolerance(RING, -5e-5, 5e-5, "normal"), Tolerance(YOKE, -2e-5, 3e-5, "uniform")
    stray, own = Limit("stray_field", "<=", 0.0213), Limit(YOKE, ">=", 5e-4)
    share = Interval(0.796, 0.78, 0.81)
    spread = FigureSpread(
        "stray_field", 0.021, 0.0211, 2e-4, 0.0203, 0.0219, {RING: 1.0, YOKE: 2.0}, {RING: 0.3, YOKE: 0.7}, True, {}
    )
    return ToleranceResult(
        production=Production((ring, yoke)),
        values={RING: 2.4e-3, YOKE: 8e-4},
        held=("actuator.winding.turns",),
        nominal=nominal,
        figures=(spread, dataclasses.replace(spread, subject=YOKE, nominal=8e-4, mean=8e-4, sigma=1e-5)),
        requirements=(
            Requirement(stray, 0.021, -0.7, 0.8, share, 0.2),
            Requirement(own, 8e-4, math.inf, 1.0, Interval(1.0, 0.99, 1.0), 0.0),
        ),
        simulated=share,
        examined=10_000,
        effects=(ToleranceEffect(yoke, 0.95, 0.154, (0.7, 1.0)), ToleranceEffect(ring, 0.79, -1e-4, (3e-12, 0.0))),
        rejects=(Reject("The winding does not fit.", 17),),
        evaluations=13,
    )


def test_prices_give_room_in_the_limits_own_direction(content: ReportContent, optimality: Optimality) -> None:
    """50 N/A per tesla at a limit of 0.42 mT: 0.01 mT more is 0.0005 N/A; a lower limit gives way downwards."""
    assert content.search is not None
    search = dataclasses.replace(content.search, optimality=optimality)
    table = optimum.prices(content.spec, search, FORCE)
    assert table is not None
    assert cells(table, "Stray field at most")[2:4] == ["+0.01 mT", "+5.00·10⁻⁴ N/A"]
    assert cells(table, "Back yoke thickness at least")[2:4] == ["−0.01 mm", "+0.004 N/A"]
    assert cells(table, "Ring width at most 6 mm, its own bound")[3:] == ["+0.003 N/A", "0.02 % (1 % of its range)"]
    assert cells(table, "Total mass")[3] == "nothing"
    text = optimum.residual(search, FORCE)
    assert "2.5·10⁻⁵" in text
    assert "rounded" not in text
    rounded = dataclasses.replace(search, rounded=dataclasses.replace(content.search.start, checks=()))
    assert "before it was rounded" in optimum.residual(rounded, FORCE)
    assert optimum.residual(content.search, FORCE) == ""
    free = dataclasses.replace(search, optimality=Optimality(1e-6, ()))
    assert optimum.prices(content.spec, free, FORCE) is None
    assert "No limit and no bound costs anything" in optimum.residual(free, FORCE)


def test_a_conflict_says_who_clashes_and_by_how_much(content: ReportContent) -> None:
    """Catches a bound's weight shown as a share, and a miss without its unit."""
    clashes = (
        Clash("stray_field", "<=", 4e-4, 4.5e-4, 5e-5, 0.125, 0.6, 8e-5),
        Clash(RING, "<=", 2e-3, 2e-3, 0.0, 0.0, 0.4, 3e-4, True),
    )
    text, table = optimum.conflict(content.spec, Conflict({RING: 2e-3}, 0.125, clashes))
    assert "as far as the search went" in text
    assert "ring width 2\u00a0mm" in text
    assert "12.5\u00a0%" in text
    assert cells(table, "Stray field")[2:] == ["0.05 mT (12.5 %)", "60 %", "0.08 mT"]
    assert cells(table, "Ring width")[2:] == ["–", "–", "0.3 mm"]


def test_nothing_is_a_share_of_a_limit_of_zero(content: ReportContent) -> None:
    """Catches per cents of the start's value, which stand for per cents of the limit."""
    room = Limit("winding_room", ">=", 0.0, scale=4e-4)
    broken = study_tables.verdict(content.spec, Check(room, -1e-5, -0.025, False, False))
    assert broken.text.replace("\u00a0", " ") == "✗ broken by 0.01 mm"
    clash = Clash("winding_room", ">=", 0.0, -1e-5, 1e-5, 0.025, 1.0, 1e-5, scale=4e-4)
    text, table = optimum.conflict(content.spec, Conflict({RING: 2e-3}, 0.025, (clash,)))
    assert "still misses the worst of them by 0.01\u00a0mm." in text
    assert cells(table, "Winding room")[2:] == ["0.01 mm", "100 %", "0.01 mm"]
    assert content.search is not None
    price = Multiplier("winding_room", ">=", 0.0, 0.0, 400.0, 0.02)
    prices = optimum.prices(
        content.spec, dataclasses.replace(content.search, optimality=Optimality(1e-6, (price,))), FORCE
    )
    assert prices is not None
    assert cells(prices, "Winding room")[2:] == ["−1 mm", "−0.4 N/A", "–"]


def test_sensitivities_are_per_unit_people_use(content: ReportContent) -> None:
    """-302 N/A per metre is -0.302 N/A per millimetre; the norm stands beside the true maximum; noise is zero."""
    assert content.chosen is not None
    slopes = {
        "force_constant": {RING: -302.0, YOKE: 1e-9},
        "stray_field": {RING: -0.4, YOKE: -1.5},
        "winding_temperature": {RING: 1000.0, YOKE: 0.0},
        "total_mass": {RING: 5.0, YOKE: 60.0},
        "length": {RING: -1e-13, YOKE: 0.0},
    }
    figures = dataclasses.replace(content.chosen.performance, winding_temperature=373.15)
    design = dataclasses.replace(
        content.chosen, performance=figures, gradient=slopes, norms={"stray_field": Norm(8.0, 0.02)}
    )
    found = sensitivity.sensitivities(dataclasses.replace(content, chosen=design))
    assert found is not None
    assert found.rest is None
    assert found.main.head[2:] == ("Ring width τ_f, per mm", "Back yoke thickness, per mm")
    assert cells(found.main, "Force constant")[2:] == ["−0.302 N/A", "0"]
    assert cells(found.main, "Winding temperature")[1:] == ["100.0 °C", "+1 K", "0"]
    assert cells(found.main, "Total mass")[2:] == ["+5 g", "+60 g"]
    assert cells(found.main, "Stray field")[1].endswith("(8-norm 20.00 mT)")
    assert cells(found.main, "Stray field")[2:] == ["−0.4 mT", "−1.5 mT"]
    assert found.notes[-1] == "None of them moves overall length."
    assert [title for _, title in found.main.sections] == [
        "Force",
        "Magnetic field",
        "Losses and heat",
        "Size and mass",
    ]
    assert sensitivity.sensitivities(content) is None


def test_of_many_figures_the_asked_for_stand_open(content: ReportContent) -> None:
    """Catches the objective or a limit's figure folded away among sixty others."""
    assert content.chosen is not None
    every = dataclasses.replace(content.chosen, gradient={name: {RING: 1.0} for name in FIGURES})
    found = sensitivity.sensitivities(dataclasses.replace(content, chosen=every))
    assert found is not None
    assert found.rest is not None
    assert len(found.main.rows) + len(found.rest.rows) == len(FIGURES)
    open_ = {row[0].text for row in found.main.rows}
    assert {"Force constant", "Stray field", "Yoke flux density", "Winding resistance"} <= open_
    assert "Hoop stress" not in open_


def test_a_front_says_what_a_step_costs(content: ReportContent, pareto: ParetoResult) -> None:
    """20 N/A per kg is 0.2 N/A for 10 g; points that were not found keep their reason."""
    table = front.table(content.spec, pareto)
    assert cells(table, "2")[1:4] == ["12.000", "700.0", "+0.2 N/A per 10 g"]
    assert "No design meets every limit." in cells(table, "3")[-1]
    text = " ".join(front.sentences(pareto, HYBRID)).replace("\u00a0", " ")
    assert text.startswith("Largest force constant against smallest total mass")
    assert "goes from 14.000 N/A to 7.000 N/A, the total mass from 900.0 g to 450.0 g" in text
    assert "10 g more total mass moves the force constant by +0.2 N/A at 700.0 g and by +0.05 N/A at 900.0 g" in text
    same = dataclasses.replace(pareto, points=pareto.points[:1], conflicting=False, hypervolume=None)
    assert "do not conflict" in " ".join(front.sentences(same, HYBRID))
    drawn = study_curves.front_curve(pareto, content.search.chosen if content.search else None)
    assert drawn is not None
    assert "front of 3 designs" in drawn.alt
    assert "total mass (g)" in drawn.markup
    assert study_curves.front_curve(dataclasses.replace(pareto, points=pareto.points[2:3]), None) is None


def test_tolerances_say_what_hurts_most(content: ReportContent, production: ToleranceResult) -> None:
    """Catches a yield without its interval, a gain that is noise, and an infinite margin printed as inf."""
    spec = content.design_spec
    text = " ".join(tolerances.sentences(spec, production)).replace("\u00a0", " ")
    assert text.startswith("79.6 % (78 to 81 %) of the actuators")
    assert "The tolerance of the back yoke thickness hurts most: half of it would raise the yield to 95 %" in text
    assert "17 cannot be made, such as: The winding does not fit." in text
    limits = tolerances.requirements(spec, production)
    assert limits is not None
    assert cells(limits, "Stray field")[3:] == [
        "−0.7",
        "79.6 % (78 to 81 %)",
        "20 points",
    ]
    assert cells(limits, "Back yoke thickness")[3] == "does not scatter"
    assert cells(limits, "Back yoke thickness")[5] == "nothing"
    listed = tolerances.tolerances(spec, production)
    assert listed is not None
    assert cells(listed, "Back yoke thickness")[2:6] == ["+0.03 mm / −0.02 mm", "uniform", "95 %", "+15.4 points"]
    assert cells(listed, "Ring width")[2] == "±0.05 mm"
    assert cells(listed, "Ring width")[6] == "0.0 %"
    scatter = tolerances.spreads(spec, production)
    assert scatter is not None
    assert cells(scatter, "Stray field")[-1] == "back yoke thickness, 70 %"
    assert scatter.sections[-1][1] == "Dimensions"
    bars = study_curves.tolerance_bars(spec, production)
    assert bars is not None
    assert bars.alt.index("back yoke thickness 15.4") < bars.alt.index("ring width")


def test_a_robust_search_tells_its_price(content: ReportContent, production: ToleranceResult) -> None:
    """Catches a price without its unit, and the limits that were not moved crowding out those that were."""
    assert content.search is not None
    stray, own = Limit("stray_field", "<=", 0.0213), Limit(YOKE, ">=", 5e-4)
    steps = (
        RobustRound((stray, own), content.search, production, 9.0),
        RobustRound((dataclasses.replace(stray, limit=0.0209), own), content.search, production, 8.9),
        RobustRound((dataclasses.replace(stray, limit=0.02), own), content.search, None, None, "No design was found."),
    )
    found = RobustResult(0.95, steps, 1, True, 0.1, "The yield is reached.")
    table = tolerances.rounds(content.spec, found)
    assert len(table.head) == 4
    assert cells(table, "2 – chosen")[2] == "8.900"
    assert cells(table, "3")[-1] == "No design was found."
    assert "0.1\u00a0N/A of force constant" in " ".join(tolerances.robust_sentences(content.spec, found))


def test_figures_stand_under_headings_with_their_sources(content: ReportContent) -> None:
    """Catches a source for a figure that is no more, and an assumption that the specification has meanwhile given."""
    assert set(SOURCES) <= set(FIGURES)
    table, meant = figure_tables.comparison(content), figure_tables.meanings(content)
    assert table is not None
    assert meant is not None
    assert len(table.rows) == len(meant.rows) == sum(len(rows) for _, rows in table.bodies)
    names = [name for name in FIGURES if content.chosen and getattr(content.chosen.performance, name) is not None]
    assert [title for _, title in table.sections] == [group for group, _ in grouped(names)]
    assert source_text("back_emf") == "2/3 K v"
    assert source_text("length") == ""
    assert "emissivity" in "".join(SOURCES["winding_temperature"].rests_on)
    spec = loads(template("ipehla"))
    assert "emissivity 0.1 (default)" in assumptions(spec, "winding_temperature")
    painted = spec.with_values({"actuator.back_yoke.emissivity": 0.9})
    assert "emissivity" not in assumptions(painted, "winding_temperature")
    assert assumptions(spec, "voltage_margin").replace("\u00a0", " ") == "supply voltage 24 V"
    assert "hysteresis" in assumptions(spec, "iron_loss")


def test_a_whole_page_with_every_section(
    content: ReportContent, optimality: Optimality, pareto: ParetoResult, production: ToleranceResult
) -> None:
    """Catches a section that the template forgets, and one that says nan, inf or None."""
    assert content.search is not None
    assert content.chosen is not None
    search = dataclasses.replace(content.search, optimality=optimality, algorithm="SLSQP", network_calls=120)
    chosen = dataclasses.replace(content.chosen, gradient={"force_constant": {RING: 1.0, YOKE: 2.0}}, norms={})
    full = dataclasses.replace(
        content, search=search, chosen=chosen, front=pareto, tolerance=production, sweeps=(), flux_map=None,
        start_flux_map=None, slots=None, assembly=None,
    )  # fmt: skip
    page = render(full)
    for name in ("search", "sensitivities", "front", "tolerances", "figures"):
        assert f'id="{name}"' in page
        assert f'href="#{name}"' in page
    text = re.sub(r"<style>.*?</style>|<[^>]+>", " ", page, flags=re.DOTALL)
    assert "Algorithm: SLSQP. The magnetic network was called 120 times besides." in text
    assert not re.search(r"\b(None|nan|inf)\b", text)


def test_coils_are_not_called_a_machine(content: ReportContent) -> None:
    """Catches the words of one kind of actuator on the page of another."""
    figures = Performance(stored_energy=1.8e8, stray_flux_density=9e-4, total_mass=81194.0, merit=0.0883)
    page = render(ReportContent(spec=content.spec, start=Evaluation("fem", OK, (), figures), words=COILS))
    text = re.sub(r"<style>.*?</style>|<[^>]+>", " ", page, flags=re.DOTALL)
    assert "Every figure by the exact field in air" in text
    assert "81194" in text
    for word in ("finite elements", "FEM", "Force over position", "equation (2)", "seal fin"):
        assert word not in text
    assert 'id="field"' not in page
    for kind in (HYBRID, COILS, PLAIN):
        assert set(kind.headlines) | set(kind.main) <= set(FIGURES)
        assert all(sentence.endswith(".") for sentence in kind.not_checked)
    assert HYBRID.not_checked
    assert set(HYBRID.not_checked).isdisjoint(COILS.not_checked)


def test_the_first_screen_tells_each_requirement_the_broken_first(content: ReportContent) -> None:
    """Catches a mark without its value, and a broken requirement below six that are met."""
    checks = (
        Check(Limit("force_constant", ">=", 8.0), 8.7, 0.09, True, False),
        Check(Limit("total_mass", "<=", 0.5), 0.55, -0.1, False, False),
        Check(Limit("shaft_safety", ">=", 2.0), None, 1.0, True, False),
    )
    found = study_tables.verdicts(ReportContent(spec=content.spec, start=content.start, checks=checks))
    assert [cell.text.replace("\u00a0", " ") for cell in found] == [
        "✗ Total mass 550.0 g, at most 500.0 g",
        "✓ Force constant 8.700 N/A, at least 8.000 N/A",
        "✓ Shaft safety, at least 2",
    ]
    assert [cell.tone for cell in found] == ["bad", "good", "good"]
