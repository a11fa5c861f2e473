"""Random lead screws, most of which can be built, and what may come of one: figures, or one sentence."""

from __future__ import annotations

import math
from dataclasses import fields
from pathlib import Path

import numpy as np

from fluxbore.design.errors import FluxboreError
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec, load
from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.evaluation import Evaluation

EXAMPLE = Path(__file__).parent.parent / "examples" / "rotlin.toml"

FORMS = ("continuous", "helical arcs", "stepped arcs")
MAGNETS = ("N42", "N48M", "N52")
IRONS = ("1010", "1018", "pure iron", "TEAM 13 steel")


def changes(seed: int) -> dict[str, str]:
    """`--set` of nearly every key of the example: radii over two decades, pitches over one, gaps of 3 to 30 % of it."""
    rng = np.random.default_rng(seed)

    def log(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    def mm(length: float) -> str:
        return f"{length!r} mm"

    radius = log(3, 300)
    pitch, poles, starts = log(0.15, 1.5) * radius, int(rng.integers(1, 13)), int(rng.choice([1, 1, 1, 2, 3, 8]))
    gap = max(log(0.03, 0.3) * pitch, radius / 60)
    engaged = poles * pitch / 2
    found = {
        "actuator.pitch": mm(pitch),
        "actuator.starts": str(starts),
        "actuator.poles": str(poles),
        "actuator.gap": mm(gap),
        "actuator.gap_tolerance": mm(gap * float(rng.uniform(0, 1.02))),
        "actuator.carried_mass": f"{log(1e-3, 100)!r} kg",
        "actuator.translator.outer_radius": mm(radius),
        "actuator.translator.length": mm(engaged * float(rng.uniform(0.98, 6))),
        "actuator.translator.thickness": "",
        "actuator.rotor.outer_radius": "",
        "actuator.rotor.frame_thickness": mm(log(0.01, 0.5) * radius),
        "actuator.rotor.length": "",
        "actuator.rotor.overhang": mm(float(rng.uniform(0, 3)) * engaged),
        "actuator.rotor.bearing": "",
        "actuator.motor.outer_radius": "",
        "actuator.motor.length": "",
        "actuator.motor.inertia": f"{log(1e-8, 1)!r} kg m^2",
        "operating_point.load_force": f"{log(1e-2, 1e4)!r} N",
        "operating_point.acceleration": f"{log(1e-2, 1e2)!r} m/s^2",
        "operating_point.friction_torque": f"{log(1e-6, 1)!r} N m",
        "operating_point.stroke": mm(float(rng.uniform(0, 8)) * engaged),
        "operating_point.magnet_temperature": f"{float(rng.uniform(-40, 140))!r} degC",
    }
    for member in ("translator", "rotor"):
        own = f"actuator.{member}."
        form = str(rng.choice(FORMS))
        found[own + "magnet_thickness"] = mm(log(0.05, 0.6) * min(pitch, radius))
        found[own + "magnet_fill"] = repr(float(rng.uniform(0.2, 1.0)))
        found[own + "magnet"] = str(rng.choice(MAGNETS))
        found[own + "remanence"] = "" if rng.random() < 0.5 else f"{float(rng.uniform(0.2, 1.45))!r} T"
        found[own + "magnet_permeability"] = "" if rng.random() < 0.5 else repr(float(rng.uniform(1.0, 1.3)))
        found[own + "iron_thickness"] = mm(0.0 if rng.random() < 0.3 else log(0.02, 0.5) * min(pitch, radius))
        found[own + "iron"] = str(rng.choice(IRONS))
        found[own + "magnets"] = form
        if form != "continuous":
            count = int(rng.integers(2, 13))
            found[own + "arcs_per_turn"] = str(count)
            found[own + "arc_angle"] = f"{360 / count * float(rng.uniform(0.5, 1.01))!r} deg"
    return found


def outcome(seed: int) -> tuple[str, dict[str, Evaluation]]:
    """ "refused" or "built", and what became of it by each route; AssertionError where that is no honest answer."""
    try:
        spec = load(EXAMPLE, changes(seed))
    except FluxboreError as error:
        assert_sentence(str(error))
        return "refused", {}
    found = {"network": evaluate(spec, "network"), "fem": evaluate(spec, "fem")}
    for evaluation in found.values():
        assert_honest(spec, evaluation)
    return "built", found


def assert_sentence(text: str) -> None:
    assert text.endswith(".")
    assert "\n" not in text
    assert "nan" not in text.split()


def assert_honest(spec: Spec, evaluation: Evaluation) -> None:
    """Figures that are numbers, or reasons that are sentences and no slip of the program's."""
    if not evaluation.ok:
        assert evaluation.reasons
        for reason in evaluation.reasons:
            assert_sentence(reason)
            assert not reason.startswith("The evaluation stopped with"), reason
        return
    performance = evaluation.performance
    for field in fields(Performance):
        value = getattr(performance, field.name)
        if isinstance(value, float):
            assert math.isfinite(value), field.name
    assert performance.stall_force is not None
    assert performance.stall_force > 0
    assert performance.stroke_end_force is not None
    assert performance.stroke_end_force <= performance.stall_force * (1 + 1e-12)
