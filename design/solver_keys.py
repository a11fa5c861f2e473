"""The keys of the finite elements' solver that every kind with a nonlinear field has."""

from __future__ import annotations

from fluxbore.design.keys import Key


def solver_keys(place: str) -> tuple[Key, ...]:
    """Mesh, tolerance and steps; place : what each field is solved at, "position" or "displacement"."""
    return (
        Key(
            "solver.mesh_refinement",
            "finite-element mesh: 1 is the default mesh, 2 halves every element, 3 thirds it",
            kind="integer",
            minimum=1,
            maximum=6,
            default=1,
        ),
        Key(
            "solver.tolerance",
            "relative residual at which Newton's iteration stops",
            kind="number",
            above=0.0,
            maximum=1e-2,
            default=1e-8,
        ),
        Key(
            "solver.max_iterations",
            f"most Newton steps per {place}",
            kind="integer",
            minimum=1,
            maximum=500,
            default=60,
        ),
    )
