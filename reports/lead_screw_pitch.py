"""What the figure of a lead screw over its pitch says, in sentences."""

from __future__ import annotations

from fluxbore.optimize.pitch_curve import PitchCurve, PitchPoint
from fluxbore.reports import lead_screw_curves
from fluxbore.reports.wording import change, figure_label, figure_scale, millimetres, significant

NOTABLE = 0.02
"""By which the routes may differ before the page says what it means."""

FEW = 3
"""Poles along the axis, below which a field without ends is a poor guide."""


def sentences(curve: PitchCurve) -> tuple[str, ...]:
    """Where each figure would be best at the design's own length of poles, and what limits the pitch."""
    found = []
    if curve.network:
        for name in lead_screw_curves.PER_LENGTH:
            text = _best(curve, name)
            if text:
                found.append(text)
        found += [*_least_torque(curve), *_apart(curve)]
    if curve.network and curve.least:
        found.append(f"Below {millimetres(curve.network[0].pitch)}: {curve.least}")
    if curve.network and curve.most:
        found.append(f"Above {millimetres(curve.network[-1].pitch)}: {curve.most}")
    if not curve.network:
        found.append(f"No other pitch can be built: {curve.least or curve.most}")
    return tuple(found)


def _least_torque(curve: PitchCurve) -> list[str]:
    """The pitch at which the motor has least to do at the operating point, with the design's number of poles."""
    asked = [
        (torque, item.pitch)
        for item in curve.network
        if (torque := item.evaluation.performance.motor_torque) is not None
    ]
    own = curve.design.evaluation.performance.motor_torque
    if not asked or not own:
        return []
    torque, place = min(asked)
    shown = figure_scale("motor_torque", [torque]).quantity(torque)
    if place in (curve.network[0].pitch, curve.network[-1].pitch):
        where = f"still falls towards a pitch of {millimetres(place)}"
    else:
        where = f"is least at a pitch of {millimetres(place)}"
    return [
        f"With the design’s poles the motor’s torque at the operating point {where}: {shown}, {change(own, torque)}. A "
        "longer pitch turns the force into more torque, a shorter one must spin the rotor up faster."
    ]


def _apart(curve: PitchCurve) -> list[str]:
    """What to think of the analytic field where the finite elements say something else."""
    name = lead_screw_curves.PER_LENGTH[0]
    near = min(curve.network, key=lambda item: abs(item.pitch - curve.design.pitch))
    ideal, real = (getattr(item.evaluation.performance, name) for item in (near, curve.design))
    if ideal is None or real is None or abs(ideal / real - 1) < NOTABLE:
        return []
    return [
        f"At the design’s own pitch the analytic field’s stall force is {change(real, ideal)} against the finite "
        "elements, for its iron does not saturate: of these curves trust the circles."
    ]


def _best(curve: PitchCurve, name: str) -> str:
    """The pitch with the largest figure for the same length of poles, beside the design's."""
    label = figure_label(name)

    def value(item: PitchPoint) -> float:
        own = getattr(item.evaluation.performance, name)
        return 0.0 if own is None else own * curve.design.active_length / item.active_length

    best = max(curve.network, key=value)
    own = min(curve.network, key=lambda item: abs(item.pitch - curve.design.pitch))
    place = curve.network.index(best)
    found = figure_scale(name, [value(best)]).quantity(value(best))
    more = change(value(own), value(best))
    edge = place in (0, len(curve.network) - 1)
    word = "still grows towards" if edge else "is largest at"
    gain = f"{more} against the design’s own pitch" if best is not own else "the design’s own pitch"
    poles = 2 * curve.design.active_length / best.pitch
    few = (
        f" That is {significant(poles, 2)} poles, and the fewer there are the more their ends count."
        if poles < FEW
        else ""
    )
    return (
        f"With {millimetres(curve.design.active_length)} of poles, by the analytic field, the {label} {word} "
        f"{millimetres(best.pitch)}: {found}, {gain}.{few}"
    )
