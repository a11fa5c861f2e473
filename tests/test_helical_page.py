"""The page on lead screws by finite elements: its script runs, and the figures that it quotes are the program's."""

from __future__ import annotations

import contextlib
import io
import re
from pathlib import Path

import numpy as np
import pytest
from rotlin_section import PERIOD, POLES, backed, ideal
from scipy.optimize import brentq

from fluxbore.design.lead_screw import Arcs
from fluxbore.design.materials import standard
from fluxbore.fem.helical import solve
from fluxbore.fem.helical_arcs import arc_force, arc_harmonics
from fluxbore.fem.helical_force import force
from fluxbore.geometry.helical_bands import alternating
from fluxbore.geometry.helical_section import HelicalSection

PAGE = (Path(__file__).parent.parent / "docs" / "helical.md").read_text(encoding="utf-8")
SIXTY = Arcs(np.pi / 3, 6, stepped=True)


def row(name: str) -> list[float]:
    """The numbers in the row of a table, without a minus sign of typography."""
    (line,) = re.findall(rf"^\| {re.escape(name)} \|(.*)\|$", PAGE, re.MULTILINE)
    return [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?", line.replace("−", "-"))]


def peak(section: HelicalSection) -> float:
    return force(solve(section)) * POLES / 2


def test_the_script_runs() -> None:
    """Three routes to one force, in thick steel."""
    (script,) = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(script, {})
    stress, virtual, by_torque = map(float, printed.getvalue().split())
    assert stress == pytest.approx(virtual, rel=1e-9)
    assert stress == pytest.approx(by_torque, rel=1e-9)
    assert stress == pytest.approx(186.8, abs=0.2)


@pytest.mark.parametrize("thickness", ["5.5", "1.0", "0.5", "0.3", "0.1"])
def test_what_iron_does(thickness: str) -> None:
    bands = alternating(1.25)
    found = peak(backed(bands, curve=standard()["1010"].curve, thickness=float(thickness) * 1e-3))
    best = peak(ideal(bands, bands, PERIOD / 4))
    shown, change = row(thickness)
    assert shown == pytest.approx(found, abs=0.06)
    assert change == pytest.approx((found / best - 1) * 100, abs=0.06)
    assert row("ideal")[0] == pytest.approx(best, abs=0.06)


def test_no_iron() -> None:
    bands = alternating(1.25)
    found, best = peak(backed(bands)), peak(ideal(bands, bands, PERIOD / 4))
    shown, change = row("none")
    assert shown == pytest.approx(found, abs=0.06)
    assert change == pytest.approx((found / best - 1) * 100, abs=0.06)


def test_arcs() -> None:
    """Loss, ripple and place of zero force of six arcs in a turn."""
    bands = alternating(1.0)
    section = ideal(bands, bands)
    waves = arc_harmonics(section, SIXTY, SIXTY)
    angles = np.linspace(0, np.pi / 3, 241)
    over_angle = arc_force(waves, PERIOD, PERIOD / 4, angles) * POLES / 2
    single = arc_force(arc_harmonics(section, SIXTY, None), PERIOD, PERIOD / 4, 0.0) * POLES / 2
    assert row("peak force, continuous helices") == [pytest.approx(peak(ideal(bands, bands, PERIOD / 4)), abs=0.06)]
    assert row("one member of arcs") == [pytest.approx(float(single), abs=0.06)]
    assert row("both of arcs, mean over the angle") == [pytest.approx(over_angle[:-1].mean(), abs=0.06)]
    least, most = row("both of arcs, least and most over the angle, at a quarter pitch")
    assert (least, most) == (pytest.approx(over_angle.min(), abs=0.06), pytest.approx(over_angle.max(), abs=0.06))
    first = {part.azimuthal: part.amplitude for part in waves if part.order == 1}
    shares = [first[nu] / first[1] * 100 for nu in (-5, 7)]
    assert row("waves ν = −5 and 7 beside the fundamental") == [pytest.approx(share, abs=0.06) for share in shares]
    rests = [brentq(lambda x, a=a: float(arc_force(waves, PERIOD, x, a)), -1e-4, 1e-4) for a in angles]
    assert row("place of zero force, six times a turn") == [pytest.approx(max(rests) * 1e6, abs=0.6)]
