"""Keys: limits, what each kind takes, and values that survive being written."""

import math
import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.errors import SpecError, one_line, shown
from fluxbore.design.hybrid_keys import HYBRID_ALTERNATIVES, HYBRID_KEYS
from fluxbore.design.keys import LONGEST_WORD, Alternatives, Key, toml_string

WIDTH = Key("a.width", "", above=0.0, maximum=1.0)
COUNT = Key("a.count", "", kind="integer", minimum=1, maximum=9)
RATIO = Key("a.ratio", "", kind="number", minimum=1.0)
WORD = Key("a.word", "", kind="word")
CHOICE = Key("a.choice", "", kind="word", choices=("one", "two"))
HEAT = Key("a.heat", "", dimension="temperature", above=0.0)


@pytest.mark.parametrize(
    "key, raw, value",
    [
        (WIDTH, "5 mm", 0.005),
        (COUNT, 4, 4),
        (RATIO, 1.05, 1.05),
        (RATIO, 2, 2.0),
        (WORD, " N48 ", "N48"),
        (CHOICE, "two", "two"),
    ],
)
def test_each_kind_reads_its_own(key, raw, value):
    assert key.read(raw) == value
    assert type(key.read(raw)) is type(value)


@pytest.mark.parametrize(
    "key, raw, sentence",
    [
        (WIDTH, "0 mm", "a.width must exceed 0 mm; got 0 mm."),
        (WIDTH, "-2 mm", "a.width must exceed 0 mm; got -2 mm."),
        (WIDTH, "2 m", "a.width must be at most 1000 mm; got 2000 mm."),
        (COUNT, 0, "a.count must be at least 1; got 0."),
        (COUNT, 10, "a.count must be at most 9; got 10."),
        (COUNT, 4.0, "a.count must be a whole number, such as 4; got 4.0."),
        (COUNT, True, "a.count must be a whole number, such as 4; got true."),
        (COUNT, "4", 'a.count must be a whole number, such as 4; got "4".'),
        (RATIO, 0.5, "a.ratio must be at least 1; got 0.5."),
        (RATIO, "1.05", 'a.ratio must be a plain finite number without a unit; got "1.05".'),
        (RATIO, math.nan, "a.ratio must be a plain finite number without a unit; got nan."),
        (RATIO, math.inf, "a.ratio must be a plain finite number without a unit; got inf."),
        (RATIO, [1], "a.ratio must be a plain finite number without a unit; got [1]."),
        (WORD, 1010, "a.word must be text in quotes; got 1010."),
        (WORD, "  ", 'a.word must be text in quotes; got "  ".'),
        (WORD, "two\nlines", 'a.word must be one line of printable text; got "two\\nlines".'),
        (WORD, "\N{RIGHT-TO-LEFT OVERRIDE}x", 'a.word must be one line of printable text; got "\\u202ex".'),
        (
            WORD,
            "x" * (LONGEST_WORD + 1),
            f"a.word must have at most {LONGEST_WORD} characters; got {LONGEST_WORD + 1}.",
        ),
        (CHOICE, "three", 'a.choice must be one of one, two; got "three".'),
    ],
)
def test_the_sentence_names_key_limit_and_value(key, raw, sentence):
    with pytest.raises(SpecError) as caught:
        key.read(raw)
    assert str(caught.value) == sentence


def test_a_whole_number_beyond_every_float_is_refused_in_words():
    """Catches an OverflowError: TOML as Python reads it has whole numbers without end."""
    for key in (COUNT, RATIO):
        with pytest.raises(SpecError, match=f"^{key.name} must be .*; got "):
            key.read(10**400)


@given(st.floats(1e-12, 1.0))
def test_a_length_is_written_so_that_it_reads_back_to_the_last_bit(value):
    """Catches a design.toml whose evaluation differs from the report in the last digit."""
    assert tomllib.loads(f"x = {WIDTH.write(value)}")["x"].endswith(" mm")
    assert WIDTH.read(tomllib.loads(f"x = {WIDTH.write(value)}")["x"]) == value


@given(st.floats(1.0, 1e308))
def test_a_number_is_written_so_that_it_reads_back_to_the_last_bit(value):
    assert RATIO.read(tomllib.loads(f"x = {RATIO.write(value)}")["x"]) == value


@given(st.floats(1e-3, 1000.0))
def test_a_temperature_comes_back_to_within_rounding(value):
    assert HEAT.read(tomllib.loads(f"x = {HEAT.write(value)}")["x"]) == pytest.approx(value, rel=1e-15, abs=1e-13)


@given(st.text())
def test_any_text_survives_as_a_toml_string(text):
    assert tomllib.loads(f"x = {toml_string(text)}")["x"] == text


def test_a_step_of_temperature_is_no_temperature():
    step = HEAT.difference
    assert step.read("5 degC") == step.read("5 K") == 5.0
    assert step.read("-5 K") == -5.0
    assert step.show(5.0) == "5 K"
    assert WIDTH.difference.read("-2 mm") == -0.002


@pytest.mark.parametrize(
    "raw, text",
    [
        ("a", '"a"'), (True, "true"), (None, "none"), (1.5, "1.5"), ([1, "a"], '[1, "a"]'), ({}, "an empty table"),
        ({"a": 1}, "{ a = 1 }"), ([[[[1]]]], "[[[...]]]"), ("x" * 100, '"' + "x" * 57 + '..."'), ("a\nb", '"a\\nb"'),
    ],
)  # fmt: skip
def test_a_wrong_value_is_shown_as_toml_on_one_line(raw, text):
    assert shown(raw) == text


@given(
    st.recursive(
        st.none() | st.text() | st.integers() | st.floats(), lambda x: st.lists(x) | st.dictionaries(st.text(), x)
    )
)
def test_whatever_is_shown_is_short_and_one_line(raw):
    text = shown(raw)
    assert len(text) < 700
    assert text.isprintable()
    assert one_line(text) == text


def test_alternatives_say_which_keys_and_why():
    pair = Alternatives(("a.x", "a.y", "a.z"), 2, "z = x + y")
    pair.check({"a.x": 1.0, "a.z": 1.0})
    with pytest.raises(
        SpecError, match=r"over-determined: give exactly two of a\.x, a\.y, a\.z \(z = x \+ y\); got a\.x, a\.y, a\.z\."
    ):
        pair.check({"a.x": 1.0, "a.y": 1.0, "a.z": 1.0})
    with pytest.raises(SpecError, match=r"under-determined: .*; got none\.$"):
        pair.check({})


def test_the_table_of_the_hybrid_is_consistent():
    """Catches a key declared twice, a default outside its own limits, an alternative that names no key."""
    names = [key.name for key in HYBRID_KEYS]
    assert len(set(names)) == len(names)
    assert {name for group in HYBRID_ALTERNATIVES for name in group.keys} <= set(names)
    for key in HYBRID_KEYS:
        assert key.doc
        assert key.name.count(".") in (1, 2)
        assert key.leaf == key.name.split(".")[-1]
        assert key.section + "." + key.leaf == key.name
        if key.default is not None:
            key.check(key.default)
