"""The field along a path, and FEMM's line integrals over it.

On an interface the values are those of its left side, as in FEMM, whose normal points there too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fluxbore.design.errors import SpecError
from fluxbore.fem.femm_solution import FemmSolution
from fluxbore.fem.mesh import Floats
from fluxbore.fem.paths import Path, Stations, integrate
from fluxbore.fem.probe import Probe, field_in, locate

SAMPLES = 201
"""Of a table, where no number is asked for."""

INTEGRAL_ACCURACY = 1e-5
"""Of the quadrature, as a share of the integral of the integrand's size: well below the field's own error."""

_ASIDE = 1e-8
"""How far to the left of the path the field is taken, as a share of the mesh's diagonal; beyond the locator's snap."""


@dataclass(frozen=True, slots=True, eq=False)
class LineTable:
    """stations : where. field : what is there. axisymmetric : the potential is r·A then. unit : (m, name) of the file's
    lengths."""

    stations: Stations
    field: Probe
    axisymmetric: bool
    unit: tuple[float, str]

    def columns(self) -> dict[str, Floats]:
        """(k,) each, by heading; lengths in the file's unit, all else SI."""
        metres, name = self.unit
        first, second = ("r", "z") if self.axisymmetric else ("x", "y")
        at, b, h = self.stations, self.field.flux_density, self.field.field_strength
        return {
            f"distance ({name})": at.distance / metres,
            f"{first} ({name})": at.points[:, 0] / metres,
            f"{second} ({name})": at.points[:, 1] / metres,
            "r A (Wb/rad)" if self.axisymmetric else "A (Wb/m)": self.field.potential,
            f"B_{first} (T)": b[:, 0],
            f"B_{second} (T)": b[:, 1],
            f"H_{first} (A/m)": h[:, 0],
            f"H_{second} (A/m)": h[:, 1],
            "B_n (T)": _dot(b, at.normals),
            "B_t (T)": _dot(b, at.tangents),
            "H_n (A/m)": _dot(h, at.normals),
            "H_t (A/m)": _dot(h, at.tangents),
            "|B| (T)": np.hypot(*b.T),
            "|H| (A/m)": np.hypot(*h.T),
        }

    def csv(self) -> str:
        """A line of headings and one for each place; ten digits."""
        columns = self.columns()
        rows = np.column_stack(list(columns.values()))
        return "\n".join([",".join(columns), *(",".join(f"{v:.10g}" for v in row) for row in rows.tolist()), ""])


@dataclass(frozen=True, slots=True)
class LineIntegrals:
    """FEMM's line integrals, by their numbers there.

    0. flux : Wb, through the surface that the path sweeps over the depth or round the axis; mean_flux_density : T.
    1. mmf : ∫H·t dl (A); mean_tangential_field : A/m.
    2. length : m. surface : m².
    3. force : N, ∫ T·n dA in (x, y), or axial alone, (0, z). Of a closed path that runs clockwise, the force on what is
       inside: the normal points out of it then.
    4. torque : N m about the origin, zero in an axisymmetric problem.
    5. squared : ∫(B·n)² dl (T² m); mean_squared : T².
    errors : of the quadrature, of 1, 3 (both), 4 and 5.
    """

    flux: float
    mean_flux_density: float
    mmf: float
    mean_tangential_field: float
    length: float
    surface: float
    force: tuple[float, float]
    torque: float
    squared: float
    mean_squared: float
    errors: tuple[float, float, float, float, float]


def line_values(solution: FemmSolution, path: Path, samples: int = SAMPLES) -> LineTable:
    """The field at places at equal distances along a path.

    Raises SpecError for a path that leaves the model.
    """
    stations = path.sample(samples)
    outline = solution.drawing.outline
    unit = outline.unit, outline.unit_name
    return LineTable(stations, _field(solution, stations), solution.model.axisymmetric, unit)


def line_integrals(solution: FemmSolution, path: Path) -> LineIntegrals:
    """All of FEMM's line integrals over a path.

    The flux is exact for the potential at the ends. The others are of the recovered field. Raises SpecError for a path
    that leaves the model.
    """
    axisymmetric = solution.model.axisymmetric
    extent = solution.solution.problem.extent
    ends = _field(solution, path.at(np.array([0.0, path.length]))).potential
    flux = extent * float(ends[1] - ends[0] if axisymmetric else ends[0] - ends[1])

    def integrands(at: Stations) -> Floats:
        """(k, 6) of 1, 3 (two), 4, 5, and of the surface."""
        field = _field(solution, at)
        b, h = field.flux_density, field.field_strength
        across = _dot(b, at.normals)
        traction = (h * across[:, None] + b * _dot(h, at.normals)[:, None] - at.normals * _dot(b, h)[:, None]) / 2
        width = extent * at.points[:, 0] if axisymmetric else np.full(across.shape, extent)
        turning = at.points[:, 0] * traction[:, 1] - at.points[:, 1] * traction[:, 0]
        return np.column_stack((_dot(h, at.tangents), width[:, None] * traction, width * turning, across**2, width))

    (mmf, first, second, torque, squared, surface), error = integrate(path, integrands, INTEGRAL_ACCURACY)
    if axisymmetric:
        first = torque = error[1] = error[3] = 0.0
    return LineIntegrals(
        flux,
        flux / float(surface) if surface > 0 else 0.0,
        float(mmf),
        float(mmf) / path.length,
        path.length,
        float(surface),
        (float(first), float(second)),
        float(torque),
        float(squared),
        float(squared) / path.length,
        (float(error[0]), float(error[1]), float(error[2]), float(error[3]), float(error[4])),
    )


def _field(solution: FemmSolution, at: Stations) -> Probe:
    """On the path's left; where the model ends there, on the path itself."""
    locator, mesh = solution.locator, solution.solution.problem.mesh
    size = float(np.hypot(*np.ptp(mesh.positions, axis=0)))
    elements, places = locator.find(at.points + _ASIDE * size * at.normals)
    lost = np.flatnonzero(elements < 0)
    if lost.size:
        elements[lost], places[lost] = locate(mesh, locator, at.points[lost])
    outside = np.flatnonzero(elements < 0)
    if outside.size:
        outline = solution.drawing.outline
        x, y = at.points[outside[0]] / outline.unit
        raise SpecError(f"A line must lie inside the model; it leaves it at ({x:.6g}, {y:.6g}) {outline.unit_name}.")
    return field_in(solution.solution, solution.field, elements, places, at.points)


def _dot(a: Floats, b: Floats) -> Floats:
    return np.asarray(np.sum(a * b, axis=1))
