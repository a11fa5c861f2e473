"""What a cluster's worker does with a task: it hands it to a process of this machine and waits.

The process is what local runs use (`fluxbore.optimize.worker`): one BLAS thread, a time limit that can be enforced, and
a crash that costs its task and leaves the cluster's worker, with the tasks beside it, alive.
"""

from __future__ import annotations

import contextlib
import pickle
import sys
import threading
from collections import defaultdict
from functools import cache

from fluxbore.design.errors import FluxboreError
from fluxbore.optimize.design_key import program, source_hash
from fluxbore.optimize.executor import ProcessExecutor

Answer = tuple[bytes | None, str | None]
"""The value, pickled, or the sentence why there is none."""

_lock = threading.Lock()
_idle: defaultdict[float | None, list[ProcessExecutor]] = defaultdict(list)
_busy: defaultdict[str, set[ProcessExecutor]] = defaultdict(set)
_abandoned: set[str] = set()


class OtherProgramError(FluxboreError):
    """A worker that would give other figures. parts : its `versions`, which are compared where the sentence is read."""

    def __init__(self, parts: dict[str, str]) -> None:
        super().__init__(parts)
        self.parts = parts

    def __str__(self) -> str:
        own = versions()
        differing = [f"{name} {value}, here {own[name]}" for name, value in self.parts.items() if own[name] != value]
        if not differing:
            return "was started before its fluxbore changed; restart it"
        return f"has {' and '.join(differing)}: make them alike and restart it"


@cache
def versions() -> dict[str, str]:
    """What `program` is made of, as a person tells them apart; read once a process, as that is."""
    import numpy
    import scipy

    import fluxbore

    return {
        "fluxbore": f"{fluxbore.__version__} of the sources {source_hash()[:8]}",
        "numpy": numpy.__version__,
        "scipy": scipy.__version__,
        "Python": f"{sys.version_info.major}.{sys.version_info.minor}",
    }


def compute(run: str, expected: str, message: bytes, time_limit: float | None) -> Answer:
    """The answer to the task in ``message``, a pickled (function, task).

    run : names the run, for `abandon`. expected : the client's `program`, without which the figures would not be those
    that its journal says. time_limit : s.
    Raises FluxboreError where the programs differ or no process can be started here.
    """
    parts = versions()
    if program() != expected:
        raise OtherProgramError(parts)
    with _lock:
        if run in _abandoned:
            return None, "The evaluation was abandoned."
        executor = _idle[time_limit].pop() if _idle[time_limit] else ProcessExecutor(1, time_limit)
        _busy[run].add(executor)
    try:
        outcome = next(executor.run(_unpacked, [message]), None)
    except BaseException:
        executor.abandon()
        raise
    finally:
        with _lock:
            _busy[run].discard(executor)
    if outcome is None:
        return None, "The evaluation was abandoned."
    with _lock:
        _idle[time_limit].append(executor)
    return outcome.value, outcome.failure


def abandon(run: str) -> None:
    """Kill what is being computed of the run and begin nothing more of it."""
    with _lock:
        _abandoned.add(run)
        executors = _busy.pop(run, set())
    for executor in executors:
        executor.abandon()


def rest() -> None:
    """End the processes that wait for tasks."""
    with _lock:
        executors = [executor for group in _idle.values() for executor in group]
        _idle.clear()
    for executor in executors:
        with contextlib.suppress(Exception):
            executor.close()


def _unpacked(message: bytes) -> bytes:
    """Runs in the process; what comes back stays packed on its way through the cluster."""
    function, task = pickle.loads(message)
    return pickle.dumps(function(task), protocol=pickle.HIGHEST_PROTOCOL)
