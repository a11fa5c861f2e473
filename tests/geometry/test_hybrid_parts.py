"""The hybrid actuator's parts: that they are all there, fit one another, and follow the parameters."""

import dataclasses
import itertools
import math
import re
from collections import Counter
from typing import Any

import pytest
from actuators import table_ii
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.errors import DesignError
from fluxbore.design.hybrid import BackYoke, Cylinder, EndCaps, HybridActuator, Mover, Piston, Shaft, Winding
from fluxbore.design.iso286 import limits
from fluxbore.design.threads import SCREWS
from fluxbore.geometry import assembly as geometry
from fluxbore.geometry import hybrid_layout, hybrid_parts
from fluxbore.geometry import part as parts_of

MM = 1e-3


def changed(section: str, **values: float | str) -> HybridActuator:
    actuator = table_ii()
    part: Any = getattr(actuator, section)
    new: dict[str, Any] = {section: dataclasses.replace(part, **values)}
    return dataclasses.replace(actuator, **new)


@st.composite
def actuators(draw: st.DrawFn) -> HybridActuator:
    """Actuators that can be built, of any size: each dimension is drawn between the limits that the others leave."""

    def between(low: float, high: float) -> float:
        return draw(st.floats(low, high, allow_nan=False))

    rod = between(1 * MM, 60 * MM)
    magnet = rod + between(1 * MM, 60 * MM)
    bore = magnet + between(0.02 * MM, 2 * MM)
    tube = bore + between(0.5 * MM, 10 * MM)
    coil = tube + between(0.2 * MM, 20 * MM)
    yoke = coil + between(0.0, 2 * MM)
    pitch, pole_pairs = between(3 * MM, 60 * MM), draw(st.integers(1, 10))
    ring = draw(st.just(0.0) | st.floats(0.03, 0.97)) * pitch
    sets = pole_pairs + draw(st.integers(1, 4))
    stroke, length, overhang = between(1 * MM, 300 * MM), between(2 * MM, 40 * MM), between(0, 20 * MM)
    chamber = 2 * pole_pairs * pitch + stroke + 2 * length
    barrel = max(chamber, 2 * sets * pitch + 2 * overhang) + between(0.1 * MM, 60 * MM)
    fin_length = between(0.1, 0.9) * length
    fin_inner = bore - between(0.1, 1) * min(0.05 * fin_length, 0.8 * (bore - rod))
    fin_outer = bore + between(0.1, 1) * min(0.05 * fin_length, tube - bore - 0.1 * MM)
    # A lip of at most 0.8 of the room above the shaft leaves a tenth of it for the hub, on which the piston seats.
    room = (fin_inner - rod) / 2
    seat = rod + 0.15 * room
    clearance = between(0, 0.2) * (seat - rod) / 2
    port = between(0.05, 0.95) * math.sqrt(seat**2 - (rod + 2 * clearance) ** 2)
    flange = 1.2 * port + between(0.1 * MM, 20 * MM)
    nose = draw(st.just(0.0) | st.floats(0.1 * MM, 60 * MM))
    section, screw, screws = between(0.3 * MM, 4 * MM), draw(st.sampled_from(sorted(SCREWS))), draw(st.integers(0, 12))
    return HybridActuator(
        name="any",
        back_yoke=BackYoke(yoke + between(0.2 * MM, 20 * MM), yoke, overhang, between(0, 1) * overhang, "1010"),
        winding=Winding(coil, sets, sets, 0.05 * MM, "copper"),
        cylinder=Cylinder(tube, bore, bore, barrel, "aluminium 6061"),
        mover=Mover(pitch, ring, pole_pairs, magnet, "N48", 1.4, 1.05, "1010", stroke),
        shaft=Shaft(rod, barrel + flange + nose + between(0, 100 * MM), "stainless steel 304"),
        piston=Piston(length, fin_outer, fin_inner, fin_length, between(0.05, 0.8) * (room - 0.05 * MM), "POM"),
        end_caps=EndCaps(
            tube + between(0.1 * MM, 40 * MM),
            flange,
            port,
            clearance,
            "aluminium 6061",
            None,
            nose,
            section,
            screw,
            screws,
            screw,
            screws,
        ),
    )


def ends(actuator: HybridActuator) -> tuple[float, float]:
    return (
        actuator.mid_stroke - actuator.mover.stroke / 2,
        actuator.mid_stroke + actuator.mover.stroke / 2,
    )


def test_the_prototype_has_every_part_of_the_papers_figure() -> None:
    """Fig. 5 and Table II: 24 coils, 8 magnets, 7 rings and 2 half rings, and what a workshop adds; catches a miscount
    and a name used twice."""
    parts = hybrid_parts.assembly(table_ii(), 0.0).parts
    assert Counter(part.role for part in parts) == {
        "back yoke": 1,
        "coil": 24,
        "cylinder": 1,
        "end cap": 2,
        "shaft": 1,
        "magnet": 8,
        "ring": 7,
        "half ring": 2,
        "piston": 2,
        "O-ring": 2,
        "rod seal": 1,
        "bush": 1,
        "snap ring": 2,
    }
    assert len({part.name for part in parts}) == len(parts) == 54
    coils = [part.name for part in parts if part.role == "coil"]
    assert coils[:4] == ["coil 01 U", "coil 02 V", "coil 03 W", "coil 04 U"]
    assert coils[-1] == "coil 24 W"
    assert {part.material for part in parts if part.group == "mover"} == {"1010", "N48", "POM", "stainless steel 304"}
    assert [part.note for part in parts if part.role == "magnet"][:2] == ["magnetised along +z", "magnetised along -z"]


def test_the_prototypes_volumes_are_those_of_its_drawing() -> None:
    """Hand figures from Table II's diameters and lengths (mm^3)."""
    whole = hybrid_parts.assembly(table_ii(), 0.0)
    hand = {
        "coil 07 U": math.pi / 4 * (24.2**2 - 20**2) * 8,
        "magnet 3": math.pi / 4 * (15.9**2 - 8**2) * 10.5,
        "ring 3": math.pi / 4 * (15.9**2 - 8**2) * 1.5,
        "half ring, rod side": math.pi / 4 * (15.9**2 - 8**2) * 0.75,
        "bush": math.pi / 4 * (10**2 - 8**2) * 6,
    }
    for name, cubic_millimetres in hand.items():
        assert parts_of.volume(whole.part(name)) == pytest.approx(cubic_millimetres * 1e-9, rel=1e-12)


def test_without_ring_width_there_are_magnets_only() -> None:
    parts = hybrid_parts.assembly(changed("mover", ring_width=0.0), 0.0).parts
    assert not {"ring", "half ring"} & {part.role for part in parts}
    assert sum(part.role == "magnet" for part in parts) == 8


def test_the_fins_squeeze_is_the_paper_s_overlap() -> None:
    """The tip's triangle outside the bore, by Pappus: (D_f - D_c')/2 high, as long as the cone takes to get there."""
    actuator = table_ii()
    high = (16.3 - 16.1) / 2
    long = 1.8 * high / ((16.3 - 15.4) / 2)
    expected = 2 * math.pi * (16.1 / 2 + high / 3) * high * long / 2
    squeezes = geometry.interferences(hybrid_parts.assembly(actuator, actuator.mid_stroke))
    assert [(one.first, one.second) for one in squeezes] == [
        ("cylinder tube", "piston, cap side"),
        ("cylinder tube", "piston, rod side"),
    ]
    for one in squeezes:
        assert one.designed
        assert one.volume * 1e9 == pytest.approx(expected, rel=1e-9)


def test_caps_made_to_their_tolerances_squeeze_their_seals_and_clear_the_rod() -> None:
    """General tolerances of 0.2 mm on a groove's floor would take half of the squeeze, and close the rod's bore."""
    actuator = table_ii()
    whole = hybrid_parts.assembly(actuator, 0.0)
    parts = {part.name: part for part in whole.parts if isinstance(part, parts_of.Part)}
    section = actuator.end_caps.ring_section
    for name in ("end cap, cap end", "end cap, rod end"):
        fits = {fit.feature: fit for fit in parts[name].fits}
        floor, spigot = fits["floor of the O-ring"], fits["spigot"]
        room = (spigot.nominal - floor.nominal) / 2
        spread = [change / 2 for change in limits(floor.nominal, floor.tolerance)]
        assert max(abs(change) for change in spread) < 0.1 * (section - room)
    rod, seal, bore = parts["shaft"].fits[0], fits["floor of the rod seal"], fits["clearance of the rod"]
    assert bore.nominal + limits(bore.nominal, bore.tolerance)[0] > rod.nominal + limits(rod.nominal, rod.tolerance)[1]
    slack = (limits(seal.nominal, seal.tolerance)[1] - limits(rod.nominal, rod.tolerance)[0]) / 2
    assert slack < 0.25 * (section - (seal.nominal - rod.nominal) / 2)


def test_a_ground_shaft_as_it_is_sold_keeps_the_drawings_tolerance_and_passes_every_bore() -> None:
    """``--snap catalogue`` names a shaft h6; a sheet that asks for f7 would have it turned down again."""
    parts = [p for p in hybrid_parts.assembly(table_ii(), 0.0).parts if isinstance(p, parts_of.Part)]
    (rod,) = [fit for part in parts if part.role == "shaft" for fit in part.fits]
    low, high = limits(rod.nominal, rod.tolerance)
    sold = limits(rod.nominal, "h6")
    assert low <= sold[0] < sold[1] <= high
    bores = [fit for part in parts for fit in part.fits if fit.feature == "bore" and part.group == "mover"]
    assert bores
    assert all(limits(fit.nominal, fit.tolerance)[0] >= high for fit in bores)


def test_at_the_strokes_ends_the_pistons_touch_the_caps() -> None:
    actuator = table_ii()
    low, high = ends(actuator)
    for position, near, far in ((low, "cap", "rod"), (high, "rod", "cap"), (actuator.mid_stroke, "", "")):
        whole = hybrid_parts.assembly(actuator, position)
        assert not [one for one in geometry.interferences(whole) if not one.designed]
        for side in ("cap", "rod"):
            gap = geometry.clearance(whole.part(f"piston, {side} side"), whole.part(f"end cap, {side} end"))
            expected = {near: 0.0, far: 88 * MM}.get(side, 44 * MM)
            assert gap == pytest.approx(expected, abs=1e-12)
        assert geometry.clearance(whole.part("magnet 1"), whole.part("cylinder tube")) == pytest.approx(0.1 * MM)
        assert geometry.clearance(whole.part("shaft"), whole.part("end cap, rod end")) == pytest.approx(0.05 * MM)


def test_air_has_a_way_from_each_port_to_its_chamber() -> None:
    """The drilling opens into the passage over its whole width; beside the rod the passage has the port's area."""
    actuator = table_ii()
    whole = hybrid_parts.assembly(actuator, 0.0)
    passage = hybrid_layout.passage_diameter(actuator)
    assert passage**2 - (8.1 * MM) ** 2 == pytest.approx((3 * MM) ** 2)
    for cap in (part for part in whole.parts if part.role == "end cap"):
        hole = cap.holes[1]
        bored = [z for r, z in cap.profile if r == passage / 2]
        assert min(bored) < hole.z - hole.diameter / 2 or max(bored) > hole.z + hole.diameter / 2
        assert min(bored) < hole.z < max(bored)
        assert hole.bottom == 0


@given(actuators(), st.floats(0, 1))
def test_any_actuator_that_can_be_built_fits_together(actuator: HybridActuator, share: float) -> None:
    """No overlap but the fins', at any position; the array has no gaps; the pistons touch at the stroke's ends only."""
    low, high = ends(actuator)
    whole = hybrid_parts.assembly(actuator, low + share * (high - low))
    assert not [one for one in geometry.interferences(whole) if not one.designed]
    array = [part for part in whole.parts if part.role in ("magnet", "ring", "half ring")]
    for before, after in itertools.pairwise(array):
        assert max(z for _, z in before.profile) == min(z for _, z in after.profile)
    total = max(z for _, z in array[-1].profile) - min(z for _, z in array[0].profile)
    assert total == pytest.approx(actuator.array_length, rel=1e-12)
    for side, gap in (("cap", share * (high - low)), ("rod", (1 - share) * (high - low))):
        found = geometry.clearance(whole.part(f"piston, {side} side"), whole.part(f"end cap, {side} end"))
        assert found == pytest.approx(gap, abs=2e-10)
    assert all(parts_of.volume(part) > 0 for part in whole.parts)


LENGTHS = [
    (section.name, field.name)
    for section in dataclasses.fields(HybridActuator)
    if section.name != "name"
    for field in dataclasses.fields(getattr(table_ii(), section.name))
    if isinstance(getattr(getattr(table_ii(), section.name), field.name), float)
]


@given(st.sampled_from(LENGTHS), st.floats(0.01, 20))
def test_one_parameter_gone_wild_is_refused_by_name_or_still_fits(which: tuple[str, str], factor: float) -> None:
    """Catches a bad value that gets as far as an outline, an overlap or an error of arithmetic."""
    section, key = which
    actuator = changed(section, **{key: factor * getattr(getattr(table_ii(), section), key)})
    whole, sentence = attempt(actuator)
    if whole is None:
        assert re.match(r"actuator\.\w+\.\w+ must .*; got .*\.$", sentence)
    else:
        assert not [one for one in geometry.interferences(whole) if not one.designed]


def attempt(actuator: HybridActuator) -> tuple[geometry.Assembly | None, str]:
    try:
        return hybrid_parts.assembly(actuator, actuator.mid_stroke), ""
    except DesignError as error:
        return None, str(error)


@pytest.mark.parametrize(
    ("section", "values", "sentence"),
    [
        ("cylinder", {"length": 204 * MM}, r"cylinder\.length must .* back yoke, at least 212 mm; got 204 mm\."),
        (
            "end_caps",
            {"port_diameter": 14 * MM, "port_thread": None},
            r"port_diameter must .* at most 10\.8\d+ mm; got 14 mm\.",
        ),
        ("end_caps", {"rod_clearance": 4 * MM}, r"rod_clearance must .* below 2\.7\d+ mm; got 4 mm\."),
        ("end_caps", {"flange_length": 5 * MM}, r"flange_length must .* at least 6 mm; got 5 mm\."),
        ("end_caps", {"port_thread": "G1/4"}, r"flange_length must .* at least 14\.157 mm; got 12 mm\."),
        (
            "end_caps",
            {"port_thread": "G1/8", "flange_diameter": 20.1 * MM},
            r"flange_diameter must hold .* G1/8, .* 20\.2\d* mm; got 20\.1 mm\.",
        ),
        ("end_caps", {"nose_length": 1e-6}, r"nose_length must .* at least 0\.02 mm; got 0\.001 mm\."),
        (
            "mover",
            {"longest_magnet": 0.2 * MM},
            r"longest_magnet must .* 50 pieces .* at least 0\.21 mm; got 0\.2 mm\.",
        ),
        ("shaft", {"length": 220 * MM}, r"shaft\.length must .* at least 228 mm; got 220 mm\."),
        ("piston", {"fin_outer_diameter": 20 * MM}, r"fin_outer_diameter must .* 20 mm; got 20 mm\."),
        ("piston", {"fin_thickness": 4 * MM}, r"fin_thickness must .* at most 3\.5\d+ mm; got 4 mm\."),
        ("piston", {"fin_inner_diameter": 7 * MM}, r"fin_inner_diameter must .* 8 mm; got 7 mm\."),
        ("piston", {"fin_length": 7.995 * MM}, r"fin_length must .* at most 7\.99 mm; got 7\.995 mm\."),
        ("mover", {"ring_width": 1e-6}, r"ring_width must .* 0\.02 mm; got 0\.001 mm\."),
    ],
)
def test_what_does_not_fit_is_named_with_limit_and_value(section: str, values: dict[str, float], sentence: str) -> None:
    with pytest.raises(DesignError, match=sentence):
        hybrid_parts.assembly(changed(section, **values), 44 * MM)


def test_a_position_beyond_the_stroke_is_refused() -> None:
    with pytest.raises(DesignError, match=r"0 mm to 88 mm; got 89 mm\."):
        hybrid_parts.assembly(table_ii(), 89 * MM)
