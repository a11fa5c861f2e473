"""Catalogue sizes: what is bought has one, clearances stay, and the figures are those of the design that is written."""

import json
from itertools import pairwise
from pathlib import Path

import pytest

import fluxbore
from fluxbore import snapping
from fluxbore.cli import main
from fluxbore.design.catalogue import SHAFTS, TUBES, WIRES
from fluxbore.design.catalogue_rules import RULES
from fluxbore.design.errors import DesignError
from fluxbore.design.spec_file import template
from fluxbore.reading import load

EXAMPLES = Path(__file__).parents[1] / "examples"


@pytest.fixture(scope="module")
def snapped():
    return fluxbore.snap(EXAMPLES / "ipehla.toml")


def test_what_is_bought_has_a_size_of_its_catalogue(snapped):
    for rule in RULES["hybrid"]:
        sizes = [{key: size.lengths[length] for key, length in rule.keys.items()} for size in rule.catalogue.sizes]
        assert {key: snapped.spec.values[key] for key in rule.keys} in sizes


def test_clearances_stay(snapped):
    """Catches magnets that stand in a narrower bore as wide as before."""
    before = load(EXAMPLES / "ipehla.toml")
    for key in ("mover.outer_diameter", "piston.fin_outer_diameter", "piston.fin_inner_diameter"):
        gaps = [
            item.number("actuator.cylinder.inner_diameter") - item.number(f"actuator.{key}")
            for item in (before, snapped.spec)
        ]
        assert gaps[0] == pytest.approx(gaps[1], abs=1e-12)


def test_figures_are_those_of_the_written_design(snapped, tmp_path, capsys, monkeypatch):
    """Catches a file that is not the design whose figures were printed."""
    monkeypatch.setattr(snapping, "snap", lambda spec: snapped)
    status = main(
        [
            "export",
            str(EXAMPLES / "ipehla.toml"),
            "-o",
            str(tmp_path),
            "--snap",
            "catalogue",
            "--format",
            "bom",
            "--json",
        ]
    )
    found = json.loads(capsys.readouterr().out)
    assert (status, found["status"]) == (0, "ok")
    written = load(next(path for path in found["files"] if path.endswith("iPEHLA-catalogue.toml")))
    assert written.given == snapped.spec.given
    assert found["snap"]["after"]["force_constant"] == fluxbore.evaluate(written).performance.force_constant
    assert found["snap"]["before"]["force_constant"] != found["snap"]["after"]["force_constant"]


@pytest.mark.parametrize("name", ["ipehla", "prehydra", "rotlin"])
def test_a_design_of_catalogue_sizes_stays_as_it_is(name, monkeypatch):
    """Catches sizes that wander from one run to the next."""
    monkeypatch.setattr(snapping, "evaluate", lambda spec: fluxbore.evaluate(spec, "network"))
    once = fluxbore.snap(EXAMPLES / f"{name}.toml")
    again = fluxbore.snap(once.spec)
    assert again.spec.given == once.spec.given
    assert not any(item.after for item in again.bought)


def test_a_limit_that_is_missed_is_told(tmp_path, capsys, monkeypatch):
    """Catches a design that no longer keeps its limits and goes to the workshop all the same."""
    text = template("ipehla").replace(
        'lower = "0.5 mm"\n\n[[study.sweeps]]',
        'lower = "0.5 mm"\n\n[[study.constraints]]\nfigure = "force_constant"\nlower = "start"\n\n[[study.sweeps]]',
        1,
    )
    (tmp_path / "spec.toml").write_text(text)
    monkeypatch.setattr(snapping, "evaluate", lambda spec: fluxbore.evaluate(spec, "network"))
    assert (
        main(
            [
                "export",
                str(tmp_path / "spec.toml"),
                "-o",
                str(tmp_path / "out"),
                "--snap",
                "catalogue",
                "--format",
                "bom",
            ]
        )
        == 3
    )
    assert "force_constant >=" in capsys.readouterr().out


def test_the_next_size_is_taken_where_the_nearest_makes_no_actuator(monkeypatch):
    """Catches a run that ends at the first tube that does not fit."""
    tried = []

    def refuse(spec):
        tried.append(spec.number("actuator.shaft.outer_diameter"))
        if tried[-1] == 0.008:
            raise DesignError("too thick")

    monkeypatch.setattr(snapping, "assembly_of", refuse)
    monkeypatch.setattr(snapping, "evaluate", lambda spec: fluxbore.evaluate(spec, "network"))
    shaft = fluxbore.snap(load(EXAMPLES / "ipehla.toml")).bought[0]
    assert (shaft.rank, shaft.after["actuator.shaft.outer_diameter"]) == (1, 0.0079375)
    monkeypatch.setattr(snapping, "assembly_of", lambda spec: refuse(load(EXAMPLES / "ipehla.toml")))
    with pytest.raises(
        DesignError, match=r"^The shaft must have a size of the catalogue \(precision shaft\).*: too thick"
    ):
        fluxbore.snap(load(EXAMPLES / "ipehla.toml"))


def test_catalogues_are_as_published():
    """A few rows looked up; wires grow, and every tube has the wall that it says."""
    assert next(size for size in WIRES.sizes if size.lengths["bare"] == 0.4e-3).lengths["insulated"] == 0.439e-3
    assert {size.lengths["outer"] for size in SHAFTS.sizes} >= {0.008, 0.00635}
    for size in TUBES.sizes:
        assert size.lengths["outer"] - size.lengths["inner"] == pytest.approx(2 * size.lengths["wall"], abs=2e-9)
        assert size.lengths["inner"] > 0
    for one, other in pairwise(WIRES.sizes):
        assert one.lengths["bare"] < other.lengths["bare"] < other.lengths["insulated"]
