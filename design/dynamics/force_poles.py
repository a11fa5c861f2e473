"""Poles of the force control over the RotLin paper's grid: K_e to 5000 kN/m (Fig. 23), K_l* to 10 000 kN/m (Fig. 24).

The loop is linearised (`linearised`), with the disturbance observer on the rotor's own speed, as the appendix has it,
and on the filtered speed, as it can be built.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.force_control import force_loop
from fluxbore.design.dynamics.force_parameters import ForceParameters
from fluxbore.design.dynamics.force_stand import controller_of, stand_of
from fluxbore.design.dynamics.linearised import UNFILTERED, ForceLoop, force_characteristic
from fluxbore.design.poles import Complex, loci, poles
from fluxbore.design.routh_hurwitz import sign_changes

Floats = NDArray[np.float64]

LARGEST_K_E, LARGEST_K_L = 5e6, 10e6
"""N/m, of Figs. 23 and 24."""

STIFFNESSES, SLOPES = 75, 60
"""Values of K_e and of K_l* on the grid, evenly spaced; the first is a step above zero, where a pole lies at zero."""

OTHER_DAMPINGS = (0.0, 10.0, 1000.0)
"""N s/m, D_e beside the load's own."""

UNIT = 100.0
"""rad/s, near the middle of the loop's poles."""


@dataclass(frozen=True, slots=True)
class PoleSurvey:
    """Over the grid: the largest real part of any pole (1/s), at which K_e, K_l* (N/m) and D_e (N s/m) it lies, and
    how many of the grid's points are unstable."""

    largest: float
    stiffness: float
    slope: float
    damping: float
    unstable: int
    points: int


def nominal_loop(parameters: ForceParameters, force: float = 0.0) -> ForceLoop:
    """The loop about a spring force (N) on the benchmark's own load."""
    stand = stand_of(parameters)
    return force_loop(stand.plant, stand.environment, controller_of(parameters), force)


def pole_set(loop: ForceLoop, observer_speed: str = UNFILTERED) -> Complex:
    """The six poles (1/s), the slowest first."""
    return poles(force_characteristic(loop, observer_speed), UNIT)


def grid_axes(parameters: ForceParameters) -> tuple[Floats, Floats, Floats]:
    """K_e (N/m), K_l* (N/m) and D_e (N s/m) along the grid: the load's own damping and the others."""
    stiffness = np.linspace(0, LARGEST_K_E, STIFFNESSES + 1)[1:]
    slope = np.linspace(0, LARGEST_K_L, SLOPES + 1)[1:]
    return stiffness, slope, np.unique([parameters.load_damping, *OTHER_DAMPINGS])


def grid_loop(parameters: ForceParameters) -> ForceLoop:
    """The loop whose coefficients are arrays over all of the grid."""
    stiffness, slope, damping = grid_axes(parameters)
    return replace(
        nominal_loop(parameters), K_e=stiffness[:, np.newaxis, np.newaxis], K_l=slope[:, np.newaxis], D_e=damping
    )


def unstable_by_routh(parameters: ForceParameters, observer_speed: str = UNFILTERED) -> int:
    """How many points of the grid have a pole in the right half plane by Routh's table, which computes no pole."""
    return int(np.count_nonzero(sign_changes(force_characteristic(grid_loop(parameters), observer_speed)) > 0))


def survey(parameters: ForceParameters, observer_speed: str = UNFILTERED) -> PoleSurvey:
    """All of the grid, by its poles."""
    stiffness, slope, damping = grid_axes(parameters)
    real = pole_set(grid_loop(parameters), observer_speed)[..., 0].real
    at = np.unravel_index(int(np.argmax(real)), real.shape)
    return PoleSurvey(
        float(real[at]),
        float(stiffness[at[0]]),
        float(slope[at[1]]),
        float(damping[at[2]]),
        int(np.count_nonzero(real > 0)),
        real.size,
    )


def locus_over_load(parameters: ForceParameters, stiffness: Floats, observer_speed: str = UNFILTERED) -> Complex:
    """(n, 6) poles, a branch in each column, over stiffnesses K_e (n,) (N/m) of the load at no force: Fig. 23."""
    return loci(pole_set(replace(nominal_loop(parameters), K_e=stiffness), observer_speed))


def locus_over_spring(parameters: ForceParameters, slope: Floats, observer_speed: str = UNFILTERED) -> Complex:
    """The same over slopes K_l* (n,) (N/m) of the spring, each above zero: Fig. 24."""
    return loci(pole_set(replace(nominal_loop(parameters), K_l=slope), observer_speed))
