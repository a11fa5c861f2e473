"""Solid axisymmetric finite elements of a lip's wall: no shell theory, by which that of its closed form is checked.

Quadrilaterals of eight nodes with four points of quadrature, which bend without locking. The bore holds one node of the
lip's end, at the middle of the wall or at its outer edge; pressure acts on the inner face.
"""

import math

import numpy as np

from fluxbore.design.lip import Lip

ALONG, ACROSS = 24, 2

CORNERS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])


def contact_force(lip: Lip, interference: float, pressure: float, edge: bool = False) -> float:
    """N, radial and all around, of the end's middle (or its outer edge) on the bore."""
    numbers = np.full((2 * ALONG + 1, 2 * ACROSS + 1), -1)
    used = [(i, j) for i in range(2 * ALONG + 1) for j in range(2 * ACROSS + 1) if not (i % 2 and j % 2)]
    numbers[tuple(np.transpose(used))] = np.arange(len(used))
    meridian, normal = (
        np.array([math.sin(lip.angle), math.cos(lip.angle)]),
        np.array([math.cos(lip.angle), -math.sin(lip.angle)]),
    )
    places = np.array(
        [
            [lip.inner_diameter / 2, 0.0]
            + meridian * lip.meridian * i / (2 * ALONG)
            + normal * lip.thickness * (j / (2 * ACROSS) - 0.5)
            for i, j in used
        ]
    )
    count = 2 * len(places)
    stiffness, load = np.zeros((count, count)), np.zeros(count)
    for i in range(0, 2 * ALONG, 2):
        for j in range(0, 2 * ACROSS, 2):
            nodes = numbers[[i, i + 2, i + 2, i, i + 1, i + 2, i + 1, i], [j, j, j + 2, j + 2, j, j + 1, j + 2, j + 1]]
            where = np.stack([2 * nodes, 2 * nodes + 1], axis=1).ravel()
            stiffness[np.ix_(where, where)] += _element(lip, places[nodes])
        inner = numbers[i : i + 3, 0]
        for a, weight in zip(*np.polynomial.legendre.leggauss(3), strict=True):
            shape = np.array([a * (a - 1) / 2, 1 - a * a, a * (a + 1) / 2])
            push = weight / 2 * lip.meridian / ALONG * 2 * math.pi * (shape @ places[inner, 0]) * pressure
            load[2 * inner] += push * normal[0] * shape
            load[2 * inner + 1] += push * normal[1] * shape
    held = 2 * numbers[-1, -1 if edge else ACROSS]
    root = np.concatenate([2 * numbers[0], 2 * numbers[0] + 1])
    free = np.setdiff1d(np.arange(count), np.append(root, held))
    moved = np.zeros(count)
    moved[held] = -interference
    rest = load - stiffness @ moved
    moved[free] = np.linalg.solve(stiffness[np.ix_(free, free)], rest[free])
    return float(load[held] - stiffness[held] @ moved)


def _element(lip: Lip, places: np.ndarray) -> np.ndarray:
    """(16, 16) stiffness (N/m) of one quadrilateral, all around."""
    nu = lip.poisson_ratio
    law = np.full((3, 3), nu) + (1 - 2 * nu) * np.eye(3)
    law = lip.young_modulus / ((1 + nu) * (1 - 2 * nu)) * np.block(
        [[law, np.zeros((3, 1))], [np.zeros((1, 3)), np.array([[(1 - 2 * nu) / 2]])]]
    )  # fmt: skip
    found = np.zeros((16, 16))
    for a, b in CORNERS / math.sqrt(3):
        shape, by_a, by_b = _shapes(a, b)
        jacobian = np.array([by_a, by_b]) @ places
        by_r, by_z = np.linalg.solve(jacobian, np.array([by_a, by_b]))
        radius = shape @ places[:, 0]
        strain = np.zeros((4, 16))
        strain[0, 0::2], strain[1, 1::2], strain[2, 0::2] = by_r, by_z, shape / radius
        strain[3, 0::2], strain[3, 1::2] = by_z, by_r
        found += strain.T @ law @ strain * abs(np.linalg.det(jacobian)) * 2 * math.pi * radius
    return found


def _shapes(a: float, b: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The eight functions and their derivatives: corners, then the middles of the sides."""
    u, v = CORNERS.T
    corner = (1 + u * a) * (1 + v * b) * (u * a + v * b - 1) / 4
    by_a = u * (1 + v * b) * (2 * u * a + v * b) / 4
    by_b = v * (1 + u * a) * (2 * v * b + u * a) / 4
    side = [(1 - a * a) * (1 - b) / 2, (1 + a) * (1 - b * b) / 2, (1 - a * a) * (1 + b) / 2, (1 - a) * (1 - b * b) / 2]
    side_a = [-a * (1 - b), (1 - b * b) / 2, -a * (1 + b), -(1 - b * b) / 2]
    side_b = [-(1 - a * a) / 2, -b * (1 + a), (1 - a * a) / 2, -b * (1 - a)]
    return np.append(corner, side), np.append(by_a, side_a), np.append(by_b, side_b)
