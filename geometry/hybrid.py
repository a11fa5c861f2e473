"""The hybrid actuator's magnetic cross-section at a position of its mover."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

from fluxbore.design.hybrid import PHASES, HybridActuator
from fluxbore.design.materials import Material, PermanentMagnet, SoftIron
from fluxbore.geometry.cross_section import CoilWindow, CrossSection, Rectangle, Region, breakpoints, paint

STRAY_DISTANCE = 5e-3
"""m outside the yoke: the cylinder on which the stray field is read; a mesh line lies there."""

FAR_DIAMETERS = 3.0
"""The computed air reaches this many yoke diameters beyond the yoke, all round."""

SMALLEST = 1e-9
"""m; breakpoints closer than this are one."""


def cross_section(
    actuator: HybridActuator, position: float, materials: Mapping[str, Material], magnet_temperature: float
) -> CrossSection:
    """Rectangles of the machine with its magnet array's cap-side face at ``position`` (m).

    Winding, cylinder, pistons and end caps count as air unless the cylinder is soft iron. Coils are windows, so that
    no line is needed between them and the yoke.
    """
    far = FAR_DIAMETERS * actuator.back_yoke.outer_diameter
    radii = [
        0.0,
        actuator.shaft.outer_diameter / 2,
        actuator.mover.outer_diameter / 2,
        actuator.cylinder.inner_diameter / 2,
        actuator.cylinder.outer_diameter / 2,
        actuator.back_yoke.inner_diameter / 2,
        actuator.back_yoke.outer_diameter / 2,
        actuator.back_yoke.outer_diameter / 2 + STRAY_DISTANCE,
        actuator.back_yoke.outer_diameter / 2 + STRAY_DISTANCE + far,
    ]
    magnetic_cylinder = isinstance(materials[actuator.cylinder.material], SoftIron)
    magnetic_shaft = isinstance(materials[actuator.shaft.material], SoftIron)
    shaft, cylinder = "soft shaft" if magnetic_shaft else "shaft", "soft cylinder" if magnetic_cylinder else "cylinder"
    r = breakpoints(
        radii,
        (shaft, "magnet", "clearance", cylinder, "winding", "back yoke", "near air", "far air"),
        SMALLEST,
    )
    rectangles = _mover(actuator, position, materials, magnet_temperature)
    rectangles.append(
        Rectangle(
            Region("back yoke", materials[actuator.back_yoke.material]),
            (radii[5], radii[6]),
            (actuator.yoke_start, actuator.yoke_end),
        )
    )
    if magnetic_cylinder:
        half = actuator.cylinder.length / 2
        rectangles.append(
            Rectangle(
                Region("cylinder", materials[actuator.cylinder.material]),
                (radii[3], radii[4]),
                (actuator.middle - half, actuator.middle + half),
            )
        )
    if magnetic_shaft:
        start = position - actuator.piston.length
        rectangles.append(
            Rectangle(
                Region("shaft", materials[actuator.shaft.material]),
                (0.0, radii[1]),
                (start, start + actuator.shaft.length),
            )
        )
    z_values, z_names = _axial(rectangles, actuator, position, far)
    z = breakpoints(z_values, z_names, SMALLEST)
    regions, cells = paint(r, z, rectangles)
    return CrossSection(
        r,
        z,
        regions,
        cells,
        _coils(actuator),
        tuple(rectangles),
        (radii[2], radii[3] if magnetic_cylinder else radii[4]),
    )


def _mover(
    actuator: HybridActuator, position: float, materials: Mapping[str, Material], temperature: float
) -> list[Rectangle]:
    mover = actuator.mover
    r = (actuator.shaft.outer_diameter / 2, mover.outer_diameter / 2)
    magnet = materials[mover.magnet]
    assert isinstance(magnet, PermanentMagnet)
    remanence = magnet.remanence_at(temperature, mover.remanence)
    ring = Region("ring", materials[mover.ring_material])
    rectangles = []
    for i in range(actuator.magnets + 1):
        centre = position + i * mover.pole_pitch
        start = max(centre - mover.ring_width / 2, position)
        end = min(centre + mover.ring_width / 2, position + actuator.array_length)
        if end - start > SMALLEST:
            rectangles.append(Rectangle(ring, r, (start, end)))
        if i < actuator.magnets:
            # The first magnet points to the rod end: its sign only fixes which current direction is positive.
            signed = remanence if i % 2 == 0 else -remanence
            region = Region(f"magnet {i + 1}", magnet, signed, magnet.recoil(mover.magnet_permeability))
            rectangles.append(Rectangle(region, r, (end, centre + mover.pole_pitch - mover.ring_width / 2)))
    return rectangles


def _axial(
    rectangles: list[Rectangle], actuator: HybridActuator, position: float, far: float
) -> tuple[list[float], list[str]]:
    """All z edges in order, and for each interval the name of what is finest there."""
    ends = [z for rectangle in rectangles for z in rectangle.z]
    ends += [min(ends) - far, max(ends) + far]
    values = sorted(set(ends))
    names = []
    first, last = position, position + actuator.array_length
    for a, b in pairwise(values):
        middle = (a + b) / 2
        covering = [
            rectangle.region.name.split()[0]
            for rectangle in rectangles
            if rectangle.z[0] < middle < rectangle.z[1] and rectangle.region.name.startswith(("magnet", "ring"))
        ]
        if covering:
            half = covering[0] == "ring" and (abs(a - first) < SMALLEST or abs(b - last) < SMALLEST)
            names.append("half ring" if half else covering[0])
        elif a < actuator.yoke_start - SMALLEST:
            names.append("beyond cap end")
        elif b > actuator.yoke_end + SMALLEST:
            names.append("beyond rod end")
        else:
            names.append("cap end" if middle < first else "rod end")
    return values, names


def _coils(actuator: HybridActuator) -> tuple[CoilWindow, ...]:
    r = (actuator.cylinder.outer_diameter / 2, actuator.winding.outer_diameter / 2)
    width = actuator.coil_width
    return tuple(
        CoilWindow(
            PHASES[i % len(PHASES)],
            actuator.turns_per_coil,
            r,
            (actuator.winding_start + i * width, actuator.winding_start + (i + 1) * width),
        )
        for i in range(actuator.coils)
    )
