"""What the curves of a report share: their size, the titles of axes, legends, marks of what has no result."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from fluxbore.reports.svg import BAD
from fluxbore.reports.wording import Scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDTH, HEIGHT = 500.0, 320.0
"""Of an ordinary figure, which stands two abreast on a desk and alone on a telephone."""


def shown(value: float | None, scale: Scale) -> float:
    """The number in the axis's unit; matplotlib leaves a gap where it is not a number."""
    return math.nan if value is None else scale.shown(value)


def axis_title(label: str, unit: str) -> str:
    return f"{label} ({unit})" if unit else label


def legend_above(plot: Axes, columns: int) -> None:
    """A legend above the axes: it never covers a point, whatever the data."""
    plot.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=columns, borderaxespad=0.2, handlelength=1.6)


def crosses(plot: Axes, places: Sequence[float], label: str) -> None:
    """Designs without a result, as crosses along the foot of the axes."""
    foot = plot.get_xaxis_transform()
    plot.plot(places, [0.02] * len(places), "x", color=BAD, transform=foot, clip_on=False, label=label)
