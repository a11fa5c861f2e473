"""What was tried, in sentences: the cost of a search, the designs that it lost, where a sweep has its best."""

from __future__ import annotations

import re
from collections import Counter

from fluxbore.design.spec import Spec
from fluxbore.optimize.outcome import SearchResult, SweepResult
from fluxbore.reports.kind_words import PLAIN, KindWords
from fluxbore.reports.wording import (
    capital,
    change,
    duration,
    figure_label,
    figure_scale,
    key_label,
    key_scale,
    listing,
)


def effort(search: SearchResult, words: KindWords = PLAIN) -> str:
    """``33 designs by finite elements in 41 s, by MMA.``; seconds say nothing of designs that an earlier run computed.

    A single design in the journal need not be an earlier run's: a sweep of this one may have passed through the start.
    """
    count, reused = len(search.history), search.reused
    designs = f"{count} {'design' if count == 1 else 'designs'} by {words.route}"
    ran = f" Algorithm: {search.algorithm}." if search.algorithm else ""
    called = search.network_calls
    were = "were" if words.network.endswith("s") else "was"
    ran += f" {capital(words.network)} {were} called {called} times besides." if called and words.network else ""
    if search.replayed:
        return f"{designs}, {'all' if reused >= count else reused} of them from an earlier run.{ran}"
    known = f", {reused} of them already in the journal" if reused else ""
    return f"{designs} in {duration(search.seconds)}{known}.{ran}"


def failures(search: SearchResult) -> str:
    """How many designs of the search have no result, and the commonest reasons; numbers in a reason do not matter."""
    lost = [item.evaluation for item in search.history if not item.evaluation.ok]
    if not lost:
        return ""
    texts = [" ".join(item.reasons) or item.status for item in lost]
    kinds = [re.sub(r"[-−]?\d[\d.,e+-]*", "#", text) for text in texts]
    example = dict(zip(reversed(kinds), reversed(texts), strict=True))
    common = Counter(kinds).most_common(3)
    listed = "; ".join(f"{example[kind].rstrip('.')} ({count} of them)" for kind, count in common)
    rest = len(lost) - sum(count for _, count in common)
    more = f"; other reasons ({rest} of them)" if rest else ""
    if len(lost) == 1:
        return f"1 of {len(search.history)} designs has no result: {texts[0].rstrip('.')}."
    return f"{len(lost)} of {len(search.history)} designs have no result: {listed}{more}."


def sweep_finding(spec: Spec, result: SweepResult, figure: str, maximise: bool) -> str:
    """Where the sweep's best lies, beside the published one."""
    best = result.best(figure, maximise)
    failed = sum(not row.evaluation.ok for row in result.rows)
    tail = f" {failed} of {len(result.rows)} designs {'has' if failed == 1 else 'have'} no result." if failed else ""
    if best is None:
        return f"No design of this sweep has a {figure_label(figure)}.{tail}"
    at = listing(
        f"{key_label(spec, key)} {key_scale(spec, key, [value]).quantity(value)}" for key, value in best.values.items()
    )
    value = getattr(best.evaluation.performance, figure)
    word = "largest" if maximise else "smallest"
    top = figure_scale(figure, [value]).quantity(value)
    text = f"The {word} {figure_label(figure)} of {len(result.rows)} designs, {top}, is at {at}."
    reference = result.sweep.reference
    if reference is not None and len(result.sweep.axes) == 1:
        axis = result.sweep.axes[0]
        shown = key_scale(spec, axis.key, [reference]).quantity(reference)
        source = f" ({result.sweep.reference_source})" if result.sweep.reference_source else ""
        found = best.values[axis.key]
        same = abs(found - reference) <= 1e-9 * max(abs(found), abs(reference))
        nearest = min(axis.values, key=lambda v: abs(v - reference))
        apart = abs(axis.values.index(found) - axis.values.index(nearest)) if found in axis.values else 0
        agreement = "the same" if same else f"{apart} grid steps from it" if apart != 1 else "one grid step from it"
        text += f" The published optimum{source} is {shown}: {agreement}."
    return text + _published(spec, result, figure) + tail


def _published(spec: Spec, result: SweepResult, figure: str) -> str:
    """The published points beside what was computed at the same places; between grid points nothing is claimed."""
    objective, found = spec.study.objective, []
    if objective is None or objective.figure != figure or len(result.sweep.axes) != 1:
        return ""
    key = result.sweep.axes[0].key
    for x, y in result.sweep.published:
        place, scale = key_scale(spec, key, [x]).quantity(x), figure_scale(figure, [y])
        row = next((row for row in result.rows if abs(row.values[key] - x) <= 1e-9 * max(abs(x), 1e-12)), None)
        value = getattr(row.evaluation.performance, figure) if row is not None else None
        beside = f", computed {scale.quantity(value)} ({change(y, value)})" if value is not None else ""
        found.append(f"{scale.quantity(y)} at {place}{beside}")
    return f" Published: {listing(found)}." if found else ""
