"""netgen in a process of its own, so that its crash, hang or hunger is an error sentence and never ours.

The parent starts `python -m fluxbore.fem.mesh_worker` once, and again when it has died, and talks to it by pipes: eight
bytes of length, then a pickle, in both directions. The worker ends with its standard input.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import pickle
import signal
import struct
import subprocess
import sys
import threading
from dataclasses import dataclass
from typing import Any, BinaryIO

import numpy as np

from fluxbore.design.errors import MeshError
from fluxbore.fem.mesh import Floats, Ints

TIME_LIMIT = 8.0
"""Seconds of the processor for a mesh, before what its size adds."""
BUSY = 2.0
"""Seconds on the clock that a second of the processor may take: on a busy machine nothing hangs yet."""
MEMORY_LIMIT = 1_500_000_000
"""Bytes of address space, where the system can limit it."""


@dataclass(frozen=True, slots=True, eq=False)
class Job:
    """points : (n, 2) m. ends : (k, 2). sides : (k, 2) domains from 1 left and right, 0 outside.

    copy : (k,) the side whose nodes this one repeats, −1 for none. sizes : (domains,) greatest side (m). seconds : time
    limit, of the processor where the system can tell it.
    """

    points: Floats
    ends: Ints
    sides: Ints
    copy: Ints
    sizes: Floats
    gradings: tuple[float, ...]
    seconds: float


@dataclass(frozen=True, slots=True, eq=False)
class Answer:
    """points : (n, 2). triangles : (m, 3). domain : (m,). segments : (q, 2). failure : netgen's words, or empty."""

    points: Floats
    triangles: Ints
    domain: Ints
    segments: Ints
    failure: str = ""


def run(job: Job) -> Answer:
    """The mesh of a job, by this process's worker. Raises MeshError when the worker fails, dies or takes too long."""
    with _lock:
        worker = _worker()
        late = threading.Event()

        def stop() -> None:
            late.set()
            worker.kill()

        timer = threading.Timer(BUSY * job.seconds, stop)
        timer.daemon = True
        timer.start()
        try:
            assert worker.stdin is not None
            assert worker.stdout is not None
            _send(worker.stdin, job)
            answer: Answer = _receive(worker.stdout)
        except (OSError, EOFError, pickle.UnpicklingError):
            _end()
            if late.is_set() or worker.returncode == -getattr(signal, "SIGPROF", 0):
                raise MeshError(f"the mesher needed more than {job.seconds:.0f} s and was stopped") from None
            raise MeshError("the mesher crashed, or needed more than 1.5 GB, on this drawing") from None
        except BaseException:
            _end()
            raise
        finally:
            timer.cancel()
    if answer.failure:
        raise MeshError(f"netgen cannot mesh this drawing: {answer.failure}")
    return answer


_lock = threading.Lock()
_running: list[subprocess.Popen[bytes]] = []
_inherited: list[subprocess.Popen[bytes]] = []
"""A parent's workers after a fork: kept so that no destructor complains about processes that are not this one's."""


def _worker() -> subprocess.Popen[bytes]:
    if _running and _running[0].poll() is not None:
        _end()
    if not _running:
        threads = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
        _running.append(
            subprocess.Popen(
                [sys.executable, "-m", "fluxbore.fem.mesh_worker"],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                env={**os.environ, **threads},
            )
        )
    return _running[0]


def _end() -> None:
    """Stop the worker, if there is one."""
    while _running:
        worker = _running.pop()
        worker.kill()
        for pipe in (worker.stdin, worker.stdout):
            if pipe is not None:
                with contextlib.suppress(OSError):
                    pipe.close()
        worker.wait()


def _forget() -> None:
    """After a fork, in the child: the worker is the parent's, and its end must not wait for us."""
    global _lock
    _lock = threading.Lock()
    while _running:
        worker = _running.pop()
        for pipe in (worker.stdin, worker.stdout):
            if pipe is not None:
                with contextlib.suppress(OSError):
                    getattr(pipe, "raw", pipe).close()  # not through the buffer: what it holds is the parent's to send
        worker.returncode = 0
        _inherited.append(worker)


atexit.register(_end)
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget)


def _send(pipe: BinaryIO | Any, thing: Job | Answer) -> None:
    data = pickle.dumps(thing, protocol=pickle.HIGHEST_PROTOCOL)
    pipe.write(struct.pack("<q", len(data)))
    pipe.write(data)
    pipe.flush()


def _receive(pipe: BinaryIO | Any) -> Any:
    head = pipe.read(8)
    if len(head) < 8:
        raise EOFError
    length = struct.unpack("<q", head)[0]
    data = pipe.read(length)
    if len(data) < length:
        raise EOFError
    return pickle.loads(data)


SLENDER = 20.0
"""Degrees: a mesh with a smaller angle is made again with the next grading."""
PATIENCE = 20_000
"""Triangles of a mesh that is not made again for its angles."""


def best(job: Job) -> Answer:
    """The first mesh without slender triangles, or the one with the largest smallest angle."""
    answers: list[tuple[float, Answer]] = []
    trouble: Exception | None = None
    for grading in job.gradings:
        try:
            answer = mesh(job, grading)
        except Exception as error:
            trouble = error
            continue
        answers.append((smallest_angle(answer), answer))
        if answers[-1][0] > SLENDER or len(answer.triangles) > PATIENCE:
            break
    if not answers and trouble is not None:
        raise trouble
    return max(answers, key=lambda rated: rated[0])[1]


def smallest_angle(answer: Answer) -> float:
    """Degrees, 0 without triangles."""
    p = answer.points[answer.triangles]
    u, v = np.roll(p, -1, axis=1) - p, np.roll(p, 1, axis=1) - p
    angle = np.arctan2(np.abs(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]), (u * v).sum(axis=2))
    return float(np.degrees(angle.min(initial=np.pi))) if len(p) else 0.0


def mesh(job: Job, grading: float) -> Answer:
    """By netgen, in this process."""
    from netgen.geom2d import SplineGeometry

    geometry = SplineGeometry()
    numbers = [geometry.AppendPoint(x, y) for x, y in job.points.tolist()]
    for (a, b), (left, right), copy in zip(job.ends.tolist(), job.sides.tolist(), job.copy.tolist(), strict=True):
        more = {"copy": copy} if copy >= 0 else {}
        geometry.Append(["line", numbers[a], numbers[b]], leftdomain=left, rightdomain=right, **more)
    for domain, size in enumerate(job.sizes.tolist(), 1):
        geometry.SetDomainMaxH(domain, size)
    # Its Delaunay variant does not return on some long boundaries: the advancing front is meant.
    made = geometry.GenerateMesh(maxh=float(job.sizes.max()), grading=grading, delaunay2d=False, quad_dominated=False)
    elements, segments = made.Elements2D().NumPy(), made.Elements1D().NumPy()
    return Answer(
        np.array(made.Coordinates(), dtype=float)[:, :2],
        elements["nodes"][:, :3].astype(np.int_) - 1,
        elements["index"].astype(np.int_),
        segments["nodes"][:, :2].astype(np.int_) - 1,
    )


def main() -> None:
    """Answer jobs until the standard input ends."""
    pipe_in = os.fdopen(os.dup(0), "rb")
    pipe_out = os.fdopen(os.dup(1), "wb")
    # netgen prints to the process's own streams, where the answers go.
    nowhere = os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1, 2):
        os.dup2(nowhere, stream)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent decides
    with contextlib.suppress(ImportError, ValueError, OSError):
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (MEMORY_LIMIT, MEMORY_LIMIT))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    from netgen.meshing import SetMessageImportance

    SetMessageImportance(0)
    nothing = np.zeros((0, 3), dtype=np.int_)
    while True:
        try:
            job = _receive(pipe_in)
        except EOFError:
            return
        _stop_after(job.seconds)
        try:
            answer = best(job)
        except MemoryError:
            answer = Answer(np.zeros((0, 2)), nothing, nothing[:, 0], nothing[:, :2], "it needs more than 1.5 GB")
        except Exception as error:
            words = " ".join(str(error).split())[:60] or type(error).__name__
            answer = Answer(np.zeros((0, 2)), nothing, nothing[:, 0], nothing[:, :2], words)
        _stop_after(0)
        _send(pipe_out, answer)


def _stop_after(seconds: float) -> None:
    """End this process when it has reckoned for so long; 0 for no end. In time too, should the parent be gone."""
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_PROF, max(seconds, 0.0))
        signal.setitimer(signal.ITIMER_REAL, max(BUSY * seconds + 5 * (seconds > 0), 0.0))


if __name__ == "__main__":
    # Under its own name, so that what it pickles is what the parent knows.
    from fluxbore.fem import mesh_worker

    mesh_worker.main()
