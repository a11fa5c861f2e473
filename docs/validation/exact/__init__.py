"""Closed forms and quadratures that the finite elements are held against. SI throughout; scipy only."""
