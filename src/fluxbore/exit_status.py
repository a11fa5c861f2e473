"""How a command ends, for shells and schedulers."""

DONE = 0
PROGRAM_FAULT = 1
INPUT_WRONG = 2
"""One sentence on stderr, and nothing on stdout."""
NOT_VALID = 3
"""It ran, and the result is not valid: no feasible design, no convergence."""
INTERRUPTED = 130
