"""Meshes of a period: the magnets' edges are lines at any displacement, and what is folded is one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from rotlin_section import PERIOD, backed, ideal

from fluxbore.fem.element import kernel
from fluxbore.fem.helical_mesh import helical_mesh, member_lines
from fluxbore.geometry.helical_bands import Bands, Segment, alternating
from fluxbore.geometry.helical_section import HelicalSection

UNLIKE = Bands((Segment(0.0, 0.45, 1.0, 1.0), Segment(0.45, 1.0, -1.0, -1.0)))
"""A south band wider than the north band: the field has no half period."""

AREA = (20.75e-3 - 14.95e-3) * PERIOD


@pytest.mark.parametrize("displacement", [0.0, 0.01, 0.2345, 0.5, -1.7, 3.9])
@pytest.mark.parametrize("inner", [alternating(1.0), alternating(1.0, 0.6), UNLIKE])
def test_no_displacement_turns_a_cell_over(inner: Bands, displacement: float) -> None:
    """Catches cells sheared by more than they can bear, and a period that is not covered once."""
    grid = helical_mesh(ideal(inner, alternating(1.0, 0.9), displacement * PERIOD))
    frame = kernel(grid.mesh)
    corners = grid.mesh.nodes[grid.mesh.elements[:, :3]]
    sides = corners[:, 1:] - corners[:, :1]
    areas = (sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0]) / 2
    assert np.all(areas > 0)
    assert frame.weight.sum() * grid.copies == pytest.approx(AREA, rel=1e-12)


@pytest.mark.parametrize("displacement", [0.0, 0.2345, -1.7])
def test_magnets_edges_are_lines(displacement: float) -> None:
    """Catches an edge of a displaced band inside a cell, where the field's order would be lost."""
    section = ideal(alternating(1.0, 0.6), alternating(1.0, 0.8, 0.2), displacement * PERIOD)
    grid = helical_mesh(section)
    for number, moved in ((0, 0.0), (2, section.displacement)):
        profile = section.layers[number].magnets
        assert profile is not None
        corners = grid.mesh.nodes[grid.mesh.elements[grid.layer == number][:, :3], 1]
        inside = (corners + 1e-3 * (corners.mean(axis=1, keepdims=True) - corners) - moved) / PERIOD
        values = profile.remanence(inside)
        assert np.ptp(values, axis=1).max() == 0.0
        assert set(np.unique(np.abs(values))) == {0.0, 1.0}


def test_the_number_of_unknowns_is_the_same_at_any_displacement() -> None:
    """Catches a new pattern, and with it a jump of the figures, for each displacement."""
    sections = [ideal(alternating(1.0), alternating(1.0), x * PERIOD) for x in (0.0, 0.3, 1.1)]
    assert len({id(helical_mesh(section).mesh.topology) for section in sections}) == 1


def test_half_a_period_only_where_the_field_mirrors() -> None:
    """Catches half a mesh for bands of unlike widths."""
    assert helical_mesh(ideal(alternating(1.0), alternating(1.0))).copies == 2
    assert helical_mesh(ideal(alternating(1.0), UNLIKE)).copies == 1


def test_meshes_are_nested() -> None:
    """Catches a refined mesh that moves the coarse one's lines: no rate could be measured on it."""
    layers = ideal(alternating(1.0, 0.6), UNLIKE).layers[:1]
    coarse, fine = (member_lines(layers, refinement, 2) for refinement in (1, 3))
    assert np.allclose(fine[::3], coarse, rtol=0, atol=1e-15)


def test_unknowns_of_a_closed_section() -> None:
    """Catches a potential without a zero, or with two, and an axis whose nodes are not one."""
    section: HelicalSection = backed(UNLIKE, 100.0)
    grid = helical_mesh(section)
    tied = grid.mesh.topology
    rows = (tied.freedom.size // (2 * np.unique(grid.mesh.nodes[:, 0]).size)) * 2
    columns = tied.freedom.size // (rows + 1)
    assert tied.unknowns == rows * columns - 1
    to_axis = helical_mesh(replace(section, inner_radius=0.0)).mesh.topology
    assert to_axis.unknowns == rows * (columns - 1) + 1 - 1
