"""The report's sections on an electro-hydrostatic actuator: what they say follows from the figures."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hydrostatic_limits import CORD

from fluxbore.design.hydrostatic_range import LIMITS, demand, largest_amplitude
from fluxbore.design.spec import Spec, load
from fluxbore.hydrostatic_views import assembly, hydraulics
from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.hydrostatic_common import weighed
from fluxbore.report_content import part_rows
from fluxbore.reports import hydrostatic, hydrostatic_parts_tables
from fluxbore.reports.content import ReportContent
from fluxbore.reports.hydrostatic_content import HydraulicsContent, Tracked
from fluxbore.reports.kind_words import HYDROSTATIC
from fluxbore.reports.page import render
from fluxbore.reports.tables import Table

SPEC = load(Path(__file__).parents[2] / "examples" / "prehydra.toml")


def plain(page: str) -> str:
    """The page's words alone."""
    text = re.sub(r"<(style|svg).*?</\1>", " ", page, flags=re.DOTALL)
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", "", text)).replace("\u00a0", " ")


def words(*texts: str) -> str:
    return " ".join(texts).replace("\u00a0", " ")


def cells(table: Table | None) -> dict[str, tuple[str, ...]]:
    assert table is not None
    return {row[0].text: tuple(cell.text.replace("\u00a0", " ") for cell in row[1:]) for row in table.rows}


def shown(spec: Spec) -> tuple[Evaluation, HydraulicsContent]:
    design = evaluate(spec, "fem")
    content = hydraulics(spec, design)
    assert content is not None
    return design, content


@pytest.fixture(scope="module")
def found() -> tuple[Evaluation, HydraulicsContent]:
    return shown(SPEC)


@pytest.fixture(scope="module")
def content(found: tuple[Evaluation, HydraulicsContent]) -> HydraulicsContent:
    return found[1]


@pytest.fixture(scope="module")
def tracked(content: HydraulicsContent) -> Tracked:
    assert content.tracked is not None
    return content.tracked


def test_the_page_has_every_section(found: tuple[Evaluation, HydraulicsContent]) -> None:
    design, content = found
    parts = part_rows(SPEC, assembly(SPEC))
    page = render(
        ReportContent(
            spec=SPEC,
            start=design,
            start_network=evaluate(SPEC, "network"),
            words=HYDROSTATIC,
            hydraulics=content,
            parts=parts,
            not_checked=HYDROSTATIC.not_checked,
        )
    )
    for name in ("range", "power", "force", "figures", "parts", "checks"):
        assert page.count(f'id="{name}"') == 1, name
        assert f'href="#{name}"' in page
    text = plain(page)
    assert "It lies within every limit." in text
    assert "by both routes" in text
    assert "Closed forms against simulated" in text
    assert "Inertia of the fluid and leakage past the seals" in text
    assert "a common rate of the real-time target that was used" in text  # an assumption of the specification
    assert "differs from the model" not in text
    assert "finite element" not in text


def test_what_was_designed_is_no_longer_assumed(found: tuple[Evaluation, HydraulicsContent]) -> None:
    """The start's wall was assumed; the chosen one is the search's."""
    wall, hose = "actuator.output_cylinder.wall_thickness", "actuator.hose.roughness"
    content = ReportContent(spec=SPEC, start=found[0], words=HYDROSTATIC)
    designed = replace(content, chosen_spec=SPEC.with_values({wall: 0.6e-3}), chosen=found[0])
    for page, listed in ((render(content), True), (render(designed), False)):
        assert (f"<code>{wall}</code>" in page) == listed
        assert f"<code>{hose}</code>" in page


def test_the_range_s_limits_are_those_of_single_forces(content: HydraulicsContent) -> None:
    """The least of the lines, drawn between points of a grid, against a search at its own frequency."""
    limits = content.range
    assert limits is not None
    assert set(limits.limits) == set(LIMITS)
    for at in (0, len(limits.frequencies) // 2, len(limits.frequencies) - 3):
        least = min(values[at] for values in limits.limits.values())
        exact, _ = largest_amplitude(content.actuator, float(limits.frequencies[at]), content.point.least)
        assert least == pytest.approx(exact, rel=0.03)
    speed = limits.limits["speed"] * limits.frequencies
    inside = limits.limits["speed"] < limits.amplitudes[1]
    assert speed[inside] == pytest.approx(content.figures.force_frequency_limit, rel=1e-3)


def test_the_limits_table_is_the_figures(content: HydraulicsContent) -> None:
    rows = cells(hydrostatic.demand_table(content))
    assert content.figures.speed_load == pytest.approx(content.demand.speed)
    for name in LIMITS:
        assert float(rows[name.capitalize()][1].split()[0]) == pytest.approx(
            100 * getattr(content.demand, name), rel=5e-3
        )


def test_what_a_port_has_more_than_the_next_is_lost_between(tracked: Tracked) -> None:
    """Efforts and flows against the losses, each by its own formulas; up to what is stored within the last periods."""
    lost = dict(tracked.losses)
    net = {row.name: row.sent - row.returned for row in tracked.ports}
    stored = 0.05 * net["motor shaft"]
    pairs = (
        ("screw", "nut", "ball screw"),
        ("nut", "input piston", "input piston"),
        ("input line, first", "input line, second", "input line"),
        ("output line, first", "output line, second", "output line"),
        ("output piston", "return element", "output piston"),
    )
    for first, second, component in pairs:
        assert net[first] - net[second] == pytest.approx(lost[component], abs=stored / 5), component
    whole = sum(lost.values()) - lost["motor winding"]
    assert net["motor shaft"] == pytest.approx(whole, abs=stored)
    assert tracked.imbalance < 1e-6


def test_the_traces_are_the_evaluation_s(found: tuple[Evaluation, HydraulicsContent], tracked: Tracked) -> None:
    design, _ = found
    error = np.abs(tracked.reference - tracked.force).max()
    assert design.performance.tracking_error is not None
    assert 0.5 * design.performance.tracking_error < error <= design.performance.tracking_error * (1 + 1e-9)
    assert design.performance.peak_pressure is not None
    assert tracked.pressures.max(axis=0)[2] <= design.performance.peak_pressure * (1 + 1e-9)
    periods = tracked.time[-1] / tracked.period
    assert periods == pytest.approx(round(periods), abs=1e-6)


def test_the_masses_are_the_model_s(content: HydraulicsContent) -> None:
    rows = hydrostatic_parts_tables.components(content)
    assert sum(mass for _, mass, _, _ in rows) == pytest.approx(content.figures.total_mass, rel=1e-12)
    assert sum(worn for _, _, worn, _ in rows) == pytest.approx(content.figures.distal_mass, rel=1e-12)
    text = words(*hydrostatic_parts_tables.mass_text(content))
    assert "No mass is told of" in text or all(mass > 0 for name, mass, _, _ in rows if name != "other at the joint")


def test_margins_and_gland(content: HydraulicsContent) -> None:
    rows = cells(hydrostatic_parts_tables.margins(content))
    column = rows["Rod as a column over the stroke, fixed and free"]
    assert float(column[2]) == pytest.approx(content.figures.buckling_safety, rel=5e-3)
    (tube,) = (row for name, row in rows.items() if name.startswith("Tube of"))
    assert float(tube[2]) == pytest.approx(content.figures.burst_factor, rel=5e-3)
    assert cells(hydrostatic_parts_tables.gland(content.gland))["Squeeze"] == ("14 %", "10 to 25 %", "yes")
    loose = replace(content.gland, groove_diameter=content.gland.groove_diameter - 0.3e-3)
    assert cells(hydrostatic_parts_tables.gland(loose))["Squeeze"][2] == "no"


def test_a_point_beyond_the_speed_is_told(content: HydraulicsContent) -> None:
    fast = replace(content.point, frequency=5.0)
    asked = demand(content.actuator, fast.amplitude, fast.frequency, fast.least)
    text = words(*hydrostatic.range_text(replace(content, point=fast, demand=asked)))
    assert "It lies beyond the limit of the speed, and cannot be made as asked." in text


def test_a_rubber_cord_s_words(content: HydraulicsContent) -> None:
    cord = weighed(SPEC.with_values(CORD))
    text = words(*hydrostatic.return_text(replace(content, actuator=cord)))
    assert "goes from 1.3 to 2.06 times its length" in text
    assert "Its stiffness goes from 1.528 N/mm to 0.9825" in text


def test_a_constant_force_has_no_range() -> None:
    """And its page has what is known all the same: force, strength, gland and masses."""
    design, content = shown(SPEC.with_values({"actuator.return_spring.element": "constant force"}))
    assert not design.ok
    section = hydrostatic.section(content, SPEC)
    assert section["map"] is None
    assert section["demand"] is None
    assert section["ports"] is None
    assert "a constant force is the same wherever the piston stands" in section["untracked"]
    assert "there is no other force to choose" in words(*section["range"])
    assert "takes 2.802 bar in the output cylinder" in words(*section["fluid"])
    assert "operating point" not in words(*section["fluid"], *section["force"], section["return_curve"].caption)
