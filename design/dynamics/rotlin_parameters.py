"""The RotLin prototype and its control: what the paper gives, and what it does not give, with each value's reason.

"Novel force estimation method for magnetic lead screw-based RotLin actuator", Tables I and II and Sec. IV. Nominal
values are taken for the plant's own: nothing else is known of it.
"""

from __future__ import annotations

import math
from dataclasses import Field, dataclass, field, fields
from typing import Any

from fluxbore.design.dynamics.bouc_wen import BoucWen
from fluxbore.design.dynamics.disturbance_observer import DisturbanceObserver
from fluxbore.design.dynamics.force_control import ForceController, MoverFriction
from fluxbore.design.dynamics.force_step import Stand
from fluxbore.design.dynamics.guides import Guides
from fluxbore.design.dynamics.linearised import FILTERED
from fluxbore.design.dynamics.magnetic_hysteresis import HysteresisSpring
from fluxbore.design.dynamics.magnetic_spring import SineSpring
from fluxbore.design.dynamics.series_elastic import Environment, SeriesElastic

TABLE_I, TABLE_II = "Table I", "Table II"


def _published(value: float, symbol: str, unit: str, source: str = TABLE_II) -> Any:
    return field(default=value, metadata={"symbol": symbol, "unit": unit, "source": source, "assumed": ""})


def _assumed(value: float, symbol: str, unit: str, reason: str) -> Any:
    return field(default=value, metadata={"symbol": symbol, "unit": unit, "source": "", "assumed": reason})


@dataclass(frozen=True, slots=True)
class RotLinParameters:
    """Every number of the force control in simulated time, SI units; its symbol, unit and source, or the reason why it
    was assumed, are in `parameter_table`."""

    pitch: float = _published(36e-3 / 7, "l_p", "m", TABLE_I + ", 5.1429 mm, taken as 36/7 mm")
    torque_constant: float = _published(0.0387, "K_tn", "N m/A")
    mass: float = _published(2.55, "M_n", "kg")
    inertia: float = _published(7.68e-5, "J_n", "kg m^2")
    observer_cutoff: float = _published(1000.0, "g_D", "rad/s")
    speed_cutoff: float = _published(1000.0, "g_v", "rad/s")
    position_gain: float = _published(100.0, "K_p", "1/s")
    speed_gain: float = _published(0.5, "K_v", "A s/rad")
    stall_force: float = _published(192.0, "F_stall", "N")
    elastic_share: float = _published(0.96, "w", "1")
    phi: float = _published(1.0, "phi", "1")
    psi: float = _published(3000.0, "psi", "1/m")
    xi: float = _published(1000.0, "xi", "1/m")
    eta: float = _published(1.0, "eta", "1")
    environment_stiffness: float = _published(2250.0, "K_e", "N/m")
    environment_damping: float = _published(0.1, "D_e", "N s/m")
    smooth_friction: float = _published(0.8, "gamma_1", "N")
    friction_sharpness: float = _published(200.0, "gamma_2", "s/m")
    friction_jump: float = _published(0.05, "gamma_3", "N")
    control_period: float = _published(100e-6, "T", "s", "Sec. IV, carrier frequency 10 000 Hz")
    position_count: float = _published(
        1e-6, "x count", "m", "Sec. IV, encoder RGH24X; Renishaw's data sheet L-9517-0166 gives it 1 um"
    )
    guide_friction: float = _assumed(
        0.85, "F_C", "N", "the true friction is not published; gamma_1 + gamma_3 is what the controller takes it for"
    )
    guide_stiffness: float = _assumed(
        85e3, "sigma_0", "N/m", "guides commonly give some ten micrometres before they slide: 0.85 N over 10 um"
    )
    guide_damping: float = _assumed(
        30.0,
        "sigma_1",
        "N s/m",
        "3 % of critical on the bristles: they ring down, and gain no work below 4 F_C/sigma_1 = 0.11 m/s",
    )
    angle_count: float = _assumed(
        2 * math.pi / 65536,
        "theta count",
        "rad",
        "not published; 16 bits a turn are 0.08 um of travel, below x's count",
    )

    @property
    def transfer_ratio(self) -> float:
        """h = l_p/2 pi (m/rad), (3). Table II's 8.19e-4 is this rounded, and 0.06 % off it."""
        return self.pitch / (2 * math.pi)


@dataclass(frozen=True, slots=True)
class ParameterRow:
    """assumed : the reason, empty for what is published."""

    name: str
    symbol: str
    value: float
    unit: str
    source: str
    assumed: str


def parameter_table(parameters: RotLinParameters) -> tuple[ParameterRow, ...]:
    """Every parameter as a row, in their order."""
    return tuple(_row(parameters, found) for found in fields(parameters))


def rotlin_stand(parameters: RotLinParameters) -> Stand:
    """The prototype pressing on plastic foam: hysteresis, friction and encoders included."""
    p = parameters
    return Stand(
        plant=SeriesElastic(p.inertia, p.mass, p.transfer_ratio),
        environment=Environment(p.environment_stiffness, p.environment_damping),
        spring=HysteresisSpring(
            SineSpring(p.stall_force, p.transfer_ratio), p.elastic_share, BoucWen(p.phi, p.psi, p.xi, p.eta)
        ),
        guides=Guides(p.guide_friction, p.guide_stiffness, p.guide_damping),
        angle_count=p.angle_count,
        position_count=p.position_count,
    )


def rotlin_controller(parameters: RotLinParameters, observer_speed: str = FILTERED) -> ForceController:
    """Fig. 22, sampled."""
    p = parameters
    return ForceController(
        position_gain=p.position_gain,
        speed_gain=p.speed_gain,
        speed_cutoff=p.speed_cutoff,
        observer=DisturbanceObserver(p.torque_constant, p.inertia, p.observer_cutoff),
        stall_force=p.stall_force,
        transfer_ratio=p.transfer_ratio,
        period=p.control_period,
        friction=MoverFriction(p.smooth_friction, p.friction_sharpness, p.friction_jump),
        observer_speed=observer_speed,
    )


def _row(parameters: RotLinParameters, found: Field[Any]) -> ParameterRow:
    told = found.metadata
    value = float(getattr(parameters, found.name))
    return ParameterRow(found.name, told["symbol"], value, told["unit"], told["source"], told["assumed"])
