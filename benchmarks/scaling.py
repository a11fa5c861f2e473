"""Seconds, memory and error of one nonlinear problem at meshes from 2,000 to a million unknowns.

    python benchmarks/scaling.py              the table
    python benchmarks/scaling.py --write      and docs/validation/scaling.md
    python benchmarks/scaling.py --sizes 2000 10000

A coaxial line whose field is known: a solid steel wire that carries its current itself, air, a steel tube and a copper
sheath for the return, one quarter of it; Ampère's law gives H(r), the steel's curve B, and a sum over r the coenergy.
The steel goes from no field to beyond saturation. netgen meshes it coarsely, arcs and all, and triangles are cut into
four until there are enough. Newton begins without a field.

Each size runs in a process of its own with one BLAS thread; below 150,000 unknowns the median of three. Seconds of
assembly and solver are the processor's, so that programs waiting beside it do not count; the mesher's are the clock's.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import platform
import resource
import statistics
import subprocess
import sys
from datetime import UTC, datetime
from pathlib import Path
from time import perf_counter, process_time

import numpy as np

from fluxbore.design.bh_curve import BHCurve
from fluxbore.design.materials import SoftIron, lookup, standard
from fluxbore.fem.bisection import refine_all
from fluxbore.fem.conditions import Conditions, Prescribed, conditioned_mesh
from fluxbore.fem.conductors import Conductor, circuit
from fluxbore.fem.energy import energies
from fluxbore.fem.linear import choose
from fluxbore.fem.magnetostatics import Settings, System, solve
from fluxbore.fem.outline import Curve, Outline, Seed
from fluxbore.fem.problem import MagneticMaterial, Problem
from fluxbore.fem.quadratic import quadratic_nodes
from fluxbore.fem.reluctivity import VACUUM_RELUCTIVITY, ReluctivityCurve, reluctivity_curve
from fluxbore.fem.unstructured import triangulate

TOP = Path(__file__).resolve().parents[1]
PAGE = TOP / "docs" / "validation" / "scaling.md"
SIZES = (2_000, 10_000, 50_000, 90_000, 200_000, 400_000, 1_000_000)
REPEATED = 150_000
"""Unknowns below which the median of three runs is taken."""
DIRECT, ITERATIVE = 1.6, 1.2
"""Greatest exponents of the solver's time against the unknowns that are accepted."""
COARSE = 4_000
"""Unknowns at most that netgen's own mesh is to have."""
Row = dict[str, float | str]

RADII = (0.010, 0.014, 0.024, 0.030)
"""m: of the wire, the air, the tube and the sheath."""
CURRENT = 2000.0
"""A."""


def steel() -> ReluctivityCurve:
    curve = lookup("1010", "iron", standard(), SoftIron).curve
    assert isinstance(curve, BHCurve)
    return reluctivity_curve(curve)


def exact_coenergy() -> float:
    """J/m of the whole line: ∫ dr 2πr ∫ B dH up to H(r), by Gauss's rule in 2,000 points for each layer."""
    points, weights = np.polynomial.legendre.leggauss(2000)
    curve = steel()
    wire, _, tube, sheath = RADII
    total, inner = 0.0, 0.0
    for layer, outer in enumerate(RADII):
        r = (inner + outer) / 2 + (outer - inner) / 2 * points
        enclosed = ((r / wire) ** 2, 1.0, 1.0, (sheath**2 - r**2) / (sheath**2 - tube**2))[layer]
        h = CURRENT * enclosed / (2 * math.pi * r)
        density = curve.coenergy_at(h) if layer in (0, 2) else h**2 / (2 * VACUUM_RELUCTIVITY)
        total += float(np.sum(weights * (outer - inner) / 2 * 2 * math.pi * r * density))
        inner = outer
    return total


def outline(side: float) -> Outline:
    """A quarter: the flux runs along arcs, so that both straight sides are natural."""
    points = [(0.0, 0.0), *((r, 0.0) for r in RADII), *((0.0, r) for r in RADII)]
    curves = [Curve(k, k + 1) for k in range(4)]
    curves += [Curve(4 + k if k else 0, 5 + k) for k in range(4)]
    curves += [Curve(1 + k, 5 + k, math.pi / 2, None, 0 if k == 3 else None) for k in range(4)]
    middles = [(a + b) / 2 / math.sqrt(2) for a, b in zip((0.0, *RADII), RADII, strict=False)]
    seeds = tuple(Seed((middle, middle), layer, side) for layer, middle in enumerate(middles))
    return Outline("planar", np.array(points), tuple(curves), seeds)


def line(unknowns: int) -> Problem:
    """The problem at about this many unknowns."""
    cuts = max(0, math.ceil(math.log(unknowns / COARSE, 4)))
    drawn = outline(2**cuts * math.sqrt(math.pi / 4 * RADII[-1] ** 2 / (0.82 * unknowns)))
    triangulation = triangulate(drawn)
    for _ in range(cuts):
        triangulation = refine_all(triangulation, drawn).triangulation
    nodes = quadratic_nodes(triangulation, drawn)
    rim = Prescribed(lambda places: np.zeros(len(places)))
    conditioned = conditioned_mesh(triangulation, nodes, drawn, Conditions((rim,)))
    wire, _, tube, sheath = RADII
    there, back = Conductor(0, 1 / (math.pi * wire**2)), Conductor(3, -1 / (math.pi * (sheath**2 - tube**2)))
    coil = circuit(conditioned.mesh, "line", [there, back], CURRENT)
    iron, air = MagneticMaterial(curve=steel()), MagneticMaterial()
    # Four quarters of one metre each are the line.
    return Problem(conditioned.mesh, (iron, air, iron, air), (coil,), prescribed=conditioned.prescribed, depth=4.0)


def mesher_memory() -> float:
    """Peak of this process's children (GB), which still run and so are in nobody's account: by Linux's /proc."""
    peak = 0.0
    for children in Path("/proc/self/task").glob("*/children"):
        for child in children.read_text().split():
            status = dict(line.split(":", 1) for line in Path(f"/proc/{child}/status").read_text().splitlines())
            peak = max(peak, float(status["VmHWM"].split()[0]) / 1024**2)
    return peak


def run(unknowns: int) -> Row:
    """Mesh, assemble and solve; in a fresh process."""
    begin = perf_counter()
    problem = line(unknowns)
    mesh_seconds = perf_counter() - begin
    meshed = process_time()
    System(problem)
    assembled = process_time()
    System(problem)  # with the pattern at hand, as solve() makes its own
    again = process_time()
    solution = solve(problem, Settings(method="auto"))
    solved = process_time()
    if not solution.convergence.converged:
        sys.exit(solution.convergence.sentence())
    topology = problem.mesh.topology
    return {
        "unknowns": topology.unknowns,
        "method": choose(topology.pattern),
        "mesh": mesh_seconds,
        "assembly": assembled - meshed,
        "solve": (solved - again) - (again - assembled),
        "steps": solution.convergence.iterations,
        "memory": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024**2,
        "mesher": mesher_memory(),
        "error": abs(energies(solution)[1] / exact_coenergy() - 1),
    }


def measured(unknowns: int) -> Row:
    """One size in fresh processes: medians of seconds and memory."""
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    command = [sys.executable, str(Path(__file__).resolve()), "--one", str(unknowns)]
    rows: list[Row] = []
    for _ in range(3 if unknowns < REPEATED else 1):
        answer = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
        if answer.returncode:
            sys.exit(f"{unknowns} unknowns: {answer.stderr.strip()}")
        rows.append(json.loads(answer.stdout))
    row = rows[0]
    for key in ("mesh", "assembly", "solve", "memory", "mesher"):
        row[key] = statistics.median(float(each[key]) for each in rows)
    return row


def exponent(rows: list[Row], key: str) -> float:
    """Slope of log of the column against log unknowns, least squares."""
    x = [math.log(float(row["unknowns"])) for row in rows]
    y = [math.log(float(row[key])) for row in rows]
    return statistics.linear_regression(x, y).slope


def lines(rows: list[Row]) -> list[str]:
    """The table and the exponents, as Markdown."""
    out = [
        "| unknowns | method | mesh (s) | assembly (s) | solve (s) | Newton steps | s per step | solver (GB) "
        "| mesher (GB) | error of coenergy |",
        "|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|",
    ]
    for row in rows:
        row["step"] = float(row["solve"]) / float(row["steps"])
        out.append(
            f"| {row['unknowns']:,} | {row['method']} | {row['mesh']:.2f} | {row['assembly']:.2f} | {row['solve']:.2f} "
            f"| {row['steps']} | {row['step']:.3f} | {row['memory']:.2f} | {row['mesher']:.2f} | {row['error']:.1e} |"
        )
    out.append("")
    groups = (
        ("Direct", [row for row in rows if row["method"] != "multigrid"], DIRECT),
        ("Multigrid", [row for row in rows if row["method"] == "multigrid"], ITERATIVE),
    )
    for name, group, accepted in groups:
        if len(group) > 1:
            found = exponent(group, "solve")
            verdict = "within" if found <= accepted else "**above**"
            out.append(
                f"- {name}: seconds of the solver grow as N^{found:.2f}, {verdict} N^{accepted}; "
                f"of one Newton step as N^{exponent(group, 'step'):.2f}."
            )
    if len(rows) > 1:
        out.append(f"- The error falls as N^{exponent(rows, 'error'):.2f}; theory says N^-2.")
    peak = max(max(float(row["memory"]), float(row["mesher"])) for row in rows)
    out.append(f"- At most {peak:.2f} GB in one process.")
    return out


def provenance() -> str:
    """Machine, date and commit."""
    command = ["git", "-C", str(TOP), "rev-parse", "--short", "HEAD"]
    commit = subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip() or "unknown"
    return (
        f"{datetime.now(UTC):%Y-%m-%d}, commit {commit}; {os.cpu_count()} × {platform.machine()} under "
        f"{platform.system()}, Python {platform.python_version()}, numpy {np.__version__}. "
        f"Load before: {os.getloadavg()[0]:.1f}."
    )


def main() -> None:
    parser = argparse.ArgumentParser(description="Seconds, memory and error against the number of unknowns.")
    parser.add_argument("--sizes", type=int, nargs="+", default=list(SIZES), help="about how many unknowns")
    parser.add_argument("--write", action="store_true", help=f"write {PAGE.relative_to(TOP)}")
    parser.add_argument("--one", type=int, metavar="N", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.one is not None:
        print(json.dumps(run(arguments.one)))
        return
    where = provenance()
    rows: list[Row] = []
    for size in sorted(arguments.sizes):
        rows.append(measured(size))
        print(rows[-1], file=sys.stderr, flush=True)
    text = "\n".join(lines(rows))
    print(text)
    if arguments.write:
        head = (
            "# Time, memory and error against size\n\n"
            f"Written by `python benchmarks/scaling.py --write`, {where}\n\n"
            "A coaxial line of steel, air, steel and copper with its current in the steel, solved from no field to\n"
            "beyond saturation; its coenergy is known. One BLAS thread. The mesher's seconds are the clock's, the\n"
            "others the processor's: other programs on the machine slow its memory down and are in them. Memory is\n"
            "the peak of the solver's process and of netgen's.\n\n"
        )
        PAGE.write_text(head + text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
