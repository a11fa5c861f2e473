"""The prototype's specification cut down to one pole pair, so that its fields take a third of the time."""

from dataclasses import replace
from pathlib import Path

from fluxbore.design.keys import Value
from fluxbore.design.spec import Spec, load

EXAMPLE = Path(__file__).parents[1] / "examples" / "ipehla.toml"
MM = 1e-3


def short_spec(**changes: Value) -> Spec:
    """Two positions, a peak current that saturates, Newton to 1e-12.

    changes : the actuator's keys with two underscores for the last dot, such as mover__ring_width.
    """
    base = load(EXAMPLE)
    given: dict[str, Value] = {
        **base.given,
        "actuator.mover.pole_pairs": 1,
        "actuator.mover.stroke": 20 * MM,
        "actuator.winding.sets_per_phase": 2,
        "actuator.winding.turns": 146.0,
        "actuator.cylinder.length": 80 * MM,
        "actuator.shaft.length": 110 * MM,
        "operating_point.positions": 2,
        "operating_point.first_position": 4.1 * MM,
        "operating_point.last_position": 7.3 * MM,
        "operating_point.peak_current": 30.0,
        "solver.tolerance": 1e-12,
    }
    for name, value in changes.items():
        given[name.replace("__", ".") if name.startswith("operating") else "actuator." + name.replace("__", ".")] = (
            value
        )
    spec = replace(base, given=given)
    assert spec.kind.check is not None
    spec.kind.check(spec.values)
    return spec
