"""The section that a benchmark in simulated time gets on the page, by the benchmark's name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from fluxbore.optimize.benchmark import BenchmarkResult
from fluxbore.reports import contact_force, force_benchmark, tracking_benchmark


@dataclass(frozen=True, slots=True)
class BenchmarkSection:
    """anchor : identifier of the section on the page. title : its link at the head of the page. template : its file.

    shown : everything that the template shows of a result that has figures.
    """

    anchor: str
    title: str
    template: str
    shown: Callable[[BenchmarkResult], Mapping[str, Any]]


SECTIONS: dict[str, BenchmarkSection] = {
    "mcfc": BenchmarkSection("contact-force", "Contact force", "contact_force.html", contact_force.section),
    "force": BenchmarkSection("force-benchmark", "Force, simulated", "force_benchmark.html", force_benchmark.section),
    "tracking": BenchmarkSection("tracking", "Force tracking", "tracking_benchmark.html", tracking_benchmark.section),
}
"""Every benchmark that has a section."""


def benchmark_section(result: BenchmarkResult | None) -> dict[str, Any] | None:
    """What the page needs of a simulation; None where there is none, or none with figures."""
    if result is None or not result.ok:
        return None
    section = SECTIONS.get(result.benchmark.name)
    if section is None:
        return None
    return {
        "anchor": section.anchor,
        "title": section.title,
        "template": section.template,
        "shown": section.shown(result),
    }
