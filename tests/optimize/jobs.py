"""Tasks for the executor's tests, importable by worker processes."""

import os
import signal
import sys
import time
from pathlib import Path

import toy

from fluxbore.design.performance import Performance
from fluxbore.optimize.evaluation import OK, Evaluation


def double(number):
    return 2 * number


def fragile(task):
    """Do what the word says, else give the task back."""
    if task == "raise":
        raise ValueError("raised on purpose")
    if task == "memory":
        raise MemoryError
    if task == "exit":
        os._exit(7)
    if task in ("kill", "segv"):
        os.kill(os.getpid(), signal.SIGKILL if task == "kill" else signal.SIGSEGV)
    return task


def die_once(flag):
    if not Path(flag).exists():
        Path(flag).touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return flag


def announce_and_sleep(folder):
    (Path(folder) / str(os.getpid())).touch()
    time.sleep(600)


def sleep_but_first(task):
    folder, number = task
    (Path(folder) / str(os.getpid())).touch()
    if number:
        time.sleep(600)


def surroundings(_):
    return [os.environ.get(name) for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS")], "numpy" in sys.modules


def interrupts_blocked(_):
    return signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, ())


def chatter(_):
    print("chatter", flush=True)
    os.write(1, b"more chatter\n")


def stillborn(_connection, _preload):
    os._exit(3)


def kill_the_clusters_worker(kills):
    """Take the process above with us, as a lack of memory may; the others are at work meanwhile."""
    if kills:
        os.kill(os.getppid(), signal.SIGKILL)
    time.sleep(600 if kills else 0.5)
    return kills


def slow_rosenbrock(design, fidelity="fem"):
    """`toy.rosenbrock`, whose network leaves no trace: it is not recorded, so that it is computed in every run."""
    if fidelity == "network":
        return Evaluation(fidelity, OK, (), Performance(force_constant=-((design.number(toy.X) - 0.5) ** 2)))
    time.sleep(0.02)
    return toy.rosenbrock(design, fidelity)


def search_study(designs):
    """A search of so many designs, without derivatives."""
    return toy.rosenbrock_study(algorithm="ISRES", max_evaluations=designs)
