"""The Python interface: the command line's words as typed functions."""

import inspect
import subprocess
import sys
from pathlib import Path

import pytest

import fluxbore
from fluxbore.design.spec_file import template

TOP = Path(__file__).parents[1]
VERBS = (
    "design",
    "evaluate",
    "export",
    "load",
    "optimize",
    "pareto",
    "report",
    "robust",
    "snap",
    "solve",
    "sweep",
    "tolerance",
)

SCRIPT = """
from pathlib import Path

import fluxbore
from fluxbore import Evaluation, FemmSolution, FluxboreError, Spec, SweepResult


def best(path: Path) -> float:
    spec: Spec = fluxbore.load(path, {"actuator.mover.ring_width": "2 mm"})
    evaluation: Evaluation = fluxbore.evaluate(spec, "network")
    sweeps: tuple[SweepResult, ...] = fluxbore.sweep(spec, fidelity="network", workers=1)
    files: list[Path] = fluxbore.export(spec, "cad")
    page: Path = fluxbore.report(spec, "report.html", picture=False).files[0]
    solution: FemmSolution = fluxbore.solve("model.fem", groups=[1], changes={"circuit.coil.current": 2.0})
    pull: tuple[float, float] = solution.force(1).value.force
    slopes = fluxbore.evaluate(spec, gradient=["actuator.mover.ring_width"]).gradient or {}
    front: fluxbore.ParetoResult = fluxbore.pareto(spec, "out", scheduler="tcp://127.0.0.1:8786", time_limit=60.0)
    made: fluxbore.ToleranceResult = fluxbore.tolerance(spec, fidelity="network")
    reached: bool = fluxbore.robust(spec).reached
    print(slopes["force_constant"]["actuator.mover.ring_width"], front.front, made.best_estimate.low, reached)
    found = fluxbore.optimize(spec, "out", workers=2, force=True)
    chosen = fluxbore.design(spec, "out").evaluation
    print(files, page, pull, found.chosen, sweeps[0].rows[0].values, chosen.performance.force_constant)
    return evaluation.performance.force_constant or 0.0


try:
    best(Path("spec.toml"))
except FluxboreError as error:
    print(error)
"""


@pytest.fixture
def spec_file(tmp_path):
    path = tmp_path / "spec.toml"
    path.write_text(template("ipehla"))
    return path


def python(code: str, cwd: Path) -> str:
    done = subprocess.run([sys.executable, "-c", code], cwd=cwd, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


FIRST = (
    "",
    pytest.param("import fluxbore.optimize.evaluate", marks=pytest.mark.full),
    pytest.param("import fluxbore.design.spec, fluxbore.optimize.sweep", marks=pytest.mark.full),
    "from fluxbore.design import spec; from fluxbore import optimize",
)


@pytest.mark.parametrize("first", FIRST)
def test_verbs_stay_verbs_whatever_was_imported_first(first, tmp_path):
    """Catches `fluxbore.optimize(spec)` becoming a call of a module once somebody imports the room of that name."""
    code = f"{first}\nimport fluxbore\nprint(*(callable(getattr(fluxbore, verb)) for verb in {VERBS}))"
    assert python(code, tmp_path) == " ".join(["True"] * len(VERBS))
    for call in ("optimize('none.toml')", "design('none.toml', 'out')"):
        code = f"{first}\nimport fluxbore\ntry: fluxbore.{call}\nexcept fluxbore.FluxboreError as error: print(error)"
        assert python(code, tmp_path) == "none.toml cannot be read: No such file or directory."
    assert list(tmp_path.iterdir()) == []


def test_every_public_name_is_there_and_documented():
    for name in fluxbore.__all__:
        assert inspect.getdoc(getattr(fluxbore, name)), name
    with pytest.raises(AttributeError, match="has no attribute 'nonsense'"):
        fluxbore.nonsense


def test_a_path_will_do_for_a_specification(spec_file):
    spec = fluxbore.load(spec_file)
    assert isinstance(spec, fluxbore.Spec)
    by_path, by_text, by_spec = (fluxbore.evaluate(x, "network") for x in (spec_file, str(spec_file), spec))
    assert by_path == by_text == by_spec
    assert by_path.ok
    assert isinstance(by_path, fluxbore.Evaluation)
    assert isinstance(by_path.performance, fluxbore.Performance)


def test_overrides_are_the_command_line_s(spec_file):
    assert fluxbore.load(spec_file, {"actuator.mover.ring_width": "2 mm"}).number("actuator.mover.ring_width") == 0.002
    with pytest.raises(fluxbore.FluxboreError, match=r"did you mean actuator\.mover\.ring_width\?"):
        fluxbore.load(spec_file, {"actuator.mover.ring_widht": "2 mm"})


def test_a_design_that_fails_is_a_value(spec_file):
    overrides = {"operating_point.positions": "1", "solver.max_iterations": "1"}
    evaluation = fluxbore.evaluate(fluxbore.load(spec_file, overrides))
    assert not evaluation.ok
    assert evaluation.reasons
    assert evaluation.performance == fluxbore.Performance()


def test_a_sweep_keeps_grid_order_and_writes_where_told(spec_file, tmp_path):
    spec = fluxbore.load(spec_file)
    results = fluxbore.sweep(spec, tmp_path / "out", fidelity="network", workers=1)
    assert [len(result.rows) for result in results] == [24, 9]
    assert isinstance(results[0], fluxbore.SweepResult)
    for result in results:
        axis = result.sweep.axes[0]
        assert [row.values[axis.key] for row in result.rows] == list(axis.values)
    assert (tmp_path / "out" / "results.csv").exists()


@pytest.mark.parametrize(
    "missing",
    ["study.objective", "study.variables", "study.sweeps"],
)
def test_what_a_study_lacks_is_said_before_anything_is_written(missing, spec_file, tmp_path):
    """Catches a folder that a refused run leaves behind, and that the corrected one then finds taken."""
    spec = fluxbore.load(spec_file, {missing: ""})
    with pytest.raises(fluxbore.FluxboreError, match=f"^{missing} must be given"):
        (fluxbore.sweep if missing == "study.sweeps" else fluxbore.optimize)(spec, tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_a_script_checks_under_mypy_strict(tmp_path):
    """Catches an interface whose types get lost behind the lazy imports."""
    pytest.importorskip("mypy")
    (tmp_path / "script.py").write_text(SCRIPT)
    # The project's own settings say how to follow its dependencies; its cache makes this a matter of seconds.
    config = str(TOP / "pyproject.toml")
    command = [sys.executable, "-m", "mypy", "--strict", "--config-file", config, str(tmp_path / "script.py")]
    done = subprocess.run(command, cwd=TOP, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_every_kind_of_actuator_stands_in_every_table() -> None:
    """A kind that specifications can name and that nothing can evaluate, draw or report."""
    from fluxbore.actuators import ACTUATORS
    from fluxbore.design.spec import KINDS
    from fluxbore.optimize.evaluate import MODELS

    assert set(KINDS) == set(MODELS) == set(ACTUATORS)
