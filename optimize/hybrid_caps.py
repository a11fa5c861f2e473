"""What holds the hybrid actuator's end caps against the pressure, from the specification."""

from __future__ import annotations

from fluxbore.design import screw_joint
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.materials import Material, lookup
from fluxbore.design.screw_joint import ScrewJoint
from fluxbore.design.spec import Spec
from fluxbore.geometry.hybrid_layout import spigot


def safety(spec: Spec, actuator: HybridActuator) -> float | None:
    """Of the set screws as drawn; None where caps are bonded or held by tie rods, nothing pushes, or a yield stress is
    not known."""
    caps, cylinder, place = actuator.end_caps, actuator.cylinder, spigot(actuator)
    tube, cap = (
        lookup(spec.word(key), key, spec.materials, Material).yield_stress
        for key in ("actuator.cylinder.material", "actuator.end_caps.material")
    )
    if place.screws is None or tube is None or cap is None or spec.word("actuator.cylinder.ends") != "closed":
        return None
    bore = cylinder.inner_diameter
    joint = ScrewJoint(
        place.screws.thread,
        caps.screws,
        bore,
        wall=(cylinder.outer_diameter - bore) / 2,
        edge=place.length - place.screws.s,
        depth=bore / 2 - place.screws.bottom,
        tube_yield=tube,
        cap_yield=cap,
    )
    return screw_joint.safety(joint, spec.number("operating_point.pressure"))
