"""Designs put through a benchmark: each seed is computed once, and what cannot be simulated costs nothing else."""

from __future__ import annotations

import csv
import io
import math

import benchmark_toy
import pytest
from benchmark_toy import TOY
from coil_study import SPEC

from fluxbore.design.errors import SpecError
from fluxbore.design.spec import loads
from fluxbore.optimize.executor import local_executor
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.progress import Progress
from fluxbore.optimize.simulation_median import median_figures
from fluxbore.optimize.simulation_run import run_benchmark
from fluxbore.optimize.simulation_table import TRACES, traces_table, trials_table

DENSITY = "actuator.coil_1.current_density"


@pytest.fixture
def spec():
    return loads(SPEC)


@pytest.fixture(autouse=True)
def calls():
    benchmark_toy.calls.clear()
    return benchmark_toy.calls


def run(designs, seeds, journal=None, **options):
    with local_executor(in_process=True) as executor:
        return run_benchmark(TOY, designs, seeds, executor, journal, "fem", **options)


def test_every_design_meets_every_seed(spec, calls):
    """Catches a seed that one design misses, traces of seeds that nobody asked for, and mixed-up designs."""
    weaker = spec.with_values({DENSITY: spec.number(DENSITY) / 2})
    told: list[Progress] = []
    result = run([("own", spec), ("weaker", weaker)], (3, 4, 5), progress=told.append)
    assert sorted(calls) == [(3, False), (3, True), (4, False), (4, False), (5, False), (5, False)]
    assert [simulation.seed for simulation in result.run.simulations] == [3, 4, 5]
    assert result.run.simulations[0].trials[0].trace is not None
    assert result.run.simulations[1].trials[0].trace is None
    own, other = (item.figures["error"]["A"] for item in result.runs)
    assert own == 4 * result.run.field
    assert own > 1.5 * other
    assert (told[-1].done, told[-1].total, told[-1].reused) == (6, 6, 0)
    assert result.run.figures["cells"] == 4
    assert isinstance(result.run.figures["cells"], int)


def test_a_design_that_cannot_be_simulated_keeps_its_reason(spec):
    """Catches one bad design that ends the others' runs, and half a design's figures shown as its result."""
    bad = spec.with_values({DENSITY: -spec.number(DENSITY)})
    result = run([("own", spec), ("bad", bad)], (1, 2))
    assert result.ok
    assert result.against[0].status == "refused"
    assert result.against[0].reasons == ("A current against the field cannot be simulated.",)
    assert result.against[0].figures == {}
    assert result.against[0].simulations == ()
    with pytest.raises(SpecError, match="cannot be simulated"):
        run([("bad", bad), ("own", spec)], (1, 2))


def test_variations_are_the_first_seed_in_the_same_field(spec, calls):
    """Catches variations of another design or seed, a field that is computed anew, and a refused one that ends all."""
    weaker = spec.with_values({DENSITY: spec.number(DENSITY) / 3})
    result = run([("own", spec), ("weaker", weaker)], (7, 8), vary=True)
    assert [item.label for item in result.against] == ["weaker"]
    half, turned, huge = result.variations
    assert [item.seed for item in half.simulations] == [7]
    assert half.field == result.run.field
    assert half.figures["error"]["A"] == pytest.approx(result.run.simulations[0].figures["error"]["A"] / 2, rel=1e-12)
    assert (turned.status, turned.figures) == ("refused", {})
    assert huge.status == "refused"
    assert DENSITY in huge.reasons[0]
    assert [item.path for item in result.moved] == [("error", "A")]
    assert sorted(calls) == [(7, False), (7, False), (7, False), (7, True), (8, False), (8, False)]
    assert run([("own", spec)], (7,)).variations == ()


def test_the_journal_spares_every_seed_that_it_holds(spec, calls, tmp_path):
    """Catches a run again that simulates again, one without the journal that sees other figures, and a key that
    forgets the design."""
    plain = run([("own", spec)], (1, 2))
    with Journal(tmp_path / "j") as journal:
        first = run([("own", spec)], (1, 2), journal)
        (tmp_path / TRACES).write_bytes(b"not parquet")
        again = run([("own", spec)], (1, 2), journal, traces=tmp_path)
        assert calls[4:] == [(1, True)]  # its traces were lost
        key = traces_key(journal)
        (tmp_path / TRACES).write_bytes(traces_table(first.run.simulations[0], key))
        calls.clear()
        third = run([("own", spec)], (1, 2), journal, traces=tmp_path)
        assert calls == []
        assert third.reused == 2
        for result in (first, again, third):
            assert result.run.figures == plain.run.figures
            assert trials_table(result.runs) == trials_table(plain.runs)
            for trial, other in zip(result.run.simulations[0].trials, plain.run.simulations[0].trials, strict=True):
                assert trial.trace.signals["force"].tolist() == other.trace.signals["force"].tolist()
                assert trial.trace.time.tolist() == other.trace.time.tolist()
        run([("own", spec.with_values({DENSITY: 1e7}))], (1,), journal, traces=tmp_path)
        assert calls == [(1, True)]


def traces_key(journal: Journal) -> str:
    import json

    lines = [json.loads(line) for line in journal.path.read_text().splitlines()]
    return next(line["key"] for line in lines if line["kind"] == "simulation" and "content" in line)


def test_the_table_has_a_row_for_each_trial(spec):
    """Catches rows of one seed alone, figures under another's name, and a "nan" where nothing is known."""
    result = run([("own", spec)], (1, 2))
    rows = list(csv.DictReader(io.StringIO(trials_table(result.runs))))
    assert len(rows) == 2 * 4
    last = rows[-1]
    assert (last["design"], last["seed"], last["way"], last["load"]) == ("own", "2", "B", "0.2")
    assert float(last["error"]) == 2 * result.run.field * 0.2
    assert last["none"] == ""


def test_medians_go_into_what_is_nested():
    """Catches a mean in a median's place, whole counts that become fractions, and words that differ taken for one."""
    runs = [
        {"a": {"x": 1.0}, "n": 36, "pairs": [{"p": 0.1, "of": "A"}], "word": "u", "none": None},
        {"a": {"x": 2.0}, "n": 35, "pairs": [{"p": 0.3, "of": "A"}], "word": "v", "none": 1.0},
        {"a": {"x": 9.0}, "n": 36, "pairs": [{"p": 0.2, "of": "A"}], "word": "u", "none": 1.0},
    ]
    found = median_figures(runs)
    assert found == {"a": {"x": 2.0}, "n": 36, "pairs": [{"p": 0.2, "of": "A"}], "word": None, "none": None}
    assert median_figures(runs[:2])["n"] == 35.5
    assert median_figures([]) == {}


def test_a_published_figure_is_held_against_its_own_path():
    """Catches a comparison with a figure that is not there, and one whose sign of the difference counts."""
    published, _ = TOY.published
    assert published.of({"error": {"A": 1.25}}) == 1.25
    assert published.reproduced({"error": {"A": 0.5}}) is True
    assert published.reproduced({"error": {"A": 0.49}}) is False
    assert published.reproduced({"error": 3.0}) is None
    assert not math.isnan(published.value)
