"""Names, numbers and properties of products put into the text of a STEP file that the CAD kernel wrote.

The kernel writes shapes, colours and placements; of properties it knows few, and a density with a wrong unit. Products
come from it under keys, which are replaced here. Properties are written as readers expect them: material and density,
volume and centre for validation, all else as user defined attributes, each with its unit.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from fluxbore.geometry.step_products import Product, Property
from fluxbore.geometry.step_text import Instances, after, aggregate, extended, number, word

_PRODUCT = re.compile(r"#(\d+)\s*=\s*PRODUCT\('([^']*)','[^']*','[^']*',\s*(\(#\d+\))\s*\);")
_FORMATION = re.compile(r"#(\d+)\s*=\s*PRODUCT_DEFINITION_FORMATION\(\s*'[^']*','[^']*',\s*(#\d+)\s*\);")
_DEFINITION = re.compile(r"#(\d+)\s*=\s*PRODUCT_DEFINITION\(\s*'[^']*','[^']*',\s*(#\d+),\s*#\d+\s*\);")
_USAGE = re.compile(
    r"#(\d+)\s*=\s*NEXT_ASSEMBLY_USAGE_OCCURRENCE\(\s*'([^']*)',\s*'([^']*)',\s*'[^']*',\s*(#\d+),\s*(#\d+),\s*\$\s*\);"
)
_CONTEXT = re.compile(r"#(\d+)\s*=\s*\(\s*GEOMETRIC_REPRESENTATION_CONTEXT\(3\)")

_SOURCES = {"make": ".MADE.", "buy": ".BOUGHT."}

_MM = 1e-3


def named(text: str, products: Mapping[str, Product], usages: Mapping[str, tuple[str, str]]) -> str:
    """The file with products in place of their keys, and with their properties.

    usages : name and note of each placement, by its key.
    """
    keys: dict[str, str] = {}
    notes: dict[str, str] = {}

    def product(found: re.Match[str]) -> str:
        made = products[found[2]]
        keys[f"#{found[1]}"] = found[2]
        words = ",".join(word(part) for part in (made.number, made.name, made.description))
        return f"#{found[1]} = PRODUCT({words},{found[3]});"

    def formation(found: re.Match[str]) -> str:
        key = keys[found[2]]
        keys[f"#{found[1]}"] = key
        made = products[key]
        kind, source = "PRODUCT_DEFINITION_FORMATION", _SOURCES.get(made.source)
        if source is None:
            return f"#{found[1]} = {kind}({word(made.revision)},'',{found[2]});"
        return f"#{found[1]} = {kind}_WITH_SPECIFIED_SOURCE({word(made.revision)},'',{found[2]},{source});"

    def usage(found: re.Match[str]) -> str:
        name, note = usages[found[3]]
        if note:
            notes[f"#{found[1]}"] = note
        # Readers take a description for the name where there is one.
        words = ",".join(word(part) for part in (found[2], name, ""))
        return f"#{found[1]} = NEXT_ASSEMBLY_USAGE_OCCURRENCE({words},{found[4]},{found[5]},$);"

    text = _USAGE.sub(usage, _FORMATION.sub(formation, _PRODUCT.sub(product, text)))
    context = _CONTEXT.search(text)
    assert context is not None
    more = after(text)
    writer = _Writer(more, f"#{context[1]}", _Units(more))
    for found in _DEFINITION.finditer(text):
        writer.product(f"#{found[1]}", products[keys[found[2]]])
    for used, note in notes.items():
        writer.attribute(Property("note", note), used)
    return extended(text, more)


class _Units:
    """The units of properties, each written once and when it is first asked for."""

    def __init__(self, instances: Instances) -> None:
        self._instances = instances
        self._known: dict[str, str] = {}

    def __call__(self, name: str) -> str:
        if name not in self._known:
            self._known[name] = self._instances.add(self._content(name))
        return self._known[name]

    def _content(self, name: str) -> str:
        if name == "kg":
            return "( MASS_UNIT() NAMED_UNIT(*) SI_UNIT(.KILO.,.GRAM.) )"
        if name in ("mm", "m"):
            prefix = ".MILLI." if name == "mm" else "$"
            return f"( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT({prefix},.METRE.) )"
        powers = {"mm^3": (("mm", 3),), "kg/m^3": (("kg", 1), ("m", -3)), "kg mm^2": (("kg", 1), ("mm", 2))}[name]
        elements = [self._instances.add(f"DERIVED_UNIT_ELEMENT({self(base)},{power}.)") for base, power in powers]
        return f"DERIVED_UNIT({aggregate(elements)})"


@dataclass(frozen=True, slots=True)
class _Writer:
    """Properties of product definitions. context : of representations."""

    instances: Instances
    context: str
    units: _Units

    def product(self, definition: str, made: Product) -> None:
        if made.volume is not None:
            item = self._measure("volume measure", "VOLUME_MEASURE", made.volume / _MM**3, "mm^3")
            self._property("geometric validation property", "volume", "volume", item, definition)
        if made.centre is not None:
            place = aggregate(number(value / _MM) for value in made.centre)
            item = self.instances.add(f"CARTESIAN_POINT('centre point',{place})")
            self._property("geometric validation property", "centroid", "centroid", item, definition)
        for one in made.properties:
            self.attribute(one, definition)
        # Last: some readers take whatever property they meet for the material, and keep the last.
        if made.material is not None:
            name, density = made.material
            item = self.instances.add(f"DESCRIPTIVE_REPRESENTATION_ITEM({word(name)},{word(name)})")
            self._property("material property", "material name", "material name", item, definition)
            item = self._measure("density", "POSITIVE_RATIO_MEASURE", density, "kg/m^3")
            self._property("material property", "density", "density", item, definition)

    def attribute(self, one: Property, definition: str) -> None:
        """A user defined attribute of a product or of one use of it: its property is of a kind that others may have."""
        if isinstance(one.value, str):
            item = self.instances.add(f"DESCRIPTIVE_REPRESENTATION_ITEM({word(one.name)},{word(one.value)})")
        elif one.unit:
            kind = {"kg": "MASS_MEASURE", "mm": "LENGTH_MEASURE", "kg mm^2": "NUMERIC_MEASURE"}[one.unit]
            item = self._measure(one.name, kind, one.value, one.unit)
        else:
            item = self.instances.add(f"REAL_REPRESENTATION_ITEM({word(one.name)},{number(one.value)})")
        made = self._property(one.name, "user defined attribute", "", item, definition)
        general = self.instances.add(f"GENERAL_PROPERTY({word(one.name)},'user defined attribute',$)")
        self.instances.add(f"GENERAL_PROPERTY_ASSOCIATION('user defined attribute','',{general},{made})")

    def _measure(self, name: str, kind: str, value: float, unit: str) -> str:
        return self.instances.add(
            f"MEASURE_REPRESENTATION_ITEM({word(name)},{kind}({number(value)}),{self.units(unit)})"
        )

    def _property(self, name: str, description: str, shown: str, item: str, definition: str) -> str:
        made = self.instances.add(f"PROPERTY_DEFINITION({word(name)},{word(description)},{definition})")
        kept = self.instances.add(f"REPRESENTATION({word(shown)},({item}),{self.context})")
        self.instances.add(f"PROPERTY_DEFINITION_REPRESENTATION({made},{kept})")
        return made
