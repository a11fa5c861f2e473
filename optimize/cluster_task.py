"""What a cluster's worker does with a task: it hands it to a process of this machine and waits.

The process is what local runs use (`fluxbore.optimize.worker`): one BLAS thread, a time limit that can be enforced, and
a crash that costs its task and leaves the cluster's worker, with the tasks beside it, alive.
"""

from __future__ import annotations

import contextlib
import pickle
import threading
from collections import defaultdict

from fluxbore.design.errors import FluxboreError
from fluxbore.optimize.design_key import program
from fluxbore.optimize.executor import ProcessExecutor

Answer = tuple[bytes | None, str | None]
"""The value, pickled, or the sentence why there is none."""

_lock = threading.Lock()
_idle: defaultdict[float | None, list[ProcessExecutor]] = defaultdict(list)
_busy: defaultdict[str, set[ProcessExecutor]] = defaultdict(set)
_abandoned: set[str] = set()


def compute(run: str, expected: str, message: bytes, time_limit: float | None) -> Answer:
    """The answer to the task in ``message``, a pickled (function, task).

    run : names the run, for `abandon`. expected : the client's `program`, without which the figures would not be those
    that its journal says. time_limit : s.
    Raises FluxboreError where the programs differ or no process can be started here.
    """
    if program() != expected:
        raise FluxboreError("has another version of fluxbore, numpy, scipy or Python than this computer")
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
