"""Times the 264 solves of the paper's Fig. 6 and says how far its force constants are from converged ones.

    python benchmarks/fig6.py               median of three runs, with the errors
    python benchmarks/fig6.py --once        one run
    python benchmarks/fig6.py --reference N write benchmarks/fig6_reference.csv from the mesh refined N times (minutes)

24 ring widths and 9 yoke thicknesses, eight positions each, in two processes of one BLAS thread, from the start of the
first process to the last design; nothing is cached between runs.
"""

from __future__ import annotations

import argparse
import csv
import statistics
import subprocess
import sys
from datetime import UTC, datetime
from pathlib import Path
from time import perf_counter

from fluxbore.design.spec import Spec, load
from fluxbore.optimize.executor import local_executor
from fluxbore.optimize.outcome import SweepResult
from fluxbore.optimize.sweep import run_sweeps

TOP = Path(__file__).resolve().parents[1]
REFERENCE = TOP / "benchmarks" / "fig6_reference.csv"
EXAMPLES = ("ipehla-fig6a.toml", "ipehla-fig6b.toml")
WORKERS = 2
Table = dict[tuple[str, str], float]
"""(example, value of the axis in metres as written) -> force constant (N/A)."""


def specs() -> list[Spec]:
    return [load(TOP / "examples" / name) for name in EXAMPLES]


def run(studies: list[Spec]) -> list[SweepResult]:
    """Both sweeps with fresh processes."""
    with local_executor(WORKERS) as executor:
        return [result for spec in studies for result in run_sweeps(spec, None, executor)]


def table(results: list[SweepResult]) -> Table:
    """The force constants; ends the program where a design has none."""
    found: Table = {}
    for name, result in zip(EXAMPLES, results, strict=True):
        for row in result.rows:
            force = row.evaluation.performance.force_constant
            if force is None:
                sys.exit(f"{name}: {row.values} gave no force constant: {' '.join(row.evaluation.reasons)}")
            (value,) = row.values.values()
            found[name, f"{value:.6g}"] = force
    return found


def write_reference(found: Table, refinement: int) -> None:
    command = ["git", "-C", str(TOP), "rev-parse", "--short", "HEAD"]
    commit = subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip() or "unknown"
    with REFERENCE.open("w", newline="", encoding="utf-8") as file:
        file.write(f"# Force constants (N/A) of Fig. 6 at mesh refinement {refinement}.\n")
        file.write(
            f"# python benchmarks/fig6.py --reference {refinement}, commit {commit}, {datetime.now(UTC):%Y-%m-%d}\n"
        )
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("example", "value_m", "force_constant"))
        writer.writerows((*key, f"{force:.9g}") for key, force in found.items())


def read_reference() -> Table:
    lines = [line for line in REFERENCE.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    return {(row["example"], row["value_m"]): float(row["force_constant"]) for row in csv.DictReader(lines)}


def show(found: Table, converged: Table) -> None:
    """A line for each sweep: its optimum, and the errors against the converged values."""
    for name in EXAMPLES:
        keys = [key for key in found if key[0] == name]
        error = {key: found[key] / converged[key] - 1 for key in keys}
        worst = max(keys, key=lambda key: abs(error[key]))
        best, best_converged = max(keys, key=found.__getitem__), max(keys, key=converged.__getitem__)
        rms = statistics.fmean(e**2 for e in error.values()) ** 0.5
        print(
            f"{name}: {len(keys)} designs, error {100 * rms:.3f} % rms, {100 * error[worst]:+.3f} % at most "
            f"(at {float(worst[1]) * 1e3:.4g} mm), {100 * error[best]:+.3f} % at the optimum "
            f"{float(best[1]) * 1e3:.4g} mm (converged: {float(best_converged[1]) * 1e3:.4g} mm)"
        )


def main() -> None:
    parser = argparse.ArgumentParser(description="The 264 solves of Fig. 6: seconds and error.")
    parser.add_argument("--once", action="store_true", help="one run instead of the median of three")
    parser.add_argument("--reference", type=int, metavar="N", help="compute and store the values at refinement N")
    arguments = parser.parse_args()
    if arguments.reference is not None:
        refined = [spec.with_values({"solver.mesh_refinement": arguments.reference}) for spec in specs()]
        write_reference(table(run(refined)), arguments.reference)
        return
    if not REFERENCE.exists():
        sys.exit(f"{REFERENCE} is missing; --reference makes it.")
    seconds: list[float] = []
    results: list[SweepResult] = []
    for _ in range(1 if arguments.once else 3):
        begin = perf_counter()
        results = run(specs())
        seconds.append(perf_counter() - begin)
    solves = sum(len(row.evaluation.positions) for result in results for row in result.rows)
    print(f"{solves} solves in {statistics.median(seconds):.1f} s ({', '.join(f'{s:.1f}' for s in seconds)})")
    show(table(results), read_reference())


if __name__ == "__main__":
    main()
