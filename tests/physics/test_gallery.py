"""A part of the validation gallery at the default accuracy: one case for each kind of model. The rest: tests/full."""

from __future__ import annotations

import sys
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases import CASES, Case
from cases.exterior import with_exterior

from fluxbore.fem.adapt import Level
from fluxbore.fem.femm_solution import FemmSolution, solve_model

QUICK = (
    "air_coil_in_a_box",
    "two_coils",
    "kelvin_exterior",
    "voice_coil",
    "unequal_magnets",
    "sphere",
    "halbach_ring",
    "sphere_in_a_field",
    "ball_and_coil",
    "saturated_solenoid",
    "saturated_ring",
    "confined_wire",
    "point_current",
    "coaxial_cable",
    "parallel_strips",
    "slotless_no_load",
    "slotless_load",
    "laminated_strips",
    "mixed_condition",
)
"""Names of the functions that build them."""

IDEALISED = ("saturated_solenoid", "saturated_ring", "laminated_strips", "air_coil_in_a_box")
"""Their exact values are of a steel's law, which the model has a table of, or without the box: up to 7e-4 of the
difference is no mesh's, so that a finer mesh of the same model has to say what is right."""

HONEST = 2.0
"""A figure's error may be this many times its estimate."""


@cache
def built(name: str) -> Case:
    return next(build for build in CASES if build.__name__ == name)()


@cache
def solved(name: str, accuracy: float | None = None) -> FemmSolution:
    case = built(name)
    model = with_exterior(case.model) if case.open_boundary else case.model
    return solve_model(model, case.groups, case.points if accuracy is None else (), accuracy)


@cache
def result(name: str, accuracy: float | None = None) -> dict[str, Any]:
    """What the checks read: the part of the JSON contract that they need."""
    case, solution = built(name), solved(name, accuracy)
    energy, coenergy = solution.energies
    forces = {group: solution.force(group).by_stress for group in case.groups}
    probed = solution.probe(np.array(case.points, dtype=float)) if case.points and accuracy is None else None
    return {
        "energy": energy,
        "coenergy": coenergy,
        "circuits": {
            item.name: {"flux_linkage": linked}
            for item, linked in zip(case.model.circuits, solution.linkages, strict=True)
        },
        "groups": {str(group): {"force": body.force, "torque": body.torque} for group, body in forces.items()},
        "points": []
        if probed is None
        else [
            {"at": at, "A": a, "B": b}
            for at, a, b in zip(case.points, probed.potential, probed.flux_density, strict=True)
        ],
    }


def each(names: tuple[str, ...]) -> pytest.MarkDecorator:
    return pytest.mark.parametrize("name", names)


def check_values(name: str) -> None:
    found = result(name)
    misses = {
        built(name).label(check): f"{check.error(found):+.2%} of {check.tolerance:.1%}"
        for check in built(name).checks
        if not check.holds(found)
    }
    assert not misses


def check_routes(name: str) -> None:
    """A force of zero is held against the check's own scale, such as that of its parts."""
    case = built(name)
    for group in case.groups:
        found = solved(name).force(group)
        scales = [check.scale for check in case.checks if check.path[:3] == ("groups", str(group), "force")]
        assert found.error < 0.01 * max(float(np.hypot(*found.by_stress.force)), *scales)
        assert found.touches == ()
    for one, other in case.pairs:
        a, b = (np.array(solved(name).force(group).by_stress.force) for group in (one, other))
        assert np.hypot(*(a + b)) < 1e-3 * np.hypot(*a)


def check_estimates(name: str) -> None:
    """Of energy, linkages and forces. In saturated steel the largest relative estimate counts for all figures.

    There an adjoint's estimate leaves out what is quadratic in the error, which is of the same order.
    """
    case, found = built(name), figures(result(name))
    finer = figures(result(name, 2e-5)) if name in IDEALISED else {}
    level: Level = solved(name).adapted.levels[-1]
    saturated = any(material.curve for material in case.model.materials)
    for estimate in level.estimates:
        path = path_of(case, estimate.name)
        exact = finer.get(path, next((check.exact for check in case.checks if check.path == path), None))
        if exact is not None:
            rounding = 1e-7 * max(abs(exact), abs(estimate.value))
            error = max(estimate.error, level.worst * abs(exact)) if saturated else estimate.error
            assert abs(found[path] - exact) < HONEST * error + rounding, (estimate, exact)


def path_of(case: Case, name: str) -> tuple[str | int, ...]:
    """Where the figure of an estimate stands in a result."""
    if name.startswith("flux linkage of "):
        return "circuits", name.removeprefix("flux linkage of "), "flux_linkage"
    if " force on group " in name:
        axis, group = name.split(" force on group ")
        return "groups", group, "force", 0 if axis == "x" else 1
    return (name,)


def figures(found: dict[str, Any]) -> dict[tuple[str | int, ...], float]:
    """Energy, linkages and forces by their places."""
    flat: dict[tuple[str | int, ...], float] = {("energy",): found["energy"]}
    for name, circuit in found["circuits"].items():
        flat["circuits", name, "flux_linkage"] = circuit["flux_linkage"]
    for group, body in found["groups"].items():
        for axis, value in enumerate(body["force"]):
            flat["groups", group, "force", axis] = value
    return flat


@each(QUICK)
def test_every_value_is_within_its_tolerance(name: str) -> None:
    """Catches any figure of a file more than 0.3 % (forces 0.5 %) from its exact value."""
    assert solved(name).adapted.reached
    check_values(name)


@each(("two_coils", "voice_coil", "unequal_magnets", "ball_and_coil", "confined_wire", "slotless_load"))
def test_two_routes_to_a_force_and_its_reaction(name: str) -> None:
    """Catches routes more than 1 % apart, and a pair of bodies that would fly away: a rest of 1e-3."""
    check_routes(name)


@each(QUICK)
def test_estimates_are_honest(name: str) -> None:
    """Catches an estimate that promises more than twice what holds."""
    check_estimates(name)
