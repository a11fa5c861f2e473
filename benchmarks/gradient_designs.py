"""Random hybrid actuators, as whole specifications, on which gradients are tried.

Bounds are those of machines that somebody might build, with their dark corners: rings and yokes so thin that they
saturate, cylinders and shafts of soft iron, hot magnets without rings between them, currents far beyond the rating.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from fluxbore.design.errors import FluxboreError
from fluxbore.design.keys import Value
from fluxbore.design.materials import PermanentMagnet, SoftIron
from fluxbore.design.spec import Spec, load
from fluxbore.optimize.hybrid_common import common_figures

EXAMPLE = Path(__file__).resolve().parents[1] / "examples" / "ipehla.toml"
MM = 1e-3
TRIES = 1000
"""Draws until one can be built; about every second can."""


def random_spec(seed: int) -> Spec:
    """One design of a seed. Which of the alternatives it is given by is drawn too, so that every key takes its turn."""
    rng = np.random.default_rng(seed)
    base = load(EXAMPLE)
    for _ in range(TRIES):
        spec = _given_otherwise(replace(base, given=_drawn(base, rng)), rng)
        try:
            assert spec.kind.check is not None
            spec.kind.check(spec.values)
            common_figures(spec, spec.actuator)
        except FluxboreError:
            continue
        return spec
    raise AssertionError(f"Seed {seed} has no design.")


def _drawn(base: Spec, rng: np.random.Generator) -> dict[str, Value]:
    irons = [name for name, material in base.materials.items() if isinstance(material, SoftIron)]
    magnets = [name for name, material in base.materials.items() if isinstance(material, PermanentMagnet)]

    def between(low: float, high: float) -> float:
        return float(rng.uniform(low, high))

    def log(low: float, high: float) -> float:
        return float(np.exp(between(np.log(low), np.log(high))))

    def often(share: float) -> bool:
        return bool(rng.random() < share)

    shaft = log(3 * MM, 20 * MM)
    magnet = shaft + 2 * log(1.5 * MM, 12 * MM)
    bore = magnet + 2 * log(0.03 * MM, 0.4 * MM)
    tube = bore + 2 * log(0.3 * MM, 3 * MM)
    wound = tube + 2 * log(0.8 * MM, 6 * MM)
    clearance = 0.0 if often(0.1) else log(0.05 * MM, 0.8 * MM)
    pitch = log(5 * MM, 30 * MM)
    coil = 2 * pitch / 3
    pairs = int(rng.integers(1, 5))
    sets = pairs + 1 + int(rng.integers(0, 3))
    stroke, piston = between(0.3, 2.0) * pitch, between(0.3, 1.2) * pitch
    array = 2 * pairs * pitch
    wire = min(log(0.1 * MM, 0.8 * MM), (wound - tube) / 3, coil / 2)
    turns = between(0.2, 0.6) * coil * (wound - tube) / 2 / (np.pi / 4 * wire**2) * sets
    current = log(1e6, 1e7) * np.pi / 4 * wire**2
    front, back = (0.0 if often(0.1) else between(0.05, 1.5) * pitch for _ in range(2))
    tube_length = max(array + 2 * piston + stroke, 3 * sets * coil + 2 * max(front, back)) * between(1.1, 1.4) + 30 * MM
    given: dict[str, Value] = {
        **base.given,
        "actuator.back_yoke.thickness": log(0.15 * MM, 4 * MM),
        "actuator.back_yoke.front_overhang": front,
        "actuator.back_yoke.back_overhang": back,
        "actuator.back_yoke.inner_diameter": wound + 2 * clearance,
        "actuator.back_yoke.material": str(rng.choice(irons)),
        "actuator.back_yoke.emissivity": between(0.05, 0.9),
        "actuator.winding.outer_diameter": wound,
        "actuator.winding.sets_per_phase": sets,
        "actuator.winding.turns": turns,
        "actuator.winding.wire_diameter": wire,
        "actuator.winding.insulated_diameter": wire * between(1.03, 1.15),
        "actuator.cylinder.outer_diameter": tube,
        "actuator.cylinder.inner_diameter": bore,
        "actuator.cylinder.catalogue_bore": bore * between(0.97, 1.03),
        "actuator.cylinder.length": tube_length,
        "actuator.cylinder.material": str(rng.choice(irons)) if often(0.15) else "aluminium 6061",
        "actuator.mover.pole_pitch": pitch,
        "actuator.mover.ring_width": 0.0 if often(0.05) else log(0.02, 0.6) * pitch,
        "actuator.mover.pole_pairs": pairs,
        "actuator.mover.outer_diameter": magnet,
        "actuator.mover.magnet": str(rng.choice(magnets)),
        "actuator.mover.ring_material": str(rng.choice(irons)),
        "actuator.mover.stroke": stroke,
        "actuator.shaft.outer_diameter": shaft,
        "actuator.shaft.length": tube_length * between(1.05, 1.3),
        "actuator.shaft.material": str(rng.choice(irons)) if often(0.15) else "stainless steel 304",
        "actuator.piston.length": piston,
        "actuator.piston.fin_outer_diameter": bore * 1.01,
        "actuator.piston.fin_inner_diameter": bore * 0.95,
        "actuator.piston.fin_length": piston / 4,
        "actuator.end_caps.flange_diameter": tube * 1.3,
        "actuator.seal.viscous_coefficient": log(1.0, 100.0),
        "operating_point.current": current,
        "operating_point.duty": between(0.2, 1.0),
        "operating_point.speed": log(0.02, 2.0),
        "operating_point.supply_voltage": log(12.0, 400.0),
        "operating_point.winding_temperature": between(293.0, 400.0),
        "operating_point.magnet_temperature": between(253.0, 383.0),
    }
    del given["actuator.back_yoke.outer_diameter"]
    for key, share, low, high in (
        ("actuator.mover.remanence", 0.6, 0.9, 1.5),
        ("actuator.mover.magnet_permeability", 0.6, 1.02, 1.2),
    ):
        given.pop(key, None)
        if often(share):
            given[key] = between(low, high)
    if often(0.4):
        given["operating_point.peak_current"] = current * log(1.5, 30.0)
    _window(given, rng, stroke, often(0.3))
    return given


def _window(given: dict[str, Value], rng: np.random.Generator, stroke: float, several: bool) -> None:
    """One position, or two or three; none at the stroke's ends."""
    middle = _mid_stroke(given)
    first, last = sorted(middle + float(x) * stroke for x in rng.uniform(-0.45, 0.45, 2))
    given["operating_point.positions"] = int(rng.integers(2, 4)) if several else 1
    given["operating_point.first_position"], given["operating_point.last_position"] = first, last


def _mid_stroke(given: dict[str, Value]) -> float:
    """Position in the middle of the stroke (m)."""
    spec = replace(load(EXAMPLE), given=given)
    return float(spec.kind.from_values(spec.values).mid_stroke)


def _given_otherwise(spec: Spec, rng: np.random.Generator) -> Spec:
    """The same design, given by other ones of each group of alternatives."""
    for group in spec.kind.alternatives:
        keys = rng.permutation([key for key in group.keys if key in spec.values])[: group.count]
        spec = spec.pinned(str(key) for key in keys)
    return spec
