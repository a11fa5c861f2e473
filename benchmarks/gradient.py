"""What exact gradients cost, and how good they are: the prototype with its window of positions.

    python benchmarks/gradient.py

Seconds are the processor's, in one thread, the median of three: of an evaluation from no field, and of the same with
the derivatives of all figures by eight and by twenty keys. Beside them the largest error of any figure's derivative
against extrapolated differences that can tell (`gradient_differences`), relative to max(|derivative|, figure/key).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from statistics import median
from time import process_time

from gradient_designs import EXAMPLE
from gradient_differences import TOLERANCE, Designs, scale, size
from gradient_proof import RESOLVED, WITHOUT

from fluxbore.design.spec import Spec, load
from fluxbore.fem.threads import one_thread
from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.hybrid_field import solve_field

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


def seconds(spec: Spec, keys: Sequence[str]) -> float:
    """Of one evaluation; median of `RUNS`."""
    found = []
    for _ in range(RUNS):
        begin = process_time()
        assert evaluate(spec, "fem", keys).ok
        found.append(process_time() - begin)
    return median(found)


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
    forward = seconds(spec, ())
    print(f"{'':26}{'seconds':>10}{'gradient/forward':>20}")
    print(f"{'evaluation':26}{forward:10.3f}")
    for title, keys in (("with 8 derivatives", EIGHT), ("with 20 derivatives", TWENTY)):
        both = seconds(spec, keys)
        print(f"{title:26}{both:10.3f}{(both - forward) / forward:20.2f}", flush=True)
    error, where, told, count = largest_error(spec, EIGHT)
    print(f"\nLargest error by the eight keys: {error:.1e} ({where}); {told} of {count} derivatives can be told.")


if __name__ == "__main__":
    main()
