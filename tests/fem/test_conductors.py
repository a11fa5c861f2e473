"""Loads of regions with current: their sums, next to the axis too, and what they do to the field."""

import numpy as np
import pytest
from manufactured import circle, levels, polygon

from fluxbore.fem.conditions import Conditions
from fluxbore.fem.conductors import circuit, current_density, region_load
from fluxbore.fem.mesh import Mesh
from fluxbore.fem.outline import Curve, Outline, Seed
from fluxbore.fem.problem import Circuit, Conductor, MagneticMaterial, Problem


def mesh_of(outline: Outline) -> Mesh:
    (level,) = levels(outline, Conditions(), 1)
    return level.mesh


def cylinder() -> Mesh:
    """r to 2, z to 1: region 0 inside r = 1, region 1 outside, and 2, a triangle with a tip on the axis."""
    points = np.array([(0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (0, 1), (0, 0.5), (0.5, 0.3), (0.5, 0.7)], dtype=float)
    curves = (*polygon(0, 6)[:5], Curve(5, 6), Curve(6, 0), Curve(1, 4), Curve(6, 7), Curve(7, 8), Curve(8, 6))
    seeds = Seed((0.5, 0.1), 0), Seed((1.5, 0.5), 1), Seed((0.4, 0.5), 2)
    return mesh_of(Outline("axisymmetric", points, curves, seeds))


def test_planar_load_sums_to_the_area() -> None:
    """Catches a lost factor of the quadrature: a disc's area to the mesh's own accuracy."""
    points = np.array([(-1, 0), (1, 0)], dtype=float)
    load = region_load(mesh_of(Outline("planar", points, tuple(circle(0)), (Seed((0, 0.1), 0),))), 0)
    assert load.sum() == pytest.approx(np.pi, rel=1e-4)


@pytest.mark.parametrize("region, area", [(0, 0.9), (1, 1.0), (2, 0.1)])
def test_axisymmetric_load_sums_to_the_section(region: int, area: float) -> None:
    """Catches 1/r integrated as if it were smooth, where triangles touch the axis with a side or a tip."""
    assert region_load(cylinder(), region).sum() == pytest.approx(area, rel=1e-5)


def test_load_by_radius() -> None:
    """Catches a power of r too many: ∫ dr dz/r over 1 to 2 by 1 is ln 2."""
    assert region_load(cylinder(), 1, by_radius=True).sum() == pytest.approx(np.log(2), rel=1e-5)


def test_load_belongs_to_its_region() -> None:
    """Catches current that leaks into a neighbour."""
    mesh = cylinder()
    load = region_load(mesh, 1)
    others = np.setdiff1d(np.arange(mesh.nodes.shape[0]), mesh.elements[mesh.region == 1])
    assert np.all(load[others] == 0.0)


def test_load_of_a_linear_function() -> None:
    """Catches weights put on the wrong nodes: ∫ s dr dz and ∫ z dr dz over region 1 by nodal values."""
    mesh = cylinder()
    load = region_load(mesh, 1)
    assert load @ mesh.nodes[:, 0] == pytest.approx(7 / 6, rel=1e-5)  # ∫ r²/2 from 1 to 2
    assert load @ mesh.nodes[:, 1] == pytest.approx(0.5, rel=1e-5)


def test_circuit_adds_its_conductors_with_their_signs() -> None:
    """Catches turns of the other sense counted forwards."""
    mesh = cylinder()
    found = circuit(mesh, "pair", [Conductor(0, 2.0), Conductor(1, -3.0)], 4.0)
    assert found.density == pytest.approx(2 * region_load(mesh, 0) - 3 * region_load(mesh, 1))
    assert found.current == 4.0


def test_current_density_counts_circuits_and_sources() -> None:
    """Catches J without the current, or a solid ring's J/r taken for a winding's."""
    mesh = cylinder()
    circuits = (Circuit("a", np.zeros(0), 2.0, (Conductor(0, 5.0), Conductor(1, 7.0, by_radius=True))),)
    sources = (Circuit("", np.zeros(0), 1.0, (Conductor(0, 100.0),)),)
    uniform, by_radius = current_density(Problem(mesh, (MagneticMaterial(),) * 3, circuits, sources))
    assert uniform.tolist() == [110.0, 0.0, 0.0]
    assert by_radius.tolist() == [0.0, 14.0, 0.0]
