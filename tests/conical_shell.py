"""Finite elements of the whole conical shell, by which the lip's closed form is checked.

Kirchhoff and Love's thin shell of revolution with its membrane displacement u along the meridian, which the closed form
leaves out, and with the radius as it varies: Hermite's cubic for w, a straight line for u, energy by quadrature.
"""

import math

import numpy as np

from fluxbore.design.lip import Lip

ELEMENTS = 80


class ConicalShell:
    """One lip, clamped at its root, its tip pushed in by an interference (m) against a pressure inside (Pa)."""

    def __init__(self, lip: Lip, interference: float, pressure: float) -> None:
        self.lip = lip
        sine, cosine = math.sin(lip.angle), math.cos(lip.angle)
        size = lip.meridian / ELEMENTS
        membrane = lip.young_modulus * lip.thickness / (1 - lip.poisson_ratio**2)
        nu = lip.poisson_ratio
        count = 3 * (ELEMENTS + 1)
        matrix, load = np.zeros((count, count)), np.zeros(count)
        self.rows = []
        for element in range(ELEMENTS):
            where = np.arange(3 * element, 3 * element + 6)
            for point, weight in zip(*np.polynomial.legendre.leggauss(4), strict=True):
                x = (point + 1) / 2
                radius = lip.inner_diameter / 2 + (element + x) * size * sine
                u = np.array([1 - x, 0, 0, x, 0, 0])
                du = np.array([-1, 0, 0, 1, 0, 0]) / size
                w = np.array([0, 1 - 3 * x**2 + 2 * x**3, size * (x - 2 * x**2 + x**3),
                              0, 3 * x**2 - 2 * x**3, size * (x**3 - x**2)])  # fmt: skip
                dw = np.array([0, 6 * (x**2 - x), size * (1 - 4 * x + 3 * x**2),
                               0, 6 * (x - x**2), size * (3 * x**2 - 2 * x)]) / size  # fmt: skip
                ddw = np.array([0, 12 * x - 6, size * (6 * x - 4), 0, 6 - 12 * x, size * (6 * x - 2)]) / size**2
                strain = np.stack([du, (u * sine + w * cosine) / radius])
                bend = np.stack([-ddw, -sine / radius * dw])
                law = np.array([[1, nu], [nu, 1]])
                stiffness = strain.T @ law @ strain + lip.thickness**2 / 12 * bend.T @ law @ bend
                area = weight / 2 * size * 2 * math.pi * radius
                matrix[np.ix_(where, where)] += membrane * area * stiffness
                load[where] += pressure * area * w
                self.rows.append((where, strain, bend))
        tip = np.zeros(count)
        tip[-3:-1] = sine, cosine
        free = slice(3, None)
        whole = np.block([[matrix[free, free], tip[free, None]], [tip[None, free], np.zeros((1, 1))]])
        found = np.linalg.solve(whole, np.append(load[free], -interference))
        self.moved = np.concatenate([np.zeros(3), found[:-1]])
        self.force = float(found[-1])
        """N, radial, of tip on bore."""

    def stress(self) -> float:
        """Pa, the largest of von Mises at the points of quadrature, on both faces."""
        largest = 0.0
        nu = self.lip.poisson_ratio
        law = self.lip.young_modulus / (1 - nu**2) * np.array([[1, nu], [nu, 1]])
        for where, strain, bend in self.rows:
            for height in (-self.lip.thickness / 2, self.lip.thickness / 2):
                along, around = law @ ((strain + height * bend) @ self.moved[where])
                largest = max(largest, math.sqrt(along**2 - along * around + around**2))
        return largest
