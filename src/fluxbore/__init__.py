"""Design tubular linear actuators: specification, magnetic field, optimisation, solid model and report.

The same words as on the command line, with typed results::

    import fluxbore

    spec = fluxbore.load("examples/ipehla.toml")
    print(fluxbore.evaluate(spec).performance.force_constant)
    fluxbore.design(spec, "out")
    print(fluxbore.solve("model.fem", groups=[1]).force(1).value.force)

Every function takes a `Spec` or the path of a specification file, `solve` that of a FEMM file; all work in SI units and
raise `FluxboreError` with one sentence for whatever a person can mend.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

__all__ = [
    "BenchmarkResult",
    "ComparisonResult",
    "Evaluation",
    "FemmSolution",
    "FluxboreError",
    "Identification",
    "ParetoResult",
    "Performance",
    "RobustResult",
    "SearchResult",
    "Snapped",
    "Spec",
    "SweepResult",
    "ToleranceResult",
    "compare",
    "design",
    "evaluate",
    "export",
    "identify",
    "load",
    "optimize",
    "pareto",
    "report",
    "robust",
    "simulate",
    "snap",
    "solve",
    "sweep",
    "tolerance",
]

if TYPE_CHECKING:
    from fluxbore.api import (
        compare,
        design,
        evaluate,
        export,
        identify,
        load,
        optimize,
        pareto,
        report,
        robust,
        simulate,
        sweep,
        tolerance,
    )
    from fluxbore.comparing import ComparisonResult
    from fluxbore.design.errors import FluxboreError
    from fluxbore.design.performance import Performance
    from fluxbore.design.spec import Spec
    from fluxbore.fem.femm_solution import FemmSolution
    from fluxbore.identifying import Identification
    from fluxbore.optimize.benchmark import BenchmarkResult
    from fluxbore.optimize.evaluation import Evaluation
    from fluxbore.optimize.outcome import SearchResult, SweepResult
    from fluxbore.optimize.pareto_result import ParetoResult
    from fluxbore.optimize.tolerance_result import RobustResult, ToleranceResult
    from fluxbore.snapping import Snapped, snap
    from fluxbore.solving import solve

_HOMES = {
    "BenchmarkResult": "fluxbore.optimize.benchmark",
    "ComparisonResult": "fluxbore.comparing",
    "FluxboreError": "fluxbore.design.errors",
    "Performance": "fluxbore.design.performance",
    "Spec": "fluxbore.design.spec",
    "FemmSolution": "fluxbore.fem.femm_solution",
    "Identification": "fluxbore.identifying",
    "Evaluation": "fluxbore.optimize.evaluation",
    "SearchResult": "fluxbore.optimize.outcome",
    "SweepResult": "fluxbore.optimize.outcome",
    "ParetoResult": "fluxbore.optimize.pareto_result",
    "ToleranceResult": "fluxbore.optimize.tolerance_result",
    "RobustResult": "fluxbore.optimize.tolerance_result",
    "Snapped": "fluxbore.snapping",
    "snap": "fluxbore.snapping",
    "solve": "fluxbore.solving",
}


class _Verb(ModuleType):
    """A room that is called like the function of its name: ``fluxbore.optimize(spec)``."""

    def __call__(self, *arguments: Any, **options: Any) -> Any:
        verb = self.__name__.rpartition(".")[2]
        return getattr(import_module("fluxbore.api"), verb)(*arguments, **options)


# ``design`` and ``optimize`` are verbs of the interface and rooms of the package. Importing a room binds its module to
# that name, whatever stood there, so the modules themselves are made callable. Both are empty but for a docstring.
for _room in ("design", "optimize"):
    import_module(f"fluxbore.{_room}")
    sys.modules[f"fluxbore.{_room}"].__class__ = _Verb


def __getattr__(name: str) -> Any:
    """Import on first use, so that ``import fluxbore`` and ``fluxbore --help`` load nothing heavy."""
    if name not in __all__:
        raise AttributeError(f"module 'fluxbore' has no attribute {name!r}")
    return getattr(import_module(_HOMES.get(name, "fluxbore.api")), name)
