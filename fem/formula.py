"""Directions of magnetisation as formulas of the position, in the small language that FEMM takes them in.

FEMM hands the text to Lua 4 with x, y (r, z), theta and R set, so this follows Lua 4: its operators and their order of
precedence (reference manual 4.0, section 4.5), angles of sin, atan2 and the like in radians, and truth, where a
comparison gives 1 or nil and ``c and a or b`` chooses. nil is NaN here: it spreads through arithmetic, and a formula
that ends in it is refused, as FEMM refuses it. FEMM reckons in complex numbers; this in real ones.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import reduce
from typing import NamedTuple

import numpy as np

from fluxbore.design.errors import SpecError, shown
from fluxbore.fem.mesh import Floats

LONGEST = 500
"""Characters of a formula."""

DEEPEST = 50
"""Brackets and signs within one another."""

_Node = Callable[[Mapping[str, Floats]], Floats]

VARIABLES = ("x", "y", "r", "z", "theta", "R")
CONSTANTS = {"PI": math.pi, "pi": math.pi, "Pi": math.pi}


class _Function(NamedTuple):
    """least, most : how many arguments; most None for any number."""

    call: Callable[..., Floats]
    least: int = 1
    most: int | None = 1


FUNCTIONS: dict[str, _Function] = {
    "abs": _Function(np.abs),
    "sin": _Function(np.sin),
    "cos": _Function(np.cos),
    "tan": _Function(np.tan),
    "asin": _Function(np.arcsin),
    "acos": _Function(np.arccos),
    "atan": _Function(np.arctan),
    "atan2": _Function(np.arctan2, 2, 2),
    "sinh": _Function(np.sinh),
    "cosh": _Function(np.cosh),
    "tanh": _Function(np.tanh),
    "sqrt": _Function(np.sqrt),
    "exp": _Function(np.exp),
    "log": _Function(np.log),
    "log10": _Function(np.log10),
    "floor": _Function(np.floor),
    "ceil": _Function(np.ceil),
    "mod": _Function(np.fmod, 2, 2),
    "deg": _Function(np.degrees),
    "rad": _Function(np.radians),
    "min": _Function(lambda *values: reduce(np.minimum, values), 1, None),
    "max": _Function(lambda *values: reduce(np.maximum, values), 1, None),
}
"""Those of FEMM's mathematics library that have one real value."""


@dataclass(frozen=True, slots=True)
class Formula:
    """text : as the file has it. Two formulas of the same text are equal."""

    text: str
    _root: _Node = field(compare=False, repr=False)

    def evaluate(self, x: Floats, y: Floats) -> Floats:
        """Degrees from the x (r) axis towards y (z) at x, y (any shape, the file's unit).

        The same in planar and axisymmetric files: FEMM gives r and z the values of x and y in one, x and y those of r
        and z in the other; theta is their polar angle in degrees and R the distance from the origin in both. Raises
        SpecError, with the position, where the formula has no finite value.
        """
        x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
        values = {"x": x, "y": y, "r": x, "z": y, "theta": np.degrees(np.arctan2(y, x)), "R": np.hypot(x, y)}
        with np.errstate(all="ignore"):
            degrees = np.broadcast_to(self._root(values), x.shape)
        bad = np.flatnonzero(~np.isfinite(degrees))
        if bad.size:
            at = f"({x.flat[bad[0]]:.6g}, {y.flat[bad[0]]:.6g})"
            raise SpecError(f"The formula {shown(self.text)} must have a finite value everywhere; it has none at {at}.")
        return np.array(degrees)


def parse_formula(text: str) -> Formula:
    """Read a formula. Raises SpecError that names what is wrong; nothing but arithmetic can be said."""
    if len(text) > LONGEST:
        raise SpecError(f"A formula must have at most {LONGEST} characters; {shown(text)} has {len(text)}.")
    return Formula(text, _Parser(text).whole())


class _Operator(NamedTuple):
    """left, right : binding to the operand before and after; a weaker right than left groups from the right."""

    left: int
    right: int
    call: Callable[[Floats, Floats], Floats]


def _truth(test: Callable[[Floats, Floats], Floats]) -> Callable[[Floats, Floats], Floats]:
    return lambda a, b: np.where(test(a, b), 1.0, np.nan)


_OPERATORS = {
    "and": _Operator(1, 1, lambda a, b: np.where(np.isnan(a), a, b)),
    "or": _Operator(1, 1, lambda a, b: np.where(np.isnan(a), b, a)),
    "<": _Operator(2, 2, _truth(np.less)),
    ">": _Operator(2, 2, _truth(np.greater)),
    "<=": _Operator(2, 2, _truth(np.less_equal)),
    ">=": _Operator(2, 2, _truth(np.greater_equal)),
    "==": _Operator(2, 2, _truth(np.equal)),
    "~=": _Operator(2, 2, _truth(np.not_equal)),
    "+": _Operator(5, 5, np.add),
    "-": _Operator(5, 5, np.subtract),
    "*": _Operator(6, 6, np.multiply),
    "/": _Operator(6, 6, np.divide),
    "^": _Operator(9, 8, np.power),
}
_UNARY = 7
_TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<name>[A-Za-z_][A-Za-z_0-9]*)|(?P<sign><=|>=|==|~=|[-+*/^<>(),]))"
)


class _Parser:
    """Precedence climbing: each rule returns the function that evaluates what it has read."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.depth = 0
        self.at = 0
        self.tokens: list[tuple[str, str]] = []
        # Lua's comments: a doubled minus sign is none, and FEMM ignores what follows it.
        source, position = text.partition("--")[0].rstrip(), 0
        while position < len(source):
            match = _TOKEN.match(source, position)
            if match is None or match.lastgroup is None:
                raise self.error(f"{shown(source[position:].strip())} cannot be read")
            self.tokens.append((match.lastgroup, match[match.lastgroup]))
            position = match.end()

    def error(self, problem: str) -> SpecError:
        return SpecError(f"The formula {shown(self.text)} must be an expression of {', '.join(VARIABLES)}; {problem}.")

    def whole(self) -> _Node:
        node = self.expression(0)
        if self.at < len(self.tokens):
            raise self.error(f"{shown(self.tokens[self.at][1])} stands where it should end")
        return node

    def take(self) -> tuple[str, str]:
        if self.at == len(self.tokens):
            raise self.error("it ends too early" if self.tokens else "it is empty")
        self.at += 1
        return self.tokens[self.at - 1]

    def peek(self) -> str:
        return self.tokens[self.at][1] if self.at < len(self.tokens) else ""

    def expect(self, sign: str) -> None:
        if self.peek() != sign:
            raise self.error(f'"{sign}" is missing before {shown(self.peek()) if self.peek() else "its end"}')
        self.at += 1

    def expression(self, limit: int) -> _Node:
        """Everything that binds more tightly than ``limit``."""
        self.depth += 1
        if self.depth > DEEPEST:
            raise self.error(f"more than {DEEPEST} brackets or signs stand within one another")
        node = self.operand()
        while (operator := _OPERATORS.get(self.peek())) is not None and operator.left > limit:
            self.at += 1
            node = _binary(operator.call, node, self.expression(operator.right))
        self.depth -= 1
        return node

    def operand(self) -> _Node:
        kind, word = self.take()
        if kind == "number":
            return _constant(float(word))
        if word == "-":
            inner = self.expression(_UNARY)
            return lambda values: -inner(values)
        if word == "not":
            denied = self.expression(_UNARY)
            return lambda values: np.where(np.isnan(denied(values)), 1.0, np.nan)
        if word == "(":
            node = self.expression(0)
            self.expect(")")
            return node
        if kind == "name" and word in FUNCTIONS:
            return self.call(word)
        if word in CONSTANTS:
            return _constant(CONSTANTS[word])
        if word in VARIABLES:
            return lambda values: values[word]
        raise self.error(f"{shown(word)} is {'not known' if kind == 'name' else 'out of place'}")

    def call(self, name: str) -> _Node:
        function = FUNCTIONS[name]
        self.expect("(")
        arguments = [self.expression(0)]
        while self.peek() == ",":
            self.at += 1
            arguments.append(self.expression(0))
        self.expect(")")
        if len(arguments) < function.least or (function.most is not None and len(arguments) > function.most):
            raise self.error(f"{name} takes {function.least} value{'s'[: function.least - 1]}, not {len(arguments)}")
        return lambda values: function.call(*(argument(values) for argument in arguments))


def _constant(value: float) -> _Node:
    return lambda values: np.asarray(value)


def _binary(call: Callable[[Floats, Floats], Floats], left: _Node, right: _Node) -> _Node:
    return lambda values: call(left(values), right(values))
