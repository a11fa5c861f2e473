"""The three cases of back iron that the RotLin paper's analytic field can have, beside one another.

"Novel force estimation method for magnetic lead screw-based RotLin actuator": its (7) to (10) do not say which
members have iron behind their magnets. Valid as `fluxbore.design.helical_field` is: iron that does not saturate.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from fluxbore.design.helical_field import force_series, harmonic_ratios, remanence_for_stall_force
from fluxbore.design.lead_screw import LeadScrew

CASES = (("both members", True, True), ("translator only", True, False), ("none", False, False))
"""In words, and whether there is iron behind the translator's and the rotor's magnets."""


@dataclass(frozen=True, slots=True)
class BackIronCase:
    """One case of a screw.

    specified : whether the screw itself is of this case. second, third : K_2/K_1 and K_3/K_1. stall_force : N, with
    the screw's own magnets. remanence : T, of both members' magnets, with which the stall force is the one asked for.
    """

    name: str
    specified: bool
    second: float
    third: float
    stall_force: float
    remanence: float


def back_iron_cases(screw: LeadScrew, stall_force: float) -> tuple[BackIronCase, ...]:
    """The cases of a screw, with the remanence for a stall force (N).

    Raises DesignError for a stall force that is not above zero, and where no field crosses the gap.
    """
    found = []
    own = screw.translator.iron_thickness > 0, screw.rotor.iron_thickness > 0
    for name, *iron in CASES:
        case = replace(
            screw,
            translator=replace(screw.translator, iron_thickness=_behind(screw.translator.iron_thickness, iron[0])),
            rotor=replace(screw.rotor, iron_thickness=_behind(screw.rotor.iron_thickness, iron[1])),
            frame_radius=screw.frame_radius + THIN,
        )
        second, third = harmonic_ratios(case)
        remanence = remanence_for_stall_force(case, stall_force)
        stall = force_series(case).peak[1]
        found.append(BackIronCase(name, own == tuple(iron), second, third, stall, remanence))
    return tuple(found)


THIN = 1e-9
"""m, of iron where the screw has none: the closed form knows only whether there is any."""


def _behind(own: float, iron: bool) -> float:
    return max(own, THIN) if iron else 0.0
