"""Runs a study in a folder, as the command line does; the kill tests kill it.  sweep_script.py FOLDER WHAT

WHAT : of the toy, whose designs take 20 ms, "sweep 9" over 9 x 9 and 4 designs or "search 80" over 80; or the path of a
specification to sweep by finite elements.
"""

import sys
from pathlib import Path

import jobs
import toy

from fluxbore.design.spec import load
from fluxbore.optimize import parquet, table
from fluxbore.optimize.executor import local_executor
from fluxbore.optimize.folder import open_folder
from fluxbore.optimize.search import run_search
from fluxbore.optimize.sweep import run_sweeps


def study(what):
    kind, _, size = what.partition(" ")
    if kind == "sweep":
        return toy.two_sweeps(points=int(size))
    return jobs.search_study(int(size)) if kind == "search" else load(what)


def results(what, spec, journal, executor):
    """The study's sweeps and its search's designs."""
    if what.startswith("search "):
        return (), run_search(spec, journal, executor, evaluate=jobs.slow_rosenbrock).history
    options = {"evaluate": toy.slow} if what.startswith("sweep ") else {}
    return run_sweeps(spec, journal, executor, **options), ()


if __name__ == "__main__":
    spec = study(sys.argv[2])
    with open_folder(Path(sys.argv[1]), spec) as folder, local_executor(2) as executor:
        found = results(sys.argv[2], spec, folder.journal, executor)
        folder.write(table.FILE_NAME, table.results_table(spec, *found))
        folder.write(parquet.FILE_NAME, parquet.results_parquet(spec, *found))
