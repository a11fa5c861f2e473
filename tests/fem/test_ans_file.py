"""FEMM's solution files, read as its readers do: the model's text, then rows of numbers."""

import sys
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases.drawing import Drawing

from fluxbore.fem.ans_file import ans_text
from fluxbore.fem.femm_model import Exterior, PointProperty
from fluxbore.fem.femm_reader import parse
from fluxbore.fem.femm_solution import FemmSolution, solve_model
from fluxbore.fem.mesh import Floats, Ints

MM = 1e-3
SIGMA = 5e7


@dataclass
class Answer:
    """What follows [Solution]. nodes : (n, 4) x, y, A, property. elements : (m, 8). blocks : (labels, 2)."""

    model: str
    nodes: Floats
    elements: Floats
    blocks: Floats
    ties: Ints

    @property
    def corners(self) -> Ints:
        return self.elements[:, :3].astype(int)

    @property
    def areas(self) -> Floats:
        """(m,) in the file's unit, signed."""
        (a, b, c) = self.nodes[self.corners, :2].transpose(1, 0, 2)
        u, v = b - a, c - a
        return np.asarray((u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2)


def read(text: str) -> Answer:
    """By counts, as FEMM does; every row must have the columns that FEMM writes."""
    model, _, rest = text.partition("[Solution]\n")
    lines = iter(rest.splitlines())

    def table(columns: int) -> Floats:
        rows = [[float(word) for word in next(lines).split()] for _ in range(int(next(lines)))]
        return np.array(rows, dtype=float).reshape(-1, columns)

    answer = Answer(model, table(4), table(8), table(2), table(3).astype(int))
    assert next(lines) == "0"
    assert not list(lines)
    return answer


@cache
def ring() -> FemmSolution:
    """A ball of radius 10 mm with a solid ring, a wound one and one of a given density."""
    drawing = Drawing(axisymmetric=True)
    drawing.half_disc(10, boundary=drawing.boundary("far"))
    solid, wire = drawing.circuit("solid", 100.0), drawing.circuit("wire", 2.0)
    copper, air = drawing.material("copper", conductivity=SIGMA), drawing.material("air")
    drawing.rectangle((3, 5), (-2, 0))
    drawing.rectangle((2, 4), (2, 4))
    drawing.rectangle((1, 2), (-5, -4))
    drawing.label(4, -1, copper, solid)
    drawing.label(3, 3, copper, wire, turns=-50)
    drawing.label(1.5, -4.5, drawing.material("given", density=3e6))
    drawing.label(8, 0, air)
    return solve_model(drawing.model())


@cache
def periodic() -> FemmSolution:
    """A bar of copper between two sides of opposite sign, A = 0 below and a point of given A."""
    drawing = Drawing(axisymmetric=False, depth=20.0)
    below = drawing.boundary("A=0")
    sides = drawing.boundary("sides", "antiperiodic")
    drawing.line((0, 0), (10, 0), boundary=below)
    drawing.line((0, 0), (0, 10), boundary=sides)
    drawing.line((10, 0), (10, 10), boundary=sides)
    drawing.line((0, 10), (10, 10))
    drawing.rectangle((4, 6), (4, 6))
    drawing.point(5, 2, PointProperty("held", 1e-4))
    bar = drawing.circuit("bar", 10.0)
    drawing.label(5, 5, drawing.material("copper", conductivity=SIGMA), bar)
    drawing.label(1, 1, drawing.material("air"))
    return solve_model(drawing.model())


@pytest.mark.parametrize("build", [ring, periodic])
def test_the_model_comes_first(build: type) -> None:
    """Catches an echo of the file that is not the model that was solved."""
    assert parse(read(ans_text(build())).model) == build().model


@pytest.mark.parametrize("build", [ring, periodic])
def test_the_triangles_fill_the_model(build: type) -> None:
    """Catches triangles that overlap, turn clockwise, or carry another label's number."""
    solution: FemmSolution = build()
    answer = read(ans_text(solution))
    assert answer.areas.min() > 0
    assert answer.areas.sum() == pytest.approx(np.pi * 50 if solution.model.axisymmetric else 100, rel=1e-3)
    label = answer.elements[:, 3].astype(int)
    for number, size in enumerate([4, 4, 1] if solution.model.axisymmetric else [4]):
        assert answer.areas[label == number].sum() == pytest.approx(size)
    assert answer.nodes.shape[0] == solution.solution.psi.size == np.unique(answer.corners).size


def test_flux_around_an_axis() -> None:
    """Catches r A for 2π r A; and that straight triangles find the same B."""
    solution = ring()
    answer = read(ans_text(solution))
    assert answer.nodes[:, 2] == pytest.approx(2 * np.pi * solution.solution.psi)
    far = np.argmin(np.hypot(answer.nodes[:, 0] - 7, answer.nodes[:, 1] - 3))
    assert answer.nodes[far, 2] == pytest.approx(
        2 * np.pi * solution.probe(answer.nodes[far : far + 1, :2]).potential[0], rel=1e-9
    )


def test_currents_by_label_and_element() -> None:
    """Catches A/m² for MA/m², a circuit's current in another's block, and a solid ring without its 1/r."""
    answer = read(ans_text(ring()))
    k = 100.0 / (np.log(5 / 3) * 2 * MM)
    assert answer.blocks.tolist() == [
        pytest.approx([0, -k / SIGMA]),
        pytest.approx([1, -100.0 / (4 * MM**2) * 1e-6]),
        [1, 0],
        [1, 0],
    ]
    label, current = answer.elements[:, 3].astype(int), answer.areas * answer.elements[:, 7]
    totals = [current[label == number].sum() for number in range(4)]
    assert totals == pytest.approx([100.0, -100.0, 3.0, 0.0], rel=1e-3)
    bar = read(ans_text(periodic()))
    assert bar.blocks[0] == pytest.approx([0, -10 / (4 * MM**2) / SIGMA])


def test_periodic_nodes() -> None:
    """Catches ties between nodes that do not face each other, or of the wrong sign."""
    answer = read(ans_text(periodic()))
    first, second, kind = answer.ties.T
    assert first.size > 4
    assert np.all(kind == 1)
    assert answer.nodes[first, 1] == pytest.approx(answer.nodes[second, 1], abs=1e-9)
    assert sorted({*np.round(answer.nodes[first, 0], 6), *np.round(answer.nodes[second, 0], 6)}) == [0, 10]
    assert answer.nodes[first, 2] == pytest.approx(-answer.nodes[second, 2])
    assert read(ans_text(ring())).ties.size == 0


def test_properties_of_nodes_and_edges() -> None:
    """Catches a boundary's number on the wrong side of a triangle, and a point property that is lost."""
    answer = read(ans_text(periodic()))
    held = np.flatnonzero(answer.nodes[:, 3] >= 0)
    assert answer.nodes[held].tolist() == [pytest.approx([5, 2, 1e-4, 0])]
    lengths = np.zeros(2)
    for side in range(3):
        ends = answer.nodes[answer.corners[:, [side, (side + 1) % 3]], :2]
        prop = answer.elements[:, 4 + side].astype(int)
        assert np.all(ends[prop == 0][..., 1] == 0)
        assert np.all(np.isin(ends[prop == 1][..., 0], [0, 10]))
        length = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
        lengths += [length[prop == number].sum() for number in (0, 1)]
    assert lengths == pytest.approx([10, 20])


@cache
def exterior() -> FemmSolution:
    """A coil in a ball of radius 20 mm, and all of space around it in a ball of the same size further down."""
    drawing = Drawing(axisymmetric=True, exterior=Exterior(-50.0, 20.0, 20.0))
    rim = drawing.boundary("rim", "periodic")
    drawing.half_disc(20, boundary=rim)
    drawing.half_disc(20, -50, boundary=rim)
    drawing.rectangle((5, 8), (-3, 3))
    air = drawing.material("air")
    drawing.label(6, 0, air, drawing.circuit("coil", 5.0), turns=100)
    drawing.label(15, 0, air)
    drawing.label(5, -50, air)
    drawing.labels[-1] = replace(drawing.labels[-1], external=True)
    return solve_model(drawing.model())


def test_the_energy_of_a_kelvin_exterior() -> None:
    """Catches an exterior in our scale: FEMM takes the energy density there times (R/R_o)² where R_i = R_o."""
    solution = exterior()
    answer = read(ans_text(solution))
    (r, z), a = answer.nodes[answer.corners, :2].transpose(2, 0, 1) * MM, answer.nodes[answer.corners, 2]
    # ψ is linear in s = r²/2 and z in each triangle: B_z = ∂ψ/∂s, B_r = −∂ψ/∂z / r.
    rows = np.stack((np.ones_like(r), r**2 / 2, z), axis=-1)
    slope = np.linalg.solve(rows, a[..., None] / (2 * np.pi))[:, 1:, 0]
    middle = r.mean(axis=1)
    density = (slope[:, 0] ** 2 + (slope[:, 1] / middle) ** 2) / (2 * 4e-7 * np.pi)
    volume = 2 * np.pi * middle * answer.areas * MM**2
    squared = middle**2 + (z.mean(axis=1) + 50 * MM) ** 2
    outside = answer.elements[:, 3] == 2
    kelvin = np.where(outside, squared / (20 * MM) ** 2, 1.0)
    energy = density * volume * kelvin
    assert energy.sum() == pytest.approx(solution.energies[0], rel=0.01)
    assert 0.01 < energy[outside].sum() / energy.sum() < 0.5


def test_a_kelvin_exterior_of_another_size() -> None:
    """Catches r A that is the same on both rims: FEMM has the same A there, so that its fluxes are as the radii."""
    solution = exterior()
    smaller = replace(solution, model=replace(solution.model, exterior=Exterior(-50.0, 10.0, 20.0)))
    answer, other = read(ans_text(solution)), read(ans_text(smaller))
    outside = answer.nodes[:, 1] < -25
    assert other.nodes[:, 2] == pytest.approx(answer.nodes[:, 2] * np.where(outside, 0.5, 1.0))
