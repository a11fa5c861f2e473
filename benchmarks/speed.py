"""How long the hybrid actuator's studies take, with the error beside the time.

    python benchmarks/speed.py              the table, and how time scales (minutes)
    python benchmarks/speed.py --table      the table alone
    python benchmarks/speed.py --once       one run of what is otherwise the median of three

Whole processes are timed from their start to their end, with nothing cached between runs; single solves are timed in a
process of one BLAS thread. Errors are against the same model on the mesh refined three times, those of Fig. 6 against
benchmarks/fig6_reference.csv, whose mesh has many small cells at every corner of iron. Beside the seconds stand those
that a fixed factorisation takes on this machine at the time: a machine that is busy is slow at both. Where cvxopt is
installed, CHOLMOD factorises the same matrix beside the band.
"""

from __future__ import annotations

import argparse
import os
import platform
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable
from time import perf_counter

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np  # after the number of threads is set
from fig6 import TOP, command, errors, sweep

from fluxbore.design.hybrid_values import positions as window_positions
from fluxbore.design.spec import Spec, load
from fluxbore.fem.cell_arrays import CellArrays
from fluxbore.fem.cell_matrices import Precision
from fluxbore.fem.cell_model import CellKernels, cell_model
from fluxbore.fem.cell_native import CellNative
from fluxbore.fem.cell_system import CellSystem
from fluxbore.fem.factors import Band
from fluxbore.fem.magnetostatics import Settings
from fluxbore.fem.native import functions
from fluxbore.fem.tubular import TubularSolution, solve_currents, solve_positions, space_vector
from fluxbore.geometry.hybrid import cross_section
from fluxbore.optimize.evaluate import evaluate

PRECISIONS: dict[str, Precision] = {"single": np.float32, "double": np.float64}
KEYS = ("actuator.mover.ring_width", "actuator.back_yoke.thickness", "actuator.winding.outer_diameter")


def median(runs: int, action: Callable[[], object]) -> float:
    """The seconds of the middle one of some runs."""
    seconds = []
    for _ in range(runs):
        begin = perf_counter()
        action()
        seconds.append(perf_counter() - begin)
    return statistics.median(seconds)


def yardstick() -> float:
    """Seconds of LAPACK's banded Cholesky, 14,616 unknowns of half bandwidth 114: what a solve once began with."""
    from scipy.linalg import cholesky_banded

    band = np.full((115, 14_616), -1e-3)
    band[0] = 10.0
    return median(5, lambda: cholesky_banded(band, lower=True, check_finite=False))


def fig6(workers: int = 2) -> tuple[float, float, float]:
    """Seconds of both sweeps from the shell; root mean square and largest relative error of their force constants."""
    seconds, found = sweep(workers)
    wrong = np.array(list(errors(found).values()))
    return seconds, float(np.sqrt(np.mean(wrong**2))), float(np.abs(wrong).max())


def solved(spec: Spec, places: list[float], refinement: int = 1, method: str = "banded") -> list[TubularSolution]:
    settings = Settings(1e-8, 60, "superlu" if method == "superlu" else "banded")
    return solve_positions(
        lambda z: cross_section(spec.actuator, z, spec.materials, 293.15), places, settings, refinement
    )


def constant(item: TubularSolution) -> float:
    """N/A."""
    return 1.5 * abs(space_vector(item.thrust_constants()))


def single_solves(spec: Spec, runs: int) -> list[tuple[str, float, float]]:
    """(words, seconds, relative error of the force constant) of a first position, and of a position after others."""
    places = [float(z) for z in window_positions(spec.values)]
    exact = constant(solved(spec, places[:1], 3)[0])
    found = constant(solved(spec, places[:1])[0])
    cold = median(runs, lambda: constant(solved(spec, places[:1])[0]))
    plain = median(runs, lambda: constant(solved(spec, places[:1], method="superlu")[0]))
    window = median(runs, lambda: [constant(item) for item in solved(spec, places)])
    next_design = _next_design(spec, places[0], runs)
    return [
        ("one cold solve with thrust constants", cold, found / exact - 1),
        ("the same by the plain path (SuperLU)", plain, found / exact - 1),
        ("the next position, warm", (window - cold) / (len(places) - 1), found / exact - 1),
        ("the next design, from the last one's field", next_design, found / exact - 1),
    ]


def _next_design(spec: Spec, place: float, runs: int) -> float:
    """Seconds for a ring 1 % wider, begun from the field before; studies begin anew, see docs/performance.md."""
    (before,) = solved(spec, [place])
    wider = spec.with_values({KEYS[0]: 1.01 * spec.number(KEYS[0])})

    def solve() -> float:
        section = cross_section(wider.actuator, place, spec.materials, 293.15)
        return constant(solve_currents(section, place, {}, Settings(1e-8), near=before))

    return median(runs, solve)


def gradient_ratio(spec: Spec, runs: int) -> tuple[float, float]:
    """Seconds of a design's figures, and of their derivatives by three variables as a ratio to that."""
    forward = median(runs, lambda: evaluate(spec))
    both = median(runs, lambda: evaluate(spec, "fem", KEYS))
    return forward, both / forward - 1


def worker_memory() -> float:
    """MB that a process needs at most for three designs of eight positions (of Linux)."""
    # Not resource.getrusage, whose maximum a new process has from the one that started it.
    code = (
        "import sys; from pathlib import Path; from fluxbore.design.spec import load; "
        "from fluxbore.optimize.evaluate import evaluate; "
        "spec = load(sys.argv[1]); [evaluate(spec) for _ in range(3)]; "
        "text = Path('/proc/self/status').read_text(); print(text.split('VmHWM:')[1].split()[0])"
    )
    run = [sys.executable, "-c", code, str(TOP / "examples" / "ipehla.toml")]
    return float(subprocess.run(run, capture_output=True, text=True, check=True).stdout) / 1024


def line(words: str, seconds: float | None, target: str, remark: str) -> None:
    shown = "" if seconds is None else f"{seconds:.3g} s"
    print(f"| {words} | {shown} | {target} | {remark} |", flush=True)


def show_table(spec: Spec, runs: int) -> None:
    print(f"{platform.machine()}, {os.cpu_count()} cores; yardstick {1e3 * yardstick():.1f} ms (15 ms when quiet)\n")
    print("| what | time | to reach | error, remark |\n|---|---|---|---|")
    seconds, rms, worst = sorted(fig6() for _ in range(runs))[runs // 2]
    line(
        "Fig. 6(a) + 6(b), 33 designs of eight positions",
        seconds,
        "5 s",
        f"{100 * rms:.3f} % rms, {100 * worst:.3f} % at most",
    )
    targets = {
        "one cold solve with thrust constants": "0.05 s",
        "the next position, warm": "0.02 s",
        "the next design, from the last one's field": "0.02 s",
    }
    for words, seconds, error in single_solves(spec, 3 * runs):
        line(words, seconds, targets.get(words, ""), f"{100 * error:+.3f} %")
    with tempfile.TemporaryDirectory() as folder:
        example = str(TOP / "examples" / "ipehla-optimum.toml")
        line(
            "six-variable constrained optimum with gradients",
            command("optimize", example, "-o", folder, "--quiet"),
            "10 s",
            "",
        )
    network = ("evaluate", str(TOP / "examples" / "ipehla.toml"), "--fidelity", "network")
    line("evaluate --fidelity network", median(3, lambda: command(*network)), "0.8 s", "from the shell")
    line("peak memory of a worker", None, "300 MB", f"{worker_memory():.0f} MB")
    forward, ratio = gradient_ratio(spec, runs)
    line("one design, eight positions", forward, "", f"its gradient by three variables: {ratio:.2f} times that")


def show_factors(spec: Spec) -> None:
    """One factor of the motor's condensed tangent and one solution with it, by what there is."""
    (item,) = solved(spec, [spec.actuator.mid_stroke])
    system, psi = item.solution.system, item.solution.psi
    assert isinstance(system, CellSystem)
    model = cell_model(system.problem, item.grid, system.rim)
    arrays = CellArrays(model)
    _, tensor = arrays.residual(psi)
    bands = {
        words: arrays.condensed(tensor, precision, arrays.linear(precision))[1]
        for words, precision in PRECISIONS.items()
    }
    size, width = bands["double"].shape
    print(f"\n{size} unknowns, half band {width - 1}, {size * (width - 1) ** 2 / 1e6:.0f} million operations\n")
    print("| factor | numbers | one solution |\n|---|---|---|")
    compiled = functions()
    kinds: list[tuple[str, CellKernels]] = [("numpy and LAPACK", arrays)]
    if compiled is not None:
        kinds.insert(0, ("compiled kernels", CellNative(model, compiled)))
    for words, kind in kinds:
        linear = kind.linear(np.float32)
        taken = median(15, lambda k=kind, a=linear: k.factor(tensor, np.float32, a))  # type: ignore[misc]
        whole = kind.factor(tensor, np.float32, linear)
        one = median(15, lambda f=whole: f.solve(system.load))  # type: ignore[misc]
        words = f"{words}, single precision: iron condensed, band put together and factorised; all nodes solved for"
        print(f"| {words} | {1e3 * taken:.1f} ms | {1e3 * one:.2f} ms |")
    for words, band in bands.items():
        factor, right = Band(band.copy()), np.ones(size, dtype=band.dtype)
        taken = median(15, lambda b=band: Band(b.copy()))  # type: ignore[misc]
        one = median(15, lambda f=factor, r=right: f.solve(r))  # type: ignore[misc]
        print(f"| the band alone by LAPACK, {words} precision | {1e3 * taken:.1f} ms | {1e3 * one:.2f} ms |")
    try:
        from cvxopt import cholmod, matrix, spmatrix
    except ImportError:
        print("| CHOLMOD | pip install cvxopt (GPL) | |")
        return
    lower = bands["double"]
    place = np.flatnonzero(lower)
    column, below = np.divmod(place, width)
    whole = spmatrix(lower.ravel()[place].tolist(), (column + below).tolist(), column.tolist(), (size, size))
    found = cholmod.symbolic(whole, uplo="L")
    ordering = median(15, lambda: cholmod.symbolic(whole, uplo="L"))
    taken = median(15, lambda: cholmod.numeric(whole, found))
    one = median(15, lambda: cholmod.solve(found, matrix(1.0, (size, 1))))
    words = f"the same by CHOLMOD (cvxopt), after {1e3 * ordering:.1f} ms of ordering"
    print(f"| {words} | {1e3 * taken:.1f} ms | {1e3 * one:.2f} ms |")


def show_scaling(spec: Spec, runs: int) -> None:
    """Time against unknowns, positions, designs and workers."""
    middle = spec.actuator.mid_stroke
    print("\n| mesh refinement | unknowns | one cold solve |\n|---|---|---|")
    for refinement in (1, 2, 3):
        (item,) = solved(spec, [middle], refinement)
        seconds = median(runs, lambda n=refinement: constant(solved(spec, [middle], n)[0]))  # type: ignore[misc]
        print(f"| {refinement} | {item.grid.topology.unknowns} | {seconds:.3f} s |", flush=True)
    print("\n| positions | one design |\n|---|---|")
    for count in (1, 2, 4, 8, 16):
        places = [middle + 8e-3 * k / count for k in range(count)]
        print(f"| {count} | {median(runs, lambda p=places: [constant(i) for i in solved(spec, p)]):.3f} s |")  # type: ignore[misc]
    print("\n| designs | in one process |\n|---|---|")
    for count in (1, 2, 4, 8):
        widths = [spec.with_values({KEYS[0]: 1e-3 + 1e-4 * k}) for k in range(count)]
        print(f"| {count} | {median(1, lambda w=widths: [evaluate(one) for one in w]):.3f} s |", flush=True)  # type: ignore[misc]
    print("\n| workers | Fig. 6 from the shell |\n|---|---|")
    for workers in (1, 2):
        print(f"| {workers} | {fig6(workers)[0]:.1f} s |", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description="Seconds and errors of the hybrid actuator's studies.")
    parser.add_argument("--table", action="store_true", help="without the scaling")
    parser.add_argument("--once", action="store_true", help="one run instead of the median of three")
    arguments = parser.parse_args()
    spec, runs = load(TOP / "examples" / "ipehla.toml"), 1 if arguments.once else 3
    show_table(spec, runs)
    show_factors(spec)
    if not arguments.table:
        show_scaling(spec, runs)


if __name__ == "__main__":
    main()
