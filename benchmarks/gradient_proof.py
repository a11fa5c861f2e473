"""Exact gradients against extrapolated differences, over 50 random designs, by every continuous key.

    python benchmarks/gradient_proof.py --out runs.jsonl          an hour; run again, it goes on where it stopped
    python benchmarks/gradient_proof.py --out runs.jsonl --write  and docs/validation/gradients.md

A key within one step of a bound (or on it, such as a clearance of zero) has no central difference; it is skipped, and
counted. Of the other derivatives those count whose difference is in doubt by less than a third of the limit;
where one of these disagrees by more than the limit, its key is differenced again by fields that begin from nothing
(`Designs.anew`), and that counts. What differences cannot tell (a cogging force of next to nothing, between rounding
and the knots of a magnetisation curve) is counted apart.
"""

from __future__ import annotations

import argparse
import json
import subprocess
from collections import Counter, defaultdict
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np
from gradient_designs import random_spec
from gradient_differences import TOLERANCE, Designs, Difference, scale, size

from fluxbore.design.errors import FluxboreError
from fluxbore.design.spec import Spec
from fluxbore.fem.threads import one_thread
from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.evaluation import Gradient
from fluxbore.optimize.hybrid_field import Field, solve_field
from fluxbore.optimize.partials import differentiable

TOP = Path(__file__).resolve().parents[1]
PAGE = TOP / "docs" / "validation" / "gradients.md"
COUNT, SEED = 50, 40_000
LIMIT = 1e-6
"""Of max(|derivative|, figure/size of the key)."""

RESOLVED = 0.3 * LIMIT
"""Largest doubt of a difference that may judge."""

WITHOUT = frozenset({"demagnetised_fraction", "peak_demagnetised_fraction"})
"""Figures that count points, and so have no derivative."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One derivative. error, doubt : relative to the scale; error is None where the gradient lacks it. anew : whether
    the difference is of fields begun from nothing."""

    key: str
    figure: str
    error: float | None
    doubt: float
    anew: bool = False

    @property
    def off(self) -> bool:
        """Whether a difference that can tell disagrees by more than the limit."""
        return self.error is not None and self.error > LIMIT and self.doubt <= RESOLVED


@dataclass(frozen=True, slots=True)
class Run:
    """One design. commit : of the code. highest : T, in iron. skipped : key -> why."""

    seed: int
    commit: str
    status: str
    positions: int
    peaks: int
    iron_cylinder: bool
    iron_shaft: bool
    highest: float
    skipped: dict[str, str]
    entries: list[Entry]


def run(seed: int, commit: str, share: float = 1.0) -> Run:
    """All derivatives of one design's figures by both routes. share : of the keys, drawn with the design's seed."""
    spec = random_spec(seed)
    spec = replace(spec, given={**spec.given, "solver.tolerance": TOLERANCE})
    keys = differentiable(spec, list(spec.given))
    keys = sorted(np.random.default_rng(seed).choice(keys, max(1, round(share * len(keys))), replace=False))
    found = evaluate(spec, "fem", keys)
    skipped: dict[str, str] = {}
    entries: list[Entry] = []
    with one_thread():
        field = solve_field(spec)
        if not found.ok or field.failure is not None:
            return _run((seed, commit), found.status, spec, field, skipped, entries)
        designs = Designs(spec, field)
        assert found.gradient is not None
        for key in keys:
            length = size(spec, key)
            if length == 0:
                skipped[key] = "The value is zero."
                continue
            try:
                differences = designs.derivatives(key)
            except FluxboreError as refusal:
                skipped[key] = str(refusal)
                continue
            own = [
                _entry(key, name, difference, found.gradient, designs)
                for name, difference in sorted(differences.items())
                if name not in WITHOUT
            ]
            if any(entry.off for entry in own):
                again = Designs(spec, field, anew=True)
                second = again.derivatives(key)
                own = [
                    _entry(key, entry.figure, second[entry.figure], found.gradient, again, anew=True)
                    if entry.off
                    else entry
                    for entry in own
                ]
            entries += own
    return _run((seed, commit), found.status, spec, field, skipped, entries)


def _entry(
    key: str, figure: str, difference: Difference, gradient: Gradient, designs: Designs, anew: bool = False
) -> Entry:
    adjoint = gradient.get(figure, {}).get(key)
    size_of_error = scale(difference.value, designs.own[figure], size(designs.spec, key)) or 1.0
    error = None if adjoint is None else abs(adjoint - difference.value) / size_of_error
    return Entry(key, figure, error, difference.doubt / size_of_error, anew)


def _run(
    which: tuple[int, str], status: str, spec: Spec, field: Field, skipped: dict[str, str], entries: list[Entry]
) -> Run:
    highest = max(item.highest_flux_density() for item in (*field.window, *field.peaks))
    iron = [spec.materials[spec.word(f"actuator.{part}.material")].curve is not None for part in ("cylinder", "shaft")]
    return Run(*which, status, len(field.window), len(field.peaks), iron[0], iron[1], highest, skipped, entries)


def faults(found: Sequence[Run]) -> list[str]:
    """Derivatives that are missing, or farther off than the limit from differences that can tell: one sentence each."""
    return [
        f"Seed {item.seed}: {entry.figure} by {entry.key} "
        + ("has no derivative." if entry.error is None else f"is off by {entry.error:.1e} (doubt {entry.doubt:.1e}).")
        for item in found
        for entry in item.entries
        if entry.error is None or entry.off
    ]


def lines(found: Sequence[Run]) -> list[str]:
    """Counts, the largest errors by figure and by key, and what is off, as Markdown."""
    status = ", ".join(f"{n} {word}" for word, n in Counter(item.status for item in found).most_common())
    skipped = Counter(key for item in found for key in item.skipped)
    entries = [entry for item in found for entry in item.entries]
    unresolved = [entry for entry in entries if entry.error is not None and entry.doubt > RESOLVED]
    errors = np.array([entry.error for entry in entries if entry.error is not None and entry.doubt <= RESOLVED])
    off = faults(found)
    highest = [item.highest for item in found]
    out = [
        f"{len(found)} designs ({status}); {len(entries)} derivatives. Highest flux density in iron "
        f"{min(highest):.2f} T to {max(highest):.2f} T, above 2 T in {sum(b > 2 for b in highest)} designs; "
        f"{sum(item.iron_cylinder for item in found)} cylinders and {sum(item.iron_shaft for item in found)} shafts of "
        f"soft iron; {sum(item.positions > 1 for item in found)} windows of several positions; "
        f"{sum(item.peaks > 0 for item in found)} designs with a peak current.",
        "",
        f"Skipped, within one step of a bound: {sum(skipped.values())} keys in "
        f"{sum(bool(item.skipped) for item in found)} designs"
        + (" (" + ", ".join(f"{key} {n}" for key, n in skipped.most_common()) + ")" if skipped else "")
        + ".",
        "",
        f"Off by more than {LIMIT:g} of the scale: {len(off)} of {errors.size}. Median error {np.median(errors):.1e}, "
        f"99 % {np.quantile(errors, 0.99):.1e}, largest {errors.max():.1e}. Differenced again from nothing, since the "
        f"first difference was off: {sum(entry.anew for entry in entries)}.",
        "",
        f"Not told by differences, which are in doubt by more than {RESOLVED:g} themselves: {len(unresolved)} ("
        + ", ".join(f"{name} {n}" for name, n in Counter(entry.figure for entry in unresolved).most_common())
        + f"), of which {sum((entry.error or 0.0) > LIMIT for entry in unresolved)} differ by more than {LIMIT:g} and "
        f"{sum((entry.error or 0.0) > 3 * entry.doubt + LIMIT for entry in unresolved)} by more than thrice the doubt.",
    ]
    for title, attribute in (("figure", "figure"), ("key", "key")):
        worst: dict[str, list[Entry]] = defaultdict(list)
        for entry in (entry for entry in entries if entry.doubt <= RESOLVED):
            worst[getattr(entry, attribute)].append(entry)
        out += ["", f"| {title} | derivatives | largest error | doubt there |", "|---|---:|---:|---:|"]
        for name, own in sorted(worst.items()):
            top = max(own, key=lambda entry: np.inf if entry.error is None else entry.error)
            shown = "none" if top.error is None else f"{top.error:.1e}"
            out.append(f"| {name} | {len(own)} | {shown} | {top.doubt:.1e} |")
    return out + ([""] + [f"- {sentence}" for sentence in off] if off else [])


def known(path: Path) -> list[Run]:
    """The runs of a file of results; none where there is no file."""
    if not path.exists():
        return []
    rows = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
    return [Run(**{**row, "entries": [Entry(**entry) for entry in row["entries"]]}) for row in rows]


def head() -> str:
    """The commit that is checked out."""
    command = ["git", "-C", str(TOP), "rev-parse", "--short", "HEAD"]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip() or "unknown"


def main() -> None:
    parser = argparse.ArgumentParser(description="Adjoint gradients against extrapolated differences.")
    parser.add_argument("--count", type=int, default=COUNT, help="how many designs")
    parser.add_argument("--seed", type=int, default=SEED, help="of the first; the others follow")
    parser.add_argument("--out", type=Path, required=True, help="results, one line for each design")
    parser.add_argument("--known", action="store_true", help="solve nothing: only what the results already hold")
    parser.add_argument("--write", action="store_true", help=f"write {PAGE.relative_to(TOP)}")
    arguments = parser.parse_args()
    commit = head()  # asked first: the run is of what is loaded now
    wanted = range(arguments.seed, arguments.seed + arguments.count)
    done = {item.seed for item in known(arguments.out)}
    for seed in wanted:
        if seed not in done and not arguments.known:
            text = json.dumps(asdict(run(seed, commit)))
            with arguments.out.open("a", encoding="utf-8") as file:
                file.write(text + "\n")
    found = sorted((item for item in known(arguments.out) if item.seed in wanted), key=lambda item: item.seed)
    text = "\n".join(lines(found))
    print(text)
    if arguments.write:
        commits = ", ".join(sorted({item.commit for item in found}))
        options = f"--count {arguments.count} --seed {arguments.seed} --out FILE --write"
        missing = len(wanted) - len(found)
        unfinished = f"Unfinished: {missing} of {len(wanted)} designs are not yet in this table.\n\n" if missing else ""
        PAGE.write_text(
            "# Gradients of random designs\n\n"
            f"Written by `python benchmarks/gradient_proof.py {options}` at commit {commits}.\n"
            "Adjoint derivatives against twice extrapolated central differences, Newton's residual at\n"
            f"{TOLERANCE:g}; errors relative to max(|derivative|, figure/key). Where a figure is a maximum, its\n"
            "p-norm is compared. How designs are drawn: `random_spec` in `benchmarks/gradient_designs.py`; how the\n"
            "differences are taken, and what their doubt is: `benchmarks/gradient_differences.py`. What gradients are\n"
            "made of: [gradients](../gradients.md).\n\n" + unfinished + text + "\n",
            encoding="utf-8",
        )


if __name__ == "__main__":
    main()
