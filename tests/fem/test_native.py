"""The compiled kernels: the same equations as numpy's arrays, on every kind of processor; how they are compiled."""

from __future__ import annotations

import shutil
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest

from fluxbore.design.spec import Spec
from fluxbore.fem import cell_system, tubular
from fluxbore.fem.asymptotic import Rim, open_rim
from fluxbore.fem.cell_arrays import CellArrays
from fluxbore.fem.cell_model import CellModel, cell_model
from fluxbore.fem.cell_native import CellNative
from fluxbore.fem.factors import SingularMatrixError
from fluxbore.fem.kernels.build import FOLDER, LEVELS, SOURCES, build, compiler, library
from fluxbore.fem.mapped import mapped_mesh
from fluxbore.fem.native import kernels
from fluxbore.fem.problem import Problem
from fluxbore.fem.tubular import TubularSolution, magnetic_material
from fluxbore.geometry.hybrid import cross_section
from fluxbore.optimize.evaluate import evaluate

needs_compiler = pytest.mark.skipif(compiler() is None, reason="there is no C compiler")


@pytest.fixture(params=LEVELS)
def level(request: pytest.FixtureRequest) -> str:
    """A kind of processor that this one is."""
    if kernels() is None:
        pytest.skip("the kernels are not compiled")
    name: str = request.param
    own, found = kernels(), kernels(name)
    assert own is not None
    assert found is not None
    if name != "base" and own["solve"].__name__ != found["solve"].__name__:
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
    kind = request.param
    return model_of(spec, 2 if kind == "refined" else 1, kind != "closed", kind == "with a direction")


def compiled(model: CellModel, level: str) -> CellNative:
    found = kernels(level)
    assert found is not None
    return CellNative(model, found)


def field(model: CellModel, largest: float = 2.4) -> np.ndarray:
    """(n,) with |B| from zero to beyond saturation."""
    nodes = model.cells.grid.mesh.nodes
    shape = nodes[:, 0] * (np.sin(90 * nodes[:, 1]) + 0.3 * np.cos(2e4 * nodes[:, 0]))
    b_z, b_r = model.cells.fields(shape)
    return np.where(model.free, largest * shape / np.hypot(b_z, b_r)[model.iron].max(), 0.0)


def test_compiled_and_arrays_say_the_same(model: CellModel, level: str) -> None:
    """Catches a term, a cell or an interval of a curve that only one of them knows: residual, tensor and product."""
    one, other, psi = compiled(model, level), CellArrays(model), field(model)
    (forces, tensor), (expected, expected_tensor) = one.residual(psi), other.residual(psi)
    assert forces == pytest.approx(expected, rel=1e-10, abs=1e-11 * np.abs(expected).max())
    assert tensor == pytest.approx(expected_tensor, rel=1e-9, abs=1e-11 * np.abs(expected_tensor).max())
    columns = np.random.default_rng(1).normal(size=(psi.size, 2)) * model.free[:, None]
    images, expected = one.product(expected_tensor, columns), other.product(expected_tensor, columns)
    assert images == pytest.approx(expected, rel=1e-10, abs=1e-11 * np.abs(expected).max())


def test_compiled_factors_are_as_good_as_single_precision_is(model: CellModel, level: str) -> None:
    """Catches an entry that lands in another's place, or a tile left out: A⁻¹ A x = x, and next to LAPACK's error."""
    one, other = compiled(model, level), CellArrays(model)
    _, tensor = other.residual(field(model))
    x = field(model) * np.random.default_rng(3).uniform(0.5, 1.5, model.load.size)
    right = other.product(tensor, x[:, None])[:, 0]
    errors = []
    for kind in (one, other):
        found = kind.factor(tensor, np.float32, kind.linear(np.float32)).solve(right)
        assert not found[~model.free].any()
        errors.append(np.abs(found - x).max() / np.abs(x).max())
    assert errors[0] < 1e-2
    assert errors[0] < 3 * errors[1]


def test_what_is_not_definite_is_told(spec: Spec, level: str) -> None:
    """Catches a square root of what is negative, and a cell's pivot of zero, passed on as a factor."""
    model = model_of(spec)
    one = compiled(model, level)
    _, tensor = one.residual(field(model))
    with pytest.raises(SingularMatrixError):
        one.factor(-tensor, np.float32, one.linear(np.float32))
    with pytest.raises(SingularMatrixError):
        one.factor(np.nan * tensor, np.float32, one.linear(np.float32))
    # Every cell is definite, the whole is not: the rim takes out more than there is.
    assert model.rim is not None
    drawn = compiled(replace(model, rim=Rim(model.rim.nodes, -100 * model.rim.matrices)), level)
    with pytest.raises(SingularMatrixError):
        drawn.factor(tensor, np.float32, drawn.linear(np.float32))


def test_nothing_is_read_where_there_is_no_iron(mid_stroke: TubularSolution, level: str) -> None:
    """Catches kernels that take it for granted: empty curves, an empty tensor."""
    problem = mid_stroke.solution.problem
    air = replace(problem, materials=tuple(replace(item, curve=None) for item in problem.materials))
    model = cell_model(air, mid_stroke.grid, None)
    one, other = compiled(model, level), CellArrays(model)
    psi = mid_stroke.solution.psi
    forces, tensor = one.residual(psi)
    assert tensor.shape == (3, 0, 25)
    expected, _ = other.residual(psi)
    assert forces == pytest.approx(expected, rel=1e-10, abs=1e-11 * np.abs(expected).max())
    factor = one.factor(tensor, np.float32, one.linear(np.float32))
    assert np.all(np.isfinite(factor.solve(model.load)))


def test_a_design_without_the_library(spec: Spec, monkeypatch: pytest.MonkeyPatch) -> None:
    """Catches a machine without a compiler that gets other figures, or none; and kernels that nobody calls."""
    if kernels() is None:
        pytest.skip("the kernels are not compiled")
    calls: list[int] = []
    solve = CellNative.solved
    monkeypatch.setattr(CellNative, "solved", lambda *arguments: calls.append(1) or solve(*arguments))
    with_it = evaluate(spec)
    assert calls
    monkeypatch.setattr(cell_system, "kernels", lambda: None)
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
    assert kernels() is not None


@needs_compiler
def test_a_library_of_other_sources_is_not_taken(folder: Path) -> None:
    """Catches figures of yesterday's C: a changed source asks for a library of its own, and the old one goes."""
    first = build(folder)
    assert first == library(folder)
    assert build(folder) == first
    (folder / "band.c").write_text((folder / "band.c").read_text() + "\n")
    assert library(folder) != first
    second = build(folder)
    assert second is not None
    assert sorted(folder.glob("*.so")) == [second]


def test_without_a_compiler_a_sentence_is_said(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    """Catches an installation that fails where the kernels cannot be compiled, or leaves half a library."""
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setenv("PATH", str(folder))
    assert build(folder) is None
    assert "no C compiler" in capfd.readouterr().err
    for broken in ("/bin/false", "no-such-compiler -O1"):
        monkeypatch.setenv("CC", broken)
        assert build(folder) is None
        assert "could not be compiled" in capfd.readouterr().err
    assert sorted(path.name for path in folder.iterdir()) == sorted(SOURCES)
