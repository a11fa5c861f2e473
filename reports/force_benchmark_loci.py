"""Where the poles of the force control go with the environment and with the spring: the loci of Figs. 23 and 24."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.force_parameters import ForceParameters
from fluxbore.design.dynamics.force_poles import (
    LARGEST_K_E,
    LARGEST_K_L,
    locus_over_load,
    locus_over_spring,
    nominal_loop,
    pole_set,
)
from fluxbore.design.dynamics.linearised import FILTERED, OBSERVER_SPEEDS, UNFILTERED, ForceLoop
from fluxbore.reports.svg import CHOSEN, INK, PUBLISHED, Drawing, drawing, new_figure, style
from fluxbore.reports.wording import plain, significant

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

WIDE = 1000.0

COLOURS = {UNFILTERED: CHOSEN, FILTERED: PUBLISHED}

WIDTHS = {UNFILTERED: 2.4, FILTERED: 1.2}
"""The published loop is drawn broad, and the other one thin upon it: in places they run together."""

LABELS = {
    UNFILTERED: "observer reads the unfiltered speed, as published",
    FILTERED: "observer reads the filtered speed, which can be built",
}

POINTS = 400
"""Along a locus."""

CROWDED = 3
"""Power by which the points crowd where the parameter is small: the slow pole does most of its way there."""


@dataclass(frozen=True, slots=True)
class Axis:
    """A coefficient along which the poles are followed.

    name : of `ForceLoop`. words : what it is. largest : where the locus ends (N/m). figure : the paper’s. locus : of
    parameters, values (n,) (N/m) and the observer's speed, the poles (n, 6) (1/s), a branch in each column.
    """

    name: str
    words: str
    largest: float
    figure: str
    locus: Callable[[ForceParameters, Floats, str], Complex]

    def values(self) -> Floats:
        """(points,) N/m, from nearly zero to the largest."""
        return np.asarray(self.largest * np.linspace(0.0, 1.0, POINTS + 1)[1:] ** CROWDED)

    def branches(self, parameters: ForceParameters, observer_speed: str) -> Complex:
        """(points, 6) poles along the values."""
        return self.locus(parameters, self.values(), observer_speed)

    def poles(self, loop: ForceLoop, value: float, observer_speed: str) -> Complex:
        """The six of a loop with this value (N/m) of the coefficient, the slowest first."""
        return pole_set(loop.with_values({self.name: value}), observer_speed)


LOAD = Axis("K_e", "stiffness of the load", LARGEST_K_E, "Fig. 23", locus_over_load)
SPRING = Axis("K_l", "slope of the spring", LARGEST_K_L, "Fig. 24", locus_over_spring)


def over_load(parameters: ForceParameters) -> Drawing:
    """Fig. 23: at no force, with the benchmark's own load and stiffnesses around it marked."""
    own = parameters.load_stiffness
    marked = {stiffness_text(own): own, **{stiffness_text(k * own): k * own for k in (0.5, 1.5)}}
    return loci_figure(parameters, LOAD, marked)


def over_spring(parameters: ForceParameters) -> Drawing:
    """Fig. 24: the spring's slope at no force, at the references of the steps, and far steeper ones."""
    marked = {"no force": nominal_loop(parameters).K_l}
    marked |= {f"{force:g}\u00a0N": nominal_loop(parameters, force).K_l for force in parameters.references}
    steep = 5 * marked["no force"]
    return loci_figure(parameters, SPRING, {**marked, stiffness_text(steep): steep})


def loci_figure(parameters: ForceParameters, axis: Axis, marked: Mapping[str, float]) -> Drawing:
    """All poles, the ringing ones by the imaginary axis, and the slow one on the real axis by zero.

    marked : values of the parameter (N/m) whose slow pole is named, by that name; the first is the design's.
    """
    loop, design = nominal_loop(parameters), next(iter(marked.values()))
    branches = {speed: axis.branches(parameters, speed) for speed in OBSERVER_SPEEDS}
    here = {speed: axis.poles(loop, design, speed) for speed in OBSERVER_SPEEDS}
    with style():
        canvas = new_figure(WIDE, 520.0)
        plots = canvas.subplot_mosaic(
            [["whole", "ringing"], ["slow", "slow"]], height_ratios=(5, 1), gridspec_kw={"wspace": 0.05}
        )
        whole, ringing, slow = plots["whole"], plots["ringing"], plots["slow"]
        for plot in (whole, ringing):
            for speed in OBSERVER_SPEEDS:
                _draw(plot, branches[speed], here[speed], speed)
        _by_the_imaginary_axis(ringing, branches)
        _by_zero(slow, loop, axis, marked, branches)
        for plot, title in (
            (whole, "all poles"),
            (ringing, "ringing, by the imaginary axis"),
            (slow, "slow pole, on the real axis"),
        ):
            plot.set_title(title, loc="left")
            plot.axvline(0.0, color=INK, lw=0.8)
            plot.set_xlabel("real part (1/s)")
        whole.set_ylabel("imaginary part (rad/s)")
        canvas.legend(handles=_handles(), loc="outside upper left", ncols=2)
        ends = "; ".join(f"{LABELS[speed]}: {rightmost(branches[speed])} 1/s at its end" for speed in OBSERVER_SPEEDS)
        alt = f"Poles of the force control along the {axis.words}. Largest real part of the ringing pair, {ends}."
        caption = (
            f"Poles of the linearised force control along the {axis.words}, from 0 to "
            f"{stiffness_text(axis.largest)}, as in {axis.figure}: crosses where it is 0, rings at its end, "
            f"diamonds at the design’s {stiffness_text(design)}. Below, the slow pole on the real axis."
        )
        return drawing(canvas, f"force-loci-{axis.name.lower().replace('_', '-')}", alt, caption, wide=True)


def onset(parameters: ForceParameters, observer_speed: str) -> float | None:
    """The stiffness (N/m) of the load at which the loop becomes unstable on the way of `LOAD`; None where it does not.

    On the line between two points of the locus, which lie within 3 % of one another there.
    """
    values = LOAD.values()
    real = np.max(LOAD.branches(parameters, observer_speed).real, axis=1)
    after = int(np.argmax(real > 0))
    if real[after] <= 0:
        return None
    if after == 0:
        return float(values[0])
    share = real[after - 1] / (real[after - 1] - real[after])
    return float(values[after - 1] + share * (values[after] - values[after - 1]))


def rightmost(branches: Complex) -> str:
    """The largest real part at a locus's end of the poles that ring, of all where none does."""
    last = _ringing(branches)[-1]
    return plain(float(np.max((last if len(last) else branches[-1]).real)), 2)


def stiffness_text(value: float) -> str:
    """``2.25 kN/m`` and ``10 000 kN/m``, of N/m."""
    size = value / 1e3
    return f"{significant(size) if size < 1e3 else f'{size:,.0f}'.replace(',', chr(0x202F))}\u00a0kN/m"


def _ringing(branches: Complex) -> Complex:
    """(points, n) the branches that end above the real axis."""
    return branches[:, branches[-1].imag > 1e-6 * np.max(np.abs(branches[-1]))]


def _draw(plot: Axes, branches: Complex, here: Complex, observer_speed: str) -> None:
    colour = COLOURS[observer_speed]
    for branch in branches.T:
        plot.plot(branch.real, branch.imag, color=colour, lw=WIDTHS[observer_speed])
    plot.plot(branches[0].real, branches[0].imag, "x", color=colour, ms=6)
    plot.plot(branches[-1].real, branches[-1].imag, "o", color=colour, ms=5, mfc="none", mew=1.4)
    plot.plot(here.real, here.imag, "D", color=colour, ms=5, mec="none")


def _by_the_imaginary_axis(plot: Axes, branches: Mapping[str, Complex]) -> None:
    """As near as the rightmost pairs at the end of their loci lie."""
    ends = {speed: _ringing(found)[-1] for speed, found in branches.items()}
    last = {speed: max(end, key=lambda pole: pole.real) for speed, end in ends.items() if len(end)}
    reach = max((abs(pole.real) for pole in last.values()), default=0.0)
    if not reach:
        return
    plot.set_xlim(-8 * reach, 3.5 * reach)
    plot.set_ylim(0.0, 1.12 * max(pole.imag for pole in last.values()))
    for speed, pole in last.items():
        right = speed == FILTERED
        sign = "+" if pole.real > 0 else ""
        plot.annotate(
            f"{sign}{plain(pole.real, 2)}",
            (pole.real, pole.imag),
            xytext=(6 if right else -6, 6),
            textcoords="offset points",
            ha="left" if right else "right",
            color=COLOURS[speed],
            fontsize=11.0,
        )


def _by_zero(
    plot: Axes, loop: ForceLoop, axis: Axis, marked: Mapping[str, float], branches: Mapping[str, Complex]
) -> None:
    """The slow pole on the real axis, with the parameter's values beside it."""
    found = {name: float(axis.poles(loop, value, UNFILTERED)[0].real) for name, value in marked.items()}
    for speed in OBSERVER_SPEEDS:
        for branch in branches[speed].T:
            plot.plot(branch.real, branch.imag, color=COLOURS[speed], lw=WIDTHS[speed])
    far = min(found.values())
    plot.set_xlim(1.35 * far, -0.25 * far)
    plot.set_ylim(-1.0, 1.0)
    plot.set_yticks([])
    plot.spines["left"].set_visible(False)
    for number, (name, place) in enumerate(found.items()):
        up = number % 2 == 0
        plot.plot(place, 0.0, "D" if number == 0 else "|", color=COLOURS[UNFILTERED], ms=6 if number == 0 else 12)
        plot.annotate(
            name,
            (place, 0.0),
            xytext=(0, 7 if up else -7),
            textcoords="offset points",
            ha="center",
            va="bottom" if up else "top",
            fontsize=10.5,
        )


def _handles() -> Sequence[object]:
    from matplotlib.lines import Line2D

    return [Line2D([], [], color=COLOURS[speed], lw=WIDTHS[speed], label=LABELS[speed]) for speed in OBSERVER_SPEEDS]
