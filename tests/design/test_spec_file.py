"""Specifications written and read again: the same floats, the same study, the same figures."""

from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from fluxbore.design.errors import DesignError, SpecError
from fluxbore.design.spec import Spec, load, loads
from fluxbore.design.spec_file import template, template_names, to_toml
from fluxbore.design.study import (
    Axis,
    Constraint,
    Objective,
    Pareto,
    Production,
    Search,
    Study,
    Sweep,
    Tolerance,
    Variable,
)
from fluxbore.design.units import DIMENSIONS
from fluxbore.optimize.evaluate import evaluate

EXAMPLES = Path(__file__).parents[2] / "examples"
IPEHLA = loads(template("ipehla"))
RING, YOKE = "actuator.mover.ring_width", "actuator.back_yoke.thickness"
SETS = "actuator.winding.sets_per_phase"


def again(spec: Spec) -> Spec:
    return loads(to_toml(spec, "A remark,\nof two lines."))


def test_the_template_is_the_example():
    """Catches an example that is mended and a template that is not; an installed wheel has the template alone."""
    assert template_names() == ("ipehla", "prehydra", "rotlin", "team22")
    for name in template_names():
        assert template(name) == (EXAMPLES / f"{name}.toml").read_text(encoding="utf-8")
        assert template(name).isascii()  # whatever encoding the terminal redirects in


@pytest.mark.parametrize("name", ["", "nope", "../ipehla", "ipehla.toml"])
def test_there_is_no_other_template(name):
    with pytest.raises(SpecError, match=r"^There is a template for ipehla, prehydra, rotlin, team22; got "):
        template(name)


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.toml")), ids=lambda path: path.stem)
def test_examples_survive_to_the_last_bit(path):
    spec = load(path)
    found = again(spec)
    assert dict(found.given) == dict(spec.given)
    assert found.study == spec.study
    assert found.notes == spec.notes
    assert found.fingerprint() == spec.fingerprint()
    assert to_toml(found) == to_toml(spec)


@given(st.data())
@settings(max_examples=60, deadline=None)
def test_any_valid_design_survives_to_the_last_bit(data):
    """Random neighbours of the example, in random units, through whichever alternatives are chosen."""
    held = [
        group.keys[i]
        for group in IPEHLA.kind.alternatives
        for i in data.draw(st.permutations(range(len(group.keys))))[: group.count]
    ]
    base = IPEHLA.pinned(held)
    changes = {}
    for key in base.kind.keys:
        value = base.given.get(key.name)
        if key.kind == "quantity" and isinstance(value, float) and data.draw(st.booleans()):
            changes[key.name] = value * data.draw(st.floats(0.98, 1.02))
    try:
        spec = base.with_values(changes)
        spec.actuator
        found = again(spec)
    except (DesignError, SpecError):
        assume(False)
    assert dict(found.given) == dict(spec.given)
    assert dict(found.values) == dict(spec.values)


@given(st.sampled_from([key for key in IPEHLA.kind.keys if key.kind == "quantity"]), st.data())
@settings(deadline=None)
def test_every_unit_of_every_key_survives(key, data):
    """Catches a unit whose value cannot be written in the preferred unit without a loss."""
    unit = data.draw(st.sampled_from(sorted(DIMENSIONS[key.dimension].units)))
    number = data.draw(st.floats(0.0, 500.0).map(lambda x: round(x, 6)))
    try:
        value = key.read(f"{number!r} {unit}")
    except SpecError:
        assume(False)
    found = key.read(key.write(value).strip('"'))
    exact = DIMENSIONS[key.dimension].units[DIMENSIONS[key.dimension].preferred].offset == 0
    assert found == (value if exact else pytest.approx(value, rel=1e-15, abs=1e-13))


def test_a_study_with_everything_survives():
    study = Study(
        objective=Objective("total_mass", False),
        variables=(Variable(RING, 1e-3, 2.1e-3), Variable("operating_point.magnet_temperature", 293.15, 353.15, 5.0)),
        constraints=(
            Constraint("stray_field", 1.1, None, True),
            Constraint("force_constant", None, 8.1),
            Constraint("turns", 600.5, 500.0),
            Constraint(SETS, 8.5),
            Constraint(RING, 2e-3, 1.1e-3),
        ),
        sweeps=(
            Sweep('a "name" with \\ and é', (Axis(SETS, (8.0, 9.0)), Axis(YOKE, (1e-4, 4e-4)))),
            Sweep("one", (Axis(RING, (0.0, 0.1 + 0.2e-3)),), 1.5e-3, "somebody, 2023"),
        ),
        hold=("actuator.winding.turns_density",),
        search=Search("CRS2", 7, 1.0 / 3, 5, 600.0 / 7, "manifold"),
        pareto=Pareto(Objective("stray_field", False), 5, "normal boundary intersection"),
        production=Production(
            (
                Tolerance(YOKE, -1e-5, 1e-5),
                Tolerance(RING, 0.0, 1e-4 / 3, "uniform"),
                Tolerance("operating_point.magnet_temperature", -1.0, 2.5, "triangular"),
            ),
            500, 3, 9, 2.0 / 3,
        ),
    )  # fmt: skip
    found = again(replace(IPEHLA, study=study)).study
    assert found == study
    assert repr(found) == repr(study)  # what the fingerprint is made of


def test_a_count_as_a_variable_survives():
    study = Study(objective=Objective("total_mass", False), variables=(Variable(SETS, 6.0, 9.0, None, True),))
    found = again(replace(IPEHLA, study=study)).study
    assert found == study
    assert repr(found) == repr(study)


def test_a_count_that_a_search_chose_is_written_as_one():
    """Catches a design.toml with "pole_pairs = 5.0", which no longer reads."""
    design = IPEHLA.with_values({SETS: 7.0})
    assert again(design).given[SETS] == 7


def test_own_materials_and_odd_names_survive():
    own = (
        '[materials."my \\"iron\\" <1>"]\ntype = "soft iron"\ndensity = "7.85 g/cm^3"\nbh = [[0.5, 100], [1.5, 1000.2]]'
    )
    text = f"{template('ipehla')}\n{own}\n"
    spec = loads(text, {"actuator.back_yoke.material": 'my "iron" <1>'})
    spec = loads(
        text.replace('value = "1010", assumed = "the paper', 'value = "my \\"iron\\" <1>", assumed = "the paper')
    )
    spec = replace(spec, given={**spec.given, "actuator.name": 'A/B "<C>" \\ Ä'})
    found = again(spec)
    assert found.word("actuator.name") == 'A/B "<C>" \\ Ä'
    assert found.materials['my "iron" <1>'] == spec.materials['my "iron" <1>']
    assert found.fingerprint() == spec.fingerprint()


def test_figures_of_a_written_design_are_the_same_bits_by_the_network():
    """design.toml stands for the report's design: it is promised to 1e-9, and is exact."""
    design = IPEHLA.for_study().with_values({RING: 0.0018333333333333333, YOKE: 0.0005000000000000001})
    assert evaluate(again(design), "network") == evaluate(design, "network")


def test_figures_of_a_written_design_are_the_same_bits_by_finite_elements():
    design = loads(template("ipehla"), {"operating_point.positions": "1"}).for_study()
    design = design.with_values({RING: 0.0018333333333333333, YOKE: 0.0005000000000000001})
    found = evaluate(again(design))
    assert found.ok
    assert found == evaluate(design)
