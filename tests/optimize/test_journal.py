"""The journal: what was written comes back to the last bit, and no torn byte costs more than its own record."""

import json
import math
from dataclasses import replace

import pytest
import toy
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.errors import OutputError
from fluxbore.design.performance import Performance
from fluxbore.optimize.evaluation import FAILED, INVALID, NOT_CONVERGED, OK, Evaluation, Norm, failure, to_plain
from fluxbore.optimize.journal import Journal, settled

EVALUATION = toy.plain(toy.spec(x=1 / 3, y=math.pi))


def same(one, other):
    """Equality in which NaN equals itself."""
    return repr(to_plain(one)) == repr(to_plain(other))


def test_an_evaluation_comes_back_to_the_last_bit(tmp_path):
    """Catches floats that are rounded on their way through the file, and a reopened journal unlike a live one."""
    with Journal(tmp_path / "j") as journal:
        put = journal.put("a", "sweep", {toy.X: 1 / 3}, EVALUATION)
        assert same(journal.get("a"), put)
    with Journal(tmp_path / "j") as journal:
        assert same(journal.get("a"), put)
        assert same(put, settled(EVALUATION))
        assert journal.get("a").performance == EVALUATION.performance
        assert journal.get("b") is None


def test_other_results_stand_beside_designs(tmp_path):
    """Catches a note that is taken for a design, is lost on reopening, or costs the designs around it when torn."""
    content = {"figures": {"a": 1 / 3, "b": [1, None, "x"]}}
    with Journal(tmp_path / "j") as journal:
        journal.put("a", "sweep", {}, EVALUATION)
        assert journal.note("n", "simulation", {"figures": {"a": 1 / 3, "b": (1, float("nan"), "x")}}) == content
        assert journal.noted("n") == content
        assert "n" not in journal
        assert len(journal) == 1
        journal.note("m", "simulation", content)
    whole = (tmp_path / "j").read_bytes()
    for cut in (1, 2, 40):
        (tmp_path / "j").write_bytes(whole[:-cut])
        with Journal(tmp_path / "j") as journal:
            assert journal.noted("n") == content
            assert journal.noted("m") == (content if cut == 1 else None)
            assert journal.get("n") is None
            assert journal.noted("a") is None
            assert same(journal.put("b", "sweep", {}, EVALUATION), journal.get("a"))
        with Journal(tmp_path / "j") as journal:
            assert same(journal.get("b"), journal.get("a"))


@given(st.floats(allow_nan=True, allow_infinity=True))
def test_every_float_survives_or_is_null(tmp_path_factory, value):
    """Catches a NaN in the file, which is not JSON, and any finite float that does not read back as itself."""
    path = tmp_path_factory.mktemp("journal") / "j"
    with Journal(path) as journal:
        journal.put("a", "sweep", {}, Evaluation("fem", OK, (), Performance(force_constant=value)))
        found = journal.get("a").performance.force_constant
    assert found == value if math.isfinite(value) else found is None
    json.loads(path.read_text(), parse_constant=pytest.fail)


def test_numbers_of_numpy_are_written_as_numbers(tmp_path):
    """Catches a journal that dies of a numpy integer, and a table with "np.float64(1.0)" in it."""
    np = pytest.importorskip("numpy")
    evaluation = Evaluation("fem", OK, (), Performance(force_constant=np.float64(0.1)), (), {"nodes": np.int64(7)})
    with Journal(tmp_path / "j") as journal:
        found = journal.put("a", "sweep", {}, evaluation)
    assert repr(found.performance.force_constant) == "0.1"
    assert found.details == {"nodes": 7}
    assert same(found, settled(evaluation))


@pytest.mark.parametrize("stride", [23, pytest.param(1, marks=pytest.mark.full)])
def test_torn_at_any_byte_it_loses_the_torn_record_only(tmp_path, stride):
    """Catches every way of reading half a record as a whole one, or of losing a whole one beside it.

    stride : bytes between the tears; around the records' ends it is torn at each.
    """
    whole = tmp_path / "whole"
    ends = [0]
    with Journal(whole) as journal:
        for i in range(2):
            journal.put(str(i), "sweep", {}, EVALUATION)
            ends.append(whole.stat().st_size)
    content = whole.read_bytes()
    torn = tmp_path / "torn"
    beside = {end + i for end in ends for i in range(-4, 5)}
    for length in sorted({*range(0, len(content), stride), *beside} & {*range(len(content) + 1)}):
        torn.write_bytes(content[:length])
        # A record is whole with its last brace; only the line's end may be missing.
        expected = sum(length >= end - 1 for end in ends[1:])
        with Journal(torn) as journal:
            assert len(journal) == expected, length
            journal.put("new", "sweep", {}, EVALUATION)
        with Journal(torn) as journal:
            assert len(journal) == expected + 1, length
            assert same(journal.get("new"), settled(EVALUATION))
        assert all(json.loads(line) for line in torn.read_text().splitlines())


BAD_LINES = [
    b"\n",
    b"\0" * 40 + b"\n",
    b"{}\n",
    b"[1]\n",
    b'{"key":1,"evaluation":{"status":"ok"}}\n',
    b'{"key":"c","evaluation":{"status":"ok"}}\n',
    b'{"key":"c","evaluation":{"status":"ok","positions":[1]}}\n',
    b'{"key":"c","evaluation":{"fidelity":"fem","status":"ok","reasons":[],"performance":{"gone":1},"positions":[],'
    b'"details":null}}\n',
    b"\xff\xfe\n",
]


@pytest.mark.parametrize("damage", BAD_LINES)
def test_a_damaged_line_in_the_middle_costs_nothing_else(tmp_path, damage):
    """Catches a journal that refuses to open after a power cut filled a block with zeros."""
    path = tmp_path / "j"
    with Journal(path) as journal:
        journal.put("a", "sweep", {}, EVALUATION)
    with path.open("ab") as file:
        file.write(damage)
    with Journal(path) as journal:
        journal.put("b", "sweep", {}, EVALUATION)
    with Journal(path) as journal:
        assert "a" in journal
        assert "b" in journal
        assert len(journal) == 2
        assert journal.get("c") is None


def test_what_crashed_is_tried_again_and_what_is_invalid_is_not(tmp_path):
    """Catches a lack of memory that is remembered as the design's fault."""
    with Journal(tmp_path / "j") as journal:
        for status in (FAILED, INVALID, NOT_CONVERGED):
            journal.put(status, "sweep", {}, failure("fem", status, "Why."))
    with Journal(tmp_path / "j") as journal:
        assert journal.get(FAILED) is None
        assert journal.get(INVALID).reasons == ("Why.",)
        assert journal.get(NOT_CONVERGED).status == NOT_CONVERGED


def test_two_runs_in_one_folder_are_refused(tmp_path):
    """Catches two writers whose records would be torn by each other."""
    with (
        Journal(tmp_path / "j"),
        pytest.raises(OutputError, match=r"must be written by one run at a time; another run is at work"),
    ):
        Journal(tmp_path / "j")
    Journal(tmp_path / "j").close()


def test_a_place_that_cannot_be_written_is_one_sentence(tmp_path):
    """Catches a traceback for a folder that is not there."""
    with pytest.raises(OutputError, match=r"cannot be written: "):
        Journal(tmp_path / "nowhere" / "j")
    with pytest.raises(OutputError, match=r"cannot be written: "):
        Journal(tmp_path)


def test_a_record_with_derivatives_serves_a_request_without(tmp_path):
    """Catches a sweep that computes again what a search has computed with more, and derivatives where none belong."""
    rich = replace(EVALUATION, gradient={"force_constant": {toy.X: 0.5}}, norms={"stray_field": Norm(8.0, 0.1)})
    unsound = replace(failure("fem", NOT_CONVERGED, "Why."), gradient={})
    with Journal(tmp_path / "j") as journal:
        journal.put("with", "search", {}, rich, "without")
        journal.put("unsound with", "search", {}, unsound, "unsound")
        live = journal.get("without")
    with Journal(tmp_path / "j") as journal:
        assert len(journal) == 2
        assert journal.get("with").gradient == rich.gradient
        assert journal.get("with").norms == rich.norms
        assert same(journal.get("without"), settled(EVALUATION))
        assert same(live, settled(EVALUATION))
        assert journal.get("unsound") is None, "it may converge without"
        other = replace(EVALUATION, warnings=("A plain record of its own.",))
        journal.put("without", "sweep", {}, other)
        assert journal.get("without").warnings == other.warnings
