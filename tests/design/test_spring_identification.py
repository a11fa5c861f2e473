"""A magnetic spring's laws from displacement and force: what is found, how well, and what data do not tell."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from fluxbore.design.dynamics.bouc_wen import BoucWen
from fluxbore.design.dynamics.magnetic_hysteresis import HysteresisSpring, force_record, steady_loop
from fluxbore.design.dynamics.magnetic_spring import LinearSpring, PolynomialSpring, SineSpring
from fluxbore.design.errors import FluxboreError, IdentificationError, MeasurementError, SpecError
from fluxbore.design.measurements import Measurements, parse_measurements
from fluxbore.design.spring_identification import (
    COLUMNS,
    LAWS,
    TIME,
    hysteresis_spring,
    identify_spring,
    linear_spring,
    polynomial_spring,
    sine_spring,
)

Floats = NDArray[np.float64]

H = 36e-3 / 7 / math.tau
TABLE_II = HysteresisSpring(SineSpring(192.0, H), 0.96, BoucWen(1.0, 3000.0, 1000.0))
TRUTH = {
    "stall_force": 192.0,
    "transfer_ratio": H,
    "weight": 0.96,
    "rising_rate": 4000.0,
    "falling_rate": 2000.0,
    "psi": 3000.0,
    "xi": 1000.0,
    "pitch": 36e-3 / 7,
}


def path(*amplitudes: float, rows: int = 50) -> Floats:
    """To and fro, from rest at zero."""
    turns = [0.0]
    for amplitude in amplitudes:
        turns += [amplitude, -amplitude]
    legs = [np.linspace(begin, end, rows)[1:] for begin, end in pairwise(turns)]
    return np.concatenate([[0.0], *legs])


LOOPS = path(0.35e-3, 0.35e-3, 0.85e-3, 0.85e-3, 1.1e-3)


def table(x: Floats, f: Floats, noise: float = 0.0, seed: int = 1, time: Floats | None = None) -> Measurements:
    """As a file would give it."""
    scattered = f + np.random.default_rng(seed).normal(0.0, noise, len(f))
    columns = [x, scattered] if time is None else [x, scattered, time]
    rows = [",".join(map(repr, row)) for row in np.stack(columns, axis=1).tolist()]
    header = "displacement,force" if time is None else "displacement,force,time"
    return parse_measurements("\n".join([header, *rows]), "loops.csv", COLUMNS, optional=(TIME,))


def test_without_scatter_the_hysteresis_itself_comes_back() -> None:
    found = identify_spring("hysteresis", table(LOOPS, force_record(TABLE_II, LOOPS)))
    estimates = {**found.parameters, **found.derived}
    for name, value in TRUTH.items():
        assert estimates[name].value == pytest.approx(value, rel=1e-6), name
    spring = hysteresis_spring(found)
    assert steady_loop(spring, 0.847e-3).height == pytest.approx(4.28, rel=0.01)


def test_the_zero_and_the_state_at_the_start_are_found_where_asked_for() -> None:
    """Encoders zeroed 20 um off, in the middle of a loop; not asked for, no hysteresis fits."""
    x, start = LOOPS[60:], -1.4e-4
    data = table(x + 20e-6, force_record(TABLE_II, x, start), noise=0.05)
    found = identify_spring("hysteresis", data, free=("zero_displacement", "start_state"))
    zero, state = (found.parameters[name] for name in ("zero_displacement", "start_state"))
    assert zero.value == pytest.approx(20e-6, abs=0.5e-6)
    assert state.low < start < state.high
    assert found.residual_deviation < 0.07
    with pytest.raises(IdentificationError, match="does not identify"):
        identify_spring("hysteresis", data)


@pytest.mark.full
def test_intervals_cover_the_truth() -> None:
    """At 90 %, 24 noisy records: far from 21.6 of them would be intervals of the wrong width, for any parameter."""
    x = path(0.35e-3, 0.85e-3, 1.1e-3, rows=25)
    clean = force_record(TABLE_II, x)
    hits = dict.fromkeys(("stall_force", "transfer_ratio", "weight", "rising_rate", "falling_rate"), 0)
    for seed in range(24):
        found = identify_spring("hysteresis", table(x, clean, 0.1, seed), level=0.9)
        for name in hits:
            estimate = found.parameters[name]
            hits[name] += estimate.low <= TRUTH[name] <= estimate.high
    assert all(17 <= count < 24 for count in hits.values()), hits


def test_each_law_finds_its_own() -> None:
    x = np.linspace(-1e-3, 1e-3, 81)
    linear, sine = LinearSpring(220e3), SineSpring(192.0, H)
    polynomial = PolynomialSpring((234e3, -5.5e10, 3e15))
    assert linear_spring(identify_spring("linear", table(x, linear.force(x)))).spring_constant == pytest.approx(220e3)
    found = identify_spring("sine", table(x, sine.force(x), 0.2))
    assert sine_spring(found).stall_force == pytest.approx(192.0, abs=0.5)
    assert found.derived["spring_constant"].low < sine.spring_constant < found.derived["spring_constant"].high
    fitted = polynomial_spring(identify_spring("polynomial", table(x, polynomial.force(x))))
    assert fitted.coefficients == pytest.approx(polynomial.coefficients, rel=1e-6)
    shifted = identify_spring("sine", table(x + 3e-5, sine.force(x), 0.2), free=("zero_displacement",))
    assert shifted.parameters["zero_displacement"].value == pytest.approx(3e-5, abs=1e-6)


def test_scatter_tells_the_laws_apart() -> None:
    """On loops up to the stall force: the line is worst, the sine and the polynomial leave the loop's height."""
    data = table(LOOPS, force_record(TABLE_II, LOOPS), 0.05)
    left = {law: identify_spring(law, data).residual_deviation for law in LAWS}
    assert left["hysteresis"] == pytest.approx(0.05, rel=0.2)
    assert 1.0 < left["sine"] < 2.0
    assert left["polynomial"] == pytest.approx(left["sine"], rel=0.1)
    assert left["linear"] > 3 * left["sine"]


def test_what_small_displacements_do_not_tell() -> None:
    """A tenth of a millimetre is on the straight part: stall force and pitch hold up to a factor."""
    x = path(0.05e-3, 0.05e-3)
    data = table(x, SineSpring(192.0, H).force(x), 0.2)
    with pytest.raises(IdentificationError, match="does not identify") as raised:
        identify_spring("sine", data)
    assert "transfer_ratio" in str(raised.value)
    assert "a quarter of the pitch" in str(raised.value)
    assert identify_spring("linear", data).parameters["spring_constant"].value == pytest.approx(234e3, rel=0.02)


def test_a_virgin_curve_does_not_tell_the_way_back() -> None:
    """psi - xi shows where the state comes back; one stretch of motion has none of that."""
    x = np.linspace(0.0, 1.1e-3, 200)
    with pytest.raises(IdentificationError, match="falling_rate"):
        identify_spring("hysteresis", table(x, force_record(TABLE_II, x), 0.05))


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize(
    ("time", "words"),
    [
        ([0.0, 0.1, 0.1], "line 4: time must rise from row to row; got 0.1 s after 0.1 s."),
        ([0.0, 0.2, 0.1], "line 4: time must rise from row to row; got 0.1 s after 0.2 s."),
    ],
)
def test_time_that_does_not_rise(law: str, time: list[float], words: str) -> None:
    head = np.array(time)
    rows = np.concatenate((head, head[-1] + 0.1 * np.arange(1, len(LOOPS) - 2)))
    with pytest.raises(MeasurementError) as raised:
        identify_spring(law, table(LOOPS, force_record(TABLE_II, LOOPS), time=rows))
    assert words in str(raised.value)


def test_a_gap_in_a_record_with_hysteresis() -> None:
    """What turned about in the gap is unknown; a law without memory does not mind."""
    time = 0.01 * np.arange(len(LOOPS))
    time[100:] += 0.5
    data = table(LOOPS, force_record(TABLE_II, LOOPS), time=time)
    with pytest.raises(MeasurementError) as raised:
        identify_spring("hysteresis", data)
    assert "line 102: time must rise by 0.01 s as elsewhere, within 10 %, without gaps; got a step of 0.51 s." in str(
        raised.value
    )
    identify_spring("sine", data)


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        ("1e-4,20\n2e-4,nan\n", 'line 3: force must hold finite numbers; got "nan"'),
        ("1e-4,20\n2e-4,\n", "line 3: force must hold finite numbers; got an empty cell"),
        ("0,0\n0,1\n", "displacement must reach 1e-06 mm or more from zero; got 0 mm"),
        ("1e-200,1\n2e-200,2\n", "displacement must reach 1e-06 mm or more from zero; got 2e-197 mm"),
        ("1e-4,-20\n2e-4,-40\n", "force must rise with the displacement by 0.001 N/m or more"),
        ("1e-4,1e-300\n2e-4,2e-300\n", "force must rise with the displacement by 0.001 N/m or more"),
        ("1e-4,20\n", "must have more rows than"),
        ("1e-4,20\n2e-4,40\n", "must have more rows than"),
    ],
)
def test_tables_that_are_no_spring_s(rows: str, words: str) -> None:

    def identified() -> None:
        data = parse_measurements("displacement,force\n" + rows, "t.csv", COLUMNS, optional=(TIME,))
        identify_spring("sine", data)

    with pytest.raises(FluxboreError) as raised:
        identified()
    assert words in str(raised.value)
    assert "\n" not in str(raised.value)


def test_laws_and_parameters_that_are_none() -> None:
    data = table(LOOPS, force_record(TABLE_II, LOOPS))
    with pytest.raises(SpecError, match='law must be one of linear, sine, polynomial, hysteresis; got "cubic"'):
        identify_spring("cubic", data)
    with pytest.raises(SpecError, match='free must be one of zero_displacement for sine; got "start_state"'):
        identify_spring("sine", data, free=("start_state",))
