"""Quantities at the file's edge: exact where decimals are, and nothing read that is not one number and one unit."""

import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.errors import SpecError
from fluxbore.design.units import (
    DIFFERENCES,
    DIMENSIONS,
    example,
    format_quantity,
    parse_quantity,
    quantity_pattern,
    with_article,
)

INDEPENDENT = {
    # From the SI brochure (9th ed.), NIST SP 811 appendix B and ISO 2533, not from the table under test.
    "length": {"mm": 0.001, "um": 0.000001, "cm": 0.01, "m": 1.0, "in": 0.0254},
    "area density": {"1/mm^2": 1e6, "1/cm^2": 1e4, "1/m^2": 1.0},
    "angle": {"deg": 0.017453292519943295, "rad": 1.0},
    "flux density": {"T": 1.0, "mT": 1e-3, "uT": 1e-6, "G": 1e-4},
    "current": {"A": 1.0, "mA": 1e-3},
    "stress": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9},
    "force": {"N": 1.0, "kN": 1e3, "mN": 1e-3},
    "force constant": {"N/A": 1.0},
    "motor constant": {"N/sqrt(W)": 1.0},
    "mass": {"kg": 1.0, "g": 1e-3},
    "resistance": {"ohm": 1.0, "mohm": 1e-3},
    "current density": {"A/mm^2": 1e6, "A/cm^2": 1e4, "A/m^2": 1.0, "MA/m^2": 1e6},
    "energy": {"J": 1.0, "kJ": 1e3, "MJ": 1e6},
    "work": {"J": 1.0, "mJ": 1e-3, "kJ": 1e3},
    "electric loading": {"A/m": 1.0, "kA/m": 1e3, "A/mm": 1e3},
    "time": {"s": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0},
    "volume": {"mm^3": 1e-9, "cm^3": 1e-6, "m^3": 1.0},
    "density": {"kg/m^3": 1.0, "g/cm^3": 1e3, "kg/dm^3": 1e3},
    "field strength": {"A/m": 1.0, "kA/m": 1e3, "Oe": 79.57747154594767, "kOe": 79577.47154594767},
    "resistivity": {"ohm m": 1.0, "ohm mm^2/m": 1e-6, "uohm cm": 1e-8, "nohm m": 1e-9},
    "temperature coefficient": {"%/K": 0.01, "1/K": 1.0},
    "speed": {"m/s": 1.0, "mm/s": 1e-3},
    "voltage": {"V": 1.0, "mV": 1e-3, "kV": 1e3},
    "inductance": {"H": 1.0, "mH": 1e-3, "uH": 1e-6},
    "thermal conductivity": {"W/(m K)": 1.0},
    "viscous friction": {"N s/m": 1.0},
    "energy density": {"J/m^3": 1.0, "kJ/m^3": 1e3},
    "frequency": {"Hz": 1.0, "kHz": 1e3},
    "area": {"mm^2": 1e-6, "cm^2": 1e-4, "m^2": 1.0},
    "stiffness": {"N/mm": 1e3, "N/m": 1.0, "kN/m": 1e3},
    "force density": {"kN/m^3": 1e3, "N/m^3": 1.0},
    "force constant density": {"kN/(A m^3)": 1e3, "N/(A m^3)": 1.0},
    "volume flow": {"ml/min": 1.6666666666666667e-8, "l/min": 1.6666666666666667e-5, "m^3/s": 1.0},
    "distance": {"km": 1e3, "m": 1.0},
    "wear rate": {"um/km": 1e-9, "mm/km": 1e-6, "m/m": 1.0},
    "specific wear": {"mm^3/(N m)": 1e-9, "m^2/N": 1.0},
    "torque": {"N m": 1.0, "mN m": 1e-3},
    "torque constant": {"N m/A": 1.0, "mN m/A": 1e-3},
    "acceleration": {"m/s^2": 1.0, "mm/s^2": 1e-3},
    "rotational inertia": {"kg m^2": 1.0, "g cm^2": 1e-7},
    "angular frequency": {"rad/s": 1.0, "rpm": 0.10471975511965977},
    "rate": {"1/s": 1.0},
    "wave number": {"1/m": 1.0, "1/mm": 1e3},
    "transfer ratio": {"rad/m": 1.0, "rad/mm": 1e3},
    "inverse speed": {"s/m": 1.0},
    "speed gain": {"A s/rad": 1.0},
    "shaft power": {"W": 1.0, "mW": 1e-3, "kW": 1e3},
    "dynamic viscosity": {"mPa s": 1e-3, "Pa s": 1.0},
    "force per pressure": {"N/MPa": 1e-6, "N/bar": 1e-5, "N/Pa": 1.0},
    "force gain": {"mm/(N s)": 1e-3, "m/(N s)": 1.0},
    "force rate": {"N/s": 1.0, "kN/s": 1e3},
    "specific force": {"N/kg": 1.0, "kN/kg": 1e3},
    "linear mass": {"g/m": 1e-3, "kg/m": 1.0},
    "heat capacity": {"J/(kg K)": 1.0, "kJ/(kg K)": 1e3},
}
"""SI value of one unit, for every dimension without an offset."""


@pytest.mark.parametrize("dimension", INDEPENDENT)
def test_each_unit_against_its_published_size(dimension):
    """Catches a wrong factor, a unit that is gone and a unit that nobody checked."""
    assert set(DIMENSIONS[dimension].units) == set(INDEPENDENT[dimension])
    for unit, size in INDEPENDENT[dimension].items():
        assert parse_quantity(f"1 {unit}", dimension, "key") == pytest.approx(size, rel=1e-15)


def test_every_dimension_is_checked_somewhere_here():
    offset = {"pressure", "temperature", *DIFFERENCES.values()}
    assert set(DIMENSIONS) == set(INDEPENDENT) | offset


@pytest.mark.parametrize(
    "text, pascal",
    [
        ("0.6 MPa gauge", 600_000.0),
        ("0.6 MPa absolute", 498_675.0),
        ("6 bar gauge", 600_000.0),
        ("1.01325 bar absolute", 0.0),
        ("100 kPa gauge", 100_000.0),
        ("0 Pa absolute", -101_325.0),
        ("14.695948775513 psi absolute", 0.0),  # 1 atm, NIST SP 811
        ("100 psi gauge", 689_475.7293168),
        ("101325 Pa absolute", 0.0),
        ("101.325 kPa absolute", 0.0),
        ("5 Pa gauge", 5.0),
    ],
)
def test_pressures_are_kept_as_gauge_pressure(text, pascal):
    assert parse_quantity(text, "pressure", "key") == pytest.approx(pascal, rel=1e-13, abs=1e-6)


@pytest.mark.parametrize(
    "text, kelvin",
    [
        ("20 degC", 293.15),
        ("0 K", 0.0),
        ("32 degF", 273.15),
        ("212 degF", 373.15),
        ("-40 degF", 233.15),
        ("-40 degC", 233.15),
    ],
)
def test_temperatures_are_kept_in_kelvin(text, kelvin):
    assert parse_quantity(text, "temperature", "key") == pytest.approx(kelvin, rel=1e-14, abs=1e-12)


@pytest.mark.parametrize(
    "text, dimension, value",
    [
        ("5 degC", "temperature difference", 5.0),
        ("5 K", "temperature difference", 5.0),
        ("9 degF", "temperature difference", 5.0),
        ("0.1 MPa gauge", "pressure difference", 1e5),
        ("0.1 MPa absolute", "pressure difference", 1e5),
        ("1 bar", "pressure difference", 1e5),
    ],
)
def test_differences_know_no_offset(text, dimension, value):
    """Catches a step of 5 degC read as 278 K."""
    assert parse_quantity(text, dimension, "key") == pytest.approx(value, rel=1e-15)


def test_decimals_become_the_nearest_float():
    """Catches 0.1 * 1e-3 = 0.00010000000000000002: grids and hashes then differ from what a person typed."""
    for i in range(1, 2000):
        assert parse_quantity(f"{i / 100:g} mm", "length", "key") == float(f"{i}e-5")
    assert parse_quantity("0.1 mm", "length", "key") == 1e-4
    assert parse_quantity("1.05 %/K", "temperature coefficient", "key") == 0.0105


@given(st.sampled_from(sorted(DIMENSIONS)), st.data())
def test_every_unit_survives_writing_and_reading(dimension, data):
    """One unit's number, written in the preferred unit and read again, moves by rounding alone."""
    unit = data.draw(st.sampled_from(sorted(DIMENSIONS[dimension].units)))
    number = data.draw(st.floats(-1e9, 1e9).filter(lambda x: x == 0 or abs(x) > 1e-9))
    value = parse_quantity(f"{number!r} {unit}", dimension, "key")
    again = parse_quantity(format_quantity(value, dimension, 17), dimension, "key")
    table = DIMENSIONS[dimension]
    offset = max(abs(table.units[name].offset) for name in (unit, table.preferred))
    assert again == pytest.approx(value, rel=1e-14, abs=1e-14 * offset)


WRONG = [
    "", " ", "27", "mm", "27 m m", "27 mm mm", "27 mm 28 mm", "27 kg", "27 MM", "1,5 mm", "one mm", "nan mm", "inf mm",
    "-inf mm", "1e400 mm", "1e99999999999 mm", "1e999999999999999999999 mm", "0x10 mm", "1_000 mm", "27 mm\n",
    "27\nmm", "2 7 mm", "+-1 mm", "1e mm", "1.2.3 mm", "27 mm # remark", "27mm!", "\N{ARABIC-INDIC DIGIT ONE} mm",
    "1 \N{SQUARE MM}", "1 \N{GREEK SMALL LETTER MU}m", "27\0mm", "<b>27 mm</b>", "1/2 mm", "27 * mm",
]  # fmt: skip


@pytest.mark.parametrize("text", WRONG)
def test_whatever_is_not_one_number_and_one_unit_is_refused(text):
    """Catches any guess: the sentence names the key and what would do, and stays short."""
    with pytest.raises(SpecError) as caught:
        parse_quantity(text, "length", "actuator.back_yoke.thickness")
    sentence = str(caught.value)
    assert sentence.startswith("actuator.back_yoke.thickness must be a")
    assert sentence.endswith(".")
    assert "; got " in sentence
    assert len(sentence) < 250


@pytest.mark.parametrize("raw", [27, 27.0, True, None, [], ["27 mm"], {"value": "27 mm"}, math.nan, object(), b"27 mm"])
def test_whatever_is_not_text_is_refused(raw):
    with pytest.raises(SpecError, match=r"^key must be a length, one number and one unit of mm, um, cm, m, in"):
        parse_quantity(raw, "length", "key")


def test_bare_numbers_commas_and_plain_pressures_get_a_hint():
    with pytest.raises(SpecError, match=r"got the bare number 27\.$"):
        parse_quantity(27, "length", "key")
    with pytest.raises(SpecError, match="the decimal sign is a point"):
        parse_quantity("1,5 mm", "length", "key")
    with pytest.raises(SpecError, match=r'say "MPa gauge" or "MPa absolute"'):
        parse_quantity("0.6 MPa", "pressure", "key")


@pytest.mark.parametrize(
    "text", ["27mm", " 27 mm ", "27\tmm", "27\N{NO-BREAK SPACE}mm", "+27 mm", "27.0e0 mm", "2.7e1 mm"]
)
def test_space_is_free_and_signs_and_exponents_are_numbers(text):
    assert parse_quantity(text, "length", "key") == 0.027


@given(st.sampled_from(sorted(DIMENSIONS)), st.data())
def test_the_schemas_pattern_takes_what_the_reader_takes(dimension, data):
    """Catches an editor that complains of what fluxbore reads, or the other way round."""
    units = sorted({unit for table in DIMENSIONS.values() for unit in table.units})
    alphabet = [*"0123456789+-.eE,^/()%_ \t\n", "\N{NO-BREAK SPACE}", "\N{ARABIC-INDIC DIGIT TWO}", *units]
    text = "".join(data.draw(st.lists(st.sampled_from(alphabet), max_size=6)))
    text = data.draw(st.sampled_from([text, f"{data.draw(st.floats(allow_nan=False, allow_infinity=False))!r} {text}"]))
    # ECMA's $ is the end of the text, Python's also stands before a last line feed.
    fits = re.search(quantity_pattern(dimension)[:-1] + r"\Z", text) is not None
    try:
        parse_quantity(text, dimension, "key")
        read = True
    except SpecError as error:
        read = "must be a finite" in str(error)
    assert read == fits


def test_examples_are_quantities():
    for dimension in DIMENSIONS:
        parse_quantity(example(dimension).strip('"'), dimension, "key")


def test_articles():
    assert with_article("length") == "a length"
    assert with_article("area density") == "an area density"
