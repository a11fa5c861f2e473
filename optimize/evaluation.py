"""The result of evaluating one design, and its plain form for the journal and for ``--json``."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any, Literal

from fluxbore.design.performance import Performance, from_mapping, to_mapping

Fidelity = Literal["network", "fem"]

OK = "ok"
"""The status of a design whose figures can be trusted."""

INVALID = "invalid"
"""The status of a design that cannot be built."""

NOT_CONVERGED = "not converged"
"""The status of a design whose field did not converge; its figures are not given."""

FAILED = "failed"
"""The status of a design at which the program itself failed (a crash, a time limit, no memory)."""


@dataclass(frozen=True, slots=True)
class PositionResult:
    """What the finite elements found at one position of the mover. SI units.

    thrust_constants : incremental thrust per ampere of each phase (N/A), stress-tensor route, phases U, V, W.
    flux_linkages : of each phase at no current (Wb).
    force_constant : 3/2 |K_alpha,beta| of the thrust constants (N/A).
    force_constant_linkage : 3/2 (pi/tau) |lambda_alpha,beta| of the flux linkages (N/A).
    """

    position: float
    thrust_constants: tuple[float, float, float]
    flux_linkages: tuple[float, float, float]
    force_constant: float
    force_constant_linkage: float
    cogging_force: float
    iterations: int
    residual: float


@dataclass(frozen=True, slots=True)
class Norm:
    """The smooth stand-in of a figure that is a maximum: (mean of x^p)^(1/p) over where the maximum is looked for.

    exponent : p. value : SI, below the maximum and near it.
    """

    exponent: float
    value: float


Gradient = Mapping[str, Mapping[str, float]]
"""Figure -> dotted key -> derivative (SI), the other variables and the held keys staying as they are."""


@dataclass(frozen=True, slots=True)
class Evaluation:
    """One design's figures by one route.

    status : `OK`, or why there are no figures; ``reasons`` are whole sentences.
    positions : the window's positions, empty for the network.
    details : further figures of the route by name (SI), such as the network's reluctances or the mesh's size.
    warnings : whole sentences on what a sound design's reader must know, such as a magnet that is too hot.
    gradient : of the figures that have one, by the keys that were asked for; None where none was asked for. Of a figure
    with a norm it is the norm's. norms : by figure.
    """

    fidelity: Fidelity
    status: str
    reasons: tuple[str, ...]
    performance: Performance
    positions: tuple[PositionResult, ...] = ()
    details: Mapping[str, float] | None = None
    warnings: tuple[str, ...] = ()
    gradient: Gradient | None = None
    norms: Mapping[str, Norm] | None = None

    @property
    def ok(self) -> bool:
        return self.status == OK


def failure(fidelity: Fidelity, status: str, reason: str) -> Evaluation:
    """An evaluation without figures."""
    return Evaluation(fidelity, status, (reason,), Performance())


def to_plain(evaluation: Evaluation) -> dict[str, Any]:
    """The evaluation as JSON-ready values: no NaN, None where a figure is not given."""
    return {
        "fidelity": evaluation.fidelity,
        "status": evaluation.status,
        "reasons": list(evaluation.reasons),
        "warnings": list(evaluation.warnings),
        "performance": {name: _finite(value) for name, value in to_mapping(evaluation.performance).items()},
        "positions": [asdict(position) for position in evaluation.positions],
        "details": {name: _finite(value) for name, value in (evaluation.details or {}).items()},
        "gradient": None
        if evaluation.gradient is None
        else {name: dict(slopes) for name, slopes in evaluation.gradient.items()},
        "norms": None if evaluation.norms is None else {name: asdict(norm) for name, norm in evaluation.norms.items()},
    }


def from_plain(plain: Mapping[str, Any]) -> Evaluation:
    """The inverse of `to_plain`, exact to the last bit."""
    positions = tuple(
        PositionResult(
            **{
                **item,
                "thrust_constants": tuple(item["thrust_constants"]),
                "flux_linkages": tuple(item["flux_linkages"]),
            }
        )
        for item in plain["positions"]
    )
    return Evaluation(
        plain["fidelity"],
        plain["status"],
        tuple(plain["reasons"]),
        from_mapping(plain["performance"]),
        positions,
        plain["details"],
        tuple(plain["warnings"]),
        plain["gradient"],
        None if plain["norms"] is None else {name: Norm(**norm) for name, norm in plain["norms"].items()},
    )


def _finite(value: float | None) -> float | None:
    return value if value is not None and math.isfinite(value) else None
