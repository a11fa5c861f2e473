"""Conditions on curves and points: who wins where they meet, ties and their signs, mixed edges."""

import numpy as np
import pytest
from manufactured import Level, levels, manufactured, misses, polygon

from fluxbore.fem.conditions import Conditions, Mixed, Prescribed, chain, sides
from fluxbore.fem.outline import Curve, Outline, Pair, Seed
from fluxbore.fem.problem import MagneticMaterial

UNIT = MagneticMaterial(1.0)


def square(*conditions: int | None, chart: str = "planar", pairs: tuple[Pair, ...] = ()) -> Outline:
    """Of side 1 from the origin: below, right, above (leftwards), left (downwards)."""
    points = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=float)
    curves = tuple(Curve(k, (k + 1) % 4, condition=c) for k, c in enumerate(conditions))
    assert chart in ("planar", "axisymmetric")
    return Outline("planar" if chart == "planar" else "axisymmetric", points, curves, (Seed((0.4, 0.4), 0),), pairs)


def one(outline: Outline, conditions: Conditions) -> Level:
    (level,) = levels(outline, conditions, 1)
    return level


def constant(value: float) -> Prescribed:
    return Prescribed(lambda points: np.full(points.shape[0], value))


def at(level: Level, x: float, y: float) -> int:
    return int(np.argmin(np.hypot(*(level.mesh.positions - (x, y)).T)))


def test_point_comes_before_curve_and_curve_before_later_one() -> None:
    """Catches another order of precedence than the documented one."""
    level = one(square(0, 1, None, None), Conditions([constant(1.0), constant(2.0)], {0: 5.0}))
    values = level.conditioned.prescribed
    assert values[at(level, 0, 0)] == 5.0
    assert values[at(level, 1, 0)] == 1.0
    assert values[at(level, 1, 1)] == 2.0


def test_potential_counts_by_radius_around_the_axis() -> None:
    """Catches ψ = A: a prescribed A of 3 Wb/m at r = 1, and nothing on the axis, whatever is written there."""
    level = one(square(0, 0, None, 0, chart="axisymmetric"), Conditions([constant(3.0)]))
    r = level.mesh.positions[:, 0]
    fixed = level.mesh.topology.freedom < 0
    assert level.conditioned.prescribed[fixed] == pytest.approx(3 * r[fixed])
    assert np.all(fixed[r == 0])


def test_without_any_condition_one_node_is_chosen() -> None:
    """Catches a singular matrix: only differences of A matter then."""
    level = one(square(None, None, None, None), Conditions())
    assert np.count_nonzero(level.mesh.topology.freedom < 0) == 1
    assert np.all(level.conditioned.loose == 0)


def test_any_mixed_condition_of_c0_holds() -> None:
    """Catches a zero chosen where there is no choice, for a c0 of either sign; c1 alone says nothing of the zero."""
    for c0, held in ((1.0, True), (-1.0, True), (0.0, False)):
        level = one(square(0, None, None, None), Conditions([Mixed(c0, 2.0)]))
        assert np.count_nonzero(level.mesh.topology.freedom < 0) == (0 if held else 1)


def test_parts_that_nothing_holds_are_numbered() -> None:
    """Catches a held part among them, and two of them under one number."""
    points = np.array([(x + dx, dy) for x in (0, 2, 4) for dx, dy in ((0, 0), (1, 0), (1, 1), (0, 1))], dtype=float)
    curves = (*polygon(0, 4), *polygon(4, 4, 0), *polygon(8, 4))
    seeds = tuple(Seed((x + 0.5, 0.5), k) for k, x in enumerate((0, 2, 4)))
    level = one(Outline("planar", points, curves, seeds), Conditions([constant(0.0)]))
    x = level.mesh.positions[:, 0]
    loose = level.conditioned.loose
    assert np.all(loose[(x >= 2) & (x <= 3)] == -1)
    first, last = (np.unique(loose[part]).tolist() for part in (x <= 1, x >= 4))
    assert sorted(first + last) == [0, 1]


@pytest.mark.parametrize("sign", [1, -1])
def test_tied_nodes_face_each_other(sign: int) -> None:
    """Catches mates at other heights, or of the wrong sign."""
    level = one(square(None, None, None, None, pairs=(Pair(1, 3, sign, True),)), Conditions())
    topology, space = level.mesh.topology, level.mesh.positions
    signs = np.ones(space.shape[0]) if topology.sign is None else topology.sign
    for node in np.flatnonzero(np.isclose(space[:, 0], 0.0)):
        mate = at(level, 1.0, float(space[node, 1]))
        assert topology.freedom[mate] == topology.freedom[node]
        if topology.freedom[node] >= 0:
            assert signs[mate] * signs[node] == sign


def test_a_node_that_is_minus_itself_is_zero() -> None:
    """Catches an unknown of two signs: the centre of a sector whose sides, left and below, are antiperiodic."""
    level = one(square(None, None, None, None, pairs=(Pair(3, 0, -1, True),)), Conditions())
    centre = at(level, 0, 0)
    assert level.mesh.topology.freedom[centre] < 0
    assert level.conditioned.prescribed[centre] == 0.0
    assert np.count_nonzero(level.mesh.topology.freedom < 0) == 1


def test_two_pairs_tie_four_corners_to_one_unknown() -> None:
    """Catches ties that do not reach through one another."""
    level = one(square(None, None, None, None, pairs=(Pair(1, 3, 1, True), Pair(0, 2, -1, True))), Conditions())
    corners = [at(level, x, y) for x in (0, 1) for y in (0, 1)]
    assert len({int(level.mesh.topology.freedom[k]) for k in corners}) == 1


def test_prescribed_value_reaches_the_tied_node() -> None:
    """Catches a mate left free, or with the wrong sign: A = 2 on the left is −2 on the right."""
    level = one(square(None, None, None, 0, pairs=(Pair(3, 1, -1, True),)), Conditions([constant(2.0)]))
    right = np.isclose(level.mesh.positions[:, 0], 1.0)
    assert np.all(level.mesh.topology.freedom[right] < 0)
    assert level.conditioned.prescribed[right] == pytest.approx(-2.0)


def test_mixed_condition_holds_a_uniform_field() -> None:
    """Catches a sign of c0 or c1: A = x, ν ∂A/∂n + c0 A + c1 = 1 + 2·1 − 3 = 0 on the right side."""
    level = one(square(None, 1, None, 0), Conditions([constant(0.0), Mixed(2.0, -3.0)]))
    solution = manufactured(level, (UNIT,))
    assert np.sqrt(misses(solution, lambda p: np.broadcast_to((0.0, -1.0), p.shape))[0].max()) < 1e-9


def test_mixed_condition_around_the_axis_holds_a_uniform_field() -> None:
    """Catches a factor of r: B_z = 1, A = r/2, and H_z on the outer wall balances c0 A + c1 = 2·0.5 − 2 = −1."""
    level = one(square(None, 0, None, None, chart="axisymmetric"), Conditions([Mixed(2.0, -2.0)]))
    solution = manufactured(level, (UNIT,))
    assert np.sqrt(misses(solution, lambda p: np.broadcast_to((0.0, 1.0), p.shape))[0].max()) < 1e-9


def test_chain_orders_edges() -> None:
    """Catches edges in the order of the mesh instead of the curve's."""
    assert chain(np.array([(4, 7, 5), (1, 4, 2), (7, 0, 8)])).tolist() == [1, 2, 4, 5, 7, 8, 0]


def test_sides_tell_rims_from_inner_lines() -> None:
    """Catches a rim taken for an inner line, and its inside for its outside."""
    points = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=float)
    curves = (*polygon(0, 4)[:2], Curve(3, 2), Curve(3, 0), Curve(0, 2))
    outline = Outline("planar", points, curves, (Seed((0.7, 0.3), 0), Seed((0.3, 0.7), 1)))
    level = one(outline, Conditions())
    found = sides(level.triangulation)
    for number, expected in enumerate((1, 1, -1, 1, 0)):
        assert set(found[level.triangulation.curve == number].tolist()) == {expected}
