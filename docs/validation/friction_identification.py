"""Writes docs/validation/friction_identification.md and examples/ipehla-friction.csv. Run from the repository's top.

Takes a minute on one core. `--check` writes nothing and compares the page from its first table on.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import fluxbore
from fluxbore.design.dynamics.contact_force import FREQUENCIES
from fluxbore.design.dynamics.contact_force_plant import ContactForcePlant
from fluxbore.design.dynamics.force_map import ForceMap
from fluxbore.design.dynamics.friction_run import PRESSURES, friction_runs
from fluxbore.design.friction import SealFriction, seal_friction
from fluxbore.design.friction_identification import identify_friction
from fluxbore.design.friction_points import FrictionPoints, window_friction
from fluxbore.design.identification import Estimate, Identified

TOP = Path(__file__).parent.parent.parent
TARGET = Path(__file__).with_suffix(".md")
EXAMPLE = TOP / "examples" / "ipehla-friction.csv"

Floats = NDArray[np.float64]

LAW = SealFriction(0.182, 0.127, 20.5, 0.00132, 0.0)
"""Table IV."""
AREA = 20.6e-6
"""m^2, Table III."""
STROKE = 1.05e-3
"""m, inferred from the paper's figures."""
NOISE, TRIALS, SEED = 0.1, 200, 1
RUN_SEEDS = (1, 2, 3, 4, 5)

TRUTH = {
    "static_coefficient": LAW.static_coefficient,
    "coulomb_coefficient": LAW.coulomb_coefficient,
    "contact_force": LAW.contact_force,
    "stribeck_speed": LAW.stribeck_speed,
    "coulomb_force": LAW.coulomb_coefficient * LAW.contact_force,
}
SYMBOLS = ("mu_S", "mu_C", "F_0", "v_s", "mu_C F_0")


@dataclass(frozen=True)
class Tally:
    """Of one parameter over the trials, relative: root mean square error, the mean of the standard errors that they
    state, the largest error, the share within 5 %; in how many of them the 95 % interval held the true value."""

    error: float
    stated: float
    worst: float
    within: float
    covered: int


def trials(count: int = TRIALS, seed: int = SEED, noise: float = NOISE, both: bool = True) -> dict[str, Tally]:
    """(6) with Table IV at eight pressures and twelve speeds, `noise` (N) on each point.

    both : whether each direction is a point by itself, or each run is one, half the difference of both.
    """
    speeds = 2 * STROKE * np.array(FREQUENCIES)
    v, P = (each.ravel() for each in np.meshgrid(np.concatenate((speeds, -speeds)) if both else speeds, PRESSURES))
    clean = seal_friction(LAW, AREA, P, v)
    random = np.random.default_rng(seed)
    found = [
        estimates(
            identify_friction(FrictionPoints(v, P, clean + random.normal(0, noise, len(v)), f"trial {number}"), AREA)
        )
        for number in range(count)
    ]
    table = {}
    for name, value in TRUTH.items():
        errors = np.array([trial[name].value / value - 1 for trial in found])
        table[name] = Tally(
            float(np.sqrt(np.mean(errors**2))),
            float(np.mean([trial[name].standard_error for trial in found])) / value,
            float(np.max(np.abs(errors))),
            float(np.mean(np.abs(errors) <= 0.05)),
            sum(trial[name].low <= value <= trial[name].high for trial in found),
        )
    return table


def estimates(found: Identified) -> Mapping[str, Estimate]:
    return {**found.parameters, **found.derived}


def plant() -> ContactForcePlant:
    """The test stand of examples/ipehla.toml. No current flows in these runs and the stator is smooth, so that a map
    without cogging serves."""
    spec = fluxbore.load(TOP / "examples" / "ipehla.toml")
    position = np.array([spec.number(f"operating_point.{end}_position") for end in ("first", "last")])
    mass = fluxbore.evaluate(spec, "network").performance.moving_mass
    return ContactForcePlant.from_values(
        spec.actuator, spec.values, ForceMap(position, np.full(2, 8.0), np.zeros(2)), mass
    )


def experiment(seed: int, corrected: bool) -> tuple[FrictionPoints, Identified]:
    """The paper's identification run in simulated time, with or without the thrust of the breathing chamber."""
    stand = plant()
    area = stand.chamber.area if corrected else 0.0
    points = window_friction(friction_runs(stand, seed), f"seed {seed}", piston_area=area)
    return points, identify_friction(points, stand.seal.area)


def example(points: FrictionPoints, seed: int) -> str:
    """Points of the simulated run with the scatter from run to run that a bench has and the simulation does not."""
    scatter = np.random.default_rng(seed).normal(0, NOISE, len(points.friction))
    rows = [
        f"{v * 1e3:.3f}, {P * 1e-6:.5f}, {f:.3f}"
        for v, P, f in zip(points.velocity, points.pressure, points.friction + scatter, strict=True)
    ]
    return "\n".join(
        [
            "# Simulated, not measured: the identification run of Nakata and Noda (2023), Sec. IV-C, on the test stand",
            f"# of examples/ipehla.toml with Table IV, seed {seed}; scatter of {NOISE:g} N (one sigma) added.",
            "# A row is a run of ten round trips: half the difference of the load cell's mean forces in both",
            "# directions, between -0.8 and -0.2 mm. Written by docs/validation/friction_identification.py.",
            "velocity [mm/s], pressure [MPa gauge], force [N]",
            *rows,
            "",
        ]
    )


def page() -> tuple[str, str]:
    """The page and the example."""
    commit = subprocess.run(
        ["git", "-C", TOP, "log", "-1", "--format=%h"], capture_output=True, text=True
    ).stdout.strip()
    directions, whole = trials(), trials(both=False)
    tallies = "\n".join(
        f"| {points} | {symbol} | {one.error:.1%} | {one.stated:.1%} | {one.worst:.1%} | {one.within:.1%} "
        f"| {one.covered} |"
        for points, found in ((192, directions), (96, whole))
        for symbol, one in zip(SYMBOLS, found.values(), strict=True)
    )
    beyond = 1 - whole["stribeck_speed"].within
    rows, kept = [], None
    for corrected in (False, True):
        for seed in RUN_SEEDS:
            points, found = experiment(seed, corrected)
            kept = points if corrected and kept is None else kept
            cells = [f"{estimates(found)[name].value / value - 1:+.2%}" for name, value in TRUTH.items()]
            what = "thrust taken off" if corrected else "as the paper says"
            rows.append(f"| {what} | {seed} | {' | '.join(cells)} | {found.residual_deviation:.4f} N |")
    assert kept is not None
    heads = " | ".join(SYMBOLS)
    text = f"""# Identifying the friction law: errors and coverage

Written by `python docs/validation/friction_identification.py` at commit {commit}.

## Scatter of {NOISE} N

Equation (6) with Table IV at eight pressures from 0 to 0.6 MPa and twelve speeds of 2 f x 1.05 mm, with normal scatter
of {NOISE} N on each point, {TRIALS} trials, seed {SEED}. 192 points are each direction by itself, with scatter of its
own; 96 are one for each run, as half the difference of both directions gives it. The contact area is known. Errors are
relative; "covered" counts the trials whose 95 % interval holds the true value (90 to 98 % of 200 are 180 to 196).

| points | parameter | rms error | stated standard error | largest error | trials within 5 % | covered of {TRIALS} |
|---:|---|---:|---:|---:|---:|---:|
{tallies}

Within 5 % is a matter of the root mean square, not of every trial: with a point for each run {beyond:.0%} of the trials
have v_s further off. The errors are those that the trials state of themselves, and the least that any unbiased estimate
of these data can have (the bound of Cramer and Rao, for normal scatter). mu_C and F_0 trade off against each other
(correlation -0.98); their product, the friction without pressure, is known better.

## The paper's run, simulated

The test stand of `examples/ipehla.toml` at eight pressures and twelve frequencies, ten round trips each; the window
from -0.8 to -0.2 mm, half the difference of the mean forces in both directions. Errors of the parameters against the
plant's:

| window average | seed | {heads} | scatter about (6) |
|---|---:|---:|---:|---:|---:|---:|---:|
{chr(10).join(rows)}

- The averages alone take part of the chamber's thrust for friction. The chamber breathes through a slow valve, so its
  pressure is lower while the mover advances than while it goes back. That grows with the pressure, so it comes out as
  a larger mu_C and a smaller F_0. Whether the paper took it off is not said; its parameters may hold some of it.
  `window_friction` takes it off where it knows the piston's area.
- With the thrust taken off, a bias below one per cent stays: 0.2 mm after a turn the bristles have not quite come
  round. A window from -0.7 to -0.35 mm, or bristles ten times as stiff, leave less than a tenth of a per cent.
- The scatter of these runs is the load cell's, averaged over many samples, and much below {NOISE} N. The intervals
  follow from the scatter and know nothing of the bias.
"""
    return text, example(kept, RUN_SEEDS[0])


if __name__ == "__main__":
    text, table = page()
    if "--check" in sys.argv[1:]:
        old = TARGET.read_text(encoding="utf-8")
        raise SystemExit(0 if text.partition("\n## ")[2] == old.partition("\n## ")[2] else 3)
    TARGET.write_text(text, encoding="utf-8")
    EXAMPLE.write_text(table, encoding="utf-8")
