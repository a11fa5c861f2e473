"""Every figure of the design under its heading: by each route, and where it comes from."""

from __future__ import annotations

from fluxbore.design.performance import FIGURES, grouped
from fluxbore.design.rates import measure_of_figure
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.reports.content import ReportContent
from fluxbore.reports.figure_sources import assumptions, source_text
from fluxbore.reports.tables import Cell, Table
from fluxbore.reports.wording import DASH, capital, change, difference, figure_label, figure_scale, meaning


def comparison(content: ReportContent) -> Table | None:
    """Every figure: start and chosen by the kind's own route, the chosen by the network where the kind has one."""
    design, network = content.design, content.design_network
    columns: list[tuple[str, Evaluation]] = []
    short, word = content.words.route_short, "Chosen, " if content.is_study else ""
    if content.is_study and content.start is not None:
        columns.append((f"Start, {short}", content.start))
    columns += [(capital(f"{word}{short}"), design)] if design is not None else []
    columns += [(capital(f"{word}{content.words.network_short}"), network)] if network is not None else []
    both = design is not None and network is not None
    rows: list[tuple[Cell, ...]] = []
    sections = []
    for group, names in grouped(_given(content)):
        sections.append((len(rows), group))
        for name in names:
            values = [getattr(item.performance, name) for _, item in columns]
            scale = figure_scale(name, values)
            cells = [Cell(capital(figure_label(name))), Cell(scale.unit or DASH, "muted")]
            cells += [Cell(scale.number(value)) for value in values]
            if design is not None and network is not None:
                fine, coarse = getattr(design.performance, name), getattr(network.performance, name)
                cells.append(Cell(against(name, fine, coarse) or DASH, "muted"))
            rows.append(tuple(cells))
    head = (
        "Figure",
        "Unit",
        *(title for title, _ in columns),
        *((f"{capital(content.words.network_short)} against {short}",) if both else ()),
    )
    caption = "Every figure by both routes" if both else f"Every figure by {content.words.route}"
    return Table(caption, head, tuple(rows), words=frozenset({1}), sections=tuple(sections)) if rows else None


def meanings(content: ReportContent) -> Table | None:
    """What each figure of the comparison is, where it comes from, and what it rests on that is assumed."""
    rows: list[tuple[Cell, ...]] = []
    sections = []
    for group, names in grouped(_given(content)):
        sections.append((len(rows), group))
        for name in names:
            texts = (meaning(name), source_text(name), assumptions(content.design_spec, name))
            rows.append((Cell(capital(figure_label(name))), *(Cell(text or DASH) for text in texts)))
    head = ("Figure", "What it is", "Formula (source)", "Assumed or by default")
    columns = frozenset({1, 2, 3})
    caption = "What each figure is and where it comes from"
    return Table(caption, head, tuple(rows), words=columns, sections=tuple(sections), signs=True) if rows else None


def against(name: str, fine: float | None, coarse: float | None) -> str:
    """The relative change; of temperatures, which have no share of one another, the difference."""
    if FIGURES[name].dimension == "temperature" and fine is not None and coarse is not None:
        return difference(measure_of_figure(name), coarse - fine, signed=True)
    return change(fine, coarse)


def _given(content: ReportContent) -> list[str]:
    """The figures that any of the shown routes gives."""
    shown = [content.design, content.design_network, content.start if content.is_study else None]
    return [n for n in FIGURES if any(getattr(item.performance, n) is not None for item in shown if item is not None)]
