"""The models of the validation gallery are drawn as they are meant, and read a result as the contract says."""

from __future__ import annotations

import sys
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from shapely.geometry import LineString, Point, Polygon
from shapely.ops import polygonize, unary_union

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases import CASES, Case
from cases.exterior import with_exterior

from fluxbore.fem.femm_problem import drawing
from fluxbore.fem.femm_reader import parse
from fluxbore.fem.femm_writer import write_text

built = cache(lambda number: CASES[number]())
each = pytest.mark.parametrize("number", range(len(CASES)), ids=[build.__name__ for build in CASES])


def faces(case: Case) -> tuple[list[Polygon], tuple[tuple[float, float], ...]]:
    """The closed faces of a model, and its labels' places (m)."""
    outline = drawing(with_exterior(case.model) if case.open_boundary else case.model).outline
    lines = []
    for curve in outline.curves:
        points = outline.along(curve, np.linspace(0, 1, 2 if curve.turn == 0 else 181))
        points[0], points[-1] = outline.points[curve.start], outline.points[curve.end]
        lines.append(LineString(points))
    return list(polygonize(unary_union(lines))), tuple(seed.position for seed in outline.seeds)


def test_cases_have_names_of_their_own() -> None:
    """Catches a page that overwrites another's."""
    names = [built(number).name for number in range(len(CASES))]
    assert len(set(names)) == len(names) >= 25


@each
def test_each_face_has_one_label(number: int) -> None:
    """Catches an open outline, a forgotten label, or two labels in one face."""
    found, places = faces(built(number))
    assert len(found) == len(places)
    for face in found:
        assert sum(face.contains(Point(place)) for place in places) == 1


@each
def test_values_are_finite_and_their_points_inside(number: int) -> None:
    """Catches an exact value that is none, an error relative to nothing, and a point outside the model."""
    case = built(number)
    inside = unary_union(faces(case)[0]).buffer(1e-9)
    assert case.checks
    assert all(np.isfinite(check.exact) and check.scale > 0 for check in case.checks)
    assert all(inside.contains(Point(np.array(at) * case.model.metres)) for at in case.points)
    assert {label.group for label in case.model.labels} >= set(case.groups)


@each
def test_each_model_is_a_file(number: int) -> None:
    """Catches a model that the file format cannot say."""
    model = built(number).model
    assert parse(write_text(model)) == model


@each
def test_checks_read_the_contract(number: int) -> None:
    """Catches a path that is not the contract's: a result made of the exact values holds, a shifted one does not."""
    case = built(number)

    def result(factor: float) -> dict[str, Any]:
        made: dict[str, Any] = {"circuits": {}, "groups": {}, "points": []}
        for item in case.model.circuits:
            made["circuits"][item.name] = {"current": item.current, "flux_linkage": 0.0}
        for group in case.groups:
            made["groups"][str(group)] = {"force": [0.0, 0.0], "torque": 0.0, "force_error": 0.0}
        for at in case.points:
            made["points"].append({"at": list(at), "A": 0.0, "B": [0.0, 0.0], "H": [0.0, 0.0]})
        for check in case.checks:
            place: Any = made if check.at is None else made["points"][case.points.index(check.at)]
            for key in check.path[:-1]:
                place = place[key]
            place[check.path[-1]] = check.exact + factor * check.scale
        return made

    assert all(check.holds(result(0.0)) for check in case.checks)
    assert not any(check.holds(result(0.01)) for check in case.checks)
