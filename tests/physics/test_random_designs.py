"""Random tubular designs over wide bounds: each converges or says why not."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from fluxbore.design.errors import DesignError
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.spec import Spec
from fluxbore.fem.tubular import solve_positions
from fluxbore.geometry.hybrid import cross_section

IRONS = ("1010", "1018", "pure iron", "TEAM 13 steel")


def random_actuator(base: HybridActuator, seed: int) -> HybridActuator:
    """Sizes over two decades, thin and thick yokes, narrow and wide rings, one to ten pole pairs, any iron."""
    rng = np.random.default_rng(seed)

    def log(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    def iron() -> str:
        return str(rng.choice(IRONS))

    shaft = log(1e-3, 50e-3)
    magnets = shaft + 2 * log(0.5e-3, 30e-3)
    bore = magnets + 2 * log(0.02e-3, 1e-3)
    tube = bore + 2 * log(0.1e-3, 5e-3)
    winding = tube + 2 * log(0.5e-3, 15e-3)
    yoke_bore = winding + 2 * (0.0 if rng.random() < 0.2 else log(1e-5, 1e-3))
    yoke = yoke_bore + 2 * log(0.05e-3, 15e-3)
    pitch = log(3e-3, 60e-3)
    ring = 0.0 if rng.random() < 0.1 else float(rng.uniform(0.01, 0.97)) * pitch
    pairs = int(log(1, 10.999))
    sets = max(2, pairs + int(rng.integers(0, 6)))
    mover = replace(
        base.mover,
        pole_pitch=pitch,
        ring_width=ring,
        pole_pairs=pairs,
        outer_diameter=magnets,
        remanence=float(rng.uniform(0.2, 1.5)),
        magnet_permeability=float(rng.uniform(1.0, 1.2)),
        ring_material=iron(),
        stroke=0.5 * pitch,
    )
    coil = 2 * pitch / 3
    overhang = float(rng.uniform(0.1, 3)) * coil
    actuator = replace(
        base,
        back_yoke=replace(
            base.back_yoke,
            outer_diameter=yoke,
            inner_diameter=yoke_bore,
            front_overhang=overhang,
            back_overhang=float(rng.uniform(0.1, 3)) * coil,
            material=iron(),
        ),
        winding=replace(base.winding, outer_diameter=winding, sets_per_phase=sets, turns=100.0 * sets),
        cylinder=replace(base.cylinder, outer_diameter=tube, inner_diameter=bore, length=4 * sets * coil),
        mover=mover,
        shaft=replace(
            base.shaft,
            outer_diameter=shaft,
            length=2 * pairs * pitch + 5 * pitch + 0.1,
            material=iron() if rng.random() < 0.25 else base.shaft.material,
        ),
    )
    if rng.random() < 0.1:
        actuator = replace(actuator, cylinder=replace(actuator.cylinder, material=iron()))
    return actuator


Solved = tuple[str, int, float]


@pytest.fixture(scope="module")
def outcome(spec: Spec) -> Callable[[int], Solved]:
    """(status, Newton steps, residual) of one design at a random position of a random window."""

    def of(seed: int) -> Solved:
        actuator = random_actuator(spec.actuator, seed)
        position = actuator.mid_stroke + float(np.random.default_rng(seed + 10**6).uniform(-2, 2)) * (
            actuator.mover.pole_pitch
        )
        try:
            (item,) = solve_positions(lambda z: cross_section(actuator, z, spec.materials, 293.15), [position])
        except DesignError as error:
            return str(error), 0, 0.0
        if item.convergence.converged:
            assert np.all(np.isfinite(item.thrust_constants()))
            assert np.all(np.isfinite(item.solution.psi))
        return item.convergence.status, item.convergence.iterations, item.convergence.residual

    return of


def test_forty_random_designs_converge(outcome: Callable[[int], Solved]) -> None:
    """Catches a Newton iteration that needs a motor like the published one: thin yokes, tiny gaps, deep saturation."""
    bad = {seed: found for seed in range(40) if (found := outcome(seed))[0] != "converged"}
    assert not bad


@pytest.mark.full
def test_three_hundred_random_designs_converge(outcome: Callable[[int], Solved]) -> None:
    """Catches what forty do not show; prints the distribution of Newton's steps."""
    found = {seed: outcome(seed) for seed in range(1000, 1300)}
    steps = np.array([item[1] for item in found.values()])
    print(f"Newton steps: median {np.median(steps):.0f}, 90 % {np.quantile(steps, 0.9):.0f}, most {steps.max()}")
    bad = {seed: item for seed, item in found.items() if item[0] != "converged"}
    assert not bad
