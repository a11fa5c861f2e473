"""Damaged FEMM files through whole solves: figures or a sentence, whatever stands in them."""

from __future__ import annotations

import femm_fuzz
import numpy as np

from fluxbore.design.bh_curve import MU_0
from fluxbore.fem.femm_model import BlockLabel, BlockProperty, BoundaryProperty, FemmModel, Node, Segment
from fluxbore.solving import solve

SEED = 20250611


def test_damaged_files_give_an_answer_or_one_sentence() -> None:
    """Catches any exception that is not ours, a warning of numpy's, a figure that is no number, and a deaf run."""
    kinds = []
    for number in range(75):
        item = femm_fuzz.mutant(SEED, number)
        try:
            kinds.append(femm_fuzz.outcome(item).kind)
        except Exception as error:
            raise AssertionError(f"file {number}, a damaged {item.name}") from error
    assert 7 < kinds.count("answer") < 60  # otherwise the damage is too great or too small to try anything
    assert kinds.count("MeshError") > 2


def test_a_number_gives_the_same_file_each_time() -> None:
    """Catches a run that cannot be repeated."""
    first, second = ([femm_fuzz.mutant(SEED, number) for number in range(40)] for _ in range(2))
    assert first == second
    assert len({item.text for item in first}) > 30


def test_parts_of_a_drawing_that_nothing_holds_have_a_zero_of_their_own() -> None:
    """Catches a singular matrix where only one of two separate parts has a boundary condition."""
    corners = ((0, 0), (10, 0), (10, 10), (0, 10))
    nodes = tuple(Node(float(x + shift), float(y)) for shift in (0, 30) for x, y in corners)
    lines = tuple(Segment(k, (k + 1) % 4, boundary=0) for k in range(4))
    lines += tuple(Segment(4 + k, 4 + (k + 1) % 4) for k in range(4))
    labels = tuple(BlockLabel(x, 5.0, 0) for x in (5.0, 35.0))
    magnet = BlockProperty("magnet", coercivity=1e5)
    zero = BoundaryProperty("A = 0", "prescribed")
    model = FemmModel(False, boundaries=(zero,), materials=(magnet,), nodes=nodes, segments=lines, labels=labels)
    found = solve(model, points=((5.0, 5.0), (35.0, 5.0)))
    assert found.solution.convergence.converged
    # A = 0 all round keeps the magnet's flux in; with no condition H_t = 0 lets B = μ0 H_c through.
    held, free = found.probe(np.array([(5.0, 5.0), (35.0, 5.0)])).flux_density
    assert abs(free[0] - MU_0 * 1e5) < 1e-9
    assert abs(held[0]) < 1e-9
