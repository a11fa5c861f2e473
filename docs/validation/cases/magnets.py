"""Magnets in free space: axially magnetised, magnetised across, spherical, and in a ring."""

from __future__ import annotations

import numpy as np
from exact import cylinders, spheres, transverse
from exact.loops import MU_0
from exact.wires import unwrap

from cases.case import Case, Check, flux_density, force, torque
from cases.drawing import Drawing, open_ball, open_disc

MM = 1e-3


def _fields(points: tuple[tuple[float, float], ...], field: object, scale: float | None = None) -> list[Check]:
    assert callable(field)
    return [check for at in points for check in flux_density(at, field(at[0] * MM, at[1] * MM), scale)]


def cylinder() -> Case:
    drawing = Drawing(True)
    air, magnet = drawing.material("Air"), drawing.material("Magnet 1.2 T", remanence=1.2)
    drawing.rectangle((0, 10), (-10, 10))
    drawing.label(5, 0, magnet, magnetisation=90)
    open_ball(drawing, 45)
    drawing.label(30, 0, air)
    points = ((0, 0), (5, 4), (0, 15), (5, 15), (15, 0), (14, 14), (0, 30))
    checks = _fields(points, lambda r, z: cylinders.magnet_flux_density(1.2, 0.01, 0.02, r, z))
    source = "Derby and Olbert, Am. J. Phys. 78 (2010) 229"
    return Case("cylinder-magnet", "Axially magnetised cylinder", drawing.model(), tuple(checks), source, "", True)


def magnet_pair() -> Case:
    return _pair("magnet-pair", 20, 40)


def unequal_magnets() -> Case:
    return _pair("unequal-magnets", 15, 30)


def _pair(name: str, radius: float, height: float) -> Case:
    drawing = Drawing(True)
    air, magnet = drawing.material("Air"), drawing.material("Magnet 1.3 T", remanence=1.3)
    drawing.rectangle((0, 20), (-45, -5))
    drawing.rectangle((0, radius), (25 - height / 2, 25 + height / 2))
    drawing.label(10, -25, magnet, group=1, magnetisation=90)
    drawing.label(radius / 2, 25, magnet, group=2, magnetisation=90)
    open_ball(drawing, 110)
    drawing.label(60, 0, air)
    pull = cylinders.magnet_force((1.3, 0.02, 0.04), (1.3, radius * MM, height * MM), 0.05)
    checks = force(1, 1, pull), force(2, 1, -pull)
    source = "Maxwell's mutual inductance of the surface currents' ends; the same by charged discs"
    title = f"Two magnets, R 20 h 40 and R {radius:g} h {height:g} mm"
    return Case(name, title, drawing.model(), checks, source, "Centres 50 mm apart.", True, ((1, 2),))


def sphere() -> Case:
    drawing = Drawing(True)
    air, magnet = drawing.material("Air"), drawing.material("Magnet 1.2 T", remanence=1.2)
    drawing.half_disc(10)
    drawing.label(5, 0, magnet, magnetisation=90)
    open_ball(drawing, 40)
    drawing.label(25, 0, air)
    points = ((0, 0), (5, 3), (2, -8), (0, 15), (15, 0), (12, 12), (0, -35))
    checks = _fields(points, lambda r, z: spheres.magnetised_sphere_flux_density(1.2, 0.01, r, z))
    source = "Jackson, Classical Electrodynamics, 5.10: 2/3 Br inside, a dipole outside"
    return Case("sphere-magnet", "Uniformly magnetised sphere", drawing.model(), tuple(checks), source, "", True)


def transverse_cylinder() -> Case:
    direction = np.radians(30)
    drawing = Drawing(False, depth=100)
    air, magnet = drawing.material("Air"), drawing.material("Magnet 1.2 T", remanence=1.2)
    drawing.circle(0, 0, 10)
    drawing.label(0, 0, magnet, magnetisation=30)
    open_disc(drawing, 40)
    drawing.label(25, 0, air)
    br = 1.2 * np.exp(1j * direction)
    points = ((0, 0), (5, 5), (15, 0), (0, 15), (-12, 12), (35, 0))
    checks = _fields(points, lambda x, y: unwrap(transverse.magnetised_cylinder(br, 0.01, complex(x, y))))
    source = "Br/2 inside, a plane dipole outside"
    title = "Long cylinder magnetised across"
    return Case("transverse-cylinder", title, drawing.model(), tuple(checks), source, "", True)


def torque_on_a_cylinder() -> Case:
    """A uniform field set by A on a circle; a magnet of μr = 1 does not turn itself in a concentric circle."""
    field, direction = 0.1, np.radians(60)
    drawing = Drawing(False, depth=100)
    air, magnet = drawing.material("Air"), drawing.material("Magnet 1.2 T", remanence=1.2)
    edge = drawing.boundary("uniform", a1=-field * np.sin(direction) * MM, a2=field * np.cos(direction) * MM)
    drawing.circle(0, 0, 40, edge, edge)
    drawing.circle(0, 0, 10)
    drawing.label(0, 0, magnet, group=1)
    drawing.label(25, 0, air)
    moment = 0.1 * transverse.torque(1.2, 0.01, field, direction)
    pull = 0.1 * np.pi * 0.01**2 * 1.2 / MU_0 * field / 0.01
    checks = torque(1, moment), force(1, 0, 0.0, pull), force(1, 1, 0.0, pull)
    source = "m × B per length; the boundary A = B (y cos 60° − x sin 60°)"
    return Case("torque", "Torque on a magnetised cylinder", drawing.model(), checks, source, "Depth 100 mm.")


def halbach_ring() -> Case:
    drawing = Drawing(False, depth=100)
    air, magnet = drawing.material("Air"), drawing.material("Magnet 1.2 T", remanence=1.2)
    edge = drawing.boundary("A=0")
    drawing.circle(0, 0, 10)
    drawing.circle(0, 0, 25)
    drawing.circle(0, 0, 40, edge, edge)
    drawing.label(0, 0, air)
    drawing.label(17, 0, magnet, magnetisation="2*theta")
    drawing.label(32, 0, air)
    bore = transverse.halbach_cylinder(1.2, 0.01, 0.025)
    inside = [check for at in ((0, 0), (5, 4), (-3, 8)) for check in flux_density(at, (bore, 0.0))]
    outside = [check for at in ((28, 0), (0, 30)) for check in flux_density(at, (0.0, 0.0), bore)]
    source = "Halbach, Nucl. Instrum. Methods 169 (1980) 1: Br ln(ro/ri), and nothing outside"
    notes = "The direction is the formula 2*theta."
    return Case("halbach-ring", "Halbach ring", drawing.model(), (*inside, *outside), source, notes)
