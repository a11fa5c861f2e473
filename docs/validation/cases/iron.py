"""Iron: spheres and cylinders of constant permeability, and saturable cores with a known field."""

from __future__ import annotations

import numpy as np
from exact import layers, spheres, transverse, wires
from exact.coils import Coil
from exact.loops import MU_0
from exact.wires import unwrap

from cases.air_coils import draw_coil
from cases.case import Case, coenergy, energy, flux_density, force, linkage
from cases.drawing import Drawing, open_ball, open_disc

MM = 1e-3
STEEL = layers.Steel()


def sphere_in_a_field() -> Case:
    """A long solenoid: a thin winding at 300 mm, and lines of flux normal to both ends."""
    loading, field = 0.05 / MU_0, 0.05
    drawing = Drawing(True)
    air, copper, iron = drawing.material("Air"), drawing.material("Copper"), drawing.material("Iron", mu=100)
    drawing.half_disc(10)
    drawing.rectangle((0, 300), (-300, 300))
    drawing.rectangle((300, 310), (-300, 300))
    drawing.label(5, 0, iron)
    drawing.label(150, 0, air)
    drawing.label(305, 0, copper, drawing.circuit("solenoid", 1.0), loading * 0.6)
    checks = [
        check
        for at in ((0, 0), (4, 5), (0, 15), (15, 0), (12, 12))
        for check in flux_density(at, spheres.iron_sphere_flux_density(100, field, 0.01, at[0] * MM, at[1] * MM))
    ]
    notes = "The images of the sphere in winding and ends, 30 radii away, are below 1e-4."
    source = "Jackson, Classical Electrodynamics, 5.12: 3 μr/(μr + 2)"
    return Case("iron-sphere", "Iron sphere in a uniform field", drawing.model(), tuple(checks), source, notes)


def ball_and_coil() -> Case:
    coil = Coil(300, 20.0, 0.012, 0.02, 0.015, 0.025)
    drawing = Drawing(True)
    air, copper, iron = drawing.material("Air"), drawing.material("Copper"), drawing.material("Iron", mu=1000)
    drawing.half_disc(10)
    drawing.label(5, 0, iron, group=1)
    draw_coil(drawing, coil, drawing.circuit("coil", 20.0), copper, 2)
    open_ball(drawing, 60)
    drawing.label(40, 0, air)
    pull = spheres.force_on_sphere(coil, 1000, 0.01)
    source = (
        "Multipoles of the coil's field about the ball, −4π μ0 Σ (n + 1) d_n c_(n+1): docs/validation/exact/spheres.py"
    )
    checks = force(1, 1, pull), force(2, 1, -pull)
    return Case("ball-and-coil", "Iron ball pulled by a coil", drawing.model(), checks, source, "", True, ((1, 2),))


def saturated_solenoid() -> Case:
    solenoid = layers.LongSolenoid(STEEL, 2e4, 0.01, 0.011, 0.015)
    drawing = Drawing(True)
    air, copper = drawing.material("Air"), drawing.material("Copper")
    steel = drawing.material("Steel", curve=STEEL.table())
    for r in ((0, 10), (10, 11), (11, 15), (15, 20)):
        drawing.rectangle(r, (0, 20))
    drawing.label(5, 10, steel)
    drawing.label(10.5, 10, air)
    drawing.label(13, 10, copper, drawing.circuit("winding", 2.0), 200)
    drawing.label(17, 10, air)
    stored = [0.02 * value for value in solenoid.energies()]
    checks = (
        linkage("winding", 200 * solenoid.flux_per_turn()),
        energy(stored[0]),
        coenergy(stored[1]),
        *flux_density((5, 10), (0.0, STEEL.flux_density(2e4))),
        *flux_density((13, 5), (0.0, MU_0 * 1e4)),
        *flux_density((18, 5), (0.0, 0.0), MU_0 * 2e4),
    )
    notes = (
        "No condition on any edge but the axis: lines of flux leave the ends at right angles. H = 20 kA/m in the core."
    )
    return Case("saturated-solenoid", "Endless solenoid on saturated steel", drawing.model(), checks, "H = NI/l", notes)


def saturated_ring() -> Case:
    current, turns = 1000.0, 1.0
    drawing = Drawing(False, depth=50)
    air, copper = drawing.material("Air"), drawing.material("Copper")
    steel, edge = drawing.material("Steel", curve=STEEL.table()), drawing.boundary("A=0")
    for radius in (2, 10, 30):
        drawing.circle(0, 0, radius)
    drawing.circle(0, 0, 40, edge, edge)
    drawing.label(0, 0, copper, drawing.circuit("wire", current), turns)
    drawing.label(6, 0, air)
    drawing.label(20, 0, steel)
    drawing.label(35, 0, air)
    flux, stored, co = layers.ring(STEEL, current, 0.01, 0.03)
    straight = MU_0 / (2 * np.pi) * (0.25 + np.log(10 / 2) + np.log(40 / 30))
    checks = (
        linkage("wire", 0.05 * (flux + straight * current)),
        energy(0.05 * (stored + straight * current**2 / 2)),
        coenergy(0.05 * (co + straight * current**2 / 2)),
        *flux_density((0, 12), (-STEEL.flux_density(current / (2 * np.pi * 0.012)), 0.0)),
        *flux_density((20, 0), (0.0, STEEL.flux_density(current / (2 * np.pi * 0.02)))),
        *flux_density((-28, 0), (0.0, -STEEL.flux_density(current / (2 * np.pi * 0.028)))),
        *flux_density((6, 0), (0.0, MU_0 * current / (2 * np.pi * 0.006))),
    )
    return Case("saturated-ring", "Steel ring around a wire", drawing.model(), checks, "H = I/(2πr)", "Depth 50 mm.")


def cylinder_in_a_field() -> Case:
    field = 0.1
    drawing = Drawing(False)
    air, iron = drawing.material("Air"), drawing.material("Iron", mu=500)
    edge = drawing.boundary("uniform", a2=field * MM)
    drawing.circle(0, 0, 10)
    drawing.circle(0, 0, 50, edge, edge)
    drawing.label(0, 0, iron)
    drawing.label(25, 0, air)
    checks = [
        check
        for at in ((0, 0), (5, 4), (15, 0), (0, 15), (-12, 12), (40, 10))
        for check in flux_density(
            at, unwrap(transverse.iron_cylinder(500, field, 0.01, 0.05, complex(at[0] * MM, at[1] * MM)))
        )
    ]
    source = "Smythe (1968), chapter 4, with A = B0 y on the circle of 50 mm"
    return Case("iron-cylinder", "Iron cylinder in a uniform field", drawing.model(), tuple(checks), source)


def wires_beside_iron() -> Case:
    current = 500.0
    sources = ((current, complex(0.02, 0)), (-current, complex(0.028, 0.012)))
    drawing = Drawing(False, depth=1000)
    air, copper, iron = drawing.material("Air"), drawing.material("Copper"), drawing.material("Iron", mu=200)
    drawing.circle(0, 0, 10)
    drawing.label(0, 0, iron, group=1)
    loop = drawing.circuit("loop", current)
    for number, (strength, place) in enumerate(sources):
        x, y = place.real / MM, place.imag / MM
        drawing.circle(x, y, 2)
        drawing.label(x, y, copper, loop, np.sign(strength), 2 + number)
    open_disc(drawing, 90)
    drawing.label(0, 40, air)
    images = wires.iron_images(sources, 200, 0.01)
    pulls = [wires.force((*images, other), (wire,)) for wire, other in (sources, sources[::-1])]
    on_iron = -wires.force(images, sources)
    checks = []
    for group, pull in ((1, on_iron), (2, pulls[0]), (3, pulls[1])):
        checks += [force(group, 0, pull.real, abs(pull)), force(group, 1, pull.imag, abs(pull))]
    for at in ((0, 0), (5, 3)):
        inside = wires.iron_inside(200) * wires.flux_density(sources, complex(at[0] * MM, at[1] * MM))
        checks += flux_density(at, unwrap(inside))
    outside = wires.flux_density((*sources, *images), complex(0.012, 0.01))
    checks += flux_density((12, 10), unwrap(outside))
    source = "Images of the wires in the cylinder (Smythe 1968, 7.15); round conductors act as lines"
    title = "Go-and-return wires beside an iron cylinder"
    return Case("wires-beside-iron", title, drawing.model(), tuple(checks), source, "", True)
