"""results.csv: exact numbers, nothing for what is not known, whole lines whatever stands in a reason."""

import csv
import io

import toy

from fluxbore.design.performance import FIGURES
from fluxbore.optimize.executor import SerialExecutor
from fluxbore.optimize.outcome import Candidate
from fluxbore.optimize.sweep import run_sweeps
from fluxbore.optimize.table import results_table


def test_the_table_is_exact_and_whole():
    """Catches rounded numbers, "None", line breaks inside a row, and a key's column that is empty or wrong."""
    spec = toy.two_sweeps()
    results = run_sweeps(spec, None, SerialExecutor(), evaluate=toy.plain)
    text = results_table(spec, results)
    rows = list(csv.reader(io.StringIO(text)))
    assert rows[0] == [toy.X, toy.Y, toy.N, *FIGURES, "status", "reason"]
    assert len(rows) == 1 + 25 + 4 == text.count("\n")
    made = [row for result in results for row in result.rows]
    for line, row in zip(rows[1:], made, strict=True):
        cells = dict(zip(rows[0], line, strict=True))
        force = row.evaluation.performance.force_constant
        assert cells["force_constant"] == ("" if force is None else repr(force))
        assert cells["motor_constant"] == ""
        assert cells["status"] == row.evaluation.status
        values = {toy.X: 1.0, toy.Y: 1.0, toy.N: 1, **row.values}
        assert [cells[key] for key in values] == [repr(value) for value in values.values()]
    assert 'No convergence at x = 5.0, "y" = 2.5; the last residual is 0.1.' in [line[-1] for line in rows]


def test_a_searchs_designs_follow_the_sweeps():
    spec = toy.spec()
    evaluation = toy.plain(spec)
    text = results_table(spec, (), [Candidate({toy.X: 0.1}, evaluation, 1.0, ())])
    assert text.startswith(f"{toy.X},force_constant,")
    assert text.splitlines()[1].startswith(f"0.1,{evaluation.performance.force_constant!r},")
