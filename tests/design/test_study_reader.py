"""The study section: what it asks for, and what contradicts itself before anything is computed."""

# ruff: noqa: E501  one case a line, as long as it is

import re

import pytest

from fluxbore.design.errors import SpecError
from fluxbore.design.spec import loads
from fluxbore.design.spec_file import template
from fluxbore.design.study import ALGORITHMS, Axis, Constraint, Objective, Search

TEXT = template("ipehla")
BARE = TEXT[: TEXT.index("[study]")]
RING, YOKE, SETS = "actuator.mover.ring_width", "actuator.back_yoke.thickness", "actuator.winding.sets_per_phase"


def study(lines: str):
    return loads(f"{BARE}[study]\n{lines}\n").study


def refused(lines: str) -> str:
    with pytest.raises(SpecError) as caught:
        study(lines)
    sentence = str(caught.value)
    assert sentence.startswith(("study", "The study")), sentence
    assert sentence.endswith(".")
    assert "\n" not in sentence
    return sentence


def axes(text: str) -> str:
    return f"[[study.sweeps]]\naxes = [{text}]"


def test_the_paper_s_study():
    found = loads(TEXT).study
    assert found.objective == Objective("force_constant", True)
    ring, yoke = found.variables  # what a workshop resolves is its own affair
    assert (ring.key, ring.lower, ring.upper) == (RING, 5e-4, 6e-3)
    assert (yoke.key, yoke.lower, yoke.upper) == (YOKE, 3e-4, 2.5e-3)
    assert found.constraints == (Constraint("stray_field", 1.0, None, True), Constraint(YOKE, None, 5e-4))
    assert found.hold == ("actuator.winding.yoke_clearance", "actuator.winding.turns_density")
    ring, yoke = found.sweeps
    assert ring.axes[0].values == tuple(float(f"{5 * i}e-4") for i in range(24))
    assert yoke.axes[0].values == tuple(float(f"{1 + 3 * i}e-4") for i in range(9))
    assert (ring.reference, yoke.reference) == (1.5e-3, 4e-4)
    assert found.search == Search("COBYLA", 40, 1e-4, 1)


def test_an_empty_study_is_legal_and_so_is_none():
    assert study("").variables == ()
    assert loads(BARE).study.sweeps == ()


def test_grids():
    (sweep,) = study(
        axes(f'{{ key = "{RING}", values = ["2 mm", "1 mm"] }}, {{ key = "{SETS}", from = 8, to = 10, step = 1 }}')
    ).sweeps
    assert sweep.axes == (Axis(RING, (0.002, 0.001)), Axis(SETS, (8.0, 9.0, 10.0)))
    assert sweep.size == 6
    assert sweep.name == f"{RING} x {SETS}"
    (down,) = study(axes(f'{{ key = "{RING}", from = "1 mm", to = "0 mm", step = "-0.5 mm" }}')).sweeps
    assert down.axes[0].values == (0.001, 0.0005, 0.0)


def test_a_step_of_temperature_or_pressure_is_a_difference():
    """Catches a step of 20 degC read as 293 K and one of 0.1 MPa absolute read as -1 kPa."""
    for step in ("20 degC", "20 K", "36 degF"):
        heat = study(
            axes(f'{{ key = "operating_point.magnet_temperature", from = "20 degC", to = "80 degC", step = "{step}" }}')
        )
        assert heat.sweeps[0].axes[0].values == pytest.approx((293.15, 313.15, 333.15, 353.15))
    for scale in ("gauge", "absolute"):
        air = study(
            axes(
                f'{{ key = "operating_point.pressure", from = "0.1 MPa {scale}", to = "0.3 MPa {scale}", step = "0.1 MPa {scale}" }}'
            )
        )
        assert air.sweeps[0].axes[0].values[2] - air.sweeps[0].axes[0].values[0] == pytest.approx(2e5)
    variable = (
        '[[study.variables]]\nkey = "operating_point.magnet_temperature"\nlower = "20 degC"\nupper = "80 degC"\n'
        'resolution = "5 degC"'
    )
    assert study(variable).variables[0].resolution == 5.0


def test_limits_relative_to_the_start():
    limit = '[[study.constraints]]\nfigure = "stray_field"\nupper = "{}"'
    assert study(limit.format("start")).constraints == (Constraint("stray_field", 1.0, None, True),)
    assert study(limit.format("1.1 x start")).constraints == (Constraint("stray_field", 1.1, None, True),)
    assert study(limit.format("0.4 mT")).constraints == (Constraint("stray_field", 4e-4, None, False),)


VARIABLE = "[[study.variables]]\n"
CONSTRAINT = "[[study.constraints]]\n"
STRAY = CONSTRAINT + 'figure = "stray_field"\n'
BOTH = f'{VARIABLE}key = "{YOKE}"\nlower = "0.3 mm"\nupper = "2.5 mm"\n'
WRONG = {
    # Variables.
    'variables = 3': 'study.variables must be a list of tables, each headed [[study.variables]]; got 3.',
    'variables = [[]]': "study.variables must be a list of tables, each headed [[study.variables]]; got [[]].",
    VARIABLE: "study.variables.0.key must be a dotted key of this specification; got none.",
    f'{VARIABLE}key = "{RING}"': f"study.variables.0.lower is missing: the variable {RING} needs both a lower and an upper bound.",
    f'{VARIABLE}key = "{RING}"\nlower = "1 mm"': f"study.variables.0.upper is missing: the variable {RING} needs both a lower and an upper bound.",
    f'{VARIABLE}key = "{RING}"\nlower = "2 mm"\nupper = "1 mm"': "study.variables.0.upper must exceed study.variables.0.lower 2 mm; got 1 mm.",
    f'{VARIABLE}key = "{RING}"\nlower = "1 mm"\nupper = "1 mm"': "study.variables.0.upper must exceed study.variables.0.lower 1 mm; got 1 mm.",
    f'{VARIABLE}key = "{RING}"\nlower = 1\nupper = "1 mm"': "got the bare number 1.",
    f'{VARIABLE}key = "{RING}"\nlower = "-1 mm"\nupper = "1 mm"': f"study.variables.0.lower: {RING} must be at least 0 mm; got -1 mm.",
    f'{VARIABLE}key = "{RING}"\nlower = "1 mm"\nupper = "2 mm"\nresolution = "5 mm"': "must be above zero and at most the range 1 mm; got 5 mm.",
    f'{VARIABLE}key = "{RING}"\nlower = "1 mm"\nupper = "2 mm"\nresolution = "0 mm"': "must be above zero and at most the range 1 mm; got 0 mm.",
    f'{VARIABLE}key = "{RING}"\nlower = "1 mm"\nupper = "2 mm"\nstep = "1 mm"': "study.variables.0.step is not a key of this specification; study.variables.0 has key, lower, upper, resolution.",
    f'{VARIABLE}key = "actuator.name"\nlower = "1 mm"\nupper = "2 mm"': "must name a continuous quantity; got actuator.name, which is a word.",
    f'{VARIABLE}key = "{SETS}"\nlower = 1\nupper = 2': "which is a count.",
    f'{VARIABLE}key = "solver.tolerance"\nlower = 1e-9\nupper = 1e-8': "which is a setting of the solver.",
    BOTH + BOTH: f"study.variables must name each key once; got {YOKE} twice.",
    # Constraints.
    CONSTRAINT: "study.constraints.0 must hold exactly one of figure and key; got none.",
    f'{STRAY}key = "{RING}"\nupper = "start"': "must hold exactly one of figure and key",
    STRAY: "study.constraints.0 must hold upper or lower for stray_field; got neither.",
    f"{STRAY}upper = 1": "study.constraints.0.upper must be a flux density",
    f'{STRAY}upper = "1 mm"': 'with the unit "mm".',
    f'{STRAY}upper = "-1 T"': "study.constraints.0.upper must be at least zero, for stray_field always is; got -1 T.",
    f'{STRAY}upper = "0 x start"': 'got the factor "0".',
    f'{STRAY}upper = "1 mT"\nlower = "2 mT"': "stray_field would have to be at least 0.002 T and at most 0.001 T.",
    f'{STRAY}upper = "start"\nlower = "2 x start"': "stray_field would have to be at least 2 x start and at most 1 x start.",
    f'{STRAY}upper = "start"\nlower = "2 mT"': "upper and lower must both be quantities or both be relative",
    f'{CONSTRAINT}figure = "thrust"\nupper = 1': "study.constraints.0.figure must name a figure, one of force_constant, ",
    f'{CONSTRAINT}figure = ["stray_field"]\nupper = 1': 'got ["stray_field"].',
    f'{CONSTRAINT}key = "actuator.name"\nupper = "x"': "which is a word.",
    f'{STRAY}upper = "1 mT"\n{STRAY}lower = "2 mT"': "study.constraints cannot be met: stray_field would have to be at least 0.002",
    f'{BOTH}{CONSTRAINT}key = "{YOKE}"\nlower = "3 mm"': "would have to be at least 3 mm, but its bounds are 0.3 mm to 2.5 mm.",
    f'{BOTH}{CONSTRAINT}key = "actuator.shaft.length"\nlower = "300 mm"': "actuator.shaft.length would have to be at least 300 mm, but no variable moves it from 235 mm.",
    # Sweeps.
    "[[study.sweeps]]": "study.sweeps.0.axes must be a list of at least one table; got none.",
    "[[study.sweeps]]\naxes = []": "study.sweeps.0.axes must be a list of at least one table; got [].",
    axes("3"): "study.sweeps.0.axes.0 must be a section of keys; got 3.",
    axes(f'{{ key = "{RING}" }}'): "study.sweeps.0.axes.0.from is missing: an axis needs from, to and step, or values.",
    axes(f'{{ key = "{RING}", from = "0 mm", to = "1 mm", step = "0 mm" }}'): "step must lead from 0 mm to 1 mm; got 0 mm.",
    axes(f'{{ key = "{RING}", from = "0 mm", to = "1 mm", step = "-1 mm" }}'): "step must lead from 0 mm to 1 mm; got -1 mm.",
    axes(f'{{ key = "{RING}", from = "0 mm", to = "1 mm", step = "0.3 mm" }}'): "step must divide the range from 0 mm to 1 mm evenly; got 0.3 mm.",
    axes(f'{{ key = "{RING}", from = "0 mm", to = "1 mm", step = "1e-9 mm" }}'): "must have at most 1000000 points; got 1e+09.",
    axes(f'{{ key = "{RING}", from = "0 mm", to = "1 mm", step = "1e-320 mm" }}'): "must have at most 1000000 points; got inf.",
    axes(f'{{ key = "{RING}", from = "-1 mm", to = "1 mm", step = "1 mm" }}'): f"study.sweeps.0.axes.0.from: {RING} must be at least 0 mm; got -1 mm.",
    axes(f'{{ key = "{RING}", values = [] }}'): "study.sweeps.0.axes.0.values must be a list of at least one value; got [].",
    axes(f'{{ key = "{RING}", values = "1 mm" }}'): 'got "1 mm".',
    axes(f'{{ key = "{RING}", values = ["1 mm", 2] }}'): "study.sweeps.0.axes.0.values.1 must be a length",
    axes(f'{{ key = "{RING}", values = ["-1 mm"] }}'): f"study.sweeps.0.axes.0.values.0: {RING} must be at least 0 mm; got -1 mm.",
    axes(f'{{ key = "{RING}", values = ["1 mm"], to = "1 mm" }}'): "must hold key with values = [...], or with from, to and step; got key, values, to.",
    axes(f'{{ key = "{SETS}", values = [1, 2.5] }}'): "study.sweeps.0.axes.0.values.1 must be a whole number, such as 4; got 2.5.",
    axes(f'{{ key = "{SETS}", from = 1, to = 4, step = 0.5 }}'): "study.sweeps.0.axes.0.step must be a whole number, such as 4; got 0.5.",
    axes(f'{{ key = "{RING}", values = ["1 mm"] }}, {{ key = "{RING}", values = ["1 mm"] }}'): "study.sweeps.0.axes must name each key once",
    axes(f'{{ key = "{RING}", values = ["1 mm"] }}, {{ key = "actuator.mover.magnet_thickness", values = ["9 mm"] }}'): "The study is over-determined: at most 1 of",
    axes(f'{{ key = "{RING}", values = ["1 mm"] }}') + "\nname = 3": "study.sweeps.0.name must be text in quotes; got 3.",
    axes(f'{{ key = "{RING}", values = ["1 mm"] }}') + "\nsource = []": "study.sweeps.0.source must be text in quotes; got [].",
    axes(f'{{ key = "{RING}", values = ["1 mm"] }}') + '\npublished_optimum = "1 T"': "study.sweeps.0.published_optimum must be a length",
    (axes(f'{{ key = "{RING}", values = ["1 mm"] }}') + "\n") * 2: "study.sweeps.1.name must differ from the other sweeps' names",
    axes(f'{{ key = "{RING}", from = "0 mm", to = "11 mm", step = "1 um" }}, {{ key = "{YOKE}", from = "1 mm", to = "2 mm", step = "1 um" }}'): "study.sweeps.0 must have at most 1000000 designs; got 11012001.",
    # The rest.
    'objective = "force_constant"': 'must be "maximise FIGURE" or "minimise FIGURE", such as "maximise force_constant"; got "force_constant".',
    'objective = "maximise thrust"': 'study.objective must name a figure, one of force_constant, ',
    "objective = 3": "got 3.",
    'hold = "x"': 'study.hold must be a list of dotted keys in quotes; got "x".',
    'hold = ["actuator.shaft.length"]': "study.hold.0 must be a key that has alternatives, one of ",
    f'hold = ["{YOKE}"]\n{BOTH}': f"study.hold.0 must not be a variable of the study as well; got {YOKE}.",
    'hold = ["actuator.winding.turns", "actuator.winding.turns_density"]': "The study is over-determined: at most 1 of",
    "goal = 1": "study.goal is not a key of this specification; study has objective, hold, variables, constraints, sweeps, search.",
    "search = 3": "study.search must be a section of keys; got 3.",
    '[study.search]\nalgorithm = "SIMPLEX"': f'study.search.algorithm must be one of {", ".join(ALGORITHMS)}; got "SIMPLEX".',
    "[study.search]\nmax_evaluations = 0": "study.search.max_evaluations must be at least 1; got 0.",
    "[study.search]\nrelative_tolerance = 0.9": "study.search.relative_tolerance must be at most 0.5; got 0.9.",
    "[study.search]\nseed = 1.5": "study.search.seed must be a whole number, such as 4; got 1.5.",
}  # fmt: skip


@pytest.mark.parametrize("lines", WRONG, ids=[re.sub(r"\W+", "-", lines)[-60:] for lines in WRONG])
def test_a_study_that_makes_no_sense(lines):
    """Catches a traceback, a study that runs for hours before it fails, and a sentence that hides the key."""
    assert WRONG[lines] in refused(lines)
