"""Writes examples/rotlin-spring.csv: loops of displacement and force as a test stand would record them.

python docs/validation/magnetic_spring.py > examples/rotlin-spring.csv
"""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from fluxbore.design.dynamics.bouc_wen import BoucWen
from fluxbore.design.dynamics.magnetic_hysteresis import HysteresisSpring, force_record
from fluxbore.design.dynamics.magnetic_spring import SineSpring

HEAD = """\
# Simulated, not measured: equations (17) and (18) of the paper on the RotLin actuator with Table II and h = l_p/2 pi,
# loops from rest at zero to +-0.35, +-0.85 and +-1.1 mm; scatter of 0.1 N (one sigma), seed 1.
# Written by docs/validation/magnetic_spring.py.
time [s], displacement [mm], force [N]"""

TURNS = (0.0, 0.35, -0.35, 0.85, -0.85, 1.1, -1.1)
"""mm."""


def rows() -> str:
    """The whole file."""
    spring = HysteresisSpring(SineSpring(192.0, 36e-3 / 7 / math.tau), 0.96, BoucWen(1.0, 3000.0, 1000.0))
    legs = [np.linspace(begin, end, 41)[1:] for begin, end in pairwise(TURNS)]
    x = np.round(np.concatenate([[0.0], *legs]), 5)
    force = force_record(spring, x * 1e-3) + np.random.default_rng(1).normal(0.0, 0.1, len(x))
    body = [f"{0.1 * k:.1f}, {way:.5f}, {f:.3f}" for k, (way, f) in enumerate(zip(x, force, strict=True))]
    return "\n".join([HEAD, *body]) + "\n"


if __name__ == "__main__":
    print(rows(), end="")
