"""Products and their placements as the CAD kernel writes them into STEP files, under keys in place of names."""

from __future__ import annotations

import math
import os
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from fluxbore.design.errors import OutputError
from fluxbore.geometry.kernel import MILLIMETRE, Shape
from fluxbore.geometry.part import Body, Colour
from fluxbore.geometry.placement import Placement
from fluxbore.geometry.step_products import Piece, Product, Tree

SCHEMAS = {"AP242": "AP242DIS", "AP214": "AP214IS"}
"""What a STEP file may follow -> the kernel's word for it."""

Solids = Callable[[Body], Shape]
"""The kernel's solid (mm) of a shape in its own frame, made once."""


class Document:
    """An Open CASCADE document. products, usages : what each key stands for."""

    def __init__(self, solids: Solids) -> None:
        from OCP.TCollection import TCollection_ExtendedString
        from OCP.TDocStd import TDocStd_Document
        from OCP.XCAFApp import XCAFApp_Application
        from OCP.XCAFDoc import XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

        self._document = TDocStd_Document(TCollection_ExtendedString("BinXCAF"))
        XCAFApp_Application.GetApplication_s().InitDocument(self._document)
        self._shapes = XCAFDoc_DocumentTool.ShapeTool_s(self._document.Main())
        self._colours = XCAFDoc_DocumentTool.ColorTool_s(self._document.Main())
        XCAFDoc_ShapeTool.SetAutoNaming_s(False)  # else products without a name of ours are called "SOLID"
        self._solids = solids
        self._labels: dict[Product, tuple[Any, Colour]] = {}
        self.products: dict[str, Product] = {}
        self.usages: dict[str, tuple[str, str]] = {}

    def part(self, piece: Piece) -> Any:
        """The product of a piece, in the colour of the first that is asked for."""
        known = self._labels.get(piece.product)
        if known is None:
            label = self._named(self._shapes.AddShape(self._solids(piece.shape), False), piece.product)
            self._paint(label, piece.colour)
            known = self._labels[piece.product] = (label, piece.colour)
        return known

    def tree(self, whole: Tree) -> None:
        """All of an assembly."""
        root = self._named(self._shapes.NewShape(), whole.root)
        for product, pieces in whole.groups:
            group = self._named(self._shapes.NewShape(), product)
            for piece in pieces:
                label, colour = self.part(piece)
                used = self._use(group, label, piece.name, piece.note, piece.placement)
                if piece.colour != colour:
                    self._paint(used, piece.colour)
            self._use(root, group, product.name, "", Placement())
        self._shapes.UpdateAssemblies()

    def text(self, schema: str) -> str:
        """The file's text, in millimetres. Raises OutputError where the kernel cannot write it."""
        from OCP.IFSelect import IFSelect_ReturnStatus
        from OCP.STEPCAFControl import STEPCAFControl_Writer
        from OCP.STEPControl import STEPControl_StepModelType

        words = {"write.step.schema": SCHEMAS[schema], "xstep.cascade.unit": "MM", "write.step.unit": "MM"}
        with _settings(words, {"write.surfacecurve.mode": 0}), tempfile.TemporaryDirectory() as scratch:
            path = Path(scratch) / "document.step"
            writer = STEPCAFControl_Writer()
            writer.SetColorMode(True)
            writer.SetNameMode(True)
            writer.Transfer(self._document, STEPControl_StepModelType.STEPControl_AsIs)
            if writer.Write(os.fspath(path)) != IFSelect_ReturnStatus.IFSelect_RetDone:
                raise OutputError(f'"{scratch}" must be a folder that can be written; the CAD kernel could not write.')
            return path.read_text(encoding="ascii")

    def _named(self, label: Any, product: Product) -> Any:
        key = f"p{len(self.products)}"
        self.products[key] = product
        return _set_name(label, key)

    def _use(self, group: Any, label: Any, name: str, note: str, where: Placement) -> Any:
        key = f"u{len(self.usages)}"
        self.usages[key] = name, note
        return _set_name(self._shapes.AddComponent(group, label, _location(where)), key)

    def _paint(self, label: Any, colour: Colour) -> None:
        from OCP.Quantity import Quantity_Color, Quantity_TOC_sRGB
        from OCP.XCAFDoc import XCAFDoc_ColorSurf

        self._colours.SetColor(label, Quantity_Color(*colour, Quantity_TOC_sRGB), XCAFDoc_ColorSurf)


def _set_name(label: Any, name: str) -> Any:
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDataStd import TDataStd_Name

    TDataStd_Name.Set_s(label, TCollection_ExtendedString(name))
    return label


def _location(where: Placement) -> Any:
    from OCP.gp import gp_Ax3, gp_Dir, gp_Pnt, gp_Trsf
    from OCP.TopLoc import TopLoc_Location

    if where == Placement():
        return TopLoc_Location()
    along, across = gp_Dir(0, 0, -1 if where.flipped else 1), gp_Dir(math.cos(where.angle), math.sin(where.angle), 0)
    move = gp_Trsf()
    move.SetTransformation(gp_Ax3(gp_Pnt(0, 0, where.shift / MILLIMETRE), along, across), gp_Ax3())
    return TopLoc_Location(move)


@contextmanager
def _settings(words: Mapping[str, str], numbers: Mapping[str, int]) -> Iterator[None]:
    """Hold some of the kernel's settings, which are global to the process, and put them back."""
    from OCP.Interface import Interface_Static
    from OCP.STEPCAFControl import STEPCAFControl_Controller

    STEPCAFControl_Controller.Init_s()  # before it the settings do not exist
    words_before = {name: Interface_Static.CVal_s(name) for name in words}
    numbers_before = {name: Interface_Static.IVal_s(name) for name in numbers}

    def put(values: Mapping[str, str], counts: Mapping[str, int]) -> None:
        for name, value in values.items():
            Interface_Static.SetCVal_s(name, value)
        for name, count in counts.items():
            Interface_Static.SetIVal_s(name, count)

    try:
        put(words, numbers)
        yield
    finally:
        put(words_before, numbers_before)
