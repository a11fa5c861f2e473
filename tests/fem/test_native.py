"""The compiled kernels: the same equations as numpy's arrays, on every kind of processor; how they are compiled."""

from __future__ import annotations

import os
import shutil
import subprocess
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest

from fluxbore.design.spec import Spec
from fluxbore.fem import cell_system, native, tubular
from fluxbore.fem.asymptotic import Rim, open_rim
from fluxbore.fem.cell_arrays import CellArrays
from fluxbore.fem.cell_model import CellModel, cell_model
from fluxbore.fem.cell_native import CellNative
from fluxbore.fem.factors import Factor, SingularMatrixError
from fluxbore.fem.kernels.build import FOLDER, LEVELS, SOURCES, build, compiler, library
from fluxbore.fem.mapped import mapped_mesh
from fluxbore.fem.native import functions, level
from fluxbore.fem.problem import Problem
from fluxbore.fem.refined import ROUNDING, Refined
from fluxbore.fem.tubular import TubularSolution, magnetic_material
from fluxbore.geometry.hybrid import cross_section
from fluxbore.optimize.evaluate import evaluate


def compiles() -> bool:
    """Whether this machine's compiler makes a library that includes a header."""
    command = [*(compiler() or ["no-compiler"]), "-shared", "-x", "c", "-", "-o", os.devnull]
    try:
        return subprocess.run(command, input="#include <math.h>\n", text=True, capture_output=True).returncode == 0
    except OSError:
        return False


needs_compiler = pytest.mark.skipif(not compiles(), reason="there is no C compiler")
needs_library = pytest.mark.skipif(level() is None, reason="the kernels are not compiled")


@pytest.fixture(params=LEVELS)
def kind(request: pytest.FixtureRequest) -> str:
    """A kind of processor that this one is."""
    name: str = request.param
    if level() is None:
        pytest.skip("the kernels are not compiled")
    if name not in ("base", level()):
        pytest.skip(f"this processor is not of level {name}")
    return name


def model_of(spec: Spec, refinement: int = 1, with_rim: bool = True, uneven: bool = False) -> CellModel:
    """The published motor's, with two kinds of iron and a current."""
    section = cross_section(spec.actuator, spec.actuator.mid_stroke, spec.materials, 293.15)
    grid = mapped_mesh(section, tubular.R_CELLS, tubular.Z_CELLS, refinement, open_rim=with_rim, order=tubular.ORDER)
    materials = [magnetic_material(region) for region in section.regions]
    if uneven:
        materials[0] = replace(materials[0], reluctivity=(1e6, 3e6))
    rim: Rim | None = open_rim(grid, section.ends) if with_rim else None
    coils = tuple(
        replace(circuit, current=k - 1.5) for k, circuit in enumerate(tubular.Windows(grid, section.coils).circuits())
    )
    return cell_model(Problem(grid.mesh, tuple(materials), coils), grid, rim)


@pytest.fixture(params=["as it is", "refined", "closed", "with a direction"])
def model(request: pytest.FixtureRequest, spec: Spec) -> CellModel:
    what = request.param
    return model_of(spec, 2 if what == "refined" else 1, what != "closed", what == "with a direction")


def compiled(model: CellModel, kind: str) -> CellNative:
    found = functions(kind)
    assert found is not None
    return CellNative(model, found)


def field(model: CellModel, largest: float = 2.4) -> np.ndarray:
    """(n,) with |B| from zero to beyond saturation."""
    nodes = model.cells.grid.mesh.nodes
    shape = nodes[:, 0] * (np.sin(90 * nodes[:, 1]) + 0.3 * np.cos(2e4 * nodes[:, 0]))
    b_z, b_r = model.cells.fields(shape)
    return np.where(model.free, largest * shape / np.hypot(b_z, b_r)[model.iron].max(), 0.0)


def test_compiled_and_arrays_say_the_same(model: CellModel, kind: str) -> None:
    """Catches a term, a cell or an interval of a curve that only one of them knows: residual, tensor and product."""
    one, other, psi = compiled(model, kind), CellArrays(model), field(model)
    (forces, tensor), (expected, expected_tensor) = one.residual(psi), other.residual(psi)
    assert forces == pytest.approx(expected, rel=1e-10, abs=1e-11 * np.abs(expected).max())
    assert tensor == pytest.approx(expected_tensor, rel=1e-9, abs=1e-11 * np.abs(expected_tensor).max())
    columns = np.random.default_rng(1).normal(size=(psi.size, 2)) * model.free[:, None]
    images, expected = one.product(expected_tensor, columns), other.product(expected_tensor, columns)
    assert images == pytest.approx(expected, rel=1e-10, abs=1e-11 * np.abs(expected).max())


def test_sweeps_with_compiled_factors_gain_digits(model: CellModel, kind: str) -> None:
    """Catches an entry that lands in another's place, or a tile left out: refinement then gains nothing, while single
    precision gains a digit or more at each sweep. Several right sides at once, each of its own size."""
    one, other = compiled(model, kind), CellArrays(model)
    _, tensor = other.residual(field(model))
    x = field(model)[:, None] * np.random.default_rng(3).uniform(0.5, 1.5, (model.load.size, 3)) * (1.0, 1e-6, 1e9)
    right = other.product(tensor, x)
    factor = one.factor(tensor, np.float32, one.linear(np.float32))
    refined = Refined(lambda columns: other.product(tensor, columns), factor, exact=never)
    found = refined.within(right, 1e-10)
    assert not found[~model.free].any()
    rest = right - other.product(tensor, found)
    assert np.all(np.linalg.norm(rest, axis=0) <= ROUNDING * np.linalg.norm(right, axis=0))
    assert np.all(np.abs(found - x).max(axis=0) < 1e-4 * np.abs(x).max(axis=0))
    assert factor.solve(right[:, 1]) == pytest.approx(
        factor.solve(right)[:, 1], rel=1e-4, abs=1e-9 * abs(x[:, 1]).max()
    )


def never() -> Factor:
    raise AssertionError("single precision was not enough")


def test_what_is_not_definite_is_told(spec: Spec, kind: str) -> None:
    """Catches a square root of what is negative, and a pivot of zero or no number, passed on as a factor."""
    model = model_of(spec)
    one = compiled(model, kind)
    _, tensor = one.residual(field(model))
    linear = one.linear(np.float32)
    for wrong in (-tensor, 0 * tensor, np.nan * tensor):
        with pytest.raises(SingularMatrixError):
            one.factor(wrong, np.float32, linear)
    # Every cell is definite, the whole is not: the rim takes out more than there is.
    assert model.rim is not None
    for share in (-100.0, np.nan):
        drawn = compiled(replace(model, rim=Rim(model.rim.nodes, share * model.rim.matrices)), kind)
        with pytest.raises(SingularMatrixError):
            drawn.factor(tensor, np.float32, drawn.linear(np.float32))
    air = replace(model.problem.materials[0], reluctivity=(np.nan, np.nan))
    without = cell_model(replace(model.problem, materials=(air, *model.problem.materials[1:])), model.cells.grid, None)
    with pytest.raises(SingularMatrixError):
        compiled(without, kind).linear(np.float32)


def test_no_number_gives_no_number(spec: Spec, kind: str) -> None:
    """Catches a field made of nothing: a right side that is no number somewhere has a solution nowhere."""
    model = model_of(spec)
    one = compiled(model, kind)
    _, tensor = one.residual(field(model))
    right = model.load.copy()
    right[model.where.kept[100]] = np.nan
    found = one.factor(tensor, np.float32, one.linear(np.float32)).solve(right)
    assert np.all(np.isnan(found[model.free]))
    forces, _ = one.residual(np.full(model.load.size, np.nan))
    assert np.all(np.isnan(forces[model.free]))


def test_a_mesh_without_iron(mid_stroke: TubularSolution, kind: str) -> None:
    """Catches kernels that take it for granted: empty curves, an empty tensor."""
    problem = mid_stroke.solution.problem
    air = replace(problem, materials=tuple(replace(item, curve=None) for item in problem.materials))
    model = cell_model(air, mid_stroke.grid, None)
    one, other = compiled(model, kind), CellArrays(model)
    psi = mid_stroke.solution.psi
    forces, tensor = one.residual(psi)
    assert tensor.shape == (3, 0, 25)
    expected, _ = other.residual(psi)
    assert forces == pytest.approx(expected, rel=1e-10, abs=1e-11 * np.abs(expected).max())
    exact = other.factor(tensor, np.float64, other.linear(np.float64)).solve(model.load)
    found = one.factor(tensor, np.float32, one.linear(np.float32)).solve(model.load)
    assert found == pytest.approx(exact, abs=1e-2 * np.abs(exact).max())


def test_arrays_of_another_size_are_refused(spec: Spec, kind: str) -> None:
    """Catches memory that is not ours read or written: C knows no sizes but the mesh's."""
    model = model_of(spec)
    one = compiled(model, kind)
    psi = field(model)
    _, tensor = one.residual(psi)
    factor = one.factor(tensor, np.float32, one.linear(np.float32))
    for wrong in (
        lambda: one.residual(psi[:-1]),
        lambda: one.product(tensor, psi[:-1, None]),
        lambda: one.product(tensor[:, :-1], psi[:, None]),
        lambda: one.factor(tensor[:2], np.float32, one.linear(np.float32)),
        lambda: factor.solve(np.append(psi, 0.0)),
    ):
        with pytest.raises(ValueError, match="shape"):
            wrong()
    # Of another kind or order they are read as what they say.
    columns = np.asfortranarray(np.round(psi[:, None] * 1e9).astype(np.float32))
    assert one.product(tensor, columns) == pytest.approx(one.product(tensor, columns.astype(float)))


@needs_library
def test_a_design_without_the_library(spec: Spec, monkeypatch: pytest.MonkeyPatch) -> None:
    """Catches a machine without a compiler that gets other figures, or none; and kernels that nobody calls."""
    calls: list[int] = []
    solve = CellNative.solved
    monkeypatch.setattr(CellNative, "solved", lambda *arguments: calls.append(1) or solve(*arguments))
    with_it = evaluate(spec)
    assert calls
    monkeypatch.setattr(cell_system, "functions", lambda: None)
    calls.clear()
    without = evaluate(spec)
    assert not calls
    assert with_it.performance is not None
    for name, value in asdict(with_it.performance).items():
        if isinstance(value, float):
            assert getattr(without.performance, name) == pytest.approx(value, rel=1e-8, abs=1e-10), name


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A copy of the sources, with nothing made of them."""
    for name in SOURCES:
        shutil.copy(FOLDER / name, tmp_path / name)
    return tmp_path


@needs_compiler
def test_the_library_is_there() -> None:
    """Catches an installation whose kernels were not compiled although they could be: everything would work, slowly."""
    assert level() is not None


@needs_compiler
def test_a_library_of_other_sources_is_not_taken(folder: Path) -> None:
    """Catches figures of yesterday's C: a changed source asks for a library of its own, and the old one goes. Another
    machine's, in a folder that both share, stays."""
    others = folder / "kernels-pdp11-00000000.so"
    others.touch()
    first = build(folder)
    assert first == library(folder)
    assert build(folder) == first
    (folder / "band.c").write_text((folder / "band.c").read_text() + "\n")
    assert library(folder) != first
    second = build(folder)
    assert second is not None
    assert sorted(path.name for path in folder.iterdir()) == sorted([*SOURCES, second.name, others.name])


@needs_compiler
def test_a_library_that_does_not_load_is_made_anew(folder: Path) -> None:
    """Catches a damaged file that counts as compiled for ever."""
    library(folder).write_bytes(b"no library")
    made = build(folder)
    assert made is not None
    assert made.stat().st_size > 1000


@needs_compiler
@pytest.mark.parametrize(
    "source", ["int nothing;", "int size_of_mesh(void) { return 8; } int size_of_parts(void) { return 24; }"]
)
def test_a_library_of_another_kind_is_not_used(source: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Catches memory written by another version's structures, or a traceback for what the library does not have."""
    made = tmp_path / "other.so"
    command = [*(compiler() or []), "-shared", "-fPIC", "-x", "c", "-", "-o", str(made)]
    subprocess.run(command, input=source, text=True, check=True)
    monkeypatch.setattr(native, "library", lambda: made)
    loaded = native._loaded.__wrapped__()
    assert loaded is None


def test_without_a_compiler_a_sentence_is_said(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    """Catches an installation that fails where the kernels cannot be compiled, or leaves half a library."""
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setenv("PATH", str(folder))
    assert build(folder) is None
    assert "no C compiler" in capfd.readouterr().err
    for broken in ("/bin/false", "no-such-compiler -O1", 'cc "'):
        monkeypatch.setenv("CC", broken)
        assert build(folder) is None
        assert "could not be compiled" in capfd.readouterr().err
    assert sorted(path.name for path in folder.iterdir()) == sorted(SOURCES)


@needs_compiler
def test_a_folder_that_cannot_be_written_is_no_error(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    """Catches an installation from a read-only checkout that fails for what it can do without."""

    def refused(*paths: Path) -> None:
        raise PermissionError("read-only")

    monkeypatch.setattr(shutil, "copy", refused)
    assert build(folder) is None
    assert "read-only" in capfd.readouterr().err
