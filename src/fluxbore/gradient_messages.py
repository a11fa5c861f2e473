"""What the command line says of derivatives: a line for every figure and variable, in the units people think in."""

from __future__ import annotations

from fluxbore.design.performance import show_figure
from fluxbore.design.rates import show_rate
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import Evaluation


def gradient_text(spec: Spec, evaluation: Evaluation) -> str:
    """What one unit more of each key does to each figure, the others staying as they are."""
    lines = ["What one unit more of a variable changes, all others and the held keys staying as they are:"]
    norms, unmoved = evaluation.norms or {}, []
    for figure, slopes in (evaluation.gradient or {}).items():
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
    return "\n".join(lines)
