"""A drawing in free space is worth what theory says, whatever box it was drawn in."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from fluxbore.design.bh_curve import MU_0
from fluxbore.design.errors import FluxboreError, SpecError
from fluxbore.fem.femm_model import (
    Arc,
    BlockLabel,
    BlockProperty,
    BoundaryProperty,
    CircuitProperty,
    Exterior,
    FemmModel,
    Hole,
    Node,
    PointProperty,
    Segment,
)
from fluxbore.fem.femm_open import with_open_boundary
from fluxbore.fem.femm_reader import parse
from fluxbore.fem.femm_solution import solve_model
from fluxbore.fem.femm_writer import write_text

COIL = 22.945e-3
"""H: inner diameter 1 in, outer 3 in, length 2 in, 1000 turns, by the Bessel integral (five digits)."""


def loop(first: int, count: int, boundary: int | None = None) -> tuple[Segment, ...]:
    return tuple(Segment(first + k, first + (k + 1) % count, boundary=boundary) for k in range(count))


def coil_in_a_box(height: float, width: float, base: float | None = None) -> FemmModel:
    """Inches. The axis is a line from the box's bottom to its top."""
    base = -height if base is None else base
    corners = [(0.5, -1), (1.5, -1), (1.5, 1), (0.5, 1), (0, base), (width, base), (width, height), (0, height)]
    edge = [Segment(4, 5, boundary=0), Segment(5, 6, boundary=0), Segment(6, 7, boundary=0), Segment(7, 4)]
    return FemmModel(
        True,
        "inches",
        boundaries=(BoundaryProperty("A=0", "prescribed"),),
        materials=(BlockProperty("Air"), BlockProperty("Copper", conductivity=58e6)),
        circuits=(CircuitProperty("coil", 1.0),),
        nodes=tuple(Node(*corner) for corner in corners),
        segments=(*loop(0, 4), *edge),
        labels=(BlockLabel(1, 0, 1, None, 0, turns=1000), BlockLabel(0.25, 0, 0)),
    )


def wires(half: float = 30.0) -> FemmModel:
    """Two wires of radius 2 mm, 20 mm apart, off the middle of a square box; metres deep."""
    corners = [(-half, -half + 3), (half + 7, -half + 3), (half + 7, half + 3), (-half, half + 3)]
    round_wires = [(-12, 0), (-8, 0), (8, 0), (12, 0)]
    arcs = tuple(Arc(a, b, 180.0) for a, b in ((4, 5), (5, 4), (6, 7), (7, 6)))
    return FemmModel(
        False,
        depth=1000.0,
        boundaries=(BoundaryProperty("far", "mixed", c0=1e5),),
        materials=(BlockProperty("Copper"),),
        circuits=(CircuitProperty("line", 2.0),),
        nodes=tuple(Node(x, y) for x, y in corners + round_wires),
        segments=loop(0, 4, 0),
        arcs=arcs,
        labels=(
            BlockLabel(-10, 0, 0, None, 0),
            BlockLabel(10, 0, 0, None, 0, turns=-1),
            BlockLabel(0, 10, 0),
        ),
    )


def sphere(remanence: float) -> FemmModel:
    """Of 10 mm, magnetised along z, in a half disc of 30 mm that has no condition."""
    nodes = tuple(Node(0.0, z) for z in (-30, -10, 10, 30))
    return FemmModel(
        True,
        materials=(BlockProperty("Magnet", coercivity=remanence / MU_0), BlockProperty("air", mu_x=1.0)),
        nodes=nodes,
        segments=(Segment(0, 1), Segment(1, 2), Segment(2, 3)),
        arcs=(Arc(0, 3, 180.0), Arc(1, 2, 180.0)),
        labels=(BlockLabel(2, 0, 0, None, None, 90.0), BlockLabel(20, 0, 1)),
    )


@pytest.mark.parametrize(("height", "width", "base"), [(1.5, 2.0, None), (3, 4, None), (10, 15, None), (2, 1.75, -5)])
def test_a_coil_in_free_space(height: float, width: float, base: float | None) -> None:
    """Catches a box that still matters, an axis that is not drawn, a factor of the exterior."""
    model = with_open_boundary(coil_in_a_box(height, width, base))
    model = parse(write_text(model))
    assert solve_model(model, accuracy=5e-4).linkages[0] == pytest.approx(COIL, rel=5e-4)


def test_a_drawing_away_from_the_axis() -> None:
    """Catches a way from pole to pole that is taken for a drawn one: the box ends at r = 0.25 in."""
    model = coil_in_a_box(2, 2)
    nodes = (*model.nodes[:4], Node(0.25, -2), Node(2, -2), Node(2, 2), Node(0.25, 2))
    segments = (*model.segments[:7], Segment(7, 4, boundary=0))
    labels = (model.labels[0], BlockLabel(0.3, 0, 0))
    opened = with_open_boundary(replace(model, nodes=nodes, segments=segments, labels=labels))
    assert solve_model(opened, accuracy=5e-4).linkages[0] == pytest.approx(COIL, rel=5e-4)


def test_a_pair_of_wires() -> None:
    """Catches halves of the rim tied crosswise: L = μ0/π (ln(d/a) + 1/4) per metre, with even currents exactly."""
    solved = solve_model(with_open_boundary(wires()), accuracy=5e-4)
    exact = MU_0 / np.pi * (np.log(20 / 2) + 0.25)
    assert solved.linkages[0] / 2.0 == pytest.approx(exact, rel=5e-4)
    assert solved.energies[0] == pytest.approx(exact * 2.0**2 / 2, rel=5e-4)


def test_a_magnetised_sphere() -> None:
    """Catches an exterior of a wrong reluctivity: B is 2/3 of the remanence inside, a dipole's outside."""
    solved = solve_model(with_open_boundary(sphere(1.2)), points=[(0, 0), (3, 4), (0, 20), (20, 0)], accuracy=3e-4)
    field = solved.probe(np.array([(0, 0), (3, 4), (0, 20), (20, 0)])).flux_density
    exact = [(0, 0.8), (0, 0.8), (0, 0.1), (0, -0.05)]
    assert np.linalg.norm(field - exact, axis=1) / np.linalg.norm(exact, axis=1) == pytest.approx(0, abs=3e-3)


def test_pockets_at_the_axis_are_air() -> None:
    """Catches one label for all that lies around: a domain that touches the axis twice leaves a pocket there."""
    nodes = tuple(Node(*at) for at in ((0, -2), (2, -2), (2, 2), (0, 2), (0, 1), (1, 0), (0, -1)))
    model = coil_in_a_box(2, 2)
    model = replace(
        model,
        nodes=nodes,
        segments=tuple(Segment(k, (k + 1) % 7) for k in range(7) if k not in (3, 6)) + (Segment(3, 4), Segment(6, 0)),
        labels=(BlockLabel(1.5, 0, 1, None, 0),),
    )
    opened = with_open_boundary(model)
    assert sum(label.material == 0 and not label.external for label in opened.labels) == 2
    assert solve_model(opened, accuracy=1e-2).linkages[0] > 0


def test_names_are_new_ones() -> None:
    """Catches a seam that has the name of another boundary, and a current-carrying material taken for air."""
    model = coil_in_a_box(2, 2)
    model = replace(
        model,
        boundaries=(BoundaryProperty("Open boundary", "prescribed"),),
        materials=(BlockProperty("Air", current_density=1e6), BlockProperty("Air gap", mu_x=2.0)),
    )
    opened = with_open_boundary(model)
    assert opened.boundaries[1].name == "open boundary 2"
    assert opened.materials[2] == BlockProperty("Air 2")


def shifted(model: FemmModel, **changes: float) -> FemmModel:
    return replace(model, boundaries=(replace(model.boundaries[0], **changes),))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda m: replace(m, exterior=Exterior(0, 1, 1)), "exterior region: its boundary is open already"),
        (lambda m: shifted(m, a1=0.1), "no potential but zero"),
        (lambda m: replace(m, boundaries=(BoundaryProperty("H", "mixed", c1=5.0),)), "c1 = 5 A/m"),
        (
            lambda m: replace(m, segments=(*m.segments[:4], replace(m.segments[4], boundary=None), *m.segments[5:])),
            r"from \(0, -2\) to \(2, -2\) has none",
        ),
        (
            lambda m: replace(
                m, points=(PointProperty("P", 0.5),), nodes=(*m.nodes[:5], replace(m.nodes[5], prop=0), *m.nodes[6:])
            ),
            r"the point \(2, -2\) has 0.5 Wb/m",
        ),
        (lambda m: replace(m, segments=m.segments[:3]), "must enclose an area to be opened"),
        (
            lambda m: replace(
                m,
                nodes=(*m.nodes, Node(5, 0), Node(6, 0), Node(6, 1)),
                segments=(*m.segments, *loop(8, 3)),
                labels=(*m.labels, BlockLabel(5.9, 0.1, 0)),
            ),
            "one connected drawing to be opened; it has 2 closed parts",
        ),
    ],
)
def test_what_cannot_be_opened(change: Callable[[FemmModel], FemmModel], message: str) -> None:
    """Catches a condition that is dropped although it means something."""
    with pytest.raises(FluxboreError, match=message):
        with_open_boundary(change(coil_in_a_box(2, 2)))


def test_a_period_is_not_opened() -> None:
    """Catches a machine's sector that is set free."""
    model = wires()
    sides = tuple(replace(segment, boundary=segment.start % 2) for segment in model.segments)
    seams = (BoundaryProperty("left and right", "periodic"), BoundaryProperty("top and bottom", "antiperiodic"))
    with pytest.raises(SpecError, match='"left and right" is periodic'):
        with_open_boundary(replace(model, segments=sides, boundaries=seams))


def test_a_hole_is_part_of_the_drawing() -> None:
    """Catches a hole at the edge's inside that counts as outside: its condition stays."""
    model = coil_in_a_box(3, 3)
    corners = [(2, -0.5), (2.5, -0.5), (2.5, 0.5), (2, 0.5)]
    model = replace(
        model,
        nodes=(*model.nodes, *(Node(*corner) for corner in corners)),
        segments=(*model.segments, *loop(8, 4, 0)),
        holes=(Hole(2.25, 0),),
    )
    opened = with_open_boundary(model)
    assert [s.boundary for s in opened.segments[8:12]] == [0] * 4
    assert [s.boundary for s in opened.segments[4:7]] == [None] * 3
    # A superconducting ring lowers the inductance.
    assert 0.5 * COIL < solve_model(opened, accuracy=1e-2).linkages[0] < 0.99 * COIL


def test_opening_twice_is_refused() -> None:
    with pytest.raises(SpecError, match="open already"):
        with_open_boundary(with_open_boundary(coil_in_a_box(2, 2)))
    with pytest.raises(SpecError, match="closed parts"):
        with_open_boundary(with_open_boundary(wires()))
