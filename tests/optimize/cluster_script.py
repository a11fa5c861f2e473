"""Runs a sweep of the toy on a cluster, as the command line does.  cluster_script.py FOLDER ADDRESS"""

import sys
from pathlib import Path

import toy

from fluxbore.optimize.cluster import executor_for
from fluxbore.optimize.folder import open_folder
from fluxbore.optimize.sweep import run_sweeps
from fluxbore.optimize.table import FILE_NAME, results_table

spec = toy.two_sweeps(points=9)
with open_folder(Path(sys.argv[1]), spec) as folder, executor_for(scheduler=sys.argv[2]) as executor:
    results = run_sweeps(spec, folder.journal, executor, evaluate=toy.slow)
    folder.write(FILE_NAME, results_table(spec, results))
