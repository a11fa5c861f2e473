"""The winding chart: what a winder needs for every coil and phase, and what is assumed because nothing says it.

A three-phase winding of ring coils is wound coil by coil in one direction; a phase is its coils in series, so that its
length of wire and resistance are those of `fluxbore.design.winding`. Windings given by current density alone have no
wire; of them the chart tells section, ampere-turns and conductor. Values are SI.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from fluxbore.design import winding
from fluxbore.design.coils import CoilSystem
from fluxbore.design.hybrid import PHASES, HybridActuator
from fluxbore.design.material_kinds import ROOM_TEMPERATURE, Conductor
from fluxbore.design.units import format_quantity

SAME, AGAINST = "clockwise", "counter-clockwise"
"""Seen from the cap end, along +z: currents along +phi and against it."""

HEXAGONAL = math.sqrt(3) / 2
"""Distance of layers over the wire's diameter where wires lie in the furrows of the layer beneath."""


@dataclass(frozen=True, slots=True)
class Wire:
    """Round wire in a coil's window: whole layers of whole turns. Lengths in m.

    nested : whether wires lie in the furrows of the layer beneath, which they do where layers one upon another would
    be too high. first, second : turns of a full layer on the tube and of the next. height : of the layers as they lie;
    straight : of as many as were needed one upon another. room : of the window.
    """

    bare: float
    insulated: float
    nested: bool
    layers: int
    first: int
    second: int
    height: float
    straight: float
    room: float


@dataclass(frozen=True, slots=True)
class CoilEntry:
    """One coil, in the order along the axis. Lengths in m, mass in kg, resistance in ohm.

    start, end : from the first coil's lower face. turns : of the design, not rounded; None where only ampere-turns are
    known. current : through the whole section (A), along the coil's direction; 0 where turns are told instead.
    length : of wire. follows : the coil whose end is joined to the start.
    """

    number: int
    name: str
    phase: str
    start: float
    end: float
    inner_diameter: float
    outer_diameter: float
    direction: str
    mass: float
    turns: float | None = None
    length: float | None = None
    resistance: float | None = None
    follows: int | None = None
    current: float = 0.0


@dataclass(frozen=True, slots=True)
class PhaseEntry:
    """One phase: its coils in series, from the lead to the star. SI units."""

    phase: str
    coils: tuple[int, ...]
    turns: float
    length: float
    resistance: float
    mass: float


@dataclass(frozen=True, slots=True)
class WindingChart:
    """All of it. temperature : of the resistances (K). assumed : sentences on what nothing but habit says."""

    conductor: str
    coils: tuple[CoilEntry, ...]
    phases: tuple[PhaseEntry, ...]
    mass: float
    wire: Wire | None = None
    temperature: float = ROOM_TEMPERATURE
    told: tuple[str, ...] = ()
    assumed: tuple[str, ...] = ()


def hybrid_chart(actuator: HybridActuator, conductor: Conductor, insulated: float) -> WindingChart:
    """Of a three-phase winding. insulated : diameter of the wire with its enamel (m)."""
    sets = actuator.winding.sets_per_phase
    length, ohms = winding.wire_length(actuator), winding.resistance(actuator, conductor)
    copper = winding.copper_mass(actuator, conductor)
    coils = []
    for i in range(actuator.coils):
        phase = PHASES[i % len(PHASES)]
        coils.append(
            CoilEntry(
                number=i + 1,
                name=f"{phase}{i // len(PHASES) + 1}",
                phase=phase,
                start=i * actuator.coil_width,
                end=(i + 1) * actuator.coil_width,
                inner_diameter=actuator.cylinder.outer_diameter,
                outer_diameter=actuator.winding.outer_diameter,
                direction=SAME,
                mass=copper / actuator.coils,
                turns=actuator.turns_per_coil,
                length=length / sets,
                resistance=ohms / sets,
                follows=i + 1 - len(PHASES) if i >= len(PHASES) else None,
            )
        )
    phases = tuple(
        PhaseEntry(
            phase,
            tuple(coil.number for coil in coils if coil.phase == phase),
            actuator.winding.turns,
            length,
            ohms,
            copper / len(PHASES),
        )
        for phase in PHASES
    )
    wire = wire_in_window(actuator, insulated)
    return WindingChart(
        conductor.name,
        tuple(coils),
        phases,
        winding.copper_mass(actuator, conductor),
        wire,
        told=_told(actuator, wire),
        assumed=_assumed(wire),
    )


def wire_in_window(actuator: HybridActuator, insulated: float) -> Wire:
    """Whole layers of whole turns in a coil's window, one upon another or, where these are too high, nested.

    A second nested layer is shifted by half a wire, so that it may hold one turn less.
    """
    turns, fits = max(1, round(actuator.turns_per_coil)), actuator.coil_width / insulated * (1 + 1e-9)
    first = max(1, math.floor(fits))
    room = (actuator.winding.outer_diameter - actuator.cylinder.outer_diameter) / 2
    layers = math.ceil(turns / first)
    straight = layers * insulated
    bare = actuator.winding.wire_diameter
    if straight <= room * (1 + 1e-9) or fits < 2:
        return Wire(bare, insulated, False, layers, first, first, straight, straight, room)
    second = math.floor(fits - 0.5)
    pairs, rest = divmod(turns, first + second)
    nested = 2 * pairs + (0 if rest == 0 else (1 if rest <= first else 2))
    height = insulated * (1 + (nested - 1) * HEXAGONAL)
    return Wire(bare, insulated, True, nested, first, second, height, straight, room)


def _told(actuator: HybridActuator, wire: Wire) -> tuple[str, ...]:
    """What follows from the design."""
    turns = actuator.turns_per_coil
    sentences = [
        f"Resistances at {ROOM_TEMPERATURE - 273.15:.4g} °C; the links between a phase's coils are left out.",
        "All coils are wound the same way, and a phase's coils are in series: the end of each is joined to the start "
        "of the next of its phase.",
    ]
    if abs(turns - round(turns)) > 1e-6:
        sentences.append(f"The design has {turns:.6g} turns a coil; wind {round(turns)}.")
    height, straight, room = (format_quantity(v, "length", 4) for v in (wire.height, wire.straight, wire.room))
    if wire.height > wire.room * (1 + 1e-9):
        sentences.append(
            f"The layers do not fit: they are {height} high, in a window of {room}; take fewer turns or thinner wire."
        )
    elif wire.nested:
        sentences.append(
            f"Wires must lie in the furrows of the layer beneath: {height} high, where layers one upon another would "
            f"take {straight} of a window of {room}."
        )
    else:
        sentences.append(f"Layers one upon another are {height} high, in a window of {room}.")
    hole = format_quantity(actuator.back_yoke.lead_hole, "length", 4)
    if actuator.back_yoke.lead_hole > 0:
        sentences.append(f"Leads leave at the cap end, through the back yoke's hole of {hole}.")
    return tuple(sentences)


def _assumed(wire: Wire) -> tuple[str, ...]:
    ends = "the same face, since layers are even" if wire.layers % 2 == 0 else "the other face, since layers are odd"
    return (
        "Star connection: the ends of the phases' last coils are joined, and the starts of the first are the leads.",
        f"Each coil starts at its face towards the cap end, at the tube, and ends outside at {ends} in number.",
        "Positive current enters at the start and runs clockwise seen from the cap end.",
    )


def coils_chart(system: CoilSystem, conductor: Conductor) -> WindingChart:
    """Of windings that are told by their current density."""
    lowest = min(coil.lower for coil in system.coils)
    coils = tuple(
        CoilEntry(
            number=i,
            name=coil.name.replace("_", " "),
            phase="",
            start=coil.lower - lowest,
            end=coil.upper - lowest,
            inner_diameter=2 * coil.inner_radius,
            outer_diameter=2 * coil.outer_radius,
            direction=AGAINST if coil.current_density < 0 else SAME,
            mass=coil.volume * system.fill * conductor.density,
            current=abs(coil.current_density) * (coil.outer_radius - coil.inner_radius) * (coil.upper - coil.lower),
        )
        for i, coil in enumerate(system.coils, 1)
    )
    told = (
        "Windings are told by the current density in their section: turns and wire are to be chosen, for the "
        "ampere-turns of this chart.",
        f"{100 * system.fill:.4g} % of each section is conductor; masses are of that.",
    )
    return WindingChart(conductor.name, coils, (), sum(coil.mass for coil in coils), told=told)
