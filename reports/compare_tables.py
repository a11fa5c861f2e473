"""What else differs between designs: requirements, the keys of their specifications, parts, and what was assumed."""

from __future__ import annotations

from collections.abc import Iterable

from fluxbore.design.keys import Key, Value
from fluxbore.design.performance import FIGURES
from fluxbore.optimize.outcome import Check
from fluxbore.reports.compare_content import ComparedDesign, Comparison
from fluxbore.reports.compare_figures import SideCell, SideTable, close
from fluxbore.reports.study_tables import verdict
from fluxbore.reports.wording import (
    DASH,
    capital,
    change,
    figure_scale,
    key_label,
    key_scale,
    limit_text,
    subject_label,
    subject_scale,
)

ROUNDING = 1e-9
"""Relative difference of two values of a key that comes from writing and reading numbers alone."""


def requirements(comparison: Comparison) -> SideTable | None:
    """Every limit that any design's study sets, held against the designs whose studies set it."""
    rows: dict[tuple[str, str], dict[str, Check]] = {}
    labels: dict[tuple[str, str], str] = {}
    for design in comparison.designs:
        for check in design.checks:
            at = check.limit.subject, check.limit.sense
            rows.setdefault(at, {})[design.letter] = check
            labels.setdefault(at, capital(subject_label(design.spec, check.limit.subject)))
    if not rows:
        return None
    lines = tuple(
        (
            SideCell(labels[at]),
            *(
                _held(design, checks[design.letter]) if design.letter in checks else _absent(design, at[0])
                for design in comparison.designs
            ),
        )
        for at, checks in rows.items()
    )
    return SideTable("Requirements of each design’s own study", _head("Requirement", comparison), lines, words=True)


def _held(design: ComparedDesign, check: Check) -> SideCell:
    shown = verdict(design.spec, check)
    scale = subject_scale(design.spec, check.limit.subject, [check.limit.limit, check.value])
    value = f"{scale.quantity(check.value)}, " if check.value is not None else ""
    return SideCell(shown.text, f"{value}{limit_text(design.spec, check.limit)}", shown.tone)


def _absent(design: ComparedDesign, subject: str) -> SideCell:
    """A dash where the design has no such figure or key."""
    if not design.evaluation.ok:
        return SideCell("no figures", tone="muted")
    has = design.figure(subject) is not None if subject in FIGURES else design.spec.kind.key(subject) is not None
    return SideCell("not asked" if has else DASH, tone="muted")


def keys(comparison: Comparison) -> SideTable | None:
    """The keys whose values differ: those that any specification gives, then those that only follow from others.

    Of unlike kinds only the keys that all of them have are compared. None where nothing differs.
    """
    given: list[tuple[SideCell, ...]] = []
    following: list[tuple[SideCell, ...]] = []
    for key in _shared_keys(comparison):
        values = [design.spec.values.get(key.name) for design in comparison.designs]
        if all(_equal(values[0], value) for value in values[1:]):
            continue
        own = any(key.name in design.spec.given for design in comparison.designs)
        (given if own else following).append(_key_row(comparison, key, values))
    if not given and not following:
        return None
    titles = ((0, "Given"), (len(given), "Following from what is given"))
    sections = tuple(title for title, rows in zip(titles, (given, following), strict=True) if rows)
    head = _head("Key", comparison)
    return SideTable("Values that differ", head, (*given, *following), sections if following else (), words=False)


def untold_keys(comparison: Comparison) -> str:
    """What the comparison of keys leaves out, as a sentence; empty where it leaves out nothing."""
    if comparison.alike:
        return ""
    shared = {key.name for key in _shared_keys(comparison)}
    own = ", ".join(
        f"{design.letter} {sum(name not in shared for name in design.spec.values)}" for design in comparison.designs
    )
    return f"Keys that not every kind has are left out: {own}. They stand in the designs’ own specifications."


def _shared_keys(comparison: Comparison) -> Iterable[Key]:
    """Keys of the designs and their solution that all kinds have; titles of drawings are no matter of the design."""
    others = [{key.name for key in design.spec.kind.keys} for design in comparison.designs]
    skipped = ("actuator.name", "actuator.kind")
    return [
        key
        for key in comparison.first.spec.kind.keys
        if all(key.name in names for names in others)
        and key.name not in skipped
        and not key.name.startswith("drawing.")
        and any(key.name in design.spec.values for design in comparison.designs)
    ]


def _equal(first: Value | None, second: Value | None) -> bool:
    if isinstance(first, (int, float)) and isinstance(second, (int, float)):
        return close(float(first), float(second), ROUNDING)
    return first == second


def _key_row(comparison: Comparison, key: Key, values: list[Value | None]) -> tuple[SideCell, ...]:
    numbers = [float(value) if isinstance(value, (int, float)) else None for value in values]
    scale = key_scale(comparison.first.spec, key.name, numbers)
    cells = [SideCell(capital(key_label(comparison.first.spec, key.name)), key.name)]
    for i, (value, number) in enumerate(zip(values, numbers, strict=True)):
        equal = i > 0 and _equal(values[0], value)
        share = change(numbers[0], number) if i > 0 and key.dimension != "temperature" else ""
        text = scale.quantity(number) if number is not None else str(value) if value is not None else "not given"
        cells.append(SideCell(text, "=" if equal else share, "muted" if value is None else ""))
    return tuple(cells)


def assumed(comparison: Comparison) -> SideTable | None:
    """What one specification assumes or calibrates and another gives otherwise: status or value differ."""
    shared = {key.name for key in _shared_keys(comparison)}
    names = dict.fromkeys(note.key for design in comparison.designs for note in design.spec.notes if note.key in shared)
    rows = []
    for name in names:
        cells = [_source(design, name) for design in comparison.designs]
        if len({(cell.text, cell.note) for cell in cells}) == 1:
            continue
        rows.append((SideCell(capital(key_label(comparison.first.spec, name)), name), *cells))
    if not rows:
        return None
    return SideTable(
        "Assumed or calibrated, where the designs differ", _head("Key", comparison), tuple(rows), words=True
    )


def _source(design: ComparedDesign, name: str) -> SideCell:
    """How a design comes to a key's value, and the value."""
    spec = design.spec
    value = spec.values.get(name)
    if value is None:
        return SideCell("not given", tone="muted")
    number = float(value) if isinstance(value, (int, float)) else None
    shown = key_scale(spec, name, [number]).quantity(number) if number is not None else str(value)
    note = next((note for note in spec.notes if note.key == name), None)
    if note is not None:
        return SideCell(note.status, shown)
    return SideCell("given" if name in spec.given else "follows", shown)


def parts(comparison: Comparison) -> SideTable | None:
    """Masses by the parts' roles, with the number of pieces; the mover's, the stator's and the whole beneath."""
    rows: dict[tuple[str, str], dict[str, tuple[int, float]]] = {}
    for design in comparison.designs:
        for item in design.items:
            there = rows.setdefault((item.part.group, item.part.role), {})
            count, mass = there.get(design.letter, (0, 0.0))
            there[design.letter] = count + item.count, mass + item.mass * item.count
        if design.assembly is not None and design.assembly.carried_mass > 0:
            rows.setdefault(("mover", "carried along, not drawn"), {})[design.letter] = 1, design.assembly.carried_mass
    if not rows:
        return None
    order = sorted(rows, key=lambda at: at[0])
    groups = list(dict.fromkeys(group for group, _ in order))
    lines = tuple(_part_row(comparison, role, rows[group, role]) for group, role in order)
    sections = tuple((next(i for i, at in enumerate(order) if at[0] == group), capital(group)) for group in groups)
    foot = tuple(_sum_row(comparison, rows, group) for group in (*groups, ""))
    return SideTable("Masses of parts", _head("Parts", comparison), lines, sections, foot, differs=False)


def _part_row(comparison: Comparison, role: str, found: dict[str, tuple[int, float]]) -> tuple[SideCell, ...]:
    cells = [SideCell(capital(role))]
    for design in comparison.designs:
        count, mass = found.get(design.letter, (0, 0.0))
        shown = _mass(mass) if mass else "envelope only" if count else DASH
        cells.append(SideCell(shown, f"{count} ×" if count > 1 else "", "" if mass else "muted"))
    return tuple(cells)


def _sum_row(
    comparison: Comparison, rows: dict[tuple[str, str], dict[str, tuple[int, float]]], group: str
) -> tuple[SideCell, ...]:
    cells = [SideCell(capital(group) if group else "All parts")]
    for design in comparison.designs:
        members = [found for (of, _), found in rows.items() if not group or of == group]
        mass = sum(found[design.letter][1] for found in members if design.letter in found)
        cells.append(SideCell(_mass(mass) if mass else DASH))
    return tuple(cells)


def _mass(mass: float) -> str:
    return figure_scale("total_mass", [mass]).quantity(mass)


def _head(first: str, comparison: Comparison) -> tuple[str, ...]:
    return (first, *(design.letter for design in comparison.designs))
