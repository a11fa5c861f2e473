"""What the analytic network is worth to a search by finite elements: designs and seconds to the iPEHLA's optimum.

    python benchmarks/network_first.py              COBYLA, and SLSQP where the model brings gradients
    python benchmarks/network_first.py SPEC         another study
    python benchmarks/network_first.py --algorithm SLSQP --set "actuator.mover.ring_width=5 mm"

The same study with the network off, as the place to start from, and corrected all the way (manifold). Counted are the
designs by finite elements, the start among them, and the seconds until a feasible one is within 0.1 % of the best that
any of the runs found. One process, one BLAS thread, nothing cached between runs.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter

from fluxbore.design.spec import Spec, load
from fluxbore.design.study import NETWORK_ROLES
from fluxbore.optimize.evaluate import MODELS
from fluxbore.optimize.executor import SerialExecutor
from fluxbore.optimize.outcome import SearchResult
from fluxbore.optimize.progress import Progress
from fluxbore.optimize.search import run_search

TOP = Path(__file__).resolve().parents[1]
CLOSE = 1e-3
"""Relative distance to the best at which a run has arrived."""


@dataclass(frozen=True, slots=True)
class Run:
    """One search: seconds after which each of its designs was known, from the begin of the search."""

    algorithm: str
    network: str
    result: SearchResult
    seconds: tuple[float, ...]

    @property
    def best(self) -> float | None:
        return None if self.result.best is None else self.result.best.objective


def run(spec: Spec, algorithm: str, network: str) -> Run:
    """The study's search with this algorithm and this role of the network."""
    search = replace(spec.study.search, algorithm=algorithm, network=network)
    begin, seconds = perf_counter(), []

    def note(state: Progress) -> None:
        while len(seconds) < state.done:
            seconds.append(perf_counter() - begin)

    result = run_search(replace(spec, study=replace(spec.study, search=search)), None, SerialExecutor(), note)
    return Run(algorithm, network, result, tuple(seconds))


def arrived(one: Run, best: float, maximise: bool) -> int | None:
    """Index of the first feasible design within `CLOSE` of the best; None where there is none."""
    sign = 1.0 if maximise else -1.0
    for i, made in enumerate(one.result.history):
        if made.feasible and made.objective is not None and sign * (best - made.objective) <= CLOSE * abs(best):
            return i
    return None


def table(runs: list[Run], maximise: bool) -> str:
    """A row for each run, in Markdown."""
    found = [item.best for item in runs if item.best is not None]
    if not found:
        sys.exit("No run found a feasible design.")
    best = max(found) if maximise else min(found)
    rows = [
        "| search | network | designs to 0.1 % | seconds | designs in all | network calls | best |",
        "|---|---|---|---|---|---|---|",
    ]
    for item in runs:
        index = arrived(item, best, maximise)
        near = ("–", "–") if index is None else (str(index + 1), f"{item.seconds[index]:.1f}")
        shown = "–" if item.best is None else f"{item.best:.6g}"
        rows.append(
            f"| {item.algorithm} | {item.network} | {near[0]} | {near[1]} | {len(item.result.history)} "
            f"| {item.result.network_calls} | {shown} |"
        )
    return "\n".join(rows)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("spec", nargs="?", type=Path, default=TOP / "examples" / "ipehla.toml")
    parser.add_argument("--algorithm", help="only this one")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="another start")
    given = parser.parse_args()
    spec = load(given.spec, dict(item.split("=", 1) for item in given.set))
    if spec.study.objective is None:
        sys.exit("The study has no objective.")
    algorithms = ["COBYLA", *(["SLSQP"] if MODELS[spec.kind.name].gradients else [])]
    runs = []
    for algorithm in [given.algorithm] if given.algorithm else algorithms:
        for network in NETWORK_ROLES:
            runs.append(run(spec, algorithm, network))
            print(f"{algorithm}, network {network}: {runs[-1].result.stop_reason}", flush=True)
    print()
    print(table(runs, spec.study.objective.maximise))


if __name__ == "__main__":
    main()
