"""Read magnetics files of FEMM 4 (.fem), and say in one sentence what is wrong or not supported in one.

The format is David Meeker's; FEMM's manual (4.2) explains the quantities, Schöps' "FEMMview file format" (2009) the
rows. What magnetostatics does not need (mesh options, hysteresis, eddy currents) is passed over, and so are unknown
keys, which newer versions may add.
"""

from __future__ import annotations

from pathlib import Path
from typing import TypeVar

from fluxbore.design.errors import shown
from fluxbore.fem.femm_drawing import LARGEST_LENGTH, drawing
from fluxbore.fem.femm_model import METRES, Exterior, FemmModel, LengthUnit
from fluxbore.fem.femm_properties import block_property, boundary_property, circuit_property, point_property
from fluxbore.fem.femm_text import Entry, FemmText, Source, take_apart

_T = TypeVar("_T")

LARGEST_FILE = 50_000_000
"""Bytes: a drawing of a million lines."""

UNITS: dict[str, LengthUnit] = {
    "inches": "inches",
    "millimeters": "millimeters",
    "centimeters": "centimeters",
    "meters": "meters",
    "mils": "mils",
    "microns": "microns",
    "micrometers": "microns",
}
DEPTHS = (1e-15, 1e9)
"""m, of planar problems."""

OTHER_PROBLEMS = {
    "conductorprops": "electrostatics, heat flow or current flow",
    "dt": "heat flow",
}
"""Keys that magnetics files do not have."""


def read_model(path: str | Path) -> FemmModel:
    """The model in a file. Raises SpecError, beginning with the file's name."""
    path = Path(path)
    source = Source(path.name or str(path))
    try:
        if path.exists() and not path.is_file():
            raise source.error("a file is needed; this is none.")
        with path.open("rb") as file:
            data = file.read(LARGEST_FILE + 1)
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        raise source.error(f"it cannot be read: {reason}.") from error
    if len(data) > LARGEST_FILE:
        raise source.error(f"it must have at most {LARGEST_FILE / 1e6:.0f} MB; got more.")
    return parse(_decoded(data), str(path))


def parse(text: str, path: str = "") -> FemmModel:
    """The model that a file's text describes. path : where it came from; messages begin with the file's name.

    Raises SpecError with the line of what is wrong, outside the ranges or not supported.
    """
    source = Source(Path(path).name or path) if path else Source()
    if "\0" in text:
        raise source.error("it must be a text file of FEMM's magnetics; this is binary.")
    if not text.strip("\ufeff \t\r\n"):
        raise source.error("it must be a text file of FEMM's magnetics; this is empty.")
    # The announced format comes first: whatever is no FEMM file is told so, not that its first line is no key.
    if "[format]" not in text.lower():
        raise source.error("it must have a [Format] of 4.0, as FEMM's magnetics files do; got none.")
    found = take_apart(text.removeprefix("\ufeff"), source)
    _check_kind(found)
    settings = found.settings
    axisymmetric = _word(found, "ProblemType", {"planar": False, "axisymmetric": True})
    unit = _word(found, "LengthUnits", UNITS)
    exterior = _exterior(found, METRES[unit]) if axisymmetric else None
    drawn = drawing(found, METRES[unit], axisymmetric, exterior is not None)
    return FemmModel(
        axisymmetric=axisymmetric,
        unit=unit,
        depth=_depth(settings.get("depth"), METRES[unit], axisymmetric),
        polar=_word(found, "Coordinates", {"cartesian": False, "polar": True}, default=False),
        precision=settings["precision"].number() if "precision" in settings else 1e-8,
        min_angle=settings["minangle"].number() if "minangle" in settings else 30.0,
        comment=settings["comment"].string() if "comment" in settings else "",
        points=tuple(point_property(each) for each in found.properties["point"]),
        boundaries=tuple(boundary_property(each) for each in found.properties["bdry"]),
        materials=tuple(block_property(each) for each in found.properties["block"]),
        circuits=tuple(circuit_property(each) for each in found.properties["circuit"]),
        nodes=drawn.nodes,
        segments=drawn.segments,
        arcs=drawn.arcs,
        holes=drawn.holes,
        labels=drawn.labels,
        exterior=exterior,
        path=path,
    )


def _decoded(data: bytes) -> str:
    """FEMM writes in Windows' own alphabet, scripts in UTF-8; Latin-1 takes every byte."""
    for encoding in ("utf-8", "cp1252"):
        try:
            return data.decode(encoding)
        except UnicodeDecodeError:
            continue
    return data.decode("latin-1")


def _check_kind(found: FemmText) -> None:
    """Refuse what is no magnetostatic problem."""
    settings = found.settings
    if "format" in settings and not 4.0 <= settings["format"].number() < 5.0:
        raise settings["format"].error(f"must be 4.0; got {shown(settings['format'].text)}.")
    for key, kind in OTHER_PROBLEMS.items():
        if key in settings:
            raise settings[key].error(f"belongs to FEMM's files of {kind}; only magnetics files (.fem) are supported.")
    if found.properties.get("conductor"):
        raise found.source.error("it has conductor properties; only magnetics files (.fem) are supported.")
    if "solution" in settings:
        raise settings["solution"].error("begins the results in an .ans file; only .fem files are supported.")
    if "frequency" in settings and (frequency := settings["frequency"].number()):
        raise settings["frequency"].error(f"must be 0, as time-harmonic problems are not supported; got {frequency:g}.")
    if "prevsoln" in settings and (name := settings["prevsoln"].string()):
        raise settings["prevsoln"].error(f"must be empty, as previous solutions are not supported; got {shown(name)}.")
    if "prevtype" in settings and (number := settings["prevtype"].integer()):
        raise settings["prevtype"].error(f"must be 0, as previous solutions are not supported; got {number}.")


def _word(found: FemmText, key: str, words: dict[str, _T], default: _T | None = None) -> _T:
    """The meaning of a setting whose value is one of ``words``; required without ``default``."""
    entry, allowed = found.settings.get(key.lower()), " or ".join(words)
    if entry is None:
        if default is not None:
            return default
        raise found.source.error(f"it must have [{key}] = {allowed}; got none.")
    word = entry.string().strip().lower()
    if word not in words:
        raise entry.error(f"must be {allowed}; got {shown(entry.text)}.")
    return words[word]


def _depth(entry: Entry | None, metres: float, axisymmetric: bool) -> float:
    """In the file's unit. FEMM takes one metre where there is none (or −1): its files of before 4.0 were so."""
    depth = -1.0 if entry is None else entry.number()
    if depth <= 0 and (axisymmetric or depth == -1):
        return 1.0 if axisymmetric else 1 / metres
    if entry is not None and depth <= 0:
        raise entry.error(f"must be positive in a planar file; got {depth:g}.")
    if entry is not None and not axisymmetric and not DEPTHS[0] <= depth * metres <= DEPTHS[1]:
        raise entry.error(f"must be from {DEPTHS[0]:g} m to {DEPTHS[1]:g} m; got {depth * metres:g} m.")
    return depth


def _exterior(found: FemmText, metres: float) -> Exterior | None:
    """None unless both radii are given, as in FEMM."""
    centre, outer, inner = (
        found.settings[key].number() if key in found.settings else 0.0 for key in ("extzo", "extro", "extri")
    )
    for key, radius in (("extro", outer), ("extri", inner)):
        if radius < 0:
            raise found.settings[key].error(f"must not be negative; got {radius:g}.")
    for key, length in (("extzo", centre), ("extro", outer), ("extri", inner)):
        if abs(length) * metres > LARGEST_LENGTH:
            raise found.settings[key].error(f"must be within {LARGEST_LENGTH:g} m; got {length * metres:g} m.")
    return Exterior(centre, outer, inner) if outer and inner else None
