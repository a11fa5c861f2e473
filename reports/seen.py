"""What the page's own figures check, in sentences: two routes to the force, residuals, masses."""

from __future__ import annotations

from fluxbore.optimize.evaluation import Evaluation
from fluxbore.reports import hydrostatic, lead_screw
from fluxbore.reports.content import ReportContent
from fluxbore.reports.wording import (
    change,
    figure_scale,
    significant,
)


def routes(design: Evaluation) -> str:
    """How far the two routes to the force lie apart."""
    figures = design.performance
    worst = max(
        (abs(p.force_constant_linkage / p.force_constant - 1) for p in design.positions if p.force_constant),
        default=0.0,
    )
    mean = change(figures.force_constant, figures.force_constant_linkage)
    if not mean:
        return ""
    return (
        f"Mean over the window, the flux-linkage route is {mean} against the stress tensor; "
        f"at a single position they differ by at most {100 * worst:.2f}\u00a0%."
    )


def ripple(design: Evaluation) -> str:
    """The force constant's ripple over the window."""
    values = [p.force_constant for p in design.positions]
    if len(values) < 2 or not sum(values):
        return ""
    share = (max(values) - min(values)) / (sum(values) / len(values))
    return f"Over the window the force constant varies by {100 * share:.2f}\u00a0% from its least to its largest."


def seen(content: ReportContent) -> tuple[str, ...]:
    """What the page's own figures check."""
    found = []
    design = content.design
    if design is not None and design.positions:
        steps, residual = max(p.iterations for p in design.positions), max(p.residual for p in design.positions)
        found.append(
            f"Newton’s iteration converged at all {len(design.positions)} positions: at most {steps} steps, "
            f"largest relative residual {significant(residual, 2)}."
        )
        found.append(routes(design))
    network = content.design_network
    if design is not None and network is not None:
        over = change(design.performance.force_constant, network.performance.force_constant)
        if over and content.words.network_note:
            sense = "an upper bound, as expected" if over.startswith("+") else "not the upper bound that was expected"
            found.append(f"Equation (2) of the network lies {over} against the finite elements: {sense}.")
    if content.screw is not None:
        found += lead_screw.seen(content.screw, design)
    if content.hydraulics is not None:  # whose parts list is that of one component
        found += hydrostatic.seen(content.hydraulics, design, network)
    else:
        found += _masses(content)
    return tuple(item for item in found if item)


def _masses(content: ReportContent) -> list[str]:
    design = content.design
    if design is None or not content.parts:
        return []
    mover = sum(row.mass * row.count for row in content.parts if row.group == "mover")
    whole = sum(row.mass * row.count for row in content.parts)
    pairs = (("mover", mover, design.performance.moving_mass), ("all parts", whole, design.performance.total_mass))
    found = []
    for name, listed, figure in pairs:
        if figure is not None:
            scale = figure_scale("total_mass", [listed])
            word = "equals" if abs(listed - figure) <= 1e-6 * figure else "differs from"
            found.append(
                f"The mass of {name} in the parts list, {scale.quantity(listed)}, {word} the model’s "
                f"{scale.quantity(figure)}."
            )
    return found
