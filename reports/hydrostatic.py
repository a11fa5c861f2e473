"""The report's sections on an electro-hydrostatic actuator: range, chain of power, return element, force, fluid."""

from __future__ import annotations

from typing import Any

from fluxbore.design.hydrostatic_range import Demand
from fluxbore.design.return_element import ConstantReturn, CordReturn
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.reports import hydrostatic_curves as curves
from fluxbore.reports import hydrostatic_parts_tables as parts
from fluxbore.reports.hydrostatic_content import HydraulicsContent, Tracked
from fluxbore.reports.tables import Cell, Table
from fluxbore.reports.wording import capital, change, figure_scale, millimetres, percent, scale, significant

BAR = 1e5

CONTINUOUS = "continuous, root mean square"


def section(content: HydraulicsContent, spec: Spec) -> dict[str, Any]:
    """Everything that the template shows."""
    tracked = content.tracked
    fits = content.demand.limit is None
    return {
        "map": curves.range_map(content.range, content.point, fits) if content.range is not None else None,
        "range": range_text(content),
        "demand": demand_table(content),
        "power": curves.power_band(tracked) if tracked is not None else None,
        "ports": ports(tracked) if tracked is not None else None,
        "losses": losses(tracked) if tracked is not None else None,
        "traces": curves.traces(tracked) if tracked is not None else None,
        "untracked": content.untracked,
        "return_curve": curves.return_curve(content),
        "return_text": return_text(content),
        "force": force_text(content),
        "fluid": fluid_text(content, spec),
        "masses": parts.masses(content),
        "mass_text": parts.mass_text(content),
        "margins": parts.margins(content),
        "gland": parts.gland(content.gland),
    }


def range_text(content: HydraulicsContent) -> tuple[str, ...]:
    """What the operating point asks for, and what it has left."""
    point, figures = content.point, content.figures
    asked = (
        f"The operating point asks for {_force(point.amplitude)} at {significant(point.frequency)}\u00a0Hz, half the "
        f"distance between the peaks, from {_force(point.least)} to {_force(point.top)}."
    )
    if content.range is None:
        return (
            "A constant force is the same wherever the piston stands: there is no other force to choose, and no "
            f"amplitude over a frequency. The piston works against {_force(content.actuator.return_element.force(0.0))}"
            " at any speed that the motor has.",
        )
    limit = content.demand.limit
    found = [asked]
    if figures.force_frequency_limit is not None:
        shown = figure_scale("force_frequency_limit", [figures.force_frequency_limit])
        product = point.amplitude * point.frequency
        found.append(
            f"By equation (4) amplitude times frequency may be {shown.quantity(figures.force_frequency_limit)}; "
            f"{shown.quantity(product)} are asked."
        )
    found.append(
        "It lies within every limit."
        if limit is None
        else f"It lies beyond the limit of the {limit}, and cannot be made as asked."
    )
    return tuple(found)


def demand_table(content: HydraulicsContent) -> Table | None:
    """What there is of each, and how much of it the operating point takes."""
    if content.range is None:
        return None
    actuator, demand, motor = content.actuator, content.demand, content.actuator.motor
    speed = actuator.maximum_velocity * actuator.hydraulic_ratio
    there = {
        "speed": f"{significant(speed)}\u00a0m/s of the output piston",
        "stroke": millimetres(actuator.output_cylinder.stroke),
        "pressure": f"{significant(actuator.output_cylinder.rated_pressure / BAR)}\u00a0bar, rated, output cylinder",
        "torque": f"{_torque(motor.continuous_torque)} {CONTINUOUS}, {_torque(motor.peak_torque)} peak",
    }
    if motor.rated_power is not None:
        there["power"] = f"{significant(motor.rated_power)}\u00a0W, mean over the period"
    rows = tuple((Cell(capital(name)), Cell(text), _share(demand, name)) for name, text in there.items())
    return Table(
        "What the operating point takes of each limit", ("Limit", "There is", "Taken"), rows, words=frozenset({1})
    )


def _share(demand: Demand, name: str) -> Cell:
    value = float(getattr(demand, name))
    return Cell(percent(value), "bad" if value > 1 + 1e-9 else "")


def ports(tracked: Tracked) -> Table:
    """Largest effort and flow, and mean powers, at every port."""
    rows = []
    for row in tracked.ports:
        effort, flow = _measured(row.effort, row.units[0]), _measured(row.flow, row.units[1])
        rows.append(
            (
                Cell(capital(row.name)),
                Cell(effort),
                Cell(flow),
                Cell(significant(row.sent)),
                Cell(significant(row.returned)),
                Cell(significant(row.sent - row.returned, 3)),
            )
        )
    head = ("Port", "Largest effort", "Largest flow", "Sent (W)", "Returned (W)", "Difference (W)")
    return Table("Effort, flow and power at every port of the chain", head, tuple(rows))


def _measured(size: float, unit: str) -> str:
    """In the units that the branch uses."""
    factor, shown = {"Pa": (BAR, "bar"), "m^3/s": (1e-6, "ml/s"), "m/s": (1.0, "m/s")}.get(unit, (1.0, unit))
    return f"{significant(size / factor)}\u00a0{shown}"


def losses(tracked: Tracked) -> Table:
    """Where the mean power goes."""
    whole = sum(lost for _, lost in tracked.losses)
    rows = tuple(
        (Cell(capital(name)), Cell(significant(lost, 3)), Cell(percent(lost / whole) if whole else ""))
        for name, lost in tracked.losses
    )
    foot = ((Cell("All"), Cell(significant(whole, 3), "strong"), Cell("")),)
    return Table("Losses at the operating point, mean", ("Component", "Loss (W)", "Share"), rows, foot)


def return_text(content: HydraulicsContent) -> tuple[str, ...]:
    """What pushes the piston back, and how far the operating point bends it."""
    actuator, point = content.actuator, content.point
    element, stroke = actuator.return_element, actuator.output_cylinder.stroke
    start, end = curves.held(actuator, 0.0), curves.held(actuator, stroke)
    work = scale("work", [element.energy(stroke)]).quantity(element.energy(stroke))
    if isinstance(element, ConstantReturn):
        found = [
            f"A constant force of {_force(start)} brings the piston back; over the stroke of {millimetres(stroke)} it "
            f"stores {work}."
        ]
    elif isinstance(element, CordReturn):
        stretched = element.stretch + stroke / element.length
        found = [
            f"Rubber cord, {millimetres(element.length)} long unstrained, goes from {element.stretch:.3g} to "
            f"{stretched:.3g} times its length over the stroke and from {_force(start)} to {_force(end)}, by Mooney’s "
            f"law without hysteresis; it stores {work}.",
            f"Its stiffness goes from {_stiffness(element.stiffness(0.0))} to {_stiffness(element.stiffness(stroke))}: "
            "speed and (4) depend on where the force lies, and are taken in its middle.",
        ]
    else:
        found = [
            f"Springs of {_stiffness(element.stiffness(0.0))} together push with {_force(start)} at the retracted end "
            f"and {_force(end)} at the other, {millimetres(stroke)} on; they store {work}."
        ]
    if actuator.series_stiffness is not None:
        found.append(
            f"The series spring of {_stiffness(actuator.series_stiffness)} works in parallel with it while the load is "
            "held, and its force is in these figures."
        )
    if content.range is not None and content.figures.stroke_load is not None:
        found.append(
            f"The largest force of the operating point, {_force(point.top)}, takes "
            f"{percent(content.figures.stroke_load)} of the stroke."
        )
    return tuple(found)


def force_text(content: HydraulicsContent) -> tuple[str, ...]:
    """Force at the rated pressure, by mass, and what of it arrives."""
    figures = content.figures
    found = []
    if figures.force_at_rated_pressure is not None and figures.pushing_force is not None:
        found.append(
            f"At the rated pressure the output piston has {_force(figures.force_at_rated_pressure)} without friction "
            f"and {_force(figures.pushing_force)} less the seal’s friction at the largest speed."
        )
    if figures.specific_force_distal is not None and figures.specific_force_total is not None:
        found.append(
            f"That is {significant(figures.specific_force_distal)}\u00a0N/kg of what is worn at the joint, and "
            f"{significant(figures.specific_force_total)}\u00a0N/kg of all that has a mass in the specification."
        )
    if content.range is None:  # and nothing moves
        return tuple(found)
    if figures.minimum_friction is not None and figures.friction_at_limit is not None:
        found.append(
            f"A sliding seal takes {_force(figures.minimum_friction)} at least, without pressure, and "
            f"{_force(figures.friction_at_limit)} at the largest speed and the operating point’s largest pressure."
        )
    if figures.force_efficiency is not None and figures.force_efficiency_both is not None:
        found.append(
            f"Of the largest force and the friction there {percent(figures.force_efficiency)} arrive if one cylinder’s "
            f"seal is counted, as the paper does, and {percent(figures.force_efficiency_both)} with both."
        )
    return tuple(found)


def fluid_text(content: HydraulicsContent, spec: Spec) -> tuple[str, ...]:
    """Pressures, temperature, stiffness of the column."""
    from fluxbore.design.units import STANDARD_ATMOSPHERE

    figures, fluid = content.figures, content.actuator.fluid
    if content.range is None:
        rest = content.actuator.return_element.force(0.0)
        return (
            f"The constant force takes {_bar(rest / content.actuator.output_cylinder.area)} in the output cylinder; "
            "what friction and flow add to it depends on a movement, which the specification does not tell.",
        )
    found = []
    if figures.peak_pressure is not None and figures.least_pressure is not None:
        vapour = (fluid.vapour_pressure - STANDARD_ATMOSPHERE) / BAR
        how = "simulated" if content.tracked is not None else "in closed form"
        found.append(
            f"At the operating point, {how}, the pressure is {_bar(figures.least_pressure)} at the least, in either "
            f"cylinder, and {_bar(figures.peak_pressure)} at the most, in the output cylinder; the fluid would boil at "
            f"{significant(vapour, 3)}\u00a0bar."
        )
    if figures.line_pressure_drop is not None:
        found.append(
            f"Ports, fittings, hose and block take {_bar(figures.line_pressure_drop)} at the operating point’s largest "
            "speed."
        )
    if figures.effective_bulk_modulus is not None:
        stiff = scale("stress", [figures.effective_bulk_modulus]).quantity(figures.effective_bulk_modulus)
        found.append(
            f"Fluid, entrained air ({percent(fluid.air_fraction)} of the volume without pressure) and hose together "
            f"have an effective bulk modulus of {stiff} at the middle pressure; the liquid alone has "
            f"{scale('stress', [fluid.bulk_modulus]).quantity(fluid.bulk_modulus)}."
        )
    if figures.fluid_temperature is not None:
        ambient = spec.number("operating_point.ambient_temperature")
        warm = figure_scale("fluid_temperature", [figures.fluid_temperature])
        found.append(
            f"If the operating point goes on, the fluid warms to {warm.quantity(figures.fluid_temperature)} in still "
            f"air of {warm.quantity(ambient)}, by convection and radiation of cylinders and hose alone; the figures "
            f"are those of the fluid at {warm.quantity(content.actuator.temperature)}."
        )
    return tuple(found)


def seen(content: HydraulicsContent, design: Evaluation | None, network: Evaluation | None) -> tuple[str, ...]:
    """What the section's own figures check."""
    found = []
    if content.tracked is not None:
        found.append(
            f"Energy of the simulation: what enters equals what is stored and lost in every component to "
            f"{significant(content.tracked.imbalance, 2)} of what entered."
        )
    if design is not None and design.ok and network is not None and network.ok:
        exact, cheap = design.performance.peak_pressure, network.performance.peak_pressure
        if change(exact, cheap):
            found.append(
                f"The largest pressure in closed form lies {change(exact, cheap)} against the simulation, which "
                "includes the loops and the fluid that gives."
            )
    whole = content.figures.total_mass
    if whole is not None:
        listed = sum(mass for _, mass, _, _ in parts.components(content))
        word = "equals" if abs(listed - whole) <= 1e-9 * whole else "differs from"
        weight = figure_scale("total_mass", [whole])
        found.append(f"The sum of the components’ masses, {weight.quantity(listed)}, {word} the model’s total mass.")
    return tuple(found)


def _force(force: float) -> str:
    unit = scale("force", [force])
    return f"{significant(force / unit.factor)}\u00a0{unit.unit}"


def _torque(value: float) -> str:
    unit = scale("torque", [value])
    return f"{significant(value / unit.factor)}\u00a0{unit.unit}"


def _stiffness(value: float) -> str:
    unit = scale("stiffness", [value])
    return f"{significant(value / unit.factor)}\u00a0{unit.unit}"


def _bar(pressure: float) -> str:
    return f"{significant(pressure / BAR)}\u00a0bar"
