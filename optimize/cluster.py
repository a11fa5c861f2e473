"""Runs tasks on a Dask cluster, by the same interface as local processes (`fluxbore.optimize.executor`).

The journal stays with the client; workers get a task and give back its value. A worker that dies costs nothing: the
scheduler gives its tasks to another. What crashes or hangs does so in a process of its own (`cluster_task`).
"""

from __future__ import annotations

import contextlib
import logging
import pickle
import threading
import time
import uuid
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from queue import Empty, SimpleQueue
from types import TracebackType
from typing import Any, Self, TypeVar

from fluxbore.design.errors import FluxboreError, MissingLibraryError, one_line, shown
from fluxbore.optimize import cluster_task
from fluxbore.optimize.design_key import program
from fluxbore.optimize.executor import TIME_LIMIT, Executor, Outcome, checked_time_limit, local_executor

T = TypeVar("T")
R = TypeVar("R")

CONNECT_PATIENCE = 8.0
"""s for the scheduler to answer."""

WORKER_PATIENCE = 600.0
"""s without a single worker, as at the start of a batch system's jobs, after which a run gives up."""

_POLL = 2.0
"""s between looks at how many workers there are."""

_QUEUED = 2
"""Tasks in flight for each thread of the cluster: the next one is there when the last is done."""


def executor_for(
    workers: int | None = None, scheduler: str | None = None, time_limit: float | None = TIME_LIMIT
) -> Executor:
    """The cluster behind ``scheduler``, where one is given, else ``workers`` processes on this machine.

    time_limit : s for one task, None for any time. Raises FluxboreError for both workers and scheduler, and whatever
    `ClusterExecutor` raises.
    """
    if scheduler is None:
        return local_executor(workers, time_limit=time_limit)
    if workers is not None:
        raise FluxboreError(f"workers must not be given beside a scheduler, whose cluster has its own; got {workers}.")
    return ClusterExecutor(scheduler, time_limit)


class ClusterExecutor:
    """A Dask cluster, which workers may join and leave at any time.

    address : of the scheduler, "tcp://host:8786"; its security is Dask's own configuration.
    time_limit : s after which a task is given up and its process killed. worker_patience : s without any worker.
    Raises MissingLibraryError without dask.distributed, FluxboreError where no scheduler answers.
    """

    def __init__(
        self, address: str, time_limit: float | None = TIME_LIMIT, *, worker_patience: float = WORKER_PATIENCE
    ) -> None:
        self._time_limit = None if time_limit is None else checked_time_limit(time_limit)
        self._address = address
        self._worker_patience = worker_patience
        self._client = _connected(address)
        self._levels = _hushed()
        self._program = program()
        self._threads: Mapping[str, int] = {}
        self._looked = -_POLL
        self._last_seen = time.monotonic()

    @property
    def workers(self) -> int:
        """The threads of the cluster's workers now, at least 1."""
        self._look()
        return max(sum(self._threads.values()), 1)

    def run(self, function: Callable[[T], R], tasks: Iterable[T]) -> Iterator[Outcome[R]]:
        """See `Executor`.

        Raises FluxboreError where the function stands in the main script, the scheduler is lost, no worker comes or a
        worker lacks this version of fluxbore.
        """
        if getattr(function, "__module__", None) == "__main__":
            raise FluxboreError("A function for a cluster must stand in a module that its workers can import.")
        run = uuid.uuid4().hex
        fresh = iter(enumerate(tasks))
        flying: dict[Any, tuple[int, T]] = {}  # future -> the task with its number
        suspects: list[tuple[int, T]] = []
        lone: Any = None
        finished: SimpleQueue[Any] = SimpleQueue()
        self._last_seen = time.monotonic()

        def submit(numbered: tuple[int, T], name: str) -> Any:
            message = pickle.dumps((function, numbered[1]), protocol=pickle.HIGHEST_PROTOCOL)
            call = _call("compute", run, self._program, message, self._time_limit)
            future = self._client.submit(*call, key=f"fluxbore-{run}-{name}", pure=False)
            flying[future] = numbered
            future.add_done_callback(finished.put)
            return future

        try:
            while True:
                while len(flying) < _QUEUED * self.workers and (numbered := next(fresh, None)) is not None:
                    submit(numbered, str(numbered[0]))
                if not flying:
                    if not suspects:
                        return
                    suspect = suspects.pop()
                    lone = submit(suspect, f"{suspect[0]}-alone")
                future = self._next(finished)
                if future is None:
                    continue
                if future is not lone and _is_suspect(future):
                    # The scheduler blames all tasks of a dead worker; which of them it was shows when each is alone.
                    suspects.append(flying.pop(future))
                    continue
                outcome: Outcome[R] | None = self._outcome(flying[future][0], future)
                if outcome is None:
                    future.add_done_callback(finished.put)
                    continue
                del flying[future]
                future.release()
                yield outcome
        finally:
            if flying:
                self._abandon(run, list(flying))

    def _next(self, finished: SimpleQueue[Any]) -> Any:
        """The next task that is done, or None after a while; a cluster that is gone is FluxboreError."""
        try:
            return finished.get(timeout=_POLL)
        except Empty:
            self._look()
            if time.monotonic() - self._last_seen > self._worker_patience:
                raise FluxboreError(
                    f"The scheduler {shown(self._address)} has had no worker for {self._worker_patience:g} s."
                ) from None
            return None

    def _look(self) -> None:
        """Count the workers, now and then."""
        now = time.monotonic()
        if now - self._looked < _POLL:
            return
        if self._client.status != "running":
            raise self._lost()
        try:
            self._threads = self._client.nthreads()
        except Exception as error:
            raise self._lost() from error
        self._looked = time.monotonic()
        if self._threads:
            self._last_seen = self._looked

    def _outcome(self, index: int, future: Any) -> Outcome[Any] | None:
        """What became of the task; None where its worker died with the value, so that it is computed once more."""
        from distributed import KilledWorker

        if future.status == "error":
            error = future.exception()
            if isinstance(error, KilledWorker):
                return Outcome(index, None, _killed(error))
            raise self._unfit(error)
        if future.status in ("cancelled", "lost"):
            raise self._lost()
        if future.status != "finished":
            return None
        try:
            value, failure = future.result(timeout=_POLL * 30)
            return Outcome(index, None, failure) if value is None else Outcome(index, pickle.loads(value))
        except TimeoutError:
            return None

    def _unfit(self, error: BaseException) -> FluxboreError:
        """Of a worker that cannot compute anything: to go on would make a failure of every design."""
        words = one_line(str(error))
        if isinstance(error, FluxboreError):
            return FluxboreError(f"A worker of the scheduler {shown(self._address)} {words}.")
        return FluxboreError(
            f"A worker of the scheduler {shown(self._address)} cannot run this version of fluxbore: "
            f"{type(error).__name__}: {words}."
        )

    def _lost(self) -> FluxboreError:
        return FluxboreError(f"The scheduler {shown(self._address)} was lost; run again to go on.")

    def _abandon(self, run: str, futures: list[Any]) -> None:
        """Take back what waits and kill what is being computed."""
        if self._client.status != "running":
            return
        with contextlib.suppress(Exception):
            self._client.cancel(futures, force=True)
        self._tell("abandon", run)

    def _tell(self, name: str, *arguments: str) -> None:
        with contextlib.suppress(Exception):
            self._client.run(*_call(name, *arguments), on_error="ignore")

    def close(self) -> None:
        """End the workers' processes and leave the cluster; its workers stay."""
        if self._client.status == "running":
            self._tell("rest")
        with contextlib.suppress(Exception):
            self._client.close(timeout=CONNECT_PATIENCE)
        for name, level in self._levels.items():
            logging.getLogger(name).setLevel(level)
        self._levels = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def _connected(address: str) -> Any:
    """A client of the scheduler."""
    try:
        import distributed
    except ImportError as error:
        raise MissingLibraryError('A cluster needs distributed; get it by: pip install "fluxbore[cluster]"') from error
    # Made in two steps: a client whose constructor fails must still be closed, or its thread prints when Python ends.
    client: Any = object.__new__(distributed.Client)
    try:
        with warnings.catch_warnings():
            # Other versions of Dask's own parts mostly work together; what the figures depend on is compared exactly.
            warnings.simplefilter("ignore")
            _within(
                CONNECT_PATIENCE + 2,
                lambda: client.__init__(address, timeout=CONNECT_PATIENCE, set_as_default=False),
            )
    except BaseException as error:
        with contextlib.suppress(Exception):
            client.close(timeout=1.0)
        if not isinstance(error, Exception):
            raise
        words = one_line(str(error)).rstrip(".")
        raise FluxboreError(
            f"scheduler must be the address of a Dask scheduler that runs, such as tcp://host:8786; {shown(address)} "
            f"gave {type(error).__name__}: {words}."
        ) from error
    return client


def _hushed() -> dict[str, int]:
    """Keep Dask's log off the terminal: what it tells is told in sentences. Returns the loggers' levels before."""
    names = [name for name in logging.root.manager.loggerDict if name.partition(".")[0] == "distributed"]
    before = {name: logging.getLogger(name).level for name in names}
    for name in names:
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)
    return before


def _within(seconds: float, action: Callable[[], None]) -> None:
    """Run the action; TimeoutError after the time, for Dask waits without end for a port at which no Dask answers."""
    raised: list[BaseException] = []

    def attempt() -> None:
        try:
            action()
        except BaseException as error:
            raised.append(error)

    thread = threading.Thread(target=attempt, daemon=True)
    thread.start()
    thread.join(seconds)
    if thread.is_alive():
        raise TimeoutError("no answer of a scheduler")
    if raised:
        raise raised[0]


def _call(name: str, *arguments: object) -> tuple[Any, str, dict[str, object]]:
    """A function with its arguments that calls ``cluster_task.name(*arguments)`` on a worker.

    It is Python's own `eval`, which every worker can unpickle: one that is sent a function of a package that it lacks
    ends without a word, and the run would wait for ever.
    """
    module = f"__import__('importlib').import_module({cluster_task.__name__!r})"
    return eval, f"{module}.{name}(*arguments)", {"arguments": arguments}


def _is_suspect(future: Any) -> bool:
    """Whether the task was given up because the workers that had it died."""
    from distributed import KilledWorker

    return future.status == "error" and isinstance(future.exception(), KilledWorker)


def _killed(error: Any) -> str:
    times = int(error.allowed_failures) + 1
    if times == 1:
        return "A worker of the cluster died while it computed the design."
    return f"{times} workers of the cluster died, one after another, while they computed the design."
