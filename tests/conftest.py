"""Settings of all tests."""

import os

from hypothesis import settings

# No test is timed: a busy machine is not a fault. In continuous integration the same examples come every time.
settings.register_profile("fluxbore", deadline=None, derandomize=bool(os.environ.get("CI")))
settings.load_profile("fluxbore")
