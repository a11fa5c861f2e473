"""Currents without a way back are refused; those that have one, be it c1 on a curved rim, are solved as before."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases.drawing import MU_0, Drawing

from fluxbore.design.errors import SpecError
from fluxbore.fem.femm_model import FemmModel, PointProperty
from fluxbore.fem.femm_solution import FemmSolution, solve_model
from fluxbore.solving import solve


def box(*conditions: int | None, drawing: Drawing | None = None, turns: float = 1.0) -> Drawing:
    """100 mm by 100 mm with conditions below, right, above and left, and 100 A in a square at (25, 25)."""
    made = drawing or Drawing(False)
    corners = [(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0)]
    for k, condition in enumerate(conditions or (None,) * 4):
        made.line(corners[k], corners[(k + 1) % 4], boundary=condition)
    made.rectangle((20, 30), (20, 30))
    air = made.material("Air")
    made.label(80, 80, air)
    made.label(25, 25, air, made.circuit("coil", 100.0), turns)
    return made


def rough(model: FemmModel) -> FemmSolution:
    return solve_model(model, accuracy=0.5)


def test_sides_without_a_condition() -> None:
    """Catches a node, chosen for the zero of A, that carries the current back: a field of nothing."""
    with pytest.raises(SpecError, match=r"currents in the part of the model around \(80, 80\) .* to 100 A\.$"):
        rough(box().model())


def test_sides_that_are_periodic_both_ways() -> None:
    made = Drawing(False)
    across, along = (made.boundary(name, "periodic") for name in ("across", "along"))
    with pytest.raises(SpecError, match=r"they add up to -200 A\.$"):
        rough(box(across, along, across, along, drawing=made, turns=-2.0).model())


def test_point_currents_and_current_densities_count() -> None:
    """Catches a sum over circuits alone: 100 A, −40 A at a point, and 0.5 A/mm² over 100 mm²."""
    made = box()
    made.point(60, 60, PointProperty("wire", None, -40.0))
    made.rectangle((70, 80), (20, 30))
    made.label(75, 25, made.material("bar", density=5e5))
    with pytest.raises(SpecError, match=r"they add up to 110 A\.$"):
        rough(made.model())


def test_field_strengths_of_one_sign() -> None:
    """Catches c1 that needs a current which is not there: H_t = −1 kA/m along 100 mm."""
    made = Drawing(False)
    driven = made.boundary("driven", "mixed", c1=1000.0)
    with pytest.raises(SpecError, match=r"currents \(and c1 of boundaries\) .* they add up to -100 A\.$"):
        rough(box(None, driven, None, None, drawing=made, turns=0.0).model())


def test_a_part_beside_one_that_is_held() -> None:
    """Catches one part's wall taken for the other's."""
    made = Drawing(False)
    wall = made.boundary("A=0")
    box(wall, wall, wall, wall, drawing=made)
    made.rectangle((200, 300), (0, 100))
    made.label(250, 50, 0, 0)
    with pytest.raises(SpecError, match=r"around \(250, 50\)"):
        rough(made.model())


def test_currents_that_return() -> None:
    """Catches a good model refused: what goes in one square comes back in another, and rounding is no net current."""
    made = box(turns=1 / 3)
    made.rectangle((70, 80), (20, 30))
    made.label(75, 25, 0, 0, turns=-0.33333333)
    found = rough(made.model())
    assert found.solution.convergence.converged
    assert found.linkages[0] > 0


def test_a_current_that_returns_in_a_curved_rim() -> None:
    """Catches a net current found in what the elements leave of an arc: a wire whose field is given on a circle."""
    made = Drawing(False)
    rim = made.boundary("rim", "mixed", c1=100.0 / (2 * np.pi * 0.02))
    made.circle(0, 0, 20, rim, rim)
    made.circle(0, 0, 5)
    air = made.material("Air")
    made.label(0, 0, air, made.circuit("wire", 100.0))
    made.label(12, 0, air)
    found = rough(made.model()).probe(np.array([(10.0, 0.0)]))
    assert abs(found.flux_density[0, 1]) == pytest.approx(MU_0 * 100 / (2 * np.pi * 0.01), rel=0.02)


def disc(turns: float) -> FemmModel:
    """100 A in a disc of 5 mm, and ``turns`` times as much in one beside it, within a circle of A = 0."""
    made = Drawing(False)
    wall = made.boundary("A=0")
    made.circle(0, 0, 40, wall, wall)
    air, wire = made.material("Air"), made.circuit("wire", 100.0)
    for x, count in ((-10, 1.0), (10, turns)):
        made.circle(x, 0, 5)
        made.label(x, 0, air, wire, count)
    made.label(0, 30, air)
    return replace(made.model(), path="wires.fem")


def test_a_net_current_in_an_open_plane() -> None:
    """Catches an energy that grows with every mesh, as the field of a lone current fills all of the plane."""
    assert solve(disc(1.0), accuracy=0.5).linkages[0] > 0, "within a wall it has one"
    with pytest.raises(SpecError, match=r"^wires\.fem must have currents that add up to zero to be opened.* 200 A\.$"):
        solve(disc(1.0), accuracy=0.5, open_boundary=True)
    assert solve(disc(-1.0), accuracy=0.5, open_boundary=True).linkages[0] > 0


def test_a_net_current_in_open_space() -> None:
    """Catches an axisymmetric coil refused: its current closes on itself."""
    made = Drawing(True)
    made.half_disc(40, boundary=made.boundary("A=0"))
    made.rectangle((8, 12), (-5, 5))
    air = made.material("Air")
    made.label(10, 0, air, made.circuit("coil", 2.0), 100)
    made.label(30, 0, air)
    assert solve(made.model(), accuracy=0.5, open_boundary=True).linkages[0] > 0
