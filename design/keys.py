"""The vocabulary of a specification: which dotted keys there are, what each may hold, and which exclude one another.

A table of `Key` is the one place where a key is declared; the reader, the JSON Schema, the commented template and the
error sentences are all made from it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from decimal import Decimal

from fluxbore.design.errors import SpecError, one_line, shown
from fluxbore.design.units import DIFFERENCES, DIMENSIONS, format_quantity, parse_quantity

LONGEST_WORD = 400
"""Characters of a name or a source; more than this is some other text in the wrong place."""

Value = float | int | str
"""What a key holds once read: an SI float, a count, or a word."""

Values = Mapping[str, Value]
"""Dotted key -> value."""


@dataclass(frozen=True, slots=True)
class Key:
    """One key of the specification.

    name : dotted, ``"actuator.back_yoke.thickness"``.
    kind : "quantity" (number and unit of ``dimension``), "number", "integer" or "word".
    above : exclusive lower limit; minimum, maximum : inclusive limits; all in SI.
    default : the value taken when the key is absent; ``None`` makes the key required, unless it is one of
        `Alternatives` or ``optional``.
    """

    name: str
    doc: str
    kind: str = "quantity"
    dimension: str = "length"
    symbol: str = ""
    above: float | None = None
    minimum: float | None = None
    maximum: float | None = None
    default: Value | None = None
    optional: bool = False
    choices: tuple[str, ...] = ()

    @property
    def section(self) -> str:
        return self.name.rpartition(".")[0]

    @property
    def of_design(self) -> bool:
        """Whether it describes the design or its operating point: what a study may move and figures depend on."""
        return self.name.partition(".")[0] not in ("solver", "benchmark", "drawing")

    @property
    def leaf(self) -> str:
        return self.name.rpartition(".")[2]

    def read(self, raw: object) -> Value:
        """The value that the file's ``raw`` stands for; SpecError names the key, the limit and what was found."""
        if self.kind == "quantity":
            value: Value = parse_quantity(raw, self.dimension, self.name)
        elif self.kind == "integer":
            if not isinstance(raw, int) or isinstance(raw, bool):
                raise SpecError(f"{self.name} must be a whole number, such as 4; got {shown(raw)}.")
            value = raw
        elif self.kind == "number":
            if not isinstance(raw, (int, float)) or isinstance(raw, bool) or not _finite(raw):
                raise SpecError(f"{self.name} must be a plain finite number without a unit; got {shown(raw)}.")
            value = float(raw)
        else:
            if not isinstance(raw, str) or not raw.strip():
                raise SpecError(f"{self.name} must be text in quotes; got {shown(raw)}.")
            value = raw.strip()
            if one_line(value) != value:
                raise SpecError(f"{self.name} must be one line of printable text; got {shown(raw)}.")
            if len(value) > LONGEST_WORD:
                raise SpecError(f"{self.name} must have at most {LONGEST_WORD} characters; got {len(value)}.")
        self.check(value)
        return value

    def check(self, value: Value) -> None:
        """Raise SpecError where the value breaks a limit of this key."""
        if self.choices and value not in self.choices:
            raise SpecError(f"{self.name} must be one of {', '.join(self.choices)}; got {shown(value)}.")
        if isinstance(value, str):
            return
        if not _finite(value):
            raise SpecError(f"{self.name} must be finite; got {shown(value)}.")
        if self.above is not None and not value > self.above:
            raise SpecError(f"{self.name} must exceed {self.show(self.above)}; got {self.show(value)}.")
        if self.minimum is not None and value < self.minimum:
            raise SpecError(f"{self.name} must be at least {self.show(self.minimum)}; got {self.show(value)}.")
        if self.maximum is not None and value > self.maximum:
            raise SpecError(f"{self.name} must be at most {self.show(self.maximum)}; got {self.show(value)}.")

    @property
    def difference(self) -> Key:
        """A key for a step of this one's values: of 5 K and not 5 degC, which is 278 K."""
        return replace(
            self, dimension=DIFFERENCES.get(self.dimension, self.dimension), above=None, minimum=None, maximum=None
        )

    def show(self, value: Value, digits: int = 6) -> str:
        """The value as a person would write it: in the preferred unit."""
        if self.kind == "quantity" and not isinstance(value, str):
            return format_quantity(value, self.dimension, digits)
        return f"{value:.{digits}g}" if isinstance(value, float) else str(value)

    def write(self, value: Value) -> str:
        """The value as TOML, exact to at least 15 digits."""
        if self.kind == "quantity" and not isinstance(value, str):
            return f'"{_exact(value, self.dimension)}"'
        if isinstance(value, str):
            return toml_string(value)
        return repr(float(value)) if self.kind == "number" else str(value)


@dataclass(frozen=True, slots=True)
class Alternatives:
    """Keys of which exactly ``count`` are given, because the others follow from them by ``rule``."""

    keys: tuple[str, ...]
    count: int
    rule: str

    @property
    def demand(self) -> str:
        """How many of the keys it takes, in words."""
        return f"exactly {_count_word(self.count)}"

    def check(self, given: Values) -> None:
        """Raise SpecError where too many or too few of the keys are given."""
        present = [key for key in self.keys if key in given]
        if len(present) == self.count:
            return
        wanted = f"{self.demand} of {', '.join(self.keys)} ({self.rule})"
        got = ", ".join(present) or "none"
        kind = "over-determined" if len(present) > self.count else "under-determined"
        raise SpecError(f"The specification is {kind}: give {wanted}; got {got}.")


def _exact(value: float, dimension: str) -> str:
    """A text whose reading gives this very float back where the unit allows it, else the closest of 17 digits."""
    preferred = DIMENSIONS[dimension].preferred
    unit = DIMENSIONS[dimension].units[preferred]
    if unit.offset == 0.0:
        number = Decimal(repr(float(value))) / Decimal(repr(unit.factor))
        # Plain digits for sizes that people write so; Decimal's own form of 10 is 1E+1.
        plain = f"{number:f}" if -7 <= number.adjusted() <= 9 else f"{number.normalize():E}"
        if "." in plain and "E" not in plain:
            plain = plain.rstrip("0").rstrip(".")
        text = f"{plain} {preferred}"
        if parse_quantity(text, dimension, "value") == value:
            return text
    for digits in (6, 9, 12, 15, 16, 17):
        text = format_quantity(value, dimension, digits)
        if parse_quantity(text, dimension, "value") == value:
            return text
    return format_quantity(value, dimension, 17)


def toml_string(text: str) -> str:
    """A TOML basic string (TOML 1.0, section String)."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c >= " " and c != "\x7f" else f"\\u{ord(c):04x}" for c in escaped) + '"'


def _count_word(count: int) -> str:
    return {1: "one", 2: "two", 3: "three"}.get(count, str(count))


def _finite(number: float) -> bool:
    """Whether a float holds it; a whole number may be too large for one."""
    try:
        return math.isfinite(number)
    except OverflowError:
        return False
