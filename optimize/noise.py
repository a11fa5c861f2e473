"""Rounding's noise: numbers that are zero but for the last bits of their computation."""

from __future__ import annotations

from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import Evaluation, Gradient

NOISE = 1e-9
"""Of a variable's range, or of a figure; what is smaller is zero that was computed."""


def clear_value(spec: Spec, key: str, value: float) -> float:
    """The variable's value (SI); zero where it is next to nothing of the variable's range: a bound of zero, say."""
    own = next((variable for variable in spec.study.variables if variable.key == key), None)
    return 0.0 if own is not None and abs(value) < NOISE * (own.upper - own.lower) else value


def clear_slopes(spec: Spec, evaluation: Evaluation) -> Gradient:
    """The evaluation's derivatives; zero where the variable's whole range would move the figure by next to nothing of
    its value. A key that is no variable of the study has its own size for a range."""
    spans = {variable.key: variable.upper - variable.lower for variable in spec.study.variables}

    def clear(figure: str, key: str, slope: float) -> float:
        span = spans[key] if key in spans else abs(spec.number(key))
        return 0.0 if abs(slope) * span < NOISE * abs(getattr(evaluation.performance, figure) or 0.0) else slope

    return {
        figure: {key: clear(figure, key, slope) for key, slope in slopes.items()}
        for figure, slopes in (evaluation.gradient or {}).items()
    }
