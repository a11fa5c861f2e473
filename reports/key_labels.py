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
    "actuator.motor.torque_constant": "torque constant",
    "actuator.motor.resistance": "resistance of the winding",
    "actuator.drive.force_period": "sampling period of the force loop",
    "actuator.drive.delay": "delay of the force loop",
    "actuator.ball_screw.lead": "lead of the screw",
    "actuator.ball_screw.efficiency": "efficiency of the screw",
    "actuator.input_cylinder.dead_volume": "dead volume (input cylinder)",
    "actuator.output_cylinder.dead_volume": "dead volume (output cylinder)",
    "actuator.input_cylinder.moving_mass": "moving mass (input cylinder)",
    "actuator.output_cylinder.moving_mass": "moving mass (output cylinder)",
    "actuator.port.diameter": "bore of the ports",
    "actuator.fitting.diameter": "bore of the fittings",
    "actuator.pressure_block.diameter": "bore of the block’s passage",
    "actuator.hose.linear_mass": "mass per length (hose)",
    "actuator.hose.roughness": "roughness (hose)",
    "actuator.pressure_block.volume": "volume (pressure block)",
    "actuator.return_spring.rate": "rate of the return spring",
    "actuator.return_spring.preload": "force of the return element at rest",
    "actuator.other_distal_mass": "other mass at the joint",
}
"""Key -> its short name."""

FRAGMENTS = frozenset(
    ("of", "between", "against", "along", "by", "whatever", "around", "within", "outside", "at", "that")
)
"""Words with which a key's description only goes on from its name, so that its name is the label."""
