"""Bi-objective problems whose fronts are known, as models of the toy actuator; importable by worker processes.

The first objective is force_constant, the second one total_mass, both to be minimised.
"""

import math

import toy

from fluxbore.design.performance import Performance
from fluxbore.design.study import Constraint, Objective, Pareto, Search, Variable
from fluxbore.optimize.evaluation import NOT_CONVERGED, OK, Evaluation, Norm, failure

FIRST, SECOND = "force_constant", "total_mass"


def made(fidelity, gradient, *, first, second, stray=None, norms=None):
    """An evaluation from (value, slope by x, slope by y) of each figure; the slopes only where they are asked for."""
    items = {FIRST: first, SECOND: second, **({} if stray is None else {"stray_field": stray})}
    slopes = {name: {toy.X: item[1], toy.Y: item[2]} for name, item in items.items()}
    return Evaluation(
        fidelity,
        OK,
        (),
        Performance(**{name: item[0] for name, item in items.items()}),
        gradient={name: {key: item[key] for key in gradient} for name, item in slopes.items()} if gradient else None,
        norms=norms,
    )


def quadratic(design, fidelity="fem", gradient=()):
    """u = x^2 + y^2, v = (x - 1)^2 + y^2: the front is y = 0, sqrt(u) + sqrt(v) = 1."""
    toy.log(design)
    x, y = design.number(toy.X), design.number(toy.Y)
    return made(
        fidelity,
        gradient,
        first=(x * x + y * y, 2 * x, 2 * y),
        second=((x - 1) ** 2 + y * y, 2 * (x - 1), 2 * y),
        stray=(1 + x * x, 2 * x, 0.0),
    )


def free(design, fidelity="fem"):
    """`quadratic` of a model that has no gradients."""
    return quadratic(design, fidelity)


def ellipses(design, fidelity="fem", gradient=(), *, first, second):
    """Two quadratics a (x - c)^2 + 2 b (x - c)(y - d) + e (y - d)^2, each given by (a, b, e, c, d)."""

    def form(a, b, e, c, d):
        x, y = design.number(toy.X) - c, design.number(toy.Y) - d
        return a * x * x + 2 * b * x * y + e * y * y, 2 * (a * x + b * y), 2 * (b * x + e * y)

    return made(fidelity, gradient, first=form(*first), second=form(*second))


def upside_down(design, fidelity="fem", gradient=()):
    """`quadratic` with its first objective a million times larger and to be maximised, its second one a thousandth."""
    x, y = design.number(toy.X), design.number(toy.Y)
    return made(
        fidelity,
        gradient,
        first=(-1e6 * (x * x + y * y), -2e6 * x, -2e6 * y),
        second=(1e-3 * ((x - 1) ** 2 + y * y), 2e-3 * (x - 1), 2e-3 * y),
    )


def promising(design, fidelity="fem", gradient=()):
    """`quadratic` that takes the keys of a gradient and does not give one."""
    return quadratic(design, fidelity)


def fonseca(design, fidelity="fem", gradient=()):
    """Fonseca and Fleming (1995), two variables: x = y in [-1/sqrt 2, 1/sqrt 2] is the front, which is concave."""
    x, y = design.number(toy.X), design.number(toy.Y)
    s = 1 / math.sqrt(2)
    one, other = (math.exp(-((x - c) ** 2) - (y - c) ** 2) for c in (s, -s))
    return made(
        fidelity,
        gradient,
        first=(1 - one, 2 * (x - s) * one, 2 * (y - s) * one),
        second=(1 - other, 2 * (x + s) * other, 2 * (y + s) * other),
    )


def _zdt(h, dh_dx, dh_dg):
    """Zitzler, Deb and Thiele (2000) in two variables: u = x, v = g h(x, g), g = 1 + 9 y; the front is y = 0."""

    def model(design, fidelity, gradient):
        x, y = design.number(toy.X), design.number(toy.Y)
        g = 1 + 9 * y
        value = h(x, g)
        second = (g * value, g * dh_dx(x, g), 9 * (value + g * dh_dg(x, g)))
        return made(fidelity, gradient, first=(x, 1.0, 0.0), second=second)

    return model


def zdt1(design, fidelity="fem", gradient=()):
    """v = 1 - sqrt(u): convex."""
    root = _zdt(
        lambda x, g: 1 - math.sqrt(x / g),
        lambda x, g: -0.5 / math.sqrt(max(x, 1e-12) * g),
        lambda x, g: 0.5 * math.sqrt(x / g) / g,
    )
    return root(design, fidelity, gradient)


def zdt2(design, fidelity="fem", gradient=()):
    """v = 1 - u^2: concave, so that no weighted sum finds more than its ends."""
    square = _zdt(lambda x, g: 1 - (x / g) ** 2, lambda x, g: -2 * x / g**2, lambda x, g: 2 * x * x / g**3)
    return square(design, fidelity, gradient)


def zdt3(design, fidelity="fem", gradient=()):
    """v = 1 - sqrt(u) - u sin(10 pi u): five pieces."""
    waves = _zdt(
        lambda x, g: 1 - math.sqrt(x / g) - x / g * math.sin(10 * math.pi * x),
        lambda x, g: (
            -0.5 / math.sqrt(max(x, 1e-12) * g)
            - math.sin(10 * math.pi * x) / g
            - 10 * math.pi * x / g * math.cos(10 * math.pi * x)
        ),
        lambda x, g: 0.5 * math.sqrt(x / g) / g + x / g**2 * math.sin(10 * math.pi * x),
    )
    return waves(design, fidelity, gradient)


def friends(design, fidelity="fem", gradient=()):
    """Both objectives have their least at x = 2, y = 3."""
    x, y = design.number(toy.X) - 2, design.number(toy.Y) - 3
    return made(
        fidelity, gradient, first=(1 + x * x + y * y, 2 * x, 2 * y), second=(5 + 3 * x * x + y * y, 6 * x, 2 * y)
    )


def lazy(design, fidelity="fem", gradient=()):
    """The first objective does not care for y: of its many optima only y = 0 is on the front v = (1 - u)^2."""
    x, y = design.number(toy.X), design.number(toy.Y)
    return made(fidelity, gradient, first=(x, 1.0, 0.0), second=((1 - x) ** 2 + y * y, 2 * (x - 1), 2 * y))


def moody(design, fidelity="fem", gradient=()):
    """`quadratic` that does not converge in a strip above the front, and raises in another."""
    x, y = design.number(toy.X), design.number(toy.Y)
    if 0.3 < y < 0.4:
        return failure(fidelity, NOT_CONVERGED, "No convergence.")
    if 0.5 < x < 0.9 and y > 0.15:
        raise RuntimeError("a bad day")
    return quadratic(design, fidelity, gradient)


def moody_free(design, fidelity="fem"):
    """`moody` without gradients."""
    return moody(design, fidelity)


def rough(design, fidelity="fem", gradient=()):
    """`quadratic` whose stray field is a maximum: the larger of two slopes, with a norm that stands in for it.

    Of values a = x and b = 0.8 - x + y: norm = (mean of a^p, b^p)^(1/p), p = 12.
    """
    x, y = design.number(toy.X), design.number(toy.Y)
    parts, p = (max(x, 0.0) + 0.2, max(0.8 - x + y, 0.0) + 0.2), 12
    mean = sum(part**p for part in parts) / 2
    norm = mean ** (1 / p)
    by_part = [mean ** (1 / p - 1) * part ** (p - 1) / 2 for part in parts]
    slope_x = by_part[0] * (x > 0) - by_part[1] * (0.8 - x + y > 0)
    return made(
        fidelity,
        gradient,
        first=(x * x + y * y, 2 * x, 2 * y),
        second=((x - 1) ** 2 + y * y, 2 * (x - 1), 2 * y),
        stray=(max(parts), slope_x, by_part[1] * (0.8 - x + y > 0)),
        norms={"stray_field": Norm(float(p), norm)},
    )


def study(
    x=0.4,
    y=0.5,
    *,
    points=9,
    method="epsilon constraint",
    lower=-1.0,
    upper=2.0,
    stray=None,
    maximise=(False, False),
    **search,
):
    return toy.spec(
        x=x,
        y=y,
        objective=Objective(FIRST, maximise[0]),
        variables=(Variable(toy.X, lower, upper), Variable(toy.Y, lower, upper)),
        constraints=() if stray is None else (Constraint("stray_field", upper=stray),),
        search=Search(**{"algorithm": "auto", "network": "off", **search}),
        pareto=Pareto(Objective(SECOND, maximise[1]), points, method),
    )
