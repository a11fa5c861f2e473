"""The keys of a system of coaxial coils: up to four windings, what surrounds them, and what they must withstand."""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.design.keys import Alternatives, Key, Values
from fluxbore.design.materials import Conductor, Material

COIL_NAMES = ("coil_1", "coil_2", "coil_3", "coil_4")
"""The sections of the windings; the first is always there, the others where one of their keys is given."""

LARGEST_LENGTH = 100.0
"""m; energy stores are larger than actuators, but not as large as a slip of the unit."""

LARGEST_CURRENT_DENSITY = 1e12
"""A/m^2; the best thin films carry a tenth of it."""


@dataclass(frozen=True, slots=True)
class OptionalAlternatives(Alternatives):
    """Alternatives of a section that may be absent as a whole."""

    def check(self, given: Values) -> None:
        """As for any alternatives, once any key of their section is given. Raises SpecError."""
        section = self.keys[0].rpartition(".")[0] + "."
        if any(key.startswith(section) for key in given):
            # By name: a class made anew for its slots is not the one that super() would look for.
            Alternatives.check(self, given)


def _coil(name: str, symbol: str, *, optional: bool) -> tuple[Key, ...]:
    def length(leaf: str, doc: str, sign: str) -> Key:
        return Key(f"actuator.{name}.{leaf}", doc, symbol=sign, above=0.0, maximum=LARGEST_LENGTH, optional=optional)

    return (
        length("radius", "mean radius of the winding", f"R_{symbol}"),
        length("inner_radius", "inner radius of the winding", f"a_{symbol}"),
        length("thickness", "radial thickness of the winding", f"d_{symbol}"),
        length("half_height", "half height of the winding along the axis", f"h_{symbol}/2"),
        Key(
            f"actuator.{name}.position",
            "z of the winding's middle",
            symbol=f"z_{symbol}",
            minimum=-LARGEST_LENGTH,
            maximum=LARGEST_LENGTH,
            default=None if optional else 0.0,
            optional=optional,
        ),
        Key(
            f"actuator.{name}.current_density",
            "current density in the winding's cross-section; positive along +phi",
            dimension="current density",
            symbol=f"J_{symbol}",
            minimum=-LARGEST_CURRENT_DENSITY,
            maximum=LARGEST_CURRENT_DENSITY,
            optional=optional,
        ),
    )


def _optional(name: str, doc: str, dimension: str, maximum: float) -> Key:
    return Key(f"operating_point.{name}", doc, dimension=dimension, above=0.0, maximum=maximum, optional=True)


COILS_KEYS: tuple[Key, ...] = (
    Key("actuator.name", "name of the design; STEP files and report carry it", kind="word", default="coils"),
    Key("actuator.conductor", "conductor of the windings", kind="word", default="copper"),
    Key(
        "actuator.fill",
        "share of a winding's cross-section that is conductor",
        kind="number",
        above=0.0,
        maximum=1.0,
        default=1.0,
    ),
    *(key for i, name in enumerate(COIL_NAMES) for key in _coil(name, str(i + 1), optional=i > 0)),
    _optional("line_radius", "radius of the line parallel to the axis on which the stray field is read", "length", 1e4),
    _optional("line_height", "z of the line across the axis on which the stray field is read", "length", 1e4),
    Key(
        "operating_point.points_per_line",
        "equally spaced points on each of the two lines, both ends included; the corner counts on both",
        kind="integer",
        minimum=2,
        maximum=10_000,
        default=11,
    ),
    _optional("stray_norm", "stray flux density that counts 1 in the merit", "flux density", 100.0),
    _optional("reference_energy", "stored energy that the merit asks for", "energy", 1e15),
    _optional(
        "critical_current_density",
        "current density at which the superconductor quenches without a field",
        "current density",
        LARGEST_CURRENT_DENSITY,
    ),
    _optional(
        "critical_flux_density",
        "flux density at which the superconductor carries nothing; in between its limit is a straight line",
        "flux density",
        1e3,
    ),
    Key(
        "operating_point.winding_temperature",
        "temperature of the windings, for the resistivity",
        dimension="temperature",
        above=0.0,
        maximum=1000.0,
        default=293.15,
    ),
)

COILS_ALTERNATIVES: tuple[Alternatives, ...] = tuple(
    kind(tuple(f"actuator.{name}.{leaf}" for leaf in ("radius", "inner_radius", "thickness")), 2, "R = a + d/2")
    for name, kind in zip(COIL_NAMES, (Alternatives, *(OptionalAlternatives,) * 3), strict=True)
)

COILS_MATERIALS: dict[str, type[Material]] = {"actuator.conductor": Conductor}
"""Which keys name materials, and the kind of material that each needs."""
