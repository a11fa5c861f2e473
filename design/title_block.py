"""What stands in the title block of a drawing and in the header of a CAD file, from the specification."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass

from fluxbore.design.keys import Key, Values

LONGEST_NUMBER = 24
"""Letters of a part number that is made from the design's name."""

SPELT = str.maketrans({"Ä": "AE", "Ö": "OE", "Ü": "UE", "Æ": "AE", "Ø": "OE", "Œ": "OE", "Ł": "L", "Đ": "D", "Þ": "TH"})
"""Letters that more than an accent parts from the plain ones, as they are spelt where there are none."""


def _word(leaf: str, doc: str, default: str | None = None) -> Key:
    return Key(f"drawing.{leaf}", doc, kind="word", default=default, optional=default is None)


DRAWING_KEYS: tuple[Key, ...] = (
    _word("part_number", "number of the whole; parts add a hyphen and their own. Without it the design's name"),
    _word("number", "number of the drawing of the whole; parts add a hyphen and their own. Without it the part number"),
    _word("revision", "revision of parts and drawings", "A"),
    _word("author", "who answers for the drawing"),
    _word("organisation", "whose drawing it is"),
    _word("approver", "who releases parts and drawings"),
    _word("general_tolerance", "of sizes without a tolerance of their own", "ISO 2768-mK"),
    _word("surface", "roughness of surfaces without a mark of their own", "Ra 3.2, toleranced sizes Ra 0.8 (assumed)"),
)
"""Keys of section ``[drawing]``, the same for every kind of actuator; no figure depends on them."""


@dataclass(frozen=True, slots=True)
class TitleBlock:
    """Numbers and names of a design's drawings and CAD files; of what is not given "" or what follows from the name."""

    name: str = "design"
    part_number: str = "DESIGN"
    drawing_number: str = "DESIGN"
    revision: str = "A"
    author: str = ""
    organisation: str = ""
    general_tolerance: str = "ISO 2768-mK"
    approver: str = ""
    surface: str = ""

    def number_of(self, item: int) -> str:
        """The part number of an item of the parts list."""
        return f"{self.part_number}-{item:03d}"

    def drawing_of(self, item: int) -> str:
        """The number of its drawing."""
        return f"{self.drawing_number}-{item:03d}"


def _number_from(name: str) -> str:
    """Capitals, digits and hyphens: "Kühler 2" becomes "KUEHLER-2"."""
    plain = unicodedata.normalize("NFKD", unicodedata.normalize("NFC", name.upper()).translate(SPELT))
    plain = "".join(letter for letter in plain if not unicodedata.combining(letter))
    return re.sub(r"[^A-Z0-9]+", "-", plain).strip("-")[:LONGEST_NUMBER].strip("-") or "DESIGN"


def title_block(values: Values) -> TitleBlock:
    """From the resolved values of a specification of any kind."""

    def word(leaf: str) -> str:
        return str(values.get(f"drawing.{leaf}", ""))

    name = str(values["actuator.name"])
    number = word("part_number") or _number_from(name)
    return TitleBlock(
        name,
        number,
        word("number") or number,
        word("revision"),
        word("author"),
        word("organisation"),
        word("general_tolerance"),
        word("approver"),
        word("surface"),
    )
