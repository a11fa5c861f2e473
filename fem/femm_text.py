"""The text of a FEMM file taken apart: settings, properties and rows, each with its line number, none yet understood.

A line is ``[Key] = value``, ``<Key> = value`` or, after a key that announces their number, a row of cells. Keys come in
any order and case; the last of two settings counts, as in FEMM.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from fluxbore.design.errors import SpecError, one_line, shown

LARGEST = 1e30
"""The greatest magnitude of a number: beyond any quantity in any unit, and its square is still finite."""

LONGEST = 100
"""Characters of a number."""

ANNOUNCED_PROPERTIES = {"pointprops": "point", "bdryprops": "bdry", "blockprops": "block", "circuitprops": "circuit"}
ANNOUNCED_ROWS = ("numpoints", "numsegments", "numarcsegments", "numholes", "numblocklabels")

_KEY = re.compile(r"\s*(?:\[([^\]]*)\]|<([^>]*)>)\s*=?\s*(.*)", re.DOTALL)
_NUMBER = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")


@dataclass(frozen=True, slots=True)
class Source:
    """name : the file's, as messages begin with it."""

    name: str = "The file"

    def error(self, sentence: str, line: int | None = None) -> SpecError:
        """The error whose sentence is ``sentence`` after the file's name and the line, from 1."""
        place = self.name if line is None else f"{self.name}, line {line}"
        return SpecError(f"{one_line(place)}: {one_line(sentence)}")

    def number(self, text: str, what: str, line: int) -> float:
        """A finite number. float() alone would take nan, inf, 1_0 and other alphabets' digits."""
        value = float(text) if len(text) <= LONGEST and _NUMBER.fullmatch(text) else float("nan")
        if not abs(value) <= LARGEST:
            raise self.error(f"{what} must be a number of at most {LARGEST:g}; got {shown(text)}.", line)
        return value

    def integer(self, text: str, what: str, line: int) -> int:
        if len(text) < 10 and text.isascii() and text.isdigit():  # most cells of a large drawing
            return int(text)
        value = self.number(text, what, line)
        if not (value.is_integer() and abs(value) < 2**31):
            raise self.error(f"{what} must be a whole number; got {shown(text)}.", line)
        return int(value)


@dataclass(frozen=True, slots=True)
class Entry:
    """What follows a key's equals sign."""

    source: Source
    key: str
    text: str
    line: int

    def number(self, power: int = 0) -> float:
        """Times 10^power."""
        value = self.source.number(self.text, self.key, self.line)
        return shifted(self.text, power) if power else value

    def integer(self) -> int:
        return self.source.integer(self.text, self.key, self.line)

    def string(self) -> str:
        """From the first to the last quote, so that a name may hold quotes; all of it where there are none."""
        return unquoted(self.text)

    def error(self, sentence: str) -> SpecError:
        return self.source.error(f"{self.key} {sentence}", self.line)


@dataclass(frozen=True, slots=True)
class Row:
    """Cells in one line after an announcement. text : a string in quotes at its end, empty for none."""

    source: Source
    line: int
    cells: tuple[str, ...]
    text: str = ""

    def number(self, at: int, what: str, default: float | None = None) -> float:
        """Cell ``at``, or ``default`` where the row is shorter, as older files are."""
        if at >= len(self.cells) and default is not None:
            return default
        return self.source.number(self._cell(at, what), what, self.line)

    def integer(self, at: int, what: str, default: int | None = None) -> int:
        if at >= len(self.cells) and default is not None:
            return default
        return self.source.integer(self._cell(at, what), what, self.line)

    def reference(self, at: int, what: str, count: int) -> int | None:
        """A number from 1 to ``count`` as one from 0, or None for 0 and where the row is shorter."""
        value = self.integer(at, what, 0)
        if not 0 <= value <= count:
            raise self.error(f"{what} must be one of the {count} that the file has, or 0 for none; got {value}.")
        return value - 1 if value else None

    def error(self, sentence: str) -> SpecError:
        return self.source.error(sentence, self.line)

    def _cell(self, at: int, what: str) -> str:
        if at >= len(self.cells):
            raise self.error(f"{what} must stand in column {at + 1}; the row has {len(self.cells)}.")
        return self.cells[at]


@dataclass(slots=True)
class Property:
    """The keys between <BeginX> and <EndX>. kind : X in lower case. curve : the rows after <BHPoints>."""

    source: Source
    kind: str
    line: int
    entries: dict[str, Entry] = field(default_factory=dict)
    curve: tuple[Row, ...] = ()

    def number(self, key: str, default: float = 0.0, power: int = 0, most: float = LARGEST) -> float:
        """Times 10^power. most : its greatest magnitude, as the file has it."""
        if key not in self.entries:
            return default
        value = self.entries[key].number()
        if abs(value) > most:
            raise self.error(key, f"must be at most {most:g}; got {value:g}.")
        return self.entries[key].number(power) if power else value

    def integer(self, key: str, default: int = 0) -> int:
        return self.entries[key].integer() if key in self.entries else default

    def string(self, key: str, default: str) -> str:
        return self.entries[key].string() if key in self.entries else default

    def error(self, key: str, sentence: str) -> SpecError:
        return self.entries[key].error(sentence)


@dataclass(slots=True)
class FemmText:
    """A file in pieces. rows : of each announcing key, absent where the key is."""

    source: Source
    settings: dict[str, Entry] = field(default_factory=dict)
    properties: dict[str, list[Property]] = field(default_factory=dict)
    rows: dict[str, tuple[Row, ...]] = field(default_factory=dict)


def shifted(text: str, power: int) -> float:
    """The number times 10^power, rounded once: a file's MA/m² and the A/m² from it give each other back exactly."""
    mantissa, _, exponent = text.lower().partition("e")
    return float(f"{mantissa}e{int(exponent or 0) + power}")


def unquoted(text: str) -> str:
    """What stands between the first and the last quote, or the whole text where there are not two."""
    first, last = text.find('"'), text.rfind('"')
    return text[first + 1 : last] if last > first else text.strip().strip('"')


def take_apart(text: str, source: Source) -> FemmText:
    """Raises SpecError where a line cannot be placed, or where fewer rows stand than are announced."""
    # Not splitlines(): that also breaks at the odd separators that a name may hold.
    return _Scanner(source, text.replace("\r\n", "\n").replace("\r", "\n").split("\n")).scan()


class _Scanner:
    def __init__(self, source: Source, lines: list[str]) -> None:
        self.source = source
        self.lines = lines
        self.at = 0
        self.found = FemmText(source)
        self.open: Property | None = None

    def scan(self) -> FemmText:
        while self.at < len(self.lines):
            line = self.lines[self.at].strip()
            self.at += 1
            if line:
                self.place(line)
        if self.open is not None:
            raise self.source.error(f"<Begin{self.open.kind}> must be closed by <End{self.open.kind}>.", self.open.line)
        for key, kind in ANNOUNCED_PROPERTIES.items():
            announced = self.found.settings.get(key)
            count = len(self.found.properties.setdefault(kind, []))
            if announced is not None and announced.integer() != count:
                raise announced.error(f"must be the number of its properties, {count}; got {shown(announced.text)}.")
        return self.found

    def place(self, line: str) -> None:
        match = _KEY.fullmatch(line)
        if match is None:
            kind = "a row that no key announces" if _NUMBER.match(line) else "no key in [] or <>"
            raise self.source.error(f"{shown(line)} is {kind}.", self.at)
        square, angled, value = match.groups()
        shape, name = ("[{}]", square) if square is not None else ("<{}>", angled)
        key = name.strip().lower()
        entry = Entry(self.source, shape.format(shown(name)[1:-1]), value.strip(), self.at)
        if square is None and key.startswith("begin"):
            self.begin(key.removeprefix("begin"), entry)
        elif square is None and key.startswith("end"):
            self.end(key.removeprefix("end"), entry)
        elif square is not None and key in ANNOUNCED_ROWS:
            if key in self.found.rows:
                raise entry.error("must stand once; this is the second.")
            self.found.rows[key] = self.take_rows(entry)
        elif self.open is not None and square is None:
            self.open.entries[key] = entry
            if key == "bhpoints":
                self.open.curve = self.take_rows(entry)
        else:
            self.found.settings[key] = entry
            if key == "solution":  # of an .ans file: what follows are its mesh and potentials
                self.at = len(self.lines)

    def begin(self, kind: str, entry: Entry) -> None:
        if self.open is not None:
            raise entry.error(f"must not stand within the property that line {self.open.line} begins.")
        self.open = Property(self.source, kind, self.at)

    def end(self, kind: str, entry: Entry) -> None:
        if self.open is None or self.open.kind != kind:
            raise entry.error(f"must end a property that <Begin{entry.key[4:]} began.")
        self.found.properties.setdefault(kind, []).append(self.open)
        self.open = None

    def take_rows(self, entry: Entry) -> tuple[Row, ...]:
        count = entry.integer()
        if count < 0:
            raise entry.error(f"must be a number of rows; got {count}.")
        rows: list[Row] = []
        while len(rows) < count:
            line = self.lines[self.at].strip() if self.at < len(self.lines) else "["
            if line.startswith(("[", "<")):
                raise entry.error(f"must have {count} rows after it; got {len(rows)}.")
            self.at += 1
            if line:
                cells, quote, tail = line.partition('"')
                rows.append(Row(self.source, self.at, tuple(cells.split()), unquoted(quote + tail) if quote else ""))
        return tuple(rows)
