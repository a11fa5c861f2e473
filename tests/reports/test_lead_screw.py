"""The report's sections on a lead screw: words that follow the figures, pictures that show them."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fluxbore.design.back_iron import back_iron_cases
from fluxbore.design.helical_field import force_series
from fluxbore.design.performance import Performance
from fluxbore.design.spec import load
from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.lead_screw_field import magnetised
from fluxbore.optimize.pitch_curve import PITCH, PitchCurve, PitchPoint
from fluxbore.reports import lead_screw, lead_screw_curves, lead_screw_pitch
from fluxbore.reports.content import FluxMap, ReportContent
from fluxbore.reports.kind_words import LEAD_SCREW
from fluxbore.reports.lead_screw_content import ScrewContent, SpringSample
from fluxbore.reports.page import render
from fluxbore.reports.wording import difference, figure_scale, key_label, scale, subject_measure

SPEC = load(Path(__file__).parents[2] / "examples" / "rotlin.toml")
DESIGN = replace(evaluate(SPEC, "network"), fidelity="fem")


def a_map(place: float) -> FluxMap:
    """A wave that no screw has, over two pitches."""
    pitch = SPEC.number(PITCH)
    r, z = (grid.ravel() for grid in np.meshgrid(np.linspace(9e-3, 27e-3, 10), np.linspace(-pitch, 2 * pitch, 25)))
    corner = np.array([i * 10 + j for i in range(24) for j in range(9)])
    triangles = np.concatenate([corner[:, None] + [0, 1, 10], corner[:, None] + [1, 11, 10]])
    box = np.array([(15e-3, 0.0), (17e-3, 0.0), (17e-3, pitch / 2), (15e-3, pitch / 2)])
    flux = 1e-5 * np.sin(2 * np.pi * (z - place) / pitch) * r / 27e-3
    return FluxMap(r, z, triangles, flux, 1 + np.cos(z[triangles].mean(axis=1)), (("magnets, north", box),), place)


def a_curve(pitches: tuple[float, ...] = (3.2e-3, 5.384e-3, 9e-3)) -> PitchCurve:
    own = SPEC.number(PITCH)
    points = [PitchPoint(p, 2 * p, evaluate(SPEC.with_values({PITCH: p}), "network")) for p in sorted({*pitches, own})]
    return PitchCurve(PitchPoint(own, 2 * own, DESIGN), tuple(points), tuple(points[:1]), "Too short.", "")


@pytest.fixture(scope="module")
def screw() -> ScrewContent:
    built = magnetised(SPEC)
    spring = force_series(built)
    places = (0.0, spring.pitch / 8, spring.pitch / 4)
    samples = tuple(SpringSample(place, float(spring.force(place))) for place in places)
    cases = back_iron_cases(built, 192.0)
    maps = a_map(0.0), a_map(spring.pitch / 4)
    ends = (-48e-3, 48e-3)
    return ScrewContent(
        built,
        spring,
        spring,
        samples,
        spring.peak,
        spring.barrier,
        *maps,
        ends,
        (0.0, 0.0),
        70e-3,
        cases,
        192.0,
        a_curve(),
    )


@pytest.fixture(scope="module")
def page(screw: ScrewContent) -> str:
    return render(ReportContent(spec=SPEC, start=DESIGN, start_network=DESIGN, words=LEAD_SCREW, screw=screw))


def plain(page: str) -> str:
    """The page's words alone."""
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", "", re.sub(r"(?s)<style>.*?</style>", "", page)))


def test_page_has_its_sections_and_leads_to_them(page: str) -> None:
    for name in ("spring", "pitch", "field", "checks"):
        assert page.count(f'<section id="{name}"') == 1
        assert f'<li><a href="#{name}">' in page
    for figure in ("force", "energy", "engagement", "pitch", "field"):
        assert f'"screw-{figure}-' in page or f"#screw-{figure}-" in page
    assert page.count("<svg") == 5
    assert not re.search(r"\b(nan|inf)\b", plain(page))
    assert "Newton" not in plain(page)  # the closed form has none


def test_a_page_without_a_field_has_none_of_it() -> None:
    page = render(ReportContent(spec=SPEC, start=DESIGN, words=LEAD_SCREW))
    assert not any(f'id="{name}"' in page or f'href="#{name}"' in page for name in ("spring", "pitch", "field"))


def test_page_tells_spring_slip_and_sudden_load(page: str, screw: ScrewContent) -> None:
    text = plain(page)
    stall = scale("force", [192.0]).quantity(screw.spring.peak[1])
    assert f"stall {stall}".replace("\u00a0", " ") in text
    assert f"largest {stall} at 1.286 mm" in page  # said to whoever cannot see the figure
    for figure in ("sudden_load_limit", "spring_energy", "slip_work", "spring_constant", "natural_frequency"):
        value = getattr(DESIGN.performance, figure)
        number = float(figure_scale(figure, [value]).number(value))
        assert re.search(rf"{number:.4g}0*\s?[A-Za-z]", text), figure


def words(screw: ScrewContent, load_force: float, figures: Performance = DESIGN.performance) -> str:
    return " ".join((*lead_screw.spring(screw, load_force, figures), *lead_screw.overload(screw, load_force, figures)))


def test_words_follow_the_load(screw: ScrewContent) -> None:
    stall, limit = screw.spring.peak[1], DESIGN.performance.sudden_load_limit
    assert limit is not None
    assert "names no load" in words(screw, 0.0)
    assert "each slip" not in words(screw, 0.0)
    below = words(screw, 0.5 * limit)
    assert "displaces it by" in below
    assert "stays below that" in below
    between = words(screw, (limit + stall) / 2)
    assert "displaces it by" in between
    assert "is above that" in between
    assert "holds it nowhere" in words(screw, 1.001 * stall)
    hurried = replace(DESIGN.performance, slip_margin=0.9)
    assert "slips while the motor speeds" in words(screw, 0.5 * limit, hurried)
    assert "slips while the motor speeds" not in below


def test_stall_is_that_of_the_field_where_the_series_misses_it(screw: ScrewContent) -> None:
    place, stall = screw.peak
    sharp = replace(screw, peak=(place, 0.95 * stall))
    drawn = lead_screw_curves.force_curve(sharp, 0.0)
    assert "is out by 5\u00a0%" in drawn.caption
    assert "is out by" not in lead_screw_curves.force_curve(screw, 0.0).caption
    assert scale("force", [stall]).quantity(0.95 * stall) in drawn.alt
    assert "holds it nowhere" in words(sharp, 0.97 * stall)


def test_words_follow_the_friction(screw: ScrewContent) -> None:
    stall, h = screw.spring.peak[1], screw.screw.h
    assert "Every load drives the rotor back" in lead_screw.back_driving(screw, 0.0, 0.0)[0]
    held = lead_screw.back_driving(screw, 0.5 * h * stall, 0.0)
    assert f"{0.5 * stall:.4g}" in held[0]
    assert "No load turns the rotor back" in lead_screw.back_driving(screw, 1.01 * h * stall, 0.0)[0]
    asked = lead_screw.back_driving(screw, 0.0, 100.0)
    assert any(f"{100 * h:.4g}" in text for text in asked)
    assert not any("at standstill" in text for text in lead_screw.back_driving(screw, 0.0, 1.1 * stall))


def test_words_follow_the_stroke(screw: ScrewContent) -> None:
    whole = screw.screw.translator_length - screw.screw.active_length
    assert "whole stroke" in lead_screw.stroke(replace(screw, stroke=whole), 0.0)[0]
    half = replace(screw, stroke=whole + screw.screw.active_length)  # half of the poles hang out at its ends
    text = " ".join(lead_screw.stroke(half, 0.4 * screw.spring.peak[1]))
    assert "50\u00a0% of the stall force" in text
    assert "slips there" not in text
    assert "slips there" in lead_screw.stroke(half, 0.6 * screw.spring.peak[1])[-1]
    out = replace(screw, stroke=screw.screw.translator_length + 2 * screw.screw.active_length)
    assert "slips there" in lead_screw.stroke(out, 0.1 * screw.spring.peak[1])[-1]
    assert "slips there" not in " ".join(lead_screw.stroke(out, 0.0))


def test_pitch_is_judged_at_the_same_length_of_poles() -> None:
    """The largest spring constant lies inside the curve, the largest stall force at its end."""
    force, stiffness, torque, least = lead_screw_pitch.sentences(a_curve())
    assert "the stall force still grows towards 9\u00a0mm" in force
    assert "2.3 poles" in force
    assert "the spring constant is largest at 5.384\u00a0mm" in stiffness
    assert "and the fewer" not in stiffness  # there are 3.8 of them
    assert "still falls towards a pitch of 3.2\u00a0mm" in torque
    assert least == "Below 3.2\u00a0mm: Too short."


def test_pitch_warns_where_the_routes_part(screw: ScrewContent) -> None:
    curve = a_curve()
    stall = DESIGN.performance.stall_force
    assert stall is not None
    weaker = replace(DESIGN, performance=replace(DESIGN.performance, stall_force=0.8 * stall))
    apart = lead_screw_pitch.sentences(replace(curve, design=replace(curve.design, evaluation=weaker)))
    assert any("+25.0\u00a0%" in text and "trust the circles" in text for text in apart)
    assert not any("trust the circles" in text for text in lead_screw_pitch.sentences(curve))
    assert lead_screw_pitch.sentences(replace(curve, network=(), fem=())) == (
        "No other pitch can be built: Too short.",
    )


def test_back_iron_of_the_screw_itself_stands_out(screw: ScrewContent) -> None:
    table = lead_screw.iron(screw)
    assert [row[0].tone for row in table.rows] == ["strong", "", ""]
    assert table.head[-1] == "Remanence for 192 N (T)"
    assert [row[-1].text for row in table.rows] == ["1.2164", "1.2455", "1.2761"]


def test_energy_balance_shows_a_fault(screw: ScrewContent) -> None:
    def balance(content: ScrewContent, design: Evaluation = DESIGN) -> str:
        return lead_screw.seen(content, design)[-1]

    assert "±0\u00a0%" in balance(screw)
    assert "+11.1\u00a0%" in balance(replace(screw, field_energy=0.9 * screw.field_energy))
    solved = replace(DESIGN, details={"newton_iterations": 43.0, "largest_residual": 4e-10})
    assert "43 steps together" in lead_screw.seen(screw, solved)[0]


@pytest.mark.parametrize(
    ("key", "label"),
    [
        ("actuator.pitch", "pitch"),
        ("actuator.translator.length", "length (translator)"),
        ("actuator.carried_mass", "carried mass"),
        ("actuator.rotor.iron_thickness", "thickness of the iron (rotor)"),
        ("actuator.rotor.magnet", "magnet grade (rotor)"),
    ],
)
def test_labels_are_names_where_a_description_goes_on_from_one(key: str, label: str) -> None:
    assert key_label(SPEC, key) == label


def test_small_numbers_keep_their_digits() -> None:
    assert scale("fraction", [8.058e-4]).quantity(8.058e-4) == "0.0806\u00a0%"
    assert scale("fraction", [0.0158]).quantity(0.0158) == "1.58\u00a0%"
    assert scale("fraction", [0.0]).quantity(0.0) == "0.00\u00a0%"
    assert scale("rotational inertia", [7.68e-5]).quantity(7.68e-5) == "768.0\u00a0g cm²"
    assert difference(subject_measure(SPEC, "rotor_inertia", 7.68e-5), 1e-6, signed=True) == "+10\u00a0g cm²"
