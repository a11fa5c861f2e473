"""Axisymmetric finite-element magnetostatics."""
