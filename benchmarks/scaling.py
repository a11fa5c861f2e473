"""Seconds, memory and error of one nonlinear actuator at meshes from 2,000 to a million unknowns.

    python benchmarks/scaling.py              the table
    python benchmarks/scaling.py --write      and docs/validation/scaling.md
    python benchmarks/scaling.py --sizes 2000 10000

A plunger, its stop and a C-shaped shell of saturating iron around a coil, axisymmetric, meshed by netgen with sides of
one length. Each size runs in a process of its own with one BLAS thread; below 200,000 unknowns the median of three.
Seconds of assembly and solver are the processor's, so that other programs on the machine do not count; the mesher's are
the clock's, since netgen runs in a process of its own.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import resource
import statistics
import subprocess
import sys
from pathlib import Path
from time import perf_counter, process_time

TOP = Path(__file__).resolve().parents[1]
PAGE = TOP / "docs" / "validation" / "scaling.md"
SIZES = (2_000, 10_000, 50_000, 200_000, 1_000_000)
REPEATED = 150_000
"""Unknowns below which the median of three runs is taken."""
DIRECT, ITERATIVE = 1.6, 1.2
"""Greatest exponents of the solver's time against the unknowns that are accepted."""
Row = dict[str, float | str]

LENGTH = 0.06
"""m: the domain is r < LENGTH, |z| < LENGTH."""
IRON = (
    ((0, -30), (10, -30), (10, -2), (0, -2)),
    ((0, 2), (10, 2), (10, 30), (0, 30)),
    ((12, -30), (26, -30), (26, 30), (12, 30), (12, 25), (21, 25), (21, -25), (12, -25)),
)
COIL = ((13, -24), (20, -24), (20, 24), (13, 24))
"""Corners (mm)."""
TURNS_CURRENT = 6000.0
"""A."""


def run(unknowns: int) -> Row:
    """Mesh, assemble and solve; in a fresh process."""
    import numpy as np

    from fluxbore.design.bh_curve import BHCurve
    from fluxbore.design.materials import SoftIron, lookup, standard
    from fluxbore.fem.conductors import Conductor, circuit
    from fluxbore.fem.energy import energies
    from fluxbore.fem.linear import choose, near_numbering
    from fluxbore.fem.magnetostatics import Settings, System, solve
    from fluxbore.fem.mesh import Mesh, Topology
    from fluxbore.fem.outline import Curve, Outline, Seed
    from fluxbore.fem.problem import MagneticMaterial, Problem
    from fluxbore.fem.quadratic import quadratic_nodes
    from fluxbore.fem.reluctivity import reluctivity_curve
    from fluxbore.fem.unstructured import triangulate

    side = math.sqrt(2 * LENGTH**2 / (0.86 * unknowns))
    corners = [(0, -60), (60, -60), (60, 60), (0, 60)]
    shapes = (*IRON, COIL, tuple(corners))
    points: list[tuple[float, float]] = []
    curves: list[Curve] = []
    for shape in shapes:
        for k in range(len(shape)):
            curves.append(Curve(len(points) + k, len(points) + (k + 1) % len(shape)))
        points += [(1e-3 * r, 1e-3 * z) for r, z in shape]
    seeds = [Seed((0.005, -0.015), 1, side), Seed((0.005, 0.015), 1, side), Seed((0.024, 0.0), 1, side)]
    seeds += [Seed((0.016, 0.0), 2, side), Seed((0.05, 0.0), 0, side)]
    outline = Outline("axisymmetric", np.array(points), tuple(curves), tuple(seeds))

    begin = perf_counter()
    triangulation = triangulate(outline, 2_000_000)
    quadratic = quadratic_nodes(triangulation, outline)
    place = near_numbering(quadratic.elements, quadratic.nodes.shape[0])
    nodes = np.empty_like(quadratic.nodes)
    nodes[place] = quadratic.nodes
    space = np.sqrt(2 * nodes[:, 0])
    rim = (nodes[:, 0] <= 0) | (space > LENGTH * (1 - 1e-9)) | (np.abs(nodes[:, 1]) > LENGTH * (1 - 1e-9))
    topology = Topology(place[quadratic.elements], np.where(rim, -1, np.cumsum(~rim) - 1))
    mesh = Mesh("axisymmetric", nodes, triangulation.region, topology)
    del triangulation, quadratic
    mesh_seconds = perf_counter() - begin
    meshed = process_time()

    steel = lookup("1010", "iron", standard(), SoftIron).curve
    assert isinstance(steel, BHCurve)
    area = 1e-6 * (COIL[1][0] - COIL[0][0]) * (COIL[2][1] - COIL[1][1])
    coil = circuit(mesh, "coil", [Conductor(2, 1 / area)], TURNS_CURRENT)
    iron = MagneticMaterial(curve=reluctivity_curve(steel))
    problem = Problem(mesh, (MagneticMaterial(), iron, MagneticMaterial()), (coil,))
    System(problem)
    assembled = process_time()
    System(problem)  # with the pattern at hand, as solve() makes its own
    again = process_time()
    solution = solve(problem, Settings(method="auto"))
    if not solution.convergence.converged:
        sys.exit(solution.convergence.sentence())
    solved = process_time()
    return {
        "unknowns": topology.unknowns,
        "method": choose(topology.pattern),
        "mesh": mesh_seconds,
        "assembly": assembled - meshed,
        "solve": (solved - again) - (again - assembled),
        "iterations": solution.convergence.iterations,
        "memory": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024**2,
        "coenergy": energies(solution)[1],
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
    for key in ("mesh", "assembly", "solve", "memory"):
        row[key] = statistics.median(float(each[key]) for each in rows)
    return row


def exponent(rows: list[Row], key: str) -> float:
    """Slope of log seconds against log unknowns, least squares."""
    x = [math.log(float(row["unknowns"])) for row in rows]
    y = [math.log(float(row[key])) for row in rows]
    return statistics.linear_regression(x, y).slope


def limit_of_coenergy(rows: list[Row]) -> float | None:
    """E∞ of E(N) = E∞ + c N^-p through the three largest sizes; None where they follow no such law."""
    if len(rows) < 3:
        return None
    (n1, e1), (n2, e2), (n3, e3) = ((float(row["unknowns"]), float(row["coenergy"])) for row in rows[-3:])
    if e3 == e2 or not (e2 - e1) / (e3 - e2) > 1:
        return None
    low, high = 1e-3, 5.0
    for _ in range(60):  # the ratio grows with p
        p = (low + high) / 2
        ratio = (n1**-p - n2**-p) / (n2**-p - n3**-p)
        low, high = (p, high) if ratio < (e2 - e1) / (e3 - e2) else (low, p)
    return e3 + (e3 - e2) * n3**-p / (n2**-p - n3**-p)


def lines(rows: list[Row]) -> list[str]:
    """The table and the exponents, as Markdown."""
    limit = limit_of_coenergy(rows)
    out = [
        "| unknowns | method | mesh (s) | assembly (s) | solve (s) | Newton steps | memory (GB) | coenergy error |",
        "|---:|---|---:|---:|---:|---:|---:|---:|",
    ]
    for row in rows:
        error = "" if limit is None else f"{abs(float(row['coenergy']) / limit - 1):.1e}"
        out.append(
            f"| {row['unknowns']:,} | {row['method']} | {row['mesh']:.2f} | {row['assembly']:.2f} | {row['solve']:.2f} "
            f"| {row['iterations']} | {row['memory']:.2f} | {error} |"
        )
    out.append("")
    groups = (
        ("Direct", [row for row in rows if row["method"] != "multigrid"], DIRECT),
        ("Multigrid", [row for row in rows if row["method"] == "multigrid"], ITERATIVE),
    )
    for name, group, accepted in groups:
        if len(group) > 1:
            found = exponent(group, "solve")
            verdict = "within" if found <= accepted else "above"
            out.append(f"{name}: seconds of the solver grow as N^{found:.2f}, {verdict} N^{accepted}.")
    return out


def main() -> None:
    parser = argparse.ArgumentParser(description="Seconds, memory and error against the number of unknowns.")
    parser.add_argument("--sizes", type=int, nargs="+", default=list(SIZES), help="about how many unknowns")
    parser.add_argument("--write", action="store_true", help=f"write {PAGE.relative_to(TOP)}")
    parser.add_argument("--one", type=int, metavar="N", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.one is not None:
        print(json.dumps(run(arguments.one)))
        return
    begin = perf_counter()
    rows: list[Row] = []
    for size in sorted(arguments.sizes):
        rows.append(measured(size))
        print(rows[-1], file=sys.stderr, flush=True)
    text = "\n".join(lines(rows))
    print(text)
    print(f"{perf_counter() - begin:.0f} s in all")
    if arguments.write:
        head = (
            "# Time, memory and error against size\n\n"
            "Written by `python benchmarks/scaling.py --write`. A plunger, its stop and a shell of saturating iron\n"
            "around a coil, on triangles of one size by netgen. One BLAS thread; the mesher's seconds by the clock,\n"
            "the others of the processor. Memory is the solver's process, without the mesher's. The coenergy, which\n"
            "the method makes extremal, is compared with its limit, extrapolated from the three largest sizes.\n\n"
        )
        PAGE.write_text(head + text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
