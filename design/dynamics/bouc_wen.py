"""The inner state of Bouc-Wen hysteresis, moved along exactly: no step is too long for it.

    dx_s = phi dx - psi |dx| |x_s|^(eta-1) x_s - xi dx |x_s|^eta                              (16), (18)

of the paper on the RotLin actuator; the model's survey is Ismail, Ikhouane and Rodellar (2009). (18) writes xi_s where
(16) has xi_i and Table II xi: they are taken as one parameter.

Time does not stand in it, only travel. With s the sense of a stretch of motion in one direction, y = s x_s and u the
way gone along it,

    dy/du = phi - (psi + xi) y^eta  for y >= 0,       dy/du = phi + (psi - xi) |y|^eta  for y < 0,

which for eta = 1 are two exponentials that meet at y = 0, and for any other eta

    u = (y/phi) 2F1(1, 1/eta; 1 + 1/eta; (psi + xi) y^eta/phi)

and its inverse, which a short stretch away from y = 0 need not ask: one step of the classical Runge-Kutta rule is as
good there. A stretch may therefore be taken in one step or in a million, to rounding. Euler's rule errs in
proportion to its steps, and leaves the bound for good from steps of 2/(psi + xi) on, 0.5 mm with the paper's numbers.

Valid for psi > 0, |xi| <= psi, where the state is bounded by (phi/(psi + xi))^(1/eta) from any start within (class I of
the survey) and a closed loop gives no work away; eta >= 1, below which the state at zero is not unique.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluxbore.design.errors import DesignError

Floats = NDArray[np.float64]

SHORT = 0.01
"""Of the length over which the state forgets: a fourth-order step errs by 1e-9 of the bound at most."""


@dataclass(frozen=True, slots=True)
class BoucWen:
    """phi (1), psi and xi (m^-eta), eta (1).

    Raises DesignError, one sentence, outside the range of validity above.
    """

    phi: float = 1.0
    psi: float = 3000.0
    xi: float = 1000.0
    eta: float = 1.0

    def __post_init__(self) -> None:
        for name, value, good, limit in (
            ("phi", self.phi, self.phi > 0, "above 0"),
            ("psi", self.psi, self.psi > 0, "above 0"),
            ("xi", self.xi, -self.psi < self.xi <= self.psi, f"above {-self.psi:g} and at most psi, {self.psi:g}"),
            ("eta", self.eta, self.eta >= 1, "1 or above"),
        ):
            if not (math.isfinite(value) and good):
                raise DesignError(f"{name} of the hysteresis must be finite and {limit}; got {value:g}.")

    @property
    def bound(self) -> float:
        """The largest |x_s| (m): what x_s tends to in a long stretch of motion."""
        return float((self.phi / (self.psi + self.xi)) ** (1 / self.eta))


def advance(model: BoucWen, state: float, moved: float) -> float:
    """x_s (m) after a stretch of `moved` (m, with its sign) in one direction, from x_s = state."""
    if moved == 0.0:
        return state
    sense = 1.0 if moved > 0 else -1.0
    y, u, phi = sense * state, abs(moved), model.phi
    rising, falling = model.psi + model.xi, model.psi - model.xi
    if model.eta != 1.0:
        return sense * _advance_power(model, y, u)
    if y < 0:
        to_zero = math.log1p(-falling * y / phi) / falling if falling > 0 else -y / phi
        if u <= to_zero:
            gained = -phi * math.expm1(-falling * u) / falling if falling > 0 else phi * u
            return sense * (y * math.exp(-falling * u) + gained)
        y, u = 0.0, u - to_zero
    kept = math.exp(-rising * u)
    return sense * (y * kept - phi * math.expm1(-rising * u) / rising)


def states(model: BoucWen, displacement: ArrayLike, start: float = 0.0) -> Floats:
    """x_s (m), (n,), at each row of a record of displacements (m), (n,), that begins at x_s = start.

    Between two rows the motion is taken to be in one direction. Only turning points are gone through one by one.
    """
    x = np.asarray(displacement, dtype=np.float64)
    if len(x) < 2:
        return np.full(len(x), start)
    if model.eta != 1.0:
        return _row_by_row(model, np.diff(x).tolist(), start)
    turns, stretch = _stretches(np.diff(x))
    ends = np.append(turns[1:], len(x) - 1)
    begun = np.empty(len(turns))
    state = start
    for number, moved in enumerate((x[ends] - x[turns]).tolist()):
        begun[number] = state
        state = advance(model, state, moved)
    after = _advance_rows(model, begun[stretch], x[1:] - x[turns[stretch]])
    return np.concatenate(([start], after))


def _row_by_row(model: BoucWen, moves: Sequence[float], start: float) -> Floats:
    """The states along moves (m), the first before them."""
    found = [start]
    for moved in moves:
        found.append(advance(model, found[-1], moved))
    return np.array(found)


def _stretches(steps: Floats) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """The row at which each stretch of one direction begins, and the stretch that each step belongs to.

    A rest belongs to the stretch before it.
    """
    sense = np.sign(steps)
    moving = np.flatnonzero(sense)
    if len(moving) == 0:
        return np.zeros(1, dtype=np.intp), np.zeros(len(steps), dtype=np.intp)
    turned = moving[1:][np.diff(sense[moving]) != 0]
    turns = np.concatenate((np.zeros(1, dtype=np.intp), turned))
    return turns, np.searchsorted(turns, np.arange(len(steps)), side="right") - 1


def _advance_rows(model: BoucWen, state: Floats, moved: Floats) -> Floats:
    """`advance` of many states at once, (n,), for eta = 1."""
    sense = np.where(moved < 0, -1.0, 1.0)
    y, u, phi = sense * state, np.abs(moved), model.phi
    rising, falling = model.psi + model.xi, model.psi - model.xi
    behind = np.maximum(-y, 0.0)  # below zero, by this much
    to_zero = np.log1p(falling * behind / phi) / falling if falling > 0 else behind / phi
    before = np.minimum(u, to_zero)
    gained = -phi * np.expm1(-falling * before) / falling if falling > 0 else phi * before
    left = np.where(u > to_zero, 0.0, gained - behind * np.exp(-falling * before))
    beyond = u - before
    begun = np.where(y < 0, 0.0, y)
    grown = begun * np.exp(-rising * beyond) - phi * np.expm1(-rising * beyond) / rising
    return np.asarray(sense * np.where((y < 0) & (u <= to_zero), left, grown))


def _advance_power(model: BoucWen, y: float, u: float) -> float:
    """The same for any exponent: along the travel from zero, which is negative below it."""
    if abs(y) > model.bound:
        raise DesignError(f"the hysteresis state must be at most {model.bound:g} m in size; got {abs(y):g} m.")
    if u * model.phi * model.eta <= SHORT * model.bound and not -4 * model.phi * u <= y <= 0:
        return min(_short(model, y, u), model.bound)
    goal = _travel(model, y) + u
    if goal <= 0:
        low, high = y, 0.0
    else:
        low, high = max(y, 0.0), model.bound
    for _ in range(200):  # bisection to the last bit: some fifty of them
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        if _travel(model, middle) < goal:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def _short(model: BoucWen, y: float, u: float) -> float:
    """One step of the classical Runge-Kutta rule."""
    phi, eta = model.phi, model.eta
    kept, sense = (model.psi + model.xi, 1.0) if y > 0 else (model.xi - model.psi, -1.0)
    first = phi - kept * (sense * y) ** eta
    second = phi - kept * (sense * (y + u / 2 * first)) ** eta
    third = phi - kept * (sense * (y + u / 2 * second)) ** eta
    fourth = phi - kept * (sense * (y + u * third)) ** eta
    return float(y + u / 6 * (first + 2 * (second + third) + fourth))


def _travel(model: BoucWen, y: float) -> float:
    """u from zero to y."""
    from scipy.special import hyp2f1

    share = (model.psi + model.xi) * y**model.eta if y >= 0 else -(model.psi - model.xi) * (-y) ** model.eta
    share /= model.phi
    if share >= 1:
        return math.inf
    return float(y / model.phi * hyp2f1(1.0, 1 / model.eta, 1 + 1 / model.eta, share))
