"""A reader of STEP files on their tokens alone (ISO 10303-21), so that no CAD kernel vouches for its own files."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any

TOKEN = re.compile(
    r"\s+|'(?:[^']|'')*'|#\d+|\.[A-Z_]+\.|[-+]?\d+\.\d*(?:E[-+]?\d+)?|[-+]?\d+|[A-Z_][A-Z0-9_]*|[(),;=$*]"
)


@dataclass(frozen=True)
class Instance:
    """One instance: simple ones have one name, complex ones several. arguments : by name."""

    arguments: dict[str, list[Any]]

    @property
    def name(self) -> str:
        return next(iter(self.arguments)) if len(self.arguments) == 1 else ""

    @property
    def values(self) -> list[Any]:
        return next(iter(self.arguments.values()))


class StepFile:
    """The instances by their references, "#12", and the header's by their names."""

    def __init__(self, text: str) -> None:
        assert text.isascii()
        assert text.startswith("ISO-10303-21;")
        assert text.rstrip().endswith("END-ISO-10303-21;")
        head, _, data = text.partition("DATA;")
        self.header = {item.name: item.values for item in _statements(head.partition("HEADER;")[2])}
        self.instances: dict[str, Instance] = {}
        for statement in _split(data.rpartition("ENDSEC;")[0]):
            reference, equals, *rest = statement
            assert equals == "="
            assert reference not in self.instances, reference
            self.instances[reference] = _instance(rest)
        for instance in self.instances.values():  # nothing points to what is not there
            for reference in _references(list(instance.arguments.values())):
                assert reference in self.instances, reference

    def all(self, name: str) -> dict[str, list[Any]]:
        return {at: found.arguments[name] for at, found in self.instances.items() if name in found.arguments}

    def value(self, reference: str) -> list[Any]:
        return self.instances[reference].values

    def products(self) -> dict[str, list[Any]]:
        """Arguments by product definition."""
        formations = self.all("PRODUCT_DEFINITION_FORMATION") | self.all(
            "PRODUCT_DEFINITION_FORMATION_WITH_SPECIFIED_SOURCE"
        )
        return {at: self.value(formations[item[2]][2]) for at, item in self.all("PRODUCT_DEFINITION").items()}

    def names(self) -> list[str]:
        return [item[1] for item in self.all("PRODUCT").values()]

    def usages(self) -> list[tuple[str, str, str]]:
        """Name of the assembly, of its component, and of this use of it."""
        products = self.products()
        found = self.all("NEXT_ASSEMBLY_USAGE_OCCURRENCE").values()
        assert len({item[0] for item in found}) == len(found)
        return [(products[item[3]][1], products[item[4]][1], item[1]) for item in found]

    def properties(self) -> dict[str, dict[str, Any]]:
        """Texts and numbers (in their units) by the name of a product, or of a use, and of the property."""
        owners = {at: item[1] for at, item in self.products().items()}
        owners |= {at: item[1] for at, item in self.all("NEXT_ASSEMBLY_USAGE_OCCURRENCE").items()}
        definitions = self.all("PROPERTY_DEFINITION")
        found: dict[str, dict[str, Any]] = {}
        for made, representation in self.all("PROPERTY_DEFINITION_REPRESENTATION").values():
            name, description, owner = definitions[made]
            (item,) = self.value(representation)[1]
            key = name if description == "user defined attribute" else description
            found.setdefault(owners[owner], {})[key] = self.measured(item)
        return found

    def measured(self, reference: str) -> Any:
        """A text; a number with its unit's name; a point."""
        item = self.instances[reference]
        if item.name == "DESCRIPTIVE_REPRESENTATION_ITEM":
            return item.values[1]
        if item.name == "MEASURE_REPRESENTATION_ITEM":
            return item.values[1][1][0], self.unit(item.values[2])
        return tuple(item.values[1]) if item.name == "CARTESIAN_POINT" else item.values[1]

    def unit(self, reference: str) -> str:
        found = self.instances[reference].arguments
        if "SI_UNIT" in found:
            return "".join(word.strip(".") for word in found["SI_UNIT"] if word != "$")
        parts = (self.value(element) for element in found["DERIVED_UNIT"][0])
        return " ".join(f"{self.unit(unit)}^{power:g}" for unit, power in parts)

    def colours(self) -> Counter[tuple[float, ...]]:
        return Counter(tuple(item[1:]) for item in self.all("COLOUR_RGB").values())


def read(path: Path) -> StepFile:
    return StepFile(path.read_text(encoding="ascii"))


def _split(text: str) -> list[list[str]]:
    statements: list[list[str]] = [[]]
    place = 0
    while place < len(text):
        found = TOKEN.match(text, place)
        assert found is not None, text[place : place + 40]
        place = found.end()
        token = found[0]
        if token == ";":
            statements.append([])
        elif not token.isspace():
            statements[-1].append(token)
    assert statements[-1] in ([], ["ENDSEC"])
    return statements[:-1]


def _statements(text: str) -> list[Instance]:
    return [_instance(statement) for statement in _split(text) if statement != ["ENDSEC"]]


def _instance(tokens: list[str]) -> Instance:
    if tokens[0] != "(":
        arguments, rest = _list(tokens, 1)
        assert rest == len(tokens)
        return Instance({tokens[0]: arguments})
    found, place = {}, 1
    while tokens[place] != ")":
        found[tokens[place]], place = _list(tokens, place + 1)
    assert place == len(tokens) - 1
    return Instance(found)


def _list(tokens: list[str], place: int) -> tuple[list[Any], int]:
    """What stands between the bracket at this place and its partner, and the place behind that."""
    assert tokens[place] == "("
    items: list[Any] = []
    place += 1
    while tokens[place] != ")":
        token = tokens[place]
        if token == ",":
            place += 1
        elif token == "(":
            item, place = _list(tokens, place)
            items.append(item)
        elif token[0].isalpha():  # a typed value
            item, place = _list(tokens, place + 1)
            items.append([token, item])
        else:
            items.append(_value(token))
            place += 1
    return items, place + 1


def _value(token: str) -> Any:
    if token[0] == "'":
        return _text(token[1:-1])
    if token[0] in "#$*" or (token[0] == "." and token[-1] == "."):
        return token
    return float(token) if "." in token else int(token)


def _text(coded: str) -> str:
    def letters(found: re.Match[str]) -> str:
        return bytes.fromhex(found[2]).decode({"2": "utf-16-be", "4": "utf-32-be"}[found[1]])

    halves = coded.replace("''", "'").split("\\\\")
    return "\\".join(re.sub(r"\\X([24])\\((?:[0-9A-F]{4})+)\\X0\\", letters, half) for half in halves)


def _references(values: Any) -> list[str]:
    if isinstance(values, list):
        return [found for value in values for found in _references(value)]
    return [values] if isinstance(values, str) and re.fullmatch(r"#\d+", values) else []
