"""Iron against its knee and magnets against their coercivity, part by part."""

from __future__ import annotations

import numpy as np
import pytest

from fluxbore.design.bh_curve import MU_0, BHCurve
from fluxbore.fem.field_loads import KNEE_PRICE, KNEE_RISE, Load, knee, tubular_loads
from fluxbore.fem.tubular import TubularSolution, demagnetised_fraction

COERCIVITY = 6e5


@pytest.fixture(scope="module")
def loads(mid_stroke: TubularSolution) -> dict[str, Load]:
    return {item.name: item for item in tubular_loads(mid_stroke, COERCIVITY)}


def test_knee_of_froehlich_s_curve() -> None:
    """B = J H/(a + H) + μ0 H, whose knee is found on the formula itself; catches a knee of the initial permeability."""
    h = np.concatenate(([0.0], np.geomspace(5.0, 2e5, 400)))
    j, a = 2.0, 300.0
    b = j * h / (a + h) + MU_0 * h
    fine = np.geomspace(100.0, 1e5, 200_001)
    price = np.interp(KNEE_RISE * (j * fine / (a + fine) + MU_0 * fine), b, h) / fine
    at = fine[np.argmax(price >= KNEE_PRICE)]
    expected = j * at / (a + at) + MU_0 * at
    assert knee(BHCurve("made up", tuple(b.tolist()), tuple(h.tolist()), "a formula")) == pytest.approx(
        expected, rel=0.01
    )


def test_share_beyond_is_the_demagnetised_fraction(mid_stroke: TubularSolution, loads: dict[str, Load]) -> None:
    """Catches a load without the volume's weights, and a magnet that counts twice."""
    magnets = [item for item in loads.values() if item.kind == "magnet"]
    assert len(magnets) == 1
    expected = demagnetised_fraction(mid_stroke, COERCIVITY)
    assert 0 < expected < 1
    assert magnets[0].beyond == pytest.approx(expected, rel=1e-12)
    assert magnets[0].limit == COERCIVITY


def test_yoke_s_mean_is_that_of_its_volume(mid_stroke: TubularSolution, loads: dict[str, Load]) -> None:
    """The mean of |B| by a sum over the whole mesh's points; catches another region's cells."""
    cells = mid_stroke.cells
    names = [region.name for region in mid_stroke.section.regions]
    own = np.flatnonzero(cells.region == names.index("back yoke"))
    size = np.hypot(*(part[own] for part in cells.fields(mid_stroke.solution.psi)))
    weight = cells.weight[own]
    yoke = loads["back yoke"]
    assert yoke.kind == "iron"
    assert yoke.mean == pytest.approx(float(np.sum(weight * size) / np.sum(weight)), rel=1e-12)
    assert yoke.mean < yoke.high <= yoke.largest == pytest.approx(float(size.max()))
    below = float(weight[size <= yoke.high].sum() / weight.sum())
    assert below == pytest.approx(0.99, abs=0.002)


def test_parts_of_one_name_stand_together(mid_stroke: TubularSolution, loads: dict[str, Load]) -> None:
    """Catches a line for each of many magnets, and a count of materials for one of parts."""
    stems = [item.region.name.rstrip("0123456789 ") for item in mid_stroke.section.rectangles]
    assert len(loads) < len(stems)
    for name, item in loads.items():
        assert item.count == stems.count(name)
