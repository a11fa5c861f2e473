"""Axisymmetric nonlinear magnetostatics on quadratic triangles."""
