"""The seal's figures from a specification: the prototype's, what moves them, what lacks, and the fin's study."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from seal_study import closed, seal_figures

from fluxbore.design.errors import DesignError, SpecError
from fluxbore.design.performance import FIGURES, Performance, to_mapping
from fluxbore.design.seal_keys import FIN_KEYS, SEAL_KEYS
from fluxbore.design.spec import Spec, load
from fluxbore.design.study import Objective, Pareto
from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.executor import SerialExecutor
from fluxbore.optimize.hybrid_common import common_figures
from fluxbore.optimize.hybrid_gaps import gaps
from fluxbore.optimize.hybrid_seal import contact_force, friction_law, warnings
from fluxbore.optimize.pareto import run_pareto
from fluxbore.optimize.search import run_search

EXAMPLES = Path(__file__).parents[2] / "examples"

PROTOTYPE = load(EXAMPLES / "ipehla.toml")

FIN = load(EXAMPLES / "ipehla-fin.toml")

KEYS = tuple(variable.key for variable in FIN.study.variables)

SEAL = tuple(name for name, figure in FIGURES.items() if figure.group == "Seal")


def figures(changes: dict[str, str] | None = None, path: str = "ipehla") -> Performance:
    return seal_figures(load(EXAMPLES / f"{path}.toml", changes or {}))


def test_every_figure_of_the_seal_is_given() -> None:
    found = to_mapping(common_figures(PROTOTYPE, PROTOTYPE.actuator))
    assert [name for name in SEAL if found[name] is None] == []


def test_the_papers_fin() -> None:
    found = figures()
    assert found.fin_deformed_length == pytest.approx(0.412e-3, abs=1e-6)
    assert found.fin_contact_area == pytest.approx(20.86e-6, abs=1e-8)
    assert found.fin_angle == pytest.approx(np.radians(14.04), abs=1e-4)


def test_the_lips_press_with_the_measured_force_at_the_prototypes_shape() -> None:
    """What the modulus was calibrated for; the same friction then follows with and without the measured F_0."""
    assert contact_force(PROTOTYPE) == 20.5
    assert contact_force(FIN) == pytest.approx(20.5, rel=5e-4)
    same = {"operating_point.pressure": "0.3 MPa gauge", "operating_point.speed": "5 mm/s"}
    assert figures(same).seal_friction == pytest.approx(figures(path="ipehla-fin").seal_friction, rel=5e-4)


def test_what_the_fins_study_takes_for_the_unmeasured_says_why() -> None:
    """Catches a default of the seal that stands in no specification, and would pass for published."""
    given = {key for key in FIN.given if key.startswith(("actuator.seal.", "actuator.piston."))}
    optional = {key.name for key in FIN.kind.keys if key.optional}
    assert {key.name for key in (*SEAL_KEYS, *FIN_KEYS)} - optional <= given
    published = {f"actuator.seal.{name}" for name in ("static_coefficient", "coulomb_coefficient", "stribeck_speed")}
    published |= {"actuator.seal.viscous_coefficient"}
    published |= {f"actuator.piston.fin_{name}" for name in ("outer_diameter", "inner_diameter", "length")}
    assert given - published == given & {note.key for note in FIN.notes}


def test_the_force_follows_the_fin_where_none_is_measured() -> None:
    thin = {"actuator.piston.fin_thickness": "0.2 mm"}
    assert figures(thin).seal_friction == figures().seal_friction
    assert figures(thin, "ipehla-fin").seal_friction < 0.9 * figures(path="ipehla-fin").seal_friction  # type: ignore[operator]
    guided = load(EXAMPLES / "ipehla-fin.toml", {"actuator.seal.guide_force": "3 N"})
    assert contact_force(guided) == pytest.approx(23.5, rel=5e-4)


def test_two_lips_of_pom_would_press_five_times_as_hard() -> None:
    """The reason in the example for another material."""
    stiff = {"actuator.piston.fin_material": '"POM"', "actuator.piston.fin_modulus": "3.1 GPa"}
    assert contact_force(load(EXAMPLES / "ipehla-fin.toml", stiff)) == pytest.approx(103, abs=0.5)


def test_the_variation_is_the_pressures_part_of_the_friction() -> None:
    rest = figures({"operating_point.pressure": "0 Pa gauge"})
    found = figures()
    assert found.seal_friction_variation == pytest.approx(found.seal_friction - rest.seal_friction)  # type: ignore[operator]
    assert rest.seal_friction_variation == 0
    assert rest.sealing_margin is None
    assert rest.air_leakage == 0


def test_margins_stand_at_the_worst_of_the_fit() -> None:
    """With no tolerance and no change of temperature they are those of the drawing, by hand."""
    exact = {
        "actuator.cylinder.bore_tolerance": "0 mm",
        "actuator.piston.fin_tolerance": "0 mm",
        "operating_point.coldest_temperature": "20 degC",
        "operating_point.hottest_temperature": "20 degC",
    }
    found = figures(exact)
    assert found.fin_interference == pytest.approx(0.1e-3)
    assert found.largest_interference == pytest.approx(0.1e-3)
    assert found.sealing_margin == pytest.approx(found.lip_contact_pressure / 0.6e6)  # type: ignore[operator]
    assert found.seal_life == pytest.approx(0.1e-3 / found.seal_wear)  # type: ignore[operator]
    worst = figures()
    cold = (16.3 * (1 - 10 * 2.0e-4) - 16.1 * (1 - 10 * 2.36e-5)) / 2 - (0.027 + 0.043) / 4
    hot = (16.3 * (1 + 20 * 2.0e-4) - 16.1 * (1 + 20 * 2.36e-5)) / 2 + (0.027 + 0.043) / 4
    assert worst.fin_interference == pytest.approx(cold * 1e-3, rel=1e-9)
    assert worst.largest_interference == pytest.approx(hot * 1e-3, rel=1e-9)


@settings(max_examples=40, deadline=None)
@given(
    which=st.sampled_from(["actuator.cylinder.bore_tolerance", "actuator.piston.fin_tolerance"]),
    width=st.floats(0.0, 0.1e-3),
    more=st.floats(1e-6, 0.05e-3),
)
def test_a_wider_field_leaves_less(which: str, width: float, more: float) -> None:
    """Catches a tolerance that helps: less interference and margin, more leakage and stress."""
    narrow, wide = (seal_figures(PROTOTYPE.with_values({which: value})) for value in (width, width + more))
    for name in ("fin_interference", "sealing_margin", "lip_safety", "seal_life"):
        assert getattr(wide, name) < getattr(narrow, name), name
    assert wide.largest_interference > narrow.largest_interference  # type: ignore[operator]
    assert wide.air_leakage > narrow.air_leakage  # type: ignore[operator]


def test_a_fin_that_does_not_touch_has_no_leakage_to_tell() -> None:
    loose = figures({"actuator.cylinder.bore_tolerance": "1 mm", "operating_point.pressure": "0 Pa gauge"})
    assert loose.fin_interference < 0  # type: ignore[operator]
    assert loose.air_leakage is None


UNKNOWN = """
[materials.felt]
type = "structural"
density = "1 g/cm^3"
"""


def test_a_lip_of_unknown_stiffness(tmp_path: Path) -> None:
    """Figures that need it are missing with their reason, and the friction asks for a measured force."""
    text = (EXAMPLES / "ipehla-fin.toml").read_text() + UNKNOWN
    lines = [line for line in text.splitlines() if not line.startswith("fin_modulus")]
    (tmp_path / "felt.toml").write_text("\n".join(lines))
    spec = load(tmp_path / "felt.toml", {"actuator.piston.fin_material": '"felt"'})
    found = seal_figures(spec)
    for name in ("seal_friction", "lip_contact_force", "sealing_margin", "fin_interference"):
        assert getattr(found, name) is None, name
    assert found.fin_contact_area is not None
    with pytest.raises(DesignError, match=r"actuator\.seal\.contact_force must be given .*\"felt\".*; got none\.$"):
        friction_law(spec)
    sentences = " ".join(gaps(spec, found))
    for name in ("seal_friction", "sealing_margin", "fin_interference", "air_leakage", "lip_safety"):
        assert f"{name} is not given" in sentences
    assert 'actuator.piston.fin_material "felt" states no young_modulus' in sentences
    known = {"actuator.piston.fin_material": '"felt"', "actuator.piston.fin_modulus": "1 MPa"}
    stiff = load(tmp_path / "felt.toml", known)
    assert 'fin_material "felt" states no poisson_ratio.' in " ".join(gaps(stiff, seal_figures(stiff)))
    measured = spec.with_values({"actuator.seal.contact_force": 20.5})
    assert seal_figures(measured).seal_friction is not None


def test_beyond_the_lips_formulas_is_said() -> None:
    assert warnings(PROTOTYPE) == ()
    (thick,) = warnings(PROTOTYPE.with_values({"actuator.piston.fin_thickness": 0.9e-3}))
    assert "hold below a wall of 0.1 radii and 20 deg of cone" in thick
    (bulged,) = warnings(PROTOTYPE.with_values({"operating_point.pressure": 6e6}))
    assert "bulges against the bore" in bulged


def test_a_seal_that_opens_is_said() -> None:
    """Catches a leakage and a life that stand there as if the lip still pressed."""
    wide = PROTOTYPE.with_values({"actuator.cylinder.bore_tolerance": 0.4e-3})
    assert seal_figures(wide).fin_interference < 0  # type: ignore[operator]
    assert "does not touch the bore without pressure: fin_interference is -0.0252 mm" in " ".join(warnings(wide))
    tight = PROTOTYPE.with_values({"actuator.cylinder.bore_tolerance": 0.027e-3 + 4 * 68.0e-6})
    assert 0 < seal_figures(tight).fin_interference < 0.2e-6  # type: ignore[operator]
    assert "does not touch" not in " ".join(warnings(tight))
    weak = PROTOTYPE.with_values(
        {
            "actuator.piston.fin_outer_diameter": 16.5e-3,
            "actuator.piston.fin_inner_diameter": 15.5e-3,
            "actuator.piston.fin_length": 2.5e-3,
            "actuator.piston.fin_modulus": 1e6,
        }
    )
    margin = seal_figures(weak).sealing_margin
    assert margin is not None
    assert margin < 1
    assert any(
        f"presses with {margin:.3g} of operating_point.pressure, and air lifts it" in text for text in warnings(weak)
    )
    assert not any("lifts" in text for text in warnings(weak.with_values({"operating_point.pressure": 0.0})))


WRONG = {
    "fin below the bore": ({"actuator.piston.fin_outer_diameter": "16 mm"}, "fin_outer_diameter must exceed"),
    "inner above outer": (
        {"actuator.piston.fin_inner_diameter": "16.4 mm"},
        r"fin_inner_diameter must be below actuator\.piston\.fin_outer_diameter 16\.3 mm; got 16\.4 mm",
    ),
    "inner above the bore": (
        {"actuator.piston.fin_inner_diameter": "16.2 mm"},
        r"fin_inner_diameter must be below actuator\.cylinder\.inner_diameter",
    ),
    "no length": ({"actuator.piston.fin_length": "0 mm"}, "fin_length must exceed 0 mm"),
    "negative pressure": ({"operating_point.pressure": "-1 kPa gauge"}, "pressure must be at least 0 MPa gauge"),
    "temperatures swapped": (
        {"operating_point.hottest_temperature": "0 degC"},
        "must not be below operating_point.cold",
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_a_fin_that_cannot_be_is_refused(case: str) -> None:
    """By the reader, in one sentence with both values."""
    changes, sentence = WRONG[case]
    with pytest.raises((SpecError, DesignError), match=sentence) as caught:
        load(EXAMPLES / "ipehla.toml", changes)
    assert str(caught.value).count(". ") == 0
    assert "; got " in str(caught.value)


def test_a_fin_that_a_study_cannot_build_is_a_row_with_its_reason() -> None:
    found = evaluate(PROTOTYPE.with_values({"actuator.piston.fin_outer_diameter": 16.0e-3}), "network")
    assert not found.ok
    assert "fin_outer_diameter must exceed" in found.reasons[0]


def test_derivatives_are_those_of_a_wide_difference() -> None:
    """Catches a figure that jumps or bends within a thousandth: fourth-order differences over a hundred times the
    step."""
    slopes = closed(FIN, gradient=KEYS).gradient
    assert slopes is not None
    assert set(SEAL) <= set(slopes)
    for key in KEYS:
        value = FIN.number(key)
        step = 2e-4 * min(value, 1e-3)
        at = {k: to_mapping(seal_figures(FIN.with_values({key: value + k * step}))) for k in (-2, -1, 1, 2)}
        for name in SEAL:
            far, near = (at[2][name] - at[-2][name]), (at[1][name] - at[-1][name])  # type: ignore[operator]
            expected = (8 * near - far) / (12 * step)
            scale = abs(to_mapping(seal_figures(FIN))[name] / value)  # type: ignore[operator]
            assert slopes[name][key] == pytest.approx(expected, rel=2e-5, abs=1e-6 * scale), (name, key)


def best(spec: Spec) -> tuple[Spec, Performance]:
    result = run_search(spec, None, SerialExecutor(), evaluate=closed, gradients=True)
    assert result.ending == "done"
    assert result.best is not None
    assert result.best.feasible
    return spec.with_values(result.best.values), result.best.evaluation.performance


def aiming_at(figure: str) -> Spec:
    return replace(FIN, study=replace(FIN.study, objective=Objective(figure, maximise=False)))


def no_worse(found: Performance, start: Performance) -> bool:
    """The study's limits, written out once more."""
    below = ("sealing_margin", "fin_interference", "lip_safety", "seal_life")
    return (
        all(getattr(found, name) >= getattr(start, name) * (1 - 1e-6) for name in below)
        and found.air_leakage is not None
        and found.air_leakage <= start.air_leakage * (1 + 1e-6)  # type: ignore[operator]
        and found.lip_contact_force <= start.lip_contact_force * (1 + 1e-6)  # type: ignore[operator]
        and found.fin_angle <= np.radians(20) * (1 + 1e-6)  # type: ignore[operator]
    )


@pytest.mark.parametrize(("figure", "gain"), [("seal_friction", 0.12), ("seal_friction_variation", 0.06)])
def test_the_fin_optimum_beats_the_prototype_and_its_neighbours(figure: str, gain: float) -> None:
    """Less friction at 0.3 MPa under the same margins, and no sound design of 500 around it has less."""
    start = seal_figures(FIN)
    design, found = best(aiming_at(figure))
    assert no_worse(found, start)
    assert warnings(design) == ()
    least = getattr(found, figure)
    assert least < (1 - gain) * getattr(start, figure)
    rng = np.random.default_rng(5)
    variables = FIN.study.variables
    centre = np.array([design.number(variable.key) for variable in variables])
    low, high = (np.array([getattr(variable, side) for variable in variables]) for side in ("lower", "upper"))
    sound = 0
    for _ in range(500):
        width = 10 ** rng.uniform(-3, 0)
        point = np.clip(centre + width * (high - low) * rng.uniform(-0.5, 0.5, len(centre)), low, high)
        tried = seal_figures(design.with_values(dict(zip(KEYS, map(float, point), strict=True))))
        if no_worse(tried, start):
            sound += 1
            assert getattr(tried, figure) > least * (1 - 2e-4)
    assert sound > 5


def test_the_front_of_friction_against_the_margin() -> None:
    """More margin costs friction, all along; the cheap end is the study's own optimum."""
    spec = replace(FIN, study=replace(FIN.study, pareto=Pareto(Objective("sealing_margin", True), points=3)))
    front = run_pareto(spec, None, SerialExecutor(), evaluate=closed)
    assert [point.standing for point in front.points] == ["front"] * 3
    friction, margin = ([getattr(point, side) for point in front.points] for side in ("first", "second"))
    assert friction == sorted(friction)
    assert margin == sorted(margin)
    assert friction[0] == pytest.approx(best(FIN)[1].seal_friction, rel=1e-4)
    assert margin[-1] > 1.02 * margin[0]
