"""The prototype's numbers: each has a source or a reason, and they agree with one another."""

import math

import pytest

from fluxbore.design.dynamics.rotlin_parameters import (
    RotLinParameters,
    parameter_table,
    rotlin_controller,
    rotlin_stand,
)

PARAMETERS = RotLinParameters()


def test_every_number_has_a_source_or_a_reason():
    """Catches a value that slips in as if it had been published."""
    rows = parameter_table(PARAMETERS)
    assert all(bool(row.source) != bool(row.assumed) for row in rows)
    assert all(row.symbol and row.unit for row in rows)
    assert {row.name for row in rows if row.assumed} == {
        "guide_friction",
        "guide_stiffness",
        "guide_damping",
        "angle_count",
    }


def test_the_table_follows_the_parameters():
    changed = {row.name: row.value for row in parameter_table(RotLinParameters(mass=3.0))}
    assert changed["mass"] == 3.0


def test_the_published_transfer_ratio_is_the_pitchs():
    assert PARAMETERS.transfer_ratio == pytest.approx(8.19e-4, rel=1e-3)
    assert PARAMETERS.pitch == pytest.approx(5.1429e-3, rel=1e-5)


def test_the_guides_never_gain_work():
    """Bristles are passive up to 4 F_C/sigma_1, which must lie above the speeds of the steps, 45 mm/s at 100 N."""
    guides = rotlin_stand(PARAMETERS).guides
    assert 4 * guides.level / guides.damping > 0.1
    friction = rotlin_controller(PARAMETERS).friction
    assert friction.level == pytest.approx(guides.level)
    assert guides.damping < 2 * math.sqrt(guides.stiffness * PARAMETERS.mass)
