"""Evaluation of one design, sweeps over many, and the search for the best."""
