"""The hybrid actuator's constraint figures: what is given, what follows from a field, and how smoothly."""

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fluxbore.design import magnetic_network
from fluxbore.design.performance import Performance, to_mapping
from fluxbore.design.spec import Spec, loads
from fluxbore.design.spec_file import template
from fluxbore.optimize.hybrid_common import common_figures, derived, warnings

TEXT = template("ipehla")

PROTOTYPE = loads(TEXT)

FIELD = {
    "force_constant": 8.67,
    "gap_flux_density": 0.41,
    "yoke_flux_density": 1.35,
    "phase_inductance": 2.5e-3,
    "peak_force": 8.5,
}

CLOSED = (
    "hoop_stress", "cylinder_safety", "cap_safety", "bore_dilation", "bore_clearance", "buckling_force",
    "seal_friction", "fill_factor", "winding_layers", "winding_room", "yoke_wall", "cylinder_wall", "magnet_wall",
)  # fmt: skip

FOLLOWING = (
    "back_emf", "voltage_demand", "voltage_margin", "no_load_speed", "speed_limit", "saturation_ratio",
    "motor_constant", "iron_loss", "eddy_loss", "drag_force", "winding_temperature", "continuous_current",
    "continuous_thrust", "peak_thrust", "shaft_stress", "shaft_safety", "buckling_safety",
)  # fmt: skip


def figures(changes: dict[str, str] | None = None, **field: float | None) -> Performance:
    spec = loads(TEXT, changes or {})
    return derived(spec, replace(common_figures(spec, spec.actuator), **{**FIELD, **field}))


def test_every_figure_is_given_for_the_prototype() -> None:
    """Catches a figure that no route fills, and one that is not a number."""
    found = to_mapping(figures())
    for name in (*CLOSED, *FOLLOWING):
        value = found[name]
        assert value is not None, name
        assert math.isfinite(value), name


def test_figures_without_a_field_need_none() -> None:
    spec = loads(TEXT)
    found = to_mapping(common_figures(spec, spec.actuator))
    assert all(found[name] is not None for name in CLOSED)
    assert all(found[name] is None for name in FOLLOWING if name != "motor_constant")
    bare = common_figures(spec, spec.actuator)
    assert derived(spec, bare) == bare


def test_the_numbers_of_the_paper() -> None:
    """5.7 ohm at 27 degC, 121 N at 0.6 MPa, 4.35 turns/mm^2 in a fill of 0.55, 8.67 N/A -> 0.578 V at 0.1 m/s."""
    found = figures({"operating_point.winding_temperature": "27 degC"})
    assert found.winding_resistance == pytest.approx(5.7, abs=0.005)
    assert found.pneumatic_force_advance == pytest.approx(121, abs=0.5)
    assert found.fill_factor == pytest.approx(4.345e6 * math.pi / 4 * 0.4e-3**2, rel=1e-3)
    assert found.back_emf == pytest.approx(2 / 3 * 8.67 * 0.1)
    assert found.peak_thrust == pytest.approx(120.64 + 8.5, abs=0.01)
    assert found.saturation_ratio == pytest.approx(8.5 / 8.67)
    assert found.bore_clearance == pytest.approx(0.1e-3, rel=0.01)


def test_pressure_opens_the_clearance() -> None:
    clearance = [figures({"operating_point.pressure": text}).bore_clearance for text in
                 ("0 Pa gauge", "0.6 MPa gauge", "6 MPa gauge")]  # fmt: skip
    assert clearance == sorted(set(clearance), key=lambda value: value or 0.0)
    assert clearance[0] == pytest.approx(0.1e-3)


def test_the_losses_balance_the_drag() -> None:
    found = figures()
    assert found.iron_loss is not None
    assert found.eddy_loss is not None
    assert found.drag_force is not None
    assert found.drag_force * 0.1 == pytest.approx(found.iron_loss + found.eddy_loss)
    slow = figures({"operating_point.speed": "0.05 m/s"})
    assert slow.eddy_loss == pytest.approx(found.eddy_loss / 4)
    at_rest = figures({"operating_point.speed": "0 m/s"})
    assert at_rest.eddy_loss == at_rest.iron_loss == 0
    assert at_rest.drag_force is not None
    assert 0 < at_rest.drag_force < slow.drag_force  # type: ignore[operator]
    assert at_rest.seal_friction > found.seal_friction  # type: ignore[operator]


def test_the_limit_current_heats_to_the_limit() -> None:
    """One statement by two figures: at the continuous current the winding is at its limit, at any duty."""
    for duty in ("1.0", "0.25"):
        common = {"operating_point.duty": duty, "operating_point.winding_temperature_limit": "110 degC"}
        limit = figures(common).continuous_current
        assert limit is not None
        hot = figures(common | {"operating_point.current": f"{limit!r} A"})
        assert hot.winding_temperature == pytest.approx(110 + 273.15, rel=1e-9)
        assert hot.continuous_thrust == pytest.approx(8.67 * limit)


def test_at_the_speed_limit_no_voltage_is_left() -> None:
    limit = figures().speed_limit
    assert figures({"operating_point.speed": f"{limit!r} m/s"}).voltage_margin == pytest.approx(0, abs=1e-9)


def test_without_a_supply_there_is_no_limit() -> None:
    found = figures({"operating_point.supply_voltage": ""})
    assert found.voltage_margin is found.speed_limit is found.no_load_speed is None
    assert found.voltage_demand is not None


@pytest.mark.parametrize(
    ("part", "material", "missing"),
    [
        ("cylinder", "brass", ("cylinder_safety", "cap_safety", "bore_dilation", "bore_clearance")),
        ("cylinder", "PEEK", ("eddy_loss", "bore_dilation", "bore_clearance")),
        ("shaft", "brass", ("shaft_safety",)),
        ("shaft", "PTFE", ("shaft_safety",)),
        ("back_yoke", "TEAM 13 steel", ("iron_loss",)),
    ],
)
def test_what_a_material_does_not_tell_is_not_guessed(part: str, material: str, missing: tuple[str, ...]) -> None:
    """Catches a zero or a typical value in place of a datum that the material lacks."""
    found = to_mapping(figures({f"actuator.{part}.material": material}))
    assert {name for name in (*CLOSED, *FOLLOWING) if found[name] is None} == set(missing)


KEYS = (
    "actuator.mover.ring_width", "actuator.mover.pole_pitch", "actuator.mover.outer_diameter",
    "actuator.cylinder.outer_diameter", "actuator.cylinder.inner_diameter", "actuator.back_yoke.thickness",
    "actuator.back_yoke.outer_diameter", "actuator.winding.turns", "actuator.winding.wire_diameter",
    "actuator.shaft.outer_diameter", "actuator.shaft.length", "operating_point.current", "operating_point.pressure",
    "operating_point.speed", "operating_point.duty", "operating_point.ambient_temperature",
)  # fmt: skip


def _slopes(spec: Spec, key: str, step: float) -> dict[str, float]:
    """Central differences of every figure, the field's held."""
    value = spec.number(key)
    ends = []
    for sign in (-1, 1):
        moved = spec.with_values({key: value * (1 + sign * step)})
        ends.append(to_mapping(derived(moved, replace(common_figures(moved, moved.actuator), **FIELD))))
    low, high = ends
    return {name: (high[name] - low[name]) / (2 * step) for name in (*CLOSED, *FOLLOWING)}  # type: ignore[operator]


@pytest.mark.parametrize("key", KEYS)
def test_every_figure_is_smooth_in_every_key(key: str) -> None:
    """Catches a rounding, a kink or a root that stops early: slopes of steps of 5e-5 and 5e-6 agree."""
    spec = loads(TEXT, {"operating_point.duty": "0.5"})
    size = to_mapping(derived(spec, replace(common_figures(spec, spec.actuator), **FIELD)))
    coarse, fine = _slopes(spec, key, 5e-5), _slopes(spec, key, 5e-6)
    for name in (*CLOSED, *FOLLOWING):
        assert fine[name] == pytest.approx(coarse[name], rel=1e-5, abs=2e-6 * abs(size[name] or 0.0)), name


@pytest.mark.parametrize("name", FIELD)
def test_the_field_enters_smoothly(name: str) -> None:
    """Catches a figure of the field that nothing follows from, and a kink in what does."""

    def slopes(step: float) -> dict[str, float]:
        low, high = (to_mapping(figures(**{name: FIELD[name] * (1 + sign * step)})) for sign in (-1, 1))
        return {figure: (high[figure] - low[figure]) / (2 * step) for figure in FOLLOWING}  # type: ignore[operator]

    coarse, fine = slopes(1e-3), slopes(1e-5)
    assert any(abs(slope) > 0 for slope in fine.values())
    for figure in FOLLOWING:
        assert fine[figure] == pytest.approx(coarse[figure], rel=1e-4, abs=1e-7), figure


def test_the_network_gives_the_same_figures() -> None:
    """Catches a figure that only one route can fill."""
    spec = loads(TEXT)
    solved = magnetic_network.network(spec.actuator, spec.materials)
    found = derived(
        spec,
        replace(
            common_figures(spec, spec.actuator),
            force_constant=solved.force_constant,
            gap_flux_density=solved.gap_flux_density,
            yoke_flux_density=solved.yoke_flux_density,
        ),
    )
    assert {name for name in FOLLOWING if getattr(found, name) is None} == {"saturation_ratio"}


def test_a_speed_beyond_the_thin_wall_is_warned_of() -> None:
    """Catches eddy currents beyond their formula without a word; 0.1 m/s is far below."""
    assert warnings(loads(TEXT), figures()) == ()
    fast = loads(TEXT, {"operating_point.speed": "20 m/s"})
    (warning,) = warnings(fast, figures())
    assert "skin depth" in warning
    assert "eddy_loss" in warning


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        (
            {"operating_point.peak_current": "0.5 A"},
            "peak_current must not be below operating_point.current 1 A; got 0.5",
        ),
        ({"operating_point.winding_temperature_limit": "10 degC"}, "limit must not be below .* 20 degC; got 10 degC"),
        ({"actuator.winding.insulated_diameter": "0.3 mm"}, "insulated_diameter must not be below .* 0.4 mm; got 0.3"),
    ],
)
def test_an_operating_point_that_contradicts_itself_is_refused(changes: dict[str, str], sentence: str) -> None:
    from fluxbore.design.errors import SpecError

    with pytest.raises(SpecError, match=sentence):
        loads(TEXT, changes)


RANGES = {
    "operating_point.pressure": st.floats(0, 1e9),
    "operating_point.current": st.floats(0, 1e3),
    "operating_point.peak_current": st.floats(1e3, 1e6),
    "operating_point.speed": st.floats(0, 1e3),
    "operating_point.duty": st.floats(1e-6, 1),
    "operating_point.supply_voltage": st.floats(1e-6, 1e5),
    "operating_point.ambient_temperature": st.floats(201, 400),
    "operating_point.winding_temperature_limit": st.floats(400, 1000),
    "actuator.back_yoke.emissivity": st.floats(0, 1),
    "actuator.winding.insulation_conductivity": st.floats(1e-6, 1e3),
    "actuator.winding.yoke_clearance": st.floats(0, 1e-3),
    "actuator.mover.ring_width": st.floats(1e-4, 11e-3),
    "actuator.seal.contact_force": st.floats(0, 1e6),
    "actuator.seal.stribeck_speed": st.floats(1e-6, 100),
}


@settings(max_examples=40, deadline=None)
@given(changes=st.fixed_dictionaries(RANGES), field=st.sampled_from([1e-9, 1.0, 3.0]))
def test_whatever_keys_allow_gives_numbers_or_none(changes: dict[str, float], field: float) -> None:
    """Catches an overflow, a root of a negative number or an iteration that diverges at values that keys accept."""
    spec = PROTOTYPE.with_values(changes)
    found = derived(
        spec,
        replace(
            common_figures(spec, spec.actuator),
            force_constant=10 * field,
            gap_flux_density=field,
            yoke_flux_density=field,
        ),
    )
    for name, value in to_mapping(found).items():
        assert value is None or math.isfinite(value), name
    assert found.continuous_current is not None
    if found.winding_temperature is not None:
        assert found.winding_temperature >= changes["operating_point.ambient_temperature"]


def test_the_inductance_is_the_fields() -> None:
    """The current sheet's closed form against the finite elements at the prototype: 0.8 mH within 10 %."""
    from fluxbore.design.inductance import phase_inductance
    from fluxbore.fem.threads import one_thread
    from fluxbore.fem.tubular import solve_currents, space_vector
    from fluxbore.geometry.hybrid import cross_section

    spec = loads(TEXT)
    actuator = spec.actuator
    section = cross_section(actuator, actuator.mid_stroke, spec.materials, 293.15)
    # At half of 0.4 A to either side the magnets' own flux falls out; midway between the axes it is their mean.
    angle, linkages = math.pi / 4, []
    for amplitude in (-0.2, 0.2):
        currents = {phase: amplitude * math.cos(angle - 2 * math.pi * i / 3) for i, phase in enumerate("UVW")}
        with one_thread():
            linkages.append(space_vector(solve_currents(section, actuator.mid_stroke, currents).flux_linkages()))
    field = abs(linkages[1] - linkages[0]) / 0.4
    assert phase_inductance(actuator) == pytest.approx(field, rel=0.1)


def test_a_pull_stresses_the_rod_too() -> None:
    """Catches a safety that is missing, or negative, where the cogging outweighs the force."""
    found = figures({"operating_point.pressure": "0 MPa gauge", "operating_point.peak_current": "1 A"}, peak_force=-2.0)
    assert found.shaft_stress is not None
    assert found.shaft_safety is not None
    assert found.shaft_stress < 0 < found.shaft_safety
    assert found.buckling_safety is None
