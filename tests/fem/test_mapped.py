"""Mapped meshes: fixed topology, nested refinement, covered regions, nodes that move smoothly."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fluxbore.design.spec import Spec
from fluxbore.fem.element import kernel
from fluxbore.fem.mapped import MappedMesh, Subdivision, mapped_mesh
from fluxbore.fem.mesh import Mesh
from fluxbore.fem.tubular import R_CELLS, Z_CELLS
from fluxbore.geometry.cross_section import Breakpoints, CrossSection
from fluxbore.geometry.hybrid import cross_section


@given(st.integers(1, 12), st.floats(1.0, 2.5), st.sampled_from(["both", "start", "end"]), st.integers(1, 5))
@settings(max_examples=80, deadline=None)
def test_fractions(cells: int, growth: float, fine: str, refinement: int) -> None:
    """Catches lines out of order, ends that are missed, and a refined mesh that does not contain the coarse one."""
    division = Subdivision(cells, growth, fine)
    coarse, lines = division.fractions(1), division.fractions(refinement)
    assert lines[0] == 0
    assert lines[-1] == pytest.approx(1)
    assert lines.size == cells * refinement + 1
    assert np.all(np.diff(lines) > 0)
    assert lines[::refinement] == pytest.approx(coarse)
    size = np.diff(coarse)
    if fine == "both":
        assert size == pytest.approx(size[::-1])
    ratio = size[1:] / size[:-1]
    if fine == "start":
        assert ratio == pytest.approx(growth)
    if fine == "end":
        assert 1 / ratio == pytest.approx(growth)


def test_every_node_belongs_to_the_grid(block: Callable[..., MappedMesh]) -> None:
    """Catches an element whose middles are not between its corners, or that lies upside down or on another."""
    grid = block(4, 1.2)
    mesh = grid.mesh
    nodes = mesh.nodes[mesh.elements]
    for middle, (a, b) in zip((3, 4, 5), ((0, 1), (1, 2), (2, 0)), strict=True):
        np.testing.assert_allclose(nodes[:, middle], (nodes[:, a] + nodes[:, b]) / 2, atol=1e-16)
    assert np.unique(mesh.elements).size == mesh.nodes.shape[0]
    area = kernel(mesh).weight.sum(axis=1)
    assert np.all(area > 0)
    assert area.sum() == pytest.approx(0.1**2 / 2 * 0.2)
    assert mesh.nodes[grid.node(3, 2)] == pytest.approx([grid.r_nodes[2], grid.z_nodes[3]])


def test_only_the_rim_is_prescribed(block: Callable[..., MappedMesh]) -> None:
    """Catches an axis or a far boundary that floats, or an inner node that is held."""
    mesh = block(3).mesh
    s, z = mesh.nodes.T
    rim = (s == 0) | (s == s.max()) | (z == 0) | (z == z.max())
    assert np.array_equal(mesh.topology.freedom < 0, rim)
    assert mesh.topology.unknowns == np.count_nonzero(~rim)
    assert np.array_equal(mesh.topology.freedom[mesh.topology.nodes_of_freedom], np.arange(mesh.topology.unknowns))


def test_an_open_rim_is_unknown_but_for_the_axis(block: Callable[..., MappedMesh]) -> None:
    """Catches an axis that floats, and far edges that stay at zero."""
    closed = block(3)
    section = CrossSection(
        Breakpoints((0.0, 0.1), ("r",)),
        Breakpoints((0.0, 0.2), ("z",)),
        (),
        np.zeros((1, 1), dtype=int),
        (),
        (),
        (0, 0),
    )
    mesh = mapped_mesh(section, {"r": Subdivision(3)}, {"z": Subdivision(3)}, open_rim=True).mesh
    assert np.array_equal(mesh.elements, closed.mesh.elements)
    assert np.array_equal(mesh.topology.freedom < 0, mesh.nodes[:, 0] == 0)
    assert mesh.topology.unknowns == np.count_nonzero(mesh.nodes[:, 0] > 0)


def test_positions_are_radii(block: Callable[..., MappedMesh]) -> None:
    """Catches a picture in s instead of in r."""
    mesh = block(3).mesh
    assert mesh.positions[:, 0].max() == pytest.approx(0.1)
    planar = Mesh("planar", mesh.nodes, mesh.region, mesh.topology)
    assert planar.positions is mesh.nodes


def test_the_motor_keeps_one_topology_over_its_stroke(spec: Spec) -> None:
    """Catches a breakpoint that crosses another on the way: the jump would look like a force."""
    actuator = spec.actuator
    half = actuator.mover.stroke / 2
    topologies = {
        id(mapped_mesh(cross_section(actuator, z, spec.materials, 293.15), R_CELLS, Z_CELLS).mesh.topology)
        for z in np.linspace(actuator.mid_stroke - half, actuator.mid_stroke + half, 12)
    }
    assert len(topologies) == 1


def test_ring_width_and_thickness_do_not_change_the_topology(spec: Spec) -> None:
    """Catches remeshing between two designs of a study."""
    topologies = {
        id(
            mapped_mesh(
                cross_section(spec.with_values({key: value}).actuator, 0.027, spec.materials, 293.15), R_CELLS, Z_CELLS
            ).mesh.topology
        )
        for key, value in (
            ("actuator.mover.ring_width", 0.5e-3),
            ("actuator.mover.ring_width", 11.5e-3),
            ("actuator.back_yoke.thickness", 0.5e-3),
            ("actuator.mover.outer_diameter", 15e-3),
        )
    }
    assert len(topologies) == 1


def test_regions_have_their_parts_volumes(spec: Spec) -> None:
    """Catches a part painted over its neighbour: volumes of regions in the mesh against the dimensions."""
    actuator = spec.actuator
    section = cross_section(actuator, 0.0273, spec.materials, 293.15)
    mesh = mapped_mesh(section, R_CELLS, Z_CELLS).mesh
    volume = 2 * np.pi * np.bincount(mesh.region, kernel(mesh).weight.sum(axis=1))
    by_name = {region.name: volume[i] for i, region in enumerate(section.regions)}
    mover, yoke = actuator.mover, actuator.back_yoke
    tube = np.pi / 4 * (mover.outer_diameter**2 - actuator.shaft.outer_diameter**2)
    assert by_name["ring"] == pytest.approx(8 * tube * mover.ring_width)
    assert sum(v for n, v in by_name.items() if n.startswith("magnet")) == pytest.approx(8 * tube * 10.5e-3)
    length = actuator.yoke_end - actuator.yoke_start
    assert by_name["back yoke"] == pytest.approx(np.pi / 4 * (yoke.outer_diameter**2 - yoke.inner_diameter**2) * length)


def test_a_finer_mesh_holds_the_coarse_one(spec: Spec) -> None:
    """Catches refinements that are not nested, whose results would not converge at a rate."""
    section = cross_section(spec.actuator, 0.0273, spec.materials, 293.15)
    coarse, fine = (mapped_mesh(section, R_CELLS, Z_CELLS, k) for k in (1, 3))
    assert fine.r_lines[::3] == pytest.approx(coarse.r_lines, abs=1e-12)
    assert fine.z_lines[::3] == pytest.approx(coarse.z_lines, abs=1e-12)
    assert fine.mesh.elements.shape[0] == 9 * coarse.mesh.elements.shape[0]


def test_an_unknown_interval_is_an_error(spec: Spec) -> None:
    """Catches a name without cells that is passed over in silence."""
    section = cross_section(spec.actuator, 0.0273, spec.materials, 293.15)
    with pytest.raises(KeyError):
        mapped_mesh(
            replace(section, r=replace(section.r, intervals=("odd", *section.r.intervals[1:]))), R_CELLS, Z_CELLS
        )
