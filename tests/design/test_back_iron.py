"""The three cases of back iron of a lead screw, each against the screw that is built so."""

import pytest
from lead_screws import table_i

from fluxbore.design.back_iron import back_iron_cases
from fluxbore.design.helical_field import force_series, harmonic_ratios, with_remanence

STALL = 192.0


@pytest.mark.parametrize("iron", [(True, True), (True, False), (False, False), (False, True)])
def test_cases_are_those_of_screws_built_so(iron: tuple[bool, bool]) -> None:
    """The specified case is the screw itself; a screw with iron on the rotor alone is none of the paper's."""
    built = table_i(*iron)
    cases = back_iron_cases(built, STALL)
    assert [case.name for case in cases] == ["both members", "translator only", "none"]
    own = [case for case in cases if case.specified]
    assert len(own) == (iron != (False, True))
    for case in own:
        assert (case.second, case.third) == harmonic_ratios(built)
        assert case.stall_force == force_series(built).peak[1]
        assert force_series(with_remanence(built, case.remanence)).peak[1] == pytest.approx(STALL, rel=1e-12)


def test_cases_do_not_depend_on_the_screw_s_own_iron() -> None:
    figures = [
        [(case.second, case.third, case.stall_force, case.remanence) for case in back_iron_cases(screw, STALL)]
        for screw in (table_i(), table_i(False, False))
    ]
    assert figures[0] == figures[1]


def test_less_iron_is_less_force_and_a_wave_with_more_of_its_harmonics() -> None:
    forces, second = zip(*[(case.stall_force, case.second) for case in back_iron_cases(table_i(), STALL)], strict=True)
    assert list(forces) == sorted(forces, reverse=True)
    assert list(second) == sorted(second)
