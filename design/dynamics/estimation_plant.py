"""A stand-in for the RotLin actuator on its test stand: what the paper gives of it, and what it leaves open.

Published values bear their table, assumed ones their reason; both are read by `sources`. They are a plant to try force
estimation on, whose true load is known; no measurement of the paper's.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluxbore.design.dynamics.bouc_wen import BoucWen
from fluxbore.design.dynamics.magnetic_hysteresis import HysteresisSpring
from fluxbore.design.dynamics.magnetic_spring import SineSpring

Floats = NDArray[np.float64]


def _published(default: float, unit: str, source: str) -> Any:
    return field(default=default, metadata={"unit": unit, "source": source, "kind": "published"})


def _assumed(default: float, unit: str, reason: str) -> Any:
    return field(default=default, metadata={"unit": unit, "source": reason, "kind": "assumed"})


def _calibrated(default: float, unit: str, how: str) -> Any:
    return field(default=default, metadata={"unit": unit, "source": how, "kind": "calibrated"})


@dataclass(frozen=True, slots=True)
class RotLinPlant:
    """SI units. Angles of the distortion's waves are zero at angle and position zero, where the encoders are zeroed."""

    pitch: float = _published(36e-3 / 7, "m", "Table I, 5.1429 mm, which is 36/7")
    stall_force: float = _published(192.0, "N", "Table II")
    weight: float = _published(0.96, "1", "Table II, w")
    phi: float = _published(1.0, "1", "Table II")
    psi: float = _published(3000.0, "1/m", "Table II")
    xi: float = _published(1000.0, "1/m", "Table II")
    mass: float = _published(2.55, "kg", "Table II, M_n")
    inertia: float = _published(7.68e-5, "kg m^2", "Table II, J_n")
    torque_constant: float = _published(0.0387, "N m/A", "Table II, K_tn")
    position_gain: float = _published(100.0, "1/s", "Table II, K_p")
    speed_gain: float = _published(0.5, "A s/rad", "Table II, K_v")
    observer_cutoff: float = _published(1000.0, "rad/s", "Table II, g_D")
    speed_cutoff: float = _published(1000.0, "rad/s", "Table II, g_v")
    load_stiffness: float = _published(2250.0, "N/m", "Table II, K_e, of the load of foam")
    load_damping: float = _published(0.1, "N s/m", "Table II, D_e")
    control_period: float = _published(1e-4, "s", "Sec. IV, carrier of 10 kHz; one sample a period is assumed")
    position_count: float = _published(1e-6, "m", "Sec. IV, head RGH24X30D00A; X is 1 um (Renishaw L-9517-0166)")
    angle_count: float = _assumed(
        1e-6 / (36e-3 / 7 / math.tau), "rad", "the interpolation of the T2011-10A is not told; 1 um at the mover"
    )
    distortion: float = _calibrated(
        27.07e-6, "m", "on the polynomial estimate's error in experiment 1 alone, 4.68 N in Table III"
    )
    second_order: float = _assumed(0.35, "1", "of the first; Fig. 12 is said to show a pattern that repeats each turn")
    sixth_order: float = _assumed(0.2, "1", "of the first; arcs of 60 deg give six blocks a turn")
    translator_order: float = _assumed(0.35, "1", "of the first; the overall variation of Fig. 12 is the translator's")
    translator_wave: float = _assumed(60e-3, "m", "a variation over the stroke, no ripple of the turns")
    friction: float = _assumed(0.85, "N", "gamma_1 + gamma_3 of Table II: what (29) tends to with speed")
    bristle_stiffness: float = _assumed(1e5, "N/m", "0.85 N over 8.5 um of presliding, as guides with balls have it")
    bristle_damping: float = _assumed(100.0, "N s/m", "a tenth of critical, for the mover on its bristles")
    frequency: float = _assumed(0.1, "Hz", "of the movement; its speeds, 6 to 23 mm/s, are about those of Fig. 12")

    @property
    def transfer_ratio(self) -> float:
        """h = l_p/2 pi (m/rad), of the pitch itself."""
        return self.pitch / math.tau

    @property
    def spring(self) -> HysteresisSpring:
        """(17) and (18)."""
        law = SineSpring(self.stall_force, self.transfer_ratio)
        return HysteresisSpring(law, self.weight, BoucWen(self.phi, self.psi, self.xi))

    def zero_force_line(self, angle: ArrayLike, position: ArrayLike) -> Floats:
        """x_d0 (m) at rotor angles (rad) and mover positions (m); they broadcast."""
        theta = np.asarray(angle, dtype=np.float64)
        along = math.tau / self.translator_wave * np.asarray(position, dtype=np.float64)
        shape = np.sin(theta) + self.second_order * np.sin(2 * theta) + self.sixth_order * np.sin(6 * theta)
        return np.asarray(self.distortion * (shape + self.translator_order * np.sin(along)))


def sources() -> Mapping[str, tuple[str, str, str]]:
    """Parameter -> kind ("published", "assumed" or "calibrated"), unit, and its source or reason."""
    return {each.name: tuple(each.metadata[key] for key in ("kind", "unit", "source")) for each in fields(RotLinPlant)}
