"""A Dask cluster does what local processes do, also while its workers die: a real scheduler, two real workers."""

import contextlib
import os
import pickle
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

import jobs
import pytest
import toy
from clusters import cluster, kill

from fluxbore.design.errors import FluxboreError, MissingLibraryError
from fluxbore.optimize.cluster import ClusterExecutor, executor_for
from fluxbore.optimize.cluster_task import OtherProgramError, versions
from fluxbore.optimize.executor import ProcessExecutor, SerialExecutor
from fluxbore.optimize.sweep import run_sweeps
from fluxbore.optimize.table import results_table

SCRIPT = Path(__file__).with_name("cluster_script.py")

# Dask leaves sockets to the garbage collector when a peer vanishes; nothing of ours is meant.
pytestmark = [
    pytest.mark.filterwarnings("ignore::ResourceWarning"),
    pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning"),
]


@pytest.fixture(scope="module")
def two_workers(tmp_path_factory):
    """A cluster of two workers that stay."""
    with cluster(tmp_path_factory.mktemp("cluster")) as made:
        made.worker()
        made.worker()
        with ClusterExecutor(made.address) as executor:
            made.wait(lambda: len(executor._client.nthreads()) == 2)
        yield made


@pytest.fixture
def executor(two_workers):
    with ClusterExecutor(two_workers.address) as made:
        yield made


def ended(processes):
    """Whether all of these processes end, with patience for a loaded machine."""
    limit = time.monotonic() + 20
    while any(alive(process) for process in processes):
        if time.monotonic() > limit:
            return False
        time.sleep(0.02)
    return True


def alive(process):
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] not in ("Z", "X")
    except (FileNotFoundError, ProcessLookupError):
        return False


def test_every_task_has_its_outcome(executor):
    """Catches outcomes that are lost, doubled or given to another task."""
    outcomes = list(executor.run(jobs.double, range(30)))
    assert sorted((o.index, o.value, o.failure) for o in outcomes) == [(i, 2 * i, None) for i in range(30)]
    assert list(executor.run(jobs.double, [])) == []
    assert executor.workers == 2


def test_a_crash_costs_its_task_alone(executor):
    """Catches a crash that takes the cluster's worker with it, and every task beside it."""
    tasks = ["raise", 1, "memory", "kill", 2, "exit", 3]
    outcomes = {o.index: o for o in executor.run(jobs.fragile, tasks)}
    assert [outcomes[i].value for i in (1, 4, 6)] == [1, 2, 3]
    assert outcomes[0].failure == "The evaluation stopped with ValueError: raised on purpose."
    assert "out of memory" in outcomes[2].failure
    assert "SIGKILL, 2 times" in outcomes[3].failure
    assert "exit status 7, 2 times" in outcomes[5].failure


def test_a_worker_computes_with_one_thread_of_blas(executor):
    """Catches a node whose every task starts as many threads as the node has cores."""
    threads, _ = next(executor.run(jobs.surroundings, [None])).value
    assert threads == ["1", "1"]


def test_a_task_beyond_its_time_limit_costs_itself_alone(two_workers, tmp_path):
    """Catches a design that hangs and keeps a thread of the cluster for ever."""
    with ClusterExecutor(two_workers.address, 3.0) as executor:
        outcomes = {o.index: o for o in executor.run(jobs.sleep_but_first, [(tmp_path, i == 1) for i in range(4)])}
        assert [outcomes[i].failure for i in (0, 2, 3)] == [None] * 3
        assert outcomes[1].failure == "The evaluation took longer than its time limit of 3 s."
    assert ended(int(path.name) for path in tmp_path.iterdir())


def test_leaving_early_ends_what_is_in_flight(executor, tmp_path):
    """Catches a cluster that computes on after Ctrl-C."""
    outcomes = executor.run(jobs.sleep_but_first, [(str(tmp_path), i) for i in range(5)])
    next(outcomes)
    outcomes.close()
    assert ended([int(file.name) for file in tmp_path.iterdir()])
    assert next(executor.run(jobs.double, [1])).value == 2, "and goes on afterwards"


def test_tasks_are_taken_as_they_can_be_used(executor):
    """Catches a grid of a million designs that is sent to the scheduler at once."""
    taken = []

    def tasks():
        for i in range(1000):
            taken.append(i)
            yield i

    with contextlib.closing(executor.run(jobs.double, tasks())) as outcomes:
        next(outcomes)
        assert len(taken) <= 8


def test_a_sweep_gives_the_local_table_while_a_worker_dies(tmp_path):
    """Catches a row that is lost, doubled or failed because a machine of the cluster went away under it."""
    spec = toy.two_sweeps(points=9)
    expected = results_table(spec, run_sweeps(spec, None, SerialExecutor(), evaluate=toy.plain))
    trace = tmp_path / "trace"
    (tmp_path / "cluster").mkdir()
    with cluster(tmp_path / "cluster", TOY_LOG=str(trace)) as made:
        doomed = made.worker("--no-nanny")
        made.worker()
        process = subprocess.Popen(
            [sys.executable, str(SCRIPT), str(tmp_path / "out"), made.address],
            env=os.environ | {"PYTHONPATH": os.pathsep.join(part for part in sys.path if part)},
            stderr=subprocess.PIPE,
        )
        made.wait(lambda: (trace.exists() and len(trace.read_text().splitlines()) > 20) or process.poll() is not None)
        assert process.poll() is None, process.stderr.read().decode()
        kill(doomed)
        _, errors = process.communicate(timeout=60)
    assert (process.returncode, errors) == (0, b"")
    assert (tmp_path / "out" / "results.csv").read_bytes() == expected.encode()
    computed = trace.read_text().splitlines()
    assert len(set(computed)) == 9 * 9 - 1 + 4
    assert len(computed) - len(set(computed)) <= 2, "only what the dead worker held may be computed again"


def test_a_task_that_kills_its_workers_is_a_row(tmp_path):
    """Catches a design that takes one machine after another with it, for ever, and one that is blamed for another's."""
    with cluster(tmp_path, DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES="0") as made:
        made.worker("--nthreads", "2")
        with ClusterExecutor(made.address) as executor:
            outcomes = {o.index: o for o in executor.run(jobs.kill_the_clusters_worker, [False, True, False])}
    assert [(outcomes[i].value, outcomes[i].failure) for i in (0, 2)] == [(False, None)] * 2
    assert outcomes[1].failure == "A worker of the cluster died while it computed the design."


def test_a_worker_without_this_fluxbore_is_one_sentence(tmp_path):
    """Catches a study of which every row failed, or whose figures are another version's."""
    (tmp_path / "other" / "fluxbore").mkdir(parents=True)
    (tmp_path / "other" / "fluxbore" / "__init__.py").touch()
    with cluster(tmp_path) as made:
        made.worker(PYTHONPATH=str(tmp_path / "other"))
        with (
            ClusterExecutor(made.address) as executor,
            pytest.raises(FluxboreError, match=r"cannot run this version of fluxbore: ModuleNotFoundError: .*\.$"),
        ):
            list(executor.run(jobs.double, [1]))


def test_a_worker_of_another_version_is_one_sentence(executor, monkeypatch):
    monkeypatch.setattr(executor, "_program", "of yesterday")
    with pytest.raises(FluxboreError, match=r"^A worker of the scheduler \"tcp:.* was started before its fluxbore"):
        list(executor.run(jobs.double, [1]))


def test_another_program_says_which_part_of_it_differs():
    """Catches a hunt through four versions; the sentence is made where it is read, after the way over the network."""
    error = OtherProgramError({**versions(), "numpy": "1.0"})
    said = str(pickle.loads(pickle.dumps(error)))
    assert said == f"has numpy 1.0, here {versions()['numpy']}: make them alike and restart it"


def test_a_scheduler_that_is_lost_or_has_no_worker_is_one_sentence(tmp_path):
    """Catches a run that waits for ever."""
    with cluster(tmp_path) as made:
        with (
            ClusterExecutor(made.address, worker_patience=0.5) as executor,
            pytest.raises(FluxboreError, match=r"^The scheduler \"tcp:.*\" has had no worker for 0\.5 s\.$"),
        ):
            list(executor.run(jobs.double, [1]))
        with ClusterExecutor(made.address) as executor:
            threading.Timer(1.0, kill, [made.scheduler]).start()
            with pytest.raises(FluxboreError, match=r"was lost; run again to go on\.$"):
                list(executor.run(jobs.double, [1]))


@pytest.mark.parametrize("address", ["nowhere", "http://localhost:1", "tcp://127.0.0.1:{silent}", "tcp://\n:1"])
def test_an_address_without_a_scheduler_is_one_sentence(address, monkeypatch):
    """Catches a traceback, and a run that hangs on a port at which something else answers."""
    monkeypatch.setattr("fluxbore.optimize.cluster.CONNECT_PATIENCE", 0.2)
    with socket.create_server(("127.0.0.1", 0)) as server:
        address = address.format(silent=server.getsockname()[1])
        with pytest.raises(FluxboreError, match=r"^scheduler must be the address of a Dask scheduler.*\.$"):
            ClusterExecutor(address)


def test_without_dask_one_sentence_says_how_to_get_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(MissingLibraryError, match=r'pip install "fluxbore\[cluster\]"$'):
        ClusterExecutor("tcp://127.0.0.1:1")


def test_the_executor_is_chosen(two_workers):
    with contextlib.closing(executor_for(1, time_limit=5.0)) as local:
        assert isinstance(local, ProcessExecutor)
    with contextlib.closing(executor_for(scheduler=two_workers.address)) as remote:
        assert isinstance(remote, ClusterExecutor)
    with pytest.raises(FluxboreError, match="workers must not be given beside a scheduler"):
        executor_for(2, two_workers.address)
    for make in (lambda: executor_for(1, time_limit=0.0), lambda: executor_for(None, "tcp://127.0.0.1:1", -1.0)):
        with pytest.raises(FluxboreError, match="time limit of a design must be above 0 s"):
            make()


def test_ctrl_c_ends_the_client_and_what_it_computes(two_workers, tmp_path):
    """Catches a first Ctrl-C that hangs on the cluster, or leaves it at work."""
    script = "import sys, jobs\nfrom fluxbore.optimize.cluster import executor_for\n"
    script += "with executor_for(scheduler=sys.argv[1]) as executor:\n"
    script += "    list(executor.run(jobs.announce_and_sleep, [sys.argv[2]] * 2))\n"
    process = subprocess.Popen(
        [sys.executable, "-c", script, two_workers.address, str(tmp_path)],
        env=os.environ | {"PYTHONPATH": os.pathsep.join(part for part in sys.path if part)},
        stderr=subprocess.PIPE,
        text=True,
    )
    two_workers.wait(lambda: len(list(tmp_path.iterdir())) == 2 or process.poll() is not None)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert errors.strip().endswith("KeyboardInterrupt"), errors
    assert ended([int(file.name) for file in tmp_path.iterdir()])
