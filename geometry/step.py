"""An assembly as STEP files (ISO 10303-21, AP214): one with all parts, named and coloured, and one of every part.

The files are written into a scratch folder on the same disk and renamed when all of them are there.
"""

from __future__ import annotations

import os
import re
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fluxbore.design.errors import OutputError
from fluxbore.design.units import format_quantity
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.part import Colour
from fluxbore.geometry.solid import solid, tessellate
from fluxbore.geometry.step_files import NEW, OLD, PARTS, is_own, own_files, remove_stale, scratch_prefix

if TYPE_CHECKING:
    import cadquery

__all__ = ["file_name", "tessellate", "write_step"]

LONGEST_NAME = 80
"""Bytes of a file's name, its ending left out."""

Body = tuple[str, Colour, "cadquery.Solid"]
"""Name, colour and solid of a product."""


def write_step(assembly: Assembly, folder: Path) -> list[Path]:
    """Write ``<name>.step`` and ``parts/<part>.step`` into the folder; return the paths, the assembly's first.

    An existing folder never mixes two designs: STEP files of fluxbore's own that this design does not have are
    removed, an assembly of another name among them. Other files stay. Raises OutputError where the folder cannot be
    written, and then leaves what was there before.
    """
    bodies = [(part.group, (part.name, part.colour, solid(part))) for part in assembly.parts]
    groups = {group: [body for of, body in bodies if of == group] for group in dict.fromkeys(of for of, _ in bodies)}
    whole = f"{file_name(assembly.name)}.step"
    pieces = [f"{stem}.step" for stem in _unlike([file_name(part.name).lower() for part in assembly.parts])]
    try:
        beside = folder if folder.is_dir() else folder.absolute().parent
        beside.mkdir(parents=True, exist_ok=True)
        for place in (folder, folder.absolute().parent):
            remove_stale(place)
        with tempfile.TemporaryDirectory(prefix=scratch_prefix(), dir=beside) as scratch:
            new = Path(scratch) / NEW
            (new / PARTS).mkdir(parents=True)
            position = format_quantity(assembly.position, "length", 6)
            _write(new / whole, _tree(assembly.name, groups), f"{assembly.name}, mover at {position}")
            for piece, part, (_, body) in zip(pieces, assembly.parts, bodies, strict=True):
                _write(new / PARTS / piece, _single(body), f"{part.name} of {assembly.name}, {part.material}")
            _keep_others(folder / PARTS, new / PARTS)
            _move(new, folder, whole, Path(scratch) / OLD)
        for path in own_files(folder):
            if path.name != whole:
                path.unlink()
    except OSError as error:
        reason = error.strerror or "the CAD kernel could not write"
        raise OutputError(f'"{folder}" must be a folder that can be written; got: {reason}.') from error
    return [folder / whole, *(folder / PARTS / piece for piece in pieces)]


def file_name(name: str) -> str:
    """The name with everything that some file system or shell minds turned into hyphens: "end cap, rod end" becomes
    "end-cap-rod-end"."""
    safe = re.sub(r"[^\w.+]+", "-", name).strip("-.")
    # File systems take 255 bytes at most, and a folder's listing reads better with far fewer.
    return safe.encode()[:LONGEST_NAME].decode(errors="ignore").strip("-.") or "unnamed"


def _unlike(names: Sequence[str]) -> list[str]:
    """The same names with a number where one came before."""
    seen: dict[str, int] = {}
    result = []
    for name in names:
        seen[name] = seen.get(name, 0) + 1
        result.append(name if seen[name] == 1 else f"{name}-{seen[name]}")
    return result


def _keep_others(before: Path, after: Path) -> None:
    """Copy what is not fluxbore's own from the old folder to the new one; the old one is still whole when it fails."""
    for path in before.iterdir() if before.is_dir() else ():
        if is_own(path) or (after / path.name).exists():
            continue
        if path.is_dir() and not path.is_symlink():
            shutil.copytree(path, after / path.name, symlinks=True)
        else:
            shutil.copy2(path, after / path.name, follow_symlinks=False)


def _move(new: Path, folder: Path, whole: str, old: Path) -> None:
    """Put the finished files in place: a folder that is not there yet at one stroke, else file and folder by name."""
    if not folder.is_dir():
        new.replace(folder)
        return
    parts = folder / PARTS
    kept = parts.exists()
    if kept:
        parts.replace(old)
    try:
        (new / PARTS).replace(parts)
        (new / whole).replace(folder / whole)
    except OSError:
        if kept:
            # Back to where it was; what stands there now is ours.
            if parts.exists():
                parts.replace(new / PARTS)
            old.replace(parts)
        raise


class _Document:
    """An Open CASCADE document of named, coloured products."""

    def __init__(self) -> None:
        from OCP.TCollection import TCollection_ExtendedString
        from OCP.TDocStd import TDocStd_Document
        from OCP.XCAFApp import XCAFApp_Application
        from OCP.XCAFDoc import XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

        self.document = TDocStd_Document(TCollection_ExtendedString("BinXCAF"))
        XCAFApp_Application.GetApplication_s().InitDocument(self.document)
        self.shapes = XCAFDoc_DocumentTool.ShapeTool_s(self.document.Main())
        self.colours = XCAFDoc_DocumentTool.ColorTool_s(self.document.Main())
        XCAFDoc_ShapeTool.SetAutoNaming_s(False)  # else products without a name of ours are called "SOLID"

    def name(self, label: Any, name: str) -> Any:
        from OCP.TCollection import TCollection_ExtendedString
        from OCP.TDataStd import TDataStd_Name

        TDataStd_Name.Set_s(label, TCollection_ExtendedString(_ascii(name), True))
        return label

    def product(self, body: Body) -> Any:
        from OCP.Quantity import Quantity_Color, Quantity_TOC_sRGB
        from OCP.XCAFDoc import XCAFDoc_ColorSurf

        name, colour, shape = body
        label = self.name(self.shapes.AddShape(shape.wrapped, False), name)
        self.colours.SetColor(label, Quantity_Color(*colour, Quantity_TOC_sRGB), XCAFDoc_ColorSurf)
        return label

    def group(self, name: str, members: Sequence[tuple[str, Any]]) -> Any:
        """A product made of products, each at its place: the parts are modelled where they stand."""
        from OCP.TopLoc import TopLoc_Location

        label = self.name(self.shapes.NewShape(), name)
        for member_name, member in members:
            self.name(self.shapes.AddComponent(label, member, TopLoc_Location()), member_name)
        return label


def _single(body: Body) -> _Document:
    document = _Document()
    document.product(body)
    return document


def _tree(name: str, groups: dict[str, list[Body]]) -> _Document:
    document = _Document()
    taken = {*groups, *(body[0] for bodies in groups.values() for body in bodies)}
    # Readers merge products of one name, so the root must not be called as one of its children.
    root = f"{name} assembly" if name in taken else name
    members = [
        (group, document.group(group, [(body[0], document.product(body)) for body in bodies]))
        for group, bodies in groups.items()
    ]
    document.group(root, members)
    document.shapes.UpdateAssemblies()
    return document


def _write(path: Path, document: _Document, description: str) -> None:
    """Write one document as AP214, with a header that names the program and neither machine nor user."""
    from OCP.APIHeaderSection import APIHeaderSection_MakeHeader
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.STEPCAFControl import STEPCAFControl_Writer
    from OCP.STEPControl import STEPControl_StepModelType
    from OCP.TCollection import TCollection_HAsciiString

    with _settings({"write.step.schema": "AP214IS", "xstep.cascade.unit": "MM", "write.step.unit": "MM"}):
        writer = STEPCAFControl_Writer()
        writer.SetColorMode(True)
        writer.SetNameMode(True)
        writer.Transfer(document.document, STEPControl_StepModelType.STEPControl_AsIs)
        header = APIHeaderSection_MakeHeader(writer.ChangeWriter().Model())
        header.SetName(TCollection_HAsciiString(_ascii(path.name)))
        header.SetDescriptionValue(1, TCollection_HAsciiString(_ascii(description)))
        header.SetAuthorValue(1, TCollection_HAsciiString(_program()))
        header.SetOrganizationValue(1, TCollection_HAsciiString(""))
        header.SetOriginatingSystem(TCollection_HAsciiString(_program()))
        header.SetAuthorisation(TCollection_HAsciiString(""))
        if writer.Write(os.fspath(path)) != IFSelect_ReturnStatus.IFSelect_RetDone:
            raise OSError


def _ascii(text: str) -> str:
    """Text for the header, which the kernel writes as it is; ISO 10303-21 puts other letters between X2 and X0."""
    return re.sub(r"[^ -~]", lambda letter: f"\\X2\\{letter[0].encode('utf-16-be').hex().upper()}\\X0\\", text)


@contextmanager
def _settings(values: dict[str, str]) -> Iterator[None]:
    """Hold some of the kernel's settings, which are global to the process, and put them back."""
    from OCP.Interface import Interface_Static
    from OCP.STEPCAFControl import STEPCAFControl_Controller

    STEPCAFControl_Controller.Init_s()  # before it the settings do not exist
    before = {name: Interface_Static.CVal_s(name) for name in values}
    try:
        for name, value in values.items():
            Interface_Static.SetCVal_s(name, value)
        yield
    finally:
        for name, value in before.items():
            Interface_Static.SetCVal_s(name, value)


def _program() -> str:
    try:
        return f"fluxbore {version('fluxbore')}"
    except PackageNotFoundError:  # run from a bare checkout
        return "fluxbore"
