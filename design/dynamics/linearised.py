"""The force control of a magnetic-lead-screw actuator about one load: its transfer function, from its block diagram.

"Novel force estimation method for magnetic lead screw-based RotLin actuator", equations (2)-(6), (28) and
(30)-(34) and Fig. 22, with the spring's slope K_l* at the load, (32):

    theta_ref = F_ref/(h K_l*) + x/h                                                      (31), linearised
    i         = K_v (K_p (theta_ref - theta) - omega_hat) + d/K_t
    (s + g_v) omega_hat = g_v s theta                                                     (28), of the rotor
    d         = g_D/(s + g_D) (K_t i + g_D J omega_o) - g_D J omega_o
    J s omega = K_t i - h F_s,    M s^2 x = F_s - F_l                                     (4)-(6)
    F_s       = K_l* (h theta - x),    F_l = (K_e + D_e s) x                              (33), (34)

(31) has the slope 1/(h K_l*) since F_stall cos(x_d*/h) = h K_l*; friction and pole distortion are taken as known, and
drop out. omega_o, the speed of the disturbance observer, is the open question of Fig. 22: with the rotor's own speed
the denominator is the paper's (37), which needs an ideal derivative of the encoder; with omega_hat it can be built.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from fluxbore.design.block_diagram import Diagram, Ratio, Signal, characteristic, transfer
from fluxbore.design.polynomial import Number, Polynomial, S

UNFILTERED, FILTERED = OBSERVER_SPEEDS = ("unfiltered", "filtered")
"""What the disturbance observer reads: the rotor's own speed, which is the paper's, or omega_hat as the speed loop."""


@dataclass(frozen=True, slots=True)
class ForceLoop:
    """Coefficients of the linearised loop, each a float, an array over a grid, a fraction or a symbol; SI units.

    J : rotor inertia (kg m^2). M : mover mass (kg). h : transfer ratio (m/rad). K_l : slope of the spring at the load,
    K_l* (N/m). K_e, D_e : environment (N/m, N s/m). K_p (1/s), K_v (A s/rad) : position and speed controller. K_t :
    torque constant (N m/A). g_D, g_v : cut-off frequencies of disturbance observer and speed calculator (rad/s).
    """

    J: Number
    M: Number
    h: Number
    K_l: Number
    K_e: Number
    D_e: Number
    K_p: Number
    K_v: Number
    K_t: Number
    g_D: Number
    g_v: Number

    def with_values(self, values: Mapping[str, Any]) -> ForceLoop:
        return replace(self, **values)


def diagram(loop: ForceLoop, observer_speed: str = UNFILTERED) -> Diagram:
    """Fig. 22 signal by signal. Its one source from outside is `commanded`, F_ref/(h K_l*) (rad): the angle by which
    (31) would turn the spring. Raises ValueError for another observer speed than the two."""
    if observer_speed not in OBSERVER_SPEEDS:
        raise ValueError(f"the observer's speed is one of {', '.join(OBSERVER_SPEEDS)}; got {observer_speed}")
    k = loop
    observed = "speed" if observer_speed == UNFILTERED else "estimated_speed"
    inertia_torque = k.g_D * k.J
    return {
        # theta_ref - theta with x/h - theta as one signal: by itself x/h would cancel to rounding where K_e is zero.
        "angle_error": Signal({"commanded": (1,), "displacement": (-1 / k.h,)}),
        "speed_reference": Signal({"angle_error": (k.K_p,)}),
        "current": Signal(
            {"speed_reference": (k.K_v,), "estimated_speed": (-k.K_v,), "disturbance": (1 / k.K_t,)},
        ),
        "torque": Signal({"current": (k.K_t,)}),
        "observer": Signal({"torque": (k.g_D,), observed: (k.g_D * inertia_torque,)}, (k.g_D, 1)),
        "disturbance": Signal({"observer": (1,), observed: (-inertia_torque,)}),
        "speed": Signal({"torque": (1,), "spring_torque": (-1,)}, (0, k.J)),
        "angle": Signal({"speed": (1,)}, S),
        "estimated_speed": Signal({"angle": (0, k.g_v)}, (k.g_v, 1)),
        "displacement": Signal({"angle": (k.h,), "position": (-1,)}),
        "spring_force": Signal({"displacement": (k.K_l,)}),
        "spring_torque": Signal({"spring_force": (k.h,)}),
        "position": Signal({"spring_force": (1,), "load_force": (-1,)}, (0, 0, k.M)),
        "load_force": Signal({"position": (k.K_e, k.D_e)}),
    }


def force_transfer(loop: ForceLoop, observer_speed: str = UNFILTERED) -> Ratio:
    """F_l/F_l^ref, (35). K_l* above zero: at the stall force itself (31) has no finite slope."""
    turned = transfer(diagram(loop, observer_speed), "commanded", "load_force")
    slope = 1 / (loop.h * loop.K_l)
    return Ratio(tuple(c * slope for c in turned.numerator), turned.denominator)


def force_characteristic(loop: ForceLoop, observer_speed: str = UNFILTERED) -> Polynomial:
    """The denominator of (35) alone, of degree six, the constant first; for every K_l* of zero and above."""
    return characteristic(diagram(loop, observer_speed))
