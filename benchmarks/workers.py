"""What a second worker is worth: a sweep of 24 designs, each by the network and by finite elements.

    python benchmarks/workers.py            medians of three runs each, their ratio, and whether it is at least 1.8

The paper's ring widths (Fig. 6(a), eight positions a design). Each run is a study as the command line runs it: fresh
processes, a fresh folder, every design forced to the disk; from the start of the first process to the written tables.
Runs with one and with two workers alternate, so that whatever else the machine does meets both.
"""

from __future__ import annotations

import statistics
import sys
import tempfile
from pathlib import Path
from time import perf_counter

from fluxbore.design.spec import Spec, load
from fluxbore.optimize import parquet, table
from fluxbore.optimize.executor import available_cores, local_executor
from fluxbore.optimize.folder import open_folder
from fluxbore.optimize.sweep import run_sweeps

EXAMPLE = Path(__file__).resolve().parents[1] / "examples" / "ipehla-fig6a.toml"
RUNS = 3
WANTED = 1.8


def seconds(spec: Spec, workers: int) -> float:
    """Of one whole study; ends the program where a design has no figures."""
    with tempfile.TemporaryDirectory() as place:
        begin = perf_counter()
        with open_folder(place, spec) as folder, local_executor(workers) as executor:
            network = run_sweeps(spec, folder.journal, executor, "network")
            results = run_sweeps(spec, folder.journal, executor, "fem")
            folder.write(table.FILE_NAME, table.results_table(spec, results))
            folder.write(parquet.FILE_NAME, parquet.results_parquet(spec, results))
        taken = perf_counter() - begin
    if bad := [row.values for result in (*network, *results) for row in result.rows if not row.evaluation.ok]:
        sys.exit(f"{len(bad)} designs gave no figures, such as {bad[0]}")
    return taken


def main() -> None:
    spec = load(EXAMPLE)
    if available_cores() < 2:
        sys.exit("two workers need two cores")
    taken: dict[int, list[float]] = {1: [], 2: []}
    for _ in range(RUNS):
        for workers, times in taken.items():
            times.append(seconds(spec, workers))
    medians = {workers: statistics.median(times) for workers, times in taken.items()}
    for workers, times in taken.items():
        print(f"{workers} worker(s): {medians[workers]:.2f} s of " + ", ".join(f"{time:.2f}" for time in times))
    ratio = medians[1] / medians[2]
    print(f"ratio {ratio:.2f}, at least {WANTED} wanted: {'met' if ratio >= WANTED else 'NOT MET'}")
    sys.exit(0 if ratio >= WANTED else 1)


if __name__ == "__main__":
    main()
