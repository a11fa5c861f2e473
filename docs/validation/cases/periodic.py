"""Planar magnet rows with antiperiodic sides."""

from __future__ import annotations

from exact import arrays

from cases.case import Case, Check, flux_density, force, linkage
from cases.drawing import Drawing

MM = 1e-3
MACHINE = arrays.Slotless(1.2, 1.0, 12 * MM, 0.7, 4 * MM, 10 * MM)
COIL = ((1.0, 5.0), (6.0, 9.0))


def halbach_array() -> Case:
    wavelength, height = 20.0, 4.0
    drawing = Drawing(False, depth=100)
    air, magnet = drawing.material("Air"), drawing.material("Magnet 1.2 T", remanence=1.2)
    far = drawing.boundary("A=0")
    drawing.line((0, -20), (10, -20), boundary=far)
    drawing.line((0, 24), (10, 24), boundary=far)
    for y in ((-20, 0), (0, 4), (4, 24)):
        side = drawing.boundary(f"sides from {y[0]}", "antiperiodic")
        for x in (0, 10):
            drawing.line((x, y[0]), (x, y[1]), boundary=side)
    drawing.line((0, 0), (10, 0))
    drawing.line((0, 4), (10, 4))
    drawing.label(5, -10, air)
    drawing.label(5, 2, magnet, magnetisation="90 + 18*x")
    drawing.label(5, 14, air)
    checks: list[Check] = []
    for at in ((3.0, 6.0), (7.0, 8.0), (5.0, 12.0)):
        checks += flux_density(
            at, arrays.halbach_array(1.2, wavelength * MM, height * MM, at[0] * MM, (at[1] - 4) * MM)
        )
    strong = 1.2 * 0.715
    checks += flux_density((4.0, -2.0), (0.0, 0.0), strong)
    source = "Mallinson, IEEE Trans. Magn. 9 (1973) 678"
    notes = "Half a wavelength, antiperiodic sides; the direction is the formula 90 + 18*x. The far edges count 4e-6."
    return Case("halbach-array", "Planar Halbach array", drawing.model(), tuple(checks), source, notes)


def _machine(current: float) -> Drawing:
    drawing = Drawing(False, depth=100)
    air, copper = drawing.material("Air"), drawing.material("Copper")
    magnet = drawing.material("Magnet 1.2 T", remanence=1.2)
    side = drawing.boundary("sides", "antiperiodic")
    drawing.line((-6, 0), (6, 0), (6, 10), (-6, 10), (-6, 0))
    # Drawn in opposite directions, as an outline is by hand: which ends are mates does not depend on that.
    drawing.line((-6, 10), (-6, 0), boundary=side)
    drawing.line((6, 0), (6, 10), boundary=side)
    drawing.rectangle((-4.2, 4.2), (0, 4))
    drawing.rectangle(*COIL)
    drawing.label(0, 2, magnet, group=1, magnetisation=90)
    drawing.label(3, 7.5, copper, drawing.circuit("coil", current), 50, 2)
    drawing.label(0, 9.5, air)
    return drawing


NOTES = "Irons of infinite permeability are edges without a condition: lines of flux enter them at right angles."
SOURCE = "Fourier series of the scalar potential (after Zhu et al., IEEE Trans. Magn. 29 (1993) 124)"


def slotless_no_load() -> Case:
    checks: list[Check] = []
    for at in ((0.0, 7.0), (3.0, 8.0), (5.0, 7.0), (0.0, 9.8)):
        checks += flux_density(at, MACHINE.flux_density(at[0] * MM, at[1] * MM))
    (x, y), depth = COIL, 0.1
    mean = MACHINE.mean_potential((x[0] * MM, x[1] * MM), (y[0] * MM, y[1] * MM))
    checks.append(linkage("coil", 50 * depth * mean))
    title = "Slotless linear machine at no current"
    return Case("slotless-no-load", title, _machine(0.0).model(), tuple(checks), SOURCE, NOTES)


def slotless_load() -> Case:
    (x, y), depth = COIL, 0.1
    push = depth * MACHINE.thrust(200.0, (x[0] * MM, x[1] * MM), (y[0] * MM, y[1] * MM))
    title = "Thrust of a slotless linear machine"
    return Case("slotless-load", title, _machine(4.0).model(), (force(2, 0, push),), SOURCE, NOTES)
