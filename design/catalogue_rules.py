"""Which dimensions of each kind of actuator are bought, from which catalogue, and what goes along with them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from fluxbore.design.catalogue import HOSES, SHAFTS, TUBES, WIRES, Catalogue, Size
from fluxbore.design.keys import Values


@dataclass(frozen=True, slots=True)
class Rule:
    """One thing that is bought.

    keys : key -> the length of the catalogue that it holds. near : the keys of these by which sizes are near or far.
    along : key -> the key by whose change it changes too where it has a value, so that clearances stay.
    """

    what: str
    catalogue: Catalogue
    keys: Mapping[str, str]
    near: tuple[str, ...]
    along: Mapping[str, str] = field(default_factory=dict)

    def changes(self, size: Size, values: Values) -> dict[str, float]:
        """Every key that this size gives another value; values : the specification's own, resolved (SI)."""
        sizes = {key: size.lengths[length] for key, length in self.keys.items()}
        moved = {
            key: float(values[key]) + sizes[lead] - float(values[lead])
            for key, lead in self.along.items()
            if key in values and sizes[lead] != values[lead]
        }
        return {key: value for key, value in {**moved, **sizes}.items() if values.get(key) != value}

    def by_distance(self, values: Values) -> list[Size]:
        """The catalogue, the nearest size first: by the largest difference of a length (m), then of all together."""

        def far(size: Size) -> tuple[float, float]:
            gaps = [abs(size.lengths[self.keys[key]] - float(values[key])) for key in self.near]
            return round(max(gaps), 9), round(sum(gaps), 9)

        return sorted(self.catalogue.sizes, key=far)


_BORE = "actuator.cylinder.inner_diameter"
_WIRE = "actuator.winding.wire_diameter"


def _cylinder(name: str) -> tuple[Rule, ...]:
    """Of a hydraulic cylinder."""
    bore, wall = f"actuator.{name}.bore", f"actuator.{name}.wall_thickness"
    words = name.replace("_", " ")
    rod = f"actuator.{name}.rod_diameter"
    return (
        Rule(f"tube of the {words}", TUBES, {bore: "inner", wall: "wall"}, (bore, wall)),
        Rule(f"rod of the {words}", SHAFTS, {rod: "outer"}, (rod,)),
    )


RULES: Mapping[str, tuple[Rule, ...]] = {
    "hybrid": (
        Rule("shaft", SHAFTS, {"actuator.shaft.outer_diameter": "outer"}, ("actuator.shaft.outer_diameter",)),
        Rule(
            "cylinder tube",
            TUBES,
            {"actuator.cylinder.outer_diameter": "outer", _BORE: "inner", "actuator.cylinder.catalogue_bore": "inner"},
            ("actuator.cylinder.outer_diameter", _BORE),
            {
                "actuator.mover.outer_diameter": _BORE,
                "actuator.piston.fin_outer_diameter": _BORE,
                "actuator.piston.fin_inner_diameter": _BORE,
            },
        ),
        Rule(
            "winding wire",
            WIRES,
            {_WIRE: "bare", "actuator.winding.insulated_diameter": "insulated"},
            (_WIRE,),
        ),
    ),
    "hydrostatic": (
        *_cylinder("input_cylinder"),
        *_cylinder("output_cylinder"),
        Rule("hose", HOSES, {"actuator.hose.bore": "inner"}, ("actuator.hose.bore",)),
    ),
    "lead-screw": (),
    "coils": (),
}
"""By kind. A lead screw's bearings are always a catalogue's, and its members are made; coils name no wire."""
