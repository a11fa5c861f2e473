"""The sentences of a report: what was asked, what was reached, and what follows from the figures."""

from __future__ import annotations

from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.design.study import Constraint, Variable
from fluxbore.optimize.outcome import Candidate
from fluxbore.reports.content import ReportContent
from fluxbore.reports.tables import Cell
from fluxbore.reports.wording import (
    change,
    figure_label,
    figure_scale,
    key_label,
    key_range,
    key_scale,
    listing,
    room_text,
    subject_label,
    subject_scale,
)

PRICE = {
    "force_constant": -1,
    "motor_constant": -1,
    "winding_resistance": 1,
    "moving_mass": 1,
    "stray_field": 1,
    "cogging_force": 1,
    "pneumatic_force_advance": -1,
    "pneumatic_force_retract": -1,
    "outer_diameter": 1,
    "length": 1,
    "stall_force": -1,
    "slip_margin": -1,
    "sudden_load_limit": -1,
    "motor_torque": 1,
    "rotor_inertia": 1,
    "magnet_mass": 1,
    "force_frequency_limit": -1,
    "force_at_rated_pressure": -1,
    "specific_force_distal": -1,
    "force_efficiency": -1,
    "tracking_error": 1,
    "distal_mass": 1,
}
"""Figures that can be the price of a gain, with the sign of the change that makes them worse."""

NOTABLE_PRICE = 5e-4
"""Relative change from which a figure that got worse is told."""


def asked(spec: Spec) -> tuple[str, ...]:
    """The requirement in words, one sentence each; a study without an objective asks for less."""
    study, sentences = spec.study, []
    if study.objective is not None:
        verb = "Maximise" if study.objective.maximise else "Minimise"
        goal = f"{verb} the {figure_label(study.objective.figure)}"
        by = listing(_range(spec, variable) for variable in study.variables)
        sentences.append(f"{goal} by moving {by}." if by else f"{goal}.")
    if study.constraints:
        sentences.append(f"Keep {listing(_limit(spec, item) for item in study.constraints)}.")
    if study.hold:
        sentences.append(f"Hold {listing(f'the {key_label(spec, key)}' for key in study.hold)}.")
    if study.sweeps:
        names = listing(" and ".join(key_label(spec, axis.key) for axis in sweep.axes) for sweep in study.sweeps)
        sentences.append(f"Sweep {names}.")
    return tuple(sentences) or ("Evaluate the design of the specification; no study was asked for.",)


def reached(content: ReportContent) -> Cell:
    """The outcome in one sentence, with its tone."""
    design = content.design
    if design is None:
        return Cell(f"No evaluation by {content.words.route} is part of this report.", "muted")
    if not design.ok:
        which = "chosen" if content.is_study else "specified"
        return Cell(f"The {which} design has no figures ({design.status}): {' '.join(design.reasons)}", "bad")
    checks = content.design_checks
    broken = [check for check in checks if not check.satisfied]
    if content.search is not None and content.search.chosen is None:
        return Cell("The search found no feasible design; the figures are the start’s.", "bad")
    if broken:
        names = listing(subject_label(content.spec, check.limit.subject) for check in broken)
        verb = "is" if len(broken) == 1 else "are"
        return Cell(f"{len(broken)} of {len(checks)} requirements {verb} not met: {names}.", "bad")
    if not checks:
        return Cell("The design was evaluated; no requirement was set.", "warn" if design.warnings else "muted")
    open_ = sum(check.margin is None for check in checks)
    if open_:
        return Cell(
            f"{len(checks) - open_} of {len(checks)} requirements are met; {open_} could not be checked.", "muted"
        )
    met = {1: "The requirement is met", 2: "Both requirements are met"}
    text = met.get(len(checks), f"All {len(checks)} requirements are met")
    if design.warnings:
        return Cell(f"{text}, but with {'a warning' if len(design.warnings) == 1 else 'warnings'}.", "warn")
    return Cell(f"{text}.", "good")


def gain(content: ReportContent) -> tuple[str, ...]:
    """What the joint optimum gains over the start and over one variable at a time."""
    search, objective = content.search, content.spec.study.objective
    if search is None or objective is None or search.chosen is None:
        return ()
    label = figure_label(objective.figure)
    best, start, single = search.chosen, search.start, content.one_at_a_time
    scale = figure_scale(objective.figure, [best.objective, start.objective])
    if dict(best.values) == dict(start.values):
        sentences = [
            "Nothing better than the start was found.",
            f"The start is the chosen design, with a {label} of {scale.quantity(best.objective)}.",
        ]
    else:
        more = change(start.objective, best.objective)
        against = f"{more} against the start’s {scale.quantity(start.objective)}"
        broken = _broken(content.spec, start)
        against += f" (which breaks {broken})" if broken else ""
        paid = price(start.evaluation.performance, best.evaluation.performance, objective.figure)
        sentences = [
            f"The chosen design has a {label} of {scale.quantity(best.objective)}"
            f"{f', {against}' if more else ''}{f'; the price: {paid}' if paid else ''}."
        ]
    if search.best is not None and search.best is not search.chosen and search.best.objective != best.objective:
        sentences.append(
            f"Before it was rounded to the workshop’s steps the joint optimum reached "
            f"{scale.quantity(search.best.objective)}, {change(start.objective, search.best.objective)}."
        )
    if single is None:
        return tuple(sentences)
    source = next((sweep.sweep.reference_source for sweep in content.sweeps if sweep.sweep.reference_source), "")
    values = listing(
        f"{key_label(content.spec, key)} {key_scale(content.spec, key, [value]).quantity(value)}"
        for key, value in single.values.items()
    )
    quoted = f" as published (“no interaction effects were considered”; {source})" if source else ""
    found = f"One variable at a time{quoted} gives {values}"
    if single.objective is None:
        sentences.append(f"{found}, a design without figures: {' '.join(single.evaluation.reasons)}")
    elif single.feasible:
        more = change(single.objective, best.objective)
        sentences.append(f"{found} and {scale.quantity(single.objective)}; the chosen design is {more} against it.")
    else:
        sentences.append(
            f"{found} and {scale.quantity(single.objective)}, but it breaks {_broken(content.spec, single)}, "
            "so it is no alternative."
        )
    return tuple(sentences)


def price(before: Performance, after: Performance, objective: str) -> str:
    """The key figures beside the objective that got worse, each with its change."""
    worse = []
    for name, sign in PRICE.items():
        old, new = getattr(before, name), getattr(after, name)
        if name != objective and old and new is not None and sign * (new - old) > NOTABLE_PRICE * abs(old):
            worse.append(f"{figure_label(name)} {change(old, new)}")
    return listing(worse)


def _broken(spec: Spec, item: Candidate) -> str:
    """``the limit on the stray field``; empty where all limits hold."""
    names = dict.fromkeys(f"the {subject_label(spec, c.limit.subject)}" for c in item.checks if not c.satisfied)
    return f"the {'limit' if len(names) == 1 else 'limits'} on {listing(names)}" if names else ""


def active(content: ReportContent) -> str:
    """Which limits hold the chosen design back."""
    if not content.is_study or not content.design_checks:
        return ""
    names = [
        f"the {subject_label(content.spec, check.limit.subject)}" for check in content.design_checks if check.active
    ]
    found = [f"At its limit in the chosen design: {listing(names)}."] if names else []
    found += [text for text in (_left_by_rounding(content), _nearest_step(content)) if text]
    return " ".join(found) or "No requirement is at its limit in the chosen design."


def _left_by_rounding(content: ReportContent) -> str:
    """What the steps of the workshop left unused of the limits that the optimum had used up."""
    search = content.search
    if search is None or search.best is None or search.chosen is not search.rounded:
        return ""
    used = {(check.limit.subject, check.limit.sense) for check in search.best.checks if check.active}
    left, free = [], []
    for check in content.design_checks:
        if (check.limit.subject, check.limit.sense) not in used or check.active or check.margin is None:
            continue
        label = f"the {subject_label(content.spec, check.limit.subject)}"
        if check.unloaded:
            free.append(label)
        else:
            share = "of" if check.limit.scale is None else "to"
            left.append(f"{room_text(content.spec, check.limit, check.margin)} {share} the limit on {label}")
    found = [f"Rounding to the workshop’s steps left {listing(left)} unused."] if left else []
    found += [f"Rounding left {listing(free)} without a load."] if free else []
    return " ".join(found)


def _nearest_step(content: ReportContent) -> str:
    """Why the chosen design is not the step nearest to the optimum, where the search has seen that step."""
    search, spec = content.search, content.spec
    if search is None or search.best is None or search.rounded is None or search.chosen is not search.rounded:
        return ""
    steps = {variable.key: variable.resolution for variable in spec.study.variables}
    nearest = {}
    for key, value in search.best.values.items():
        step = steps.get(key)
        nearest[key] = round(value / step) * step if step else value

    def there(item: Candidate) -> bool:
        return all(abs(item.values[key] - value) <= 1e-6 * abs(value) + 1e-12 for key, value in nearest.items())

    seen = next((item for item in search.history if there(item)), None)
    if seen is None or there(search.rounded) or seen.feasible:
        return ""
    place = listing(
        f"{key_label(spec, key)} {key_scale(spec, key, [value]).quantity(value)}"
        for key, value in nearest.items()
        if steps.get(key)
    )
    broken = _broken(spec, seen)
    why = f"breaks {broken}" if seen.evaluation.ok and broken else "has no result"
    return (
        f"The step nearest to the optimum, {place}, {why}; the chosen design is the best feasible one of those tried."
    )


def _range(spec: Spec, variable: Variable) -> str:
    return f"the {key_label(spec, variable.key)} ({key_range(spec, variable.key, variable.lower, variable.upper)})"


def _limit(spec: Spec, item: Constraint) -> str:
    """``the stray field no higher than the start’s``."""
    label = f"the {subject_label(spec, item.subject)}"
    found = []
    for bound, word, same in ((item.lower, "at least", "no lower than"), (item.upper, "at most", "no higher than")):
        if bound is None:
            continue
        if item.relative_to_start:
            found.append(f"{same} the start’s" if bound == 1 else f"{word} {bound:.4g} times the start’s")
        else:
            found.append(f"{word} {subject_scale(spec, item.subject, [bound]).quantity(bound)}")
    return f"{label} {' and '.join(found)}"


def title(content: ReportContent) -> str:
    """The name of the design, which the specification's author chose."""
    return str(content.spec.values.get("actuator.name", "Actuator"))
