"""What can be seen of an electro-hydrostatic actuator: its output cylinder, its range, the power along its chain."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fluxbore.design.errors import DesignError
from fluxbore.design.hydrostatic_values import HydrostaticDesign
from fluxbore.design.spec import Spec
from fluxbore.geometry import hydrostatic_parts
from fluxbore.geometry.assembly import Assembly
from fluxbore.optimize.evaluation import Evaluation

if TYPE_CHECKING:
    from fluxbore.design.hydrostatic import HydrostaticActuator
    from fluxbore.reports.hydrostatic_content import (
        Array,
        HydraulicsContent,
        OperatingPoint,
        PortRow,
        RangeMap,
        Tracked,
    )

FREQUENCIES, AMPLITUDES = 14, 13
"""Of the operating range's grid; between its points every limit is nearly a power of both."""

SLOWER, FASTER = 12.0, 30.0
"""Parts and times of the frequency up to which the whole stroke can be made: what the range shows."""

BEYOND = 4.0
"""Times the amplitudes of interest at which limits are looked for: so that lines do not end within the picture."""

SHOWN_TIME = 0.5
"""s; the whole periods that last no less are shown of the simulation, two of them at least."""

LONGEST_SHOWN = 20.0
"""s, of a period that is simulated for a picture."""


def assembly(spec: Spec, place: float = 0.5) -> Assembly:
    """The parts with the piston at this share of its stroke. Raises DesignError where they do not fit."""
    design: HydrostaticDesign = spec.actuator
    return hydrostatic_parts.assembly(design, place * design.bare.output_cylinder.stroke)


def hydraulics(spec: Spec, design: Evaluation) -> HydraulicsContent | None:
    """What the report shows of the hydraulics; None where the design has no figures by either route.

    design : the specification's evaluation by simulation in time.
    """
    from fluxbore.design.column import END_CONDITIONS
    from fluxbore.design.hydrostatic_figures import rod_buckling_force
    from fluxbore.design.hydrostatic_range import demand
    from fluxbore.design.materials import Material as Substance
    from fluxbore.design.materials import lookup
    from fluxbore.geometry.mass import part_masses, total
    from fluxbore.optimize.evaluate import evaluate
    from fluxbore.optimize.hydrostatic_common import operating_point, weighed
    from fluxbore.reports.hydrostatic_content import HydraulicsContent, Material, OperatingPoint

    found = design if design.ok else evaluate(spec, "network")
    if not found.ok:
        return None
    actuator, described = weighed(spec), spec.actuator
    point = OperatingPoint(*operating_point(spec))
    tracked, untracked = _tracked(actuator, point) if design.ok else (None, " ".join(design.reasons))
    tube, rod = (
        lookup(str(spec.values[key]), key, spec.materials, Substance)
        for key in ("actuator.output_cylinder.material", "actuator.output_cylinder.rod")
    )
    rows = part_masses(assembly(spec, 0.5), spec.materials)
    return HydraulicsContent(
        actuator,
        found.performance,
        point,
        demand(actuator, point.amplitude, point.frequency, point.least),
        _range(actuator, point),
        tracked,
        untracked,
        described.gland,
        Material(tube.name, tube.yield_stress),
        Material(rod.name, rod.yield_stress),
        {ends: rod_buckling_force(actuator.output_cylinder, rod, ends=ends) for ends in END_CONDITIONS}
        if rod.young_modulus is not None
        else {},
        (total(rows), total(rows, "mover")),
        described.unweighed,
    )


def _range(actuator: HydrostaticActuator, point: OperatingPoint) -> RangeMap | None:
    """Each limit's largest amplitude over the frequency; None where the force does not change with the stroke."""
    import numpy as np

    from fluxbore.design import hydrostatic_figures as figures
    from fluxbore.design.hydrostatic_range import LIMITS, demand, extension_at
    from fluxbore.reports.hydrostatic_content import RangeMap

    limit = figures.force_frequency_limit(actuator, extension_at(actuator, point.least + point.amplitude))
    whole = figures.stroke_force(actuator) / 2
    if not (limit > 0 and whole > 0):
        return None
    knee = limit / whole
    frequencies = np.geomspace(
        min(knee / SLOWER, point.frequency / 2), max(knee * FASTER, point.frequency * 2), FREQUENCIES
    )
    pressed = max((figures.ideal_force(actuator) - point.least) / 2, 0.0)
    largest = 3 * max(min(whole, pressed), point.amplitude / 2)
    least = min(limit / frequencies[-1], point.amplitude) / 2
    amplitudes = np.geomspace(least / BEYOND, largest * BEYOND, AMPLITUDES)
    asked = [[demand(actuator, a, f, point.least) for a in amplitudes.tolist()] for f in frequencies.tolist()]
    limits = {}
    for name in LIMITS:
        sizes = np.array([[float(getattr(item, name)) for item in row] for row in asked])
        limits[name] = np.array([_crossing(amplitudes, row) for row in sizes])
    if actuator.motor.rated_power is None:
        del limits["power"]
    return RangeMap(frequencies, limits, (least, largest))


def _crossing(amplitudes: Array, demands: Array) -> float:
    """Where demands that grow with the amplitude pass one; the nearer end where they do not."""
    import numpy as np

    beyond = np.flatnonzero(demands > 1)
    if not len(beyond) or beyond[0] == 0:
        return float(amplitudes[0 if len(beyond) else -1])
    at = beyond[0]
    x, y = np.log(amplitudes[at - 1 : at + 1]), np.log(np.maximum(demands[at - 1 : at + 1], 1e-9))
    return float(np.exp(x[0] - y[0] * (x[1] - x[0]) / (y[1] - y[0])))


def _tracked(actuator: HydrostaticActuator, point: OperatingPoint) -> tuple[Tracked | None, str]:
    """The operating point's last periods, else the reason why they are not shown."""
    import math

    import numpy as np

    from fluxbore.design.dynamics.force_reference import ForceReference
    from fluxbore.design.dynamics.hydrostatic_drive import simulate
    from fluxbore.design.dynamics.hydrostatic_ports import energy_audit, ports
    from fluxbore.optimize.hydrostatic_simulation import LEAST_TIME, LONGEST_STEP, since
    from fluxbore.reports.hydrostatic_content import PortRow, Tracked

    if point.frequency * LONGEST_SHOWN < 1:
        return None, f"A period of {1 / point.frequency:.4g} s is not simulated for a picture."
    signal = ForceReference(actuator.return_element.force(0.0), point.least, point.amplitude, point.frequency)
    control = actuator.drive.force_period
    step = control / math.ceil(control / LONGEST_STEP - 1e-9)
    turning = math.ceil(LEAST_TIME * point.frequency - 1e-9) / point.frequency
    periods = max(math.ceil(SHOWN_TIME * point.frequency - 1e-9), 1)
    try:
        run = simulate(actuator, signal, signal.ramp + turning, step=step)
    except DesignError as error:
        return None, str(error)
    begun = max(len(run.time) - 1 - round(periods / point.frequency / run.step), 0)
    shown = since(run, begun)
    audit, whole = energy_audit(shown), energy_audit(run)
    span = run.step * (len(shown.time) - 1)
    rows: list[PortRow] = []
    for port in ports(shown):
        power = np.asarray(port.power)
        effort, flow = (float(np.max(np.abs(values))) for values in (port.effort, port.flow))
        sent, returned = float(np.mean(np.maximum(power, 0.0))), float(np.mean(np.maximum(-power, 0.0)))
        rows.append(PortRow(port.name, effort, flow, port.units, sent, returned))
    return (
        Tracked(
            shown.time - shown.time[0],
            shown.reference,
            shown.force,
            shown.pressure,
            1 / point.frequency,
            tuple(rows),
            tuple((name, lost / span) for name, lost in audit.lost.items()),
            sum(part.stored for part in audit.components) / span,
            whole.imbalance,
        ),
        "",
    )
