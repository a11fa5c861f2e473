"""What holds a lead screw together: that it fits anywhere in the stroke, weighs what the figures say, and is smooth."""

import math
from pathlib import Path

import numpy as np
import pytest

from fluxbore.actuators import assembly_of
from fluxbore.design.errors import DesignError
from fluxbore.design.spec import Spec, load
from fluxbore.geometry import outline
from fluxbore.geometry.assembly import Assembly, clearance, interferences
from fluxbore.geometry.lead_screw_fittings import FittingMasses, fitting_masses
from fluxbore.geometry.mass import part_masses, total
from fluxbore.geometry.part import Part
from fluxbore.optimize.lead_screw_common import common_figures
from fluxbore.optimize.lead_screw_field import magnetised

MM = 1e-3
ROTLIN = Path(__file__).parents[2] / "examples" / "rotlin.toml"
PAIRS = {"translator end", "rotor clamp ring", "rotor hub", "bearing", "end shield"}


@pytest.fixture(scope="module")
def spec() -> Spec:
    return load(ROTLIN)


@pytest.fixture(scope="module")
def whole(spec: Spec) -> Assembly:
    return assembly_of(spec)


def turned_part(whole: Assembly, name: str) -> Part:
    part = whole.part(name)
    assert isinstance(part, Part)
    return part


def masses(overrides: dict[str, str]) -> FittingMasses:
    spec = load(ROTLIN, overrides)
    return fitting_masses(spec.actuator, spec.materials)


@pytest.mark.parametrize("place", [0.0, 1.0])
def test_nothing_runs_into_anything_at_the_ends_of_the_stroke(spec: Spec, place: float) -> None:
    """And the holders' grip is beyond the mover wherever that is."""
    found = assembly_of(spec, place)
    assert interferences(found) == ()
    moving = [z for part in found.parts if part.group == "mover" for _, z in part.profile]
    ends = [z for part in found.parts if part.role == "translator end" for _, z in part.profile]
    grip = 1.5 * 17.45 * MM
    assert min(ends) + grip < min(moving)
    assert max(moving) < max(ends) - grip
    rotor = [part for part in found.parts if part.group == "mover"]
    assert min(clearance(found.part("translator end, upper"), part) for part in rotor) >= 0.8 * MM


def test_what_holds_lies_against_what_it_holds(whole: Assembly) -> None:
    """Flange and magnets, clamp ring and iron, hub and frame, bearing and both of its seats: no gap."""
    for first, second in (
        ("translator end, upper", "translator magnet N"),
        ("translator end, lower", "translator iron"),
        ("rotor clamp ring, upper", "rotor iron"),
        ("rotor clamp ring, lower", "rotor magnet S"),
        ("rotor hub, upper", "rotor frame"),
        ("bearing, upper", "rotor hub, upper"),
        ("bearing, lower", "end shield, lower"),
        ("end shield, upper", "motor stator"),
    ):
        assert clearance(whole.part(first), whole.part(second)) == 0, (first, second)


def test_parts_come_in_pairs_and_have_fits(whole: Assembly) -> None:
    for role in PAIRS:
        lower, upper = (turned_part(whole, f"{role}, {side}") for side in ("lower", "upper"))
        turned_over = sorted((r, -z) for r, z in upper.profile)
        assert np.array(turned_over) == pytest.approx(np.array(sorted(lower.profile)))
        assert upper.fits or upper.bought
    bearing = turned_part(whole, "bearing, upper")
    assert bearing.bought == "deep groove ball bearing 61809, 45 mm x 58 mm x 7 mm"
    assert "actuator.carried_mass" in bearing.note
    assert len(turned_part(whole, "end shield, upper").axial_holes) == 6
    assert "M8 x 16" in turned_part(whole, "translator end, upper").note


def test_figures_have_the_fittings_in_them(spec: Spec, whole: Assembly) -> None:
    """Masses of the parts list; inertia by slices of the outlines, of what turns and of nothing else."""
    bare = load(ROTLIN, {"actuator.fittings": "none"})
    held, without = (common_figures(each, magnetised(each)) for each in (spec, bare))
    rows = part_masses(whole, spec.materials)
    assert total(rows, "mover") + whole.carried_mass == pytest.approx(held.moving_mass, rel=1e-12)
    assert total(rows) + whole.carried_mass == pytest.approx(held.total_mass, rel=1e-12)
    turned = 0.0
    for role in ("rotor clamp ring", "rotor hub"):
        part = turned_part(whole, f"{role}, upper")
        low, high = (limit(z for _, z in part.profile) for limit in (min, max))
        step, density = (high - low) / 4_000, spec.materials[part.material].density
        for i in range(4_000):
            for inner, outer in outline.spans(part.profile, low + (i + 0.5) * step):
                z = low + (i + 0.5) * step
                turned += 2 * density * math.pi / 2 * (outline.at(outer, z) ** 4 - outline.at(inner, z) ** 4) * step
    assert held.rotor_inertia - without.rotor_inertia == pytest.approx(turned, rel=1e-4)
    assert held.length == pytest.approx(2 * max(z for part in whole.parts for _, z in part.profile))
    # Stall force and spring are the field's alone.
    assert spec.actuator.magnetised(spec.materials, 293.15) == bare.actuator.magnetised(bare.materials, 293.15)


def test_nothing_is_drawn_that_is_not_asked_for() -> None:
    """An older specification: its parts, and what they weigh."""
    assert {part.role for part in assembly_of(load(ROTLIN, {"actuator.fittings": ""})).parts}.isdisjoint(PAIRS)
    assert masses({"actuator.fittings": ""}) == FittingMasses()


def test_a_solid_translator_is_bored_for_its_ends() -> None:
    """What the spigots fill of the same aluminium was bored out: only what lies beyond its length is added."""
    solid = load(ROTLIN, {"actuator.translator.thickness": ""})
    whole = assembly_of(solid)
    assert interferences(whole) == ()
    carrier, end = turned_part(whole, "translator carrier"), turned_part(whole, "translator end, upper")
    assert min(r for r, _ in carrier.profile) == 0
    assert max(r for r, z in end.profile if z < 42.4 * MM) == pytest.approx(9.95 / 2 * MM)
    outside = tuple((r, max(z, 42.5 * MM)) for r, z in end.profile)
    density = solid.materials["aluminium 6061"].density
    added = fitting_masses(solid.actuator, solid.materials).fixed
    assert added == pytest.approx(2 * density * outline.turned(outside)[0], rel=1e-9)


def test_a_bearing_that_does_not_fit_is_one_sentence() -> None:
    with pytest.raises(DesignError, match=r"^actuator\.rotor\.bearing must have a bore between 40\.25 mm, .* 61811 "):
        assembly_of(load(ROTLIN, {"actuator.rotor.bearing": "61811"}))
    with pytest.raises(DesignError, match=r"got 61808 with 40 mm\.$"):
        masses({"actuator.rotor.bearing": "61808"})


@pytest.mark.parametrize("key", ["rotor.length", "motor.length", "gap", "translator.length", "pitch"])
def test_masses_have_no_kink_where_lengths_are_alike(key: str) -> None:
    """The frame is as long as the motor: what follows the longer of them must not jump in its slope."""
    name = f"actuator.{key}"
    base = load(ROTLIN, {"actuator.rotor.bearing": ""})
    value = base.number(name)

    def at(share: float) -> tuple[float, ...]:
        spec = load(ROTLIN, {"actuator.rotor.bearing": "", name: f"{value * (1 + share) * 1e3!r} mm"})
        found = fitting_masses(spec.actuator, spec.materials)
        return found.fixed, found.moving, found.inertia, found.length

    step = 1e-4
    before, here, after = (at(share) for share in (-step, 0.0, step))
    for low, middle, high in zip(before, here, after, strict=True):
        assert abs(high + low - 2 * middle) < 0.05 * abs(high - low) + 1e-9 * abs(middle)
