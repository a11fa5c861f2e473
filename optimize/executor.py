"""Runs tasks in local processes: results as they come, a crash costs one task.

Each worker has a pipe of its own, so that the parent always knows which task a dead worker held. (A shared queue, as in
`concurrent.futures`, breaks as a whole and leaves every task in flight under suspicion.)
"""

from __future__ import annotations

import math
import os
import pickle
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from types import TracebackType
from typing import Any, Generic, Protocol, Self, TypeVar

from fluxbore.design.errors import FluxboreError
from fluxbore.optimize.worker import FAILURE, READY, Worker, start_worker

T = TypeVar("T")
T_contra = TypeVar("T_contra", contravariant=True)
R = TypeVar("R")

ATTEMPTS = 2
"""A task whose worker dies is tried once more, alone: what killed the worker may have been its neighbour's memory."""

TIME_LIMIT = 1800.0
"""s for one task: hundreds of times what a design takes, so that only what hangs meets it."""

_START_FAILURES = 3

_START_PATIENCE = 60.0
"""s for a process to come up, which is not the task's time."""


PRELOAD = (
    "fluxbore.fem.lapack",
    "fluxbore.optimize.evaluate",
    "fluxbore.optimize.hybrid_figures",
    "fluxbore.fem.tubular",
)
"""What a process that is started early loads meanwhile."""

_early: deque[Worker] = deque()


@dataclass(frozen=True, slots=True)
class Outcome(Generic[R]):
    """What became of the task number ``index``: its value, or in ``failure`` a sentence that says why there is none."""

    index: int
    value: R | None
    failure: str | None = None


class Executor(Protocol):
    """What sweeps and searches need of whatever computes: local processes, this process, a cluster.

    ``run`` yields one outcome for every task, in the order in which they finish; it takes tasks from the iterable only
    as it can use them. Closing the iterator early abandons what is in flight. ``function`` and tasks are pickled.
    """

    @property
    def workers(self) -> int: ...

    def run(self, function: Callable[[T], R], tasks: Iterable[T]) -> Iterator[Outcome[R]]: ...

    def close(self) -> None: ...

    def __enter__(self) -> Self: ...

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None: ...


def local_executor(
    workers: int | None = None, *, in_process: bool = False, time_limit: float | None = TIME_LIMIT
) -> Executor:
    """Processes on this machine, as many as it has cores; or this very process, where nothing can crash alone.

    time_limit : seconds for one task, None for any time; this very process has none.
    """
    if in_process:
        return SerialExecutor()
    return ProcessExecutor(available_cores() if workers is None else workers, time_limit)


def start_early(workers: int | None = None) -> None:
    """Start processes for the local executor to come, while this one still reads what they are to do.

    workers : as for `local_executor`; no more than there are cores. What is not taken ends with the executor, or with
    this process.
    """
    for _ in range(min(workers or available_cores(), available_cores()) - len(_early)):
        _early.append(start_worker(keep_main=False, preload=PRELOAD))


def available_cores() -> int:
    """The cores that this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:  # not on every platform
        return os.cpu_count() or 1


def checked_time_limit(seconds: float) -> float:
    """The limit for one task (s), which must be positive; FluxboreError says so."""
    if not seconds > 0:
        raise FluxboreError(f"The time limit of a design must be above 0 s; got {seconds:g} s.")
    return seconds


class SerialExecutor:
    """Runs tasks one by one in this process; an exception costs its task, a crash costs all, and time has no limit."""

    @property
    def workers(self) -> int:
        return 1

    def run(self, function: Callable[[T], R], tasks: Iterable[T]) -> Iterator[Outcome[R]]:
        """See `Executor`."""
        for index, task in enumerate(tasks):
            try:
                outcome = Outcome(index, function(task))
            except Exception as error:
                outcome = Outcome(index, None, f"The evaluation stopped with {type(error).__name__}: {error}.")
            yield outcome

    def close(self) -> None:
        pass

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


@dataclass(slots=True)
class _Job:
    index: int
    message: bytes
    crashes: int = 0
    deadline: float = math.inf


class ProcessExecutor:
    """Up to ``workers`` processes, started when first needed and kept until `close`.

    time_limit : seconds after which a task is given up and its process killed.
    """

    def __init__(self, workers: int, time_limit: float | None = TIME_LIMIT) -> None:
        if workers < 1:
            raise FluxboreError(f"workers must be at least 1; got {workers}.")
        self._workers = workers
        self._time_limit = math.inf if time_limit is None else checked_time_limit(time_limit)
        self._idle: list[Worker] = []
        self._busy: dict[Worker, _Job] = {}
        self._start_failures = 0
        self._abandoned = False

    @property
    def workers(self) -> int:
        return self._workers

    def run(self, function: Callable[[T], R], tasks: Iterable[T]) -> Iterator[Outcome[R]]:
        """See `Executor`. Raises FluxboreError where worker processes cannot be started at all."""
        fresh = iter(enumerate(tasks))
        again: deque[_Job] = deque()  # their worker did not even start: no blame
        suspects: deque[_Job] = deque()  # their worker died
        busy = self._busy = {}
        main = getattr(function, "__module__", None) == "__main__"

        def next_job() -> _Job | None:
            if again:
                return again.popleft()
            for index, task in fresh:
                return _Job(index, pickle.dumps((function, task), protocol=pickle.HIGHEST_PROTOCOL))
            if suspects and not busy:
                return suspects.popleft()
            return None

        done: list[Outcome[R]] = []
        try:
            while True:
                while not self._abandoned and len(busy) < self._workers and (job := next_job()) is not None:
                    self._hand_out(job, busy, main)
                # Results are given out after the next tasks are under way: what the consumer does with a result (a
                # sync to the disk) then costs no worker's time.
                yield from done
                if not busy:
                    return
                done = [
                    outcome for worker in self._answered(busy) for outcome in self._take(worker, busy, again, suspects)
                ]
                done += self._overdue(busy)
        finally:
            self._busy = {}
            for worker in busy:
                worker.kill()

    def abandon(self) -> None:
        """Give up what is being computed, from any thread: `run` then ends without the outcomes that are missing."""
        self._abandoned = True
        for worker in list(self._busy):
            worker.strike()

    def _hand_out(self, job: _Job, busy: dict[Worker, _Job], main: bool) -> None:
        job.deadline = time.monotonic() + self._time_limit
        while self._idle:
            worker = self._idle.pop()
            if worker.send(job.message):
                break
            worker.kill()  # died while idle
        else:
            job.deadline += _START_PATIENCE
            worker = _early.popleft() if _early and not main else start_worker(keep_main=main)
            worker.send(job.message)  # where it is dead already, the wait below finds out
        busy[worker] = job
        if self._abandoned:  # while it was not in the table yet
            worker.strike()

    def _answered(self, busy: dict[Worker, _Job]) -> list[Worker]:
        from multiprocessing.connection import wait

        deadline = min(job.deadline for job in busy.values())
        patience = None if math.isinf(deadline) else max(deadline - time.monotonic(), 0.0)
        ready = set(wait([worker.connection for worker in busy], patience))
        return [worker for worker in busy if worker.connection in ready]

    def _overdue(self, busy: dict[Worker, _Job]) -> list[Outcome[Any]]:
        """Give up what is beyond its time; an answer that has come in the meantime is taken all the same."""
        now = time.monotonic()
        late = [worker for worker, job in busy.items() if job.deadline <= now and not worker.connection.poll()]
        for worker in late:
            worker.kill()
        words = {
            True: f"The evaluation took longer than its time limit of {self._time_limit:g} s.",
            False: f"The process for the evaluation did not start within {_START_PATIENCE + self._time_limit:g} s.",
        }
        return [Outcome(busy.pop(worker).index, None, words[worker.ready]) for worker in late]

    def _take(
        self, worker: Worker, busy: dict[Worker, _Job], again: deque[_Job], suspects: deque[_Job]
    ) -> Iterator[Outcome[Any]]:
        answer = worker.receive()
        if answer is not None and answer[0] == READY:
            self._start_failures = 0
            busy[worker].deadline = time.monotonic() + self._time_limit  # starting up is not the task's time
            return
        job = busy.pop(worker)
        if answer is not None:
            kind, content = answer
            if worker.leaving:
                worker.kill(patience=1.0)
            else:
                self._idle.append(worker)
            yield Outcome(job.index, None, content) if kind == FAILURE else Outcome(job.index, content)
            return
        ended = worker.kill(patience=1.0)
        if self._abandoned:
            return
        if not worker.ready:
            self._start_failures += 1
            if self._start_failures >= _START_FAILURES:
                raise FluxboreError(f"The worker processes cannot be started: each {ended} before its first design.")
            again.append(job)
            return
        job.crashes += 1
        if job.crashes < ATTEMPTS:
            suspects.append(job)
            return
        yield Outcome(job.index, None, f"The process that computed the design {ended}, {job.crashes} times.")

    def close(self) -> None:
        """End the workers; what they compute is abandoned."""
        idle, self._idle = [*self._idle, *_early], []
        _early.clear()
        for worker in idle:
            worker.dismiss()
        for worker in idle:
            worker.kill(patience=1.0)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
