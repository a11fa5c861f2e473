"""Why a figure that is asked for is missing."""

from dataclasses import replace

import pytest

from fluxbore.design.errors import SpecError
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec, loads
from fluxbore.design.spec_file import template
from fluxbore.design.study import Constraint, Objective, Pareto, Variable
from fluxbore.optimize.hybrid_common import common_figures, derived, warnings
from fluxbore.optimize.search import check_study

TEXT = template("ipehla")


def asked(changes: dict[str, str], *figures: str) -> tuple[Spec, Performance]:
    """A specification that constrains these figures, and its own."""
    spec = loads(TEXT, changes)
    spec = replace(spec, study=replace(spec.study, constraints=tuple(Constraint(name, lower=1.0) for name in figures)))
    field = {"force_constant": 8.67, "gap_flux_density": 0.41, "yoke_flux_density": 1.35}
    return spec, derived(spec, replace(common_figures(spec, spec.actuator), **field))


@pytest.mark.parametrize(
    ("changes", "figure", "reason"),
    [
        ({"actuator.cylinder.material": "brass"}, "cylinder_safety", '"brass" states no yield_stress'),
        ({"actuator.cylinder.material": "PTFE"}, "bore_clearance", '"PTFE" states no poisson_ratio'),
        ({"actuator.cylinder.material": "PEEK"}, "eddy_loss", '"PEEK" states no resistivity'),
        ({"actuator.back_yoke.material": "TEAM 13 steel"}, "iron_loss", "no hysteresis_coefficient and no resistivity"),
        ({"actuator.shaft.material": "PTFE"}, "shaft_safety", "states no yield_stress"),
        ({"operating_point.pressure": "0 Pa gauge"}, "cylinder_safety", "does not load the cylinder"),
        ({"operating_point.supply_voltage": ""}, "speed_limit", "supply_voltage is not given"),
    ],
)
def test_the_reason_names_what_is_missing(changes: dict[str, str], figure: str, reason: str) -> None:
    """Catches a constraint that cannot be met without a word why."""
    (warning,) = warnings(*asked(changes, figure))
    assert warning.startswith(f"{figure} is not given: ")
    assert reason in warning
    # Nobody asks: nothing to say.
    assert warnings(*asked(changes)) == ()


def test_a_figure_that_is_given_needs_no_reason() -> None:
    assert warnings(*asked({}, "cylinder_safety", "winding_temperature", "stray_field")) == ()


def test_the_objective_counts_too() -> None:
    spec, found = asked({"operating_point.supply_voltage": ""})
    spec = replace(spec, study=replace(spec.study, objective=Objective("no_load_speed", True)))
    (warning,) = warnings(spec, found)
    assert "supply_voltage" in warning


def test_a_winding_that_runs_away_is_said() -> None:
    (warning,) = warnings(*asked({"operating_point.current": "40 A"}))
    assert "the copper runs away" in warning


@pytest.mark.parametrize(
    ("figure", "changes", "reason"),
    [
        ("peak_force", {"operating_point.peak_current": ""}, "operating_point.peak_current is not given"),
        ("stored_energy", {}, "only coils have it"),
        ("no_load_speed", {"operating_point.supply_voltage": ""}, "operating_point.supply_voltage is not given"),
        ("eddy_loss", {"actuator.cylinder.material": "PEEK"}, '"PEEK" states no resistivity'),
    ],
)
def test_an_objective_that_no_design_has_is_refused(figure: str, changes: dict[str, str], reason: str) -> None:
    """Catches a budget spent on designs none of which can be compared."""
    spec = loads(TEXT, changes)
    moved = Variable("operating_point.peak_current", 1.0, 3.0)
    spec = replace(spec, study=replace(spec.study, objective=Objective(figure, True), constraints=(), pareto=None))
    with pytest.raises(SpecError, match=rf"^study\.objective must name .* {figure} is not given: .*{reason}\.$"):
        check_study(spec)
    if figure == "peak_force":
        check_study(replace(spec, study=replace(spec.study, variables=(moved,))))
    against = Pareto(Objective(figure, True), 5)
    front = replace(spec.study, objective=Objective("force_constant", True), pareto=against)
    with pytest.raises(SpecError, match=r"^study\.pareto\.against must name"):
        check_study(replace(spec, study=front))
