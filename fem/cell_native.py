"""A mapped mesh's equations by the compiled kernels, in cells of fourth order; factors are in single precision."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from fluxbore.fem import native
from fluxbore.fem.cell_band import CellFactor, Places
from fluxbore.fem.cell_matrices import Precision, slope_products
from fluxbore.fem.cell_model import CellModel
from fluxbore.fem.cells import Cells
from fluxbore.fem.factors import SingularMatrixError
from fluxbore.fem.linear import check_finite
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.tensor_product import side, square

ORDER = 4

TILE = 16
"""The band is kept in squares of so many rows and columns."""


@dataclass(frozen=True, slots=True, eq=False)
class _Parts:
    """Cells without what is inside of them, in single precision, as kernels.h lays them out."""

    edge: Any
    inverse: Any
    coupling: Any

    @property
    def pointers(self) -> native.Parts:
        return native.Parts(self.edge.ctypes.data, self.inverse.ctypes.data, self.coupling.ctypes.data)


def _parts(count: int) -> _Parts:
    shape = square(ORDER)
    e, i = shape.edge, shape.nodes - shape.edge
    return _Parts(*(np.empty((count, *rest), dtype=np.float32) for rest in ((e, e), (i, e), (i, e))))


class CellNative:
    """See `CellKernels`."""

    def __init__(self, model: CellModel, functions: native.Functions) -> None:
        """model : its cells are of fourth order."""
        assert model.cells.square.order == ORDER
        self._run, self._model, self._kept = functions, model, list[Any]()
        self._tiles = _tiles(model.where)
        self._mesh = native.Mesh(
            **self._sizes(), **{name: self._address(array) for name, array in self._arrays().items()}
        )

    def _address(self, array: Any) -> int:
        """Of an array, which from now on lives as long as this does."""
        whole = np.ascontiguousarray(array)
        self._kept.append(whole)
        return int(whole.ctypes.data)

    def _sizes(self) -> dict[str, int]:
        model = self._model
        rows, columns = model.cells.shape
        return {
            "rows": rows,
            "columns": columns,
            "irons": model.iron.size,
            "most": max((curve.coefficients.shape[1] for curve, _ in model.curves), default=0),
            "rim_edges": 0 if model.rim is None else model.rim.nodes.shape[0],
            "unknowns": model.where.kept.size,
            "tiles": self._tiles.count,
        }

    def _arrays(self) -> dict[str, Any]:
        model, cells = self._model, self._model.cells
        polynomials = side(ORDER)
        points, weights = polynomials.gauss
        nu_r, nu_z = model.reluctivity
        curve, place = np.full(cells.region.size, -1, dtype=np.int32), np.empty(cells.region.size, dtype=np.int32)
        for number, (_, part) in enumerate(model.curves):
            curve[model.iron[part]] = number
        for chosen in (model.iron, model.others):
            place[chosen] = np.arange(chosen.size)
        found = {
            "width": cells.widths,
            "height": cells.heights,
            "inverse_radius": cells.inverse_radius_of_columns,
            "nu_r": nu_r.astype(float),
            "nu_z": nu_z.astype(float),
            "curve": curve,
            "iron": model.iron.astype(np.int32),
            "others": model.others.astype(np.int32),
            "place": place,
            "steps": np.array([curve.step for curve, _ in model.curves], dtype=float),
            "intervals": np.array([curve.coefficients.shape[1] for curve, _ in model.curves], dtype=np.int64),
            "coefficients": _coefficients([curve.coefficients for curve, _ in model.curves]),
            "value": polynomials.values(points),
            "slope": polynomials.slopes(points),
            "gauss": weights,
            "nodes": np.stack((cells.square.rows, cells.square.columns), axis=1).astype(np.int32),
            "is_free": model.free.astype(np.uint8),
            "load": model.load,
            "across": _across(),
            "along": _along(cells),
            "number": self._tiles.number,
            "target": self._tiles.target,
        }
        if model.rim is not None:
            found |= {"rim_nodes": model.rim.nodes.astype(np.int64), "rim_matrices": model.rim.matrices}
        return found

    def residual(self, psi: Floats) -> tuple[Floats, Floats]:
        """Of nodal ψ, with the tensor."""
        whole, tensor = _checked(psi, self._model.load.shape), np.empty(self._tensor_shape)
        forces = np.empty_like(whole)
        self._done("residual", whole.ctypes.data, forces.ctypes.data, tensor.ctypes.data)
        return forces, tensor

    def product(self, tensor: Floats, columns: Floats) -> Floats:
        """With nodal fields (n, k)."""
        whole, tensor = self._rows(columns), _checked(tensor, self._tensor_shape)
        found = np.empty_like(whole)
        for one, image in zip(whole, found, strict=True):
            self._done("product", tensor.ctypes.data, one.ctypes.data, image.ctypes.data)
        return found.T

    def linear(self, precision: Precision) -> _Parts:
        """The cells without iron."""
        assert precision is np.float32
        found = _parts(self._model.others.size)
        self._definite("condense_linear", found.pointers)
        return found

    def factor(self, tensor: Floats, precision: Precision, linear: _Parts) -> NativeFactor:
        """Of all cells' edges."""
        assert precision is np.float32
        tensor = _checked(tensor, self._tensor_shape)
        check_finite(tensor)
        iron = _parts(self._model.iron.size)
        self._definite("condense_iron", tensor.ctypes.data, iron.pointers)
        band = np.empty((self._tiles.blocks, self._tiles.count, TILE, TILE), dtype=np.float32)
        self._definite("factorise", linear.edge.ctypes.data, iron.edge.ctypes.data, band.ctypes.data)
        return NativeFactor(self, band, linear, iron)

    @property
    def _tensor_shape(self) -> tuple[int, ...]:
        return 3, self._model.iron.size, self._model.cells.square.points

    def _rows(self, columns: Floats) -> Floats:
        """Nodal (n, k) as the library reads them, one after another."""
        return _checked(columns.T, (columns.shape[1], self._model.load.size))

    def _done(self, name: str, *arguments: Any) -> None:
        if self._run[name](self._mesh, *arguments):
            raise MemoryError(f"no memory for the kernel {name}")

    def _definite(self, name: str, *arguments: Any) -> None:
        if self._run[name](self._mesh, *arguments):
            raise SingularMatrixError("the matrix is not positive definite")

    def solved(self, band: Any, linear: _Parts, iron: _Parts, columns: Floats) -> Floats:
        """(n, k) by a factor, which is read once for all columns."""
        right = self._rows(columns)
        found = np.empty_like(right)
        addresses = right.ctypes.data, found.ctypes.data
        self._done("solve", band.ctypes.data, linear.pointers, iron.pointers, right.shape[0], *addresses)
        return found.T


def _checked(array: Floats, shape: tuple[int, ...]) -> Floats:
    """As the library reads it, which knows no size but its own; raises ValueError."""
    if array.shape != shape:
        raise ValueError(f"expected an array of shape {shape}, got {array.shape}")
    return np.ascontiguousarray(array, dtype=float)


class NativeFactor(CellFactor):
    """By tiles, in single precision: four or five digits."""

    def __init__(self, cells: CellNative, band: Any, linear: _Parts, iron: _Parts) -> None:
        super().__init__()
        self._cells, self._band, self._linear, self._iron = cells, band, linear, iron

    def _solved(self, columns: Floats) -> Floats:
        return self._cells.solved(self._band, self._linear, self._iron, columns)


@dataclass(frozen=True, slots=True, eq=False)
class _Tiles:
    """Where cells land in a band of tiles (blocks, count, TILE, TILE), in each block of columns the diagonal's first.

    number : (n,) unknown of each node, or −1. target : (m, pairs) in the band of each entry of the lower triangle of a
    cell's edge, or −1.
    """

    blocks: int
    count: int
    number: Ints
    target: Ints


@lru_cache(maxsize=4)
def _tiles(where: Places) -> _Tiles:
    """Of a topology, made once for its designs and positions."""
    count = -(-where.bandwidth // TILE) + 1
    unknown = where.number[where.edge]
    one, other = (unknown[:, k] for k in np.tril_indices(unknown.shape[1]))
    row, column = np.maximum(one, other), np.minimum(one, other)
    tile = column // TILE * count + row // TILE - column // TILE
    target = np.where(column >= 0, (tile * TILE + column % TILE) * TILE + row % TILE, -1)
    return _Tiles(-(-where.kept.size // TILE), count, where.number.astype(np.int32), target.astype(np.int32))


def _coefficients(curves: list[Floats]) -> Floats:
    """(curves, most, 4) of curves' (4, intervals)."""
    found = np.zeros((len(curves), max((curve.shape[1] for curve in curves), default=0), 4))
    for own, curve in zip(found, curves, strict=True):
        own[: curve.shape[1]] = curve.T
    return found


def _across() -> Floats:
    """(n, n) ∫ ∂_s φ ∂_s φᵀ on the unit square."""
    shape = square(ORDER)
    return np.asarray((shape.weights @ slope_products(ORDER)[: shape.points]).reshape(shape.nodes, -1))


def _along(cells: Cells) -> Floats:
    """(columns, n, n) ∫ 1/r² ∂_z φ ∂_z φᵀ on a square of unit width and height, by column.

    A rectangle of width w in s and height h in z has the matrix ν_z h/w `_across` + ν_r w/h `_along`.
    """
    shape = cells.square
    weights = shape.weights * cells.metric[: cells.shape[1]]
    return np.asarray((weights @ slope_products(ORDER)[-shape.points :]).reshape(-1, shape.nodes, shape.nodes))
