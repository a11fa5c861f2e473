"""What is gathered for the page beyond what a run found."""

import fluxbore
from fluxbore.design.spec import loads
from fluxbore.design.spec_file import template
from fluxbore.design_result import DesignResult
from fluxbore.report_file import design_evaluation

YOKE = "actuator.back_yoke.thickness"


def test_derivatives_on_the_page_are_those_of_the_study():
    """Catches slopes that let the turns stay where the study holds their density: here they differ in sign."""
    spec = loads(template("ipehla"))
    assert "actuator.winding.turns_density" in spec.study.hold
    plain = fluxbore.evaluate(spec, "network")
    found = design_evaluation(spec, DesignResult(spec, plain, (), "ok", ()))
    wanted = fluxbore.evaluate(spec, "network", gradient=True)
    assert found.performance == plain.performance
    assert found.gradient == wanted.gradient
    assert found.gradient["force_constant"][YOKE] < 0
    with_own = DesignResult(spec, wanted, (), "ok", ())
    assert design_evaluation(spec, with_own) is wanted


def test_without_continuous_variables_there_is_nothing_to_add():
    """Catches an evaluation asked for no key at all."""
    spec = loads(template("ipehla").split("[study]")[0])
    found = fluxbore.evaluate(spec, "network")
    assert design_evaluation(spec, DesignResult(spec, found, (), "ok", ())) is found
