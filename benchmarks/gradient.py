"""What exact gradients cost, and how good they are: the prototype with its window of positions.

    python benchmarks/gradient.py

Seconds are the processor's, in one thread, the median of three. Two evaluations are the measure: the one that runs,
whose first position begins from no field and each other one from its neighbours, and the same with every position begun
from no field. What a gradient adds is given for all figures by eight and by twenty keys, and for the field's own five,
`FIVE`, by eight, with its ratio to either. Below them the largest error of any figure's derivative against extrapolated
differences that can tell (`gradient_differences`), relative to max(|derivative|, figure/key).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from statistics import median
from time import process_time

from gradient_designs import EXAMPLE
from gradient_differences import TOLERANCE, Designs, scale, size
from gradient_proof import RESOLVED, WITHOUT

from fluxbore.design.hybrid_values import positions
from fluxbore.design.spec import Spec, load
from fluxbore.fem.threads import one_thread
from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.evaluation import PositionResult
from fluxbore.optimize.hybrid_field import Field, field_figures, position_result, solve_field, solve_window
from fluxbore.optimize.hybrid_figures import complete
from fluxbore.optimize.hybrid_gradient import field_gradient

RUNS = 3
EIGHT = (
    "actuator.mover.ring_width",
    "actuator.back_yoke.thickness",
    "actuator.mover.pole_pitch",
    "actuator.back_yoke.outer_diameter",
    "actuator.cylinder.outer_diameter",
    "actuator.mover.outer_diameter",
    "actuator.mover.remanence",
    "actuator.shaft.outer_diameter",
)
TWENTY = (
    *EIGHT,
    "actuator.winding.outer_diameter",
    "actuator.winding.turns",
    "actuator.winding.wire_diameter",
    "actuator.cylinder.inner_diameter",
    "actuator.back_yoke.front_overhang",
    "actuator.back_yoke.back_overhang",
    "actuator.mover.magnet_permeability",
    "operating_point.magnet_temperature",
    "operating_point.current",
    "operating_point.first_position",
    "operating_point.last_position",
    "operating_point.speed",
)


FIVE = ("force_constant", "force_constant_linkage", "yoke_flux_density", "stray_field", "cogging_force")


def seconds(run: Callable[[], object]) -> float:
    begin = process_time()
    run()
    return process_time() - begin


def evaluated(spec: Spec, keys: Sequence[str] = ()) -> None:
    assert evaluate(spec, "fem", keys).ok


def results(spec: Spec, field: Field) -> tuple[PositionResult, ...]:
    return tuple(position_result(item, spec.actuator.mover.pole_pitch) for item in field.window)


def cold(spec: Spec) -> None:
    """The evaluation with each position begun from no field."""
    field = Field([item for z in positions(spec.values) for item in solve_window(spec, [z])], [])
    complete(spec, field_figures(spec, field, results(spec, field)))


def five(spec: Spec) -> float:
    """Seconds of the gradient of the five figures alone, by eight keys, on a field that is there."""
    field = solve_field(spec)
    of_positions = results(spec, field)
    return seconds(lambda: field_gradient(spec, field, of_positions, EIGHT, FIVE))


def costs(spec: Spec) -> dict[str, float]:
    """Medians of `RUNS`, taken in turns so that whatever else the machine does falls on all alike."""
    found: dict[str, list[float]] = {}
    with one_thread():
        for _ in range(RUNS):
            running = seconds(lambda: evaluated(spec))
            for name, own in (
                ("evaluation as it runs", running),
                ("evaluation from no field at each position", seconds(lambda: cold(spec))),
                ("gradient of all figures, 8 keys", seconds(lambda: evaluated(spec, EIGHT)) - running),
                ("gradient of all figures, 20 keys", seconds(lambda: evaluated(spec, TWENTY)) - running),
                ("gradient of the five figures, 8 keys", five(spec)),
            ):
                found.setdefault(name, []).append(own)
    return {name: median(own) for name, own in found.items()}


def largest_error(spec: Spec, keys: Sequence[str]) -> tuple[float, str, int, int]:
    """Relative to the scale, of which figure and key; how many derivatives were told, of how many."""
    spec = replace(spec, given={**spec.given, "solver.tolerance": TOLERANCE})
    gradient = evaluate(spec, "fem", keys).gradient
    assert gradient is not None
    worst, where, told, count = 0.0, "", 0, 0
    with one_thread():
        designs = Designs(spec, solve_field(spec))
        for key in keys:
            for name, own in designs.derivatives(key).items():
                if name in WITHOUT:
                    continue
                size_of_error = scale(own.value, designs.own[name], size(spec, key)) or 1.0
                count += 1
                if own.doubt > RESOLVED * size_of_error:
                    continue
                told += 1
                error = abs(gradient[name][key] - own.value) / size_of_error
                if error > worst:
                    worst, where = error, f"{name} by {key}"
    return worst, where, told, count


def main() -> None:
    spec = load(EXAMPLE)
    evaluate(spec, "fem", EIGHT)  # imports and topology are no design's own
    found = costs(spec)
    running, from_none = list(found.values())[:2]
    print(f"{'':44}{'seconds':>9}{'of as it runs':>15}{'of no field':>13}")
    for name, own in found.items():
        print(f"{name:44}{own:9.3f}{own / running:15.2f}{own / from_none:13.2f}", flush=True)
    error, where, told, count = largest_error(spec, EIGHT)
    print(f"\nLargest error by the eight keys: {error:.1e} ({where}); {told} of {count} derivatives can be told.")


if __name__ == "__main__":
    main()
