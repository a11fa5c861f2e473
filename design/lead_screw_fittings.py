"""What holds a magnetic lead screw together and in its place, as frozen parameters.

The RotLin paper tells of rotor and stator joined by ball bearings into the mover, and of a translator fixed by shaft
holders; its sizes it does not tell. Those that a specification leaves out are in proportion to the screw's own.
"""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.design.keys import Key, Values
from fluxbore.design.materials import Material
from fluxbore.design.rolling_bearings import BEARINGS, Bearing
from fluxbore.design.threads import SCREWS, Thread

NONE, DRAWN = CHOICES = ("none", "drawn")

LARGEST_LENGTH = 10.0
"""m; beyond it a length is a slip of the unit."""


def _length(name: str, doc: str) -> Key:
    return Key(f"actuator.{name}", doc, above=0.0, maximum=LARGEST_LENGTH, optional=True)


def _one_of(name: str, doc: str, choices: tuple[str, ...]) -> Key:
    return Key(f"actuator.{name}", doc, kind="word", choices=choices, optional=True)


FITTING_KEYS: tuple[Key, ...] = (
    Key(
        "actuator.fittings",
        "whether the translator's ends, the rotor's clamps and hubs and the motor's shields are drawn and weighed",
        kind="word",
        choices=CHOICES,
        default=NONE,
    ),
    _length("translator.end_grip", "of each end of the translator within its holder; without it 1.5 R_t"),
    _one_of("translator.end_thread", "tapped into each end of the translator; without it none", tuple(SCREWS)),
    _length("rotor.clamp_length", "axial, of the rings that hold the rotor's magnets; without it 0.08 R_r"),
    _one_of("rotor.bearing", "ball bearings of the rotor, by ISO 15; without it in proportion", tuple(BEARINGS)),
    Key("actuator.rotor.hub", "at the rotor's ends, in the bearings", kind="word", default="aluminium 6061"),
    Key("actuator.motor.shield", "from the motor's stator to the bearings", kind="word", default="aluminium 6061"),
    _one_of("motor.screw", "six of them hold each end shield; without it none is drawn", tuple(SCREWS)),
)

FITTING_MATERIALS: dict[str, type[Material]] = {"actuator.rotor.hub": Material, "actuator.motor.shield": Material}

FITTING_NON_MAGNETIC = frozenset({"actuator.rotor.hub"})
"""Near the magnets."""


@dataclass(frozen=True, slots=True)
class Fittings:
    """end_grip, clamp_length : m; None where they are in proportion, as the bearing is. end_thread, screw : None for
    none. hub, shield : names of materials."""

    end_grip: float | None
    end_thread: Thread | None
    clamp_length: float | None
    bearing: Bearing | None
    hub: str
    shield: str
    screw: Thread | None


def fittings_of(values: Values) -> Fittings | None:
    """Of the resolved values; None where they are not to be drawn."""
    if values["actuator.fittings"] == NONE:
        return None

    def length(name: str) -> float | None:
        value = values.get(f"actuator.{name}")
        return None if value is None else float(value)

    def word(name: str) -> str:
        return str(values.get(f"actuator.{name}", ""))

    return Fittings(
        length("translator.end_grip"),
        SCREWS.get(word("translator.end_thread")),
        length("rotor.clamp_length"),
        BEARINGS.get(word("rotor.bearing")),
        word("rotor.hub"),
        word("motor.shield"),
        SCREWS.get(word("motor.screw")),
    )
