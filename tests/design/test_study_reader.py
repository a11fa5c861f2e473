"""The study section: what it asks for, and what contradicts itself before anything is computed."""

# ruff: noqa: E501  one case a line, as long as it is

import re

import pytest

from fluxbore.design.errors import SpecError
from fluxbore.design.spec import loads
from fluxbore.design.spec_file import template
from fluxbore.design.study import (
    ALGORITHMS,
    Axis,
    Constraint,
    Objective,
    Pareto,
    Production,
    Search,
    Tolerance,
    Variable,
)

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


AIM = 'objective = "maximise force_constant"\n'


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
    assert (ring.published, yoke.published) == (((1.5e-3, 8.67),), ((1e-3, 8.67),))
    assert found.search == Search("auto", 40, 1e-4, 1)


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
                f'{{ key = "operating_point.pressure", from = "0.2 MPa {scale}", to = "0.4 MPa {scale}", step = "0.1 MPa {scale}" }}'
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


def test_a_fraction_may_be_written_as_a_percentage():
    limit = '[[study.constraints]]\nfigure = "saturation_ratio"\nlower = {}'
    assert study(limit.format('"55 %"')).constraints == study(limit.format("0.55")).constraints
    asked = f'{GOAL}{STRAY}upper = "start"\n[study.production]\nyield = "99 %"\n{SLIP}'
    assert study(asked).production.target_yield == 0.99


def test_a_count_is_a_variable_in_whole_numbers():
    found = study(f'[[study.variables]]\nkey = "{SETS}"\nlower = 6\nupper = 9').variables
    assert found == (Variable(SETS, 6.0, 9.0, None, True),)


def test_a_front():
    found = study(GOAL + FRONT + 'points = 5\nmethod = "normal boundary intersection"').pareto
    assert found == Pareto(Objective("total_mass", False), 5, "normal boundary intersection")
    assert study(GOAL + FRONT).pareto == Pareto(Objective("total_mass", False), 9, "epsilon constraint")
    assert study(GOAL).pareto is None


def test_production():
    """One tolerance to both sides, one unlike, and one of a temperature, whose step has no offset."""
    found = study(
        GOAL
        + STRAY
        + 'upper = "start"\n'
        + "[study.production]\nsamples = 2000\nchecks = 20\nseed = 7\nyield = 0.99\n"
        + SLIP
        + f'{TOLERANCE}key = "{RING}"\nplus = "0.05 mm"\nminus = "0 mm"\ndistribution = "uniform"\n'
        + f'{TOLERANCE}key = "operating_point.magnet_temperature"\ntolerance = "18 degF"\n'
    ).production
    assert found is not None
    yoke, ring, heat = found.tolerances
    assert yoke == Tolerance(YOKE, -1e-5, 1e-5, "normal")
    assert ring == Tolerance(RING, 0.0, 5e-5, "uniform")
    assert repr(ring.minus) == "0.0"  # the fingerprint is made of such texts
    assert (heat.minus, heat.plus) == pytest.approx((-10.0, 10.0))
    assert (found.samples, found.checks, found.seed, found.target_yield) == (2000, 20, 7, 0.99)
    assert study(SLIP).production == Production((yoke,))


def test_a_search_by_derivatives_is_the_default():
    assert study("").search.algorithm == "auto"
    assert study("[study.search]\nseed = 2").search == Search("auto", seed=2)


def test_the_search_s_time_and_network():
    found = study('[study.search]\nalgorithm = "auto"\ntime_limit = "10 min"\nnetwork = "manifold"').search
    assert found == Search("auto", time_limit=600.0, network="manifold")


VARIABLE = "[[study.variables]]\n"
CONSTRAINT = "[[study.constraints]]\n"
STRAY = CONSTRAINT + 'figure = "stray_field"\n'
BOTH = f'{VARIABLE}key = "{YOKE}"\nlower = "0.3 mm"\nupper = "2.5 mm"\n'
GOAL = f'objective = "maximise force_constant"\n{BOTH}'
FRONT = '[study.pareto]\nagainst = "minimise total_mass"\n'
TOLERANCE = "[[study.production.tolerances]]\n"
SLIP = f'{TOLERANCE}key = "{YOKE}"\ntolerance = "10 um"\n'
WRONG = {
    # Variables.
    'variables = 3': 'study.variables must be a list of tables, each headed [[study.variables]]; got 3.',
    'variables = [[]]': "study.variables must be a list of tables, each headed [[study.variables]]; got [[]].",
    VARIABLE: "study.variables.0.key must be a dotted key of this specification; got none.",
    f'{VARIABLE}key = "actuator.mover.ring_widht"': f"study.variables.0.key must be a dotted key of this specification (did you mean {RING}?); got ",
    f'{VARIABLE}reslution = "1 mm"': "study.variables.0.reslution is not a key of this specification (did you mean resolution?); study.variables.0 has key, lower, upper, resolution.",
    f'{VARIABLE}key = "{RING}"': f"study.variables.0.lower is missing: the variable {RING} needs both a lower and an upper bound.",
    f'{VARIABLE}key = "{RING}"\nlower = "1 mm"': f"study.variables.0.upper is missing: the variable {RING} needs both a lower and an upper bound.",
    f'{VARIABLE}key = "{RING}"\nlower = "2 mm"\nupper = "1 mm"': "study.variables.0.upper must exceed study.variables.0.lower 2 mm; got 1 mm.",
    f'{VARIABLE}key = "{RING}"\nlower = "1 mm"\nupper = "1 mm"': "study.variables.0.upper must exceed study.variables.0.lower 1 mm; got 1 mm.",
    f'{VARIABLE}key = "{RING}"\nlower = 1\nupper = "1 mm"': "got the bare number 1.",
    f'{VARIABLE}key = "{RING}"\nlower = "-1 mm"\nupper = "1 mm"': f"study.variables.0.lower: {RING} must be at least 0 mm; got -1 mm.",
    f'{VARIABLE}key = "{RING}"\nlower = "1 mm"\nupper = "2 mm"\nresolution = "5 mm"': "must be above zero and at most the range 1 mm; got 5 mm.",
    f'{VARIABLE}key = "{RING}"\nlower = "1 mm"\nupper = "2 mm"\nresolution = "0 mm"': "must be above zero and at most the range 1 mm; got 0 mm.",
    f'{VARIABLE}key = "{RING}"\nlower = "1 mm"\nupper = "2 mm"\nstep = "1 mm"': "study.variables.0.step is not a key of this specification; study.variables.0 has key, lower, upper, resolution.",
    f'{VARIABLE}key = "actuator.name"\nlower = "1 mm"\nupper = "2 mm"': "must name a dimension, a number or a count; got actuator.name, which is a word.",
    f'{VARIABLE}key = "operating_point.positions"\nlower = 1\nupper = 2': "must name a quantity, a number or a count of the actuator's parts; got operating_point.positions, which is a count of the evaluation's.",
    f'{VARIABLE}key = "{SETS}"\nlower = 1.5\nupper = 2': "study.variables.0.lower must be a whole number, such as 4; got 1.5.",
    f'{VARIABLE}key = "{SETS}"\nlower = "1 mm"\nupper = 2': 'study.variables.0.lower must be a whole number, such as 4; got "1 mm".',
    f'{VARIABLE}key = "{SETS}"\nlower = 0\nupper = 2': f"study.variables.0.lower: {SETS} must be at least 1; got 0.",
    f'{VARIABLE}key = "{SETS}"\nlower = 3\nupper = 3': "study.variables.0.upper must exceed study.variables.0.lower 3; got 3.",
    f'{VARIABLE}key = "{SETS}"\nlower = 1\nupper = 9\nresolution = 2': f"study.variables.0.resolution must be left out, for {SETS} is a count, which moves by 1; got 2.",
    f'{VARIABLE}key = "solver.tolerance"\nlower = 1e-9\nupper = 1e-8': "which is a setting of the solver.",
    BOTH + BOTH: f"study.variables must name each key once; got {YOKE} twice.",
    # Constraints.
    CONSTRAINT: "study.constraints.0 must hold exactly one of figure and key; got none.",
    f'{STRAY}key = "{RING}"\nupper = "start"': "must hold exactly one of figure and key",
    STRAY: "study.constraints.0 must hold upper or lower for stray_field; got neither.",
    f"{STRAY}upper = 1": "study.constraints.0.upper must be a flux density",
    f'{STRAY}upper = "1 mm"': 'with the unit "mm".',
    f'{STRAY}upper = "-1 T"': "study.constraints.0.upper must be at least zero, for stray_field always is; got -1 T.",
    f'{CONSTRAINT}figure = "back_emf"\nupper = "-1 V"': "study.constraints.0.upper must be at least zero, for back_emf always is; got -1 V.",
    f'{STRAY}upper = "1.1 * start"': 'study.constraints.0.upper must be a quantity, "start" or a multiple such as "1.1 x start"; got "1.1 * start".',
    f'{STRAY}upper = "start x 1.1"': 'or a multiple such as "1.1 x start"; got "start x 1.1".',
    f'{STRAY}upper = "0 x start"': 'got the factor "0".',
    f'{STRAY}upper = "1 mT"\nlower = "2 mT"': "stray_field would have to be at least 0.002 T and at most 0.001 T.",
    f'{STRAY}upper = "start"\nlower = "2 x start"': "stray_field would have to be at least 2 x start and at most 1 x start.",
    f'{STRAY}upper = "start"\nlower = "2 mT"': "upper and lower must both be quantities or both be relative",
    f'{CONSTRAINT}figure = "thrust"\nupper = 1': "study.constraints.0.figure must name a figure, such as force_constant or total_mass",
    f'{CONSTRAINT}figure = ["stray_field"]\nupper = 1': 'got ["stray_field"].',
    f'{CONSTRAINT}key = "actuator.name"\nupper = "x"': "which is a word.",
    f'{STRAY}upper = "1 mT"\n{STRAY}lower = "2 mT"': "study.constraints cannot be met: stray_field would have to be at least 0.002",
    f'{BOTH}{CONSTRAINT}key = "{YOKE}"\nlower = "3 mm"': "would have to be at least 3 mm, but its bounds are 0.3 mm to 2.5 mm.",
    f'{BOTH}{CONSTRAINT}key = "actuator.shaft.length"\nlower = "300 mm"': "actuator.shaft.length would have to be at least 300 mm, but no variable moves it from 235 mm.",
    f'{CONSTRAINT}figure = "winding_temperature"\nupper = "110 K"': "study.constraints.0.upper must be at least the operating_point.ambient_temperature 20 degC, for winding_temperature is a temperature and not a rise; got -163.15 degC.",
    f'{CONSTRAINT}figure = "saturation_ratio"\nlower = "55"': 'study.constraints.0.lower must be a fraction, such as 0.55 or "55 %"; got "55".',
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
    AIM + axes(f'{{ key = "{RING}", values = ["1 mm"] }}') + "\npublished = []": "study.sweeps.0.published must be a list of pairs [value, force_constant]; got [].",
    AIM + axes(f'{{ key = "{RING}", values = ["1 mm"] }}') + '\npublished = [["1 mm"]]': "study.sweeps.0.published must be a list of pairs [value, force_constant]",
    AIM + axes(f'{{ key = "{RING}", values = ["1 mm"] }}') + '\npublished = [["1 T", "8 N/A"]]': "study.sweeps.0.published.0.0 must be a length",
    AIM + axes(f'{{ key = "{RING}", values = ["1 mm"] }}') + '\npublished = [["1 mm", "8 N"]]': "study.sweeps.0.published.0.1 must be a force constant",
    (axes(f'{{ key = "{RING}", values = ["1 mm"] }}') + "\n") * 2: "study.sweeps.1.name must differ from the other sweeps' names",
    axes(f'{{ key = "{RING}", from = "0 mm", to = "11 mm", step = "1 um" }}, {{ key = "{YOKE}", from = "1 mm", to = "2 mm", step = "1 um" }}'): "study.sweeps.0 must have at most 1000000 designs; got 11012001.",
    # The rest.
    'objective = "force_constant"': 'must be "maximise FIGURE" or "minimise FIGURE", such as "maximise force_constant"; got "force_constant".',
    'objective = "maximise thrust"': 'study.objective must name a figure, such as force_constant or total_mass',
    "objective = 3": "got 3.",
    'objective = "minimise total_mas"': 'study.objective must name a figure, such as force_constant or total_mass (did you mean total_mass?); got "total_mas".',
    'hold = "x"': 'study.hold must be a list of dotted keys in quotes; got "x".',
    'hold = ["actuator.shaft.length"]': "study.hold.0 must be a key that has alternatives, one of ",
    f'hold = ["{YOKE}"]\n{BOTH}': f"study.hold.0 must not be a variable of the study as well; got {YOKE}.",
    'hold = ["actuator.winding.turns", "actuator.winding.turns_density"]': "The study is over-determined: at most 1 of",
    "goal = 1": "study.goal is not a key of this specification; study has objective, hold, variables, constraints, sweeps, search, pareto, production.",
    "search = 3": "study.search must be a section of keys; got 3.",
    '[study.search]\nalgorithm = "SIMPLEX"': f'study.search.algorithm must be one of {", ".join(ALGORITHMS)}; got "SIMPLEX".',
    "[study.search]\nmax_evaluations = 0": "study.search.max_evaluations must be at least 1; got 0.",
    "[study.search]\nrelative_tolerance = 0.9": "study.search.relative_tolerance must be at most 0.5; got 0.9.",
    "[study.search]\nseed = 1.5": "study.search.seed must be a whole number, such as 4; got 1.5.",
    "[study.search]\ntime_limit = 600": "study.search.time_limit must be a time, one number and one unit of s, ms, min, h, such as \"1 s\"; got the bare number 600.",
    '[study.search]\ntime_limit = "0 s"': "study.search.time_limit must exceed 0 s; got 0 s.",
    '[study.search]\nnetwork = "on"': 'study.search.network must be one of start, manifold, off; got "on".',
    # The front.
    f'{GOAL}[study.pareto]': "study.pareto.against is missing: a front needs a second goal, such as \"minimise total_mass\".",
    "pareto = []": "study.pareto must be a section of keys; got [].",
    f'{BOTH}[study.pareto]\nagainst = "minimise total_mass"': "study.objective must be given for study.pareto",
    'objective = "maximise force_constant"\n[study.pareto]\nagainst = "minimise total_mass"': "study.variables must be given for study.pareto; got none.",
    f'{GOAL}[study.pareto]\nagainst = "minimise force_constant"': "study.pareto.against must differ from study.objective; got force_constant for both.",
    f'{GOAL}{VARIABLE}key = "{SETS}"\nlower = 1\nupper = 2\n{FRONT}': f"study.variables must be continuous for study.pareto; got the count {SETS}.",
    f'{GOAL}[study.pareto]\nagainst = "total_mass"': 'study.pareto.against must be "maximise FIGURE" or "minimise FIGURE", such as "maximise force_constant"; got "total_mass".',
    f'{GOAL}[study.pareto]\nagainst = "minimise weight"': 'study.pareto.against must name a figure, such as force_constant or total_mass',
    f'{GOAL}{FRONT}points = 2': "study.pareto.points must be at least 3; got 2.",
    f'{GOAL}{FRONT}method = "weights"': 'study.pareto.method must be one of epsilon constraint, normal boundary intersection; got "weights".',
    f'{GOAL}{FRONT}seed = 2': "study.pareto.seed is not a key of this specification; study.pareto has against, points, method.",
    # Production.
    "[study.production]": "study.production.tolerances must hold at least one table, [[study.production.tolerances]]; got none.",
    "[study.production]\ntolerances = 3": "study.production.tolerances must be a list of tables, each headed [[study.production.tolerances]]; got 3.",
    f"[study.production]\nyield = 1\n{SLIP}": "study.production.yield must be at most 0.9999; got 1.",
    f"[study.production]\nyield = 99\n{SLIP}": 'study.production.yield must be at most 0.9999, such as 0.99 or "99 %"; got 99.',
    f'[study.production]\nyield = "all"\n{SLIP}': 'study.production.yield must be a fraction, such as 0.55 or "55 %"; got "all".',
    f"[study.production]\nyield = 0\n{SLIP}": "study.production.yield must exceed 0; got 0.",
    f"[study.production]\nyield = 0.99\n{SLIP}": "study.objective must be given for a search that reaches study.production.yield; got none.",
    f"{GOAL}[study.production]\nyield = 0.99\n{SLIP}": "study.constraints must be given for a search that reaches study.production.yield; got none.",
    f"[study.production]\nsamples = 10\n{SLIP}": "study.production.samples must be at least 100; got 10.",
    f"[study.production]\nsamples = 100\nchecks = 101\n{SLIP}": "study.production.checks must be at most study.production.samples 100; got 101.",
    f"[study.production]\nsigma = 3\n{SLIP}": "study.production.sigma is not a key of this specification; study.production has tolerances, samples, checks, seed, yield.",
    TOLERANCE: "study.production.tolerances.0.key must be a dotted key of this specification; got none.",
    f'{TOLERANCE}key = "{SETS}"\ntolerance = 1': f"must name a continuous quantity; got {SETS}, which is a count.",
    f'{TOLERANCE}key = "{YOKE}"': f"study.production.tolerances.0 must hold tolerance alone, or plus and minus together, for {YOKE}; got none.",
    f'{TOLERANCE}key = "{YOKE}"\nplus = "1 um"': "or plus and minus together",
    f'{SLIP}plus = "1 um"\nminus = "1 um"': "got tolerance and plus and minus.",
    f'{TOLERANCE}key = "{YOKE}"\nplus = "1 um"\nminus = "-2 um"': "study.production.tolerances.0.minus must be at least 0 mm, for it is the distance from the nominal value; got -0.002 mm.",
    f'{TOLERANCE}key = "{YOKE}"\ntolerance = "0 mm"': f"study.production.tolerances.0 must let {YOKE} scatter; got 0 mm to both sides.",
    f'{TOLERANCE}key = "{YOKE}"\ntolerance = 0.05': "study.production.tolerances.0.tolerance must be a length",
    f'{TOLERANCE}key = "{YOKE}"\ntolerance = "2 mm"': f"study.production.tolerances.0.tolerance: {YOKE} must exceed 0 mm; got -1 mm.",
    f'{BOTH}{TOLERANCE}key = "{YOKE}"\nplus = "0.1 mm"\nminus = "0.4 mm"': f"study.production.tolerances.0.minus: {YOKE} must exceed 0 mm; got -0.1 mm.",
    f'{SLIP}distribution = "gauss"': 'study.production.tolerances.0.distribution must be one of normal, uniform, triangular; got "gauss".',
    SLIP + SLIP: f"study.production.tolerances must name each key once; got {YOKE} twice.",
    f'{SLIP}{TOLERANCE}key = "actuator.back_yoke.outer_diameter"\ntolerance = "1 um"\n{TOLERANCE}key = "actuator.back_yoke.inner_diameter"\ntolerance = "1 um"': "The study is over-determined: at most 2 of",
}  # fmt: skip


@pytest.mark.parametrize("lines", WRONG, ids=[re.sub(r"\W+", "-", lines)[-60:] for lines in WRONG])
def test_a_study_that_makes_no_sense(lines):
    """Catches a traceback, a study that runs for hours before it fails, and a sentence that hides the key."""
    assert WRONG[lines] in refused(lines)


@pytest.mark.parametrize(
    ("figure", "upper"),
    [("bore_dilation", "-1 um"), ("shaft_stress", "-1 MPa"), ("peak_force", "-1 N"), ("winding_room", "-1 mm")],
)
def test_figures_that_can_be_negative_may_have_negative_limits(figure, upper):
    """Catches a bore that is pressed inwards, or a rod that is pulled, and no limit on it."""
    assert study(f'{CONSTRAINT}figure = "{figure}"\nupper = "{upper}"').constraints[0].upper < 0
