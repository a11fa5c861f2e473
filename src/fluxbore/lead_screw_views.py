"""What can be seen of a magnetic lead screw: its parts, and its spring, field and pitch."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fluxbore.design.errors import DesignError
from fluxbore.design.lead_screw_values import LeadScrewActuator
from fluxbore.design.spec import Spec
from fluxbore.geometry import lead_screw_parts
from fluxbore.geometry.assembly import Assembly
from fluxbore.optimize.evaluation import Evaluation

if TYPE_CHECKING:
    from fluxbore.design.back_iron import BackIronCase
    from fluxbore.design.lead_screw import LeadScrew
    from fluxbore.fem.field_loads import Load
    from fluxbore.fem.helical import HelicalSolution
    from fluxbore.optimize.lead_screw_field import LeadScrewField
    from fluxbore.reports.content import Array, FluxMap
    from fluxbore.reports.lead_screw_content import ScrewContent

SLIVER = 1e-6
"""Of the pitch; what is left of a magnet in the window and is no wider is not drawn."""

SAMPLES = 121
"""Of the mover's position."""

STALL_FORCE = "benchmark.force.stall_force"


def assembly(spec: Spec, place: float = 0.5) -> Assembly:
    """The parts with the rotor at this share of its stroke. Raises DesignError where they do not fit."""
    actuator: LeadScrewActuator = spec.actuator
    return lead_screw_parts.assembly(actuator, (place - 0.5) * actuator.stroke)


def screw_content(spec: Spec, design: Evaluation) -> ScrewContent | None:
    """What the report shows of the screw itself; None where the design has no figures.

    design : the specification's evaluation by finite elements.
    """
    if not design.ok:
        return None
    import numpy as np

    from fluxbore.design.helical_field import force_series
    from fluxbore.design.lead_screw_figures import engaged_fraction
    from fluxbore.fem.helical import solve
    from fluxbore.fem.helical_force import coenergy, force
    from fluxbore.fem.threads import one_thread
    from fluxbore.optimize.lead_screw_field import magnetised, periods, section, solve_field
    from fluxbore.optimize.pitch_curve import pitch_curve
    from fluxbore.reports.lead_screw_content import ScrewContent, SpringSample

    screw = magnetised(spec)
    with one_thread():
        field = solve_field(spec, screw)
        if field.failure is not None:
            return None
        samples = tuple(
            SpringSample(item.section.displacement, periods(screw) * force(item))
            for item in sorted(field.solved, key=lambda item: item.section.displacement)
        )
        top, peak = field.stall.section.displacement, periods(screw) * force(field.stall)
        # Half a pitch away less next to rest, and the little that the spring holds there.
        near, away = (item for item in (field.rest, field.slipping) if item is not None)
        energy = periods(screw) * (coenergy(near) - coenergy(away))
        energy += float(field.series.energy(near.section.displacement))
        finer = int(spec.number("solver.mesh_refinement")) + 1  # so that field lines are smooth to the eye
        rest, stall = (_flux_map(solve(section(spec, screw, place), finer), screw) for place in (0.0, top))
        pitch = pitch_curve(spec, design)
        loads = _loads(spec, screw, field)
    stroke = spec.actuator.stroke
    reach = max(stroke, screw.translator_length + screw.active_length) / 2  # beyond it nothing is engaged
    positions = np.linspace(-reach, reach, SAMPLES)
    asked = float(spec.values[STALL_FORCE]) if STALL_FORCE in spec.given else peak
    return ScrewContent(
        screw,
        field.series,
        force_series(screw),
        samples,
        (top, peak),
        energy,
        rest,
        stall,
        tuple(positions.tolist()),
        tuple((peak * engaged_fraction(screw, positions)).tolist()),
        stroke,
        _iron_cases(screw, asked),
        asked,
        pitch,
        loads,
    )


def _loads(spec: Spec, screw: LeadScrew, field: LeadScrewField) -> tuple[Load, ...]:
    """Where the screw slips, which is the worst for the magnets; none of arcs, of which only the mean is computed."""
    from fluxbore.fem.field_loads import screw_loads
    from fluxbore.optimize.lead_screw_field import coercivity

    if field.slipping is None or screw.translator.arcs is not None or screw.rotor.arcs is not None:
        return ()
    names = [layer.name for layer in field.slipping.section.layers]
    limits = {
        names.index(f"{member} magnets"): (spec.word(f"actuator.{member}.magnet"), coercivity(spec, member))
        for member in ("translator", "rotor")
    }
    return screw_loads(field.slipping, limits)


def _iron_cases(screw: LeadScrew, stall_force: float) -> tuple[BackIronCase, ...]:
    """None of them where one cannot be built."""
    from fluxbore.design.back_iron import back_iron_cases

    try:
        return back_iron_cases(screw, stall_force)
    except DesignError:
        return ()


def _flux_map(solution: HelicalSolution, screw: LeadScrew) -> FluxMap:
    """The field over two pitches, with the outlines of magnets and iron; four of the translator's magnets are whole."""
    from fluxbore.fem.helical_flux import flux_map
    from fluxbore.reports.content import FluxMap

    section = solution.section
    start, end = -screw.pitch / 4, 7 * screw.pitch / 4
    found = flux_map(solution, start, end)
    outlines = []
    for number, layer in enumerate(section.layers):
        inside, outside = section.radii[number : number + 2]
        if layer.magnets is not None:
            rotor = number > section.gap
            width = (screw.rotor if rotor else screw.translator).magnet_width
            moved = section.displacement if rotor else 0.0
            outlines += _magnets(layer.name, (inside, outside), (start, end), width, screw.pitch, moved)
        elif layer.curve is not None:
            outlines.append(_outline(layer.name, (inside, outside), (start, end)))
    return FluxMap(
        found.r,
        found.z,
        found.triangles,
        found.flux,
        found.flux_density,
        tuple(outlines),
        section.displacement,
        found.region,
        found.components,
    )


def _magnets(
    name: str, radii: tuple[float, float], window: tuple[float, float], width: float, pitch: float, moved: float
) -> list[tuple[str, Array]]:
    """The magnets that reach into the window: north at the displacement and a pitch on, south between."""
    from math import ceil, floor

    first = floor(2 * (window[0] - moved) / pitch - 1)
    last = ceil(2 * (window[1] - moved) / pitch + 1)
    found = []
    for half in range(first, last + 1):
        middle = moved + half * pitch / 2
        low, high = max(middle - width / 2, window[0]), min(middle + width / 2, window[1])
        if high - low > SLIVER * pitch:
            found.append(_outline(f"{name}, {'south' if half % 2 else 'north'}", radii, (low, high)))
    return found


def _outline(name: str, r: tuple[float, float], z: tuple[float, float]) -> tuple[str, Array]:
    import numpy as np

    return name, np.array([(r[0], z[0]), (r[1], z[0]), (r[1], z[1]), (r[0], z[1])])
