"""A toy actuator of two lengths and a count, and models of it that cost nothing; importable by worker processes."""

import math
import os
import random
import signal
import time
from pathlib import Path

from fluxbore.design.errors import DesignError
from fluxbore.design.keys import Key
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Kind, Spec
from fluxbore.design.study import Axis, Constraint, Objective, Search, Study, Sweep, Variable
from fluxbore.optimize.evaluation import NOT_CONVERGED, OK, Evaluation, PositionResult, failure

X, Y, N = "actuator.x", "actuator.y", "actuator.n"


def resolve(given):
    return dict(given)


def from_values(values):
    if values[X] > 9 and values[Y] > 9:
        raise DesignError(f"actuator.x must not exceed 9 m where actuator.y does; got {values[X]}, {values[Y]}.")
    return tuple(values.items())


TOY = Kind(
    "toy",
    (
        Key(X, "", minimum=-100.0, maximum=100.0),
        Key(Y, "", minimum=-100.0, maximum=100.0),
        Key(N, "", kind="integer", minimum=0, maximum=100),
    ),
    (),
    resolve,
    from_values,
)


def spec(*, x=1.0, y=1.0, n=1, **study) -> Spec:
    return Spec(TOY, {X: x, Y: y, N: n}, Study(**study), (), {}, {})


def square(points=5) -> Sweep:
    """A grid of x and y from 0 to 10, so that its last corner cannot be built."""
    values = tuple(10.0 * i / (points - 1) for i in range(points))
    return Sweep("square", (Axis(X, values), Axis(Y, values)))


def two_sweeps(points=5) -> Spec:
    counts = Sweep("counts", (Axis(N, (0.0, 1.0, 2.0, 3.0)),))
    return spec(sweeps=(square(points), counts), objective=Objective("force_constant", True))


def log(design: Spec) -> None:
    """Leave a trace of this evaluation where TOY_LOG points: one short append is one line, whole."""
    if path := os.environ.get("TOY_LOG"):
        with Path(path).open("a") as file:
            file.write(f"{design.number(X)!r} {design.number(Y)!r} {int(design.number(N))}\n")


def plain(design: Spec, fidelity="fem") -> Evaluation:
    """Two figures with many digits; one column of the grid does not converge."""
    log(design)
    x, y, n = design.number(X), design.number(Y), design.number(N)
    if x == 5.0:
        return failure(fidelity, NOT_CONVERGED, f'No convergence at x = {x}, "y" = {y};\nthe last residual is 0.1.')
    force = math.sin(x / 3) + math.cos(y / 7) + n / 3
    position = PositionResult(x, (x / 3, y / 3, 0.1), (0.1, 0.2, 0.3), force, force, math.nan, 3, 1e-11)
    return Evaluation(fidelity, OK, (), Performance(force_constant=force, stray_field=x / 3), (position,))


def slow(design: Spec, fidelity="fem") -> Evaluation:
    time.sleep(0.02)
    return plain(design, fidelity)


def crashing(design: Spec, fidelity="fem") -> Evaluation:
    """Three ways to lose a process and two to fail within it, at five designs of the grid."""
    point = design.number(X), design.number(Y), design.number(N)
    if point == (0.0, 0.0, 1):
        os._exit(7)
    if point == (0.0, 2.5, 1):
        os.kill(os.getpid(), signal.SIGKILL)
    if point == (0.0, 5.0, 1):
        os.kill(os.getpid(), signal.SIGSEGV)
    if point == (0.0, 7.5, 1):
        raise MemoryError
    if point == (0.0, 10.0, 1):
        raise ZeroDivisionError("division by zero")
    return plain(design, fidelity)


def rosenbrock(design: Spec, fidelity="fem") -> Evaluation:
    """Force 10 - a tamer Rosenbrock function; stray field x^2 + y^2, which held below 1 puts the optimum on the limit.

    The network is another, smoother function that knows no stray field, as in life.
    """
    log(design)
    x, y = design.number(X), design.number(Y)
    if fidelity == "network":
        return Evaluation(fidelity, OK, (), Performance(force_constant=100 - (x - 0.5) ** 2 - (y - 0.5) ** 2))
    force = 10 - (1 - x) ** 2 - 3 * (y - x**2) ** 2
    return Evaluation(fidelity, OK, (), Performance(force_constant=force, stray_field=x * x + y * y, total_mass=x + y))


def actuator_like(design: Spec, fidelity="fem") -> Evaluation:
    """Shaped like the real study: a ring width x with an inner optimum, a yoke y that costs winding but shields.

    x, y in mm. The stray field falls steeply with the yoke; the network sees no saturation and no stray field.
    """
    log(design)
    x, y = design.number(X), design.number(Y)
    winding = 2.75 - y
    if winding <= 0.2:
        return failure(fidelity, "invalid", "no winding")
    ring = 1 - 0.035 * (x - 1.5 - 0.4 * (y - 0.4)) ** 2 + 0.002 * (x - 1.5) ** 3
    saturation = 1.0 if fidelity == "network" else 1 - 0.5 * math.exp(-y / 0.35) * (1 + 0.05 * x)
    force = 5 * ring * saturation * winding * (1 - 0.1 * winding)
    if fidelity == "network":
        return Evaluation(fidelity, OK, (), Performance(force_constant=force * 1.2))
    stray = 0.09 * math.exp(-y / 0.6) * (1 - 0.02 * x) + 0.002
    return Evaluation(fidelity, OK, (), Performance(force_constant=force, stray_field=stray))


def moody(design: Spec, fidelity="fem") -> Evaluation:
    """`rosenbrock` that fails, raises or gives no figure at a third of all points, always the same ones."""
    x, y = design.number(X), design.number(Y)
    chance = random.Random(f"{x!r} {y!r} {os.environ.get('TOY_SEED', '')}").random()
    if chance < 0.1:
        raise RuntimeError("a bad day")
    if chance < 0.2:
        return failure(fidelity, NOT_CONVERGED, "No convergence.")
    if chance < 0.3:
        return Evaluation(fidelity, OK, (), Performance(stray_field=x * x + y * y))
    return rosenbrock(design, fidelity)


def rosenbrock_study(x=0.2, y=0.2, limit=1.0, **search) -> Spec:
    return spec(
        x=x,
        y=y,
        objective=Objective("force_constant", True),
        variables=(Variable(X, -2.0, 2.0, 0.05), Variable(Y, -2.0, 2.0)),
        constraints=(Constraint("stray_field", upper=limit),),
        search=Search(**search),
    )


def actuator_study(x=3.0, y=0.9, **search) -> Spec:
    return spec(
        x=x,
        y=y,
        objective=Objective("force_constant", True),
        variables=(Variable(X, 0.5, 6.0, 0.05), Variable(Y, 0.3, 2.5, 0.05)),
        constraints=(Constraint("stray_field", upper=1.0, relative_to_start=True), Constraint(Y, lower=0.5)),
        search=Search(**search),
    )
