"""Magnetic springs for a simulation that goes step by step: a function from displacement to force that remembers.

The records of `magnetic_hysteresis` are whole arrays; a loop that closes over the force needs one number at a time, and
a plain function of floats is some ten times quicker there than an array of one.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from fluxbore.design.dynamics.bouc_wen import advance
from fluxbore.design.dynamics.magnetic_hysteresis import HysteresisSpring
from fluxbore.design.dynamics.magnetic_spring import SineSpring, SpringLaw

Stepped = Callable[[float], float]
"""Called with one displacement (m) after the other, straight on from the last, it gives the force (N) there."""


def stepped(spring: SpringLaw | HysteresisSpring) -> Stepped:
    """A fresh spring at x_d = x_s = 0."""
    return _remembering(spring) if isinstance(spring, HysteresisSpring) else _plain(spring)


def initial_stiffness(spring: SpringLaw | HysteresisSpring) -> float:
    """dF_s/dx_d (N/m) at rest, without the memory's share."""
    law = spring.law if isinstance(spring, HysteresisSpring) else spring
    return float(law.stiffness(0.0))


def _plain(law: SpringLaw) -> Stepped:
    if isinstance(law, SineSpring):
        force, h, sin = law.stall_force, law.transfer_ratio, math.sin
        return lambda displacement: force * sin(displacement / h)
    return lambda displacement: float(law.force(displacement))


def _remembering(spring: HysteresisSpring) -> Stepped:
    force, memory = _plain(spring.law), spring.memory
    elastic, plastic = spring.weight, 1 - spring.weight
    bound, rate, exp = memory.bound, memory.psi + memory.xi, math.exp
    linear = memory.eta == 1.0
    before = state = 0.0

    def step(displacement: float) -> float:
        nonlocal before, state
        moved = displacement - before
        before = displacement
        if linear and moved >= 0 and state >= 0:  # the commonest way, written out: one exponential towards the bound
            state = bound + (state - bound) * exp(-rate * moved)
        else:
            state = advance(memory, state, moved)
        return elastic * force(displacement) + plastic * force(state)

    return step
