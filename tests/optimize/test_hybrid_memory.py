"""Memory of searches in one process: of a design that is done only its figures are left."""

import gc
import weakref

from short_motor import short_spec

from fluxbore.fem.cell_band import CellFactor
from fluxbore.optimize import hybrid_figures
from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.hybrid_field import Field, solve_field

KEYS = ("actuator.mover.ring_width", "actuator.back_yoke.thickness")


def test_fields_and_factors_do_not_outlive_their_evaluation(monkeypatch):
    """Catches reference cycles and caches that keep the field of every design that a search has seen."""
    alive: list[weakref.ref[object]] = []

    def noted_field(spec) -> Field:
        field = solve_field(spec)
        alive.extend(weakref.ref(item) for item in (*field.window, *field.peaks))
        return field

    monkeypatch.setattr(hybrid_figures, "solve_field", noted_field)
    monkeypatch.setattr(CellFactor, "__init__", lambda self: alive.append(weakref.ref(self)))
    spec = short_spec()
    gc.disable()
    try:
        found = evaluate(spec, "fem", KEYS)
        left = [kept for ref in alive if (kept := ref()) is not None]
    finally:
        gc.enable()
    assert found.gradient
    assert len(alive) > 2 * len(found.positions)
    assert left == []
