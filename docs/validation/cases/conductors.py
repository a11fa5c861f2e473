"""Long conductors (planar)."""

from __future__ import annotations

import numpy as np
from exact import wires
from exact.loops import MU_0
from exact.wires import unwrap

from cases.case import Case, Check, energy, flux_density, force, linkage, potential
from cases.drawing import Drawing, open_disc
from fluxbore.fem.femm_model import PointProperty

MM = 1e-3


def _pair(drawing: Drawing, at: tuple[tuple[float, float], tuple[float, float]], current: float) -> None:
    copper, line = drawing.material("Copper"), drawing.circuit("line", current)
    for group, (x, y) in enumerate(at, 1):
        drawing.circle(x, y, 2)
        drawing.label(x, y, copper, line, 3 - 2 * group, group)


def _pair_checks(at: tuple[tuple[float, float], tuple[float, float]], current: float) -> list[Check]:
    """For a metre of two conductors of 2 mm radius, out and back."""
    sources = tuple((sign * current, complex(x, y) * MM) for sign, (x, y) in zip((1, -1), at, strict=True))
    distance = abs(sources[0][1] - sources[1][1])
    exact = wires.pair_inductance(0.002, distance)
    push = wires.force(sources[1:], sources[:1])
    middle = ((at[0][0] + at[1][0]) / 2, (at[0][1] + at[1][1]) / 2)
    checks = [linkage("line", exact * current), energy(exact * current**2 / 2)]
    for group, pull in ((1, push), (2, -push)):
        checks += [force(group, 0, pull.real, abs(pull)), force(group, 1, pull.imag, abs(pull))]
    for point in (middle, (middle[0], middle[1] + 12)):
        checks += flux_density(point, unwrap(wires.flux_density(sources, complex(*point) * MM)))
    return checks


def two_wires() -> Case:
    at = ((-10.0, 0.0), (10.0, 0.0))
    drawing = Drawing(False, depth=1000)
    _pair(drawing, at, 100.0)
    open_disc(drawing, 50)
    drawing.label(0, 30, drawing.material("Air"))
    source = "μ0 I²/(2πd); μ0/π [ln(d/a) + 1/4]"
    checks = tuple(_pair_checks(at, 100.0))
    return Case("two-wires", "Two parallel round wires", drawing.model(), checks, source, "", True, ((1, 2),))


def two_wires_in_two_discs() -> Case:
    """A second disc stands for all that is outside the first; its centre is infinity."""
    at = ((-5.0, 4.0), (12.0, -6.0))
    drawing = Drawing(False, depth=1000)
    _pair(drawing, at, 100.0)
    lower, upper = drawing.boundary("lower seam", "periodic"), drawing.boundary("upper seam", "periodic")
    drawing.circle(0, 0, 40, lower, upper)
    drawing.circle(100, 0, 40, lower, upper)
    air = drawing.material("Air")
    drawing.label(0, 30, air)
    drawing.label(100, 20, air)
    drawing.point(100, 0, PointProperty("infinity", 0.0))
    source = "As for the wires in free space; Freeman and Lowther, IEEE Trans. Magn. 25 (1989) 4135 for the second disc"
    checks = tuple(_pair_checks(at, 100.0))
    title = "Two wires with a drawn Kelvin exterior"
    return Case("kelvin-planar", title, drawing.model(), checks, source, "", False, ((1, 2),))


def confined_wire() -> Case:
    offset, radius, current = 8.0, 20.0, 100.0
    drawing = Drawing(False, depth=1000)
    air, copper, wall = drawing.material("Air"), drawing.material("Copper"), drawing.boundary("A=0")
    drawing.circle(0, 0, radius, wall, wall)
    drawing.circle(offset, 0, 3)
    drawing.label(offset, 0, copper, drawing.circuit("wire", current), 1, 1)
    drawing.label(-10, 0, air)
    exact = wires.confined_inductance(3 * MM, offset * MM, radius * MM)
    images = wires.confined_images(current, offset * MM, radius * MM)
    push = wires.force(images, ((current, complex(offset * MM)),)).real
    everything = ((current, complex(offset * MM)), *images)
    checks = [
        linkage("wire", exact * current),
        energy(exact * current**2 / 2),
        force(1, 0, push),
        force(1, 1, 0, abs(push)),
    ]
    for at in ((-5.0, 3.0), (8.0, 10.0), (0.0, 0.0)):
        where = complex(*at) * MM
        checks += flux_density(at, unwrap(wires.flux_density(everything, where)))
        checks.append(potential(at, wires.confined_potential(current, offset * MM, radius * MM, where)))
    source = "The image in the circle A = 0 (Smythe 1968, chapter 4)"
    title = "Wire off the middle of a flux-tight tube"
    return Case("confined-wire", title, drawing.model(), tuple(checks), source)


def point_current() -> Case:
    offset, radius, current = 8.0, 20.0, 100.0
    drawing = Drawing(False)
    wall = drawing.boundary("A=0")
    drawing.circle(0, 0, radius, wall, wall)
    drawing.point(offset, 0, PointProperty("line current", None, current))
    drawing.label(-10, 0, drawing.material("Air"))
    everything = ((current, complex(offset * MM)), *wires.confined_images(current, offset * MM, radius * MM))
    checks: list[Check] = []
    for at in ((-5.0, 3.0), (8.0, 10.0), (0.0, 0.0)):
        where = complex(*at) * MM
        checks += flux_density(at, unwrap(wires.flux_density(everything, where)))
        checks.append(potential(at, wires.confined_potential(current, offset * MM, radius * MM, where)))
    source = "The image in the circle A = 0 (Smythe 1968, chapter 4)"
    notes = "The wire is a point with a current: the field there is infinite, and so is the energy."
    return Case("point-current", "Line current in a flux-tight tube", drawing.model(), tuple(checks), source, notes)


def coaxial_cable() -> Case:
    current = 50.0
    drawing = Drawing(False, depth=1000)
    air, copper, wall = drawing.material("Air"), drawing.material("Copper"), drawing.boundary("A=0")
    drawing.circle(0, 0, 2)
    drawing.circle(0, 0, 6)
    drawing.circle(0, 0, 7, wall, wall)
    cable = drawing.circuit("cable", current)
    drawing.label(0, 0, copper, cable, 1)
    drawing.label(4, 0, air)
    drawing.label(6.5, 0, copper, cable, -1)
    exact = wires.coaxial_inductance(2 * MM, 6 * MM, 7 * MM)
    checks = [linkage("cable", exact * current), energy(exact * current**2 / 2)]
    for r in (1.0, 4.0, 6.5):
        checks += flux_density((r, 0), (0.0, wires.coaxial_flux_density(current, 2 * MM, 6 * MM, 7 * MM, r * MM)))
    checks += flux_density(
        (2.4, 3.2), wires.coaxial_flux_density(current, 2 * MM, 6 * MM, 7 * MM, 4 * MM) * np.array([-0.8, 0.6])
    )
    return Case("coaxial-cable", "Coaxial cable", drawing.model(), tuple(checks), "Ampère's law; L by 2W/I²")


def parallel_strips() -> Case:
    """Strips across the page's height: 58 and 20 MS/m, 2 and 3 mm wide, in one parallel circuit."""
    current, height = 90.0, 10 * MM
    drawing = Drawing(False, depth=1000)
    air = drawing.material("Air")
    copper, brass = drawing.material("Copper", conductivity=58e6), drawing.material("Brass", conductivity=20e6)
    wall = drawing.boundary("A=0")
    for x in ((0, 2), (2, 6), (6, 9), (9, 15)):
        drawing.rectangle(x, (0, 10))
    drawing.line((15, 0), (15, 10), boundary=wall)
    bus = drawing.circuit("bus", current, series=False)
    drawing.label(1, 5, copper, bus)
    drawing.label(7.5, 5, brass, bus)
    drawing.label(4, 5, air)
    drawing.label(12, 5, air)
    share = 58 * 2 / (58 * 2 + 20 * 3)
    sheet = MU_0 * current / height
    checks = (
        *flux_density((1, 5), (0.0, sheet * share / 2)),
        *flux_density((4, 5), (0.0, sheet * share)),
        *flux_density((7.5, 4), (0.0, sheet * (1 + share) / 2)),
        *flux_density((12, 6), (0.0, sheet)),
    )
    notes = "Lines of flux are upright; the left edge has H = 0 by itself."
    source = "Ampère's law; the current divides as conductivity times area"
    return Case("parallel-strips", "Two strips in parallel", drawing.model(), checks, source, notes)
