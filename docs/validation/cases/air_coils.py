"""Coils in free space, and a magnet with a coil."""

from __future__ import annotations

from exact import coils
from exact.coils import Coil

from cases.case import Case, energy, flux_density, force, linkage
from cases.drawing import Drawing, open_ball
from fluxbore.fem.femm_model import Exterior

BESSEL = (
    "Bessel integral over both windings; B by Derby and Olbert (2010) over the radii: docs/validation/exact/coils.py"
)
MM = 1e-3
LOWER = Coil(400, 2.0, 0.02, 0.03, -0.01, 0.01)
UPPER = Coil(100, 3.0, 0.01, 0.02, 0.03, 0.05)


def draw_coil(
    drawing: Drawing, coil: Coil, circuit: int, copper: int, group: int = 0, turns: float | None = None
) -> None:
    """A coil given in metres on a drawing of any unit."""
    unit = 1 / {"millimeters": 1e-3, "inches": 0.0254, "meters": 1.0}[drawing.unit]
    r, z = (coil.inner * unit, coil.outer * unit), (coil.lower * unit, coil.upper * unit)
    drawing.rectangle(r, z)
    drawing.label(sum(r) / 2, sum(z) / 2, copper, circuit, coil.turns if turns is None else turns, group)


def thick_coil() -> Case:
    inch = 0.0254
    coil = Coil(1000, 1.0, inch / 2, 1.5 * inch, -inch, inch)
    drawing = Drawing(True, "inches")
    air, copper = drawing.material("Air"), drawing.material("Copper", conductivity=58e6)
    draw_coil(drawing, coil, drawing.circuit("coil", 1.0), copper)
    open_ball(drawing, 4)
    drawing.label(0.25, 2, air)
    exact = coils.inductance(coil, coil)
    checks = (
        linkage("coil", exact),
        energy(exact / 2),
        *(
            flux_density(at, coils.coil_flux_density((coil,), at[0] * inch, at[1] * inch))[k]
            for at in ((0.0, 0.0), (1.0, 0.3), (2.0, 1.0))
            for k in (0, 1)
        ),
    )
    notes = "The coil of FEMM's own tutorial: 22.945 mH. Lengths in inches."
    return Case("thick-coil", "Air-cored coil, 1000 turns", drawing.model(), checks, BESSEL, notes, True)


def two_coils() -> Case:
    drawing = Drawing(True)
    air, copper = drawing.material("Air"), drawing.material("Copper")
    draw_coil(drawing, LOWER, drawing.circuit("lower", LOWER.current), copper, 1)
    draw_coil(drawing, UPPER, drawing.circuit("upper", UPPER.current), copper, 2)
    open_ball(drawing, 90)
    drawing.label(5, 0, air)
    mutual = coils.inductance(LOWER, UPPER)
    own = [coils.inductance(coil, coil) for coil in (LOWER, UPPER)]
    linked = own[0] * LOWER.current + mutual * UPPER.current, own[1] * UPPER.current + mutual * LOWER.current
    pull = coils.attraction(LOWER, UPPER)
    checks = (
        linkage("lower", linked[0]),
        linkage("upper", linked[1]),
        energy((linked[0] * LOWER.current + linked[1] * UPPER.current) / 2),
        force(1, 1, pull),
        force(2, 1, -pull),
        *flux_density((0, 20), coils.coil_flux_density((LOWER, UPPER), 0.0, 0.02)),
        *flux_density((25, 20), coils.coil_flux_density((LOWER, UPPER), 0.025, 0.02)),
    )
    return Case(
        "two-coils", "Two coaxial coils: linkages and force", drawing.model(), checks, BESSEL, "", True, ((1, 2),)
    )


def mutual_inductance() -> Case:
    drawing = Drawing(True)
    air, copper = drawing.material("Air"), drawing.material("Copper")
    draw_coil(drawing, LOWER, drawing.circuit("carrying", 1.0), copper)
    draw_coil(drawing, UPPER, drawing.circuit("open", 0.0), copper)
    open_ball(drawing, 90)
    drawing.label(5, 0, air)
    checks = linkage("carrying", coils.inductance(LOWER, LOWER)), linkage("open", coils.inductance(LOWER, UPPER))
    notes = "One circuit carries 1 A, the other none: its linkage is the mutual inductance."
    return Case("mutual-inductance", "Mutual inductance of two coils", drawing.model(), checks, BESSEL, notes, True)


def opposed_coils() -> Case:
    below, above = Coil(200, 5.0, 0.02, 0.025, -0.025, -0.015), Coil(-200, 5.0, 0.02, 0.025, 0.015, 0.025)
    drawing = Drawing(True)
    air, copper = drawing.material("Air"), drawing.material("Copper")
    pair = drawing.circuit("pair", 5.0)
    draw_coil(drawing, below, pair, copper, 1)
    draw_coil(drawing, above, pair, copper, 2)
    open_ball(drawing, 90)
    drawing.label(5, 0, air)
    total = 2 * coils.inductance(below, below) + 2 * coils.inductance(below, above)
    push = coils.attraction(below, above)
    checks = (
        linkage("pair", 5 * total),
        energy(12.5 * total),
        force(1, 1, push),
        force(2, 1, -push),
        *flux_density((0, 8), coils.coil_flux_density((below, above), 0.0, 0.008)),
        *flux_density((10, 0), coils.coil_flux_density((below, above), 0.01, 0.0)),
    )
    notes = "One circuit in series through turns of both signs."
    return Case(
        "opposed-coils", "Gradient pair in one circuit", drawing.model(), checks, BESSEL, notes, True, ((1, 2),)
    )


def kelvin_exterior() -> Case:
    """Inside of a ball of 60 mm about the origin, and a second ball about z = 150 mm that stands for the rest."""
    drawing = Drawing(True, exterior=Exterior(150, 60, 60))
    air, copper = drawing.material("Air"), drawing.material("Copper")
    coil = Coil(400, 2.0, 0.02, 0.03, 0.005, 0.025)
    draw_coil(drawing, coil, drawing.circuit("coil", 2.0), copper)
    seam = drawing.boundary("seam", "periodic")
    drawing.half_disc(60, 0, seam)
    drawing.half_disc(60, 150, seam)
    drawing.label(5, 0, air)
    drawing.label(20, 150, air, external=True)
    exact = coils.inductance(coil, coil)
    checks = (
        linkage("coil", 2 * exact),
        energy(2 * exact),
        *flux_density((0, 0), coils.coil_flux_density((coil,), 0.0, 0.0)),
        *flux_density((0, -50), coils.coil_flux_density((coil,), 0.0, -0.05)),
        *flux_density((45, 20), coils.coil_flux_density((coil,), 0.045, 0.02)),
    )
    notes = "The exterior is drawn in the file, as FEMM's users do; the coil is off the ball's centre on purpose."
    return Case("kelvin-exterior", "Coil with a drawn Kelvin exterior", drawing.model(), checks, BESSEL, notes)


def voice_coil() -> Case:
    coil = Coil(200, 2.0, 0.012, 0.016, 0.004, 0.014)
    magnet = (1.2, 0.01, 0.02)
    drawing = Drawing(True)
    air, copper = drawing.material("Air"), drawing.material("Copper")
    ferrous = drawing.material("Magnet 1.2 T", remanence=1.2)
    drawing.rectangle((0, 10), (-10, 10))
    drawing.label(5, 0, ferrous, group=1, magnetisation=90)
    draw_coil(drawing, coil, drawing.circuit("coil", 2.0), copper, 2)
    open_ball(drawing, 60)
    drawing.label(11, 0, air)
    push = coils.force_by_magnet(coil, *magnet)
    linked = coils.linkage_by_magnet(coil, *magnet) + 2 * coils.inductance(coil, coil)
    checks = linkage("coil", linked), force(2, 1, push), force(1, 1, -push)
    source = (
        "Maxwell's mutual inductance between the coil and the magnet's surface currents: docs/validation/exact/coils.py"
    )
    return Case("voice-coil", "Magnet and coil", drawing.model(), checks, source, "", True, ((1, 2),))


def smes() -> Case:
    """TEAM problem 22 at the published optimum of its three parameters."""
    inner = Coil(1, 22.5e6 * 0.27 * 1.6, 2 - 0.135, 2 + 0.135, -0.8, 0.8)
    outer = Coil(1, -22.5e6 * 0.394 * 0.478, 3.08 - 0.197, 3.08 + 0.197, -0.239, 0.239)
    drawing = Drawing(True, "meters")
    air = drawing.material("Air")
    for coil, name, density in ((inner, "inner", 22.5e6), (outer, "outer", -22.5e6)):
        drawing.rectangle((coil.inner, coil.outer), (coil.lower, coil.upper))
        drawing.label((coil.inner + coil.outer) / 2, 0, drawing.material(name, density=density))
    open_ball(drawing, 16)
    drawing.label(1, 2, air)
    i, o = inner.current, outer.current
    stored = i * i * coils.inductance(inner, inner) / 2 + o * o * coils.inductance(outer, outer) / 2
    stored += i * o * coils.inductance(inner, outer)
    checks = (
        energy(stored),
        *(
            flux_density(at, coils.coil_flux_density((inner, outer), *at))[k]
            for at in ((0.0, 0.0), (1.0, 0.5), (0.0, 10.0), (10.0, 0.0), (6.0, 10.0))
            for k in (0, 1)
        ),
    )
    notes = (
        "R2 = 3.08 m, h2/2 = 0.239 m, d2 = 0.394 m (TEAM benchmark problem 22; Alotto et al., IEEE Trans. Magn. 32 "
        "(1996) 1238): the energy asked for is 180 MJ. The stray field of about 1 mT at 10 m is what is left of two "
        "fields that cancel. Current densities are block properties."
    )
    return Case("team-22", "Magnetic energy store of TEAM problem 22", drawing.model(), checks, BESSEL, notes, True)


def air_coil_in_a_box() -> Case:
    """The coil with the boundary at 400 mm, as a FEMM user without an open boundary draws it."""
    drawing = Drawing(True)
    air, copper = drawing.material("Air"), drawing.material("Copper")
    edge = drawing.boundary("A=0")
    drawing.line((0, -400), (400, -400), (400, 400), (0, 400), boundary=edge)
    drawing.line((0, -400), (0, 400))
    draw_coil(drawing, LOWER, drawing.circuit("coil", 2.0), copper, 2)
    drawing.label(200, 200, air)
    exact = coils.inductance(LOWER, LOWER)
    checks = (
        linkage("coil", 2 * exact),
        energy(2 * exact),
        *(
            flux_density(at, coils.coil_flux_density((LOWER,), at[0] * MM, at[1] * MM))[k]
            for at in ((0.0, 0.0), (5.0, 0.0), (0.0, 20.0), (25.0, 0.0), (45.0, 5.0))
            for k in (0, 1)
        ),
    )
    notes = "The box of 400 mm takes less than 0.03 % of the linkage: (30/400)³."
    return Case("air-coil-in-a-box", "Air-cored coil in a large box", drawing.model(), checks, BESSEL, notes)
