"""Optimisation problems that others published, by the command line: a minute, so only when asked for (-m full)."""

import json
import math
from pathlib import Path

import pytest

from fluxbore.cli import main
from fluxbore.design.bh_curve import MU_0

pytestmark = pytest.mark.full

EXAMPLES = Path(__file__).parents[2] / "examples"

RADIUS, HALF_HEIGHT, THICKNESS = (f"actuator.coil_2.{leaf}" for leaf in ("radius", "half_height", "thickness"))

PUBLISHED = 0.0881
"""The objective of the published design of TEAM problem 22 with three variables, its stray term being 0.0879."""


def optimised(capsys, name, *changes):
    """The search's answer as `fluxbore optimize --json` prints it."""
    arguments = [item for change in changes for item in ("--set", change)]
    assert main(["optimize", str(EXAMPLES / name), "--json", "--quiet", "--workers", "1", *arguments]) == 0
    return json.loads(capsys.readouterr().out)


def figures(capsys, name, *changes):
    arguments = [item for change in changes for item in ("--set", change)]
    assert main(["evaluate", str(EXAMPLES / name), "--json", *arguments]) == 0
    return json.loads(capsys.readouterr().out)["performance"]


def at_published():
    return f"{RADIUS}=3.08 m", f"{HALF_HEIGHT}=0.239 m", f"{THICKNESS}=0.394 m"


def test_team_22_is_better_than_its_published_design(capsys):
    """Catches a search that stops in the long flat valley before the optimum, or beyond the quench limit."""
    published = figures(capsys, "team22.toml", *at_published())
    chosen = optimised(capsys, "team22.toml")["chosen"]
    assert chosen["feasible"]
    assert chosen["objective"] < published["merit"] - 3e-4
    assert chosen["objective"] == pytest.approx(0.0882604, abs=2e-7)
    assert chosen["performance"]["quench_load"] < 1
    assert chosen["performance"]["stored_energy"] == pytest.approx(180e6, rel=1e-6)
    assert chosen["values"][RADIUS] == pytest.approx(3.08, abs=0.01)  # the published grid's step
    assert chosen["values"][HALF_HEIGHT] == pytest.approx(0.239, abs=0.007)
    assert chosen["values"][THICKNESS] == pytest.approx(0.394, abs=0.012)


def test_the_other_half_of_team_22_has_the_same_optimum(capsys):
    """Catches an optimum that only the example's limit on the energy made: more energy does not pay either."""
    chosen = optimised(
        capsys,
        "team22.toml",
        "study.constraints.1.upper=",
        "study.constraints.1.lower=180 MJ",
        f"{RADIUS}=3.1 m",
        f"{HALF_HEIGHT}=0.3 m",
        f"{THICKNESS}=0.35 m",
    )["chosen"]
    assert chosen["objective"] == pytest.approx(0.08826, abs=3e-5)


@pytest.mark.parametrize(
    "start", [("2.7 m", "1 m", "0.15 m"), ("3.3 m", "0.3 m", "0.2 m"), ("2.7 m", "0.3 m", "0.38 m")]
)
def test_team_22_ends_in_one_place_from_anywhere(capsys, start):
    """Catches a search that depends on where it starts."""
    changes = [f"{key}={value}" for key, value in zip((RADIUS, HALF_HEIGHT, THICKNESS), start, strict=True)]
    assert optimised(capsys, "team22.toml", *changes)["chosen"]["objective"] == pytest.approx(0.0882604, abs=1e-6)


@pytest.mark.parametrize("published_energy", [180e6 * (1 - 3e-4), 180e6, 180e6 * (1 + 3e-4)])
def test_team_22_by_the_published_energy_is_below_the_published_objective(capsys, published_energy):
    """Catches a claim to the published 0.0881 that rests on one choice of what its authors' solver saw.

    0.0881 - 0.0879, to their digits, leaves at most 3e-4 of 180 MJ between the published design's energy and 180 MJ;
    the exact one is 179.867 MJ. Whatever lies between, with E scaled by that solver's excess the optimum is below
    0.0881. The scaled energy stands in the reference: E f = 180 MJ where E = 180 MJ / f.
    """
    exact = figures(capsys, "team22.toml", *at_published())["stored_energy"]
    reference = 180e6 * exact / published_energy
    chosen = optimised(
        capsys,
        "team22.toml",
        f"operating_point.reference_energy={reference} J",
        f"study.constraints.1.upper={reference} J",
    )["chosen"]
    assert chosen["objective"] < PUBLISHED
    assert chosen["performance"]["quench_load"] < 1


def test_fabrys_solenoid(capsys):
    """Catches a search that a flat optimum satisfies too soon: the published shape to four digits, the field to six.

    Outer radius 3.0952 and half height 1.8618 inner radii, Fabry factor 0.14262 in SI (0.179 in gauss, ohm and cm).
    """
    chosen = optimised(capsys, "fabry.toml")["chosen"]
    values = chosen["values"]
    assert 1 + values["actuator.coil_1.thickness"] / 0.025 == pytest.approx(3.0952, abs=5e-4)
    assert values["actuator.coil_1.half_height"] / 0.025 == pytest.approx(1.8618, abs=5e-4)
    resistivity = 1.72e-8 * (1 + 3.93e-3 * 40)
    strongest = MU_0 * 0.142624 * math.sqrt(10e3 * 0.8 / (resistivity * 0.025))
    assert chosen["objective"] == pytest.approx(strongest, rel=5e-6)  # the factor's own last digit
