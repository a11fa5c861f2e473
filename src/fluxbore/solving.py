"""The Python interface to FEMM files: solve a model as it is, or with other values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite
from pathlib import Path

from fluxbore.design.errors import MeshError, SpecError, one_line, shown
from fluxbore.fem.factors import SingularMatrixError
from fluxbore.fem.femm_model import FemmModel
from fluxbore.fem.femm_reader import read_model
from fluxbore.fem.femm_solution import FemmSolution, solve_model
from fluxbore.fem.threads import one_thread

TIGHTEST_ACCURACY, LOOSEST_ACCURACY = 1e-6, 0.5


def solve(
    model: FemmModel | Path | str,
    *,
    groups: Sequence[int] = (),
    points: Sequence[tuple[float, float]] = (),
    accuracy: float | None = None,
    changes: Mapping[str, str | float] | None = None,
    open_boundary: bool = False,
    max_unknowns: int | None = None,
) -> FemmSolution:
    """Solve a FEMM magnetics file, refining until the estimated errors of its figures hold.

    model : a `.fem` file or what `read_model` made of it. groups : whose forces are asked for. points : in the file's
    unit, where the field is. accuracy : relative, 0.001 without it. max_unknowns : where refinement ends.
    changes : other values, as `--set` takes them; numbers are in the key's or the file's own unit. open_boundary : put
    all of space around the model in place of its outer boundary.

    Raises FluxboreError with one sentence for whatever is wrong with the file or the question.
    """
    check_accuracy(accuracy)
    places = _places(points)
    read = model if isinstance(model, FemmModel) else read_model(model)
    try:
        if changes:
            from fluxbore.fem.femm_edit import edit

            read = edit(
                read, {key: value if isinstance(value, str) else repr(float(value)) for key, value in changes.items()}
            )
        if open_boundary:
            from fluxbore.fem.femm_open import with_open_boundary

            read = with_open_boundary(read)
        with one_thread():
            open_plane = open_boundary and not read.axisymmetric
            return solve_model(read, groups, places, accuracy, max_unknowns, open_plane)
    except MeshError as error:
        raise MeshError(_sentence(read, str(error))) from error
    except SingularMatrixError as error:
        raise SpecError(_sentence(read, f"its equations could not be solved: {error}")) from error


def _sentence(model: FemmModel, words: str) -> str:
    """What cannot be meshed or solved, with the file's name: the mesh knows the drawing alone."""
    file = one_line(Path(model.path).name)
    return (f"{file}: {words}" if file else words[:1].upper() + words[1:]).removesuffix(".") + "."


def check_accuracy(accuracy: float | None) -> None:
    """Raises SpecError for one that is out of reach, or that is none."""
    if accuracy is not None and not TIGHTEST_ACCURACY <= accuracy <= LOOSEST_ACCURACY:
        raise SpecError(
            f"--accuracy must be from {TIGHTEST_ACCURACY * 100:g}% to {LOOSEST_ACCURACY * 100:g}%; "
            f"got {accuracy * 100:g}%."
        )


def _places(points: Sequence[Sequence[float]]) -> tuple[tuple[float, float], ...]:
    """Each place once."""
    for point in points:
        if len(point) != 2 or not all(isfinite(each) for each in point):
            raise SpecError(f"A point must be two finite numbers; got {shown(list(point))}.")
    return tuple(dict.fromkeys((float(x), float(y)) for x, y in points))
