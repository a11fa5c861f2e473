"""What the command line says of derivatives: a line for every figure and variable, in the units people think in."""

from __future__ import annotations

from fluxbore.design.performance import FIGURES, show_figure
from fluxbore.design.rates import show_rate
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.noise import clear_slopes

COUNTED = ("demagnetised_fraction", "peak_demagnetised_fraction")
"""Figures that are shares of points: they jump from one to the next."""


def gradient_text(spec: Spec, evaluation: Evaluation) -> str:
    """What one unit more of each key does to each figure, the others staying as they are."""
    lines = ["What one unit more of a variable changes, all others and the held keys staying as they are:"]
    norms, unmoved = evaluation.norms or {}, []
    for figure, slopes in clear_slopes(spec, evaluation).items():
        if not any(slopes.values()):
            unmoved.append(figure)
            continue
        norm = norms.get(figure)
        smooth = ""
        if norm is not None:
            itself = show_figure(figure, getattr(evaluation.performance, figure))
            smooth = (
                f" (by its {norm.exponent:g}-norm, {show_figure(figure, norm.value)}; the figure itself is {itself})"
            )
        lines.append(f"{figure}{smooth}")
        width = max((len(key) for key in slopes), default=0)
        lines += [
            f"  {key:<{width}}  {show_rate(figure, spec.kind.known(key), slope)}" for key, slope in slopes.items()
        ]
    lines += [f"None of them moves {', '.join(unmoved)}."] if unmoved else []
    return "\n".join([*lines, *_without(evaluation)])


def _without(evaluation: Evaluation) -> list[str]:
    """The figures of which there is no derivative; those that count points say so."""
    given = (name for name in FIGURES if getattr(evaluation.performance, name) is not None)
    bare = [name for name in given if name not in (evaluation.gradient or {})]
    counted = [name for name in bare if name in COUNTED]
    others = [name for name in bare if name not in COUNTED]
    lines = [f"No derivatives, for they count points: {', '.join(counted)}."] if counted else []
    return lines + ([f"No derivatives: {', '.join(others)}."] if others else [])
