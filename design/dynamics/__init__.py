"""Actuators and their control in simulated time."""
