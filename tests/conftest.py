"""Settings of all tests."""

import os
import sys
from pathlib import Path

from hypothesis import settings

# No test is timed: a busy machine is not a fault. In continuous integration the same examples come every time.
settings.register_profile("fluxbore", deadline=None, derandomize=bool(os.environ.get("CI")))
settings.load_profile("fluxbore")

# Modules of tests that several rooms share, such as actuators.py, are found by their plain name.
sys.path.insert(0, str(Path(__file__).parent))
