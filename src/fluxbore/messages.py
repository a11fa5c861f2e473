"""What the command line says of results: plain values for ``--json``, tables for people."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from fluxbore.design.performance import grouped, show_figure, to_mapping
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import Evaluation, to_plain
from fluxbore.optimize.outcome import SweepResult
from fluxbore.value_text import route, show_key, show_subject, tolerance_size


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
            "pareto": asdict(spec.study.pareto) if spec.study.pareto is not None else None,
            "production": asdict(spec.study.production) if spec.study.production is not None else None,
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
        lower, upper = (int(bound) if item.integer else bound for bound in (item.lower, item.upper))
        lines.append(
            f"vary {item.key} from {show_key(spec, item.key, lower)} to {show_key(spec, item.key, upper)}{step}"
        )
    for limit in study.constraints:
        for word, value in (("at most", limit.upper), ("at least", limit.lower)):
            if value is not None:
                shown = f"{value:g} x the start's" if limit.relative_to_start else show_subject(limit.subject, value)
                lines.append(f"keep {limit.subject} {word} {shown}")
    lines += [f"hold {key}" for key in study.hold]
    lines += [f"sweep {sweep.name}: {sweep.size} designs" for sweep in study.sweeps]
    if study.pareto is not None:
        front, goal = study.pareto, study.pareto.against
        verb = "maximise" if goal.maximise else "minimise"
        lines.append(f"front against {verb} {goal.figure}: {front.points} points by {front.method}")
    if study.production is not None:
        for tolerance in study.production.tolerances:
            size = tolerance_size(tolerance, spec.kind.known(tolerance.key))
            lines.append(f"make {tolerance.key} within {size}, {tolerance.distribution}")
        if study.production.target_yield is not None:
            lines.append(f"reach a yield of {100 * study.production.target_yield:g} %")
    return ["", *lines] if lines else []


def evaluation_plain(spec: Spec, evaluation: Evaluation) -> dict[str, Any]:
    """One design's figures, with their derivatives where they were asked for."""
    return {"name": spec.word("actuator.name"), "specification": spec.fingerprint(), **to_plain(evaluation)}


def evaluation_text(spec: Spec, evaluation: Evaluation) -> str:
    """The figures under the headings of their groups, or why there are none."""
    if not evaluation.ok:
        return f"{evaluation.status}: " + " ".join(evaluation.reasons)
    known = {name: value for name, value in to_mapping(evaluation.performance).items() if value is not None}
    width = max((len(name) for name in known), default=0)
    lines = [f"By {route(spec, evaluation.fidelity)}:"]
    for group, names in grouped(known):
        lines += ["", group, *(f"  {name:<{width}}  {show_figure(name, known[name])}" for name in names)]
    lines += ["", *evaluation.warnings] if evaluation.warnings else []
    if evaluation.fidelity == "network" and "force_constant" in known:
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
