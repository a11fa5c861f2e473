"""A planar field that is zero on the rim of the unit square, without a symmetry that might help.

A = sin(πx) sin(πy) eˣ, with ν = 1.
"""

from __future__ import annotations

import numpy as np
from manufactured import circle, polygon

from fluxbore.fem.mesh import Floats
from fluxbore.fem.outline import Outline, Seed


def wave(points: Floats) -> Floats:
    x, y = points[..., 0], points[..., 1]
    return np.asarray(np.sin(np.pi * x) * np.sin(np.pi * y) * np.exp(x))


def wave_field(points: Floats) -> Floats:
    """(∂A/∂y, −∂A/∂x)."""
    x, y = points[..., 0], points[..., 1]
    s, c = np.sin(np.pi * x), np.cos(np.pi * x)
    along = np.pi * s * np.cos(np.pi * y)
    across = -(np.pi * c + s) * np.sin(np.pi * y)
    return np.stack((along, across), axis=-1) * np.exp(x)[..., None]


def wave_density(points: Floats) -> Floats:
    """−ΔA, with ν = 1."""
    x, y = points[..., 0], points[..., 1]
    s, c = np.sin(np.pi * x), np.cos(np.pi * x)
    return np.asarray(((2 * np.pi**2 - 1) * s - 2 * np.pi * c) * np.sin(np.pi * y) * np.exp(x))


def square() -> Outline:
    """The unit square, region 0, with a disc inside, region 1."""
    corners = [(0, 0), (1, 0), (1, 1), (0, 1), (0.25, 0.45), (0.65, 0.45)]
    curves = (*polygon(0, 4, 0), *circle(4, size=0.1))
    return Outline("planar", np.array(corners, dtype=float), curves, (Seed((0.1, 0.1), 0), Seed((0.45, 0.45), 1)))


INNER = (0.45, 0.45), 0.2
"""Middle and radius of the disc."""
