"""Toy models with exact derivatives, for searches by gradients; importable by worker processes.

Each brings what is asked for: `Evaluation.gradient` by the dotted keys, figures and derivatives from one formula.
"""

import math
import os
from dataclasses import replace

from toy import N, X, Y, log, spec

from fluxbore.design.performance import Performance
from fluxbore.design.study import Constraint, Objective, Search, Variable
from fluxbore.optimize.evaluation import NOT_CONVERGED, OK, Evaluation, Norm, failure


def made(figures, slopes, gradient, norms=None, fidelity="fem"):
    """figures : name -> value; slopes : name -> {key: derivative}."""
    wanted = {name: {key: row.get(key, 0.0) for key in gradient} for name, row in slopes.items()} if gradient else None
    return Evaluation(fidelity, OK, (), Performance(**figures), gradient=wanted, norms=norms)


def rosenbrock(design, fidelity="fem", gradient=()):
    """Force 10 - a tamer Rosenbrock function; stray field x^2 + y^2; mass x + y. The network is a smoother function."""
    log(design)
    x, y = design.number(X), design.number(Y)
    if fidelity == "network":
        return made({"force_constant": 100 - (x - 0.5) ** 2 - (y - 0.5) ** 2}, {}, (), fidelity=fidelity)
    valley = y - x * x
    return made(
        {"force_constant": 10 - (1 - x) ** 2 - 3 * valley**2, "stray_field": x * x + y * y, "total_mass": x + y},
        {
            "force_constant": {X: 2 * (1 - x) + 12 * x * valley, Y: -6 * valley},
            "stray_field": {X: 2 * x, Y: 2 * y},
            "total_mass": {X: 1.0, Y: 1.0},
        },
        gradient,
    )


def counted(design, fidelity="fem", gradient=()):
    """`rosenbrock` with its top moved by the count: the best count is 3, where the force is 10 + 3 - 9/6."""
    evaluation = rosenbrock(design, fidelity, gradient)
    n = design.number(N)
    figures = evaluation.performance
    force = figures.force_constant + n - n * n / 6
    performance = Performance(force_constant=force, stray_field=figures.stray_field, total_mass=figures.total_mass)
    return Evaluation(fidelity, OK, (), performance, gradient=evaluation.gradient)


def half(design, fidelity="fem", gradient=()):
    """`rosenbrock` in which everything beyond x = 0.7 fails, one way or another."""
    x, y = design.number(X), design.number(Y)
    if fidelity == "fem" and x > 0.7:
        kind = int(1e6 * abs(x + 2 * y)) % 3
        if kind == 0:
            raise RuntimeError("a bad day")
        if kind == 1:
            return failure(fidelity, NOT_CONVERGED, "No convergence.")
        return Evaluation(fidelity, OK, (), Performance(stray_field=math.nan))
    return rosenbrock(design, fidelity, gradient)


def crash(design, fidelity="fem", gradient=()):
    """`rosenbrock` that takes its process with it beyond x = 0.7."""
    if fidelity == "fem" and design.number(X) > 0.7:
        os._exit(3)
    return rosenbrock(design, fidelity, gradient)


def study(x=0.2, y=0.2, constraints=None, variables=None, figure="force_constant", maximise=True, **search):
    limits = (Constraint("stray_field", upper=1.0),) if constraints is None else constraints
    moved = (Variable(X, -2.0, 2.0), Variable(Y, -2.0, 2.0)) if variables is None else variables
    return spec(
        x=x,
        y=y,
        objective=Objective(figure, maximise),
        variables=moved,
        constraints=limits,
        search=Search(**search),
    )


def ridge_parts(x, y):
    """A bump along a line, its top between -1 and 1 wherever x and y are: 41 samples and their slopes by x and y."""
    for i in range(41):
        s = i / 20 - 1
        top = 0.2 * x - 0.1 * y
        height = 1 + 0.3 * x + 0.2 * y
        bump = math.exp(-2 * (s - top) ** 2)
        yield height * bump, 0.3 * bump + 0.8 * height * bump * (s - top), 0.2 * bump - 0.4 * height * bump * (s - top)


def ridge_peak(x, y):
    return max(value for value, _, _ in ridge_parts(x, y))


def ridge(design, fidelity="fem", gradient=()):
    """Force and a stray field that is the largest along a line, with its 8-norm; its derivatives are the norm's."""
    log(design)
    x, y = design.number(X), design.number(Y)
    parts = list(ridge_parts(x, y))
    mean = sum(value**8 for value, _, _ in parts) / len(parts)
    rows = [sum(part[0] ** 7 * part[i] for part in parts) / len(parts) * mean ** (1 / 8 - 1) for i in (1, 2)]
    return made(
        {"force_constant": 5 + x + 2 * y - 0.1 * (x * x + y * y), "stray_field": max(part[0] for part in parts)},
        {"force_constant": {X: 1 - 0.2 * x, Y: 2 - 0.2 * y}, "stray_field": {X: rows[0], Y: rows[1]}},
        gradient,
        {"stray_field": Norm(8.0, mean ** (1 / 8))},
        fidelity,
    )


def unkept(design, fidelity="fem", gradient=()):
    """`rosenbrock` without the derivatives of the stray field."""
    evaluation = rosenbrock(design, fidelity, gradient)
    kept = {name: row for name, row in (evaluation.gradient or {}).items() if name != "stray_field"}
    return replace(evaluation, gradient=kept or None)


def nothing(design, fidelity="fem", gradient=()):
    return failure(fidelity, NOT_CONVERGED, "No convergence.")


def contrary(design, fidelity="fem", gradient=()):
    """`rosenbrock` whose derivatives all have the wrong sign."""
    evaluation = rosenbrock(design, fidelity, gradient)
    turned = {name: {key: -slope for key, slope in row.items()} for name, row in (evaluation.gradient or {}).items()}
    return replace(evaluation, gradient=turned or None)


def vanishing(design, fidelity="fem", gradient=()):
    """`rosenbrock` that has no derivatives by y where y is 0, as where a part of an actuator vanishes."""
    evaluation = rosenbrock(design, fidelity, gradient)
    if not evaluation.gradient or design.number(Y) != 0.0:
        return evaluation
    kept = {name: {key: row[key] for key in row if key != Y} for name, row in evaluation.gradient.items()}
    return replace(evaluation, gradient=kept)


def edge(design, fidelity="fem", gradient=()):
    """`vanishing` that has no figures at all next to y = 0."""
    if fidelity == "fem" and 0.0 < design.number(Y) < 0.01:
        return failure(fidelity, NOT_CONVERGED, "No convergence.")
    return vanishing(design, fidelity, gradient)


def corner(design, fidelity="fem", gradient=(), exponent=32, share=2.0):
    """Force share x + y; a stray field that is the larger of x and y at two places, with its norm."""
    x, y = design.number(X), design.number(Y)
    norm = ((x**exponent + y**exponent) / 2) ** (1 / exponent)
    rows = {key: (value / norm) ** (exponent - 1) / 2 for key, value in ((X, x), (Y, y))}
    return made(
        {"force_constant": share * x + y, "stray_field": max(x, y)},
        {"force_constant": {X: share, Y: 1.0}, "stray_field": rows},
        gradient,
        {"stray_field": Norm(float(exponent), norm)},
        fidelity,
    )
