"""The PREHydrA's cylinder sized by the search, against its optimum in closed form and all steps about it (-m full)."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import pytest
from hydrostatic_duty import LEAD, OUT, PUSHED, sized

import fluxbore
from fluxbore.design.performance import Performance
from fluxbore.optimize.outcome import SearchResult

pytestmark = pytest.mark.full

PREHYDRA = fluxbore.load(Path(__file__).parents[2] / "examples" / "prehydra.toml")


@pytest.fixture(scope="module")
def found() -> SearchResult:
    return fluxbore.optimize(PREHYDRA, workers=2)


def test_the_search_finds_the_optimum_that_the_duty_fixes(found: SearchResult) -> None:
    """Catches a search that stops at its network's start or away from a limit: a thousandth of the mass."""
    assert found.best is not None
    by_hand = fluxbore.evaluate(PREHYDRA.with_values(sized()), "network").performance.distal_mass
    assert by_hand is not None
    assert found.best.feasible
    assert found.best.objective == pytest.approx(by_hand, rel=1e-3)
    assert found.best.objective > by_hand * (1 - 1e-6)


def test_the_sized_cylinder_is_lighter_than_the_brass_one_for_the_same_duty(found: SearchResult) -> None:
    """By a quarter and more, of the same brass, with the same port; every limit is met by the simulation."""
    made, start = found.chosen, found.start.evaluation.performance
    assert made is not None
    assert found.rounded is made
    assert made.feasible
    assert made.evaluation.fidelity == "fem"
    figures = made.evaluation.performance
    assert figures.output_cylinder_mass < 0.73 * start.output_cylinder_mass
    assert figures.distal_mass < 0.9 * start.distal_mass
    assert figures.force_frequency_limit >= start.force_frequency_limit * (1 - 1e-9)
    assert figures.tracking_error <= start.tracking_error


def test_no_step_of_the_workshops_about_it_is_lighter(found: SearchResult) -> None:
    """All 288 about the design, by closed forms: none that keeps their limits is lighter by a tenth of a gram."""
    made = found.chosen
    assert made is not None
    base = PREHYDRA.with_values(made.values)
    start = fluxbore.evaluate(PREHYDRA, "network").performance
    least = made.evaluation.performance.distal_mass
    assert least is not None
    kept = 0
    for bore, wall, rod, lead in product(
        (9.5, 10.0, 10.5), (0.45, 0.5, 0.55, 0.6, 0.65, 0.7), (6.0, 6.5, 7.0, 7.5), (2.0, 2.5, 3.0, 3.5)
    ):
        steps = {"bore": bore, "wall_thickness": wall, "rod_diameter": rod}
        values = {f"{OUT}.{leaf}": value * 1e-3 for leaf, value in steps.items()} | {LEAD: lead * 1e-3}
        other = fluxbore.evaluate(base.with_values(values), "network")
        if other.ok and _keeps(other.performance, start):
            kept += 1
            assert other.performance.distal_mass > least - 1e-4
    assert kept > 10, "else the comparison says little"


def _keeps(figures: Performance, start: Performance) -> bool:
    slack = 1 - 1e-9
    return (
        figures.force_frequency_limit >= slack * start.force_frequency_limit
        and figures.stroke_force >= slack * start.stroke_force
        and figures.pushing_force >= slack * PUSHED
        and figures.buckling_safety >= slack * 3
        and figures.burst_factor >= slack * start.burst_factor
    )
