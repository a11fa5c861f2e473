"""The benchmark's parameters as the example has them, for tests of several rooms."""

from pathlib import Path

from fluxbore.design.dynamics.force_parameters import ForceParameters, force_parameters
from fluxbore.design.spec import load

EXAMPLE = Path(__file__).parent.parent / "examples" / "rotlin.toml"


def rotlin() -> ForceParameters:
    spec = load(EXAMPLE)
    return force_parameters(spec.actuator, spec.values)


ROTLIN = rotlin()
