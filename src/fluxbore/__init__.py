"""Design tubular linear actuators: specification, magnetic field, optimisation, solid model and report."""

__version__ = "0.1.0"
