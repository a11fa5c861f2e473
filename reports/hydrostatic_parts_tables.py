"""Tables of an electro-hydrostatic actuator's report on what is built: masses, strength, the seal's gland."""

from __future__ import annotations

from fluxbore.design.seal_gland import (
    LARGEST_FILL,
    LARGEST_SQUEEZE,
    LARGEST_STRETCH,
    LARGEST_THIN,
    LEAST_SQUEEZE,
    THIN,
    SealGland,
    gland_figures,
)
from fluxbore.reports.hydrostatic_content import HydraulicsContent
from fluxbore.reports.tables import Cell, Table
from fluxbore.reports.wording import DASH, capital, millimetres, percent, scale, significant

BAR = 1e5

DRAWN, GIVEN, UNTOLD = "as drawn", "given", "not told: counted as nothing"


def components(content: HydraulicsContent) -> list[tuple[str, float, float, str]]:
    """Name, mass (kg), what of it is worn at the joint (kg), and where it comes from."""
    actuator, drawn = content.actuator, content.unweighed
    hose, fluid = actuator.hose, actuator.fluid.density
    filled = actuator.fluid_volume * fluid
    springs = float(getattr(actuator.return_element, "mass", 0.0))
    output, tube = actuator.output_cylinder.mass, hose.linear_mass * hose.length
    rows = [
        ("motor", actuator.motor.mass, 0.0, ""),
        ("drive", actuator.drive.mass, 0.0, ""),
        ("coupling", actuator.coupling.mass, 0.0, ""),
        ("ball screw", actuator.ball_screw.mass, 0.0, ""),
        ("input cylinder", actuator.input_cylinder.mass, 0.0, "input_cylinder.mass"),
        ("hose", tube, tube / 2, ""),
        ("fluid", filled, hose.volume * fluid / 2, "filled"),
        ("pressure block", actuator.block.mass, 0.0, ""),
        ("output cylinder", output, output, "output_cylinder.mass"),
        ("return element", springs, springs, "return_spring.mass"),
        ("other at the joint", actuator.other_distal_mass, actuator.other_distal_mass, ""),
    ]
    return [
        (
            name,
            mass,
            worn,
            "by volume and density" if key == "filled" else DRAWN if key in drawn else GIVEN if mass > 0 else UNTOLD,
        )
        for name, mass, worn, key in rows
    ]


def masses(content: HydraulicsContent) -> Table:
    """What every component weighs, and what of it is worn."""
    rows, whole, distal = [], 0.0, 0.0
    for name, mass, worn, source in components(content):
        whole, distal = whole + mass, distal + worn
        tone = "muted" if source == UNTOLD else ""
        if name == "return element" and source == DRAWN:
            source = "least elastic material that does it"
        rows.append((Cell(capital(name)), _grams(mass), _grams(worn), Cell(source, tone)))
    foot = ((Cell("All"), Cell(f"{whole * 1e3:.1f}", "strong"), Cell(f"{distal * 1e3:.1f}", "strong"), Cell("")),)
    head = ("Component", "Mass (g)", "Worn at the joint (g)", "Source")
    return Table("Masses", head, tuple(rows), foot, words=frozenset({3}))


def mass_text(content: HydraulicsContent) -> tuple[str, ...]:
    """What the drawing weighs beside what is given, and what the force density leaves out."""
    whole, moving = content.drawn
    cylinder = content.actuator.output_cylinder
    found = [f"As drawn the output cylinder weighs {_mass(whole)}, {_mass(moving)} of which move."]
    for leaf, drawn, given in (("mass", whole, cylinder.mass), ("moving_mass", moving, cylinder.moving_mass)):
        if f"output_cylinder.{leaf}" not in content.unweighed:
            found.append(f"The specification gives {_mass(given)} for its {leaf.replace('_', ' ')}, which counts.")
            if leaf == "mass" and drawn > given:
                found.append("That is less than its parts as drawn.")
    untold = [name for name, _, _, source in components(content) if source == UNTOLD and not name.startswith("other")]
    if untold:
        found.append(
            f"No mass is told of {', '.join(untold)}: with them the force by total mass is smaller than the one given."
        )
    return tuple(found)


def margins(content: HydraulicsContent) -> Table:
    """Loads beside what the parts bear."""
    figures, actuator = content.figures, content.actuator
    cylinder, hose = actuator.output_cylinder, actuator.hose
    rated = cylinder.area * cylinder.rated_pressure
    stress = scale("stress", [content.tube.yield_stress, content.rod.yield_stress])
    rows = [
        (
            f"Tube of {content.tube.name}, equivalent stress at the bore at the rated pressure (Lamé)",
            _of(content.tube.yield_stress, figures.burst_factor, stress.quantity),
            f"{stress.quantity(content.tube.yield_stress)} yield stress",
            figures.burst_factor,
        ),
        (
            f"Rod of {content.rod.name}, compressed by the force at the rated pressure",
            stress.quantity(figures.shaft_stress),
            f"{stress.quantity(content.rod.yield_stress)} yield stress",
            figures.shaft_safety,
        ),
    ]
    rows += [
        (
            f"Rod as a column over the stroke, {ends.replace('-', ' and ')}",
            f"{significant(rated)}\u00a0N at the rated pressure",
            f"{significant(critical)}\u00a0N",
            critical / rated,
        )
        for ends, critical in content.buckling.items()
    ]
    peak = figures.peak_pressure
    if peak is not None and content.range is not None:
        limits = (
            ("Output cylinder", cylinder.rated_pressure, "rated"),
            ("Hose", hose.rated_pressure, "rated"),
            ("Hose", hose.burst_pressure, "burst"),
        )
        rows += [
            (
                f"{name}, largest pressure of the operating point",
                f"{significant(peak / BAR)}\u00a0bar",
                f"{significant(limit / BAR)}\u00a0bar {word}",
                limit / peak,
            )
            for name, limit, word in limits
            if limit is not None
        ]
    if hose.rated_pressure is None and hose.burst_pressure is None:
        rows.append(("Hose", DASH, "neither rated nor burst pressure is told", None))
    cells = tuple((Cell(what), Cell(load), Cell(bears), _factor(factor)) for what, load, bears, factor in rows)
    return Table("Strength", ("What", "Load", "Bears", "Factor"), cells, words=frozenset({1, 2}))


def _of(bears: float | None, factor: float | None, shown: object) -> str:
    """The load that a factor and what is borne tell."""
    assert callable(shown)
    return str(shown(bears / factor)) if bears is not None and factor else DASH


def _factor(factor: float | None) -> Cell:
    if factor is None:
        return Cell(DASH, "muted")
    return Cell(significant(factor, 3), "bad" if factor < 1 else "")


def gland(found: SealGland) -> Table:
    """The O-ring in its groove against the rules for a moving seal."""
    figures = gland_figures(found)
    thin = found.ring_section <= THIN
    most = LARGEST_THIN if thin else LARGEST_SQUEEZE
    depth = (found.bore - found.groove_diameter) / 2
    limits = (
        ("Squeeze", figures.squeeze, LEAST_SQUEEZE, most),
        ("Stretch in place", figures.stretch, 0.0, LARGEST_STRETCH),
        ("Share of the groove that is filled", figures.fill, 0.0, LARGEST_FILL),
    )
    rows = [
        (
            Cell(name),
            Cell(percent(value)),
            Cell(f"{100 * low:.0f} to {100 * high:.0f}\u00a0%"),
            _holds(low, value, high),
        )
        for name, value, low, high in limits
    ]
    sizes = (
        ("Ring: section, inside", f"{millimetres(found.ring_section)}, {millimetres(found.ring_inner_diameter)}"),
        ("Groove: floor, depth", f"{millimetres(found.groove_diameter)}, {millimetres(depth)}"),
        ("Groove: width", millimetres(found.groove_width)),
        ("Section in place", millimetres(figures.section)),
    )
    rows += [(Cell(name), Cell(text), Cell(""), Cell("")) for name, text in sizes]
    return Table(
        "O-ring of the piston and its groove", ("What", "Here", "Rule", "Holds"), tuple(rows), words=frozenset({3})
    )


def _holds(low: float, value: float, high: float) -> Cell:
    held = low - 1e-9 <= value <= high + 1e-9
    return Cell("yes" if held else "no", "good" if held else "bad")


def _grams(mass: float) -> Cell:
    return Cell(f"{mass * 1e3:.1f}") if mass > 0 else Cell(DASH, "muted")


def _mass(mass: float) -> str:
    return scale("mass", [mass]).quantity(mass)
