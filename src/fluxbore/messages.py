"""What the command line says of results: plain values for ``--json``, tables for people, the progress line."""

from __future__ import annotations

import re
import sys
import time
from collections.abc import Mapping, Sequence
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

from fluxbore.design.keys import Value
from fluxbore.design.performance import FIGURES, show_figure
from fluxbore.design.spec import KINDS, Spec
from fluxbore.optimize.evaluation import Evaluation, to_plain
from fluxbore.optimize.outcome import Candidate, Check, SearchResult, SweepResult
from fluxbore.optimize.progress import Progress

if TYPE_CHECKING:
    from fluxbore.api import DesignResult

SECONDS_BETWEEN_LINES = 5.0
"""Between progress lines where stderr is a file; a terminal gets one line that is written over."""


def show_key(spec: Spec, name: str, value: Value) -> str:
    """A key's value in its preferred unit."""
    key = spec.kind.key(name)
    return key.show(value) if key is not None else str(value)


def spec_plain(spec: Spec) -> dict[str, Any]:
    """The checked specification: every key's value in SI, and the notes."""
    return {
        "status": "ok",
        "reasons": [],
        "specification": spec.fingerprint(),
        "values": dict(spec.values),
        "assumed": {note.key: note.reason for note in spec.notes if note.status == "assumed"},
        "calibrated": {note.key: note.reason for note in spec.notes if note.status == "calibrated"},
        "study": {
            "variables": [variable.key for variable in spec.study.variables],
            "sweeps": {sweep.name: sweep.size for sweep in spec.study.sweeps},
        },
    }


def spec_text(spec: Spec) -> str:
    """The checked specification as a table: given and derived values."""
    lines = []
    width = max(len(key.name) for key in spec.kind.keys)
    for key in spec.kind.keys:
        if key.name not in spec.values:
            continue
        notes = "" if key.name in spec.given else "  (follows)"
        notes += "".join(f"  ({note.status})" for note in spec.notes if note.key == key.name)
        lines.append(f"{key.name:<{width}}  {key.show(spec.values[key.name])}{notes}")
    return "\n".join([*lines, *_study_lines(spec), "", "The specification is sound."])


def _study_lines(spec: Spec) -> list[str]:
    """The study in words: objective, variables, limits, sweeps."""
    study = spec.study
    lines = []
    if study.objective is not None:
        lines.append(f"{'maximise' if study.objective.maximise else 'minimise'} {study.objective.figure}")
    for item in study.variables:
        key = spec.kind.known(item.key)
        step = f" in steps of {key.difference.show(item.resolution)}" if item.resolution is not None else ""
        lines.append(
            f"vary {item.key} from {show_key(spec, item.key, item.lower)} to "
            f"{show_key(spec, item.key, item.upper)}{step}"
        )
    for limit in study.constraints:
        for word, value in (("at most", limit.upper), ("at least", limit.lower)):
            if value is not None:
                shown = f"{value:g} x the start's" if limit.relative_to_start else _show(limit.subject, value)
                lines.append(f"keep {limit.subject} {word} {shown}")
    lines += [f"hold {key}" for key in study.hold]
    lines += [f"sweep {sweep.name}: {sweep.size} designs" for sweep in study.sweeps]
    return ["", *lines] if lines else []


def evaluation_text(evaluation: Evaluation) -> str:
    """The figures as a table, or why there are none."""
    if not evaluation.ok:
        return f"{evaluation.status}: " + " ".join(evaluation.reasons)
    width = max(len(name) for name in FIGURES)
    lines = [f"By {'finite elements' if evaluation.fidelity == 'fem' else 'the magnetic network'}:"]
    for name in FIGURES:
        value = getattr(evaluation.performance, name)
        if value is not None:
            lines.append(f"{name:<{width}}  {show_figure(name, value)}")
    lines += ["", *evaluation.warnings] if evaluation.warnings else []
    if evaluation.fidelity == "network":
        from fluxbore.design.magnetic_network import UPPER_BOUND

        lines += ["", f"force_constant: {UPPER_BOUND[0].lower()}{UPPER_BOUND[1:]}"]
    return "\n".join(lines)


def sweeps_plain(spec: Spec, results: Sequence[SweepResult]) -> dict[str, Any]:
    """All rows in grid order with the best of each sweep."""
    return {
        "status": "ok" if any(row.evaluation.ok for result in results for row in result.rows) else "failed",
        "reasons": sorted({reason for result in results for row in result.rows for reason in row.evaluation.reasons}),
        "sweeps": [
            {
                "name": result.sweep.name,
                "published_optimum": result.sweep.reference,
                "best": _best_values(spec, result),
                "rows": [
                    {
                        "values": dict(row.values),
                        "status": row.evaluation.status,
                        "reasons": list(row.evaluation.reasons),
                        "performance": to_plain(row.evaluation)["performance"],
                    }
                    for row in result.rows
                ],
            }
            for result in results
        ],
    }


def _best_values(spec: Spec, result: SweepResult) -> dict[str, float] | None:
    figure, maximise = _target(spec)
    best = result.best(figure, maximise)
    return dict(best.values) if best is not None else None


def _target(spec: Spec) -> tuple[str, bool]:
    from fluxbore.optimize.sweep import DEFAULT_OBJECTIVE

    objective = spec.study.objective or DEFAULT_OBJECTIVE
    return objective.figure, objective.maximise


def sweeps_text(spec: Spec, results: Sequence[SweepResult]) -> str:
    """Each sweep as a table of its axes and the objective's figure."""
    figure, maximise = _target(spec)
    lines = []
    for result in results:
        best = result.best(figure, maximise)
        lines.append(result.sweep.name)
        for row in result.rows:
            where = "  ".join(f"{show_key(spec, key, value):>10}" for key, value in row.values.items())
            found = show_figure(figure, getattr(row.evaluation.performance, figure))
            mark = "  <- best" if row is best else ""
            lines.append(f"  {where}  {found if row.evaluation.ok else ' '.join(row.evaluation.reasons)}{mark}")
        if result.sweep.reference is not None:
            published = show_key(spec, result.sweep.axes[0].key, result.sweep.reference)
            lines.append(f"  published optimum: {published} ({result.sweep.reference_source or 'no source given'})")
    return "\n".join(lines)


def candidate_plain(candidate: Candidate | None) -> dict[str, Any] | None:
    """A design of a study."""
    if candidate is None:
        return None
    evaluation = to_plain(candidate.evaluation)
    return {
        "values": dict(candidate.values),
        "objective": candidate.objective,
        "feasible": candidate.feasible,
        "fidelity": candidate.evaluation.fidelity,
        "status": candidate.evaluation.status,
        "reasons": evaluation["reasons"],
        "performance": evaluation["performance"],
        "constraints": [
            {
                "subject": check.limit.subject,
                "sense": check.limit.sense,
                "limit": check.limit.limit,
                "value": check.value,
                "margin": check.margin,
                "satisfied": check.satisfied,
                "active": check.active,
            }
            for check in candidate.checks
        ],
    }


def search_plain(result: SearchResult) -> dict[str, Any]:
    """The search: how it ended, start, best, chosen and history."""
    chosen = result.chosen
    return {
        "status": "no feasible design" if chosen is None else "ok" if result.ending == "done" else result.ending,
        "reasons": [] if chosen is not None and result.ending == "done" else [result.stop_reason],
        "stop_reason": result.stop_reason,
        "evaluations": len(result.history),
        "start": candidate_plain(result.start),
        "network_start": candidate_plain(result.network_start),
        "best": candidate_plain(result.best),
        "chosen": candidate_plain(chosen),
        "history": [
            {"values": dict(step.values), "objective": step.objective, "feasible": step.feasible}
            for step in result.history
        ],
    }


def _limit(check: Check) -> str:
    return f"{check.limit.subject} {check.limit.sense} {_show(check.limit.subject, check.limit.limit)}"


def _show(subject: str, value: float) -> str:
    """A figure or a key's value in its preferred unit; not rounded so far that a limit and its miss look alike."""
    if subject in FIGURES:
        return show_figure(subject, value, 6)
    key = next((key for kind in KINDS.values() if (key := kind.key(subject)) is not None), None)
    return key.show(value) if key is not None else f"{value:.6g}"


def _failures(result: SearchResult) -> list[str]:
    """The commonest reasons of failed designs with their counts; sentences that differ by numbers alone are one."""
    alike: dict[str, list[str]] = {}
    for step in result.history:
        if not step.evaluation.ok:
            reason = " ".join(step.evaluation.reasons)
            alike.setdefault(re.sub(r"[\d.]+", "#", reason), []).append(reason)
    common = sorted(alike.values(), key=len, reverse=True)[:3]
    return [f"{len(reasons)} of them failed, such as: {reasons[0]}" for reasons in common]


def search_text(spec: Spec, result: SearchResult) -> str:
    """Start and chosen design side by side, and why the search ended."""
    cost = f"{result.reused} of them from the journal" if result.replayed else f"in {result.seconds:.0f} s"
    lines = [result.stop_reason, f"Search: {len(result.history)} designs by finite elements, {cost}."]
    lines += _failures(result)
    chosen = result.chosen
    if chosen is None:
        return "\n".join([*lines, "No feasible design was found."])
    if dict(chosen.values) == dict(result.start.values):
        lines.append("Nothing better than the start was found.")
    lines.append("")
    for key, value in chosen.values.items():
        lines.append(f"{key}: {show_key(spec, key, result.start.values[key])} -> {show_key(spec, key, value)}")
    for name in ("force_constant", "motor_constant", "stray_field", "yoke_flux_density", "moving_mass", "total_mass"):
        before, after = (getattr(item.evaluation.performance, name) for item in (result.start, chosen))
        lines.append(f"{name}: {show_figure(name, before)} -> {show_figure(name, after)}")
    for check in chosen.checks:
        state = "active" if check.active else "held"
        found = _show(check.limit.subject, check.value) if check.value is not None else "no value"
        lines.append(f"{_limit(check)}: {found}, {state}")
    return "\n".join(lines)


def design_plain(result: DesignResult) -> dict[str, Any]:
    """The whole run."""
    reasons = list(result.reasons)
    if result.search is not None and result.search.chosen is None:
        reasons = search_plain(result.search)["reasons"]
    return {
        "status": result.status,
        "reasons": reasons,
        "performance": to_plain(result.evaluation)["performance"],
        "search": search_plain(result.search) if result.search is not None else None,
        "files": [str(path) for path in result.files],
        "warnings": [*result.evaluation.warnings, *result.warnings],
    }


def design_text(spec: Spec, result: DesignResult) -> str:
    """The search's result, or the design's figures, what is wrong with it, and where the files are."""
    text = search_text(spec, result.search) if result.search is not None else evaluation_text(result.evaluation)
    bad = [] if result.ok or result.search is not None else [f"{result.status}: {' '.join(result.reasons)}"]
    top = [str(path) for path in result.files if path.parent.name != "parts"]
    return "\n".join([text, *bad, "", *top])


class Bar:
    """Progress on stderr."""

    def __init__(self, quiet: bool) -> None:
        self._quiet = quiet
        self._terminal = sys.stderr.isatty()
        self._last = 0.0
        self._width = 0

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._width:
            sys.stderr.write("\n")
            self._width = 0

    def say(self, sentence: str) -> None:
        """A sentence of its own line, quiet or not."""
        if self._width:
            sys.stderr.write("\n")
            self._width = 0
        sys.stderr.write(f"fluxbore: {sentence}\n")

    def show(self, progress: Progress) -> None:
        """One more design is done."""
        now = time.monotonic()
        last = progress.done >= progress.total
        if self._quiet or not (last or self._terminal or now - self._last >= SECONDS_BETWEEN_LINES):
            return
        self._last = now
        line = _line(progress)
        if self._terminal:
            sys.stderr.write("\r" + line.ljust(self._width) + ("\n" if last else ""))
            self._width = 0 if last else len(line)
        else:
            sys.stderr.write(line + "\n")
        sys.stderr.flush()


def _line(progress: Progress) -> str:
    parts = [f"{progress.label} {progress.done}/{progress.total}"]
    if progress.reused:
        parts.append(f"{progress.reused} from the journal")
    if progress.failed:
        parts.append(f"{progress.failed} failed")
    if progress.seconds_left is not None and progress.done < progress.total:
        parts.append(f"{progress.seconds_left:.0f} s left")
    if progress.best is not None and progress.figure is not None:
        parts.append(f"best {show_figure(progress.figure, progress.best)}{_at(progress.best_values)}")
    return ", ".join(parts)


def _at(values: Mapping[str, float] | None) -> str:
    if not values:
        return ""
    return " at " + ", ".join(f"{key.rpartition('.')[2]} {_show(key, value)}" for key, value in values.items())
