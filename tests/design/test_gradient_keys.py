"""By which keys derivatives are taken, and what is refused before anything is computed."""

import pytest

from fluxbore.design.errors import SpecError
from fluxbore.design.gradient_keys import gradient_keys
from fluxbore.design.spec import Spec, loads
from fluxbore.design.spec_file import template

RING, YOKE, SETS = "actuator.mover.ring_width", "actuator.back_yoke.thickness", "actuator.winding.sets_per_phase"
COUNT = f'\n[[study.variables]]\nkey = "{SETS}"\nlower = 6\nupper = 9\n'


@pytest.fixture
def spec() -> Spec:
    return loads(template("ipehla") + COUNT)


def test_the_study_s_continuous_variables_are_the_default(spec):
    assert gradient_keys(spec) == (RING, YOKE)


def test_any_continuous_key_may_be_asked_for_once(spec):
    assert gradient_keys(spec, ["operating_point.current", YOKE, YOKE]) == ("operating_point.current", YOKE)


@pytest.mark.parametrize(
    "asked, sentence",
    [
        ([], 'gradient must list dotted keys, ["actuator.mover.ring_width"]; got [].'),
        (RING, f'got "{RING}".'),
        ([SETS], f"gradient must name continuous quantities that have a value; got {SETS}."),
        (["actuator.name"], "got actuator.name."),
        (["solver.tolerance"], "got solver.tolerance."),
        (["actuator.ring_width"], f"is not a key of this specification (did you mean {RING}?)."),
    ],
)
def test_what_has_no_derivative_is_refused(spec, asked, sentence):
    with pytest.raises(SpecError) as caught:
        gradient_keys(spec, asked)
    assert sentence in str(caught.value)


def test_counts_alone_have_none():
    text = template("ipehla")
    text = text[: text.index("[[study.variables]]")] + COUNT
    with pytest.raises(SpecError, match=rf"got counts alone, {SETS}\.$"):
        gradient_keys(loads(text))
