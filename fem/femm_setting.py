"""Changes and sweeps of a FEMM model as they are typed: KEY=VALUE, KEY=FIRST:LAST:STEP, KEY=VALUE,VALUE,..."""

from __future__ import annotations

import re
from decimal import ROUND_FLOOR, Decimal

from fluxbore.design.errors import SpecError, shown
from fluxbore.fem.femm_value import bare_number, spelt

MOST_VALUES = 10_000
"""Of a sweep."""


def setting(text: str) -> tuple[str, str]:
    """Key and value of KEY=VALUE. Raises SpecError where there is none of either."""
    quoted = False
    for at, sign in enumerate(text):
        quoted ^= sign == '"'
        if sign == "=" and not quoted:
            key, value = text[:at].strip(), text[at + 1 :].strip()
            if key and value:
                return key, value
            break
    raise SpecError(f"A change must be KEY=VALUE, such as circuit.coil.current=2; got {shown(text)}.")


def sweep_values(text: str) -> tuple[str, tuple[str, ...]]:
    """The key and the values of KEY=FIRST:LAST:STEP or KEY=VALUE,VALUE,...; a unit after LAST or STEP is every value's.

    Decimal arithmetic: 0:1:0.1 has 0.3, not its neighbour. Raises SpecError, also for more than `MOST_VALUES`.
    """
    key, values = setting(text)
    if ":" not in values:
        return key, _counted(key, [part.strip() for part in values.split(",")])
    parts = [part.strip() for part in values.split(":")]
    last, unit = _with_unit(parts[-1])
    numbers = [bare_number(part) for part in (*parts[:-1], last)]
    known = [Decimal(repr(number)) for number in numbers if number is not None]
    if len(known) != 3:
        raise SpecError(f"{spelt(key)} must be swept by FIRST:LAST:STEP, such as -2:2:0.5; got {shown(values)}.")
    first, end, step = known
    if step == 0 or (end - first) * step < 0:
        raise SpecError(f"{spelt(key)} must be swept by a step that leads from first to last; got {shown(values)}.")
    count = ((end - first) / step).to_integral_value(ROUND_FLOOR) + 1
    if count > MOST_VALUES:
        raise SpecError(f"{spelt(key)} must take at most {MOST_VALUES} values; got {count:.4g}.")
    tail = f" {unit}" if unit else ""
    return key, tuple(f"{float(first + k * step):.15g}{tail}" for k in range(int(count)))


def _counted(key: str, values: list[str]) -> tuple[str, ...]:
    if len(values) > MOST_VALUES:
        raise SpecError(f"{spelt(key)} must take at most {MOST_VALUES} values; got {len(values)}.")
    if not all(values):
        raise SpecError(f"{spelt(key)} must have a value between commas; got none.")
    return tuple(values)


def _with_unit(text: str) -> tuple[str, str]:
    """A number and the unit behind it, each perhaps empty."""
    match = re.fullmatch(r"([-+0-9.]*(?:[eE][-+]?[0-9]+)?)\s*(.*)", text, re.DOTALL)
    return (match[1], match[2]) if match else ("", text)
