"""Figures of a tubular machine's field at one position as differentiable functionals.

A maximum is not differentiable where it changes its place, so the p-norm stands in for it: (mean of x^p)^(1/p), which
is below the maximum and meets it as p grows. Its exponent here is `EXPONENT`.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from fluxbore.fem.line_field import LineField
from fluxbore.fem.mapped import by_lines
from fluxbore.fem.mesh import Floats
from fluxbore.fem.tubular import TubularSolution, reverse_fields

EXPONENT = 32.0
"""p. The norm of a peak that fills a tenth of the place is 7 % below it."""


@dataclass(slots=True, eq=False)
class Functional:
    """A figure at one position, and how it changes with all it is made of while the rest stays.

    by_psi : (n,). s, z : (lines,) by the s and z of the grid's lines. limits : (2,) by its own two
    limits in z, where it has such. The others are of an incremental figure: windows (coils, 4), turns (coils,),
    reluctivity (regions,), poles (2,); coercivity (regions,) is of a figure of the magnets.
    adjoint : (n,) K_T⁻¹ ∂/∂ψ, where it is known already.
    """

    value: float
    by_psi: Floats
    s: Floats
    z: Floats
    limits: Floats = field(default_factory=lambda: np.zeros(2))
    windows: Floats | None = None
    turns: Floats | None = None
    reluctivity: Floats | None = None
    poles: Floats | None = None
    coercivity: Floats | None = None
    adjoint: Floats | None = None


def _blank(tubular: TubularSolution) -> Functional:
    grid = tubular.grid
    return Functional(
        0.0, np.zeros(tubular.solution.psi.size), np.zeros(grid.r_lines.size), np.zeros(grid.z_lines.size)
    )


def tube_norm(
    tubular: TubularSolution, r_range: tuple[float, float], z_range: tuple[float, float], exponent: float = EXPONENT
) -> Functional:
    """The p-norm of the axial flux density averaged over a tube's cross-section (T), over the grid's rows in a range.

    The flux through the tube between two radii is 2π (ψ_o − ψ_i), its area 2π (s_o − s_i).
    """
    grid, psi = tubular.grid, tubular.solution.psi
    inner, outer = (grid.column(r) for r in r_range)
    rows = np.flatnonzero((grid.z_nodes > z_range[0]) & (grid.z_nodes < z_range[1]))
    area = grid.r_nodes[outer] - grid.r_nodes[inner]
    density = (psi[grid.node(rows, outer)] - psi[grid.node(rows, inner)]) / area
    value, by_sample = norm(np.abs(density), exponent)
    found = _blank(tubular)
    found.value = value
    pull = by_sample * np.sign(density) / area
    found.by_psi[grid.node(rows, outer)] += pull
    found.by_psi[grid.node(rows, inner)] -= pull
    found.s[outer // grid.order], found.s[inner // grid.order] = -value / area, value / area
    return found


def norm(samples: Floats, exponent: float) -> tuple[float, Floats]:
    """(mean of x^p)^(1/p) of samples x >= 0 (k,), and its derivative by each."""
    largest = float(samples.max(initial=0.0))
    if largest == 0.0:
        return 0.0, np.zeros(samples.size)
    relative = samples / largest
    mean = float(np.mean(relative**exponent))
    value = largest * mean ** (1 / exponent)
    return value, (value / largest) ** (1 - exponent) * relative ** (exponent - 1) / samples.size


def shell_mean(tubular: TubularSolution, radius: float, z_range: tuple[float, float]) -> Functional:
    """The mean radial flux density (T) through a cylinder between two z; see `tubular.shell_flux_density`."""
    grid, psi = tubular.grid, tubular.solution.psi
    column = grid.column(radius)
    nodes = grid.node(np.arange(grid.z_nodes.size), column)
    profile = psi[nodes]
    start, end = np.interp(z_range, grid.z_nodes, profile)
    length = z_range[1] - z_range[0]
    scale = np.sign(end - start) / (radius * length)
    found = _blank(tubular)
    found.value = float(abs(end - start) / (radius * length))
    by_row = np.zeros(grid.z_nodes.size)
    for place, z, sign in ((0, z_range[0], -1.0), (1, z_range[1], 1.0)):
        row = int(np.clip(np.searchsorted(grid.z_nodes, z, side="right") - 1, 0, grid.z_nodes.size - 2))
        width = grid.z_nodes[row + 1] - grid.z_nodes[row]
        share = (z - grid.z_nodes[row]) / width
        slope = sign * scale * (profile[row + 1] - profile[row]) / width
        found.by_psi[nodes[row]] += sign * scale * (1 - share)
        found.by_psi[nodes[row + 1]] += sign * scale * share
        by_row[row] -= slope * (1 - share)
        by_row[row + 1] -= slope * share
        found.limits[place] = slope - sign * found.value / length
    found.z[:] = by_lines(by_row, grid.order)
    found.s[column // grid.order] = -found.value / radius**2  # ds = r dr
    return found


def line_norm(
    tubular: TubularSolution, radius: float, z_range: tuple[float, float], exponent: float = EXPONENT
) -> Functional:
    """The p-norm of |B| (T) along a cylinder between two z: (∫ |B|^p dz / length)^(1/p), straight between nodes.

    B at the nodes is that of the cells just inside, as in `tubular.stray_field`.
    """
    grid, psi = tubular.grid, tubular.solution.psi
    line = LineField(grid, radius, outside=False)
    b = line.field(psi)
    size = np.linalg.norm(b, axis=1)
    largest = float(size.max())
    relative = (size / largest) ** exponent
    integral, by_density, by_z, by_limits = clipped_integral(grid.z_nodes, relative, z_range)
    length = z_range[1] - z_range[0]
    value = largest * (integral / length) ** (1 / exponent)
    found = _blank(tubular)
    found.value = value
    outer = value / (exponent * integral)
    found.limits[:] = outer * (by_limits + np.array([integral / length, -integral / length]))
    by_size = outer * by_density * exponent * relative / np.where(size > 0, size, 1.0)
    pull = by_size[:, None] * b / np.where(size > 0, size, 1.0)[:, None]
    found.by_psi += line.by_psi(pull)
    by_s, moved = line.by_lines(psi, pull)
    found.s += by_s
    found.z += moved + by_lines(outer * by_z, grid.order)
    return found


def reverse_norm(tubular: TubularSolution, exponent: float = EXPONENT) -> Functional:
    """The p-norm over the magnets' volume of the field against the magnetisation (A/m), where there is one."""
    cells, materials = tubular.cells, tubular.solution.problem.materials
    found = _blank(tubular)
    found.reluctivity, found.coercivity = np.zeros(len(materials)), np.zeros(len(materials))
    magnets = reverse_fields(tubular)
    if not magnets:
        return found
    chosen = np.concatenate([own for _, own, _ in magnets])
    reverse = np.concatenate([field for _, _, field in magnets])
    largest = float(reverse.max())
    if largest <= 0:
        return found
    region, weight = cells.region[chosen], cells.weight[chosen]
    power = np.maximum(reverse / largest, 0.0) ** exponent
    volume, integral = float(weight.sum()), float(np.sum(weight * power))
    value = largest * (integral / volume) ** (1 / exponent)
    found.value = value
    sign = np.array([np.sign(material.remanence[1]) for material in materials])[region][:, None]
    nu = np.array([material.components[1] for material in materials])[region][:, None]
    change = sign * weight * value / integral * power / np.where(reverse > 0, reverse, 1.0)
    b_z, _ = cells.fields(tubular.solution.psi, chosen)
    pull = cells.pull_across(-nu * change, chosen)
    found.by_psi += np.bincount(cells.nodes[chosen].ravel(), pull.ravel(), found.by_psi.size)
    # What is integrated is carried along by the cells' area, and B_z = ∂ψ/∂s falls as a cell grows wider.
    area = np.sum(weight * value / exponent * (power / integral - 1 / volume), axis=1)
    stretch_s, stretch_z = np.zeros((2, cells.region.size))
    stretch_s[chosen], stretch_z[chosen] = area + np.sum(nu * change * b_z, axis=1), area
    nothing = np.zeros(cells.region.size)
    by_s, by_z = cells.on_lines(cells.start_and_end(stretch_s, nothing, nothing), stretch_z)
    found.s += by_s
    found.z += by_z
    found.coercivity += np.bincount(region, change.sum(axis=1), len(materials))
    found.reluctivity -= np.bincount(region, (change * b_z).sum(axis=1), len(materials))
    return found


def clipped_integral(x: Floats, f: Floats, limits: tuple[float, float]) -> tuple[float, Floats, Floats, Floats]:
    """∫ of what is straight between (x, f) (k,) from one limit to the other, both within x.

    Returns it with its derivatives by f (k,), by x (k,) and by the two limits (2,).
    """
    low, high = limits
    start, end = np.clip(x[:-1], low, high), np.clip(x[1:], low, high)
    width = np.diff(x)
    a, b = (start - x[:-1]) / width, (end - x[:-1]) / width
    # Of each interval's part, the integrals of the two hats.
    rising = width * (b**2 - a**2) / 2
    falling = width * (b - a) - rising
    by_f = np.zeros(x.size)
    by_f[:-1] += falling
    by_f[1:] += rising
    slope = np.diff(f) / width
    by_x = np.zeros(x.size)
    by_x[:-1] -= slope * falling
    by_x[1:] -= slope * rising
    at_low, at_high = np.interp(limits, x, f)
    return float(by_f @ f), by_f, by_x, np.array([-at_low, at_high])
