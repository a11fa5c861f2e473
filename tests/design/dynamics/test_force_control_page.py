"""The page on force control: its script runs, and its numbers are the program's."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from rotlin_stand import ROTLIN

from fluxbore.design.dynamics.force_control import NO_FRICTION, force_loop
from fluxbore.design.dynamics.force_stand import controller_of, stand_of
from fluxbore.design.dynamics.force_step import simulate_step
from fluxbore.design.dynamics.force_step_figures import dominant_pole, step_figures
from fluxbore.design.dynamics.guides import Guides
from fluxbore.design.dynamics.linearised import FILTERED, UNFILTERED, force_characteristic
from fluxbore.design.poles import poles

TOP = Path(__file__).parents[3]
PAGE = (TOP / "docs" / "force_control.md").read_text(encoding="utf-8").replace("−", "-")
STAND, CONTROLLER = stand_of(ROTLIN, distorted=False), controller_of(ROTLIN)
EXACT = replace(STAND, angle_count=0.0, position_count=0.0)
FREE = replace(EXACT, guides=Guides())
KNOWING_NONE = replace(CONTROLLER, friction=NO_FRICTION)


def row(name):
    """The cells of the table's row that begins so."""
    line = next(line for line in PAGE.splitlines() if line.startswith(f"| {name} |"))
    return [cell.strip() for cell in line.strip("|").split("|")][1:]


def test_the_script_runs(capsys, monkeypatch):
    monkeypatch.chdir(TOP)
    (script,) = re.findall(r"^```python\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
    exec(compile(script, "docs/force_control.md", "exec"), {})
    t63, t98, error = row("and encoders that count")[:3]
    assert t98
    assert capsys.readouterr().out == f"{t63}, {error}, pole -0.988 1/s\n"


@pytest.mark.parametrize(
    "name, stand, controller",
    [
        ("sine alone", replace(FREE, spring=STAND.spring.law), KNOWING_NONE),
        ("with hysteresis (17)", FREE, KNOWING_NONE),
        ("and guides that rub", EXACT, CONTROLLER),
        ("and encoders that count", STAND, CONTROLLER),
    ],
)
def test_the_table_of_steps_is_simulated(name, stand, controller):
    cells = []
    for force in (50.0, 100.0):
        found = step_figures(simulate_step(stand, controller, force, 10.0))
        error = 0.0 if abs(found.error) < 0.005 else found.error
        cells += [f"{found.t63:.2f} s", f"{found.t98:.1f} s", f"{error:.2f} N"]
        assert found.overshoot < 1e-4
    assert row(name) == cells


def test_the_poles_are_computed():
    loop = force_loop(STAND.plant, STAND.environment, CONTROLLER)
    for name, speed in (("unfiltered speed, the paper's", UNFILTERED), ("filtered speed", FILTERED)):
        told = []
        for term in row(name)[0].split(", "):
            real, _, imaginary = term.partition(" ± ")
            parts = (
                [float(real)] if not imaginary else [complex(float(real), s * float(imaginary[:-1])) for s in (1, -1)]
            )
            told += parts
        assert poles(force_characteristic(loop, speed), 100.0) == pytest.approx(np.array(told), abs=0.06)


def test_where_the_filtered_observer_becomes_unstable():
    loop = force_loop(STAND.plant, STAND.environment, CONTROLLER)

    def ringing(stiffness, damping):
        at = replace(loop, K_e=stiffness, D_e=damping)
        return poles(force_characteristic(at, FILTERED), 100.0)[0].real

    assert "begins at K_e = 3,645 kN/m" in PAGE
    assert ringing(3.644e6, 0.1) < 0 < ringing(3.646e6, 0.1)
    assert "0.82 N s/m" in PAGE
    assert ringing(5e6, 0.82) < 0 < ringing(5e6, 0.81)
    told = [
        float(value)
        for value in re.findall(r"(\d\.\d{3}) s (?:without force|at 50 N|at 100 N)", " ".join(PAGE.split()))
    ]
    slowness = [-1 / dominant_pole(STAND.plant, STAND.environment, CONTROLLER, force).real for force in (0, 50, 100)]
    assert told == pytest.approx(slowness, abs=6e-4)
