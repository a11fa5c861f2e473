"""Random tubular designs over wide bounds: each converges or says why not."""

import sys
from pathlib import Path

import numpy as np
import pytest

from fluxbore.design.materials import standard
from fluxbore.fem.magnetostatics import Settings

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))

from robustness import lines, random_design, runs

LIBRARY = standard()


def test_random_designs_converge() -> None:
    """Catches a Newton iteration that needs a motor like the published one: thin yokes, tiny gaps, deep saturation."""
    found = [run for seed in range(12) for run in runs(seed, LIBRARY)]
    assert [run.reason for run in found if run.status != "converged"] == []
    assert max(run.highest for run in found) > 2.5, "saturated ones are among them"


def test_random_designs_pass_the_check_of_a_specification() -> None:
    """Catches bounds that the program itself would refuse, and bounds that are not wide: extremes are drawn."""
    designs = [random_design(seed, LIBRARY) for seed in range(500)]
    for design in designs:
        design.actuator.check()
    actuators = [design.actuator for design in designs]
    yokes = [actuator.back_yoke.thickness for actuator in actuators]
    rings = [actuator.mover.ring_width / actuator.mover.pole_pitch for actuator in actuators]
    assert min(yokes) < 0.1e-3
    assert max(yokes) > 10e-3
    assert min(rings) == 0
    assert max(rings) > 0.9
    assert {actuator.mover.pole_pairs for actuator in actuators} == set(range(1, 11))
    density = [
        np.linalg.norm(list(design.currents.values())) * design.actuator.turns_per_coil / design.actuator.coil_area
        for design in designs
    ]
    assert max(density) > 5e8
    assert len({a.back_yoke.material for a in actuators}) == 4
    assert len({a.mover.magnet for a in actuators}) == 8


def test_a_failure_carries_its_reason() -> None:
    """Catches a failure that is counted but not told: too few steps are said to be too few, with the seed."""
    found = runs(3, LIBRARY, Settings(max_iterations=1))
    assert {run.status for run in found} == {"iteration limit"}
    text = "\n".join(lines(found))
    assert "Designs that failed: 1." in text
    assert "- seed 3, current: iteration limit. Newton's iteration ended with status 'iteration limit'" in text


@pytest.mark.parametrize("seed", [1, 2])
def test_a_seed_is_a_design(seed: int) -> None:
    """Catches a generator that is not the seed's alone: what a table says must be found again."""
    assert random_design(seed, LIBRARY) == random_design(seed, LIBRARY)
    assert random_design(seed, LIBRARY) != random_design(seed + 10, LIBRARY)
