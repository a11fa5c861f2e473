"""The exterior of a ball inside another: its factor, and that nothing depends on where the balls are."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases import air_coils
from cases.drawing import Drawing
from exact.coils import Coil, inductance

from fluxbore.fem.femm_model import Exterior, FemmModel
from fluxbore.fem.femm_solution import solve_model
from fluxbore.fem.kelvin import KelvinExterior

COIL = Coil(400, 2.0, 0.02, 0.03, 0.005, 0.025)


def model(inner: float, outer: float, centre: float) -> FemmModel:
    """The coil in a ball of radius ``inner`` about the origin, the rest in one of radius ``outer`` (mm)."""
    drawing = Drawing(True, exterior=Exterior(centre, outer, inner))
    air, copper = drawing.material("Air"), drawing.material("Copper")
    air_coils.draw_coil(drawing, COIL, drawing.circuit("coil", 2.0), copper)
    seam = drawing.boundary("seam", "periodic")
    drawing.half_disc(inner, 0, seam)
    drawing.half_disc(outer, centre, seam)
    drawing.label(5, 0, air)
    drawing.label(outer / 3, centre, air, external=True)
    return drawing.model()


def test_factor() -> None:
    """Catches the inverse factor: R²/(R_i R_o), R_o/R_i on the rim, nothing at infinity."""
    exterior = KelvinExterior(0.15, 0.06, 0.03)
    points = np.array([(0.03, 0.15), (0.0, 0.15), (0.0, 0.165)])
    assert exterior.factor(points) == pytest.approx([0.5, 0.0, 0.125])


@pytest.mark.parametrize("balls", [(60, 60, 150), (45, 45, -200), (60, 30, 110), (90, 30, 150)])
def test_linkage_does_not_depend_on_the_balls(balls: tuple[float, float, float]) -> None:
    """Catches a factor that forgets a radius: the same coil in balls of several sizes."""
    solved = solve_model(model(*balls), accuracy=5e-4)
    assert solved.adapted.reached
    assert solved.linkages[0] == pytest.approx(2 * inductance(COIL, COIL), rel=1e-3)
    assert solved.energies[0] == pytest.approx(2 * inductance(COIL, COIL), rel=1e-3)


def test_without_the_factor_it_would_be_wrong() -> None:
    """Catches a case that does not see the exterior: with the factor left out the linkage is off by per cents."""
    bare = model(60, 60, 150)
    bare = replace(bare, labels=tuple(replace(label, external=False) for label in bare.labels))
    found = solve_model(bare, accuracy=1e-3).linkages[0]
    assert abs(found / (2 * inductance(COIL, COIL)) - 1) > 3e-3
