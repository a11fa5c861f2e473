"""The last steps of a search: quadratic models of what was seen around the incumbent, and their optimum, evaluated.

COBYLA closes in on an optimum with linear models, from either side of a limit and at a linear rate. The designs it has
asked for determine quadratic models almost for nothing; a few designs at the models' optimum (Powell's idea behind
BOBYQA, with the limits modelled as well) do what a dozen smaller simplices would.
"""

from __future__ import annotations

from collections.abc import Sequence

from fluxbore.optimize.archive import Archive
from fluxbore.optimize.models import Models, fit
from fluxbore.optimize.nlopt_loop import minimise
from fluxbore.optimize.outcome import Limit
from fluxbore.optimize.problem import Merit, Point

STEPS = 4
"""Designs that polishing may ask for."""


def polish(archive: Archive, merit: Merit, held: Sequence[Limit], back_off: float, tolerance: float) -> None:
    """Ask for up to `STEPS` designs, each where quadratic models of the nearest designs have their optimum.

    held : the limits to model; back_off : the room to leave to them; tolerance : the least gain (relative loss) that is
    worth another design. Raises BudgetUsedError. What is found stands in the archive.
    """
    trust = 1.0
    for _ in range(STEPS):
        before = archive.best
        models = fit(archive, merit, held, share=2)
        found = _optimum(archive, models, len(held), back_off, trust) if models is not None else None
        if models is None or found is None or archive.knows(found[1]):
            return
        if before is not None and found[0] > models.loss - tolerance:
            return
        archive.at(found[1])
        if archive.best is before:
            trust /= 3  # the models promised too much that far out


def _optimum(
    archive: Archive, models: Models, constraints: int, back_off: float, trust: float
) -> tuple[float, Point] | None:
    """The models' least loss without a miss, within ``trust`` of their radius, and where it is."""
    reach = trust * models.radius
    low = [max(c - reach, 0.0) for c in models.centre]
    high = [min(c + reach, 1.0) for c in models.centre]
    best: list[tuple[float, Point]] = []

    def model(u: Point) -> tuple[float, tuple[float, ...]]:
        point = archive.box.tidy([a + x * (b - a) for x, a, b in zip(u, low, high, strict=True)])
        loss, *rest = (float(value) for value in models.predict([point])[0])
        misses = tuple(value + back_off for value in rest)
        if all(miss <= 0 for miss in misses) and (not best or loss < best[0][0]):
            best[:] = [(loss, point)]
        return loss, misses

    start = [(c - a) / ((b - a) or 1.0) for c, a, b in zip(models.centre, low, high, strict=True)]
    minimise(
        "COBYLA",
        model,
        constraints,
        archive.box.tidy(start),
        step=0.25,
        objective_tolerance=1e-12,
        variable_tolerance=1e-6,
        seed=1,
        calls=1000,
    )
    return best[0] if best else None
