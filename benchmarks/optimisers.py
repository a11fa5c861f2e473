"""The iPEHLA's six dimensions (examples/ipehla-optimum.toml) by six searches: fields solved and seconds to 0.1 %.

    python benchmarks/optimisers.py                      the table
    python benchmarks/optimisers.py --write              and docs/validation/optimisers.md
    python benchmarks/optimisers.py --only SLSQP BOBYQA
    python benchmarks/optimisers.py --keep runs          runs are kept in this folder, and those in it not run again

Every search begins at the paper's prototype and has the same variables, without the workshop's steps, and the same
limits. Counted is what it took until a feasible design was within 0.1 % of the best feasible one that any search found:
designs by finite elements, the start among them, fields (one for each position of the mover in each design), Newton's
steps in them (a factorisation each), and seconds.

Each search runs in a fresh process with one BLAS thread. Seconds are the processor's, derivatives included, so that
programs beside it do not count; of the searches by gradients they are the median of three runs.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import statistics
import subprocess
import sys
from dataclasses import asdict, dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from time import process_time

from fluxbore.design.spec import Spec, load
from fluxbore.optimize.executor import SerialExecutor
from fluxbore.optimize.outcome import SearchResult
from fluxbore.optimize.progress import Progress
from fluxbore.optimize.search import run_search

TOP = Path(__file__).resolve().parents[1]
EXAMPLE = TOP / "examples" / "ipehla-optimum.toml"
PAGE = TOP / "docs" / "validation" / "optimisers.md"
CLOSE = 1e-3
"""Relative distance to the best at which a search has arrived."""
LOCAL = ("SLSQP", "MMA", "CCSAQ")
FREE = {"BOBYQA": 150, "COBYLA": 400, "ISRES": 400}
"""The searches without derivatives and their budgets of designs; those by gradients have the example's own."""
ALL = (*LOCAL, *FREE)
REPEATS = 3


@dataclass(frozen=True, slots=True)
class Step:
    """One design of a search. objective : of a feasible design, else None. seconds : the processor's, from the search's
    begin until the design was known."""

    objective: float | None
    fields: int
    newton: int
    seconds: float


@dataclass(frozen=True, slots=True)
class Run:
    """One search; residual : of Karush, Kuhn and Tucker, where there are derivatives."""

    algorithm: str
    budget: int
    steps: tuple[Step, ...]
    residual: float | None
    reason: str
    maximise: bool

    @property
    def best(self) -> float | None:
        """The best feasible objective."""
        found = [step.objective for step in self.steps if step.objective is not None]
        return (max if self.maximise else min)(found, default=None)

    def arrival(self, best: float) -> int | None:
        """Designs until a feasible one was within `CLOSE` of ``best``; None where there was none."""
        sign = 1.0 if self.maximise else -1.0
        for count, step in enumerate(self.steps, 1):
            if step.objective is not None and sign * (best - step.objective) <= CLOSE * abs(best):
                return count
        return None


def study(algorithm: str) -> Spec:
    """The example with this search, without the workshop's steps."""
    spec = load(EXAMPLE)
    budget = FREE.get(algorithm, spec.study.search.max_evaluations)
    search = replace(spec.study.search, algorithm=algorithm, max_evaluations=budget)
    variables = tuple(replace(variable, resolution=None) for variable in spec.study.variables)
    return replace(spec, study=replace(spec.study, search=search, variables=variables))


def run(algorithm: str) -> Run:
    """One search in this process."""
    spec, begin, seconds = study(algorithm), process_time(), list[float]()

    def note(state: Progress) -> None:
        seconds.extend([process_time() - begin] * (state.done - len(seconds)))

    result = run_search(spec, None, SerialExecutor(), note)
    if len(seconds) != len(result.history):
        sys.exit(f"{len(result.history)} designs, of which {len(seconds)} were reported.")
    return Run(
        result.algorithm,
        spec.study.search.max_evaluations,
        steps(result, seconds),
        None if result.optimality is None else result.optimality.residual,
        result.stop_reason,
        spec.study.objective is not None and spec.study.objective.maximise,
    )


def steps(result: SearchResult, seconds: list[float]) -> tuple[Step, ...]:
    """The designs of a search, in order."""
    return tuple(
        Step(
            made.objective if made.feasible else None,
            len(made.evaluation.positions),
            sum(position.iterations for position in made.evaluation.positions),
            at,
        )
        for made, at in zip(result.history, seconds, strict=True)
    )


def measured(algorithm: str, keep: Path | None) -> list[Run]:
    """The same search in fresh processes, as often as its seconds need it.

    keep : a folder for the runs; those that are in it already are read.
    """
    runs = []
    for count in range(REPEATS if algorithm in LOCAL else 1):
        path = None if keep is None else keep / f"{algorithm}-{count + 1}.json"
        text = path.read_text(encoding="utf-8") if path is not None and path.exists() else fresh(algorithm)
        if path is not None:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        made = json.loads(text)
        runs.append(Run(**{**made, "steps": tuple(Step(**step) for step in made["steps"])}))
    return runs


def fresh(algorithm: str) -> str:
    """A run in a process of its own, as JSON."""
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    command = [sys.executable, str(Path(__file__).resolve()), "--one", algorithm]
    answer = subprocess.run(command, stdout=subprocess.PIPE, text=True, env=environment, check=False)
    if answer.returncode:
        sys.exit(f"The run of {algorithm} failed.")
    return answer.stdout


def table(searches: list[list[Run]]) -> list[str]:
    """A row for each search, in Markdown."""
    first = [runs[0] for runs in searches]
    found = [item.best for item in first if item.best is not None]
    if not found:
        sys.exit("No search found a feasible design.")
    best = (max if first[0].maximise else min)(found)
    rows = [
        "| search | designs to 0.1 % | fields | Newton steps | seconds | designs in all | best feasible (N/A) "
        "| short of the best | KKT residual |",
        "|---|---:|---:|---:|---:|---:|---:|---:|---:|",
    ]
    for runs in searches:
        item = runs[0]
        count, every = item.arrival(best), len(item.steps)
        near = [f"not within {every}", "–", "–", "–"]
        if count is not None:
            taken = item.steps[:count]
            seconds = statistics.median(each.steps[count - 1].seconds for each in runs)
            near = [
                str(count),
                str(sum(step.fields for step in taken)),
                str(sum(step.newton for step in taken)),
                f"{seconds:.1f}",
            ]
        value = item.best
        rest = ["–", "–"] if value is None else [f"{value:.4f}", f"{100 * abs(best - value) / abs(best):.3f} %"]
        left = "–" if item.residual is None else f"{item.residual:.1e}"
        rows.append("| " + " | ".join([item.algorithm, *near, str(every), *rest, left]) + " |")
    return rows


def reasons(searches: list[list[Run]]) -> list[str]:
    """Why each search ended."""
    return [f"- {runs[0].algorithm}, at most {runs[0].budget} designs: {runs[0].reason}" for runs in searches]


def provenance() -> str:
    """Date, commit, seed and machine."""
    command = ["git", "-C", str(TOP), "rev-parse", "--short", "HEAD"]
    commit = subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip() or "unknown"
    return (
        f"{datetime.now(UTC):%Y-%m-%d}, commit {commit}, seed {load(EXAMPLE).study.search.seed}; one core of "
        f"{os.cpu_count()} × {platform.machine()} under {platform.system()}, Python {platform.python_version()}."
    )


def main() -> None:
    parser = argparse.ArgumentParser(description="Searches on one problem: fields and seconds to 0.1 % of the best.")
    parser.add_argument("--only", nargs="+", choices=ALL, default=ALL, metavar="SEARCH")
    parser.add_argument("--keep", type=Path, metavar="DIR", help="folder for the runs, not run again")
    parser.add_argument("--write", action="store_true", help=f"write {PAGE.relative_to(TOP)}")
    parser.add_argument("--one", choices=ALL, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.one is not None:
        print(json.dumps(asdict(run(given.one))))
        return
    where, searches = provenance(), []
    for algorithm in given.only:
        searches.append(measured(algorithm, given.keep))
        print(f"{algorithm}: {searches[-1][0].reason}", file=sys.stderr, flush=True)
    rows, ends = "\n".join(table(searches)), "\n".join(reasons(searches))
    print(f"{rows}\n\n{ends}")
    if given.write:
        PAGE.write_text(HEAD.format(where=where) + f"{rows}\n\nWhy each ended:\n\n{ends}\n", encoding="utf-8")


HEAD = """# Searches against one another

Written by `python benchmarks/optimisers.py --write`, {where}

The study of `examples/ipehla-optimum.toml`: six dimensions, four limits, from the paper's prototype, without the
workshop's steps at the end. Counted is what each search took until a feasible design was within 0.1 % of the best
feasible one that any of them found. A design is eight fields, one for each position of the mover; a Newton step is a
factorisation. Seconds are the processor's in one process, derivatives included, the median of three runs for SLSQP, MMA
and CCSAQ.

SLSQP, MMA and CCSAQ use exact gradients; BOBYQA, COBYLA and ISRES none. fluxbore lets COBYLA go on where ISRES has used
up 60 % of its budget, and polishes what these three leave by quadratic models. BOBYQA has no limits of its own: it gets
them through NLopt's augmented Lagrangian.

"""


if __name__ == "__main__":
    main()
