"""What a lead screw's report is made of: fields at rest and at the stall, and their energies."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fluxbore.design.spec import load
from fluxbore.lead_screw_views import screw_content
from fluxbore.optimize import pitch_curve
from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.evaluation import INVALID, failure
from fluxbore.reports.lead_screw_content import ScrewContent

ROTLIN = Path(__file__).parents[1] / "examples" / "rotlin.toml"
WIDTH = 2.2e-3


@pytest.fixture(scope="module")
def screw() -> ScrewContent:
    """RotLin with gaps between the rotor's magnets; other pitches are another test's."""
    spec = load(ROTLIN, {"actuator.rotor.magnet_width": "2.2 mm", "operating_point.stroke": "80 mm"})
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pitch_curve, "pitch_curve", lambda spec, design: None)
        found = screw_content(spec, evaluate(spec, "network"))
    assert found is not None
    return found


def test_spring_runs_through_the_fields_that_were_solved(screw: ScrewContent) -> None:
    stall = screw.spring.peak[1]
    assert len(screw.samples) > 4
    places = [item.displacement for item in screw.samples]
    assert places == sorted(places)
    for item in screw.samples:
        assert item.force == pytest.approx(float(screw.spring.force(item.displacement)), abs=1e-4 * stall)
    # The closed form takes the space between magnets as permeable as they are.
    fault = (screw.screw.rotor.magnet_permeability - 1) * (1 - 2 * WIDTH / screw.screw.pitch)
    assert stall == pytest.approx(screw.analytic.peak[1], rel=fault)
    assert screw.peak == pytest.approx(screw.spring.peak, rel=1e-3)
    assert screw.rest_under(0.5 * stall) == screw.spring.rest(0.5 * stall)
    assert screw.rest_under(1.01 * screw.peak[1]) is None


def test_energy_of_the_fields_is_the_force_s_work(screw: ScrewContent) -> None:
    assert screw.field_energy == pytest.approx(screw.spring.barrier, rel=1e-3)


def test_outlines_are_the_magnets_where_they_stand(screw: ScrewContent) -> None:
    pitch, stall = screw.screw.pitch, screw.stall.position
    assert screw.rest.position == 0
    assert stall == screw.peak[0]
    for field in (screw.rest, screw.stall):
        rotor = {name: box for name, box in reversed(field.outlines) if name.startswith("rotor magnets")}
        first = rotor["rotor magnets, north"]
        assert np.ptp(first[:, 1]) == pytest.approx(WIDTH)
        assert np.mean(first[:, 1]) == pytest.approx(field.position)
    whole = [box for name, box in screw.rest.outlines if name.startswith("translator magnets")]
    assert len(whole) == 4
    assert all(np.ptp(box[:, 1]) == pytest.approx(pitch / 2) for box in whole)


def test_field_is_strong_in_magnets_and_weak_between_them(screw: ScrewContent) -> None:
    """At rest, in the middle of the gap: north meets north at zero, and nothing stands a quarter of the pitch on."""
    field, pitch = screw.rest, screw.screw.pitch
    middle = screw.screw.radii[1] + screw.screw.gap / 2
    r, z = field.r[field.triangles].mean(axis=1), field.z[field.triangles].mean(axis=1)

    def at(place: float) -> float:
        return float(field.flux_density[np.argmin((r - middle) ** 2 + (z - place) ** 2)])

    assert at(0.0) == pytest.approx(at(pitch / 2), rel=0.05)
    assert at(0.0) > 0.4
    assert at(pitch / 4) < 0.2 * at(0.0)


def test_positions_reach_from_no_engagement_to_no_engagement(screw: ScrewContent) -> None:
    assert screw.engaged[0] == screw.engaged[-1] == 0
    assert max(screw.engaged) == screw.peak[1]
    assert screw.stroke == pytest.approx(80e-3)
    assert screw.iron_force == 192.0


def test_a_design_without_figures_has_none() -> None:
    assert screw_content(load(ROTLIN), failure("fem", INVALID, "It cannot be built.")) is None
