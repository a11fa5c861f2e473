"""Drawings that cannot be meshed are refused in one sentence with coordinates; those that only look so are mended."""

from __future__ import annotations

import numpy as np
import pytest

from fluxbore.design.errors import MeshError
from fluxbore.fem.outline import HOLE, Curve, Outline, Pair, Seed
from fluxbore.fem.outline_check import cleaned, pieces
from fluxbore.fem.unstructured import triangulate

SQUARE = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
SIDES = (Curve(0, 1), Curve(1, 2), Curve(2, 3), Curve(3, 0))


def square(
    points: tuple[tuple[float, float], ...] = (),
    curves: tuple[Curve, ...] = (),
    seeds: tuple[Seed, ...] = (Seed((0.1, 0.1), 0),),
    pairs: tuple[Pair, ...] = (),
) -> Outline:
    """A square of 1 mm with whatever is put into it."""
    at = 1e-3 * np.array([*SQUARE, *points])
    scaled = tuple(
        Seed((s.position[0] * 1e-3, s.position[1] * 1e-3), s.region, s.size and s.size * 1e-3, s.default) for s in seeds
    )
    return Outline("planar", at, (*SIDES, *curves), scaled, pairs, unit=1e-3, unit_name="mm")


@pytest.mark.parametrize(
    ("outline", "sentence"),
    [
        (square(curves=(Curve(0, 2), Curve(1, 3))), r"lines cross or touch at \(0.5, 0.5\) mm"),
        (square(((0.5, -0.2), (0.5, 0.5)), (Curve(4, 5),)), r"lines cross or touch at \(0.5, 0\) mm"),
        (square(((0.5, 0.5), (0.5, 0.5 + 1e-9)), (Curve(4, 0),)), r"two points at \(0.5, 0.5\) mm"),
        (
            square(((0.3, 0.5), (0.7, 0.5)), (Curve(4, 5, np.pi), Curve(5, 4, np.pi))),
            r"the region around \(0.5, 0.5\d*\) mm has no block label",
        ),
        (square(seeds=(Seed((0.1, 0.1), 0), Seed((0.2, 0.3), 1))), r"\(0.1, 0.1\) mm and \(0.2, 0.3\) mm lie in one"),
        (square(seeds=(Seed((0.1, 0.1), 0), Seed((0.2, 0.3), 0))), "of the same kind"),
        (square(seeds=(Seed((0.5, 0.5), 0), Seed((2.0, 0.3), 0))), r"label at \(2, 0.3\) mm lies outside"),
        (square(seeds=(Seed((1.0, 0.5), 0),)), r"label at \(1, 0.5\) mm lies on a line"),
        (square(seeds=(Seed((0.1, 0.1), HOLE),)), "every face of the drawing is a hole"),
        (square(seeds=(Seed((0.1, 0.1), 0, size=1e-5),)), r"size 1e-05 mm .* \(0.1, 0.1\) mm asks for about"),
        (square(seeds=(Seed((0.1, 0.1), 0, size=1e-300),)), r"asks for about .* triangles; at most"),
        (square(curves=(Curve(1, 1),)), r"starts and ends in the point \(1, 0\) mm"),
        (square(curves=(Curve(0, 9),)), "names point 9; the drawing has 4 points"),
        (square(((0.5, 0.5), (0.5, 0.7)), (Curve(4, 5),), pairs=(Pair(0, 4),)), "periodic sides .* differ"),
    ],
)
def test_a_drawing_that_cannot_be_meshed_is_refused_with_coordinates(outline: Outline, sentence: str) -> None:
    """Catches a defect that reaches the mesher, and a sentence without the place."""
    with pytest.raises(MeshError, match=sentence) as caught:
        triangulate(outline)
    assert "\n" not in str(caught.value)


def test_a_drawing_too_far_from_the_origin_is_refused() -> None:
    """Catches points that coarse coordinates move: a millimetre at a thousand kilometres has two digits left."""
    outline = Outline("planar", 1e-3 * np.array(SQUARE) + 1e6, SIDES, (Seed((1e6 + 5e-4, 1e6 + 5e-4), 0),))
    with pytest.raises(MeshError, match="coordinates are too coarse there"):
        triangulate(outline)
    assert len(
        triangulate(Outline("planar", np.array(SQUARE) + 1e5, SIDES, (Seed((1e5 + 0.5, 1e5 + 0.5), 0),))).triangles
    )


def test_an_open_outline_is_refused() -> None:
    """Catches the empty mesh of lines that enclose nothing."""
    outline = Outline("planar", np.array(SQUARE), SIDES[:3], (Seed((0.5, 0.5), 0),))
    with pytest.raises(MeshError, match="enclose no area"):
        triangulate(outline)


def test_the_other_side_of_the_axis_is_refused() -> None:
    """Catches negative radii: of points, and of an arc between points that are allowed."""
    points = np.array([(-1.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    with pytest.raises(MeshError, match=r"\(-1, 0\) m lies at r < 0"):
        triangulate(Outline("axisymmetric", points, SIDES, (Seed((0.5, 0.5), 0),)))
    bulge = (*SIDES[:3], Curve(3, 0, np.pi))
    with pytest.raises(MeshError, match=r"arc through \(-0.5, 0.5\) m lies at r < 0"):
        triangulate(Outline("axisymmetric", np.array(SQUARE), bulge, (Seed((0.5, 0.5), 0),)))


def test_a_point_on_a_line_cuts_it() -> None:
    """FEMM's own rule. Catches a line whose pieces lose the condition, and a tee that is taken for a crossing."""
    outline = cleaned(square(((0.5, 0.0), (0.5, 0.4)), (Curve(4, 5),)))
    cut = pieces(outline)
    assert sorted(map(tuple, cut.ends[cut.curve == 0].tolist())) == [(0, 4), (4, 1)]
    assert cut.t[cut.curve == 0].ravel() == pytest.approx([0, 0.5, 0.5, 1])


def test_a_point_on_an_arc_cuts_it() -> None:
    """Catches a foot on the arc's chord instead of its circle."""
    outline = cleaned(
        Outline(
            "planar",
            np.array([(1.0, 0.0), (-1.0, 0.0), (np.cos(1.0), np.sin(1.0)), (0.0, 0.5)]),
            (Curve(0, 1, np.pi), Curve(1, 0), Curve(2, 3)),
            (),
        )
    )
    cut = pieces(outline)
    assert cut.t[cut.curve == 0, 1] == pytest.approx([1 / np.pi, 1])


def test_copies_of_a_line_are_dropped() -> None:
    """Catches overlapping lines, whose faces of no area would want labels. The one with a condition stays."""
    outline = cleaned(square(curves=(Curve(1, 0), Curve(2, 1, condition=3))))
    kept = pieces(outline)
    assert sorted(kept.curve.tolist()) == [0, 2, 3, 5]


def test_two_arcs_between_the_same_points_are_no_copies() -> None:
    """Catches a circle that is halved: its two arcs share both ends."""
    arcs = (Curve(0, 1, np.pi), Curve(1, 0, np.pi))
    assert len(pieces(cleaned(Outline("planar", np.array([(0.0, 0.0), (1.0, 0.0)]), arcs, ()))).curve) == 2
