"""A lead screw's figures by both routes: against each other, against other routes, and by hand."""

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fluxbore.design.errors import DesignError
from fluxbore.design.force_series import ForceSeries
from fluxbore.design.lead_screw_performance import LeadScrewFigures
from fluxbore.design.performance import FIGURES, Performance, show_figure
from fluxbore.design.spec import Spec, load
from fluxbore.design.study import Constraint, Variable
from fluxbore.fem.helical import solve
from fluxbore.fem.helical_force import coenergy, force
from fluxbore.geometry.lead_screw_parts import assembly
from fluxbore.geometry.mass import part_masses, total
from fluxbore.optimize.evaluate import MODELS, evaluate
from fluxbore.optimize.evaluation import INVALID, NOT_CONVERGED, Evaluation, from_plain, to_plain
from fluxbore.optimize.lead_screw_common import common_figures
from fluxbore.optimize.lead_screw_field import QUARTERS, LeadScrewField, magnetised, periods, section, solve_field

ROTLIN = Path(__file__).parents[2] / "examples" / "rotlin.toml"
PITCH = 36e-3 / 7
BARE = {"actuator.translator.iron_thickness": 0.0, "actuator.rotor.iron_thickness": 0.0}
"""Without iron both routes solve the same linear problem, once in closed form."""

NARROW = {
    **BARE,
    "actuator.gap": 0.4e-3,
    "actuator.gap_tolerance": 0.1e-3,
    "actuator.translator.magnet_width": 1e-3,
    "actuator.rotor.magnet_width": 1e-3,
    "actuator.translator.magnet_permeability": 1.0,
    "actuator.rotor.magnet_permeability": 1.0,
}
"""Narrow magnets beside a narrow gap: the force is largest before a quarter of the pitch."""

ARCS = {
    f"actuator.{member}.{leaf}": value
    for member in ("translator", "rotor")
    for leaf, value in (("magnets", "stepped arcs"), ("arc_angle", math.radians(60.0)), ("arcs_per_turn", 6))
}


def rotlin(changes: dict[str, float | str] | None = None) -> Spec:
    return load(ROTLIN).with_values(changes or {})


def series_of(found: Evaluation, pitch: float = PITCH) -> ForceSeries:
    """The force over the displacement that an evaluation's details tell."""
    assert found.details is not None
    orders = {
        int(name.rsplit("_", 1)[1]): value
        for name, value in found.details.items()
        if name.startswith("force_amplitude_")
    }
    return ForceSeries(np.array(list(orders.values())), pitch, tuple(orders))


@pytest.fixture(scope="module")
def steel() -> Evaluation:
    """RotLin by finite elements."""
    return evaluate(rotlin())


@pytest.fixture(scope="module")
def ideal() -> Evaluation:
    """RotLin by the analytic field."""
    return evaluate(rotlin(), "network")


@pytest.fixture(scope="module")
def bare() -> Evaluation:
    return evaluate(rotlin(BARE))


@pytest.fixture(scope="module")
def narrow() -> LeadScrewField:
    spec = rotlin(NARROW)
    return solve_field(spec, magnetised(spec))


def test_both_routes_agree_without_iron(bare: Evaluation) -> None:
    """Catches a period counted twice, a member that means something else, a slope taken elsewhere than at rest."""
    closed = evaluate(rotlin(BARE), "network").performance
    for name in ("stall_force", "spring_constant", "sudden_load_limit", "spring_energy", "load_displacement"):
        assert getattr(bare.performance, name) == pytest.approx(getattr(closed, name), rel=1e-3), name
    assert bare.performance.harmonic_ratio_2 == pytest.approx(closed.harmonic_ratio_2, rel=5e-3)
    assert bare.performance.harmonic_ratio_3 == pytest.approx(closed.harmonic_ratio_3, rel=0.03)


def test_a_finer_mesh_comes_nearer(bare: Evaluation) -> None:
    """Catches a figure that stays where the first mesh put it: half the cells, at most a quarter of the error."""
    closed = evaluate(rotlin(BARE), "network").performance
    fine = evaluate(rotlin({**BARE, "solver.mesh_refinement": 2})).performance
    for name in ("stall_force", "spring_constant"):
        exact = getattr(closed, name)
        assert abs(getattr(fine, name) - exact) < abs(getattr(bare.performance, name) - exact) / 4, name


def test_the_papers_figures(steel: Evaluation, ideal: Evaluation) -> None:
    """Table II's stall force, and K_2/K_1 and K_3/K_1 of the paper's section II: 1.58 and 0.08 %."""
    for found in (steel.performance, ideal.performance):
        assert found.stall_force == pytest.approx(192.0, rel=1e-3)
        assert found.harmonic_ratio_2 == pytest.approx(1.58e-2, abs=0.02e-2)
        assert found.harmonic_ratio_3 == pytest.approx(0.080e-2, abs=0.002e-2)
    assert 0.9990 < steel.performance.stall_force / ideal.performance.stall_force < 1


def test_energy_is_that_of_the_field(steel: Evaluation) -> None:
    """The barrier, an integral of the force, against the coenergies of saturable fields at rest and half a pitch on."""
    spec = rotlin()
    screw = magnetised(spec)
    rest, slipping = (solve(section(spec, screw, share * PITCH)) for share in (0.0, 0.5))
    risen = (coenergy(rest) - coenergy(slipping)) * periods(screw)
    assert abs(risen) == pytest.approx(steel.performance.spring_energy, rel=1e-3)


def test_torque_is_h_times_the_force(steel: Evaluation, bare: Evaluation) -> None:
    """Each by its own stress."""
    for found in (steel, bare):
        assert found.details is not None
        assert found.details["torque_over_h_force"] == pytest.approx(1.0, abs=1e-9)


def test_the_peak_elsewhere_is_solved_there(narrow: LeadScrewField) -> None:
    """Catches a largest sample taken for the peak, and a place that the series alone has: the force is level there."""
    spec, pitch = rotlin(NARROW), narrow.screw.pitch
    assert narrow.top is not None
    place = narrow.stall.section.displacement
    assert 0.18 * pitch < place < 0.21 * pitch
    top = force(narrow.stall)
    assert top > max(force(item) for item in narrow.samples)
    below, above = (force(solve(section(spec, narrow.screw, place + aside * pitch))) for aside in (-5e-4, 5e-4))
    slope = (above - below) / 1e-3 / math.tau / top
    assert abs(slope) < 1e-3
    assert above + below < 2 * top


def test_the_masses_of_the_parts() -> None:
    """The parts as drawn, turned profiles and unrolled bands, weigh what the closed forms say."""
    spec = rotlin({"actuator.translator.thickness": 12e-3, "actuator.rotor.magnet_fill": 0.8})
    rows = part_masses(assembly(spec.actuator), spec.materials)
    found = common_figures(spec, magnetised(spec))
    assert total(rows, "mover") + 2.238 == pytest.approx(found.moving_mass, rel=1e-9)
    assert total(rows) + 2.238 == pytest.approx(found.total_mass, rel=1e-9)
    assert sum(row.mass for row in rows if "magnet" in row.part.role) == pytest.approx(found.magnet_mass, rel=1e-9)


def test_the_series_holds_between_the_samples(narrow: LeadScrewField) -> None:
    """Catches too few displacements, or a slope that does not belong to them."""
    assert narrow.top is not None
    assert float(narrow.series.force(narrow.stall.section.displacement)) == pytest.approx(
        force(narrow.top) * periods(narrow.screw), rel=1e-3
    )
    closed = evaluate(rotlin(NARROW), "network").performance
    assert force(narrow.top) * periods(narrow.screw) == pytest.approx(closed.stall_force, rel=1e-3)
    assert narrow.series.stiffness(0.0) == pytest.approx(closed.spring_constant, rel=2e-3)
    assert len(narrow.samples) == QUARTERS + 2


def test_flux_along_the_iron(steel: Evaluation, ideal: Evaluation) -> None:
    """By the flux function of the elements and by Bessel functions; none without iron."""
    for name in ("translator_iron_flux_density", "rotor_iron_flux_density"):
        assert getattr(steel.performance, name) == pytest.approx(getattr(ideal.performance, name), rel=0.01)


def test_spring_figures_follow_from_the_series(steel: Evaluation) -> None:
    """Energy, sudden load and rest by quadrature of the force that the details tell."""
    found, series = steel.performance, series_of(steel)
    x = np.linspace(0, PITCH / 2, 4001)
    f = series.force(x)
    energy = np.concatenate(([0.0], np.cumsum((f[1:] + f[:-1]) / 2 * np.diff(x))))
    assert found.spring_energy == pytest.approx(energy[-1], rel=1e-6)
    # The least of the energy over the way that a sudden load F must beat, U(x) > F x somewhere: max of U/x.
    assert found.sudden_load_limit == pytest.approx(np.max(energy[1:] / x[1:]), rel=1e-6)
    assert float(series.force(found.load_displacement)) == pytest.approx(100.0, rel=1e-9)
    assert float(f.max()) == pytest.approx(found.stall_force, rel=1e-6)
    assert found.slip_work == pytest.approx(100.0 * PITCH)
    assert found.natural_frequency == pytest.approx(math.sqrt(found.spring_constant / found.moving_mass) / math.tau)


def test_masses_and_inertia_by_hand() -> None:
    """Rings of magnets (7500 kg/m^3), steel (7850), Bakelite and aluminium, at the example's radii and lengths."""
    spec = rotlin({"actuator.fittings": "none"})
    found = evaluate(spec, "network").performance
    bakelite = spec.materials["phenolic paper"].density
    magnet, iron = spec.materials["N42"].density, spec.materials["1010"].density

    def ring(inner: float, outer: float, length: float, density: float) -> float:
        return math.pi * (outer**2 - inner**2) * length * density

    poles = 2 * PITCH
    rings = [(18.25e-3, 20.75e-3, poles, magnet), (20.75e-3, 25.75e-3, poles, iron), (25.75e-3, 26.25e-3, 65e-3,
             bakelite)]  # fmt: skip
    moving = 2.238 + sum(ring(*each) for each in rings)
    still = ring(14.95e-3, 17.45e-3, 85e-3, magnet) + ring(9.95e-3, 14.95e-3, 85e-3, iron)
    assert found.moving_mass == pytest.approx(moving, rel=1e-9)
    assert found.total_mass == pytest.approx(moving + still, rel=1e-9)
    assert found.magnet_mass == pytest.approx(
        ring(18.25e-3, 20.75e-3, poles, magnet) + ring(14.95e-3, 17.45e-3, 85e-3, magnet), rel=1e-9
    )
    inertia = 1.068e-5 + sum(ring(*each) * (each[0] ** 2 + each[1] ** 2) / 2 for each in rings)
    assert found.rotor_inertia == pytest.approx(inertia, rel=1e-9)
    assert found.reflected_mass == pytest.approx(inertia * (math.tau / PITCH) ** 2, rel=1e-9)
    assert (found.outer_diameter, found.length) == pytest.approx((94.5e-3, 85e-3))
    assert found.stall_force_density == pytest.approx(found.stall_force / (math.pi * 26.25e-3**2 * 65e-3))


def test_carrier_and_motor_count() -> None:
    """Catches a carrier that weighs nothing, a motor's inertia left out, a carrier in the mover."""
    spec = rotlin({"actuator.fittings": "none"})
    still, moved = (
        common_figures(each, magnetised(each))
        for each in (spec, spec.with_values({"actuator.translator.thickness": 10e-3, "actuator.motor.inertia": 5e-5}))
    )
    carrier = spec.materials["aluminium 6061"].density * math.pi * (9.95e-3**2 - 7.45e-3**2) * 85e-3
    assert moved.total_mass - still.total_mass == pytest.approx(carrier, rel=1e-9)
    assert moved.moving_mass == still.moving_mass
    assert moved.rotor_inertia - still.rotor_inertia == pytest.approx(3.932e-5, rel=1e-9)


def test_the_motor_drives_load_mass_rotor_and_friction() -> None:
    """Energy over a way x: T theta = (F + M a) x + J alpha theta + T_f theta, alpha = a/h and theta = x/h."""
    operating = {"load_force": 80.0, "acceleration": 2.0, "friction_torque": 4e-3}
    spec = rotlin({f"operating_point.{name}": value for name, value in operating.items()})
    found = evaluate(spec, "network").performance
    h = PITCH / math.tau
    x, accelerated = 0.01, found.moving_mass * 2.0
    work = (80.0 + accelerated) * x + (found.rotor_inertia * 2.0 / h + 4e-3) * x / h
    assert found.motor_torque * x / h == pytest.approx(work, rel=1e-12)
    assert found.motor_current == pytest.approx(found.motor_torque / 0.0387)
    assert found.back_driving_force == pytest.approx(4e-3 / h)
    assert found.slip_margin == pytest.approx(found.stall_force / (80.0 + accelerated))
    assert found.largest_acceleration == pytest.approx((found.stall_force - 80.0) / found.moving_mass)
    assert found.stall_torque == pytest.approx(found.stall_force * h)
    assert found.transfer_ratio == pytest.approx(1 / h)


def test_the_strokes_end_leaves_what_is_engaged() -> None:
    """The rotor's four poles stick out by half their length at either end of this stroke."""
    half_out = 85e-3 - 2 * PITCH + 2 * PITCH  # full engagement and, at each end, half of two pitches
    found = evaluate(rotlin({"operating_point.stroke": half_out}), "network").performance
    assert found.stroke_end_force == pytest.approx(found.stall_force / 2, rel=1e-9)


def test_ripple_needs_arcs_on_both_members(ideal: Evaluation) -> None:
    """docs/lead_screw.md: 10.8 % of six arcs of 60 degrees on both."""
    assert ideal.performance.force_ripple == 0.0
    assert evaluate(rotlin(ARCS), "network").performance.force_ripple == pytest.approx(0.108, abs=0.001)
    one = {key: value for key, value in ARCS.items() if key.startswith("actuator.translator")}
    assert evaluate(rotlin(one), "network").performance.force_ripple == 0.0


def test_arcs_by_both_routes() -> None:
    """The averaged helices of both members; of the magnets themselves nothing is known."""
    spec = rotlin({**BARE, **ARCS})
    found, closed = evaluate(spec).performance, evaluate(spec, "network").performance
    assert found.stall_force == pytest.approx(closed.stall_force, rel=1e-3)
    assert found.demagnetisation_load is None
    assert found.demagnetised_fraction is None


def test_heat_weakens_and_demagnetises() -> None:
    """Catches coercivity at 20 degC, and a load of magnets that helps instead of one against them."""
    cold, hot = (
        evaluate(rotlin({**BARE, "operating_point.magnet_temperature": 273.15 + celsius})) for celsius in (20.0, 120.0)
    )
    assert hot.performance.stall_force < 0.85 * cold.performance.stall_force
    assert cold.performance.demagnetisation_load < 0.9
    assert hot.performance.demagnetisation_load > 1.5 * cold.performance.demagnetisation_load
    assert hot.performance.demagnetised_fraction > cold.performance.demagnetised_fraction
    assert any("working temperature of N42" in text for text in hot.warnings)
    assert any("beyond its intrinsic coercivity when the screw slips" in text for text in hot.warnings)
    assert cold.warnings == ()


def test_thin_iron_is_warned_of() -> None:
    """Catches a network that promises what iron of 0.2 mm cannot carry, without a word: the 0.381 and 0.263 T along
    5 mm of it, by the sections' ratio."""
    (warning,) = evaluate(rotlin(dict.fromkeys(BARE, 0.2e-3)), "network").warnings
    assert "the translator's 7.99 T" in warning
    assert "the rotor's 7.32 T" in warning


def test_a_load_beyond_the_stall_is_warned_of() -> None:
    found = evaluate(rotlin({"operating_point.load_force": 200.0}), "network")
    assert found.performance.load_displacement is None
    assert found.performance.slip_margin < 1
    assert found.performance.largest_acceleration < 0
    assert any(text.startswith("The screw slips") for text in found.warnings)


def test_a_load_that_slips_at_the_strokes_ends_is_warned_of() -> None:
    """Catches silence where poles run out of the translator: a stroke of 88 mm leaves 3.643 mm of 10.286 mm."""
    within, beyond, out = (
        evaluate(rotlin({"operating_point.stroke": stroke}), "network") for stroke in (78e-3, 88e-3, 200e-3)
    )
    assert within.performance.stroke_end_force > 100.0
    assert within.warnings == ()
    (warning,) = beyond.warnings
    assert warning.startswith("The load slips at the ends of operating_point.stroke")
    assert ": 68 N of the stall force is left" in warning
    (warning,) = out.warnings
    assert ": 0 N of the stall force is left" in warning


def test_no_load_has_no_margin() -> None:
    found = evaluate(
        rotlin({"operating_point.load_force": 0.0, "operating_point.acceleration": 0.0}), "network"
    ).performance
    assert found.slip_margin is None
    assert found.load_displacement == 0.0


def test_what_does_not_converge_has_no_figures() -> None:
    found = evaluate(rotlin({"solver.max_iterations": 1}))
    assert found.status == NOT_CONVERGED
    assert found.performance == Performance()
    assert found.reasons[0].startswith("At a displacement of 1.286 mm: Newton's iteration ended")


def test_arcs_that_turn_the_poles_over_are_refused() -> None:
    """Two starts of arcs of 270 degrees in steps: their mean over a step is the opposite pole."""
    arcs = {"actuator.rotor.magnets": "stepped arcs", "actuator.rotor.arc_angle": math.radians(270.0)}
    spec = rotlin({**BARE, **arcs, "actuator.rotor.arcs_per_turn": 1, "actuator.starts": 2})
    for route in ("network", "fem"):
        found = evaluate(spec, route)
        assert found.status == INVALID
        assert "actuator.rotor.arc_angle 270 deg" in found.reasons[0]


def test_plain_form_is_exact(steel: Evaluation) -> None:
    assert from_plain(to_plain(steel)) == steel


def test_a_figure_is_given_or_never_can_be(steel: Evaluation, ideal: Evaluation) -> None:
    """Catches a study that is allowed a figure which no design has, and one that is refused what all have."""
    spec, model = rotlin(), MODELS["lead-screw"]
    for name in FIGURES:
        given = getattr(steel.performance, name) is not None
        assert given == (model.never(spec, name) is None), name
    own = LeadScrewFigures.__dataclass_fields__
    assert all(getattr(ideal.performance, name) is not None for name in own)


@pytest.mark.parametrize(
    ("changes", "figure", "reason"),
    [
        (BARE, "rotor_iron_flux_density", "actuator.rotor.iron_thickness is 0"),
        (ARCS, "demagnetisation_load", "actuator.translator.arc_angle is given"),
        ({}, "cogging_force", "a magnetic lead screw has no such figure"),
        ({"operating_point.load_force": 200.0}, "load_displacement", "beyond the stall force"),
    ],
)
def test_the_reason_names_what_is_missing(changes: dict[str, float | str], figure: str, reason: str) -> None:
    """Catches a constraint that cannot be met without a word why."""
    spec = rotlin(changes)
    spec = replace(spec, study=replace(spec.study, constraints=(Constraint(figure, lower=1.0),)))
    assert any(reason in text for text in evaluate(spec, "network").warnings)


def test_what_a_variable_moves_can_be_given() -> None:
    """Iron that starts at zero and varies."""
    spec = rotlin(BARE)
    assert MODELS["lead-screw"].never(spec, "rotor_iron_flux_density") is not None
    moved = replace(spec, study=replace(spec.study, variables=(Variable("actuator.rotor.iron_thickness", 0.0, 5e-3),)))
    assert MODELS["lead-screw"].never(moved, "rotor_iron_flux_density") is None


def test_the_pages_numbers(steel: Evaluation) -> None:
    """docs/constraints.md names every figure of a lead screw, as the program shows it."""
    page = (ROTLIN.parents[1] / "docs" / "constraints.md").read_text(encoding="utf-8")
    section_ = page.split("## Magnetic lead screw\n")[1].split("\n## ")[0]
    rows = [line.split("|")[1] for line in section_.splitlines() if line.startswith("| `")]
    told = dict(pair for row in rows for pair in re.findall(r"`(\w+)` \(([^)]*)\)", row))
    values = {name: getattr(steel.performance, name) for name in FIGURES}
    assert told == {name: show_figure(name, value, 4) for name, value in values.items() if value is not None}


def test_a_gap_without_a_field_is_refused() -> None:
    wide = {"actuator.gap": 40e-3, "actuator.rotor.outer_radius": 80e-3, "actuator.motor.outer_radius": 90e-3}
    found = evaluate(rotlin(wide), "network")
    assert found.status == INVALID
    assert "actuator.gap" in found.reasons[0]
    with pytest.raises(DesignError, match=r"actuator\.gap"):
        MODELS["lead-screw"].network(rotlin(wide), ())
