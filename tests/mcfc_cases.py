"""The prototype on the contact-force benchmark's test stand, for the tests of several rooms."""

from pathlib import Path

import numpy as np

from fluxbore.design.dynamics.contact_force_plant import ContactForcePlant
from fluxbore.design.dynamics.force_map import ForceMap
from fluxbore.design.spec import Spec, load

EXAMPLE = Path(__file__).parents[1] / "examples" / "ipehla.toml"
SECTION = "benchmark.mcfc."
MASS = 0.2
"""kg, where the design's own is not looked for."""


def straight_map(constant=8.0, slope=0.0, cogging=0.0):
    """A field of a few numbers, over the positions that the benchmark passes."""
    position = np.linspace(26e-3, 28e-3, 3)
    return ForceMap(position, constant + slope * (position - 27e-3), np.full(3, cogging))


def example(**changes) -> Spec:
    """The example with other values of the benchmark's keys (SI)."""
    return load(EXAMPLE).with_values({SECTION + name: value for name, value in changes.items()})


def plant(force_map=None, **changes) -> ContactForcePlant:
    spec = example(**changes)
    return ContactForcePlant.from_values(spec.actuator, spec.values, force_map or straight_map(), MASS, 20.5)
