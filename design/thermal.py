"""The winding's temperature in steady state: a lumped network from the copper to still air.

    winding (mean) - R_m - star - R_o - leads' clearance - yoke - convection and radiation - air
                            |
                            R_i - tube, along its length - end caps - convection and radiation - air

R_o, R_i and R_m are those of a hollow cylinder that is heated evenly (Mellor, Roberts and Turner 1991, IEE Proc. B 138,
205, radial part): exact for the mean temperature, with R_m below zero. Across the wires a winding conducts as

    k = k_i ((1 + f) k_c + (1 - f) k_i) / ((1 - f) k_c + (1 + f) k_i)

with f the copper's share, k_c the copper and k_i what fills the rest (Hashin and Shtrikman 1962, lower bound, exact for
coated cylinders). The clearance of the leads is air at the ambient's temperature, without the leads. The tube's heat
arrives evenly along the winding and leaves by its two ends: L/(12 k A) from its mean to the winding's ends.

Left out, to the safe side: whatever the actuator is screwed to, the coils' end faces, the air in the bore, moving parts
that carry heat away. Taken as perfect: the contacts of winding and tube and of tube and caps; the yoke's wall. The end
caps' faces count as horizontal cylinder. The winding's hottest place is a few kelvin above its mean.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from fluxbore.design.convection import air, heat_transfer
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.materials import Conductor, Material
from fluxbore.design.winding import copper_fill

HOTTEST = 2000.0
"""K; a winding that would be hotter has run away: no copper is left."""

FLATTEST = 0.1
"""Of the mean conductance between the winding and the air: the least with which temperatures beyond `HOTTEST` grow."""

COLDEST = 10.0
"""K; no surface is taken as colder."""

ROUNDS = 60
"""At most, of the iteration for the surfaces' temperatures; four to six are usual."""


@dataclass(frozen=True, slots=True)
class ThermalNetwork:
    """Resistances in K/W, areas in m^2, diameters in m, ambient in K."""

    outwards: float  # R_o and the leads' clearance
    inwards: float  # R_i
    mean: float  # R_m
    along_tube: float | None  # None where the tube's conductivity is not known: no heat goes that way
    yoke_area: float
    yoke_diameter: float
    cap_area: float
    cap_diameter: float
    emissivity: float
    ambient: float


@dataclass(frozen=True, slots=True)
class Heat:
    """Temperatures (K) of the parts, and the heat that the winding gives off (W)."""

    winding: float
    yoke: float
    tube: float
    caps: float
    winding_heat: float


def winding_conductivity(fill: float, conductor: float, insulation: float) -> float:
    """k across the wires (W/(m K)); fill is the copper's share of the section."""
    return (
        insulation
        * ((1 + fill) * conductor + (1 - fill) * insulation)
        / ((1 - fill) * conductor + (1 + fill) * insulation)
    )


def shell_resistances(inner: float, outer: float, length: float, conductivity: float) -> tuple[float, float, float]:
    """R_o, R_i and R_m (K/W) of an evenly heated hollow cylinder; radii and length in m."""
    a, b = inner**2, outer**2
    log = math.log(outer / inner)
    scale = 1 / (4 * math.pi * conductivity * length)
    out = scale * (1 - 2 * a * log / (b - a))
    inn = scale * (2 * b * log / (b - a) - 1)
    mean = -scale / (2 * (b - a)) * (a + b - 4 * a * b * log / (b - a))
    return out, inn, mean


def network(
    actuator: HybridActuator,
    conductor: Conductor,
    tube: Material,
    *,
    insulation_conductivity: float,
    emissivity: float,
    ambient: float,
) -> ThermalNetwork:
    """The network of an actuator; conductivity in W/(m K), ambient temperature in K.

    A conductor that states no thermal conductivity is taken as a perfect one beside its insulation.
    """
    yoke, caps = actuator.back_yoke, actuator.end_caps
    wound = actuator.winding_end - actuator.winding_start
    inner, outer = actuator.cylinder.outer_diameter / 2, actuator.winding.outer_diameter / 2
    k = winding_conductivity(copper_fill(actuator), conductor.thermal_conductivity or 1e9, insulation_conductivity)
    out, inn, mean = shell_resistances(inner, outer, wound, k)
    clearance = math.log(yoke.inner_diameter / actuator.winding.outer_diameter) / (
        2 * math.pi * air(ambient).conductivity * wound
    )
    along = None
    if tube.thermal_conductivity is not None:
        section = math.pi / 4 * (actuator.cylinder.outer_diameter**2 - actuator.cylinder.inner_diameter**2)
        beyond = max(actuator.cylinder.length - wound, 0.0)
        along = (wound / 12 + beyond / 4) / (tube.thermal_conductivity * section)
    return ThermalNetwork(
        out + clearance,
        inn,
        mean,
        along,
        math.pi * yoke.outer_diameter * (actuator.yoke_end - actuator.yoke_start),
        yoke.outer_diameter,
        2 * math.pi * caps.flange_diameter * (caps.flange_length + caps.flange_diameter / 4),
        caps.flange_diameter,
        emissivity,
        ambient,
    )


def heat_at(
    net: ThermalNetwork, winding: float, yoke_loss: float = 0.0, tube_loss: float = 0.0, near: Heat | None = None
) -> Heat:
    """What a winding at this mean temperature (K) gives off while yoke and tube have losses of their own (W).

    near : at another temperature, to begin from.

    Newton's iteration on the temperatures of the two surfaces, each of which gives off q = g T - c along its tangent.
    The heat of a surface grows faster than its temperature, so that tangents lead to the root from above.
    """
    rise = winding - net.ambient
    yoke = caps = tube = rise
    if near is not None:
        yoke, caps = near.yoke - net.ambient, near.caps - net.ambient
    given = 0.0
    for _ in range(ROUNDS):
        before = yoke, caps
        g, c = _tangent(net, net.yoke_area, net.yoke_diameter, yoke)
        outwards, outer_offset = net.outwards + 1 / g, (yoke_loss + c) / g
        admittance, offset = 1 / outwards, outer_offset / outwards
        if net.along_tube is not None:
            g_caps, c_caps = _tangent(net, net.cap_area, net.cap_diameter, caps)
            away = net.along_tube + 1 / g_caps
            admittance += 1 / (net.inwards + away)
            offset += (tube_loss * away + c_caps / g_caps) / (net.inwards + away)
        else:  # the tube's own loss can only leave through the winding
            g_caps, c_caps = math.inf, 0.0
            offset += tube_loss
        given = (rise * admittance - offset) / (1 + net.mean * admittance)
        star = rise - net.mean * given
        outer_flow = (star - outer_offset) / outwards
        inner_flow = given - outer_flow
        yoke = (outer_flow + yoke_loss + c) / g
        tube = star - net.inwards * inner_flow
        caps = (inner_flow + tube_loss + c_caps) / g_caps
        if abs(yoke - before[0]) + abs(caps - before[1]) <= 1e-15 * net.ambient:
            break
    return Heat(winding, net.ambient + yoke, net.ambient + tube, net.ambient + caps, given)


def winding_temperature(
    net: ThermalNetwork, loss: Callable[[float], float], yoke_loss: float = 0.0, tube_loss: float = 0.0
) -> float:
    """Mean temperature (K) at which the winding gives off what it loses.

    loss : of the winding at its mean temperature (K -> W), duty included. Above `HOTTEST` the heat balance is continued
    along its tangent there: no temperature that anything could have, but a measure of how far the winding has run away,
    continuous, which grows with every loss. Heat grows faster than the temperature and a conductor's loss in proportion
    to it, so that there is one root below and none beyond where the balance at `HOTTEST` is short of heat.
    """

    near: Heat | None = None

    def surplus(temperature: float) -> float:
        nonlocal near
        near = heat_at(net, temperature, yoke_loss, tube_loss, near)
        return near.winding_heat - loss(temperature)

    found = _root(surplus, net.ambient, HOTTEST)
    if found is not None:
        return found
    short, step = -surplus(HOTTEST), 1e-3 * HOTTEST
    tangent = (surplus(HOTTEST + step) - surplus(HOTTEST - step)) / (2 * step)
    mean = heat_at(net, HOTTEST).winding_heat / (HOTTEST - net.ambient)
    return HOTTEST + short / max(tangent, FLATTEST * mean)


def continuous_current(
    net: ThermalNetwork,
    resistance: float,
    limit: float,
    duty: float = 1.0,
    yoke_loss: float = 0.0,
    tube_loss: float = 0.0,
) -> float:
    """Amplitude (A) of the balanced current that keeps the winding at its limit (K): 3/2 duty R I^2 = heat given off.

    resistance : of a phase at the limit's temperature (ohm). Negative where the other losses alone pass the limit.
    """
    square = heat_at(net, limit, yoke_loss, tube_loss).winding_heat / (1.5 * duty * resistance)
    return math.copysign(math.sqrt(abs(square)), square)


def _tangent(net: ThermalNetwork, area: float, diameter: float, rise: float) -> tuple[float, float]:
    """g (W/K) and c (W) of the heat g T - c that a surface gives off near this rise T (K).

    A winding that would have to be cooled from within (see `continuous_current`) can ask for less than no temperature.
    """
    rise = max(rise, COLDEST - net.ambient)

    def heat(at: float) -> float:
        return area * heat_transfer(diameter, net.ambient + at, net.ambient, net.emissivity) * at

    step = 1e-5 * (1.0 + abs(rise))
    slope = (heat(rise + step) - heat(rise - step)) / (2 * step)
    return slope, slope * rise - heat(rise)


def _root(function: Callable[[float], float], low: float, limit: float) -> float | None:
    """The first root above ``low``, where the function is not positive; None where there is none below ``limit``.

    Brackets that double, then false position by the Illinois rule down to rounding: derivatives are differenced of it.
    """
    f_low = function(low)
    if f_low >= 0:
        return low
    step = 8.0
    high, f_high = low + step, function(low + step)
    while f_high < 0:
        if high >= limit:
            return None
        low, f_low, step = high, f_high, 2 * step
        high = min(low + step, limit)
        f_high = function(high)
    for _ in range(100):
        middle = high - f_high * (high - low) / (f_high - f_low)
        f_middle = function(middle)
        if f_middle == 0 or abs(high - low) <= 4e-16 * abs(middle):
            return middle
        if f_middle * f_high < 0:
            low, f_low = high, f_high
        else:
            f_low /= 2
        if abs(middle - high) <= 2e-16 * abs(middle):
            return middle
        high, f_high = middle, f_middle
    return high
