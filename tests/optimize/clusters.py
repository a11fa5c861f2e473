"""A real Dask scheduler and its workers as processes, on ports that the system chooses, for the cluster's tests."""

import json
import os
import signal
import subprocess
import sys
import time
from contextlib import contextmanager, suppress
from pathlib import Path

PATIENCE = 60.0
"""s for a process to come up on a loaded machine; not a measure of speed."""


class Cluster:
    def __init__(self, folder: Path, **environment: str) -> None:
        self.folder, self.environment = folder, environment
        self.file = folder / "scheduler.json"
        self.processes: list[subprocess.Popen] = []
        self.scheduler = self.start(
            "scheduler", "--host", "127.0.0.1", "--port", "0", "--scheduler-file", self.file, "--idle-timeout", "300s"
        )
        self.address: str = self.wait(self._address)

    def start(self, *arguments: object, **environment: str) -> subprocess.Popen:
        """A Dask process in a session of its own, so that what it starts can be ended with it."""
        command = [sys.executable, "-m", "dask", *map(str, arguments), "--no-dashboard", "--dashboard-address", ":0"]
        path = os.pathsep.join(part for part in sys.path if part)
        with (self.folder / f"log{len(self.processes)}").open("wb") as log:
            process = subprocess.Popen(
                command,
                cwd=self.folder,
                env=os.environ | {"PYTHONPATH": path} | self.environment | environment,
                stdout=log,
                stderr=log,
                start_new_session=True,
            )
        self.processes.append(process)
        return process

    def worker(self, *options: str, **environment: str) -> subprocess.Popen:
        return self.start(
            *("worker", self.address, "--host", "127.0.0.1", "--nthreads", "1", "--memory-limit", "0"),
            *("--local-directory", self.folder, "--death-timeout", "60", *options),
            **environment,
        )

    def wait(self, condition):
        """What the condition gives, once it gives something."""
        limit = time.monotonic() + PATIENCE
        while not (found := condition()):
            assert time.monotonic() < limit, [log.read_text()[-2000:] for log in self.folder.glob("log*")]
            time.sleep(0.02)
        return found

    def _address(self) -> str | None:
        try:
            return json.loads(self.file.read_text())["address"]
        except (FileNotFoundError, ValueError):
            return None

    def close(self) -> None:
        for process in self.processes:
            kill(process)


def kill(process: subprocess.Popen) -> None:
    """The process and what it has started, at once, as a machine that fails."""
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


@contextmanager
def cluster(folder: Path, **environment: str):
    made = Cluster(folder, **environment)
    try:
        yield made
    finally:
        made.close()
