"""Writes docs/validation/gallery/: every case solved, beside its exact values. Run from anywhere; takes minutes.

`python docs/validation/gallery.py [CASE]...` writes the pages of the cases named, or all and their index. The exit
status is 3 where a value is outside its tolerance.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from cases import CASES, Case
from gallery_figures import draw_model
from gallery_run import Run, run

from fluxbore.design.errors import FluxboreError
from fluxbore.fem.femm_writer import write_text
from fluxbore.reports.flux_plot import flux_plot

TARGET = Path(__file__).parent / "gallery"
ACCURACIES = (5e-3, None, 2e-4)
DEFAULT = 1
"""Which of them is the solver's own."""


def page(case: Case, runs: list[Run]) -> str:
    """One case."""
    lines = [f"# {case.title}", "", *([case.notes, ""] if case.notes else []), f"Exact values: {case.source}.", ""]
    if case.open_boundary:
        lines += ["The outermost circle is continued by an open boundary; the file itself says A = 0 there.", ""]
    lines += [f"![the model]({case.name}.svg) ![its field]({case.name}.png)", ""]
    lines += [f"The model: [{case.name}.fem]({case.name}.fem).", ""]
    lines += ["| quantity | exact | fluxbore | error | tolerance |", "|---|---|---|---|---|"]
    result = runs[DEFAULT].result
    for check in case.checks:
        error, mark = check.error(result), "" if check.holds(result) else " **outside**"
        lines.append(
            f"| {case.label(check)} ({check.unit}) | {check.exact:.7g} | {check.read(result):.7g} "
            f"| {error:+.3%}{mark} | {check.tolerance:.1%} |"
        )
    lines += ["", "Errors of components are relative to the vector's size.", ""]
    if case.groups:
        lines += _forces(case, runs[DEFAULT])
    return "\n".join([*lines, *_convergence(case, runs)]) + "\n"


def _forces(case: Case, solved: Run) -> list[str]:
    """The two routes, and what is left of a closed pair."""
    lines = ["| group | stress tensor (N) | layer next to the body (N) | they differ by |", "|---|---|---|---|"]
    forces = {group: solved.result["groups"][str(group)] for group in case.groups}
    for group, found in forces.items():
        a, b = np.array(found["force"]), np.array(found["force_by_virtual_work"])
        scales = [check.scale for check in case.checks if check.path[:3] == ("groups", str(group), "force")]
        size = max(float(np.hypot(*a)), *scales, 1e-300)  # a force of zero is held against what would be one
        lines.append(f"| {group} | {_vector(a)} | {_vector(b)} | {float(np.hypot(*(a - b))) / size:.3%} |")
    lines.append("")
    for one, other in case.pairs:
        a, b = np.array(forces[one]["force"]), np.array(forces[other]["force"])
        rest = float(np.hypot(*(a + b))) / float(np.hypot(*a))
        lines += [f"Groups {one} and {other} together: {rest:.1e} of either.", ""]
    return lines


def _vector(value: np.ndarray) -> str:
    return f"({value[0]:.6g}, {value[1]:.6g})"


def _convergence(case: Case, runs: list[Run]) -> list[str]:
    """Errors at three accuracies."""
    heads = ["default, 0.10%" if accuracy is None else f"{accuracy:.2%}" for accuracy in ACCURACIES]
    lines = ["| accuracy asked for | " + " | ".join(heads) + " |", "|---|" + "---|" * len(heads)]
    lines.append("| unknowns | " + " | ".join(f"{item.result['mesh']['unknowns']:,}" for item in runs) + " |")
    estimates = (item.result["accuracy"]["estimate"] for item in runs)
    lines.append("| estimated error | " + " | ".join(f"{estimate:.1e}" for estimate in estimates) + " |")
    for check in case.checks:
        errors = " | ".join(f"{check.error(item.result):+.1e}" for item in runs)
        lines.append(f"| {case.label(check)} | {errors} |")
    return lines


def summary(case: Case, runs: list[Run]) -> str:
    """The case's row of the index."""
    result = runs[DEFAULT].result
    worst = max(case.checks, key=lambda check: abs(check.error(result)) / check.tolerance)
    outside = sum(not check.holds(result) for check in case.checks)
    verdict = "yes" if not outside else f"{outside} outside"
    return (
        f"| [{case.title}]({case.name}.md) | {'axisymmetric' if case.model.axisymmetric else 'planar'} "
        f"| {result['mesh']['unknowns']:,} | {len(case.checks)} | {case.label(worst)} | {worst.error(result):+.3%} "
        f"| {routes(case, result)} | {verdict} |"
    )


SPAN = 100
"""File units: a force that needs a longer arm than this to give the torque is next to nothing."""


def routes(case: Case, result: Mapping[str, Any]) -> str:
    """The largest difference of the two force routes, of the force or, where there is only torque, of the torque."""
    worst = 0.0
    for group in case.groups:
        found = result["groups"][str(group)]
        force, other = np.array(found["force"]), np.array(found["force_by_virtual_work"])
        if abs(found["torque"]) > 0 and float(np.hypot(*force)) * SPAN * case.model.metres < abs(found["torque"]):
            worst = max(worst, abs(found["torque_by_virtual_work"] / found["torque"] - 1))
        else:
            worst = max(worst, float(np.hypot(*(force - other)) / np.hypot(*force)))
    return f"{worst:.3%}" if case.groups else ""


def index(rows: list[str]) -> str:
    """The table of all cases."""
    head = [
        "# Validation gallery",
        "",
        "Written by `python docs/validation/gallery.py`. Every value at the solver's default accuracy, on automatic",
        "mesh sizes; the tolerances are 0.3 % for linkages, energies and B, and 0.5 % for forces.",
        "",
        "| case | type | unknowns | values | nearest to its tolerance | its error | force routes differ | all within |",
        "|---|---|---|---|---|---|---|---|",
    ]
    return "\n".join([*head, *rows]) + "\n"


def main(names: list[str]) -> int:
    TARGET.mkdir(exist_ok=True)
    rows, failed = [], False
    for build in CASES:
        case = build()
        if names and case.name not in names:
            continue
        try:
            runs = [run(case, accuracy) for accuracy in ACCURACIES]
        except FluxboreError as error:
            rows.append(f"| {case.title} | | | {len(case.checks)} | {error} | | | no result |")
            failed = True
            continue
        (TARGET / f"{case.name}.fem").write_text(write_text(case.model), encoding="utf-8")
        draw_model(case, TARGET / f"{case.name}.svg")
        flux_plot(runs[DEFAULT].solution, TARGET / f"{case.name}.png", width=520)
        (TARGET / f"{case.name}.md").write_text(page(case, runs), encoding="utf-8")
        rows.append(summary(case, runs))
        print(rows[-1], flush=True)
        failed |= not all(check.holds(runs[DEFAULT].result) for check in case.checks)
    if not names:
        (TARGET / "index.md").write_text(index(rows), encoding="utf-8")
    return 3 if failed else 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
