"""The actuator as numbers: specification, materials and closed-form models, in SI units."""
