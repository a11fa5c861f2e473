"""The tracking benchmark's identification of friction: measured forces drawn by a seed, and what the fit makes of them.

As in the paper on the PREHydrA (Sec. III-A) the input cylinder is driven at constant speeds, and the pressure's share
f_C p is taken off: points of speed and force without pressure. How many, how spaced and how scattered they were is not
published; about thirty even speeds from 3 mm/s on and a scatter of 2 N give standard errors such as Table I has.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.cylinder_friction import CylinderFriction, cylinder_friction
from fluxbore.design.dynamics.tracking_stand import TrackingStand
from fluxbore.design.errors import IdentificationError
from fluxbore.design.friction_points import FrictionPoints
from fluxbore.design.hydrostatic_friction_identification import expected_errors, identify_cylinder_friction
from fluxbore.design.tracking_benchmark_keys import EVEN, GEOMETRIC

Floats = NDArray[np.float64]

SOURCE = "the simulated runs at constant speed"


def identification_speeds(stand: TrackingStand, spacing: str | None = None) -> Floats:
    """(speeds,) m/s, spaced as the stand has it or as told."""
    among = np.linspace if (spacing or stand.spacing) == EVEN else np.geomspace
    return np.asarray(among(stand.slowest_speed, stand.fastest_speed, stand.speeds), dtype=np.float64)


def friction_measurements(
    law: CylinderFriction, stand: TrackingStand, seed: int, spacing: str | None = None
) -> FrictionPoints:
    """Points at zero pressure, with normal scatter of the stand's noise drawn by the seed."""
    speeds = identification_speeds(stand, spacing)
    scatter = stand.noise * np.random.default_rng(seed).standard_normal(len(speeds))
    still = np.zeros_like(speeds)
    return FrictionPoints(speeds, still, cylinder_friction(law, speeds, still) + scatter, SOURCE)


def identified(law: CylinderFriction, stand: TrackingStand, seed: int) -> dict[str, Any]:
    """The figures of one identification, JSON-ready.

    identified_friction : by parameter its value and standard error; where the seed's data do not tell the parameters it
    is empty, and identification_refused says why. identified_friction_geometric : from as many speeds, spaced
    geometrically. expected_standard_error : before measuring, by parameter.
    """
    expected = {
        spacing: {
            name: error if np.isfinite(error) else None
            for name, error in expected_errors(law, identification_speeds(stand, spacing), stand.noise).items()
        }
        for spacing in (EVEN, GEOMETRIC)
    }
    found, refused = _fit(law, friction_measurements(law, stand, seed))
    geometric, _ = _fit(law, friction_measurements(law, stand, seed, GEOMETRIC))
    return {
        "identified_friction": found,
        "identification_refused": refused,
        "identified_friction_geometric": geometric,
        "expected_standard_error": expected[stand.spacing],
        "expected_standard_error_geometric": expected[GEOMETRIC],
    }


def _fit(law: CylinderFriction, points: FrictionPoints) -> tuple[dict[str, dict[str, float]], str | None]:
    """The parameters, f_C taken as known; or none of them, and why."""
    try:
        fit = identify_cylinder_friction(points, known_pressure_coefficient=law.pressure_coefficient)
    except IdentificationError as error:
        return {}, str(error)
    return {
        name: {"value": each.value, "standard_error": each.standard_error, "low": each.low, "high": each.high}
        for name, each in fit.parameters.items()
    }, None
