"""How numbers, units, keys and figures read on the page: SI inside, engineering units and few digits outside."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass

from fluxbore.design.performance import FIGURES, HEAVY
from fluxbore.design.rates import Measure, measure_of_figure, measure_of_key
from fluxbore.design.spec import Spec
from fluxbore.design.units import DIMENSIONS
from fluxbore.optimize.outcome import Limit
from fluxbore.reports.key_labels import FRAGMENTS, KEY_LABELS

DASH = "–"
"""Stands where a figure is not given."""

DIGITS = 4
"""Significant digits of a figure: finite elements are right to about 0.2 %."""

WEAK_FIELD = 0.1
"""T, below which the page gives flux densities in millitesla."""

SMALL_INERTIA = 1e-2
"""kg m^2, below which the page gives moments of inertia in g cm^2."""

SMALL_SHARE = 1e-3
"""Below which per cent have three digits rather than two decimals."""

_UNIT_SIGNS = {
    "N/sqrt(W)": "N/√W",
    "ohm": "Ω",
    "degC": "°C",
    "1/mm^2": "mm⁻²",
    "1": "",
}
"""Units that the page writes another way; `_sign` knows powers and micrometres in all others."""

_GREEK = {
    "tau": "τ",
    "mu": "µ",
    "lambda": "λ",
    "Delta": "Δ",
    "pi": "π",
    "phi": "φ",
    "psi": "ψ",
    "xi": "ξ",
    "eta": "η",
    "gamma": "γ",
    "sigma": "σ",
}


@dataclass(frozen=True, slots=True)
class Scale:
    """A unit of the page: ``shown = (si - offset) / factor``, with the number of decimals that the figures deserve."""

    unit: str
    factor: float
    offset: float = 0.0
    decimals: int = 3

    def number(self, value: float | None) -> str:
        """The number alone, a dash where there is none."""
        if value is None or not math.isfinite(value):
            return DASH
        return plain((value - self.offset) / self.factor, self.decimals)

    def quantity(self, value: float | None) -> str:
        """Number and unit."""
        shown = self.number(value)
        return shown if shown == DASH or not self.unit else f"{shown}\u00a0{self.unit}"

    def shown(self, value: float) -> float:
        """The bare number, for the axis of a figure."""
        return (value - self.offset) / self.factor


def plain(value: float, decimals: int) -> str:
    """Fixed decimals with a true minus sign; no minus zero."""
    text = f"{value:.{max(decimals, 0)}f}"
    if float(text) == 0:
        text = text.lstrip("-")
    return text.replace("-", "−")


def significant(value: float, digits: int = DIGITS) -> str:
    """This many significant digits, with a power of ten where plain decimals would be long."""
    if not math.isfinite(value):
        return DASH
    if value == 0 or 1e-3 <= abs(value) < 1e6:
        return f"{value:.{digits}g}".replace("-", "−") if abs(value) < 10**digits else plain(value, 0)
    mantissa, _, exponent = f"{value:.{digits - 1}e}".partition("e")
    return f"{mantissa}·10{_superscript(int(exponent))}".replace("-", "−")


def scale(dimension: str, values: Iterable[float | None], digits: int = DIGITS) -> Scale:
    """The unit and decimals in which these values of one dimension are best compared."""
    sizes = [abs(v) for v in values if v is not None and math.isfinite(v)]
    largest = max(sizes, default=0.0)
    smallest = min((v for v in sizes if v > largest / 100), default=0.0)
    if dimension == "fraction":
        return Scale("%", 0.01, decimals=_decimals(100 * smallest, 3) if 0 < largest < SMALL_SHARE else 2)
    if dimension == "count":
        least = min((v for v in sizes if v > largest / 1000), default=0.0)
        return Scale("", 1.0, decimals=0 if all(size.is_integer() for size in sizes) else _decimals(least, digits))
    if dimension == "power":
        return Scale("W", 1.0, decimals=_decimals(smallest, digits))
    table = DIMENSIONS[dimension]
    name = table.preferred
    if dimension == "flux density" and largest < WEAK_FIELD:
        name = "mT"
    elif dimension == "electric loading" and largest >= 1e3:
        name = "kA/m"
    elif dimension == "mass" and largest >= HEAVY:
        name = "kg"
    elif dimension == "rotational inertia" and largest < SMALL_INERTIA:
        name = "g cm^2"
    unit = table.units[name]
    size = abs((smallest - unit.offset) / unit.factor)
    return Scale(_sign(name), unit.factor, unit.offset, _decimals(size, digits))


def key_scale(spec: Spec, name: str, values: Iterable[float | None] = ()) -> Scale:
    """The scale of a dotted key: lengths keep up to three decimals of a millimetre, trailing zeros cut."""
    key = spec.kind.key(name)
    given = [v for v in values if v is not None]
    if key is None or key.kind != "quantity":
        return Scale("", 1.0, decimals=_needed(given, 1.0, 0.0))
    base = scale(key.dimension, given)
    return Scale(base.unit, base.factor, base.offset, _needed(given, base.factor, base.offset))


def key_range(spec: Spec, name: str, lower: float, upper: float) -> str:
    """``0.3 to 2.5 mm``, each number with the decimals it needs."""
    return f"{key_scale(spec, name, [lower]).number(lower)} to {key_scale(spec, name, [upper]).quantity(upper)}"


def figure_scale(name: str, values: Iterable[float | None]) -> Scale:
    """The scale of a figure of `Performance`."""
    return scale(FIGURES[name].dimension, values)


def subject_scale(spec: Spec, subject: str, values: Iterable[float | None]) -> Scale:
    """The scale of what a limit is about: a figure's name or a dotted key."""
    return figure_scale(subject, values) if subject in FIGURES else key_scale(spec, subject, values)


def subject_measure(spec: Spec, subject: str, size: float = 1.0) -> Measure:
    """The unit for differences of a figure of this size (SI), or of a dotted key."""
    if subject not in FIGURES:
        return measure_of_key(spec.kind.known(subject))
    if FIGURES[subject].dimension == "flux density" and abs(size) < WEAK_FIELD:
        return Measure(1e-3, "mT")
    if FIGURES[subject].dimension == "rotational inertia" and abs(size) < SMALL_INERTIA:
        return Measure(1e-7, "g cm^2")
    return measure_of_figure(subject, size)


def unit_sign(unit: Measure) -> str:
    """The unit as the page writes it; empty for plain numbers."""
    return _sign(unit.unit)


def _sign(name: str) -> str:
    """A unit of `fluxbore.design.units` as it is printed: ``kN/m³`` and ``µm/km`` for kN/m^3 and um/km."""
    printed = re.sub(r"\bum\b", "µm", name.replace("^2", "²").replace("^3", "³"))
    return _UNIT_SIGNS.get(name, printed)


def difference(unit: Measure, value: float, digits: int = 3, *, signed: bool = False) -> str:
    """A difference given in SI, ``+0.35 N/A``."""
    shown = significant(value / unit.factor, digits)
    sign = "+" if signed and value > 0 else ""
    return f"{sign}{shown}\u00a0{unit_sign(unit)}" if unit.unit else f"{sign}{shown}"


def percent(share: float, digits: int = 3) -> str:
    """``79.6 %``."""
    return f"{significant(100 * share, digits)}\u00a0%"


def figure_label(name: str) -> str:
    """``force_constant`` -> ``force constant``, with the words that a bare name lacks."""
    own = {
        "force_constant_linkage": "force constant, by flux linkage",
        "turns": "turns of a phase",
        "outer_diameter": "overall diameter",
        "length": "overall length",
        "cogging_force": "largest cogging force",
        "back_emf": "back-EMF",
        "no_load_speed": "no-load speed",
        "pneumatic_force_advance": "pneumatic force, advancing",
        "pneumatic_force_retract": "pneumatic force, retracting",
    }
    return own.get(name, name.replace("_", " "))


def meaning(name: str) -> str:
    """What a figure of `Performance` is, as a sentence without its end."""
    own = {
        "force_constant_linkage": "force constant from the fundamental of the phases’ flux linkages: 3/2 (π/τ) λ_1",
        "pneumatic_force_retract": "gauge pressure times the catalogue bore’s area less the shaft’s",
        "ring_flux_density": f"{FIGURES['ring_flux_density'].doc}: not the peak that the map of the field shows",
    }
    text = own.get(name, FIGURES[name].doc)
    return capital(greek(text).replace("^2", "²").replace("'", "’"))


def greek(text: str) -> str:
    """The names of Greek letters as letters: ``tau_f`` -> ``τ_f``."""
    return re.sub(r"[A-Za-z]+", lambda match: _GREEK.get(match.group(), match.group()), text)


def key_label(spec: Spec, name: str) -> str:
    """What a dotted key is called: the table's own short description, else the last part of its name.

    Descriptions that run on are cut at the first comma, colon or semicolon; those that go on from the key's name give
    way to it. Keys of several sections that share a label have the section behind it.
    """
    if name in KEY_LABELS:
        return KEY_LABELS[name]
    key = spec.kind.key(name)
    if key is None:
        return name.rpartition(".")[2].replace("_", " ")
    label = re.split(r"[;:,]", key.doc)[0].strip().replace("degC", "°C")
    alike = any(other.doc == key.doc and other.name != name for other in spec.kind.keys)
    if label.split()[0] in FRAGMENTS or label == "radial":
        label = key.leaf.replace("_", " ")
        alike = any(other.leaf == key.leaf and other.name != name for other in spec.kind.keys)
    return f"{label} ({name.split('.')[-2].replace('_', ' ')})" if alike else label


def subject_label(spec: Spec, subject: str) -> str:
    return figure_label(subject) if subject in FIGURES else key_label(spec, subject)


def symbol(spec: Spec, name: str) -> str:
    """The key's symbol as text, with Greek letters: ``tau_f`` -> ``τ_f``; empty without one."""
    key = spec.kind.key(name)
    if key is None:
        return ""
    return greek(key.symbol)


def limit_text(spec: Spec, limit: Limit) -> str:
    """``at most 21.3 mT``."""
    shown = subject_scale(spec, limit.subject, [limit.limit]).quantity(limit.limit)
    return f"{'at most' if limit.sense == '<=' else 'at least'} {shown}"


def room_text(spec: Spec, limit: Limit, margin: float) -> str:
    """The size of a relative margin: ``0.17 %`` of the limit, or in its unit where that is no share of its number."""
    if limit.scale is None:
        return f"{100 * abs(margin):.2g}\u00a0%"
    return difference(subject_measure(spec, limit.subject, limit.scale), abs(margin) * limit.scale, 2)


def change(before: float | None, after: float | None) -> str:
    """The relative change in per cent, signed; empty where it means nothing."""
    if before is None or after is None or not before or not (math.isfinite(before) and math.isfinite(after)):
        return ""
    percent = 100 * (after - before) / abs(before)
    if abs(percent) < 0.005:
        return "±0\u00a0%"
    decimals = 0 if abs(percent) >= 100 else 1 if abs(percent) >= 1 else 2
    return f"{'+' if percent > 0 else ''}{plain(percent, decimals)}\u00a0%"


def duration(seconds: float) -> str:
    """``42 s`` or ``3 min 5 s``."""
    if seconds < 10:
        return f"{seconds:.1f} s"
    whole = round(seconds)
    return f"{whole} s" if whole < 120 else f"{whole // 60} min {whole % 60} s"


def millimetres(length: float) -> str:
    """``5.143 mm``, without trailing zeros."""
    return f"{significant(length * 1e3)}\u00a0mm"


def capital(text: str) -> str:
    """The first letter large, the rest as it is."""
    return text[:1].upper() + text[1:]


def listing(words: Iterable[str]) -> str:
    """``a, b and c``."""
    items = list(words)
    return items[0] if len(items) == 1 else f"{', '.join(items[:-1])} and {items[-1]}" if items else ""


def _decimals(size: float, digits: int) -> int:
    """Decimals that leave this many significant digits to a number of this size, none needlessly beyond it."""
    if size <= 0 or not math.isfinite(size):
        return 1
    return min(max(digits - 1 - math.floor(math.log10(size)), 0), 8)


def _needed(values: Iterable[float], factor: float, offset: float, most: int = 3) -> int:
    """Fewest decimals, up to ``most``, at which each of these values is exact; ``most`` where it never is."""
    shown = [(value - offset) / factor for value in values if math.isfinite(value)]
    exact = (d for d in range(most) if all(abs(round(v, d) - v) < 1e-9 * max(abs(v), 1.0) for v in shown))
    return next(exact, most)


def _superscript(number: int) -> str:
    return str(number).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
