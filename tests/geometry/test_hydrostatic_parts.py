"""The hydraulic cylinder as parts: what meets what, the squeezed ring, masses, and what does not fit."""

import dataclasses
import itertools
import math
from pathlib import Path

import pytest

from fluxbore.actuators import actuator_of
from fluxbore.design.errors import DesignError
from fluxbore.design.hydrostatic_values import HydrostaticDesign
from fluxbore.design.return_element import ConstantReturn, CordReturn, LinearReturn
from fluxbore.design.return_spring_mass import (
    BENDING_STRESS,
    RUBBER_DENSITY,
    SHEAR_MODULUS,
    SHEAR_STRESS,
    SPRING_INDEX,
    STEEL_DENSITY,
    YOUNG_MODULUS,
    least_mass,
)
from fluxbore.design.seal_gland import SealGland, gland_figures
from fluxbore.design.spec import Spec, load
from fluxbore.geometry import assembly as geometry
from fluxbore.geometry import hydrostatic_parts, outline
from fluxbore.geometry import part as parts_of
from fluxbore.geometry.assembly import Assembly, interferences
from fluxbore.geometry.gland_profile import ring_profile
from fluxbore.geometry.part import Part

MM = 1e-3
PREHYDRA = Path(__file__).parents[2] / "examples" / "prehydra.toml"
CYLINDER = "actuator.output_cylinder."
WEIGHED = tuple(f"{name}_cylinder.{leaf}" for name in ("input", "output") for leaf in ("moving_mass", "mass"))


@pytest.fixture(scope="module")
def spec() -> Spec:
    return load(PREHYDRA)


@pytest.fixture(scope="module")
def whole(spec: Spec) -> Assembly:
    return actuator_of(spec).assembly(spec)


def drawn(values: dict[str, str]) -> Assembly:
    found = load(PREHYDRA, values)
    return actuator_of(found).assembly(found)


def radii(part: parts_of.Body, z: float) -> list[float]:
    """Where a horizontal line crosses the outline, from the axis outwards."""
    corners = (*part.profile, part.profile[0])
    pairs = itertools.pairwise(corners)
    return sorted(
        r0 + (r1 - r0) * (z - z0) / (z1 - z0) for (r0, z0), (r1, z1) in pairs if min(z0, z1) < z < max(z0, z1)
    )


def test_the_specified_sizes_are_those_of_the_parts(spec: Spec, whole: Assembly) -> None:
    """Read off the outlines, not off the layout that made them."""
    given = {key: spec.number(CYLINDER + key) for key in ("bore", "wall_thickness", "rod_diameter", "stroke")}
    tube = whole.part("cylinder tube")
    assert radii(tube, 0.0) == pytest.approx([given["bore"] / 2, given["bore"] / 2 + given["wall_thickness"]])
    piston, rod = whole.part("piston"), whole.part("rod")
    assert max(rod.profile)[0] == pytest.approx(given["rod_diameter"] / 2)
    heights = [z for _, z in piston.profile]
    assert min(heights) == pytest.approx(given["stroke"] / 2)
    assert max(heights) - min(heights) == pytest.approx(spec.number(CYLINDER + "piston_length"))
    groove = radii(piston, (min(heights) + max(heights)) / 2)
    assert max(groove) == pytest.approx(spec.number("actuator.seal.groove_diameter") / 2)
    port = whole.part("end cap, cap end")
    assert isinstance(port, Part)
    assert port.holes[0].diameter == spec.number("actuator.port.diameter")


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_no_two_parts_share_a_volume_anywhere_in_the_stroke(spec: Spec, share: float) -> None:
    design: HydrostaticDesign = spec.actuator
    stroke = design.bare.output_cylinder.stroke
    found = hydrostatic_parts.assembly(design, share * stroke)
    assert interferences(found) == ()
    # At both ends of the stroke, and only there, the piston stands on a cap.
    meets = [geometry.clearance(found.part("piston"), found.part(f"end cap, {end} end")) for end in ("cap", "rod")]
    assert [gap == 0 for gap in meets] == [share == 0, share == 1]


def test_a_larger_piston_would_be_found_to_run_into_the_tube(whole: Assembly) -> None:
    """That the test above can fail."""
    piston = whole.part("piston")
    assert isinstance(piston, Part)
    wide = dataclasses.replace(piston, profile=tuple((r * 1.02, z) for r, z in piston.profile))
    parts = tuple(wide if part.name == "piston" else part for part in whole.parts)
    pairs = {(found.first, found.second) for found in interferences(dataclasses.replace(whole, parts=parts))}
    assert ("cylinder tube", "piston") in pairs


def test_the_position_is_within_the_stroke(spec: Spec) -> None:
    with pytest.raises(DesignError, match=r"within the stroke, 0 mm to 152\.4 mm; got 160 mm"):
        hydrostatic_parts.assembly(spec.actuator, 160 * MM)


def area(profile: outline.Profile) -> float:
    following = (*profile[1:], profile[0])
    return abs(sum(r0 * z1 - r1 * z0 for (r0, z0), (r1, z1) in zip(profile, following, strict=True))) / 2


@pytest.mark.parametrize("depth", [1.0 * MM, 1.5 * MM, 1.7 * MM, 2.5 * MM])
def test_the_drawn_ring_fills_its_groove_by_the_share_that_is_computed(depth: float) -> None:
    """By the polygon's area; the deepest groove does not squeeze the ring, which then only lies on its floor."""
    gland = SealGland(14 * MM, 14 * MM - 2 * depth, 4 * MM, 9 * MM, 1.78 * MM)
    ring, figures = ring_profile(gland, 3 * MM), gland_figures(gland)
    assert area(ring) / (gland.groove_width * depth) == pytest.approx(figures.fill, rel=1e-12)
    heights, reach = [z for _, z in ring], [r for r, _ in ring]
    assert (min(heights) + max(heights)) / 2 == pytest.approx(3 * MM)
    assert min(reach) == pytest.approx(gland.groove_diameter / 2)
    squeezed = depth if figures.squeeze > 0 else figures.section
    assert max(reach) - min(reach) == pytest.approx(squeezed)


def test_masses_are_density_times_what_was_added_by_hand(spec: Spec) -> None:
    """Cylinders, cones and drillings of the rod and the tube added up on paper; the rest by `test_solid`'s kernel."""
    masses = hydrostatic_parts.masses(dataclasses.replace(spec.actuator, unweighed=WEIGHED), spec.materials)
    assert set(masses) == set(WEIGHED)
    place = {part.name: part for part in hydrostatic_parts.assembly(spec.actuator, 0.0).parts}
    steel, brass = spec.materials["stainless steel 304"].density, spec.materials["brass"].density
    edge = 0.15 * 6.35 / 2  # the chamfer: what a cone's rim takes off a cylinder, by Pappus
    chamfer = math.pi * edge**2 * (6.35 / 2 - edge / 3) * MM**3
    rod = math.pi / 4 * MM**3 * (3.81**2 * 9 + 6.35**2 * (152.4 + 5.005 + 16 + 1.5 * 6.35)) - chamfer
    assert parts_of.mass(place["rod"], steel) == pytest.approx(steel * rod, rel=1e-9)
    deep = 0.3 * 0.8  # two lead-ins of 20 degrees
    lead_ins = 2 * math.pi * 2.75 * deep**2 * (14.3 / 2 + deep / 3) * MM**3
    tube = math.pi / 4 * MM**3 * (15.9**2 - 14.3**2) * (152.4 + 12 + 2 * 5.005) - lead_ins
    assert parts_of.mass(place["cylinder tube"], brass) == pytest.approx(brass * tube, rel=1e-9)
    moving = sum(parts_of.mass(place[name], spec.materials[place[name].material].density) for name in
                 ("piston", "O-ring", "rod"))  # fmt: skip
    assert masses["output_cylinder.moving_mass"] == pytest.approx(moving)
    assert masses["output_cylinder.mass"] > moving + brass * tube
    # Both cylinders of the PREHydrA are alike.
    assert masses["input_cylinder.mass"] == masses["output_cylinder.mass"]


def test_masses_take_the_place_of_those_that_are_not_given(spec: Spec) -> None:
    design = dataclasses.replace(spec.actuator, unweighed=(*WEIGHED[2:], "return_spring.mass"))
    masses = hydrostatic_parts.masses(design, spec.materials)
    actuator = design.weighed(masses)
    assert actuator.output_cylinder.mass == masses["output_cylinder.mass"]
    assert actuator.input_cylinder.mass == spec.actuator.bare.input_cylinder.mass
    assert actuator.return_element.mass == masses["return_spring.mass"]


def test_the_least_spring_is_that_of_the_wire_that_a_designer_would_wind() -> None:
    """A helical spring from its wire, coil and turns (F = k x, tau = K_s 8 F D/(pi d^3)) weighs what energy says."""
    rate, stroke, preload = 1420.0, 0.1524, 22.5
    force = preload + rate * stroke
    C, K_s = SPRING_INDEX, 1 + 1 / (2 * SPRING_INDEX)
    wire = math.sqrt(8 * K_s * force * C / (math.pi * SHEAR_STRESS))
    turns = SHEAR_MODULUS * wire / (8 * C**3 * rate)
    wound = STEEL_DENSITY * math.pi / 4 * wire**2 * math.pi * C * wire * turns
    assert least_mass(LinearReturn(rate, preload), stroke) == pytest.approx(wound, rel=1e-12)
    # Two of half the stiffness weigh as much as one, and the PREHydrA's some 0.15 kg.
    assert least_mass(LinearReturn(2 * rate, 2 * preload), stroke) == pytest.approx(2 * wound)
    assert 2 * wound == pytest.approx(0.15, abs=0.02)


def test_a_strip_and_a_cord_weigh_what_holds_their_energy() -> None:
    force, stroke, width = 40.0, 0.15, 20 * MM
    thickness = 0.3 * MM
    # A strip bent to sigma holds sigma^2/(6 E) in each volume; so much of it is drawn out over the stroke.
    strip = force * stroke / (BENDING_STRESS**2 / (6 * YOUNG_MODULUS)) / (width * thickness)
    assert least_mass(ConstantReturn(force), stroke) == pytest.approx(STEEL_DENSITY * strip * width * thickness)
    cord = CordReturn(length=0.2, area=50e-6, stretch=1.2, first=0.3e6, second=0.0)
    assert least_mass(cord, stroke) == pytest.approx(RUBBER_DENSITY * 0.2 * 50e-6)


@pytest.mark.parametrize(
    ("key", "value", "sentence"),
    [
        ("output_cylinder.piston_length", "4 mm", r"piston_length must hold the O-ring's groove .* 4\.12985"),
        ("output_cylinder.rod_diameter", "16 mm", r"rod_diameter must not exceed the bore"),
        ("output_cylinder.rod_diameter", "14 mm", r"rod_diameter must leave a wall in the spigot of the rod-end cap"),
        ("output_cylinder.cap_length", "11 mm", r"cap_length must hold the port, .* at least 15\.953 mm; got 11 mm"),
        ("output_cylinder.bleed_thread", "20 mm", r"bleed_thread must leave a wall in the cap, at most 19\.95 mm"),
        ("output_cylinder.bush_wall", "4 mm", r"bush_wall must leave a wall in the rod-end cap, at most 3\.75 mm"),
        ("output_cylinder.bush_wall", "0 mm", r"wiper_width must be 0 mm where there is no bush, .*; got 2 mm"),
        ("output_cylinder.mounting_thread", "M8", r"mounting_thread must leave walls .* 7\.975 mm apart; M8 needs 10"),
        ("port.thread", "M5", r"diameter must be below the core of actuator\.port\.thread M5, 4\.13397 mm; got 4\.5"),
        ("port.diameter", "12 mm", r"port\.diameter must leave a wall in the spigot .* at most 11\.1818 mm"),
        ("seal.groove_width", "1.7 mm", r"groove_width must hold the squeezed O-ring, at least 1\.9"),
        ("seal.groove_diameter", "14.25 mm", r"groove_diameter must be below the piston's diameter"),
    ],
)
def test_what_does_not_fit_is_one_sentence(key: str, value: str, sentence: str) -> None:
    seal = {"ring_inner_diameter": "11 mm", "groove_diameter": "11.29 mm", "groove_width": "2.13 mm"}
    given = {f"actuator.seal.{leaf}": text for leaf, text in seal.items()} if key.startswith("seal") else {}
    with pytest.raises(DesignError, match=sentence) as caught:
        drawn(given | {f"actuator.{key}": value})
    assert str(caught.value).count(". ") == 0
    assert str(caught.value).endswith(".")


def test_a_limit_that_is_named_can_be_built() -> None:
    """At the least length that the sentence tells the parts fit, a little below it they do not."""
    with pytest.raises(DesignError) as caught:
        drawn({f"{CYLINDER}cap_length": "5 mm"})
    least = float(str(caught.value).split("at least ")[1].split(" mm")[0])
    drawn({f"{CYLINDER}cap_length": f"{least + 1e-4} mm"})
    with pytest.raises(DesignError):
        drawn({f"{CYLINDER}cap_length": f"{least - 1e-3} mm"})


def test_a_connectors_stud_finds_its_thread(whole: Assembly) -> None:
    """From the cap's outside to half a millimetre before the passage, as long as the standard's stud of 8 mm."""
    cap = whole.part("end cap, cap end")
    assert isinstance(cap, Part)
    bore, thread = cap.holes
    assert (bore.diameter, thread.diameter) == pytest.approx((4.5 * MM, 8.566 * MM))
    assert thread.thread == "G1/8 x 8"
    assert max(cap.profile)[0] - thread.bottom == pytest.approx(8 * MM)
    assert thread.bottom - 1.1 * 2.25 * MM == pytest.approx(0.5 * MM)
    # The bleed screw's seat opens below the thread's bottom, its own thread begins a wall beyond the port's.
    seat = [r for r, z in cap.profile if z > thread.z - 4.864 * MM and z < thread.z - 1.3 * 2.25 * MM]
    assert max(seat) < thread.bottom - 0.5 * MM


def test_mounting_holes_end_before_the_port(whole: Assembly) -> None:
    cap = whole.part("end cap, cap end")
    assert isinstance(cap, Part)
    assert len(cap.axial_holes) == 4
    for hole in cap.axial_holes:
        assert hole.thread.startswith("M3 x 4.")
        assert cap.holes[1].z - 4.864 * MM - hole.end >= 1 * MM - 1e-12
        assert min(z for _, z in cap.profile) == pytest.approx(hole.start)


def test_what_is_not_asked_for_is_not_drawn() -> None:
    """An older specification: a plain port, no bush, no wiper, no holes."""
    keys = (
        "port.thread",
        "output_cylinder.bush_wall",
        "output_cylinder.wiper_width",
        "output_cylinder.mounting_thread",
    )
    plain = drawn({f"actuator.{key}": "" for key in keys})
    assert {part.name for part in plain.parts}.isdisjoint({"rod bush", "rod wiper"})
    cap = plain.part("end cap, cap end")
    assert isinstance(cap, Part)
    assert [hole.thread for hole in cap.holes] == [""]
    assert cap.axial_holes == ()
    assert max(cap.profile)[0] == max(plain.part("cylinder tube").profile)[0]
    assert interferences(plain) == ()


def test_what_is_bought_has_a_designation(whole: Assembly) -> None:
    bought = {part.name: part.bought for part in whole.parts if part.bought}
    assert set(bought) == {"bleed screw", "rod bush", "rod wiper", "O-ring"}
    assert bought["bleed screw"] == "bleed screw M6, 90 deg seat"
    assert bought["O-ring"].startswith("O-ring AS568-013")
    for part in whole.parts:
        if isinstance(part, Part) and not part.bought:
            assert part.fits, part.name


def test_the_joint_grows_with_the_pressure() -> None:
    """Force on the cap over the spigot's surface stays at the joint's stress."""
    found = drawn({f"{CYLINDER}rated_pressure": "140 bar gauge"})
    heights = [z for _, z in found.part("end cap, rod end").profile]
    spigot = max(heights) - min(heights) - 16 * MM
    shear = 140e5 * math.pi / 4 * (14.3 * MM) ** 2 / (math.pi * 14.3 * MM * spigot)
    assert shear == pytest.approx(5e6)
