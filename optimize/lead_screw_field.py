"""What the finite elements give of a magnetic lead screw: its field at a few displacements, and its force as a series.

Mirrored along the axis a screw is itself with the displacement reversed, and shifted by a pitch it is itself:

    F(-x) = -F(x),   F(x + l_p) = F(x)

so that F is a sum of sines. In linear materials F(l_p/2 - x) = F(x) too, and they are those of odd order. Iron that
saturates bends that: attracting poles fill it and repelling ones do not. The even sines are the second in the main (to
1e-4 of the force where it is 1.6e-2), which one displacement beyond the quarter tells. The odd ones take `QUARTERS`
displacements up to the quarter and, to have its slope, one next to rest.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from fluxbore.design.errors import DesignError
from fluxbore.design.lead_screw import LeadScrew
from fluxbore.design.lead_screw_values import LeadScrewActuator
from fluxbore.design.materials import PermanentMagnet, SoftIron, lookup
from fluxbore.design.spec import Spec

if TYPE_CHECKING:
    from fluxbore.design.bh_curve import BHCurve
    from fluxbore.design.force_series import Floats, ForceSeries
    from fluxbore.fem.helical import HelicalSolution
    from fluxbore.fem.magnetostatics import Settings
    from fluxbore.fem.newton import Convergence
    from fluxbore.geometry.helical_section import HelicalSection

QUARTERS = 4
"""Displacements that cut a quarter of the pitch into like parts. All are whole cells of the mesh, so that the members'
lines meet as they do at rest. With the slope at rest they give odd harmonics up to n = 9."""

BEYOND = 3 / 8
"""Of the pitch: the mirror of a sample about the quarter, where the second harmonic is largest."""

ORDERS = (*range(1, 2 * QUARTERS + 2, 2), 2)
"""n of the sines through the samples."""

CENTRED = 1e-4
"""Of the pitch: a peak this near to the quarter is taken there, which loses 2e-7 of the force at most."""

REST = 1 / 128
"""Of the pitch: near enough to rest that the flux along the iron is its largest to 3e-4, and so far that what unlike
meshes of the members pull by themselves, a hundred-thousandth of the largest force, leaves the slope right to 5e-4."""

BESIDE = 5e-4
"""Of the pitch, to either side of the series' peak: where narrow magnets bend the force, slopes are of near places."""

FARTHEST = 0.02
"""Of the pitch: by how much more than this the series does not miss its peak."""

LOAD_EXPONENT = 8.0
"""p of the mean of (reverse field)^p over the magnets. The field is infinite where poles meet, so that the largest
value is a number of the mesh; this one is of the volume."""

SLIPPING = 0.5
"""Of the pitch: equal poles face each other, which the magnets bear at every slip."""


@dataclass(frozen=True, eq=False)
class LeadScrewField:
    """The solutions of one screw.

    samples : at `displacements` of the pitch, in that order. slipping : at half a pitch. top : at the peak
    if that is none of the samples, as of narrow magnets beside a narrow gap or of iron that saturates; None otherwise.
    beside : on either side of where the series has its peak, wherever there is a top.
    """

    screw: LeadScrew
    samples: list[HelicalSolution]
    slipping: HelicalSolution | None = None
    top: HelicalSolution | None = None
    beside: tuple[HelicalSolution, ...] = ()

    @property
    def solved(self) -> Iterator[HelicalSolution]:
        """Every state, in the order of solving."""
        yield from self.samples
        yield from (item for item in (self.slipping, self.top) if item is not None)

    @property
    def failure(self) -> tuple[str, Convergence] | None:
        """Where the first field that did not converge is, and how it ended."""
        for item in self.solved:
            if not item.convergence.converged:
                return f"At a displacement of {item.section.displacement * 1e3:.4g} mm: ", item.convergence
        return None

    @property
    def stall(self) -> HelicalSolution:
        """The state of the largest force."""
        return self.top or self.samples[0]

    @property
    def rest(self) -> HelicalSolution:
        """The state next to rest."""
        return self.samples[-1]

    @cached_property
    def series(self) -> ForceSeries:
        """F(x_d) of the whole active length, through the samples."""
        import numpy as np

        from fluxbore.design.force_series import ForceSeries
        from fluxbore.fem.helical_force import force

        forces = np.array([force(item) for item in self.samples]) * periods(self.screw)
        return ForceSeries(interpolation() @ forces, self.screw.pitch, ORDERS)


def periods(screw: LeadScrew) -> float:
    """Periods of the rotor's poles, by which the field's forces of one are multiplied."""
    return screw.poles / 2


def displacements() -> tuple[float, ...]:
    """Of the pitch: the quarter, where the peak is as a rule, comes first and next to rest last."""
    return (*(k / (4 * QUARTERS) for k in range(QUARTERS, 0, -1)), BEYOND, REST)


def interpolation() -> Floats:
    """Matrix that makes amplitudes F_n of `ORDERS` of the forces at `displacements`, of whatever pitch."""
    import numpy as np

    return np.asarray(np.linalg.inv(np.sin(2 * np.pi * np.outer(displacements(), ORDERS))))


def magnetised(spec: Spec) -> LeadScrew:
    """The screw with its materials at the specification's temperature. Raises MaterialError."""
    actuator: LeadScrewActuator = spec.actuator
    return actuator.magnetised(spec.materials, spec.number("operating_point.magnet_temperature"))


def section(spec: Spec, screw: LeadScrew, displacement: float) -> HelicalSection:
    """The cross-section at a displacement x_d (m), iron with its curves."""
    from fluxbore.geometry.lead_screw import helical_section

    actuator: LeadScrewActuator = spec.actuator
    return helical_section(
        screw,
        displacement,
        _curve(spec, "translator", actuator.translator.iron, screw.translator.iron_thickness),
        _curve(spec, "rotor", actuator.rotor.iron, screw.rotor.iron_thickness),
    )


def solve_field(spec: Spec, screw: LeadScrew) -> LeadScrewField:
    """All of the screw's fields; it ends at the first that does not converge.

    The largest force is read off a field at the peak itself, where it is level: as far as the place is missed, the
    force is short by the square of that. Raises DesignError where no force pulls back to rest.
    """
    field = LeadScrewField(screw, _solve(spec, screw, displacements()))
    if field.failure is not None:
        return field
    series = field.series
    place, peak = series.peak
    check_force(spec, peak)
    near = field.samples[0]
    field = replace(field, slipping=_solve(spec, screw, (SLIPPING,), near)[0])
    share = place / screw.pitch
    return field if abs(share - 0.25) <= CENTRED else _topped(spec, field, share)


def _topped(spec: Spec, field: LeadScrewField, share: float) -> LeadScrewField:
    """With the field at the peak, which the series puts at a share of the pitch and may miss by half a per cent of it;
    two fields side by side there tell how far to go on."""
    from fluxbore.fem.helical_force import force

    near = field.samples[0]
    pair = _solve(spec, field.screw, (share - BESIDE, share + BESIDE), near)
    if not pair[-1].convergence.converged:
        return replace(field, top=pair[-1])
    below, above = (force(item) * periods(field.screw) for item in pair)
    top = _solve(spec, field.screw, (peak_share(field.series, share, below, above),), near)[0]
    return replace(field, top=top, beside=tuple(pair))


def peak_share(series: ForceSeries, share: float, below: float, above: float) -> float:
    """Where the largest force is, of the pitch, by one step of Newton's from the share where the series has its peak:
    with its curvature, and the slope between the forces (N) `BESIDE` below and above."""
    curvature = series.curvature(share * series.pitch) * series.pitch**2
    step = -(above - below) / (2 * BESIDE) / curvature if curvature < 0 else 0.0
    return share + max(-FARTHEST, min(FARTHEST, step))


def field_figures(spec: Spec, field: LeadScrewField) -> dict[str, float | None]:
    """What the fields give beside the force, by figure: flux along the iron at rest, where both members' add up, and
    the magnets' reverse field where the screw slips. Of arcs only the mean is computed, thinner than any magnet."""
    from fluxbore.design.lead_screw_figures import along_iron
    from fluxbore.fem.helical_flux import flux_function
    from fluxbore.fem.helical_iron_flux import layer_flux
    from fluxbore.fem.helical_magnets import demagnetised_fraction, mean_load, reverse_load

    screw, names = field.screw, [layer.name for layer in field.rest.section.layers]
    found: dict[str, float | None] = {}
    psi = flux_function(field.rest) if {"translator iron", "rotor iron"} & set(names) else None
    for member in ("translator", "rotor"):
        figure, iron = f"{member}_iron_flux_density", f"{member} iron"
        if psi is None or iron not in names:
            found[figure] = None
            continue
        layer = names.index(iron)
        passed = layer_flux(field.rest, psi, layer)
        found[figure] = along_iron(screw, passed, *field.rest.section.radii[layer : layer + 2])
    whole = screw.translator.arcs is None and screw.rotor.arcs is None
    if field.slipping is not None and whole:
        limits = {names.index(f"{member} magnets"): coercivity(spec, member) for member in ("translator", "rotor")}
        state = reverse_load(field.slipping, limits)
        found["demagnetised_fraction"] = demagnetised_fraction(*state)
        found["demagnetisation_load"] = mean_load(*state, LOAD_EXPONENT)
    return found


def check_force(spec: Spec, peak: float) -> None:
    """Raise DesignError, one sentence, where the peak (N) of the force over the first quarter is not above zero: arcs
    so long that their steps turn the poles over."""
    if peak > 0:
        return
    from fluxbore.design.units import format_quantity

    found = [
        f"actuator.{member}.arc_angle {format_quantity(spec.number(f'actuator.{member}.arc_angle'), 'angle')}"
        for member in ("translator", "rotor")
        if f"actuator.{member}.arc_angle" in spec.values
    ]
    raise DesignError(
        "The poles must pull each other back to rest over the first quarter of actuator.pitch with more than 0 N; got "
        f"{peak:.3g} N{' with ' + ' and '.join(found) if found else ''}."
    )


def _solve(
    spec: Spec, screw: LeadScrew, shares: tuple[float, ...], near: HelicalSolution | None = None
) -> list[HelicalSolution]:
    """The field at each of some displacements (of the pitch), each begun from the one before."""
    from fluxbore.fem.helical import solve

    settings, refinement = _settings(spec), int(spec.number("solver.mesh_refinement"))
    solved: list[HelicalSolution] = []
    for share in shares:
        near = solve(section(spec, screw, share * screw.pitch), refinement, settings, near)
        solved.append(near)
        if not near.convergence.converged:
            break
    return solved


def coercivity(spec: Spec, member: str) -> float:
    """A/m, of a member's magnets at their temperature."""
    key = f"actuator.{member}.magnet"
    grade = lookup(spec.word(key), key, spec.materials, PermanentMagnet)
    return grade.coercivity_at(spec.number("operating_point.magnet_temperature"))


def _curve(spec: Spec, member: str, iron: str, thickness: float) -> BHCurve | None:
    return lookup(iron, f"actuator.{member}.iron", spec.materials, SoftIron).curve if thickness > 0 else None


def _settings(spec: Spec) -> Settings:
    from fluxbore.fem.magnetostatics import Settings

    return Settings(spec.number("solver.tolerance"), int(spec.number("solver.max_iterations")), "auto")
