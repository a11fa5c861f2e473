"""Models with known production: linear, quadratic and a smooth maximum, with exact gradients; importable by workers."""

import math
import threading
from dataclasses import replace

import toy
from toy import X, Y

from fluxbore.design.performance import Performance
from fluxbore.design.study import Constraint, Objective, Production, Search, Tolerance, Variable
from fluxbore.optimize.evaluation import NOT_CONVERGED, OK, Evaluation, Norm, failure


def evaluation(figures, slopes, gradient, norms=None, fidelity="fem"):
    """Figures with those of their slopes, by X and Y, that were asked for."""
    asked = {name: {key: row[key] for key in gradient} for name, row in slopes.items()} if gradient else None
    return Evaluation(fidelity, OK, (), Performance(**figures), gradient=asked, norms=norms)


def linear(design, fidelity="fem", gradient=()):
    """Force 10 + 3 x - y, stray field 2 x + y."""
    toy.log(design)
    x, y = design.number(X), design.number(Y)
    figures = {"force_constant": 10 + 3 * x - y, "stray_field": 2 * x + y}
    return evaluation(figures, {"force_constant": {X: 3.0, Y: -1.0}, "stray_field": {X: 2.0, Y: 1.0}}, gradient)


def without_slopes(design, fidelity="fem", gradient=()):
    return linear(design, fidelity)


def curved(design, fidelity="fem", gradient=()):
    """Force 10 + x + x^2/2, whose mean is above the nominal value by half the variance; stray field x."""
    x = design.number(X)
    figures = {"force_constant": 10 + x + x * x / 2, "stray_field": x}
    return evaluation(figures, {"force_constant": {X: 1 + x, Y: 0.0}, "stray_field": {X: 1.0, Y: 0.0}}, gradient)


def largest(design, fidelity="fem", gradient=()):
    """Stray field as the larger of x and y, its norm with p = 8 and the norm's slopes."""
    x, y = design.number(X), design.number(Y)
    norm = ((x**8 + y**8) / 2) ** 0.125
    rows = {"stray_field": {key: norm**-7 * value**7 / 2 for key, value in ((X, x), (Y, y))}}
    return evaluation({"stray_field": max(x, y)}, rows, gradient, {"stray_field": Norm(8, norm)})


def fragile(design, fidelity="fem", gradient=()):
    """`linear` that does not converge above x = 1.2."""
    if design.number(X) > 1.2:
        return failure(fidelity, NOT_CONVERGED, f"No convergence at x = {design.number(X)}.")
    return linear(design, fidelity, gradient)


def hill(design, fidelity="fem", gradient=()):
    """Force 10 - (x - 2)^2 - (y - 2)^2, stray field x + y + 0.1 x^2; the network is the same."""
    toy.log(design)
    x, y = design.number(X), design.number(Y)
    figures = {"force_constant": 10 - (x - 2) ** 2 - (y - 2) ** 2, "stray_field": x + y + 0.1 * x * x}
    rows = {
        "force_constant": {X: -2 * (x - 2), Y: -2 * (y - 2)},
        "stray_field": {X: 1 + 0.2 * x, Y: 1.0},
    }
    return evaluation(figures, rows, gradient, fidelity=fidelity)


def cubic(design, fidelity="fem", gradient=()):
    """The force of `hill`, stray field x^3: what it scatters by grows with x."""
    x = design.number(X)
    made = hill(design, fidelity, gradient)
    rows = {**made.gradient, "stray_field": {X: 3 * x * x, Y: 0.0}} if made.gradient else None
    return replace(made, performance=replace(made.performance, stray_field=x**3), gradient=rows)


def hill_study(target=0.95, *, limit=2.0, checks=0, width=0.3, samples=2000, floor=None):
    """Climb `hill` under a stray field that production makes scatter."""
    constraints = [Constraint("stray_field", upper=limit)]
    if floor is not None:
        constraints.append(Constraint(Y, lower=floor))
    return toy.spec(
        x=0.5,
        y=0.5,
        objective=Objective("force_constant", True),
        variables=(Variable(X, 0.0, 4.0), Variable(Y, 0.0, 4.0)),
        constraints=tuple(constraints),
        search=Search(algorithm="COBYLA", max_evaluations=120, relative_tolerance=1e-7),
        production=production(width, checks=checks, target=target, samples=samples),
    )


def production(*widths, distribution="normal", samples=4000, checks=0, seed=1, target=None):
    """Tolerances of +-width for X and Y, one for each width; a pair is minus and plus."""
    pairs = [width if isinstance(width, tuple) else (-width, width) for width in widths]
    tolerances = tuple(Tolerance(key, *pair, distribution) for key, pair in zip((X, Y), pairs, strict=False))
    return Production(tolerances, samples, checks, seed, target)


class Interrupted(Exception):
    """Stands for the kill of a run."""


def interrupting(after):
    """A progress report that ends the run once this many designs are done."""
    lock = threading.Lock()

    def report(progress):
        with lock:
            if progress.done >= after:
                raise Interrupted

    return report


def normal_share(z):
    return (1 + math.erf(z / math.sqrt(2))) / 2
