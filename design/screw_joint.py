"""What the set screws between a tube and its end caps bear against the pressure that pushes a cap out.

    push      F = p π D²/4
    bears     tube's wall     n d t R_p
              tube's edge     2 n (e - d_h/2) t R_p/√3
              spigot's thread n d h R_p
              screws          n π d_1²/4 R_s/√3

n screws of diameter d and core d_1 in holes of d_h, at a distance e from the tube's end; t the tube's wall, h the
thread's depth in the spigot; R_p the yield stress of the tube or the cap, R_s that of the screws. Bearing pressure up
to the yield stress and shear by von Mises, as in hand calculations of bolted plates; friction of seals and screws and
what a compound bears are left out. Valid for a static pressure, screws alike and evenly loaded.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from fluxbore.design.pressure_vessel import UNLOADED
from fluxbore.design.threads import Thread

SCREW_YIELD = 450e6
"""Pa, R_p0.2 of stainless screws of class A2-70 (ISO 3506-1)."""


@dataclass(frozen=True, slots=True)
class ScrewJoint:
    """One cap's screws. bore, wall : of the tube. edge : e. depth : h. Lengths in m, yield stresses in Pa."""

    thread: Thread
    count: int
    bore: float
    wall: float
    edge: float
    depth: float
    tube_yield: float
    cap_yield: float


def capacity(joint: ScrewJoint) -> float:
    """Force on a cap (N) at which the first of the four yields."""
    thread, count = joint.thread, joint.count
    return min(
        count * thread.diameter * joint.wall * joint.tube_yield,
        2 * count * (joint.edge - thread.clearance / 2) * joint.wall * joint.tube_yield / math.sqrt(3),
        count * thread.diameter * joint.depth * joint.cap_yield,
        count * math.pi / 4 * thread.core**2 * SCREW_YIELD / math.sqrt(3),
    )


def safety(joint: ScrewJoint, pressure: float) -> float | None:
    """The capacity over the push of a pressure (Pa); None where nothing pushes."""
    push = math.pi / 4 * joint.bore**2 * pressure
    return capacity(joint) / push if pressure > UNLOADED else None
