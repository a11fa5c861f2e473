"""Small FEMM files for the tests of `fluxbore solve`: hundreds of triangles at a loose accuracy, and awkward names."""

from pathlib import Path

from fluxbore.fem.femm_model import (
    Arc,
    BlockLabel,
    BlockProperty,
    BoundaryProperty,
    CircuitProperty,
    FemmModel,
    Node,
    Segment,
)
from fluxbore.fem.femm_writer import write_text

SPULE = "Spule Ö.1 a"
"""A circuit whose name has a space, a dot and a letter beyond ASCII."""

STEEL = ((0.0, 0.0), (0.8, 200.0), (1.4, 900.0), (1.8, 9000.0), (2.1, 80000.0))


def rectangle(x: tuple[float, float], y: tuple[float, float], first: int) -> tuple[list[Node], list[Segment]]:
    corners = [(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])]
    return [Node(*corner) for corner in corners], [Segment(first + k, first + (k + 1) % 4) for k in range(4)]


def planar() -> FemmModel:
    """A magnet (group 1) at (-5..5, -5..5) mm between the sides of a coil (group 2), 50 mm deep, in a box of A = 0."""
    nodes: list[Node] = []
    segments: list[Segment] = []
    for number, (x, y) in enumerate(
        (((-20, 20), (-20, 20)), ((-5, 5), (-5, 5)), ((8, 12), (-5, 5)), ((-12, -8), (-5, 5)))
    ):
        corners, lines = rectangle(x, y, 4 * number)
        nodes += corners
        segments += [Segment(line.start, line.end, boundary=0) for line in lines] if number == 0 else lines
    return FemmModel(
        False,
        "millimeters",
        50.0,
        boundaries=(BoundaryProperty("A=0", "prescribed"),),
        materials=(
            BlockProperty("Air"),
            BlockProperty("Magnet", mu_x=1.05, mu_y=1.05, coercivity=9e5),
            BlockProperty("Copper"),
        ),
        circuits=(CircuitProperty("coil", 2.0),),
        nodes=tuple(nodes),
        segments=tuple(segments),
        labels=(
            BlockLabel(0, 0, 1, magnetisation=90.0, group=1),
            BlockLabel(10, 0, 2, circuit=0, turns=100, group=2),
            BlockLabel(-10, 0, 2, circuit=0, turns=-100, group=2),
            BlockLabel(0, 15, 0),
        ),
    )


def axisymmetric(saturated: bool = False, current: float = 2.0) -> FemmModel:
    """A steel plunger (group 1) r < 5, z from -10 to 0 mm, and a coil (group 2) in a half disc of 40 mm with A = 0."""
    plunger = [Node(0, -10), Node(5, -10), Node(5, 0), Node(0, 0)]
    coil, around = rectangle((8, 12), (-5, 5), 4)
    iron = BlockProperty("Steel", curve=STEEL) if saturated else BlockProperty("Steel", mu_x=500.0, mu_y=500.0)
    return FemmModel(
        True,
        boundaries=(BoundaryProperty("A=0", "prescribed"),),
        materials=(BlockProperty("Air"), iron, BlockProperty("Copper")),
        circuits=(CircuitProperty(SPULE, current),),
        nodes=(*plunger, *coil, Node(0, -40), Node(0, 40)),
        segments=(
            Segment(0, 1, group=1),
            Segment(1, 2, group=1),
            Segment(2, 3, group=1),
            Segment(3, 0),
            *around,
            Segment(8, 0),
            Segment(3, 9),
        ),
        arcs=(Arc(8, 9, 180.0, boundary=0),),
        labels=(
            BlockLabel(2, -5, 1, group=1),
            BlockLabel(10, 0, 2, circuit=0, turns=100, group=2),
            BlockLabel(30, 0, 0),
        ),
    )


def write(folder: Path) -> None:
    """`planar.fem`, `axi.fem` and `iron.fem`, which saturates."""
    (folder / "planar.fem").write_text(write_text(planar()), encoding="utf-8")
    (folder / "axi.fem").write_text(write_text(axisymmetric()), encoding="utf-8")
    (folder / "iron.fem").write_text(write_text(axisymmetric(saturated=True, current=50.0)), encoding="utf-8")
