"""The hybrid actuator's details: that they are to rule, clear of one another, and give way where room is short."""

import dataclasses
import itertools
import math
from typing import Any

import pytest
from actuators import table_ii
from hypothesis import example, given
from hypothesis import strategies as st

from fluxbore.design import seal_gland
from fluxbore.design.air_ports import AIR_PORTS
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.materials import standard
from fluxbore.design.threads import SCREWS
from fluxbore.geometry import assembly as geometry
from fluxbore.geometry import hybrid_layout as layout
from fluxbore.geometry import hybrid_parts
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.mass import part_masses, total
from fluxbore.geometry.part import Part

MM = 1e-3


def changed(section: str, **values: Any) -> HybridActuator:
    actuator = table_ii()
    part: Any = getattr(actuator, section)
    new: dict[str, Any] = {section: dataclasses.replace(part, **values)}
    return dataclasses.replace(actuator, **new)


def drawn(actuator: HybridActuator) -> Assembly:
    return hybrid_parts.assembly(actuator, actuator.mid_stroke)


def turned(whole: Assembly, name: str) -> Part:
    part = whole.part(name)
    assert isinstance(part, Part)
    return part


def weight(actuator: HybridActuator) -> float:
    return total(part_masses(drawn(actuator), standard()))


def test_threads_have_the_core_of_their_standards() -> None:
    """ISO 724 and ISO 228-1, mm; the bore beneath a port is narrower than its thread."""
    cores = {"M2": 1.567, "M2.5": 2.013, "M3": 2.459, "M4": 3.242, "M5": 4.134, "M6": 4.917, "M8": 6.647, "M10": 8.376}
    assert {name: SCREWS[name].core / MM for name in cores} == pytest.approx(cores, abs=1.1e-3)
    ports = {"M5": 4.134, "G1/8": 8.566, "G1/4": 11.445}
    assert {name: port.core / MM for name, port in AIR_PORTS.items()} == pytest.approx(ports, abs=1e-4)
    assert all(port.flow < port.core < port.diameter for port in AIR_PORTS.values())


def test_every_seal_is_squeezed_stretched_and_filled_to_rule() -> None:
    """The static rings by 20 % and the rod's by 14 %; each touches what it seals and shares no volume with it."""
    actuator = table_ii()
    ring, guide = layout.spigot(actuator).ring, layout.rod_guide(actuator)
    assert ring is not None
    assert guide is not None
    assert seal_gland.check_gland(ring.gland).squeeze == pytest.approx(0.2)
    assert seal_gland.check_gland(guide.ring.gland).squeeze == pytest.approx(0.14)
    whole = drawn(actuator)
    for name, inside, outside in (
        ("O-ring, cap end", "end cap, cap end", "cylinder tube"),
        ("O-ring, rod end", "end cap, rod end", "cylinder tube"),
        ("rod seal", "shaft", "end cap, rod end"),
    ):
        for other in (inside, outside):
            assert geometry.clearance(turned(whole, name), turned(whole, other)) == pytest.approx(0, abs=1e-9)
    assert {(one.first, one.second) for one in geometry.interferences(whole)} == set(
        itertools.product(["cylinder tube"], ["piston, cap side", "piston, rod side"])
    )


def test_a_port_is_a_thread_above_a_narrower_bore_or_a_plain_drilling() -> None:
    """G1/8 is as deep as the flange allows; a plain port goes through as one hole."""
    ports = [turned(drawn(table_ii()), f"end cap, {end} end").holes[:2] for end in ("cap", "rod")]
    for thread, bore in ports:
        assert (thread.thread, bore.thread) == ("M5 x 6", "")
        assert (thread.diameter, bore.diameter) == pytest.approx((4.134 * MM, 3 * MM), abs=1e-7)
        assert thread.bottom == pytest.approx(7.5 * MM)
        assert (thread.z, thread.angle) == (bore.z, bore.angle)
    wide = turned(drawn(changed("end_caps", port_thread="G1/8", port_diameter=6 * MM)), "end cap, cap end")
    assert wide.holes[0].thread == "G1/8 x 7.46"  # 13.5 - 5.04 - 1
    plain = turned(drawn(changed("end_caps", port_thread=None, port_diameter=5 * MM)), "end cap, cap end")
    assert [hole.thread for hole in plain.holes if hole.diameter == 5 * MM] == [""]
    assert sum(hole.bottom == 0 for hole in plain.holes) == 1


def test_caps_are_held_by_screws_through_the_tube_and_the_cap_end_mounts_the_whole() -> None:
    """Each tapped hole lies beneath a clearance hole of the tube; bonded caps have neither."""
    whole = drawn(table_ii())
    tapped = [
        (hole.z, hole.angle)
        for end in ("cap", "rod")
        for hole in turned(whole, f"end cap, {end} end").holes
        if hole.thread.startswith("M3")
    ]
    assert sorted(tapped) == sorted((hole.z, hole.angle) for hole in turned(whole, "cylinder tube").holes)
    assert len(tapped) == 8
    mounting = turned(whole, "end cap, cap end").axial_holes
    assert [hole.thread for hole in mounting] == ["M3 x 6"] * 4
    outside = min(z for _, z in turned(whole, "end cap, cap end").profile)
    assert {hole.start for hole in mounting} == {outside}
    bonded = drawn(changed("end_caps", screws=0, mounting_holes=0))
    assert turned(bonded, "cylinder tube").holes == ()
    assert turned(bonded, "end cap, cap end").axial_holes == ()
    assert "bonded" in turned(bonded, "end cap, cap end").note


def test_without_room_details_are_left_out_with_a_note() -> None:
    """Catches an old specification that no longer works, or one that silently lacks its seals."""
    short = drawn(changed("end_caps", nose_length=0.0, port_thread=None, port_diameter=5 * MM))
    assert not {"rod seal", "bush"} & {part.role for part in short.parts}
    assert "no room for a seal and a bush" in turned(short, "end cap, rod end").note
    wide = drawn(changed("end_caps", port_thread=None, port_diameter=9.9 * MM))
    assert turned(wide, "cylinder tube").holes == ()
    assert "bonded" in turned(wide, "end cap, cap end").note
    thin = drawn(changed("piston", length=1.9 * MM))
    assert "snap ring" not in {part.role for part in thin.parts}
    assert "no room for snap rings" in turned(thin, "shaft").note
    assert turned(drawn(changed("back_yoke", back_overhang=0.0)), "back yoke").holes == ()


def test_snap_rings_lie_in_shaft_and_piston_and_leave_the_piston_its_face() -> None:
    whole, wire = drawn(table_ii()), 0.8 * MM
    for side in ("cap side", "rod side"):
        ring, piston = turned(whole, f"snap ring, {side}"), turned(whole, f"piston, {side}")
        assert max(r for r, _ in ring.profile) == pytest.approx(4 * MM + wire / 2)
        assert min(r for r, _ in ring.profile) == pytest.approx(4 * MM - wire / 2)
        for other in (piston, turned(whole, "shaft")):
            assert geometry.clearance(ring, other) == pytest.approx(0, abs=1e-9)
        assert max(r for r, _ in ring.profile) < layout.hub_radius(table_ii())
        assert ring.bought.startswith("snap ring of round wire 0.8, for shafts of 8")


def test_a_long_magnet_is_bonded_of_equal_rings() -> None:
    """10.5 mm in pieces of at most 4 mm: three of 3.5 mm, magnetised alike; nothing gets heavier."""
    cut = changed("mover", longest_magnet=4 * MM)
    pieces = [part for part in drawn(cut).parts if part.role == "magnet"]
    assert len(pieces) == 24
    assert [part.name for part in pieces[:3]] == ["magnet 1.1", "magnet 1.2", "magnet 1.3"]
    for piece in pieces:
        low, high = min(z for _, z in piece.profile), max(z for _, z in piece.profile)
        assert high - low == pytest.approx(3.5 * MM)
    assert [part.note.split(";")[0][-2:] for part in pieces] == (["+z"] * 3 + ["-z"] * 3) * 4
    assert weight(cut) == pytest.approx(weight(table_ii()), rel=1e-12)
    assert layout.segments(changed("mover", longest_magnet=10.5 * MM)) == 1


LENGTHS = [
    (section.name, field.name)
    for section in dataclasses.fields(HybridActuator)
    if section.name != "name"
    for field in dataclasses.fields(getattr(table_ii(), section.name))
    if isinstance(getattr(getattr(table_ii(), section.name), field.name), float)
    and field.name not in ("catalogue_bore", "turns", "remanence", "magnet_permeability")
]


@pytest.mark.parametrize(("section", "key"), LENGTHS, ids=lambda word: word)
def test_the_mass_has_a_slope_along_every_length(section: str, key: str) -> None:
    """Searches differentiate it: catches a size that snaps, and a kink at the prototype itself."""
    value = getattr(getattr(table_ii(), section), key)
    step = 1e-5 * value
    before, here, after = (weight(changed(section, **{key: value + way * step})) for way in (-1, 0, 1))
    assert abs(after + before - 2 * here) < 1e-8 * here


def test_bought_sizes_follow_the_shaft_without_steps() -> None:
    """Catches a catalogue's size that a shaft's diameter snaps to: wire by a tenth, bush by its root and 3/4."""
    step = 1e-3
    wider = changed("shaft", outer_diameter=8 * MM * (1 + step))
    before, after = layout.rod_guide(table_ii()), layout.rod_guide(wider)
    assert before is not None
    assert after is not None
    assert layout.snap_wire(wider) / layout.snap_wire(table_ii()) == pytest.approx(1 + step, rel=1e-9)
    assert after.wall / before.wall == pytest.approx((1 + step) ** 0.5, rel=1e-9)
    assert before.start - after.start == pytest.approx(6 * MM * step, rel=1e-6)
    assert after.ring.gland.bore - before.ring.gland.bore == pytest.approx(8 * MM * step, rel=1e-6)


@given(
    st.sampled_from(["M5", "G1/8", None]),
    st.sampled_from(sorted(SCREWS)),
    st.integers(0, 24),
    st.floats(0.4, 4.0),
    st.floats(0.6, 1.5),
)
@example("M5", "M3", 4, 3.0, 1.0)
def test_drillings_stay_clear_of_one_another(
    port: str | None, thread: str, count: int, section: float, scale: float
) -> None:
    """Pairs of radial holes apart along the axis or around it, unless they share their axis; mounting holes clear of
    the port. Catches screws in the O-ring's groove as well."""
    bore = AIR_PORTS[port].flow if port else 2 * MM
    caps = dataclasses.replace(
        table_ii().end_caps,
        port_thread=port, port_diameter=bore, screw_thread=thread, mounting_thread=thread, screws=count,
        mounting_holes=count, ring_section=section * MM, flange_diameter=27 * MM * max(scale, 0.9),
    )  # fmt: skip
    actuator = dataclasses.replace(table_ii(), end_caps=caps)
    whole = drawn(actuator)
    for name in ("end cap, cap end", "end cap, rod end", "cylinder tube"):
        part = turned(whole, name)
        for one, other in itertools.combinations(part.holes, 2):
            if (one.z, one.angle) != (other.z, other.angle):
                needed = (one.diameter + other.diameter) / 2
                inside = max(layout.passage_diameter(actuator) / 2, min(r for r, _ in part.profile))
                radius = max(one.bottom, other.bottom, inside)
                turn = abs((one.angle - other.angle + math.pi) % (2 * math.pi) - math.pi)
                assert abs(one.z - other.z) >= needed or 2 * radius * math.sin(turn / 2) >= needed * (1 - 1e-9)
        for beside, hole in itertools.product(part.axial_holes, part.holes):
            if hole.bottom == 0 and math.cos(beside.angle) > 1e-9 and hole.angle == 0:
                assert beside.radius * abs(math.sin(beside.angle)) >= (beside.diameter + hole.diameter) / 2
    spigot = layout.spigot(actuator)
    if spigot.screws is not None and spigot.ring is not None:
        edge = spigot.ring.middle + spigot.ring.gland.groove_width / 2
        half = spigot.screws.thread.clearance / 2
        assert edge < spigot.screws.s - half
        assert spigot.screws.s + half <= spigot.length - spigot.lead_in / layout.LEAD_IN + 1e-12
