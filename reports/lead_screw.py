"""The report's sections on a magnetic lead screw: its spring, its field, its pitch, in words and tables."""

from __future__ import annotations

from typing import Any

from fluxbore.design.force_series import ForceSeries
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.reports import helical_picture, lead_screw_curves, lead_screw_pitch, load_tables
from fluxbore.reports.lead_screw_content import ScrewContent
from fluxbore.reports.tables import Cell, Table
from fluxbore.reports.wording import capital, change, figure_scale, millimetres, scale, significant

ARCS = (
    "Magnets cut in arcs are computed as their mean over the rotor’s angle, which is what makes the mean force; the "
    "outlines are those of whole magnets."
)

MEMBERS = ("translator", "rotor")


def section(content: ScrewContent, spec: Spec, design: Evaluation) -> dict[str, Any]:
    """Everything that the template shows."""
    load = spec.number("operating_point.load_force")
    figures = design.performance
    return {
        "load_heading": "At rest and under the load" if load > 0 else "At rest",
        "force": lead_screw_curves.force_curve(content, load),
        "energy": lead_screw_curves.energy_curve(content, load),
        "engagement": lead_screw_curves.engagement_curve(content, load),
        "spring": spring(content, load, figures),
        "overload": overload(content, load, figures),
        "back_driving": back_driving(content, spec.number("operating_point.friction_torque"), load),
        "stroke": stroke(content, load),
        "field": helical_picture.field_picture(content),
        "loads": load_tables.section(content.loads, "where the screw slips"),
        "arcs": ARCS if any(getattr(content.screw, member).arcs for member in MEMBERS) else "",
        "pitch": lead_screw_curves.pitch_curves(content.pitch) if content.pitch is not None else None,
        "pitch_text": lead_screw_pitch.sentences(content.pitch) if content.pitch is not None else (),
        "iron": iron(content) if content.iron else None,
        "iron_note": iron_note(content),
    }


def spring(content: ScrewContent, load: float, figures: Performance) -> tuple[str, ...]:
    """How far the load bends the spring, and how much of it is left."""
    top, stall = content.peak
    slope = float(content.spring.stiffness(0.0))
    found = [
        f"At rest the spring has {scale('stiffness', [slope]).quantity(slope)}; it softens to nothing at "
        f"{millimetres(top)}, where it holds {_force(stall)}, its stall force."
    ]
    rest = content.rest_under(load)
    if load <= 0:
        found.append("The specification names no load.")
    elif rest is None:
        found.append(
            f"The load of {_force(load)} is beyond the stall force: the screw slips under it and holds it nowhere."
        )
    else:
        left = float(content.spring.stiffness(rest))
        found.append(
            f"The load of {_force(load)} displaces it by {millimetres(rest)}, {_percent(rest / top)} of the way to the "
            f"stall; {scale('stiffness', [left]).quantity(left)} are left there."
        )
    if figures.slip_margin is not None and load > 0 and rest is not None and figures.slip_margin < 1:
        found.append(
            "With the moving mass accelerated as the operating point asks the stall force is not enough: the screw "
            "slips while the motor speeds the mover up."
        )
    if figures.natural_frequency is not None:
        rate = figure_scale("natural_frequency", [figures.natural_frequency]).quantity(figures.natural_frequency)
        found.append(f"On this spring the mover swings at {rate} while the rotor is held.")
    return tuple(found)


def overload(content: ScrewContent, load: float, figures: Performance) -> tuple[str, ...]:
    """What happens beyond the stall."""
    series: ForceSeries = content.spring
    barrier = scale("work", [series.barrier]).quantity(series.barrier)
    found = [
        f"Pushed over the top the rotor snaps to the next rest, {millimetres(series.pitch)} on. Nothing breaks; "
        f"position is lost by whole pitches, and an encoder on either side sees it. {barrier} are stored at the top, "
        f"{millimetres(series.pitch / 2)} from rest."
    ]
    if load > 0:
        work = load * series.pitch
        found.append(
            f"Under the load each slip puts {scale('work', [work]).quantity(work)} into what moves, for something else "
            "to brake: the spring returns what it took."
        )
    limit = figures.sudden_load_limit
    if limit is not None:
        risk = ""
        if load > 0:
            risk = " The specified load is above that." if load > limit else " The specified load stays below that."
        found.append(
            f"A load that is put on at once makes the mover swing about twice as far as it will rest: without friction "
            f"the screw slips from {_force(limit)}, {_percent(limit / content.peak[1])} of the stall force.{risk}"
        )
    return tuple(found)


def back_driving(content: ScrewContent, friction: float, load: float) -> tuple[str, ...]:
    """Whether a load turns the rotor, and what the motor must hold."""
    h, stall = content.screw.h, content.peak[1]
    found = []
    if friction <= 0:
        found.append(
            "Every load drives the rotor back, for the specification names no torque of friction: nothing but the "
            "motor holds the position."
        )
    elif friction / h < stall:
        found.append(
            f"A load turns the rotor back against the friction from {_force(friction / h)} on; below that it stays "
            "where it is without a current."
        )
    else:
        found.append(
            f"No load turns the rotor back: friction would hold {_force(friction / h)}, and the screw slips before."
        )
    if 0 < load <= stall:
        held = h * load
        found.append(f"The load asks {scale('torque', [held]).quantity(held)} of the motor at standstill, h times F.")
    most = h * stall
    found.append(
        f"The motor cannot push harder than the stall force either: with more than "
        f"{scale('torque', [most]).quantity(most)} beyond its own friction and inertia it slips."
    )
    return tuple(found)


def stroke(content: ScrewContent, load: float) -> tuple[str, ...]:
    """What is left of the force at the ends of the stroke."""
    from fluxbore.design.lead_screw_figures import engaged_fraction, full_engagement

    share = float(engaged_fraction(content.screw, content.stroke / 2))
    reach = full_engagement(content.screw)
    stall = content.peak[1]
    if share >= 1 - 1e-9:
        return (
            f"All {content.screw.poles} poles are engaged over the whole stroke of {millimetres(content.stroke)}; they "
            f"would be over {millimetres(2 * reach)}.",
        )
    left = f"{_force(share * stall)}, {_percent(share)} of the stall force"
    text = (
        f"At the ends of the stroke of {millimetres(content.stroke)} poles run out of the translator: {left}, "
        f"is left. All poles are engaged over {millimetres(2 * reach)} alone."
    )
    return (text, "The load slips there.") if share * stall < load <= stall else (text,)


def iron(content: ScrewContent) -> Table:
    """The paper's three cases of back iron."""
    rows = tuple(
        (
            Cell(capital(case.name) + (" (specified)" if case.specified else ""), "strong" if case.specified else ""),
            Cell(f"{100 * case.second:.3f}"),
            Cell(f"{100 * case.third:.4f}"),
            Cell(f"{case.stall_force:.1f}"),
            Cell(f"{case.remanence:.4f}"),
        )
        for case in content.iron
    )
    head = (
        "Iron behind the magnets",
        "K_2/K_1 (%)",
        "K_3/K_1 (%)",
        "Stall force with the specified magnets (N)",
        f"Remanence for {significant(content.iron_force)} N (T)",
    )
    return Table("Back iron, by the analytic field", head, rows)


def iron_note(content: ScrewContent) -> str:
    """Of which force the table's remanences are."""
    if content.iron_force == content.peak[1]:
        return "The remanences are those with which each case would have the design’s stall force."
    return "The remanences are those with which each case would have the stall force of benchmark.force.stall_force."


def seen(content: ScrewContent, design: Evaluation | None) -> tuple[str, ...]:
    """What the section's own figures check."""
    found = []
    details = (design.details if design is not None else None) or {}
    if {"newton_iterations", "largest_residual"} <= details.keys():
        found.append(
            f"Newton’s iteration converged at all {len(content.samples)} displacements: "
            f"{details['newton_iterations']:.0f} steps together, largest relative residual "
            f"{significant(details['largest_residual'], 2)}."
        )
    spring, stall = content.spring, content.peak[1]
    found.append(
        f"The analytic field’s stall force lies {change(stall, content.analytic.peak[1])} against the finite elements, "
        f"its spring constant {change(float(spring.stiffness(0.0)), float(content.analytic.stiffness(0.0)))}."
    )
    work = scale("work", [spring.barrier])
    found.append(
        f"The force’s work on the way to the next pole, {work.quantity(spring.barrier)}, against the difference of the "
        f"fields’ energies there and at rest: {change(content.field_energy, spring.barrier)}."
    )
    return tuple(found)


def _force(force: float) -> str:
    unit = scale("force", [force])
    return f"{significant(force / unit.factor)}\u00a0{unit.unit}"


def _percent(share: float) -> str:
    return f"{100 * share:.0f}\u00a0%"
