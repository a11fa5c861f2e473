"""All sheets of a design: the assembly, its parts list where that needs sheets of its own, and every part that is made.

What is bought is in the parts list alone, with what to order; what is a mere envelope has no drawing of its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.drawing import Page, assembly_sheet, list_sheets
from fluxbore.geometry.file_names import item_stems
from fluxbore.geometry.part_drawing import part_sheet
from fluxbore.geometry.parts_list import Item
from fluxbore.geometry.sheet import Sheet


def made(item: Item) -> bool:
    """Whether a workshop makes it, and so needs a drawing."""
    return bool(item.part.material) and not item.part.bought


@lru_cache(maxsize=2)  # three formats ask for the same
def drawing_set(assembly: Assembly, items: tuple[Item, ...]) -> tuple[tuple[Sheet, ...], tuple[Sheet, ...]]:
    """Sheets of the whole, and of the parts with the stems of their files for names. items : the assembly's own list.

    Raises DesignError where a part has a tolerance that there is none of, or finds no room on paper.
    """
    lists = len(list_sheets(assembly, items, Page()))
    parts = [(stem, item) for stem, item in zip(item_stems(items), items, strict=True) if made(item)]
    count = 1 + lists + len(parts)
    whole = (assembly_sheet(assembly, items, Page(1, count)), *list_sheets(assembly, items, Page(2, count)))
    return whole, tuple(
        part_sheet(item, assembly.title, stem, Page(number, count))
        for number, (stem, item) in enumerate(parts, 2 + lists)
    )


def numbered_names(sheets: Sequence[Sheet], stem: str) -> list[str]:
    """Names of files for sheets of the whole: the design's own, and with a sheet's name behind it."""
    return [f"{stem}-{sheet.name}" if sheet.name else stem for sheet in sheets]
