"""A lead screw whose iron saturates: its force between the displacements that were solved; ten fields of many steps."""

from pathlib import Path

import pytest

from fluxbore.design.spec import load
from fluxbore.fem.helical import solve
from fluxbore.fem.helical_force import force
from fluxbore.optimize.lead_screw_field import magnetised, periods, section, solve_field

pytestmark = pytest.mark.full

ROTLIN = Path(__file__).parents[2] / "examples" / "rotlin.toml"
IRON = {f"actuator.{member}.iron_thickness": 1e-3 for member in ("translator", "rotor")}


def test_saturated_iron_bends_the_force() -> None:
    """Iron of 1 mm behind a pitch of 10 mm: the series, even sine and all, against fields at other displacements.

    Catches a mirror about the quarter of the pitch, which saturation breaks by 2 %, and a peak that is taken there.
    """
    spec = load(ROTLIN).with_values({**IRON, "actuator.pitch": 10e-3, "actuator.translator.thickness": 10e-3})
    screw = magnetised(spec)
    field = solve_field(spec, screw)
    before, after = (force(solve(section(spec, screw, share * screw.pitch))) * periods(screw) for share in (0.16, 0.34))
    assert after > 1.02 * before
    assert field.series.force(0.16 * screw.pitch) == pytest.approx(before, rel=1e-3)
    assert field.series.force(0.34 * screw.pitch) == pytest.approx(after, rel=1e-3)
    assert field.top is not None
    assert field.stall.section.displacement > 0.25 * screw.pitch
    assert force(field.stall) > force(field.samples[0])
