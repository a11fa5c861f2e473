"""The executor: every task has one outcome, whatever its process does; nothing outlives the parent."""

import contextlib
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import jobs
import pytest

from fluxbore.design.errors import FluxboreError
from fluxbore.optimize.executor import ProcessExecutor, SerialExecutor, local_executor


@pytest.fixture(params=["processes", "serial"])
def executor(request):
    with local_executor(2, in_process=request.param == "serial") as made:
        yield made


def alive(process: int) -> bool:
    """Whether it runs; a zombie, which waits for a parent that may not look, does not."""
    try:
        state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return False
    return state not in ("Z", "X")


def ended(processes, patience=20.0):
    """Whether all of them end; the patience is for a loaded machine, not a measure of speed."""
    limit = time.monotonic() + patience
    while any(alive(process) for process in processes):
        if time.monotonic() > limit:
            return False
        time.sleep(0.02)
    return True


def test_every_task_has_its_outcome(executor):
    """Catches outcomes that are lost, doubled or given to another task."""
    outcomes = list(executor.run(jobs.double, range(50)))
    assert sorted((o.index, o.value, o.failure) for o in outcomes) == [(i, 2 * i, None) for i in range(50)]
    assert list(executor.run(jobs.double, [])) == []


def test_an_exception_costs_its_task_alone(executor):
    """Catches a search that ends with its first failed design."""
    outcomes = {o.index: o for o in executor.run(jobs.fragile, ["raise", 1, "memory", 2])}
    assert outcomes[0].failure == "The evaluation stopped with ValueError: raised on purpose."
    assert outcomes[2].failure
    assert [outcomes[i].value for i in (1, 3)] == [1, 2]


@pytest.mark.parametrize(
    ("death", "words"),
    [("exit", "ended with exit status 7"), ("kill", "was killed by the signal SIGKILL"), ("segv", "signal SIGSEGV")],
)
def test_a_crash_costs_its_task_alone(death, words):
    """Catches a broken pool that blames the innocent designs beside the one that crashed."""
    with local_executor(2) as executor:
        tasks = [1, death, 2, 3, death, 4, 5, 6]
        outcomes = {o.index: o for o in executor.run(jobs.fragile, tasks)}
        assert [o.index for i in range(8) if (o := outcomes[i]).failure] == [1, 4]
        assert words in outcomes[1].failure
        assert [outcomes[i].value for i in (0, 2, 3, 5, 6, 7)] == [1, 2, 3, 4, 5, 6]
        assert next(executor.run(jobs.double, [4])).value == 8, "the executor goes on after a crash"


def test_a_worker_killed_from_outside_costs_nothing(tmp_path):
    """Catches a design that is blamed for its neighbour's greed for memory: it is tried once more, alone."""
    flag = tmp_path / "flag"
    with local_executor(2) as executor:
        assert [o.value for o in executor.run(jobs.die_once, [str(flag)])] == [str(flag)]


def test_tasks_are_taken_as_they_can_be_used():
    """Catches a grid of a million designs that is built before the first one is computed."""
    taken = []

    def tasks():
        for i in range(1000):
            taken.append(i)
            yield i

    with local_executor(2) as executor:
        outcomes = executor.run(jobs.double, tasks())
        next(outcomes)
        assert len(taken) <= 6
        outcomes.close()


def test_leaving_early_ends_what_is_in_flight(tmp_path):
    """Catches workers that compute on after Ctrl-C."""
    with local_executor(2) as executor:
        outcomes = executor.run(jobs.sleep_but_first, [(str(tmp_path), i) for i in range(5)])
        next(outcomes)
        outcomes.close()
        processes = [int(file.name) for file in tmp_path.iterdir()]
        assert next(executor.run(jobs.double, [1])).value == 2, "and goes on afterwards"
    assert ended(processes)


def test_workers_are_single_threaded_before_numpy_and_do_not_import_it_early():
    """Catches two workers whose BLAS threads fight over two cores; numpy reads the setting when it is imported."""
    before = dict(os.environ)
    with local_executor(1) as executor:
        threads, numpy_there = next(executor.run(jobs.surroundings, [None])).value
    assert threads == ["1", "1"]
    assert not numpy_there
    assert dict(os.environ) == before


def test_a_worker_cannot_write_to_standard_output(capfd):
    """Catches a library's chatter inside the JSON that the command line prints."""
    with local_executor(1) as executor:
        list(executor.run(jobs.chatter, [None]))
    assert capfd.readouterr().out == ""


def start(*command: object) -> subprocess.Popen:
    """Python in a session of its own, with this process's path."""
    return subprocess.Popen(
        [sys.executable, *map(str, command)],
        env=os.environ | {"PYTHONPATH": os.pathsep.join(part for part in sys.path if part)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


ENDLESS = """
import sys, jobs
from fluxbore.optimize.executor import local_executor
with local_executor(2) as executor:
    list(executor.run(jobs.announce_and_sleep, [sys.argv[1]] * 2))
"""


def running(folder: Path, process: subprocess.Popen) -> list[int]:
    """The two workers' numbers, once both are at work."""
    while len(found := list(folder.iterdir())) < 2:
        assert process.poll() is None, process.stderr.read()
        time.sleep(0.02)
    return [int(file.name) for file in found]


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_no_worker_outlives_its_parent(tmp_path, number):
    """Catches orphans that fill the machine after a kill, and a Ctrl-C that hangs or prints a page for every worker."""
    script = tmp_path / "script.py"
    script.write_text(ENDLESS)
    folder = tmp_path / "workers"
    folder.mkdir()
    process = start(script, folder)
    workers = running(folder, process)
    if number == signal.SIGINT:
        os.killpg(process.pid, number)  # as a terminal does it
    else:
        process.send_signal(number)
    _, errors = process.communicate()
    assert ended(workers)
    if number == signal.SIGINT:
        assert errors.count("Traceback") == 1, "the parent's own"


def test_a_plain_script_needs_no_guard(tmp_path):
    """Catches spawn's habit of running the user's script again in every worker."""
    script = tmp_path / "script.py"
    script.write_text(
        "import jobs\nfrom fluxbore.optimize.executor import local_executor\nprint('once')\n"
        "with local_executor(2) as executor:\n    print(sum(o.value for o in executor.run(jobs.double, range(4))))\n"
    )
    process = start(script)
    out, errors = process.communicate()
    assert (out, errors) == ("once\n12\n", "")


def test_ctrl_c_reaches_no_worker_from_its_first_moment(tmp_path):
    """Catches a traceback of each worker on Ctrl-C; the very first one of a process is the one that escapes."""
    script = tmp_path / "script.py"
    script.write_text(
        "import jobs, signal\nfrom fluxbore.optimize.executor import local_executor\n"
        "with local_executor(2) as executor:\n"
        "    print([o.value for o in executor.run(jobs.interrupts_blocked, range(4))])\n"
        "print(jobs.interrupts_blocked(None))\n"
    )
    out, errors = start(script).communicate()
    assert (out, errors) == ("[True, True, True, True]\nFalse\n", "")


def test_workers_that_cannot_start_are_one_sentence(monkeypatch):
    """Catches an endless series of processes that die as they are born."""
    monkeypatch.setattr("fluxbore.optimize.worker._work", jobs.stillborn)
    with (
        local_executor(2) as executor,
        pytest.raises(FluxboreError, match="cannot be started: each ended with exit status 3"),
    ):
        list(executor.run(jobs.double, [1, 2]))


def test_a_task_beyond_its_time_limit_costs_itself_alone(tmp_path):
    """Catches a design that hangs and holds up a study for ever, and a process that goes on after it was given up."""
    with local_executor(2, time_limit=3.0) as executor:
        outcomes = {o.index: o for o in executor.run(jobs.sleep_but_first, [(tmp_path, i == 1) for i in range(4)])}
        assert [outcomes[i].failure for i in (0, 2, 3)] == [None] * 3
        assert outcomes[1].failure == "The evaluation took longer than its time limit of 3 s."
        assert sum(alive(int(path.name)) for path in tmp_path.iterdir()) == 1  # whoever did the short ones
        assert [outcome.value for outcome in executor.run(jobs.double, [4])] == [8]


def test_the_default_is_a_process_for_each_core():
    with contextlib.closing(local_executor()) as executor:
        assert isinstance(executor, ProcessExecutor)
        assert executor.workers == len(os.sched_getaffinity(0))
    assert isinstance(local_executor(in_process=True), SerialExecutor)
    with pytest.raises(FluxboreError, match="workers must be at least 1; got 0"):
        local_executor(0)
