"""An assembly as STEP files (ISO 10303-21, AP242 or AP214): the whole at each place of its stroke, and every item.

The CAD kernel writes shapes, each of them once, colours and placements (`step_document`); numbers, names and properties
are put into its text (`step_properties`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from fluxbore.design.materials import Material
from fluxbore.design.title_block import TitleBlock
from fluxbore.design.units import format_quantity
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.file_names import PARTS, file_name, item_stems
from fluxbore.geometry.kernel import Shape, load_kernel
from fluxbore.geometry.part import Body
from fluxbore.geometry.parts_list import Item
from fluxbore.geometry.program import program
from fluxbore.geometry.solid import shape
from fluxbore.geometry.step_products import Catalogue, tree
from fluxbore.geometry.step_text import Header, with_header

if TYPE_CHECKING:
    from fluxbore.geometry.step_document import Document


def step_texts(
    places: Mapping[str, Assembly], items: Sequence[Item], materials: Mapping[str, Material], schema: str = "AP242"
) -> dict[str, str]:
    """The texts by their names: ``NAME.step``, with the mover elsewhere ``NAME-PLACE.step``, ``parts/ITEM.step``.

    places : the assembly by the place of its mover, the one of the parts list first; of one that does not move only
    that is written. schema : "AP242" or "AP214". Raises MissingLibraryError without the CAD kernel, and DesignError
    where that makes no sound body of a part.
    """
    first = next(iter(places.values()))
    catalogue = Catalogue(items, materials, first.title.revision)
    writer = _Writer(schema, first.title)
    texts = {}
    for place, whole in places.items():
        if whole is not first and whole.parts == first.parts:
            continue
        name = f"{file_name(first.name)}.step" if whole is first else f"{file_name(first.name)}-{place}.step"
        document = writer.document()
        document.tree(tree(whole, catalogue))
        position = format_quantity(whole.position, "length", 6)
        texts[name] = writer.text(document, name, f"{whole.name}, mover at {position}")
    for item, stem in zip(items, item_stems(items), strict=True):
        document = writer.document()
        document.part(catalogue.single(item))
        material = f", {item.part.material}" if item.part.material else ""
        name = f"{PARTS}/{stem}.step"
        texts[name] = writer.text(document, f"{stem}.step", f"{item.name} of {first.name}{material}")
    return texts


class _Writer:
    """What all files of one export share: the solids, each made once, and the header's words."""

    def __init__(self, schema: str, title: TitleBlock) -> None:
        self._schema, self._title = schema, title
        self._time = datetime.now(UTC).isoformat(timespec="seconds")
        self._program = program()
        self._solids: dict[Body, Shape] = {}

    def document(self) -> Document:
        from fluxbore.geometry.step_document import Document

        load_kernel()
        return Document(self._solid)

    def text(self, document: Document, name: str, description: str) -> str:
        from fluxbore.geometry.step_properties import named

        title = self._title
        header = Header(name, description, self._program, self._time, title.author, title.organisation, title.approver)
        text = named(document.text(self._schema), document.products, document.usages)
        return with_header(text, header)

    def _solid(self, body: Body) -> Shape:
        if body not in self._solids:
            self._solids[body] = shape(body)
        return self._solids[body]
