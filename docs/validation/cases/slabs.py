"""Problems of one dimension: laminated strips, and a mixed condition."""

from __future__ import annotations

from exact import layers
from exact.loops import MU_0

from cases.case import Case, Check, flux_density, linkage, potential
from cases.drawing import Drawing

MM = 1e-3


def laminated_strips() -> Case:
    """Strips side by side in an endless flat solenoid: the same H in all of them."""
    loading = 4000.0
    steel = layers.Steel()
    saturated = steel.flux_density(loading)
    drawing = Drawing(False, depth=100)
    copper, wall = drawing.material("Copper"), drawing.boundary("A=0")
    strips = (
        (drawing.material("Sheets in the plane", 1000, fill=0.9), MU_0 * loading * layers.stacked(1000, 0.9, True)),
        (
            drawing.material("Sheets along x", 100, lamination="parallel to x", fill=0.9),
            MU_0 * loading * layers.stacked(100, 0.9, False),
        ),
        (
            drawing.material("Sheets along y", 100, lamination="parallel to y", fill=0.9),
            MU_0 * loading * layers.stacked(100, 0.9, True),
        ),
        (drawing.material("Of two permeabilities", (50.0, 400.0)), MU_0 * loading * 400),
        (
            drawing.material("Steel sheets in the plane", fill=0.95, curve=steel.table()),
            0.95 * saturated + 0.05 * MU_0 * loading,
        ),
        (
            drawing.material("Steel sheets along y", lamination="parallel to y", fill=0.95, curve=steel.table()),
            0.95 * saturated + 0.05 * MU_0 * loading,
        ),
    )
    drawing.rectangle((-2, 0), (0, 10))
    drawing.rectangle((30, 32), (0, 10))
    drawing.line((-2, 0), (-2, 10), boundary=wall)
    coil = drawing.circuit("winding", 1.0)
    drawing.label(-1, 5, copper, coil, loading * 10 * MM)
    drawing.label(31, 5, copper, coil, -loading * 10 * MM)
    checks: list[Check] = []
    flux = 2 * MU_0 * loading * 2 * MM / 3
    for number, (material, field) in enumerate(strips):
        left = 5 * number
        drawing.rectangle((left, left + 5), (0, 10))
        drawing.label(left + 2.5, 5, material)
        checks += flux_density((left + 2.5, 4), (0.0, field))
        flux += 5 * MM * field
    checks.append(linkage("winding", loading * 10 * MM * 0.1 * flux))
    source = "H is the same in all strips; sheets and gaps in parallel along the sheets, in series across them"
    return Case("laminated-strips", "Laminated and anisotropic cores", drawing.model(), tuple(checks), source)


def mixed_condition() -> Case:
    density, width, c0, c1 = 1e6, 20 * MM, 2e7, 5000.0
    drawing = Drawing(False)
    copper = drawing.material("Copper", density=density)
    drawing.rectangle((0, 20), (0, 10))
    drawing.line((0, 0), (0, 10), boundary=drawing.boundary("A=0"))
    drawing.line((20, 0), (20, 10), boundary=drawing.boundary("mixed", "mixed", c0=c0, c1=c1))
    drawing.label(10, 5, copper)
    size = max(abs(layers.mixed_slab(density, width, c0, c1, x)[1]) for x in (0.0, width))
    checks: list[Check] = []
    for x in (3.0, 10.0, 19.0):
        a, b = layers.mixed_slab(density, width, c0, c1, x * MM)
        checks += [potential((x, 5), a), *flux_density((x, 5), (0.0, b), size)]
    source = "A = −μ0 J x²/2 + C x"
    return Case("mixed-condition", "Slab of current with a mixed condition", drawing.model(), tuple(checks), source)
