"""Whether Newton's iteration ends well on 500 random tubular designs, and in how many steps and seconds.

    python benchmarks/robustness.py                  the counts and the distributions
    python benchmarks/robustness.py --write          and docs/validation/robustness.md
    python benchmarks/robustness.py --count 50 --seed 7

A design is drawn from wide bounds of every parameter of the hybrid actuator that its field depends on, passes the check
that a specification passes, and is solved twice from no field: at no current, and at a current of up to 1000 A per mm²
of the winding's section. What does not converge is printed with its seed and its reason.
"""

from __future__ import annotations

import argparse
import subprocess
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter

import numpy as np

from fluxbore.design.errors import FluxboreError
from fluxbore.design.hybrid import (
    PHASES,
    BackYoke,
    Cylinder,
    EndCaps,
    HybridActuator,
    Mover,
    Piston,
    Shaft,
    Winding,
)
from fluxbore.design.materials import Library, PermanentMagnet, SoftIron, standard
from fluxbore.fem.magnetostatics import Settings
from fluxbore.fem.tubular import solve_currents
from fluxbore.geometry.hybrid import cross_section

TOP = Path(__file__).resolve().parents[1]
PAGE = TOP / "docs" / "validation" / "robustness.md"
COUNT, SEED = 500, 20_000
MM = 1e-3


@dataclass(frozen=True, slots=True)
class RandomDesign:
    """A design with the state in which it is solved. currents : A by phase. temperature : of the magnets (K)."""

    actuator: HybridActuator
    position: float
    currents: dict[str, float]
    temperature: float


@dataclass(frozen=True, slots=True)
class Run:
    """How one solution ended. status : Newton's, or "refused". reason : a sentence unless it converged."""

    seed: int
    loaded: bool
    status: str
    reason: str
    iterations: int
    seconds: float
    highest: float
    """T, in iron."""


def random_design(seed: int, library: Library) -> RandomDesign:
    """Lengths over two decades, yokes from 0.05 mm, rings from none to nearly the whole pitch, any steel and magnet."""
    rng = np.random.default_rng(seed)
    irons = [name for name, material in library.items() if isinstance(material, SoftIron)]
    magnets = [name for name, material in library.items() if isinstance(material, PermanentMagnet)]

    def log(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    def between(low: float, high: float) -> float:
        return float(rng.uniform(low, high))

    def often(share: float) -> bool:
        return bool(rng.random() < share)

    shaft = log(1 * MM, 50 * MM)
    magnet = shaft + 2 * log(0.5 * MM, 30 * MM)
    bore = magnet + 2 * log(0.01 * MM, 1 * MM)
    tube = bore + 2 * log(0.1 * MM, 5 * MM)
    wound = tube + 2 * log(0.3 * MM, 15 * MM)
    yoke_bore = wound + 2 * (0.0 if often(0.2) else log(0.01 * MM, 1 * MM))
    yoke = yoke_bore + 2 * log(0.05 * MM, 15 * MM)
    pitch = log(3 * MM, 60 * MM)
    coil = 2 * pitch / 3
    pairs = int(log(1, 10.999))
    sets = pairs + 1 + int(rng.integers(0, 6))
    stroke, piston = between(0.05, 3.0) * pitch, between(0.2, 2.0) * pitch
    array = 2 * pairs * pitch
    wire = min(log(0.05 * MM, 1 * MM), (wound - tube) / 2, coil)
    turns = between(0.1, 0.7) * coil * (wound - tube) / 2 / (np.pi / 4 * wire**2)
    actuator = HybridActuator(
        name=f"random {seed}",
        back_yoke=BackYoke(
            yoke,
            yoke_bore,
            0.0 if often(0.2) else between(0.0, 3.0) * coil,
            0.0 if often(0.2) else between(0.0, 3.0) * coil,
            str(rng.choice(irons)),
        ),
        winding=Winding(wound, sets, turns * sets, wire, "copper"),
        cylinder=Cylinder(
            tube,
            bore,
            bore * between(0.96, 1.04),
            (array + 2 * piston + stroke) * between(1.01, 1.5),
            str(rng.choice(irons)) if often(0.15) else "aluminium 6061",
        ),
        mover=Mover(
            pitch,
            0.0 if often(0.1) else between(0.005, 0.98) * pitch,
            pairs,
            magnet,
            str(rng.choice(magnets)),
            None if often(0.3) else between(0.2, 1.6),
            None if often(0.3) else between(1.0, 1.3),
            str(rng.choice(irons)),
            stroke,
        ),
        shaft=Shaft(
            shaft,
            (array + 2 * piston) * between(1.01, 2.0),
            str(rng.choice(irons)) if often(0.3) else "stainless steel 304",
        ),
        piston=Piston(piston, bore * 1.01, bore * 0.95, piston / 4, 0.3 * MM, "POM"),
        end_caps=EndCaps(tube * 1.3, 12 * MM, 5 * MM, 0.05 * MM, "aluminium 6061"),
    )
    density, angle = log(1e6, 1e9), between(0, 2 * np.pi)
    amplitude = density * actuator.coil_area / actuator.turns_per_coil
    currents = {phase: amplitude * float(np.cos(angle - k * 2 * np.pi / 3)) for k, phase in enumerate(PHASES)}
    position = actuator.mid_stroke + between(-0.5, 0.5) * stroke
    return RandomDesign(actuator, position, currents, between(253.0, 393.0))


def runs(seed: int, library: Library, settings: Settings | None = None) -> tuple[Run, Run]:
    """One design solved at no current and at its currents, each from no field."""
    design = random_design(seed, library)
    idle = replace(design, currents={})
    first, second = (_run(seed, state, library, settings) for state in (idle, design))
    return first, second


def _run(seed: int, design: RandomDesign, library: Library, settings: Settings | None) -> Run:
    loaded = bool(design.currents)
    begin = perf_counter()
    try:
        design.actuator.check()
        section = cross_section(design.actuator, design.position, library, design.temperature)
        solved = solve_currents(section, design.position, design.currents, settings)
    except FluxboreError as error:
        return Run(seed, loaded, "refused", str(error), 0, perf_counter() - begin, 0.0)
    seconds, found = perf_counter() - begin, solved.convergence
    if found.converged and not np.all(np.isfinite((*solved.solution.psi, *solved.thrust_constants()))):
        return Run(seed, loaded, "not finite", "The field or its thrust is not finite.", 0, seconds, 0.0)
    reason = "" if found.converged else found.sentence()
    return Run(seed, loaded, found.status, reason, found.iterations, seconds, solved.highest_flux_density())


def lines(found: Sequence[Run]) -> list[str]:
    """Counts, distributions and failures, as Markdown."""
    outcomes = ", ".join(f"{n} {status}" for status, n in Counter(run.status for run in found).most_common())
    failed = [run for run in found if run.status != "converged"]
    designs, bad = len({run.seed for run in found}), len({run.seed for run in failed})
    out = [
        f"{designs} designs, {len(found)} solutions: {outcomes}.\n",
        f"Designs that failed: {bad}.",
        "",
        "| | least | 25 % | median | 75 % | 95 % | most |",
        "|---|---:|---:|---:|---:|---:|---:|",
    ]
    levels = (0, 0.25, 0.5, 0.75, 0.95, 1)
    for name, loaded in (("no current", False), ("current", True)):
        part = [run for run in found if run.loaded == loaded and run.status != "refused"]
        if not part:
            continue
        for what, digits, values in (
            ("Newton steps", 0, [run.iterations for run in part]),
            ("seconds", 2, [run.seconds for run in part]),
            ("highest T in iron", 2, [run.highest for run in part]),
        ):
            cells = " | ".join(f"{value:.{digits}f}" for value in np.quantile(values, levels, method="higher"))
            out.append(f"| {what}, {name} | {cells} |")
    out += [""] if failed else []
    out += [f"- seed {r.seed}, {'current' if r.loaded else 'no current'}: {r.status}. {r.reason}" for r in failed]
    return out


def main() -> None:
    parser = argparse.ArgumentParser(description="Convergence of random designs: outcomes, Newton steps, seconds.")
    parser.add_argument("--count", type=int, default=COUNT, help="how many designs")
    parser.add_argument("--seed", type=int, default=SEED, help="of the first; the others follow")
    parser.add_argument("--write", action="store_true", help=f"write {PAGE.relative_to(TOP)}")
    arguments = parser.parse_args()
    # Asked first: the run is of what is loaded now.
    command = ["git", "-C", str(TOP), "rev-parse", "--short", "HEAD"]
    commit = subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip() or "unknown"
    library = standard()
    found: list[Run] = []
    for seed in range(arguments.seed, arguments.seed + arguments.count):
        found += runs(seed, library)
    text = "\n".join(lines(found))
    print(text)
    if arguments.write:
        options = f"--count {arguments.count} --seed {arguments.seed} --write"
        PAGE.write_text(
            "# Random designs\n\n"
            f"Written by `python benchmarks/robustness.py {options}` at commit {commit}.\n"
            "Each design is solved from no field at no current, and at a current of 1 to 1000 A per mm² of the\n"
            "winding's section; bounds are those of `random_design` there. Seconds are the clock's, with the mesh and\n"
            "the coils' integrals, in one thread, on a machine with other work on it.\n\n" + text + "\n",
            encoding="utf-8",
        )


if __name__ == "__main__":
    main()
