"""The quadratic triangle: shape functions, quadrature, and the curl-curl kernel in a chart.

With ψ = r·A_φ and s = r²/2 the axisymmetric problem has the energy  ∫ w(|B|) r dr dz  with
B_z = ∂ψ/∂s and B_r = −(1/r) ∂ψ/∂z, so its weak form is

    ∫ ν [ ∂ψ/∂s ∂v/∂s + 1/(2s) ∂ψ/∂z ∂v/∂z ] ds dz
        = ∫ J v/√(2s) ds dz + ∫ ν_pm (B_rem,z ∂v/∂s − B_rem,r/√(2s) ∂v/∂z) ds dz .

The planar problem is the same with both weights 1. The 2π of revolution is the caller's.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fluxbore.fem.mesh import Chart, Floats, Ints, Mesh, in_space

# Radon's seven-point rule, exact to degree five on a triangle (Radon 1948; Strang and Fix 1973, Table 4.1).
_A, _B = (6 - np.sqrt(15)) / 21, (6 + np.sqrt(15)) / 21
QUADRATURE_POINTS = np.array(
    [
        [1 / 3, 1 / 3, 1 / 3],
        [1 - 2 * _A, _A, _A],
        [_A, 1 - 2 * _A, _A],
        [_A, _A, 1 - 2 * _A],
        [1 - 2 * _B, _B, _B],
        [_B, 1 - 2 * _B, _B],
        [_B, _B, 1 - 2 * _B],
    ]
)
"""(7, 3) barycentric coordinates."""

QUADRATURE_WEIGHTS = np.array([9 / 40] + [(155 - np.sqrt(15)) / 1200] * 3 + [(155 + np.sqrt(15)) / 1200] * 3)
"""(7,) summing to one: multiply by the triangle's area."""


def shape(barycentric: Floats) -> Floats:
    """Values (..., 6) of the shape functions at barycentric coordinates (..., 3): corners, then middles 12, 23, 31."""
    a, b, c = np.moveaxis(barycentric, -1, 0)
    return np.stack((a * (2 * a - 1), b * (2 * b - 1), c * (2 * c - 1), 4 * a * b, 4 * b * c, 4 * c * a), axis=-1)


def shape_derivatives(barycentric: Floats) -> Floats:
    """Derivatives (..., 6, 2) by the second and third barycentric coordinate, the first being 1 − b − c."""
    a, b, c = np.moveaxis(barycentric, -1, 0)
    zero = np.zeros_like(a)
    by_b = np.stack((1 - 4 * a, 4 * b - 1, zero, 4 * (a - b), 4 * c, -4 * c), axis=-1)
    by_c = np.stack((1 - 4 * a, zero, 4 * c - 1, -4 * b, 4 * b, 4 * (a - c)), axis=-1)
    return np.stack((by_b, by_c), axis=-1)


@dataclass(frozen=True, slots=True)
class Kernel:
    """Everything about the elements that does not depend on the field.

    curl : (m, q, 2, 6) flux density per unit of ψ at the quadrature points, in the orthonormal frame of the chart:
        row 0 gives B_z (axisymmetric) or −B_y (planar), row 1 gives −B_r or B_x; the sum of squares is |B|².
    weight : (m, q) quadrature weights times the Jacobian, ds dz (m³) or dx dy (m²).
    """

    curl: Floats
    weight: Floats


def kernel(mesh: Mesh, elements: Ints | None = None, barycentric: Floats = QUADRATURE_POINTS) -> Kernel:
    """The kernel of all elements, or of the given ones, at the given points of each element.

    Elements may be curved: the six nodes carry the geometry as well. ``weight`` is meaningful only at the points of
    `QUADRATURE_POINTS`.
    """
    connectivity = mesh.elements if elements is None else mesh.elements[elements]
    nodes = mesh.nodes[connectivity]
    derivatives = shape_derivatives(barycentric)
    # (m, q, 2, 2): derivative of the two chart coordinates by the two reference coordinates.
    jacobian = np.einsum("mnk,qnd->mqkd", nodes, derivatives, optimize=True)
    determinant = jacobian[..., 0, 0] * jacobian[..., 1, 1] - jacobian[..., 0, 1] * jacobian[..., 1, 0]
    inverse = np.empty_like(jacobian)
    inverse[..., 0, 0], inverse[..., 1, 1] = jacobian[..., 1, 1], jacobian[..., 0, 0]
    inverse[..., 0, 1], inverse[..., 1, 0] = -jacobian[..., 0, 1], -jacobian[..., 1, 0]
    inverse /= determinant[..., None, None]
    gradient = np.einsum("qnd,mqdk->mqkn", derivatives, inverse, optimize=True)
    curl = gradient
    if mesh.chart == "axisymmetric":
        s = np.einsum("mn,qn->mq", nodes[..., 0], shape(barycentric), optimize=True)
        curl[:, :, 1, :] *= _inverse_radius(s)[..., None]
    count = barycentric.shape[0]
    weights = QUADRATURE_WEIGHTS if count == QUADRATURE_WEIGHTS.size else np.full(count, 1 / count)
    return Kernel(curl, np.abs(determinant) / 2 * weights)


def _inverse_radius(s: Floats) -> Floats:
    """1/√(2s); zero on the axis itself, where ∂ψ/∂z vanishes faster than the radius."""
    return np.asarray(np.divide(1.0, np.sqrt(2 * np.maximum(s, 0.0)), out=np.zeros_like(s), where=s > 0))


def flux_density_squared(curl: Floats, psi: Floats) -> tuple[Floats, Floats]:
    """B (m, q, 2) in the kernel's frame and |B|² (m, q) of nodal values ψ (m, 6)."""
    field = np.einsum("mqkn,mn->mqk", curl, psi, optimize=True)
    return field, np.einsum("mqk,mqk->mq", field, field)


def stiffness(curl: Floats, factor: Floats) -> Floats:
    """Element matrices (m, 6, 6) of  ∫ ν B(ψ)·B(v).

    factor : ν times quadrature weight, (m, q), or (m, q, 2) for each row of the kernel's frame.
    """
    m, q, two, six = curl.shape
    flat = curl.reshape(m, q * two, six)
    rows = np.repeat(factor, two, axis=1) if factor.ndim == 2 else factor.reshape(m, q * two)
    return np.asarray(flat.transpose(0, 2, 1) @ (flat * rows[..., None]))


def to_frame(chart: Chart, vectors: Floats) -> Floats:
    """(..., 2) vectors along (r, z) or (x, y) in the kernel's frame; both rows change sign together, so H·B holds."""
    first, second = vectors[..., 0], vectors[..., 1]
    return np.stack((second, -first) if chart == "axisymmetric" else (-second, first), axis=-1)


def from_frame(chart: Chart, vectors: Floats) -> Floats:
    """(..., 2) vectors of the kernel's frame along (r, z) or (x, y)."""
    first, second = vectors[..., 0], vectors[..., 1]
    return np.stack((-second, first) if chart == "axisymmetric" else (second, -first), axis=-1)


def positions(mesh: Mesh, elements: Ints | None = None, barycentric: Floats = QUADRATURE_POINTS) -> Floats:
    """(m, q, 2) the points of each element in space, m."""
    nodes = mesh.nodes[mesh.elements if elements is None else mesh.elements[elements]]
    return in_space(mesh.chart, np.einsum("qn,mnk->mqk", shape(barycentric), nodes, optimize=True))


KEPT_KERNELS = 3
"""Of groups of elements, such as iron, magnets and the shell of air that forces are measured in."""


class Kernels:
    """The kernel of a mesh, and of some of its elements without that of all where nobody has asked for it."""

    def __init__(self, mesh: Mesh) -> None:
        self._mesh = mesh
        self._of_some: dict[bytes, Kernel] = {}

    @cached_property
    def kernel(self) -> Kernel:
        """Of all elements."""
        return kernel(self._mesh)

    def kernel_of(self, elements: Ints) -> Kernel:
        """Of some elements. The last few are kept: several figures are of the same elements."""
        if "kernel" in self.__dict__:
            return Kernel(self.kernel.curl[elements], self.kernel.weight[elements])
        code = elements.tobytes()
        if code not in self._of_some:
            if len(self._of_some) == KEPT_KERNELS:
                del self._of_some[next(iter(self._of_some))]
            self._of_some[code] = kernel(self._mesh, elements)
        return self._of_some[code]
