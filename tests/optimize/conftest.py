"""Worker processes import the toy models by name, so their folder is on the path that workers inherit."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
