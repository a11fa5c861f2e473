"""How far from the optimum of a maximum the optimum of its norm lies: the price of one smooth number for many places.

Toy: force share x + y, the stray field is x at one place and y at another, the larger of both is to stay below 1. The
optimum is (1, 1) whatever the share is. Norms trade the places off: there d force/dx : d force/dy = (x/y)^(p - 1), so
that where the larger one is held to 1 the other is share^(-1/(p - 1)).
"""

import itertools
import math
from functools import partial

import pytest
import smooth
import toy

from fluxbore.design.study import Variable
from fluxbore.optimize.executor import SerialExecutor
from fluxbore.optimize.search import run_search

VARIABLES = (Variable(toy.X, 0.2, 2.0), Variable(toy.Y, 0.2, 2.0))


def search(model, x=0.5, y=0.8, variables=VARIABLES):
    spec = smooth.study(x, y, variables=variables, relative_tolerance=1e-5, network="off")
    return run_search(spec, None, SerialExecutor(), None, model, True)


@pytest.mark.parametrize("exponent", [8, 32, 128])
@pytest.mark.parametrize("share", [1.0, 2.0, 4.0])
def test_where_two_places_are_equally_high_the_norm_gives_a_share_away(exponent, share):
    """Pins where the norm's optimum lies, and that what is lost is no more than log(share)/(p - 1) of one variable.

    Catches ratios of maximum to norm that are not renewed: with the start's, the search would end off the limit.
    """
    result = search(partial(smooth.corner, exponent=exponent, share=share))
    lower = share ** (-1 / (exponent - 1))
    off = min(math.dist(made.values.values(), (1.0, lower)) for made in result.history)
    assert off < 1e-4
    best = result.best
    assert best.evaluation.performance.stray_field <= 1.0 + 1e-9
    assert share + lower - 1e-4 <= best.objective <= share + 1 + 1e-9
    assert 1 - lower <= math.log(share) / (exponent - 1)


def test_a_single_place_that_moves_costs_next_to_nothing():
    """The ridge's top wanders with x and y; by its 8-norm the optimum is no worse than the best of a fine grid."""
    variables = (Variable(toy.X, -2.0, 2.0), Variable(toy.Y, -2.0, 2.0))
    result = search(smooth.ridge, 0.2, 0.2, variables)
    grid = [i / 50 - 2 for i in range(201)]
    exact = max(
        5 + x + 2 * y - 0.1 * (x * x + y * y)
        for x, y in itertools.product(grid, repeat=2)
        if smooth.ridge_peak(x, y) <= 1.0
    )
    assert result.best.evaluation.performance.stray_field <= 1.0 + 1e-9
    assert result.best.objective >= exact - 1e-3


def test_the_residual_is_the_norm_s_and_says_so_little():
    """At (1, 1) a maximum of two places leaves no gain; the norm's one gradient cannot tell: its residual is large."""
    model = partial(smooth.corner, share=2.0)
    spec = smooth.study(1.0, 1.0, variables=VARIABLES, max_evaluations=1, network="off")
    result = run_search(spec, None, SerialExecutor(), None, model, True)
    assert result.best.objective == 3.0
    assert result.optimality.residual > 0.05
