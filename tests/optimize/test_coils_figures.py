"""The figures of coils and their gradients, and the searches that run on them."""

import math
from pathlib import Path

import pytest

from fluxbore.design.spec import load, loads
from fluxbore.optimize.coils_figures import by_fem
from fluxbore.optimize.evaluate import MODELS, evaluate
from fluxbore.optimize.evaluation import INVALID, from_plain, to_plain

EXAMPLES = Path(__file__).parents[2] / "examples"
STORE = load(EXAMPLES / "team22.toml")
SOLENOID = load(EXAMPLES / "fabry.toml")

PUBLISHED = {
    "actuator.coil_2.radius": 3.08,
    "actuator.coil_2.half_height": 0.239,
    "actuator.coil_2.thickness": 0.394,
}
"""The optimum of TEAM problem 22 with three variables, on its grid."""


def test_the_published_stray_field():
    """0.0879 of B_norm^2 at the published design: catches another set of points, radii for diameters, half fields."""
    found = evaluate(STORE.with_values(PUBLISHED)).performance
    assert found.stray_flux_density is not None
    assert (found.stray_flux_density / 3e-3) ** 2 == pytest.approx(0.0879, abs=0.00005)


def test_the_merit_is_its_definition():
    found = evaluate(STORE.with_values(PUBLISHED)).performance
    stray = (found.stray_flux_density / 3e-3) ** 2
    assert found.merit == pytest.approx(stray + abs(found.stored_energy - 180e6) / 180e6, rel=1e-14)


def test_the_quench_load_is_the_published_limit():
    """|J| = 54 - 6.4 |B| A/mm^2 is a load of one: catches a slip in the two ends of the line."""
    found = evaluate(STORE).performance
    assert found.quench_load == pytest.approx((22.5 + 6.4 * found.winding_flux_density) / 54, rel=1e-12)


def test_the_quench_load_takes_each_windings_own_current():
    """Catches the largest field of one winding held against the current of another."""
    spec = STORE.with_values({"actuator.coil_1.current_density": 30e6})
    loads_ = [
        evaluate(spec.with_values({key: 0.0})).performance
        for key in ("actuator.coil_1.current_density", "actuator.coil_2.current_density")
    ]
    assert all(each.quench_load is not None and each.winding_flux_density is not None for each in loads_)
    alone = loads_[1]  # only the inner winding carries current
    assert alone.quench_load == pytest.approx(30 / 54 + alone.winding_flux_density / 8.4375, rel=1e-12)


def test_what_the_specification_does_not_ask_for_is_not_given():
    """Catches a merit without its norm, a quench load of copper, a loss of a superconductor."""
    store, solenoid = evaluate(STORE).performance, evaluate(SOLENOID).performance
    assert store.joule_loss is None
    assert [solenoid.quench_load, solenoid.merit, solenoid.stray_flux_density] == [None] * 3


def test_the_loss_is_that_of_the_wire():
    """Catches a fill taken twice or not at all: rho (J/fill)^2 over the conductor's volume."""
    coil = SOLENOID.actuator.coils[0]
    resistivity = SOLENOID.materials["copper"].resistivity_at(333.15)
    conductor = 0.8 * math.pi * (0.045**2 - 0.025**2) * 0.16
    expected = resistivity * (coil.current_density / 0.8) ** 2 * conductor
    assert evaluate(SOLENOID).performance.joule_loss == pytest.approx(expected, rel=1e-12)


KEYS = {
    "store": (
        STORE,
        ("actuator.coil_2.radius", "actuator.coil_2.half_height", "actuator.coil_2.thickness")
        + ("actuator.coil_1.position", "actuator.coil_1.current_density", "operating_point.line_radius")
        + ("actuator.coil_2.position",)  # which the example does not give: it stands at its default
        + ("operating_point.stray_norm", "operating_point.reference_energy", "operating_point.critical_flux_density"),
    ),
    "solenoid": (
        SOLENOID,
        ("actuator.coil_1.inner_radius", "actuator.coil_1.thickness", "actuator.coil_1.half_height")
        + ("actuator.coil_1.current_density", "actuator.fill", "operating_point.winding_temperature"),
    ),
}


@pytest.mark.parametrize("name", KEYS)
def test_gradients_are_those_of_the_figures(name):
    """Catches a derivative that is lost on its way (zero) or of another quantity.

    Central differences with Richardson's extrapolation, whose own error is some 1e-9 of figure over key.
    """
    spec, keys = KEYS[name]
    # Off the symmetric place, where the hottest spot of the inner winding would jump from one end to the other.
    spec = spec.with_values({"actuator.coil_1.position": 0.02})
    found = by_fem(spec, keys)
    assert found.gradient is not None
    for key in keys:
        value = spec.number(key)
        size = 1.0 if key.endswith("position") else abs(value)

        def slope(step, key=key, value=value):
            high, low = (evaluate(spec.with_values({key: value + sign * step})).performance for sign in (1, -1))
            return {f: (getattr(high, f) - getattr(low, f)) / (2 * step) for f in found.gradient}

        coarse, fine = slope(2e-3 * size), slope(1e-3 * size)
        for figure, slopes in found.gradient.items():
            expected = (4 * fine[figure] - coarse[figure]) / 3
            scale = max(abs(expected), abs(getattr(found.performance, figure)) / size)
            assert abs(slopes[key] - expected) < 1e-6 * scale, (figure, key)


def test_a_gradient_holds_what_the_study_holds():
    """Catches a thickness that grows inwards where the bore is held: the outer radius moves by all of it."""
    key = "actuator.coil_1.thickness"
    assert by_fem(SOLENOID, (key,)).gradient["outer_diameter"][key] == pytest.approx(2.0, rel=1e-12)
    mean = SOLENOID.pinned(("actuator.coil_1.radius", key))
    assert by_fem(mean, (key,)).gradient["outer_diameter"][key] == pytest.approx(1.0, rel=1e-12)


def test_a_gradient_by_a_derived_key_takes_the_place_of_an_alternative():
    """Catches an empty gradient where the specification gives another of three measures."""
    found = by_fem(SOLENOID, ("actuator.coil_1.radius", "actuator.coil_1.thickness")).gradient
    assert found["outer_diameter"]["actuator.coil_1.radius"] == pytest.approx(2.0, rel=1e-12)


def test_counts_have_no_derivative():
    found = by_fem(STORE, ("operating_point.points_per_line", "actuator.coil_2.radius")).gradient
    assert set(found["merit"]) == {"actuator.coil_2.radius"}


def test_the_model_offers_gradients_and_its_evaluations_survive_the_journal():
    """Catches a numpy number among the figures, which JSON would refuse."""
    assert MODELS["coils"].gradients
    found = evaluate(STORE, "fem", ("actuator.coil_2.radius",))
    assert from_plain(to_plain(found)) == found
    assert all(type(value) is float for value in found.gradient["merit"].values())
    assert type(found.performance.merit) is float


def test_there_is_no_network_and_a_sentence_says_so():
    found = evaluate(STORE, "network")
    assert found.status == INVALID
    assert found.reasons == (
        "Coils in free space have no magnetic network, their field being exact (fidelity fem); got 2 of them.",
    )


def test_a_winding_too_thin_for_the_digits_is_not_converged():
    """Catches noise sold as a figure: a section of a micrometre in a coil of 100 m leaves no digits of the energy."""
    spec = loads(
        '[actuator]\nkind = "coils"\n[actuator.coil_1]\nradius = "100 m"\nthickness = "0.002 mm"\n'
        'half_height = "0.002 mm"\ncurrent_density = "1 A/mm^2"\n'
    )
    found = evaluate(spec)
    assert found.status == "not converged"
    assert found.performance.stored_energy is None
