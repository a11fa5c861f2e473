"""Damaged FEMM files solved: a number gives a file and a question, and the answer is judged.

Whatever stands in a file, the program answers with figures that are numbers, or with one sentence.
"""

from __future__ import annotations

import json
import re
import sys
import tempfile
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

import femm_mutations
import numpy as np

from fluxbore.design.errors import FluxboreError
from fluxbore.fem.femm_model import FemmModel
from fluxbore.fem.femm_reader import parse
from fluxbore.fem.femm_writer import write_text
from fluxbore.solution_messages import solution_plain
from fluxbore.solving import solve

TOP = Path(__file__).resolve().parents[1]

COARSE = 0.05
"""Accuracy that most files are solved to: thousands of them are to take minutes."""

FINE = 12
"""One file of so many is solved as a user would, to the default accuracy with the sizes of the model."""

LONGEST = 500
"""Characters of a sentence."""

READABLE = (
    femm_mutations.flip_sign,
    femm_mutations.scale_number,
    femm_mutations.jiggle_number,
    femm_mutations.swap_coordinates,
    femm_mutations.merge_nodes,
    femm_mutations.move_node,
    femm_mutations.move_label,
    femm_mutations.rewire,
    femm_mutations.drop_row,
    femm_mutations.change_problem,
)
"""Damages that most readers would not notice: half of the files have no others, so that many get as far as a field."""

VALUE = re.compile(
    r"(<(?:A_0|A_1|A_2|Phi|c0|c1|A_re|I_re|Mu_x|Mu_y|H_c|J_re|Sigma|LamType|LamFill|TotalAmps_re|CircuitType|BdryType)>"
    r"\s*=\s*|\[(?:Depth|extZo|extRo|extRi)\]\s*=\s*)(\S+)",
    re.IGNORECASE,
)
VALUES = (
    "0",
    "1",
    "2",
    "3",
    "4",
    "5",
    "-1",
    "1e-12",
    "1e-6",
    "0.5",
    "1e3",
    "1e6",
    "1e9",
    "1e12",
    "1e20",
    "1e30",
    "1e-30",
)

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Mutant:
    """name : of the model that was damaged."""

    name: str
    text: str
    groups: tuple[int, ...]
    points: tuple[Point, ...]
    accuracy: float | None
    open_boundary: bool


@lru_cache(maxsize=1)
def models() -> tuple[tuple[str, FemmModel], ...]:
    """Models of the validation gallery, of every kind of region, condition and source that it has."""
    folder = str(TOP / "docs" / "validation")
    sys.path.insert(0, folder)
    try:
        from cases import air_coils, conductors, iron, magnets, periodic, slabs  # type: ignore[import-not-found]
    finally:
        sys.path.remove(folder)
    cases = (
        air_coils.air_coil_in_a_box,
        air_coils.kelvin_exterior,
        magnets.cylinder,
        magnets.magnet_pair,
        magnets.transverse_cylinder,
        magnets.halbach_ring,
        iron.saturated_solenoid,
        iron.saturated_ring,
        iron.cylinder_in_a_field,
        iron.sphere_in_a_field,
        conductors.two_wires,
        conductors.point_current,
        conductors.coaxial_cable,
        conductors.parallel_strips,
        periodic.halbach_array,
        periodic.slotless_load,
        slabs.laminated_strips,
        slabs.mixed_condition,
    )
    return tuple((case.__name__, case().model) for case in cases)


@lru_cache(maxsize=64)
def _text(model: FemmModel, coarse: bool) -> str:
    if coarse:
        labels = tuple(replace(label, size=None) for label in model.labels)
        arcs = tuple(replace(arc, max_segment=max(arc.max_segment, 15.0)) for arc in model.arcs)
        segments = tuple(replace(segment, size=None) for segment in model.segments)
        model = replace(model, labels=labels, arcs=arcs, segments=segments)
    return write_text(model)


def mutant(seed: int, number: int, others: tuple[tuple[str, FemmModel], ...] = ()) -> Mutant:
    """The same for the same numbers. others : names and models to damage beside the gallery's."""
    rng = np.random.default_rng([seed, number])
    fine = rng.integers(FINE) == 0
    choice = (*models(), *others)
    name, model = choice[int(rng.integers(len(choice)))]
    text = damaged(_text(model, not fine), rng)
    groups, points = _asked(text, rng)
    return Mutant(name, text, groups, points, None if fine else COARSE, bool(rng.random() < 0.05))


def other_value(text: str, rng: np.random.Generator) -> str:
    """One of a property's values to another: anything that a wrong unit or a wrong key would make of it."""
    found = list(VALUE.finditer(text))
    if not found:
        return text
    match = found[int(rng.integers(len(found)))]
    value = VALUES[int(rng.integers(len(VALUES)))]
    if rng.random() < 0.5:
        try:
            value = repr(float(match[2]) * 10.0 ** rng.uniform(-12, 12))
        except ValueError:
            return text
    return text[: match.start(2)] + value + text[match.end(2) :]


def other_cell(text: str, rng: np.random.Generator) -> str:
    """A cell of a row to another small number: sizes, angles, references, groups, turns, flags."""
    lines = text.split("\n")
    sections = ("NumPoints", "NumSegments", "NumArcSegments", "NumBlockLabels", "NumBlockLabels")
    rows = femm_mutations.rows_of(lines, sections[int(rng.integers(len(sections)))])
    if len(rows) == 0:
        return text
    at = rows[int(rng.integers(len(rows)))]
    cells = lines[at].split()
    last = cells[-1].startswith('"')
    column = int(rng.integers(2, max(3, len(cells) - last)))
    values = ("0", "1", "2", "3", "-1", "0.01", "0.5", "5", "30", "90", "180", "1000", "1e6", '"theta"', '"1/(r-1)"')
    cells[min(column, len(cells) - 1)] = values[int(rng.integers(len(values) if column == 5 else len(values) - 2))]
    lines[at] = "\t".join(cells)
    return "\n".join(lines)


def damaged(text: str, rng: np.random.Generator) -> str:
    """Half of the files by any damage, half by such as leave a file that reads."""
    if rng.random() < 0.5:
        return femm_mutations.mutate(text, rng)
    readable = (*READABLE, other_value, other_value, other_value, other_cell, other_cell)
    for _ in range(1 + int(rng.integers(3))):
        text = readable[int(rng.integers(len(readable)))](text, rng)
    return text


def _asked(text: str, rng: np.random.Generator) -> tuple[tuple[int, ...], tuple[Point, ...]]:
    """A group in every third file, and a point in every third: at a label, or anywhere between the nodes."""
    try:
        model = parse(text)
    except FluxboreError:
        return (), ()
    groups: tuple[int, ...] = ()
    points: tuple[Point, ...] = ()
    if rng.random() < 1 / 3:
        groups = (model.labels[int(rng.integers(len(model.labels)))].group,)
    if rng.random() < 1 / 3:
        label = model.labels[int(rng.integers(len(model.labels)))]
        a, b = (model.nodes[int(k)] for k in rng.integers(len(model.nodes), size=2))
        points = (((label.x, label.y),) if rng.random() < 0.5 else ()) + (((a.x + b.x) / 2, (a.y + b.y) / 2),)
    return groups, points


@dataclass(frozen=True, slots=True)
class Outcome:
    """kind : "answer", "no convergence" or the error's class. sentence : why there is no answer, or how it ended."""

    kind: str
    sentence: str
    unknowns: int = 0


def outcome(item: Mutant) -> Outcome:
    """Of a whole solve as the command line does it. Raises whatever the program raises that is no sentence."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.fem"
        path.write_bytes(item.text.encode("utf-8", "surrogateescape"))
        try:
            solution = solve(
                path,
                groups=item.groups,
                points=item.points,
                accuracy=item.accuracy,
                open_boundary=item.open_boundary,
            )
            answer = solution_plain(solution, item.groups, item.points)
        except FluxboreError as error:
            sentence = str(error)
            if not sentence or not sentence.isprintable() or len(sentence) > LONGEST:
                raise AssertionError(f"this is no sentence: {sentence[: 2 * LONGEST]!r}") from error
            return Outcome(type(error).__name__, sentence)
    json.dumps(answer, allow_nan=False)
    status, unknowns = answer["convergence"]["status"], answer["mesh"]["unknowns"]
    if status != "converged":
        assert answer["warnings"]
        return Outcome("no convergence", str(answer["warnings"][0]), unknowns)
    return Outcome("answer", "as accurate as asked" if answer["accuracy"]["reached"] else "less accurate", unknowns)


def gist(outcome: Outcome) -> str:
    """The sentence without what is particular to a file, to count its kind."""
    text = re.sub(r"^[^:]{0,40}\.fem(, line \d+)?: ", "", outcome.sentence)
    text = re.sub(r'"[^"]*"|\[[^\]]*\]|<[^>]*>', "…", text)
    text = re.sub(r"[-+]?\d[\d.]*(e[-+]?\d+)?|\bnan\b", "#", text)
    return re.sub(r"\s+", " ", text).strip()[:110]
