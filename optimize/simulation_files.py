"""What marks a folder as that of simulations."""

TRACES = "traces.parquet"

HEAD = ("design", "seed")
"""The columns that every table of trials begins with."""
