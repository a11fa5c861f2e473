"""Other processes of this machine."""

from __future__ import annotations

import os


def may_run(process: int) -> bool:
    """Whether the process of this number may still be at work; what it left half-done is nobody's when it is not."""
    if os.name != "posix":  # elsewhere signal 0 would end the process
        return True
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True
    return True
