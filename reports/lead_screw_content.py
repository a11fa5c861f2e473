"""What the report shows of a magnetic lead screw alone: its spring, its field, its pitch, its back iron."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fluxbore.design.back_iron import BackIronCase
from fluxbore.design.force_series import ForceSeries
from fluxbore.design.lead_screw import LeadScrew
from fluxbore.optimize.pitch_curve import PitchCurve

if TYPE_CHECKING:
    from fluxbore.fem.field_loads import Load
    from fluxbore.reports.content import FluxMap


@dataclass(frozen=True, slots=True)
class SpringSample:
    """At one displacement (m): force (N) of the active length."""

    displacement: float
    force: float


@dataclass(frozen=True, slots=True, eq=False)
class ScrewContent:
    """SI units.

    screw : with the remanences of its grades. spring : the force over the displacement by finite elements; analytic :
    by the closed form. samples : where the finite elements were solved. peak : displacement of the largest force
    and that force, of a field solved there; where iron saturates sharply the series between the samples is out by some
    per cent. field_energy : by which the field of the
    active length exceeds that at rest when it is half a pitch away. rest, stall : maps over two pitches, `z` being ζ
    and `position` the displacement. positions, engaged : of the mover, from the middle, and the stall force that is
    left there. stroke : between the mover's ends. iron : cases of back iron for the stall force `iron_force`.
    pitch : the same design with other pitches; None where it has no figures. loads : of iron and magnets where the
    screw slips.
    """

    screw: LeadScrew
    spring: ForceSeries
    analytic: ForceSeries
    samples: tuple[SpringSample, ...]
    peak: tuple[float, float]
    field_energy: float
    rest: FluxMap
    stall: FluxMap
    positions: tuple[float, ...]
    engaged: tuple[float, ...]
    stroke: float
    iron: tuple[BackIronCase, ...]
    iron_force: float
    pitch: PitchCurve | None
    loads: tuple[Load, ...] = ()

    def rest_under(self, load: float) -> float | None:
        """Where the spring rests (m) under a load (N); None where the screw slips."""
        return self.spring.rest(load) if load <= self.peak[1] else None
