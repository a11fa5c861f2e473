"""What some dotted keys are called where their description in the table of keys is no name."""

from __future__ import annotations

KEY_LABELS = {
    "actuator.mover.ring_width": "ring width",
    "actuator.winding.turns_density": "turns density",
    "actuator.winding.yoke_clearance": "clearance of winding and yoke",
    "actuator.gap": "air gap",
    "actuator.poles": "poles along the axis",
    "actuator.translator.iron_thickness": "thickness of the iron (translator)",
    "actuator.rotor.iron_thickness": "thickness of the iron (rotor)",
    "operating_point.load_force": "load",
}
"""Key -> its short name."""

FRAGMENTS = frozenset(
    ("of", "between", "against", "along", "by", "whatever", "around", "within", "outside", "at", "that")
)
"""Words with which a key's description only goes on from its name, so that its name is the label."""
