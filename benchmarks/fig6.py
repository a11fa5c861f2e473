"""Times the 264 solves of the paper's Fig. 6 and says how far its force constants are from converged ones.

    python benchmarks/fig6.py               median of three runs, with the errors
    python benchmarks/fig6.py --once        one run
    python benchmarks/fig6.py --reference   write benchmarks/fig6_reference.csv from many small cells (minutes)

24 ring widths and 9 yoke thicknesses, eight positions each; one design is in both sweeps and computed once, so that 256
fields are solved. What is timed is `fluxbore sweep examples/ipehla.toml` from the start of
the process to its end, with results.csv and results.parquet written, two workers of one BLAS thread; nothing is kept
between runs. Python's bytecode is cached as an installation has it, whatever the environment says.
"""

from __future__ import annotations

import argparse
import csv
import os
import statistics
import subprocess
import sys
import tempfile
from datetime import UTC, datetime
from pathlib import Path
from time import perf_counter

TOP = Path(__file__).resolve().parents[1]
EXAMPLE = TOP / "examples" / "ipehla.toml"
REFERENCE = TOP / "benchmarks" / "fig6_reference.csv"
AXES = ("actuator.mover.ring_width", "actuator.back_yoke.thickness")
FORCE = "force_constant"
PROTOTYPE = (1.5e-3, 1e-3)
Design = tuple[float, float]
Table = dict[Design, float]
"""(ring width, yoke thickness) in m -> force constant (N/A)."""


def command(*arguments: str) -> float:
    """Seconds of a fluxbore command in a process of its own; ends the program where it fails."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    begin = perf_counter()
    done = subprocess.run(
        [sys.executable, "-m", "fluxbore", *arguments], capture_output=True, text=True, check=False, env=environment
    )
    if done.returncode:
        sys.exit(done.stderr)
    return perf_counter() - begin


def sweep(workers: int = 2) -> tuple[float, Table]:
    """Seconds of the whole sweep from the shell, and its force constants."""
    with tempfile.TemporaryDirectory() as folder:
        seconds = command("sweep", str(EXAMPLE), "-o", folder, "--quiet", "--workers", str(workers))
        with (Path(folder) / "results.csv").open(encoding="utf-8", newline="") as file:
            return seconds, _table(list(csv.DictReader(file)))


def _table(rows: list[dict[str, str]]) -> Table:
    return {(round(float(row[AXES[0]]), 9), round(float(row[AXES[1]]), 9)): float(row[FORCE]) for row in rows}


def converged() -> Table:
    """The reference; ends the program where there is none."""
    if not REFERENCE.exists():
        sys.exit(f"{REFERENCE} is missing; --reference makes it.")
    lines = [line for line in REFERENCE.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    return _table(list(csv.DictReader(lines)))


def errors(found: Table) -> dict[Design, float]:
    """Relative, of every design."""
    true = converged()
    return {design: force / true[design] - 1 for design, force in found.items()}


def write_reference() -> None:
    """Cells as for a field twice as rough again: geometric towards every corner of iron, many times the default's."""
    from fluxbore.design.spec import load
    from fluxbore.fem import tubular
    from fluxbore.fem.mapped import Subdivision
    from fluxbore.optimize.executor import local_executor
    from fluxbore.optimize.sweep import run_sweeps

    both, towards_end, towards_start = Subdivision(8, 4.0), Subdivision(8, 3.0, "end"), Subdivision(8, 3.0, "start")
    tubular.Z_CELLS.update(
        {
            **dict.fromkeys(("ring", "half ring", "magnet"), both),
            **dict.fromkeys(("cap end", "beyond cap end"), towards_end),
            **dict.fromkeys(("rod end", "beyond rod end"), towards_start),
        }
    )
    tubular.R_CELLS.update(
        {
            "shaft": Subdivision(4, 3.0, "end"),
            "magnet": Subdivision(8, 3.0),
            "clearance": Subdivision(2),
            "cylinder": Subdivision(3, 2.0, "start"),
            "winding": Subdivision(4, 2.0),
            "back yoke": Subdivision(4, 3.0),
            "near air": Subdivision(3, 2.0, "start"),
            "far air": Subdivision(4, 2.0, "start"),
        }
    )
    stamp = ["git", "-C", str(TOP), "rev-parse", "--short", "HEAD"]
    commit = subprocess.run(stamp, capture_output=True, text=True, check=False).stdout.strip() or "unknown"
    with local_executor(in_process=True) as executor:
        results = run_sweeps(load(EXAMPLE), None, executor)
    with REFERENCE.open("w", newline="", encoding="utf-8") as file:
        file.write("# Force constants (N/A) of Fig. 6, converged: cells graded towards every corner of iron.\n")
        file.write(f"# python benchmarks/fig6.py --reference, commit {commit}, {datetime.now(UTC):%Y-%m-%d}\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow((*AXES, FORCE))
        for result in results:
            for row in result.rows:
                values = row.evaluation.performance
                thickness = row.values.get(AXES[1], values.yoke_wall)
                ring = row.values.get(AXES[0], load(EXAMPLE).number(AXES[0]))
                writer.writerow((f"{ring:.12g}", f"{thickness:.12g}", f"{values.force_constant:.9g}"))


def show(found: Table) -> None:
    """A line for each sweep: its optimum, and the errors against the converged values."""
    wrong, true = errors(found), converged()
    for words, axis in (("Fig. 6(a), ring width", 0), ("Fig. 6(b), yoke thickness", 1)):
        keys = [design for design in found if design[1 - axis] == PROTOTYPE[1 - axis]]
        worst = max(keys, key=lambda key: abs(wrong[key]))
        best, best_true = max(keys, key=found.__getitem__), max(keys, key=true.__getitem__)
        rms = statistics.fmean(wrong[key] ** 2 for key in keys) ** 0.5
        print(
            f"{words}: {len(keys)} designs, error {100 * rms:.3f} % rms, {100 * wrong[worst]:+.3f} % at most "
            f"(at {worst[axis] * 1e3:.4g} mm), {100 * wrong[best]:+.3f} % at the optimum "
            f"{best[axis] * 1e3:.4g} mm (converged: {best_true[axis] * 1e3:.4g} mm)"
        )


def main() -> None:
    parser = argparse.ArgumentParser(description="The 264 solves of Fig. 6: seconds and error.")
    parser.add_argument("--once", action="store_true", help="one run instead of the median of three")
    parser.add_argument("--reference", action="store_true", help="compute and store the converged values")
    arguments = parser.parse_args()
    if arguments.reference:
        write_reference()
        return
    runs = [sweep() for _ in range(1 if arguments.once else 3)]
    seconds = [taken for taken, _ in runs]
    each = ", ".join(f"{one:.1f}" for one in seconds)
    print(f"33 designs of eight positions in {statistics.median(seconds):.1f} s ({each})")
    show(runs[-1][1])


if __name__ == "__main__":
    main()
