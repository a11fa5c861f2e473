"""The steps of a whole run, with coils whose field costs milliseconds: what a robust search hands on."""

from dataclasses import replace

import pytest
from coil_study import SPEC

from fluxbore.design.spec import Spec, loads
from fluxbore.design_result import DesignResult, searched
from fluxbore.design_steps import every_design, search_design, with_front, with_tolerances
from fluxbore.optimize.executor import SerialExecutor
from fluxbore.workshop import Workshop

SHOP = Workshop(None, SerialExecutor())


@pytest.fixture(scope="module")
def plain() -> Spec:
    return loads(SPEC)


@pytest.fixture(scope="module")
def sought(plain) -> DesignResult:
    return search_design(plain, SHOP, None)


@pytest.fixture(scope="module")
def robust() -> tuple[Spec, DesignResult]:
    spec = loads(SPEC, {"study.production.yield": "0.9"})
    return spec, search_design(spec, SHOP, None)


def test_a_robust_design_is_held_against_the_study_s_own_limits(robust):
    """Catches checks, or a design.toml, with the limits that the search backed off."""
    spec, found = robust
    assert found.ok
    assert found.robust is not None
    assert len(found.robust.rounds) > 1
    assert [item.limit.limit for item in found.checks] == [1.5e-3]
    assert [limit.upper for limit in found.spec.study.constraints] == [1.5e-3]
    assert found.checks[0].margin > 1e-3  # the room that was bought
    assert len(found.history) == sum(len(item.search.history) for item in found.robust.rounds)
    assert with_tolerances(spec, found, SHOP, None) is found  # already known


def test_the_robust_search_s_start_is_the_specification_s(robust):
    spec, found = robust
    assert found.search is not None
    assert found.search.start.values["actuator.coil_2.radius"] == spec.number("actuator.coil_2.radius")


def test_the_production_of_the_design_that_was_found(plain, sought):
    found = with_tolerances(plain, sought, SHOP, None)
    assert found.search is not None
    assert found.tolerance is not None
    assert found.tolerance.values["actuator.coil_2.radius"] == found.search.chosen.values["actuator.coil_2.radius"]
    assert found.tolerance.requirements[0].limit.limit == 1.5e-3


def test_a_tolerance_that_cannot_be_analysed_is_a_warning_and_not_the_end(plain, sought, monkeypatch):
    from fluxbore import design_steps
    from fluxbore.design.errors import DesignError

    def fails(*_: object, **__: object) -> None:
        raise DesignError("No figures.")

    monkeypatch.setattr(design_steps, "run_tolerance", fails)
    warned = with_tolerances(plain, sought, SHOP, None)
    assert warned.tolerance is None
    assert warned.warnings == ("No tolerance analysis: No figures.",)


def test_nothing_is_analysed_that_was_not_asked_for(plain):
    bare = replace(plain, study=replace(plain.study, pareto=None, production=None))
    found = search_design(bare, SHOP, None)
    assert with_front(bare, found, SHOP, None) is found
    assert with_tolerances(bare, found, SHOP, None) is found


def test_an_interrupted_search_ends_the_run(plain, monkeypatch):
    """What follows must not run on a design of halfway."""
    from fluxbore import design_steps

    found = searched(plain, replace(design_steps.run_search(plain, None, SerialExecutor()), ending="interrupted"))
    monkeypatch.setattr(design_steps, "run_search", lambda *_: found.search)
    with pytest.raises(KeyboardInterrupt):
        search_design(plain, SHOP, None)


def test_the_front_s_designs_are_tabled_beside_the_search_s(plain, sought):
    """Catches a table without them, and one that has a design of both twice."""
    found = with_front(plain, sought, SHOP, None)
    designs = [tuple(made.values.items()) for made in every_design(found)]
    assert designs[: len(found.history)] == [tuple(made.values.items()) for made in found.history]
    assert {tuple(made.values.items()) for made in found.front.history} <= set(designs)
    assert len(designs) < len(found.history) + len(found.front.history)
    assert every_design(replace(found, front=None)) == found.history
