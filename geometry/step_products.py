"""What a STEP file of an assembly says beside shapes: products with numbers and properties, and where pieces stand.

No CAD kernel is needed here. Alike pieces are placements of one product, whose number is the parts list's.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from fluxbore.design.materials import Material
from fluxbore.geometry import unrolled
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.file_names import unlike
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.inertia import Inertia, of_mass
from fluxbore.geometry.mass import inertia_of, part_masses, total
from fluxbore.geometry.part import Body, Colour, Part, centre_of_mass
from fluxbore.geometry.parts_list import Item
from fluxbore.geometry.placement import Placement, placement

Value = str | float


@dataclass(frozen=True, slots=True)
class Property:
    """value : a text, or a number in this unit, "kg", "mm", "kg mm^2" or "" for a plain one."""

    name: str
    value: Value
    unit: str = ""


@dataclass(frozen=True, slots=True)
class Product:
    """One product of a file.

    number : its part number. source : "make" or "buy", "" for what is put together. material : its name and density
    (kg/m^3). volume : m^3 and centre : m, of the shape in its own frame; None for what is put together.
    """

    number: str
    name: str
    revision: str
    source: str = ""
    description: str = ""
    material: tuple[str, float] | None = None
    volume: float | None = None
    centre: tuple[float, float, float] | None = None
    properties: tuple[Property, ...] = ()


@dataclass(frozen=True, slots=True)
class Piece:
    """One use of a part's product. shape : in its own frame, the same object for alike pieces."""

    name: str
    note: str
    colour: Colour
    product: Product
    shape: Body
    placement: Placement


@dataclass(frozen=True, slots=True)
class Tree:
    """An assembly of groups of pieces."""

    root: Product
    groups: tuple[tuple[Product, tuple[Piece, ...]], ...]


@dataclass(slots=True)
class Catalogue:
    """The products of a parts list, with every shape that their pieces turn out to have.

    An item has one shape, unless its pieces differ by the angles between drillings.
    """

    items: Sequence[Item]
    materials: Mapping[str, Material]
    revision: str
    _shapes: dict[int, list[tuple[Body, Product]]] = field(default_factory=dict)
    _items: dict[str, Item] = field(init=False)
    _names: dict[int, str] = field(init=False)

    def __post_init__(self) -> None:
        self._items = {part.name: item for item in self.items for part in item.parts}
        names = unlike([item.name for item in self.items])
        self._names = {item.number: name for item, name in zip(self.items, names, strict=True)}

    @property
    def names(self) -> set[str]:
        """Of all products."""
        return set(self._names.values())

    def piece(self, part: Body) -> Piece:
        """The part as a placement of a product's shape; the first of its item gives the shape."""
        item = self._items[part.name]
        known = self._shapes.setdefault(item.number, [])
        for shape, product in known:
            where = placement(shape, part)
            if where is not None:
                return Piece(part.name, part.note, part.colour, product, shape, where)
        shape, where = own_frame(part)
        product = self._product(item, shape, len(known))
        known.append((shape, product))
        return Piece(part.name, part.note, part.colour, product, shape, where)

    def single(self, item: Item) -> Piece:
        """The item by itself, in its own frame."""
        piece = self.piece(item.part)
        return Piece(piece.product.name, piece.note, piece.colour, piece.product, piece.shape, Placement())

    def _product(self, item: Item, shape: Body, variant: int) -> Product:
        name = self._names[item.number]
        density = self.materials[shape.material].density if shape.material else None
        return Product(
            item.part_number if not variant else f"{item.part_number}-{variant + 1}",
            name if not variant else f"{name}, variant {variant + 1}",
            self.revision,
            item.source,
            shape.note if len({part.note for part in item.parts}) == 1 else "",  # else it is of the single piece
            None if density is None else (shape.material, density),
            item.volume,
            centre_of_mass(shape),
            _properties(item, shape),
        )


def tree(assembly: Assembly, catalogue: Catalogue) -> Tree:
    """Every part of the assembly where it stands, under its group."""
    title, names = assembly.title, catalogue.names
    rows = part_masses(assembly, catalogue.materials)
    groups = []
    for name in dict.fromkeys(part.group for part in assembly.parts):
        carried = assembly.carried_mass if name == "mover" else 0.0
        extra = (Property("mass carried along, not drawn", carried, "kg"),) if carried else ()
        product = Product(
            f"{title.part_number}-{name.upper()}",
            _unlike_any(name, names),
            title.revision,
            properties=(Property("mass", total(rows, name), "kg"), *extra, *_inertia(inertia_of(rows, name))),
        )
        pieces = tuple(catalogue.piece(part) for part in assembly.parts if part.group == name)
        groups.append((product, pieces))
    # Readers merge products of one name, so the root must not be called as anything else.
    taken = names | {product.name for product, _ in groups} | {part.name for part in assembly.parts}
    root = Product(
        title.part_number,
        f"{assembly.name} assembly" if assembly.name in taken else assembly.name,
        title.revision,
        properties=(
            Property("mass", total(rows), "kg"),
            Property("drawing number", title.drawing_number),
            Property("position of the mover", assembly.position * 1e3, "mm"),
            *_inertia(inertia_of(rows)),
        ),
    )
    return Tree(root, tuple(groups))


def _inertia(found: Inertia, centre: bool = True) -> tuple[Property, ...]:
    """About axes through the centre of gravity, which is told where validation properties do not."""
    if not found.mass:
        return ()
    place = zip("xyz", found.centre * 1e3, strict=True) if centre else ()
    return (
        *(Property(f"centre of gravity {axis}", float(value), "mm") for axis, value in place),
        *(
            Property(f"moment of inertia {'xyz'[i]}{'xyz'[j]}", float(found.tensor[i, j]) * 1e6, "kg mm^2")
            for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
            if i == j or abs(found.tensor[i, j]) > 1e-9 * found.tensor[i, i]
        ),
    )


def own_frame(part: Body) -> tuple[Body, Placement]:
    """The part with its lower end at z = 0, and the placement that brings it back. The middle of what follows a helix
    comes to θ = 0 too."""
    low = min(z for _, z in part.profile)
    if isinstance(part, HelicalPart):
        left, right = unrolled.reach(part.outline)
        middle = (left + right) / 2
        return replace(part, outline=unrolled.moved(part.outline, -middle, -low)), Placement(False, middle, low)
    return _lowered(part, low), Placement(False, 0.0, low)


def _lowered(part: Part, way: float) -> Part:
    """m."""
    return replace(
        part,
        profile=tuple((r, z - way) for r, z in part.profile),
        holes=tuple(replace(hole, z=hole.z - way) for hole in part.holes),
        axial_holes=tuple(replace(hole, start=hole.start - way, end=hole.end - way) for hole in part.axial_holes),
    )


def _unlike_any(name: str, taken: set[str]) -> str:
    return f"{name} group" if name in taken else name


def _properties(item: Item, shape: Body) -> tuple[Property, ...]:
    """What a workshop asks of a part beside its shape."""
    found = [
        Property("part number", item.part_number),
        Property("drawing number", item.drawing_number),
        Property("source", item.source),
    ]
    if shape.bought:
        found.append(Property("designation", shape.bought))
    if shape.material:
        found += [Property("mass", item.mass, "kg"), *_inertia(of_mass(shape, item.mass), centre=False)]
    if shape.fill != 1.0:
        found.append(Property("share of the volume that is the material", shape.fill))
    if not isinstance(shape, HelicalPart):
        names = unlike([f"tolerance of {fit.feature}" for fit in shape.fits])
        for name, fit in zip(names, shape.fits, strict=True):
            found.append(Property(name, f"{fit.nominal * 1e3:.6g} {fit.tolerance}"))
        threads = [hole.thread for hole in shape.holes] + [hole.thread for hole in shape.axial_holes]
        threads += [cut.thread for cut in shape.axis_threads]
        for thread in dict.fromkeys(filter(None, threads)):
            found.append(Property(f"thread {thread}", f"{threads.count(thread)} x {thread}"))
    return tuple(found)
