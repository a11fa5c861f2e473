"""The hybrid actuator: Table II's derived figures, the identities behind them, and parts that overlap."""

from dataclasses import asdict, replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.errors import DesignError
from fluxbore.design.hybrid_values import resolve
from fluxbore.design.spec import loads
from fluxbore.design.spec_file import template

MM = 1e-3
IPEHLA = loads(template("ipehla"))


def test_derived_figures_of_table_ii():
    """The paper's own derived figures, from its given ones: L = 205 mm, tau_m = 10.5 mm, 24 coils, g_ac = 2.05 mm."""
    actuator = IPEHLA.actuator
    assert actuator.yoke_end - actuator.yoke_start == pytest.approx(205 * MM)
    assert IPEHLA.number("actuator.back_yoke.length") == pytest.approx(205 * MM)
    assert IPEHLA.number("actuator.back_yoke.inner_diameter") == pytest.approx(25 * MM)
    assert IPEHLA.number("actuator.winding.yoke_clearance") == pytest.approx(0.4 * MM)
    assert actuator.magnet_thickness == pytest.approx(10.5 * MM)
    assert actuator.coil_width == pytest.approx(8 * MM)
    assert actuator.coils == 24
    assert actuator.turns_per_coil == 73
    assert actuator.magnets == 8
    assert actuator.array_length == pytest.approx(96 * MM)
    assert actuator.air_gap == pytest.approx(2.05 * MM)
    assert actuator.coil_area == pytest.approx(16.8e-6)
    assert actuator.chamber[1] - actuator.chamber[0] == pytest.approx(200 * MM)
    assert actuator.mid_stroke == pytest.approx(44 * MM)
    assert actuator.middle == pytest.approx(92 * MM)
    assert actuator.back_yoke.thickness == pytest.approx(1 * MM)


def test_the_fixture_and_the_template_are_one_machine(table_ii):
    """Catches a fixture that drifts away from the example that users run."""
    for part in ("winding", "cylinder", "mover", "shaft", "piston"):
        assert asdict(getattr(table_ii, part)) == pytest.approx(asdict(getattr(IPEHLA.actuator, part)))


lengths = st.floats(0.1, 100.0).map(lambda x: x * MM)


@given(lengths, lengths, lengths, lengths, lengths, st.floats(0, 1), st.integers(1, 20), st.floats(1, 1e4), st.data())
def test_identities_hold_whichever_keys_are_given(d_i, thickness, front, back, pitch, share, sets, turns, data):
    """Catches a wrong branch of `resolve`: each choice of given keys must lead to one and the same machine."""
    yoke, winding, mover = "actuator.back_yoke.", "actuator.winding.", "actuator.mover."
    clearance = 0.1 * d_i
    whole = {
        yoke + "outer_diameter": d_i + 2 * thickness,
        yoke + "inner_diameter": d_i,
        yoke + "thickness": thickness,
        yoke + "length": 3 * sets * 2 * pitch / 3 + front + back,
        yoke + "front_overhang": front,
        yoke + "back_overhang": back,
        winding + "outer_diameter": d_i - 2 * clearance,
        winding + "yoke_clearance": clearance,
        winding + "turns": turns,
        winding + "turns_density": turns / (sets * 2 * pitch / 3 * (0.8 - 0.5) * d_i / 2),
        mover + "ring_width": share * pitch,
        mover + "magnet_thickness": (1 - share) * pitch,
    }
    caps = "actuator.end_caps."
    following = {
        caps + "port_diameter": 3e-3,
        winding + "insulated_diameter": 0.44e-3,
        "operating_point.peak_current": 2.0,
    }
    fixed = {
        "actuator.piston.material": "POM",
        winding + "wire_diameter": 0.4e-3,
        "operating_point.current": 2.0,
        winding + "sets_per_phase": sets,
        mover + "pole_pitch": pitch,
        "actuator.cylinder.outer_diameter": 0.5 * d_i,
    }
    given_keys = dict(fixed)
    for group in IPEHLA.kind.alternatives:
        chosen = data.draw(st.permutations(group.keys))[: group.count]
        given_keys |= {key: {**whole, caps + "port_thread": "M5", caps + "port_diameter": 3e-3}[key] for key in chosen}
    resolved = resolve(given_keys)
    assert resolved.pop("actuator.piston.fin_material") == "POM"
    assert resolved.pop(caps + "port_thread", "M5") == "M5"
    assert set(resolved) == set(whole) | set(fixed) | set(following)
    scale = whole[yoke + "outer_diameter"] + whole[yoke + "length"]
    for key, value in {**whole, **following}.items():
        assert resolved[key] == pytest.approx(value, rel=1e-9, abs=1e-12 * scale), key


def test_resolving_what_is_resolved_changes_nothing():
    assert resolve(IPEHLA.given) == dict(IPEHLA.values)


OVERLAPS = [
    (("shaft", "outer_diameter", 15.9), "mover.outer_diameter must exceed .*shaft.outer_diameter 15.9 mm; got 15.9"),
    (("mover", "outer_diameter", 17), "cylinder.inner_diameter must exceed .*mover.outer_diameter 17 mm; got 16.1"),
    (("cylinder", "inner_diameter", 20), "cylinder.outer_diameter must exceed .*cylinder.inner_diameter 20 mm"),
    (("cylinder", "outer_diameter", 25), "winding.outer_diameter must exceed .*cylinder.outer_diameter 25 mm"),
    (("winding", "outer_diameter", 25.5), "back_yoke.inner_diameter must not be below .*winding.outer_diameter 25.5"),
    (("winding", "outer_diameter", 20.1), "must leave room for one layer of wire above .* 20.8 mm; got 20.1 mm"),
    (("back_yoke", "inner_diameter", 28), "back_yoke.outer_diameter must exceed .*back_yoke.inner_diameter 28"),
    (("back_yoke", "front_overhang", -1), r"back_yoke.length must cover .* least 202 mm; got 201 mm, .*front.* -1"),
    (("back_yoke", "back_overhang", -1), r"back_yoke.length must cover .* least 195 mm; got 194 mm, .*back.* -1"),
    (("mover", "ring_width", 12), "mover.ring_width must be below .*mover.pole_pitch 12 mm; got 12 mm"),
    (("mover", "ring_width", -1), "mover.magnet_thickness must be at most .*mover.pole_pitch 12 mm; got 13 mm"),
    (("cylinder", "length", 200), "cylinder.length must exceed the chamber 200 mm"),
    (("cylinder", "catalogue_bore", 8), "catalogue_bore must be within 5% of .* 15.295 mm to 16.905 mm; got 8"),
    (("piston", "fin_inner_diameter", 16.1), "piston.fin_inner_diameter must be below .*cylinder.inner_diameter 16.1"),
    (("piston", "fin_outer_diameter", 15), "fin_outer_diameter must exceed .* 16.1 mm, .* not seal; got 15 mm"),
    (("piston", "fin_length", 8), "piston.fin_length must be below .*piston.length 8 mm; got 8 mm"),
    (("shaft", "length", 112), "shaft.length must exceed the magnet array with its two pistons, 112 mm; got 112 mm"),
    (("end_caps", "flange_diameter", 20), "end_caps.flange_diameter must exceed .*cylinder.outer_diameter 20 mm"),
]  # fmt: skip


@pytest.mark.parametrize("change, sentence", OVERLAPS, ids=[".".join(map(str, change)) for change, _ in OVERLAPS])
def test_parts_that_overlap_are_named_with_both_values(change, sentence):
    part, field, value = change
    actuator = replace(IPEHLA.actuator, **{part: replace(getattr(IPEHLA.actuator, part), **{field: value * MM})})
    with pytest.raises(DesignError, match=sentence):
        actuator.check()


def test_an_array_longer_than_the_winding_and_too_many_turns_are_refused():
    actuator = IPEHLA.actuator
    with pytest.raises(DesignError, match="shorter than the winding 192 mm; got an array of 192 mm"):
        replace(actuator, mover=replace(actuator.mover, pole_pairs=8)).check()
    with pytest.raises(DesignError, match=r"fills at most 90.7% of a coil, 15.24 mm\^2; got 18.38 mm\^2"):
        replace(actuator, winding=replace(actuator.winding, turns=1170.0)).check()


def test_limits_themselves_are_legal():
    """A winding that fills the room up to the yoke, and an array without rings, where Fig. 6(a) starts."""
    actuator = IPEHLA.actuator
    replace(actuator, winding=replace(actuator.winding, outer_diameter=25 * MM)).check()
    replace(actuator, mover=replace(actuator.mover, ring_width=0.0)).check()
