"""One worker process: how it is started, what it does, and how it ends when its parent does.

This file is imported by the new process before anything else of fluxbore; it must stay light and must not import numpy.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import pickle
import signal
import sys
import threading
import types
from collections.abc import Iterator, Sequence
from importlib import import_module
from multiprocessing.connection import Connection
from multiprocessing.context import SpawnProcess
from typing import Any

READY, VALUE, FAILURE, EXHAUSTED = "ready", "value", "failure", "exhausted"

_THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "NUMEXPR_NUM_THREADS")

_starting = threading.Lock()


class Worker:
    """The parent's end of one worker."""

    def __init__(self, process: SpawnProcess, connection: Connection) -> None:
        self.process, self.connection = process, connection
        self.ready = False  # it has come up and said so
        self.leaving = False  # it ends by itself after this answer

    def send(self, message: bytes) -> bool:
        """Whether the worker was there to take the message."""
        try:
            self.connection.send_bytes(message)
        except OSError:
            return False
        return True

    def receive(self) -> tuple[str, Any] | None:
        """The worker's answer (kind, content), or None where it died instead."""
        try:
            message = self.connection.recv_bytes()
        except (EOFError, OSError):
            return None
        try:
            kind, content = pickle.loads(message)
        except Exception as error:
            return FAILURE, f"The evaluation's result cannot be read: {type(error).__name__}: {error}."
        if kind == READY:
            self.ready = True
        if kind == EXHAUSTED:
            self.leaving = True
            kind = FAILURE
        return kind, content

    def dismiss(self) -> None:
        """Let an idle worker end: it sees the end of the pipe."""
        self.connection.close()

    def strike(self) -> None:
        """Kill the process and leave the rest to whoever waits for it in another thread."""
        with contextlib.suppress(ValueError, OSError):  # it is cleared away already
            self.process.kill()

    def kill(self, patience: float = 0.0) -> str:
        """End the worker, at once or after ``patience`` seconds; returns how it ended, in words."""
        self.connection.close()
        # A pipe breaks a moment before its process has died; how it died is worth that moment.
        if patience:
            self.process.join(patience)
        if self.process.is_alive():
            self.process.kill()
            self.process.join()
        code = self.process.exitcode
        self.process.close()
        if code is not None and code < 0:
            name = signal.Signals(-code).name if -code in set(signal.Signals) else str(-code)
            return f"was killed by the signal {name}"
        return f"ended with exit status {code}"


def start_worker(*, keep_main: bool, preload: Sequence[str] = ()) -> Worker:
    """A new process, not yet ready.

    preload : modules that it loads before its first task comes.

    Spawned, not forked: a fork copies locks that other threads hold. The new process does not import the user's main
    module again unless the function to run is defined there (``keep_main``), so that a plain script needs no guard.
    """
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    process = context.Process(target=_work, args=(theirs, tuple(preload)), daemon=True)
    main = contextlib.nullcontext() if keep_main else _main_hidden()
    with _starting, _single_threaded(), _interrupts_held_back(), _children_allowed(), main:
        process.start()
    theirs.close()
    return Worker(process, ours)


@contextlib.contextmanager
def _single_threaded() -> Iterator[None]:
    """One BLAS thread for each worker. numpy reads these when it is imported, so they must stand before the start."""
    before = {name: os.environ.get(name) for name in _THREADS}
    os.environ.update(dict.fromkeys(_THREADS, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


@contextlib.contextmanager
def _interrupts_held_back() -> Iterator[None]:
    """Ctrl-C is the parent's to handle. A blocked signal stays blocked in the new process; the parent gets it after."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    from multiprocessing import resource_tracker

    # The first start of a process would start this helper on its way and unblock the signal after it.
    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextlib.contextmanager
def _children_allowed() -> Iterator[None]:
    """multiprocessing refuses children to a daemon, which a cluster's worker is, since they would be orphaned when it
    is killed. Ours end with their parent of themselves."""
    config: dict[str, Any] = getattr(multiprocessing.current_process(), "_config", {})
    daemon = config.pop("daemon", None)
    try:
        yield
    finally:
        if daemon is not None:
            config["daemon"] = daemon


@contextlib.contextmanager
def _main_hidden() -> Iterator[None]:
    """While this lasts, multiprocessing finds a main module without a file, and so does not run it in the child."""
    main = sys.modules["__main__"]
    sys.modules["__main__"] = types.ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = main


def _work(connection: Connection, preload: Sequence[str]) -> None:
    """The worker's life: take a task, answer, until the pipe ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # where there was no mask to inherit
    with contextlib.suppress(OSError):
        os.dup2(2, 1)  # the command line's standard output is for its JSON alone
    threading.Thread(target=_end_with_parent, daemon=True).start()
    try:
        connection.send_bytes(pickle.dumps((READY, None)))
        for module in preload:
            with contextlib.suppress(Exception):  # a task that needs it will say why it cannot be loaded
                import_module(module)
        while True:
            kind, answer = _answer(connection.recv_bytes())
            connection.send_bytes(answer)
            if kind == EXHAUSTED:
                return
    except (EOFError, OSError):
        return


def _answer(message: bytes) -> tuple[str, bytes]:
    """What to send back, and what kind of answer it is."""
    try:
        function, task = pickle.loads(message)
        return VALUE, _packed(VALUE, function(task))
    except MemoryError:
        # The memory goes back to the system only with the process.
        return EXHAUSTED, _packed(EXHAUSTED, "The evaluation ran out of memory.")
    except Exception as error:
        return FAILURE, _packed(FAILURE, f"The evaluation stopped with {type(error).__name__}: {error}.")


def _packed(kind: str, content: object) -> bytes:
    return pickle.dumps((kind, content), protocol=pickle.HIGHEST_PROTOCOL)


def _end_with_parent() -> None:
    """However the parent ends, SIGKILL included, its end of a pipe closes; then this process ends too, mid-task."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
