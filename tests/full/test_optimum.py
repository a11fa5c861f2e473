"""The study of six dimensions by the command line, as its page has it: minutes, so only when asked for (-m full)."""

import contextlib
import io
import json
import re
import shlex
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from fluxbore import evaluate, load, optimize
from fluxbore.cli import main
from fluxbore.design.performance import to_mapping

pytestmark = pytest.mark.full

TOP = Path(__file__).parents[2]
EXAMPLE = TOP / "examples" / "ipehla-optimum.toml"
PAGE = TOP / "docs" / "optimisation.md"

RING, YOKE, OUTSIDE, OVERHANG, TUBE, ROD = KEYS = (
    "actuator.mover.ring_width",
    "actuator.back_yoke.thickness",
    "actuator.back_yoke.outer_diameter",
    "actuator.back_yoke.back_overhang",
    "actuator.cylinder.outer_diameter",
    "actuator.shaft.outer_diameter",
)
LIMITED = ("stray_field", "total_mass", "winding_temperature", "demagnetisation_load")
STEPS = dict(zip(KEYS, (0.05e-3, 0.01e-3, 0.05e-3, 0.1e-3, 0.05e-3, 0.1e-3), strict=True))


def answer(capsys, command, *changes):
    """What a command prints as JSON."""
    arguments = [item for change in changes for item in ("--set", change)]
    extra = ["--quiet"] if command == "optimize" else []
    assert main([command, str(EXAMPLE), "--json", *extra, *arguments]) == 0
    return json.loads(capsys.readouterr().out)


def figures(values):
    """The figures of a design whose winding fills its room as the study holds it."""
    evaluation = evaluate(load(EXAMPLE).for_study().with_values(values))
    assert evaluation.ok
    return to_mapping(evaluation.performance)


@pytest.fixture(scope="module")
def found():
    """The example's search, once."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        assert main(["optimize", str(EXAMPLE), "--json", "--quiet"]) == 0
    return json.loads(printed.getvalue())


def test_the_search_converges_within_the_prototypes_limits(found):
    """Catches a search that runs out of its budget, stops off the optimum, or gives way on a limit."""
    chosen, start = found["chosen"], found["start"]
    assert found["algorithm"] == "SLSQP"
    assert found["evaluations"] <= 20
    assert found["optimality"]["residual"] < 1e-3
    assert found["best"]["objective"] == pytest.approx(10.9493, rel=2e-4)
    assert chosen["feasible"]
    assert chosen["objective"] > 1.25 * start["objective"]
    for name in LIMITED:
        assert chosen["performance"][name] <= start["performance"][name]
    for key, step in STEPS.items():
        assert chosen["values"][key] / step == pytest.approx(round(chosen["values"][key] / step), abs=1e-6)


def test_several_limits_decide_and_have_their_price(found):
    """Catches an optimum that one limit alone makes, multipliers of limits with room to spare, wrong signs."""
    active = {item["subject"] for item in found["best"]["constraints"] if item["active"]}
    assert active == {"total_mass", "winding_temperature", "demagnetisation_load"}
    prices = {item["subject"]: item for item in found["optimality"]["multipliers"]}
    assert set(prices) == active | {TUBE, ROD, OVERHANG}
    for item in prices.values():
        assert item["share"] > 0
        assert (item["per_unit"] > 0) == (item["sense"] == "<=")


def test_the_price_of_heat_is_what_heat_buys(capsys, found):
    """Catches a multiplier of the wrong size: the limit raised by a kelvin, and the search run again."""
    price = next(item for item in found["optimality"]["multipliers"] if item["subject"] == "winding_temperature")
    limit = f"study.constraints.2.upper={price['limit'] + 1 - 273.15!r} degC"
    more = answer(capsys, "optimize", limit)["best"]["objective"]
    assert more - found["best"]["objective"] == pytest.approx(price["per_unit"], rel=0.05)


def test_it_is_better_than_one_dimension_at_a_time(found):
    """Catches a comparison with something else than the paper's two maxima in one design, or a page that is wrong."""
    limits = found["start"]["performance"]
    separate = figures({RING: 1.5e-3, YOKE: 0.4e-3})
    assert separate["force_constant"] == pytest.approx(9.839, abs=2e-3)
    assert separate["stray_field"] > 20 * limits["stray_field"]
    assert separate["winding_temperature"] > limits["winding_temperature"]
    assert found["chosen"]["objective"] > 1.1 * separate["force_constant"]


def test_a_finer_mesh_confirms_the_gain(found):
    """Catches an optimum of the mesh's errors: on twice the divisions prototype and optimum rise alike."""
    fine = [figures({**values, "solver.mesh_refinement": 2}) for values in ({}, found["chosen"]["values"])]
    coarse = found["chosen"]["objective"] / found["start"]["objective"]
    assert fine[1]["force_constant"] / fine[0]["force_constant"] == pytest.approx(coarse, rel=1e-3)
    for name in LIMITED[:3]:
        assert fine[1][name] <= fine[0][name]
    assert fine[1]["demagnetisation_load"] <= fine[0]["demagnetisation_load"] * (1 + 5e-4)


@pytest.mark.parametrize(
    "start",
    [
        (4e-3, 1.6e-3, 28e-3, 5e-3, 20.5e-3, 9e-3),
        (2e-3, 0.8e-3, 26e-3, 8e-3, 19.5e-3, 7e-3),
        (5.5e-3, 0.6e-3, 29e-3, 3e-3, 21e-3, 6.5e-3),
    ],
)
def test_it_ends_in_one_place_from_elsewhere(found, start):
    """Catches a search that depends on where in its valley it starts. The limits stay the prototype's, as numbers."""
    spec = load(EXAMPLE).for_study()
    limits = tuple(
        replace(item, upper=found["start"]["performance"][item.subject], relative_to_start=False)
        for item in spec.study.constraints
    )
    moved = replace(spec, study=replace(spec.study, constraints=limits))
    best = optimize(moved.with_values(dict(zip(KEYS, start, strict=True)))).best
    assert best is not None
    assert best.objective == pytest.approx(found["best"]["objective"], rel=1e-3)


def test_the_pages_commands_run_and_its_quotes_are_the_programs(tmp_path, monkeypatch, capsys):
    """Catches commands of the page that no longer work, words that are printed no longer, figures that moved."""
    shutil.copytree(TOP / "examples", tmp_path / "examples")
    monkeypatch.chdir(tmp_path)
    text = PAGE.read_text(encoding="utf-8")
    blocks = re.findall(r"^```(\w*)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    printed = ""
    for command in [line for name, block in blocks if not name for line in block.splitlines()]:
        status = main([*shlex.split(command)[1:], "--quiet"])
        assert status == (3 if "0.75 x start" in command else 0), command
        printed += capsys.readouterr().out
    number = r"-?\d+(?:\.\d+)?(?:e-?\d+)?"
    lines = printed.splitlines()
    for quoted in [line for name, block in blocks if name == "text" for line in block.splitlines()]:
        alike = [line for line in lines if re.sub(number, "#", line) == re.sub(number, "#", quoted)]
        ours = [float(item) for item in re.findall(number, quoted)]
        assert any(
            [float(item) for item in re.findall(number, line)] == pytest.approx(ours, rel=0.05) for line in alike
        ), quoted
