"""What the benchmark of a lead screw's force knows of its stand: the keys `benchmark.force.*` as one typed set.

Where a value is published, assumed or calibrated stands with the value, in the specification; what a key means stands
with the key. What the section leaves out of the screw itself is the design's own.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluxbore.design.dynamics.bouc_wen import BoucWen
from fluxbore.design.dynamics.magnetic_hysteresis import HysteresisSpring
from fluxbore.design.dynamics.magnetic_spring import SineSpring
from fluxbore.design.errors import SpecError
from fluxbore.design.force_benchmark_keys import PREFIX
from fluxbore.design.keys import Values
from fluxbore.design.lead_screw_figures import full_engagement
from fluxbore.design.lead_screw_values import LeadScrewActuator

Floats = NDArray[np.float64]

OF_THE_SCREW = ("stall_force", "spring_constant", "mass", "inertia", "angle_count")
"""Keys that follow from the design where they are not given."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ForceParameters:
    """SI units. The first three are the design's, the others the keys of these names (`force_benchmark_keys`).

    transfer_ratio : h (m/rad). torque_constant : K_tn (N m/A). travel : over which all poles are engaged (m).
    Plant and controller share the screw's: nothing else is known of it. The waves of the zero-force line are zero at
    angle and position zero, where the encoders are zeroed.
    """

    transfer_ratio: float
    torque_constant: float
    travel: float
    stall_force: float
    spring_constant: float
    mass: float
    inertia: float
    elastic_share: float
    phi: float
    psi: float
    xi: float
    eta: float
    position_gain: float
    speed_gain: float
    observer_cutoff: float
    speed_cutoff: float
    load_cutoff: float
    control_period: float
    smooth_friction: float
    friction_sharpness: float
    friction_jump: float
    position_count: float
    angle_count: float
    load_stiffness: float
    load_damping: float
    friction: float
    bristle_stiffness: float
    bristle_damping: float
    distortion: float
    second_order: float
    sixth_order: float
    translator_order: float
    translator_wave: float
    frequency: float
    duration: float
    detection_speed: float
    first_peak: float
    second_peak: float
    third_peak: float
    lower_peak: float
    first_loop: float
    second_loop: float
    first_step: float
    second_step: float

    @property
    def spring(self) -> HysteresisSpring:
        """(17) and (18)."""
        law = SineSpring(self.stall_force, self.transfer_ratio)
        return HysteresisSpring(law, self.elastic_share, BoucWen(self.phi, self.psi, self.xi, self.eta))

    @property
    def peaks(self) -> Mapping[str, float]:
        """Experiment -> largest load force (N), Sec. IV-B."""
        return {"1": self.first_peak, "2": self.second_peak, "3": self.third_peak}

    @property
    def references(self) -> tuple[float, float]:
        """N, of the two steps of the force."""
        return self.first_step, self.second_step

    def zero_force_line(self, angle: ArrayLike, position: ArrayLike) -> Floats:
        """x_d0 (m) at rotor angles (rad) and mover positions (m); they broadcast."""
        theta = np.asarray(angle, dtype=np.float64)
        along = math.tau / self.translator_wave * np.asarray(position, dtype=np.float64)
        shape = np.sin(theta) + self.second_order * np.sin(2 * theta) + self.sixth_order * np.sin(6 * theta)
        return np.asarray(self.distortion * (shape + self.translator_order * np.sin(along)))


def force_parameters(
    actuator: LeadScrewActuator, values: Values, own: Mapping[str, float | None] | None = None
) -> ForceParameters:
    """The set of a specification's resolved values.

    own : by the names of `OF_THE_SCREW`, what the design itself has where the section gives nothing. Raises SpecError
    for what neither has.
    """
    if actuator.torque_constant is None:
        raise SpecError("actuator.motor.torque_constant is missing: the benchmark of the force has a motor.")
    screw = actuator.shape
    read = {
        "transfer_ratio": screw.h,
        "torque_constant": actuator.torque_constant,
        "travel": 2 * full_engagement(screw),
    }
    for field in fields(ForceParameters):
        if field.name not in read:
            given = values.get(PREFIX + field.name, (own or {}).get(field.name))
            if given is None:
                raise SpecError(f"{PREFIX}{field.name} is missing: the design itself has no such figure.")
            read[field.name] = float(given)
    return ForceParameters(**read)
