"""The friction of the tracking benchmark on the page: curve, measurements and parameters (Fig. 3, Table I)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from fluxbore.design.cylinder_friction import CylinderFriction, cylinder_friction, least_friction
from fluxbore.design.dynamics.tracking_identification import friction_measurements
from fluxbore.design.dynamics.tracking_stand import TrackingStand
from fluxbore.design.tracking_benchmark_keys import EVEN
from fluxbore.optimize.hydrostatic_benchmark import TABLE_I
from fluxbore.reports.svg import CHOSEN, GOOD, INK, MUTED, OTHER, Drawing, drawing, new_figure, style
from fluxbore.reports.tables import Cell, Table
from fluxbore.reports.wording import DASH, plain, significant

WIDE = 1000.0

UNITS = {"force": "N", "inverse speed": "s/m", "viscous friction": "N s/m"}


def curve(law: CylinderFriction, stand: TrackingStand, seed: int, figures: Mapping[str, Any]) -> Drawing:
    """Friction over speed: the law without pressure and at the highest, the seed's points, and what they identify."""
    fine = np.geomspace(stand.slowest_speed / 10, stand.fastest_speed, 300)
    points = friction_measurements(law, stand, seed)
    with style():
        canvas = new_figure(WIDE, 400.0)
        whole, slow = canvas.subplots(1, 2, sharey=True, width_ratios=(1, 1))
        for plot in (whole, slow):
            plot.plot(fine, cylinder_friction(law, fine, 0.0), color=INK, lw=1.6, label="law, without pressure")
            plot.plot(
                fine,
                cylinder_friction(law, fine, stand.highest_pressure),
                color=INK,
                lw=1.2,
                ls=(0, (4, 3)),
                label=f"law, {stand.highest_pressure / 1e5:g} bar",
            )
            plot.plot(points.velocity, points.friction, "o", color=MUTED, ms=4.5, label=f"points of seed {seed}")
            for name, colour, label in (
                ("identified_friction", CHOSEN, "identified from these"),
                ("identified_friction_geometric", GOOD, "from geometric speeds"),
            ):
                if figures[name]:
                    found = replace(law, **{key: each["value"] for key, each in figures[name].items()})
                    plot.plot(fine, cylinder_friction(found, fine, 0.0), color=colour, lw=1.4, label=label)
            plot.set_xlabel("speed (m/s)")
        speed, force = least_friction(law)
        if 0 < speed < stand.fastest_speed:
            slow.plot(speed, force, "o", color=OTHER, ms=8, mfc="none", mew=1.6, label="least of the law")
        slow.set_xscale("log")
        slow.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
        whole.set_ylim(0.0)
        whole.set_ylabel("friction of one cylinder (N)")
        canvas.legend(*slow.get_legend_handles_labels(), loc="outside upper left", ncols=3)
        alt = f"Friction over speed: {plain(float(cylinder_friction(law, stand.fastest_speed, 0.0)), 1)} N at "
        alt += f"{stand.fastest_speed:g} m/s, least {plain(force, 1)} N."
        caption = (
            "Friction over speed, as in Fig. 3, on the right over the logarithm of the speed, where the Stribeck "
            f"effect can be seen: {int(np.sum(points.velocity < 3 / max(law.stribeck_decay, 1e-9)))} of "
            f"{len(points.velocity)} speeds lie within it."
        )
        return drawing(canvas, "tracking-friction", alt, caption, wide=True)


def table(law: CylinderFriction, stand: TrackingStand, figures: Mapping[str, Any]) -> Table:
    """Parameters as the plant has them, Table I, as identified; standard errors expected by either spacing."""
    rows = []
    for name, (symbol, dimension, value, error) in TABLE_I.items():
        found = figures["identified_friction"].get(name)
        other = figures["identified_friction_geometric"].get(name)
        expected = (figures["expected_standard_error"][name], figures["expected_standard_error_geometric"][name])
        rows.append(
            (
                Cell(f"{symbol} ({UNITS[dimension]})"),
                Cell(significant(getattr(law, name), 4)),
                Cell(f"{significant(value, 4)} ± {significant(error, 3)}"),
                Cell(_pair(found), "strong"),
                Cell(DASH if expected[0] is None else significant(expected[0], 3)),
                Cell(DASH if expected[0] is None else plain(expected[0] / error, 2)),
                Cell(_pair(other)),
                Cell(DASH if expected[1] is None else significant(expected[1], 3)),
            )
        )
    spacing = "even" if stand.spacing == EVEN else "geometric"
    head = (
        "Parameter",
        "Plant",
        "Table I",
        f"Identified, {spacing}",
        "Expected error",
        "Over Table I’s",
        "Identified, geometric",
        "Expected error, geometric",
    )
    return Table(f"Friction identified at {stand.speeds} speeds, ± one standard error", head, tuple(rows), signs=True)


def _pair(found: Mapping[str, float] | None) -> str:
    if found is None:
        return DASH
    return f"{significant(found['value'], 4)} ± {significant(found['standard_error'], 3)}"
