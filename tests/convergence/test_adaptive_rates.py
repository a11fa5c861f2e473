"""Adaptive refinement at corners: the energy's error falls with the unknowns as if the field were smooth, N⁻².

Uniform refinement gives N^−2/3 at a corner of A = 0 or of iron, so that a slope of 1.7 shows that elements are put
where they are needed.
"""

from __future__ import annotations

import sys
from functools import cache
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases import magnets
from cases.drawing import MU_0, Drawing
from cases.exterior import with_exterior
from manufactured import solved_levels

from fluxbore.fem.energy import energies
from fluxbore.fem.femm_model import FemmModel
from fluxbore.fem.femm_reader import read_model
from fluxbore.fem.femm_solution import FemmSolution, solve_model

RATE = 1.7
DATA = Path(__file__).parents[1] / "data"


def corner() -> FemmModel:
    """The L of three unit squares, A = 0 around it, J = 1/μ0: ∫|grad A|² is known to nine figures."""
    drawing = Drawing(False, "meters")
    wall = drawing.boundary("A=0")
    drawing.line((0, 0), (1, 0), (1, 1), (-1, 1), (-1, -1), (0, -1), (0, 0), boundary=wall)
    drawing.label(-0.5, 0.5, drawing.material("Copper", density=1 / MU_0))
    return drawing.model()


CORNER_ENERGY = 0.2140758027 / (2 * MU_0)
"""∫|grad u|² of −Δu = 1 on the L (Funken, Praetorius and Wissgott 2011, Comput. Methods Appl. Math. 11, 460)."""


def bar() -> FemmModel:
    """A quarter of a square bar of iron, μ_r = 1000, across a field of 1 T: a corner of 270 degrees of air."""
    drawing = Drawing(False, "meters")
    far, middle = drawing.boundary("far", a2=1.0), drawing.boundary("A=0")
    drawing.line((2, 0), (2, 2), (0, 2), boundary=far)
    drawing.line((0, 0), (2, 0), boundary=middle)
    drawing.line((0, 2), (0, 0))
    drawing.rectangle((0, 0.5), (0, 0.5))
    drawing.label(0.2, 0.2, drawing.material("Iron", mu=1000.0))
    drawing.label(1, 1, drawing.material("Air"))
    return drawing.model()


def magnet() -> FemmModel:
    """A cylindrical magnet in all of space: its edges are where the field is infinite."""
    return with_exterior(magnets.cylinder().model)


def plunger() -> FemmModel:
    return read_model(DATA / "plunger.fem")


@cache
def refined(name: str, accuracy: float) -> FemmSolution:
    return solve_model(MODELS[name](), (), (), accuracy)


MODELS = {"corner": corner, "iron bar": bar, "magnet": magnet, "plunger": plunger}
ENDS = {"corner": 3e-7, "iron bar": 1e-7, "magnet": 3e-7, "plunger": 5e-6}
"""Accuracies of the last mesh, which serves as the reference for those of ten times its error and more."""


def history(name: str) -> tuple[np.ndarray, np.ndarray]:
    """Unknowns and relative errors of the energy on the meshes of the sequence."""
    levels = refined(name, ENDS[name]).adapted.levels
    unknowns = np.array([level.unknowns for level in levels], dtype=float)
    values = np.array([next(e.value for e in level.estimates if e.name == "energy") for level in levels])
    # The finest value's own error, by the same N⁻² from its estimate, is small against the others kept.
    errors = np.abs(values / values[-1] - 1)
    kept = errors > 10 * ENDS[name]
    return unknowns[kept], errors[kept]


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.full) if name == "magnet" else name for name in MODELS]
)
def test_energy_error_falls_as_on_smooth_fields(name: str) -> None:
    """Catches marking or estimates that refine in the wrong place: a slope of 1.7 or more over two decades of error."""
    unknowns, errors = history(name)
    assert errors[0] / errors[-1] > 100
    slope = -np.polyfit(np.log(unknowns), np.log(errors), 1)[0]
    assert slope > RATE, (slope, unknowns, errors)


def test_corner_has_its_published_energy() -> None:
    """Catches refinement that converges to something else."""
    assert refined("corner", ENDS["corner"]).energies[0] == pytest.approx(CORNER_ENERGY, rel=2e-6)


def test_uniform_refinement_shows_the_corner() -> None:
    """Catches a corner that is none: uniform meshes, four times the unknowns each, have a rate of N^−2/3."""
    errors = [abs(energies(s)[0] / CORNER_ENERGY - 1) for s in solved_levels(corner(), 3)]
    slopes = np.log2(np.array(errors[:-1]) / np.array(errors[1:])) / 2
    assert np.all((slopes > 0.55) & (slopes < 1.1)), slopes
